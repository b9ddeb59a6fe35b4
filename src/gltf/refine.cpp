#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

#include "gltf/fine_mesh.hpp"
#include "gltf/same_vertices.hpp"
#include "gltf/skins.hpp"

namespace sweepface::gltf {
namespace {

bool isSkin(std::string_view name) {
  return name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

class Refiner {
 public:
  Refiner(BoundScene& scene, const FineMesh& mesh, Slots& slots)
      : scene_(scene), mesh_(mesh), slots_(slots) {}

  Result<void> refine() {
    // Everything is read before anything is overwritten: parts may share accessors.
    for (const Part& part : scene_.parts.parts)
      if (auto ok = mix(part); !ok) return ok;
    for (auto& [place, value] : values_)
      value.accessor = slots_.put(std::get<1>(place), value.column, Use::vertices);
    for (std::size_t p = 0; p < scene_.parts.parts.size(); ++p) rewrite(p);
    return {};
  }

 private:
  /// Run, accessor, and the set of joints and weights that it is part of, or 0 if it is in none.
  using Place = std::tuple<std::size_t, std::size_t, std::size_t>;
  struct Value {
    Column column;
    std::size_t accessor = 0;  // where it is now
  };

  Result<void> mix(const Part& part) {
    Json& primitive = primitiveOf(scene_.document, scene_.parts, part);
    const auto set = mixSkin(part.run, primitive["attributes"]);
    if (!set) return std::unexpected(set.error());
    firstSets_.push_back(*set);
    if (auto ok = mixAll(part.run, primitive["attributes"]); !ok) return ok;
    if (Json* const targets = find(primitive, "targets"))
      for (Json& target : *targets) {
        eraseSkin(target);  // morph targets have none, whatever a file says
        if (auto ok = mixAll(part.run, target); !ok) return ok;
      }
    return {};
  }

  static void eraseSkin(Json& attributes, const std::set<std::string>& except = {}) {
    const Json before = attributes;
    for (const auto& [name, number] : before.items())
      if (isSkin(name) && !except.contains(name)) attributes.erase(name);
  }

  Result<void> mixAll(std::size_t run, Json& attributes) {
    const Json before = attributes;  // some are erased on the way
    for (const auto& [name, number] : before.items()) {
      if (isSkin(name) || name == "POSITION" || name == "NORMAL") continue;
      const auto accessor = accessorAt(scene_.document, number.get<std::size_t>());
      if (!accessor) return std::unexpected(accessor.error());
      if (isGeometry(name) || accessor->columns > 1) {
        attributes.erase(name);
        continue;
      }
      const auto [value, isNew] = values_.try_emplace(Place{run, accessor->index, 0});
      if (!isNew) continue;
      const auto meaning = name.starts_with("TEXCOORD_") ? Meaning::texcoord : Meaning::other;
      auto column = mixed(scene_.document, *accessor, meaning, mesh_.runs[run].places);
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

  /// The sets of joints and weights, from 0 on; attributes that are not in pairs are erased.
  Result<SkinAttributes> takeSkin(Json& attributes) const {
    SkinAttributes skin;
    std::set<std::string> paired;
    const std::size_t accessors = scene_.document.list("accessors").size();
    for (const auto& [joints, weights] : jointSets(attributes, accessors)) {
      for (const std::string_view kind : {"JOINTS", "WEIGHTS"})
        paired.insert(fmt::format("{}_{}", kind, skin.joints.size()));
      for (const auto& [index, list] :
           {std::pair{joints, &skin.joints}, std::pair{weights, &skin.weights}}) {
        const auto accessor = accessorAt(scene_.document, index);
        if (!accessor) return std::unexpected(accessor.error());
        if (accessor->components() != 4)
          return fail("A mesh of the face's scene has joints that are not in fours.");
        list->push_back(*accessor);
      }
    }
    eraseSkin(attributes, paired);
    return skin;
  }

  /// Returns the number of the first set. Joints give other values when mixed with other weights.
  Result<std::size_t> mixSkin(std::size_t run, Json& attributes) {
    const auto skin = takeSkin(attributes);
    if (!skin) return std::unexpected(skin.error());
    std::vector<std::size_t> key{run};
    for (const auto* list : {&skin->joints, &skin->weights})
      for (const Accessor& accessor : *list) key.push_back(accessor.index);
    const auto [known, isNew] = skins_.try_emplace(std::move(key), sets_ + 1);
    const std::size_t first = known->second;
    if (!isNew || skin->joints.empty()) return first;
    auto columns = mixedSkin(scene_.document, *skin, mesh_.runs[run].places);
    if (!columns) return std::unexpected(columns.error());
    for (std::size_t s = 0; s < skin->joints.size(); ++s) {
      values_[{run, skin->joints[s].index, first + s}].column = std::move(columns->joints[s]);
      values_[{run, skin->weights[s].index, first + s}].column = std::move(columns->weights[s]);
    }
    sets_ += skin->joints.size();
    return first;
  }

  void rewrite(std::size_t number) {
    const Part& part = scene_.parts.parts[number];
    Json& primitive = primitiveOf(scene_.document, scene_.parts, part);
    const auto indices = findIndex(primitive, "indices", scene_.document.list("accessors").size());
    primitive["indices"] = slots_.put(indices, packIndices(mesh_.triangles[number]), Use::indices);
    primitive.erase("mode");
    point(part.run, primitive["attributes"]);
    pointSkin(part.run, firstSets_[number], primitive["attributes"]);
    if (Json* const targets = find(primitive, "targets"))
      for (Json& target : *targets) point(part.run, target);
    if (Json* const extensions = find(primitive, "extensions");
        extensions && extensions->is_object()) {
      const Json before = *extensions;
      for (const auto& [name, value] : before.items())
        if (countsOnOrder(name)) extensions->erase(name);
      if (extensions->empty()) primitive.erase("extensions");
    }
  }

  /// Makes attributes name the accessors that hold their new values.
  void point(std::size_t run, Json& attributes) {
    for (auto& [name, number] : attributes.items()) {
      if (isSkin(name)) continue;
      const auto value = values_.find({run, number.get<std::size_t>(), 0});
      if (value != values_.end()) number = value->second.accessor;
    }
  }
  void pointSkin(std::size_t run, std::size_t firstSet, Json& attributes) {
    for (std::size_t s = 0;; ++s)
      for (const char* kind : {"JOINTS", "WEIGHTS"}) {
        Json* const number = find(attributes, fmt::format("{}_{}", kind, s));
        if (!number) return;
        *number = values_.at({run, number->get<std::size_t>(), firstSet + s}).accessor;
      }
  }

  BoundScene& scene_;
  const FineMesh& mesh_;
  Slots& slots_;
  std::map<Place, Value> values_;
  std::map<std::vector<std::size_t>, std::size_t> skins_;  // run, accessors: their first set
  std::vector<std::size_t> firstSets_;                     // [parts]
  std::size_t sets_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace

Result<void> refine(BoundScene& scene, const FineMesh& mesh, Slots& slots) {
  return Refiner(scene, mesh, slots).refine();
}

}  // namespace sweepface::gltf
