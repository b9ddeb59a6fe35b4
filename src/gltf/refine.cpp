#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "gltf/fine_mesh.hpp"
#include "gltf/same_vertices.hpp"

namespace sweepface::gltf {
namespace {

bool isSkin(std::string_view name) {
  return name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

/// Extensions of a primitive that do not count on its vertices.
bool survives(std::string_view extension) {
  constexpr std::array names{"KHR_materials_variants", "EXT_mesh_features",
                             "EXT_structural_metadata"};
  return std::ranges::find(names, extension) != names.end();
}

class Refiner {
 public:
  Refiner(BoundScene& scene, const FineMesh& mesh, Slots& slots)
      : scene_(scene), mesh_(mesh), slots_(slots) {}

  Result<void> refine() {
    // All is read before anything is overwritten: parts may share accessors.
    for (const Part& part : scene_.parts.parts)
      if (auto ok = mix(part); !ok) return ok;
    for (auto& [place, value] : values_)
      value.accessor = slots_.put(place.second, value.column, Use::vertices);
    for (std::size_t p = 0; p < scene_.parts.parts.size(); ++p) rewrite(p);
    return {};
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // run, accessor
  struct Value {
    Column column;
    std::size_t accessor = 0;  // where it is now
  };

  Result<void> mix(const Part& part) {
    Json& primitive = primitiveOf(scene_.document, scene_.parts, part);
    if (auto ok = mixSkin(part.run, primitive["attributes"]); !ok) return ok;
    if (auto ok = mixAll(part.run, primitive["attributes"]); !ok) return ok;
    if (Json* const targets = find(primitive, "targets"))
      for (Json& target : *targets)
        if (auto ok = mixAll(part.run, target); !ok) return ok;
    return {};
  }

  Result<void> mixAll(std::size_t run, Json& attributes) {
    const Json before = attributes;  // some are taken out on the way
    for (const auto& [name, number] : before.items()) {
      if (isSkin(name) || name == "POSITION" || name == "NORMAL") continue;
      const auto accessor = accessorAt(scene_.document, number.get<std::size_t>());
      if (!accessor) return std::unexpected(accessor.error());
      if (isGeometry(name) || accessor->columns > 1) {
        attributes.erase(name);
        continue;
      }
      const auto [value, isNew] = values_.try_emplace(Place{run, accessor->index});
      if (!isNew) continue;
      auto column = mixed(scene_.document, *accessor, mesh_.runs[run].places);
      if (!column) return std::unexpected(column.error());
      bytes_ += column->bytes.size();
      if (bytes_ > mostBytes)
        return fail(
            "The face's attributes would need more than the 4 GiB of a GLB; choose a lower "
            "level of detail.");
      value->second.column = std::move(*column);
    }
    return {};
  }

  Result<void> mixSkin(std::size_t run, const Json& attributes) {
    SkinAttributes skin;
    for (int set = 0;; ++set) {
      const Json* const joints = find(attributes, fmt::format("JOINTS_{}", set));
      const Json* const weights = find(attributes, fmt::format("WEIGHTS_{}", set));
      if (!joints || !weights) break;
      for (const auto& [number, list] :
           {std::pair{joints, &skin.joints}, std::pair{weights, &skin.weights}}) {
        const auto accessor = accessorAt(scene_.document, number->get<std::size_t>());
        if (!accessor) return std::unexpected(accessor.error());
        if (accessor->components() != 4)
          return fail("A mesh of the face's scene has joints that are not in fours.");
        list->push_back(*accessor);
      }
    }
    if (skin.joints.empty() || values_.contains({run, skin.joints[0].index})) return {};
    auto columns = mixedSkin(scene_.document, skin, mesh_.runs[run].places);
    if (!columns) return std::unexpected(columns.error());
    for (std::size_t s = 0; s < skin.joints.size(); ++s) {
      values_[{run, skin.joints[s].index}].column = std::move(columns->joints[s]);
      values_[{run, skin.weights[s].index}].column = std::move(columns->weights[s]);
    }
    return {};
  }

  void rewrite(std::size_t number) {
    const Part& part = scene_.parts.parts[number];
    Json& primitive = primitiveOf(scene_.document, scene_.parts, part);
    const auto indices = findIndex(primitive, "indices", scene_.document.list("accessors").size());
    primitive["indices"] = slots_.put(indices, packIndices(mesh_.triangles[number]), Use::indices);
    primitive.erase("mode");
    point(part.run, primitive["attributes"]);
    if (Json* const targets = find(primitive, "targets"))
      for (Json& target : *targets) point(part.run, target);
    if (Json* const extensions = find(primitive, "extensions");
        extensions && extensions->is_object()) {
      const Json before = *extensions;
      for (const auto& [name, value] : before.items())
        if (!survives(name)) extensions->erase(name);
      if (extensions->empty()) primitive.erase("extensions");
    }
  }

  /// Makes attributes name the accessors that hold their new values.
  void point(std::size_t run, Json& attributes) {
    for (auto& [name, number] : attributes.items())
      if (const auto value = values_.find({run, number.get<std::size_t>()}); value != values_.end())
        number = value->second.accessor;
  }

  BoundScene& scene_;
  const FineMesh& mesh_;
  Slots& slots_;
  std::map<Place, Value> values_;
  std::size_t bytes_ = 0;
};

}  // namespace

Result<void> refine(BoundScene& scene, const FineMesh& mesh, Slots& slots) {
  return Refiner(scene, mesh, slots).refine();
}

}  // namespace sweepface::gltf
