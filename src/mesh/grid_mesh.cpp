#include "mesh/grid_mesh.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "mesh/face_cutter.hpp"
#include "mesh/face_repeats.hpp"
#include "mesh/shared_edges.hpp"
#include "mesh/weld.hpp"
#include "surface/union_find.hpp"

namespace sweepface {

namespace {

using Corner = FaceCutter::Corner;

// The pieces of a face may all meet in one corner: time grows with the square of their number.
constexpr Index kMostCorners = 4096;

// Chooses which corner of each triangle becomes its collapsed side: the one where most triangles
// meet, so that fans share their pole, and otherwise the most irregular one.
void rotateTriangles(std::vector<std::vector<Corner>>& pieces, std::size_t vertexCount) {
  std::vector<Index> triangles(vertexCount, 0), faces(vertexCount, 0);
  for (const auto& piece : pieces)
    for (const Corner& c : piece) {
      ++faces[c.vertex];
      triangles[c.vertex] += piece.size() == 3;
    }
  const auto rank = [&](const Corner& c) {
    const bool pole = triangles[c.vertex] == faces[c.vertex] && faces[c.vertex] > 4;
    return std::tuple(pole, triangles[c.vertex], std::abs(faces[c.vertex] - 4), -c.vertex);
  };
  for (auto& piece : pieces)
    if (piece.size() == 3) {
      const auto best =
          std::max_element(piece.begin(), piece.end(),
                           [&](const Corner& a, const Corner& b) { return rank(a) < rank(b); });
      std::rotate(piece.begin(), best == piece.begin() + 2 ? piece.begin() : best + 1, piece.end());
      piece.push_back(piece.back());
    }
}

// Joins quads over every edge that exactly two of them share in opposite directions.
// Returns the edges that cannot be joined.
std::vector<std::pair<Index, Index>> pairEdges(GridMesh& mesh,
                                               const std::vector<std::array<Index, 4>>& welded) {
  std::vector<EdgeSide> sides;
  mesh.twin.resize(4 * welded.size());
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h) {
    const Index a = welded[h >> 2][h & 3], b = welded[h >> 2][(h + 1) & 3];
    if (a != b) sides.emplace_back(a, b, h);
  }
  return pairSides(sides, mesh.twin);
}

// One vertex for each fan of quads around a welded vertex, one point for vertices that collapsed
// sides tie together. Welded vertices from `count` on are those of backs; modulo `count` they are
// source vertices.
void numberVertices(GridMesh& mesh, const std::vector<std::array<Index, 4>>& welded, Index count) {
  const auto halves = static_cast<HalfEdge>(4 * welded.size());
  UnionFind fans(halves);
  for (HalfEdge h = 0; h < halves; ++h)
    if (const HalfEdge t = mesh.twin[prevIn(h)]; t >= 0) fans.join(h, t);
  std::vector<Index> vertexOf(halves, -1), anchor;
  mesh.quads.resize(welded.size());
  for (HalfEdge h = 0; h < halves; ++h) {
    Index& v = vertexOf[fans.find(h)];
    if (v < 0) {
      v = static_cast<Index>(anchor.size());
      anchor.push_back(welded[h >> 2][h & 3] % count);
    }
    mesh.quads[h >> 2][h & 3] = v;
  }
  UnionFind ties(static_cast<Index>(anchor.size()));
  for (HalfEdge h = 0; h < halves; ++h)
    if (mesh.collapsed[h]) ties.join(mesh.from(h), mesh.to(h));
  mesh.point.assign(anchor.size(), -1);
  std::vector<Index> pointOf(anchor.size(), -1);
  for (Index v = 0; v < static_cast<Index>(anchor.size()); ++v) {
    Index& p = pointOf[ties.find(v)];
    if (p < 0) {
      p = mesh.pointCount();
      mesh.source.push_back(anchor[v]);
    }
    mesh.point[v] = p;
  }
}

// Sheets that touch at a vertex are separate fans: a source vertex goes with the first of its
// faces, or, if none of these is left, with the vertices it was welded to.
void placeSource(GridMesh& mesh, const Polygons& faces, const std::vector<Index>& first) {
  mesh.pointOfSource.assign(first.size(), -1);
  std::vector<Index> welded(first.size(), -1);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (int k = 0; k < 4; ++k) {
      const Index v = faces.corners[mesh.quadCorners[q][k]], p = mesh.point[mesh.quads[q][k]];
      for (Index* place : {&mesh.pointOfSource[v], &welded[first[v]]})
        if (*place < 0) *place = p;
    }
  for (std::size_t v = 0; v < first.size(); ++v)
    if (mesh.pointOfSource[v] < 0) mesh.pointOfSource[v] = welded[first[v]];
}

// The grid mesh of the source with its vertices welded as `first` says; edges left open go to
// `cut`.
Result<GridMesh> build(const MeshRig& rig, const std::vector<FaceRepeat>& repeats,
                       const std::vector<Index>& first, std::vector<std::pair<Index, Index>>& cut) {
  const Polygons& faces = rig.neutral.polygons;
  FaceCutter cutter(rig.neutral.positions);
  Index without = 0;  // faces without a surface
  const auto count = static_cast<Index>(first.size());
  for (Index f = 0; f < faces.faceCount(); ++f) {
    if (faces.faceSize(f) > kMostCorners)
      return fail("face ", f + 1, " has ", faces.faceSize(f), " corners, of which ", kMostCorners,
                  " are the most; cut it into smaller ones");
    if (repeats[f] == FaceRepeat::again) continue;
    std::vector<Corner> face;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c)
      face.push_back({first[faces.corners[c]], c});
    const std::size_t before = cutter.pieces.size();
    cutter.cut(std::move(face));
    without += cutter.pieces.size() == before;
    // A sheet and its back share no vertex: the back's are numbered from `count` on.
    if (repeats[f] == FaceRepeat::back)
      for (std::size_t k = before; k < cutter.pieces.size(); ++k)
        for (Corner& corner : cutter.pieces[k]) corner.vertex += count;
  }
  if (cutter.pieces.empty())
    return fail("the mesh has no face with an area; nothing can be converted");
  rotateTriangles(cutter.pieces, 2 * first.size());

  GridMesh mesh;
  std::vector<std::array<Index, 4>> welded;
  for (const auto& piece : cutter.pieces) {
    std::array<Index, 4> quad, corners;
    for (int k = 0; k < 4; ++k) quad[k] = piece[k].vertex, corners[k] = piece[k].corner;
    welded.push_back(quad);
    mesh.quadCorners.push_back(corners);
  }
  mesh.collapsed.assign(4 * welded.size(), 0);
  for (std::size_t q = 0; q < welded.size(); ++q)
    mesh.collapsed[4 * q + 2] = welded[q][2] == welded[q][3];
  cut = pairEdges(mesh, welded);
  for (auto& [a, b] : cut) a %= count, b %= count;
  numberVertices(mesh, welded, count);
  placeSource(mesh, faces, first);
  if (without > 0)
    mesh.warnings.push_back(
        plural(without, "face has", "faces have") +
        " fewer than three different corners and no surface; the source order keeps them.");
  if (std::string sentence = warningOfCopies(repeats); !sentence.empty())
    mesh.warnings.push_back(std::move(sentence));
  return mesh;
}

// Where vertices stand together in the neutral, this many times as wide a gap elsewhere is told of.
constexpr double kPartedGap = 10;

/// The target in which two vertices are furthest apart.
const MeshTarget& partingTarget(const MeshRig& rig, Index one, Index other) {
  return *std::ranges::max_element(rig.targets, {}, [&](const MeshTarget& target) {
    return norm(target.positions[one] - target.positions[other]);
  });
}

/// A sentence on seams that stay open, if there are any.
std::string warningOfSeams(const MeshRig& rig, double rounding, double gap,
                           const std::vector<Index>& first) {
  if (const OpenSeams open = openSeams(rig, gap, gap, first); open.vertices > 0)
    return fmt::format(
        "The surface is open along {} within {:.2g} of others in every expression, like {} and {} "
        "(counted from 0); merge them if it is meant to be closed there.",
        plural(open.vertices, "vertex", "vertices"), open.widest, open.one, open.other);
  if (rig.targets.empty()) return {};
  const OpenSeams parted = openSeams(rig, kPartedGap * gap, rounding, first);
  if (parted.vertices == 0) return {};
  return fmt::format(
      "The surface is open, in all expressions, along {} that stand where others do in the "
      "neutral, but up to {:.2g} from them in an expression, like {} and {} (counted from 0) in "
      "'{}'; move them alike there if it is meant to be closed.",
      plural(parted.vertices, "vertex", "vertices"), parted.widest, parted.one, parted.other,
      partingTarget(rig, parted.one, parted.other).name);
}

}  // namespace

Result<GridMesh> makeGridMesh(const MeshRig& rig, double rounding, double gap) {
  const std::vector<FaceRepeat> repeats = faceRepeats(rig.neutral.polygons);
  std::vector<Index> first = weld(rig);
  if (rounding > 0) rounding = weldRounded(rig, rounding, first);
  const std::string seams = gap > 0 ? warningOfSeams(rig, rounding, gap, first) : "";
  while (true) {
    std::vector<std::pair<Index, Index>> cut;
    auto mesh = build(rig, repeats, first, cut);
    if (!mesh) return mesh;
    mesh->rounding = rounding;
    if (!seams.empty()) mesh->warnings.push_back(seams);
    if (cut.empty()) return mesh;
    if (takeApart(first, cut)) continue;
    mesh->warnings.push_back(
        plural(static_cast<Index>(cut.size()), "edge joins", "edges join") +
        " more than two faces or faces that look to opposite sides, the first one at the "
        "vertices " +
        std::to_string(cut.front().first) + " and " + std::to_string(cut.front().second) +
        " (counted from 0); the surface is cut there. Make neighbouring faces look to the same "
        "side, and remove the third face of an edge.");
    return mesh;
  }
}

}  // namespace sweepface
