// Chunks that store data verbatim.

#include "codec/blocks.hpp"
#include "codec/decoding.hpp"
#include "codec/faces.hpp"
#include "codec/names.hpp"
#include "surface/vertex_numbers.hpp"

namespace sweepface::codec {

namespace {

// One vertex for each point and each T-node, and those within arcs and patches.
std::int64_t gridVertices(const Surface& surface) {
  const Wireframe& w = surface.wireframe();
  std::int64_t count = VertexNumbers(w).count;
  for (const Arc& arc : w.arcs) count += arc.collapsed ? 0 : arc.edges - 1;
  for (Index p = 0; p < surface.patchCount(); ++p)
    count += (surface.edgesU(p) - std::int64_t{1}) * (surface.edgesV(p) - 1);
  return count;
}

// Every corner takes a byte of what follows, so many faces need many bytes.
void readFaceSizes(Reader& in, Polygons& faces) {
  const std::size_t most = in.left();
  const auto sizes = readRuns(in, 3, INT32_MAX, most, "size of a face");
  std::int64_t corners = 0;
  for (Index size : sizes) {
    corners += size;
    if (corners > static_cast<std::int64_t>(most))
      return in.refuse("the faces have too many corners");
    faces.faceStart.push_back(static_cast<Index>(corners));
  }
}

std::vector<Index> readFaceNames(Reader& in, const Polygons& faces,
                                 const std::vector<std::string>& names) {
  const auto count = static_cast<std::size_t>(faces.faceCount());
  auto chosen = readRuns(in, -1, static_cast<Index>(names.size()), count, "name of a face");
  if (!chosen.empty() && chosen.size() != count) in.refuse("some faces have no name");
  return chosen;
}

}  // namespace

void readLoose(Decoding& d, Reader& in) {
  d.rig->source.loose = readVectors<Vec3>(in, d.loose, Precision::exact);
}

void readSourceOrder(Decoding& d, Reader& in) {
  auto& order = d.rig->source.gridVertex;
  const std::size_t count = in.count(1, "vertices");
  if (!d.afford(in, count, sizeof(Index))) return;
  order.resize(count);
  const std::int64_t low = -static_cast<std::int64_t>(d.rig->source.loose.size());
  const std::int64_t high = gridVertices(d.rig->surface);
  Index last = -1;
  for (Index& v : order) v = last = in.step(last + 1, low, high, "vertex");
}

void readPolygons(Decoding& d, Reader& in) {
  // A size, a corner or a name takes at least a byte.
  if (!d.afford(in, in.left(), sizeof(std::string))) return;
  Polygons& faces = d.rig->source.polygons;
  readFaceSizes(in, faces);
  const auto vertices = static_cast<Index>(d.rig->source.gridVertex.size());
  faces.corners.resize(in.ok() ? faces.faceStart.back() : 0);
  Index last = 0;
  for (Index& v : faces.corners) v = last = in.step(last, 0, vertices, "vertex");
  faces.materials = readTexts(in, "materials");
  faces.faceMaterial = readFaceNames(in, faces, faces.materials);
  faces.groups = readTexts(in, "groups");
  faces.faceGroup = readFaceNames(in, faces, faces.groups);
  faces.materialFiles = readTexts(in, "material files");
}

void readTexcoords(Decoding& d, Reader& in) {
  Polygons& faces = d.rig->source.polygons;
  const std::size_t count = in.size();
  if (!d.afford(in, count, sizeof(Vec2)) || !d.afford(in, faces.corners.size(), sizeof(Index)))
    return;
  faces.texcoords = readVectors<Vec2>(in, count, Precision::exact);
  if (in.number(0, 2, "flag") == 0) return;
  if (faces.corners.size() > in.left()) in.refuse("texture coordinates of corners are missing");
  if (!in.ok()) return;
  faces.cornerTexcoords.resize(faces.corners.size());
  Index last = -1;
  for (Index& t : faces.cornerTexcoords)
    t = last = in.step(last, -1, static_cast<Index>(faces.texcoords.size()), "texture coordinate");
}

void readQuadCorners(Decoding& d, Reader& in) {
  if (d.quads > in.left()) return in.refuse("corners of quads are missing");
  if (!d.afford(in, d.quads, sizeof(std::array<Index, 4>))) return;
  const Polygons& faces = d.rig->source.polygons;
  const auto corners = static_cast<Index>(faces.corners.size());
  Index first = 0;
  for (std::size_t q = 0; q < d.quads && in.ok(); ++q) {
    const std::int64_t told = in.signedNumber();
    std::array<Index, 4> quad = aroundQuad(faces, -1);
    const std::int64_t moved = first + (told >> 1);
    if (moved < 0 || moved >= corners) return in.refuse("a corner is out of range");
    quad[0] = first = static_cast<Index>(moved);
    if (told & 1)
      for (int k = 1; k < 4; ++k) quad[k] = in.step(quad[k - 1], 0, corners, "corner");
    else
      quad = aroundQuad(faces, first);
    if (quad[3] < 0) return in.refuse("a quad goes around a face that has not four corners");
    d.rig->source.quadCorners.insert(d.rig->source.quadCorners.end(), quad.begin(), quad.end());
  }
}

void readScene(Decoding& d, Reader& in) {
  if (d.afford(in, in.left(), 1)) d.rig->scene = in.text();
}
void readThingNames(Decoding& d, Reader& in) {
  // A name takes at least a byte, and a view for the search for duplicates.
  if (d.afford(in, in.left(), sizeof(std::string) + sizeof(std::string_view)))
    d.rig->names = readNames(in, d.rig->surface.wireframe());
}

// Vectors that are not whole multiples of steps, verbatim, by pose.
void readExact(Decoding& d, Reader& in) {
  std::int64_t pose = -1;
  while (in.left() > 0) {
    pose += 1 + static_cast<std::int64_t>(in.size());
    if (pose > static_cast<std::int64_t>(d.rig->targets.size()))
      return in.refuse("there are more poses than announced");
    std::vector<Vec3>& vectors = d.rig->vectorsOf(static_cast<Index>(pose));
    const std::size_t count = in.count(1, "vectors"), memory = d.memory;
    if (!d.afford(in, count, sizeof(Index) + sizeof(Vec3))) return;
    std::vector<Index> places(count);
    Index last = -1;
    for (Index& v : places)
      v = last = in.step(last + 1, 0, static_cast<Index>(vectors.size()), "vector");
    const std::vector<Vec3> values = readVectors<Vec3>(in, places.size(), Precision::exact);
    if (!in.ok()) return;
    d.memory = memory;  // what was read of this pose is soon freed
    if (pose == 0) {
      if (!d.afford(in, vectors.size(), sizeof(Vec3))) return;
      d.rig->packing.rest = vectors;
    }
    for (std::size_t k = 0; k < places.size(); ++k) vectors[places[k]] = values[k];
  }
}

void readDrift(Decoding& d, Reader& in) {
  for (Target& target : d.rig->targets)
    target.looseDifference = readVectors<Vec3>(in, d.loose, Precision::exact);
  if (d.rig->source.loose.empty()) in.refuse("there are no loose vertices that could move");
}

}  // namespace sweepface::codec
