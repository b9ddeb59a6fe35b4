#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

#include "gltf/fine_mesh.hpp"
#include "gltf/homes.hpp"
#include "gltf/same_vertices.hpp"
#include "gltf/skins.hpp"

namespace sweepface::gltf {
namespace {

bool isSkin(std::string_view name) {
  return name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
}

bool isTexcoord(std::string_view name) { return name.starts_with("TEXCOORD_"); }

class Refiner {
 public:
  Refiner(BoundScene& scene, const FineMesh& mesh, Slots& slots)
      : scene_(scene), mesh_(mesh), slots_(slots), homes_(scene.parts, mesh) {
    firstParts_.resize(scene.parts.runs.size());
    for (std::size_t p = scene.parts.parts.size(); p-- > 0;)
      firstParts_[scene.parts.parts[p].run] = p;
  }

  Result<void> refine() {
    // Everything is read before anything is overwritten: parts may share accessors.
    for (const Part& part : scene_.parts.parts)
      if (auto ok = mix(part); !ok) return ok;
    for (std::size_t p = 0; p < scene_.parts.parts.size(); ++p) bringHome(p);
    for (auto& [place, value] : values_)
      value.accessor = slots_.put(std::get<1>(place), value.column, Use::vertices);
    for (std::size_t p = 0; p < scene_.parts.parts.size(); ++p) rewrite(p);
    return {};
  }

 private:
  /// Run, accessor, and what it is there: texture coordinates, part of a set of joints and weights
  /// (numbered from kOther on), or something else.
  using Place = std::tuple<std::size_t, std::size_t, std::size_t>;
  static constexpr std::size_t kTexcoord = 0, kOther = 1;
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
      const auto meaning = isTexcoord(name) ? Meaning::texcoord : Meaning::other;
      const auto [value, isNew] = values_.try_emplace(Place{run, accessor->index, kindOf(name)});
      if (!isNew) continue;
      auto column = mixed(scene_.document, *accessor, meaning, mesh_.runs[run].places);
      if (!column) return std::unexpected(column.error());
      bytes_ += column->bytes.size();
      if (bytes_ > mostBytes) return tooLargeForGlb();
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

  static std::size_t kindOf(std::string_view name) { return isTexcoord(name) ? kTexcoord : kOther; }

  /// Gives vertices that triangles see beyond a seam what they have at home, so that all copies of
  /// one are bound and coloured alike. Texture coordinates alone go on beyond seams.
  void bringHome(std::size_t number) {
    const std::size_t run = scene_.parts.parts[number].run;
    std::map<std::size_t, std::vector<Pair>> pairs;  // by the run of the home
    for (const Index stranger : homes_.strangers(run)) {
      const Home home = homes_.of(run, stranger);
      const auto [known, isNew] = pairs.try_emplace(home.run);
      if (isNew) known->second = pairsOf(number, home.run == run ? number : firstParts_[home.run]);
      for (const auto& [to, from] : known->second) {
        const std::size_t size = to->elementSize();
        to->bytes.replace(size * static_cast<std::size_t>(stranger), size, from->bytes,
                          size * static_cast<std::size_t>(home.vertex), size);
      }
    }
  }

  struct Pair {
    Column* to;
    const Column* from;
  };
  /// The columns of one part that another part has, too, in the same type. Joints and weights only
  /// if it has all of them.
  std::vector<Pair> pairsOf(std::size_t part, std::size_t other) {
    std::vector<Pair> pairs, skin;
    bool sharesSkin = skinSize(part) == skinSize(other);
    for (std::size_t h = 0, count = std::min(holderCount(part), holderCount(other)); h < count; ++h)
      for (const auto& [name, index] : holderAt(part, h).items()) {
        Column* const to = isTexcoord(name) ? nullptr : columnOf(part, h, name);
        if (!to) continue;
        const Column* const from = columnOf(other, h, name);
        const bool agrees = from && from->type == to->type && from->width == to->width &&
                            from->normalized == to->normalized;
        if (agrees) (isSkin(name) ? skin : pairs).push_back({to, from});
        if (isSkin(name)) sharesSkin = sharesSkin && agrees;
      }
    if (sharesSkin) pairs.insert(pairs.end(), skin.begin(), skin.end());
    return pairs;
  }

  std::size_t skinSize(std::size_t part) const {
    const auto& attributes = holderAt(part, 0).items();
    return static_cast<std::size_t>(
        std::count_if(attributes.begin(), attributes.end(),
                      [](const auto& attribute) { return isSkin(attribute.key()); }));
  }

  // What has attributes: the primitive itself, then its targets.
  const Json& primitiveAt(std::size_t part) const {
    return primitiveOf(scene_.document, scene_.parts, scene_.parts.parts[part]);
  }
  std::size_t holderCount(std::size_t part) const {
    return 1 + listOf(primitiveAt(part), "targets").size();
  }
  const Json& holderAt(std::size_t part, std::size_t holder) const {
    return holder == 0 ? *find(primitiveAt(part), "attributes")
                       : listOf(primitiveAt(part), "targets")[holder - 1];
  }
  /// The column of an attribute, if it has one here.
  Column* columnOf(std::size_t part, std::size_t holder, const std::string& name) {
    const Json* const index = find(holderAt(part, holder), name);
    if (!index) return nullptr;
    const std::size_t kind = isSkin(name)
                                 ? firstSets_[part] + std::stoul(name.substr(name.find('_') + 1))
                                 : kindOf(name);
    const auto value =
        values_.find({scene_.parts.parts[part].run, index->get<std::size_t>(), kind});
    return value == values_.end() ? nullptr : &value->second.column;
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
      const auto value = values_.find({run, number.get<std::size_t>(), kindOf(name)});
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
  std::vector<std::size_t> firstParts_;                    // [runs] the first part of each
  std::size_t sets_ = kOther;
  Homes homes_;
  std::size_t bytes_ = 0;
};

}  // namespace

Result<void> refine(BoundScene& scene, const FineMesh& mesh, Slots& slots) {
  return Refiner(scene, mesh, slots).refine();
}

}  // namespace sweepface::gltf
