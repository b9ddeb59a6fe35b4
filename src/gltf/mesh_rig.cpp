#include "gltf/mesh_rig.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "gltf/texcoords.hpp"
#include "gltf/triangles.hpp"
#include "io/single.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

class RigReader {
 public:
  RigReader(const Document& document, const Parts& parts)
      : document_(document),
        parts_(parts),
        materials_(rig_.neutral.polygons.materials),
        groups_(rig_.neutral.polygons.groups) {}

  Result<PartedRig> read() {
    if (auto ok = checkRoom(); !ok) return std::unexpected(ok.error());
    for (const Run& run : parts_.runs)
      if (auto ok = addNeutral(run); !ok) return std::unexpected(ok.error());
    for (const std::string& name : parts_.targets)
      rig_.targets.push_back({name, rig_.neutral.positions});
    for (const Run& run : parts_.runs)
      if (auto ok = addTargets(run); !ok) return std::unexpected(ok.error());
    for (const Part& part : parts_.parts)
      if (auto ok = addPart(part); !ok) return std::unexpected(ok.error());
    if (rig_.neutral.polygons.faceCount() == 0)
      return fail("it has no triangle of three different vertices; export the file again.");
    return PartedRig{std::move(rig_), std::move(facePart_)};
  }

 private:
  /// A few bytes can claim much: targets without data, accessors that are used again and again.
  Result<void> checkRoom() const {
    const std::size_t shapes = parts_.targets.size() + 1;
    if (parts_.vertexCount <= document_.mostClaimed() / shapes) return {};
    return fail(
        fmt::format("it claims {} morph targets of {} vertices in {} bytes, more than a file of "
                    "this size can mean; export the file again.",
                    parts_.targets.size(), parts_.vertexCount, document_.sourceBytes));
  }

  const RigMesh& meshOf(const Run& run) const { return parts_.meshes[run.rigMesh]; }

  Result<std::vector<Vec3>> vectors(std::size_t index) const {
    const auto accessor = accessorAt(document_, index);
    if (!accessor) return std::unexpected(accessor.error());
    if (accessor->type == Component::uint32)
      return fail(fmt::format(
          "accessor {}: positions cannot be integers of 32 bits; export the file again.", index));
    const auto values = decode(document_, *accessor);
    if (!values) return std::unexpected(values.error());
    return asVectors(*values);
  }

  Result<void> addNeutral(const Run& run) {
    const auto accessor = accessorAt(document_, run.position);
    if (!accessor) return std::unexpected(accessor.error());
    if (!accessor->hasData())
      return fail(
          fmt::format("accessor {}: the POSITION of a mesh has no data; export the file "
                      "again.",
                      run.position));
    const auto positions = vectors(run.position);
    if (!positions) return std::unexpected(positions.error());
    for (const Vec3& p : *positions) {
      rig_.neutral.positions.push_back(meshOf(run).world.point(p));
      if (!io::isSingle(rig_.neutral.positions.back())) return tooLarge(run.position);
    }
    return {};
  }

  Result<void> addTargets(const Run& run) {
    for (std::size_t t = 0; t < run.targets.size(); ++t) {
      if (!run.targets[t]) continue;
      const auto deltas = vectors(*run.targets[t]);
      if (!deltas) return std::unexpected(deltas.error());
      Vec3* const moved = &rig_.targets[meshOf(run).targets[t]].positions[run.first];
      for (std::size_t v = 0; v < run.count; ++v) {
        moved[v] += meshOf(run).world.direction((*deltas)[v]);
        if (!io::isSingle(moved[v])) return tooLarge(*run.targets[t]);
      }
    }
    return {};
  }

  static std::unexpected<Error> tooLarge(std::size_t accessor) {
    return fail(
        fmt::format("accessor {}: a vertex is too far away for a float in the scene; scale "
                    "the model down and export it again.",
                    accessor));
  }

  Result<void> addPart(const Part& part) {
    const Json& primitive = primitiveOf(document_, parts_, part);
    const Run& run = parts_.runs[part.run];
    Members in(primitive, placeOf(document_, meshOf(run).mesh, part.primitive));
    const auto found = trianglesOf(document_, parts_, part);
    if (!found) return std::unexpected(found.error());
    corners_ += found->named;
    if (corners_ > document_.mostElements())
      in.refuse("the triangles of the file are more than its size can mean");
    const auto texcoords = addTexcoords(primitive);
    if (!texcoords) return std::unexpected(texcoords.error());
    const Index material = readMaterial(in);
    if (!in.ok()) return in.error();
    for (const Triangle& triangle : found->triangles) addFace(triangle, run, *texcoords);
    const auto faces = static_cast<std::size_t>(rig_.neutral.polygons.faceCount());
    rig_.neutral.polygons.faceMaterial.resize(faces, material);
    rig_.neutral.polygons.faceGroup.resize(faces, groups_(meshName(run)));
    facePart_.resize(faces, static_cast<Index>(&part - parts_.parts.data()));
    return {};
  }

  /// Adds a part's texture coordinates, unless another part shares them; returns the index of the
  /// first, or -1.
  Result<Index> addTexcoords(const Json& primitive) {
    const Json* const number = find(primitive["attributes"], "TEXCOORD_0");
    if (!number) return -1;
    std::vector<Vec2>& all = rig_.neutral.polygons.texcoords;
    const auto transform = textureTransformOf(document_, primitive);
    if (!transform) return std::unexpected(transform.error());
    const auto [known, isNew] = texcoords_.emplace(std::pair(*number, *transform), all.size());
    if (!isNew) return known->second;
    const auto texcoords = readTexcoords(document_, primitive, *transform);
    if (!texcoords) return std::unexpected(texcoords.error());
    if (all.size() + texcoords->size() > document_.mostElements())
      return fail("it has more texture coordinates than its size can mean; export the file again.");
    all.insert(all.end(), texcoords->begin(), texcoords->end());
    return known->second;
  }

  Index readMaterial(Members& in) {
    const std::size_t count = document_.list("materials").size();
    const auto index = in.optionalIndex("material", count, "materials");
    return index ? materials_(materialNames_[*index]) : -1;
  }

  std::string meshName(const Run& run) const {
    const Json* const name = find(document_.list("meshes")[meshOf(run).mesh], "name");
    return name && name->is_string() ? name->get<std::string>() : std::string();
  }

  void addFace(const Triangle& triangle, const Run& run, Index texcoords) {
    Polygons& polygons = rig_.neutral.polygons;
    // A mirrored mesh shows the side from which its corners go clockwise.
    const bool mirrored = meshOf(run).mirrors;
    for (const Index v : {triangle[0], triangle[mirrored ? 2 : 1], triangle[mirrored ? 1 : 2]}) {
      polygons.corners.push_back(static_cast<Index>(run.first) + v);
      polygons.cornerTexcoords.push_back(texcoords < 0 ? -1 : texcoords + v);
    }
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
  }

  const Document& document_;
  const Parts& parts_;
  MeshRig rig_;
  std::vector<Index> facePart_;
  std::vector<std::string> materialNames_ = materialNames(document_);
  io::NameIndex materials_, groups_;
  std::size_t corners_ = 0;
  // The first texture coordinate of each accessor, by the transform applied.
  std::map<std::pair<Json, TextureTransform>, Index> texcoords_;
};

}  // namespace

Result<PartedRig> readMeshRig(const Document& document, const Parts& parts) {
  auto read = RigReader(document, parts).read();
  if (!read) return read;
  Polygons& polygons = read->rig.neutral.polygons;
  if (polygons.texcoords.empty()) polygons.cornerTexcoords.clear();
  return read;
}

}  // namespace sweepface::gltf
