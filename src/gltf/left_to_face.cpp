#include "gltf/left_to_face.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

#include "gltf/slots.hpp"
#include "gltf/texcoords.hpp"
#include "gltf/triangles.hpp"

namespace sweepface::gltf {
namespace {

bool keepsOrder(const Json& primitive) {
  const Json* const extensions = find(primitive, "extensions");
  if (!extensions || !extensions->is_object()) return false;
  return std::ranges::any_of(extensions->items(),
                             [](const auto& entry) { return countsOnOrder(entry.key()); });
}

/// The accessor that a reference names, if it has no data.
std::optional<std::size_t> emptyAccessor(const Document& document, const Json* reference) {
  const auto index =
      reference ? asIndex(*reference, document.list("accessors").size()) : std::nullopt;
  if (!index) return {};
  const auto accessor = accessorAt(document, *index);
  return accessor && !accessor->hasData() ? index : std::nullopt;
}

class Taker {
 public:
  Taker(BoundScene& scene, const Polygons& polygons)
      : scene_(scene),
        polygons_(polygons),
        builder_(scene.document),
        slots_(scene.document, scene.parts, builder_),
        facesOf_(scene.parts.parts.size()) {
    for (Index face = 0; face < polygons.faceCount(); ++face)
      facesOf_[scene.facePart[face]].push_back(face);
  }

  Result<void> take() {
    for (std::size_t p = 0; p < facesOf_.size(); ++p) {
      if (auto ok = takeTriangles(p); !ok) return ok;
      if (auto ok = noteTexcoords(p); !ok) return ok;
    }
    for (const auto& [place, values] : texcoords_) {
      const std::size_t accessor = slots_.put(place.second, pack(values), Use::vertices);
      for (Json* const reference : holders_[place]) *reference = accessor;
    }
    return {};
  }

 private:
  /// Run and accessor.
  using Place = std::pair<std::size_t, std::size_t>;

  Json& primitiveOf(std::size_t part) {
    return gltf::primitiveOf(scene_.document, scene_.parts, scene_.parts.parts[part]);
  }
  const Run& runOf(std::size_t part) const {
    return scene_.parts.runs[scene_.parts.parts[part].run];
  }
  /// The vertex of the part's run at a corner of a face.
  Index vertexAt(std::size_t part, Index corner) const {
    return polygons_.corners[corner] - static_cast<Index>(runOf(part).first);
  }

  Result<void> takeTriangles(std::size_t part) {
    Json& primitive = primitiveOf(part);
    const auto accessor = emptyAccessor(scene_.document, find(primitive, "indices"));
    if (!accessor) return {};
    const auto as = accessorAt(scene_.document, *accessor);
    if (as->type != Component::uint8 && as->type != Component::uint16 &&
        as->type != Component::uint32)
      return fail(fmt::format("its indices, accessor {}, are no unsigned integers", *accessor));
    // A mirrored mesh shows the side from which its corners go clockwise.
    const bool mirrored = scene_.parts.meshes[runOf(part).rigMesh].world.mirrors();
    std::vector<double> indices;
    for (const Index face : facesOf_[part]) {
      const Index first = polygons_.faceStart[face];
      for (Index k = 1; k + 1 < polygons_.faceSize(face); ++k)
        for (const Index corner : {Index{0}, mirrored ? k + 1 : k, mirrored ? k : k + 1})
          indices.push_back(vertexAt(part, first + corner));
    }
    const Column column = pack(indices, 1, as->type);
    if (!column.sound)
      return fail(fmt::format("its indices, accessor {}, have too few bits", *accessor));
    primitive["indices"] = slots_.put(accessor, column, Use::indices);
    if (Json* const mode = find(primitive, "mode")) *mode = listMode;
    return {};
  }

  /// Parts of a run share what they have in one accessor.
  Result<void> noteTexcoords(std::size_t part) {
    Json& primitive = primitiveOf(part);
    Json* const reference = find(primitive["attributes"], "TEXCOORD_0");
    const auto accessor = emptyAccessor(scene_.document, reference);
    if (!accessor || !hasPlainTexcoords(scene_.document, primitive)) return {};
    if (polygons_.cornerTexcoords.empty()) return {};
    const Place place{scene_.parts.parts[part].run, *accessor};
    holders_[place].push_back(reference);
    std::vector<Vec2>& values = texcoords_[place];
    if (values.empty()) elements_ += runOf(part).count;
    if (elements_ > scene_.document.mostElements())
      return fail("it has far more texture coordinates");
    values.resize(runOf(part).count);
    for (const Index face : facesOf_[part])
      for (Index c = polygons_.faceStart[face]; c < polygons_.faceStart[face + 1]; ++c)
        if (const Index t = polygons_.cornerTexcoords[c]; t >= 0)
          values[vertexAt(part, c)] = {polygons_.texcoords[t].x, 1 - polygons_.texcoords[t].y};
    return {};
  }

  BoundScene& scene_;
  const Polygons& polygons_;
  Builder builder_;
  Slots slots_;
  std::vector<std::vector<Index>> facesOf_;  // [parts]
  std::map<Place, std::vector<Vec2>> texcoords_;
  std::map<Place, std::vector<Json*>> holders_;
  std::size_t elements_ = 0;  // of all texture coordinates
};

}  // namespace

std::set<const Json*> leftToFace(const Document& document, const Parts& parts) {
  std::set<const Json*> left;
  for (const Part& part : parts.parts) {
    const Json& primitive = primitiveOf(document, parts, part);
    const Json* const indices = find(primitive, "indices");
    const auto count = triangleCount(document, parts, part);
    if (indices && !keepsOrder(primitive) && count && *count > 0) left.insert(indices);
    if (hasPlainTexcoords(document, primitive))
      left.insert(find(primitive["attributes"], "TEXCOORD_0"));
  }
  return left;
}

Result<std::size_t> triangleCount(const Document& document, const Parts& parts, const Part& part) {
  const Json* const indices = find(primitiveOf(document, parts, part), "indices");
  if (const auto accessor = emptyAccessor(document, indices))
    return accessorAt(document, *accessor)->count / 3;
  const auto found = trianglesOf(document, parts, part);
  if (!found) return std::unexpected(found.error());
  return found->triangles.size();
}

Result<void> takeFromFace(BoundScene& scene, const Polygons& polygons) {
  return Taker(scene, polygons).take();
}

}  // namespace sweepface::gltf
