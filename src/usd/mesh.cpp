#include "usd/mesh.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "sweepface/box.hpp"
#include "sweepface/lod_polygons.hpp"

#include "io/single.hpp"
#include "parallel/parallel.hpp"
#include "usd/skeleton.hpp"
#include "usd/values.hpp"

namespace sweepface::usd {
namespace {

std::unexpected<Error> beyondFloats() {
  return fail("The face has numbers that are too large for the single precision of USD.");
}

std::vector<Index> facesOf(const Polygons& polygons) {
  std::vector<Index> faces;
  for (Index f = 0; f < polygons.faceCount(); ++f)
    if (polygons.faceSize(f) >= 3) faces.push_back(f);
  return faces;
}

}  // namespace

MeshWriter::MeshWriter(const Rig& rig, const UsdOptions& options, const Tessellation& grid)
    : rig_(rig),
      options_(options),
      grid_(grid),
      shapes_(rig, grid),
      polygons_(options.lod > 0 ? lodPolygons(rig, grid_) : rig.source.polygons),
      faces_(facesOf(polygons_)),
      materials_(polygons_, faces_) {
  placePoints();
}

Result<void> MeshWriter::add(Text& text, const std::string& path, const std::string& name,
                             const std::string& skeleton) const {
  if (faces_.empty()) return fail("The face has no polygon with three corners or more to export.");
  const std::vector<Vec3> points = placed(shapes_.neutral().positions);
  if (!io::areSingle(points) || !io::areSingle(polygons_.texcoords)) return beyondFloats();
  if (skeleton.empty())
    text.open("Mesh", name);
  else
    text.open("Mesh", name, {R"(prepend apiSchemas = ["SkelBindingAPI"])"});
  const Box box(points);
  text.set("uniform bool doubleSided", "1");  // mouths and lashes are seen from both sides
  text.set("float3[] extent", list(std::array{box.low, box.high}));
  addFaces(text);
  text.set("normal3f[] normals", list(placed(shapes_.neutral().normals)),
           {R"(interpolation = "vertex")"});
  text.set("point3f[] points", list(points));
  addTexcoords(text);
  text.set("uniform token subdivisionScheme", R"("none")");
  if (!skeleton.empty()) bindToJoint(text, skeleton, points.size());
  PrimNames names;
  if (auto ok = addBlendShapes(text, path + "/" + name, points, names); !ok) return ok;
  materials_.addSubsets(text, path, names);
  text.close();
  return {};
}

void MeshWriter::placePoints() {
  if (options_.lod > 0) {
    places_.resize(grid_.vertexCount());
    std::iota(places_.begin(), places_.end(), 0);
    return;
  }
  for (Index v = 0; v < static_cast<Index>(rig_.source.gridVertex.size()); ++v)
    places_.push_back(shapes_.placeOf(v));
}

std::vector<Vec3> MeshWriter::placed(const std::vector<Vec3>& values) const {
  std::vector<Vec3> list;
  list.reserve(places_.size());
  for (const Index place : places_) list.push_back(values[place]);
  return list;
}

void MeshWriter::addFaces(Text& text) const {
  std::vector<Index> counts, corners;
  for (const Index f : faces_) {
    counts.push_back(polygons_.faceSize(f));
    for (Index c = polygons_.faceStart[f]; c < polygons_.faceStart[f + 1]; ++c)
      corners.push_back(polygons_.corners[c]);
  }
  text.set("int[] faceVertexCounts", list(counts));
  text.set("int[] faceVertexIndices", list(corners));
}

/// Corners without a texture coordinate get (0, 0).
void MeshWriter::addTexcoords(Text& text) const {
  if (polygons_.cornerTexcoords.empty()) return;
  std::vector<Vec2> values = polygons_.texcoords;
  const auto none = static_cast<Index>(values.size());
  std::vector<Index> indices;
  for (const Index f : faces_)
    for (Index c = polygons_.faceStart[f]; c < polygons_.faceStart[f + 1]; ++c)
      indices.push_back(polygons_.cornerTexcoords[c] < 0 ? none : polygons_.cornerTexcoords[c]);
  if (std::ranges::find(indices, none) != indices.end()) values.emplace_back();
  text.set("texCoord2f[] primvars:st", list(values), {R"(interpolation = "faceVarying")"});
  text.set("int[] primvars:st:indices", list(indices));
}

Result<void> MeshWriter::addBlendShapes(Text& text, const std::string& path,
                                        const std::vector<Vec3>& points, PrimNames& names) const {
  if (rig_.targets.empty()) return {};
  std::vector<std::string> tokens, prims;
  std::string paths;
  for (const Target& target : rig_.targets) {
    tokens.push_back(target.name);
    prims.push_back(names.take(target.name));
    paths += fmt::format("{}<{}/{}>", paths.empty() ? "" : ", ", path, prims.back());
  }
  text.set("uniform token[] skel:blendShapes", list(tokens));
  text.set("rel skel:blendShapeTargets", "[" + paths + "]");
  double largest = 0;
  for (const Vec3& p : points)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  std::vector<Text> shapes(rig_.targets.size(), Text(text.depth()));
  std::atomic<bool> sound = true;
  parallelFor(std::size_t{0}, shapes.size(), [&](std::size_t k) {
    if (!addBlendShape(shapes[k], prims[k], static_cast<Index>(k), io::kHalfDigit * largest))
      sound = false;
  });
  if (!sound) return beyondFloats();
  for (Text& shape : shapes) text.append(std::move(shape));
  return {};
}

/// Returns whether its numbers fit. A point that moves by no more than `least` keeps its place
/// when that is added to a float as large as the mesh.
bool MeshWriter::addBlendShape(Text& text, const std::string& prim, Index target,
                               double least) const {
  const MorphShape shape = shapes_.target(target, options_.morphNormals);
  std::vector<Index> moved;
  std::vector<Vec3> offsets, normals;
  for (std::size_t v = 0; v < places_.size(); ++v) {
    const Vec3& offset = shape.positions[places_[v]];
    const Vec3 turn = options_.morphNormals ? shape.normals[places_[v]] : Vec3{};
    if (norm(offset) <= least && norm(turn) <= io::kHalfDigit) continue;
    moved.push_back(static_cast<Index>(v));
    offsets.push_back(offset);
    if (options_.morphNormals) normals.push_back(turn);
  }
  if (moved.empty()) {  // without any index, offsets would be those of all points
    moved = {0}, offsets = {{}};
    if (options_.morphNormals) normals = {{}};
  }
  text.open("BlendShape", prim);
  if (options_.morphNormals) text.set("uniform vector3f[] normalOffsets", list(normals));
  text.set("uniform vector3f[] offsets", list(offsets));
  text.set("uniform int[] pointIndices", list(moved));
  text.close();
  return io::areSingle(offsets);
}

}  // namespace sweepface::usd
