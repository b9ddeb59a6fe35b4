#include "gltf/more_targets.hpp"

#include <map>
#include <set>
#include <string_view>

#include "gltf/builder.hpp"
#include "gltf/moved_weights.hpp"

namespace sweepface::gltf {
namespace {

class TargetAdder {
 public:
  TargetAdder(Document& document, const Parts& parts, const std::vector<std::string>& names)
      : document_(document), json_(document.json), parts_(parts), names_(names) {}

  Result<void> add() {
    for (const RigMesh& mesh : parts_.meshes) {
      if (mesh.targets.empty() && !parts_.targets.empty()) continue;
      meshes_[mesh.mesh] = mesh.targets.size();
      name(mesh);
    }
    for (const Part& part : parts_.parts) widen(part);
    if (auto ok = widenOthers(); !ok) return ok;
    for (const auto& [mesh, before] : meshes_) widenWeights(json_["meshes"][mesh], before);
    if (json_.contains("nodes"))
      for (Json& node : json_["nodes"])
        if (const auto mesh = meshOf(node); mesh && node.contains("weights"))
          widenWeights(node, meshes_[*mesh]);
    return widenAnimations();
  }

 private:
  std::optional<std::size_t> meshOf(const Json& node) const {
    const auto mesh = findIndex(node, "mesh", document_.list("meshes").size());
    return mesh && meshes_.contains(*mesh) ? mesh : std::nullopt;
  }

  void name(const RigMesh& mesh) {
    Json list = Json::array();
    for (const std::size_t t : mesh.targets) list.push_back(parts_.targets[t]);
    for (const std::string& name : names_) list.push_back(name);
    Json& extras = json_["meshes"][mesh.mesh]["extras"];
    if (!extras.is_object()) extras = Json::object();
    extras["targetNames"] = std::move(list);
  }

  /// Primitives that shared their vertices keep sharing them.
  void widen(const Part& part) {
    const Run& run = parts_.runs[part.run];
    const std::size_t mesh = meshOf(part);
    if (!meshes_.contains(mesh)) return;
    Json& targets = json_["meshes"][mesh]["primitives"][part.primitive]["targets"];
    if (!targets.is_array()) targets = Json::array();
    for (std::size_t k = 0; k < names_.size(); ++k) {
      const auto [hollow, isNew] = hollows_.try_emplace({part.run, k});
      if (isNew) hollow->second = addHollow(run.count);
      targets.push_back({{"POSITION", hollow->second}});
    }
  }

  std::size_t meshOf(const Part& part) const {
    return parts_.meshes[parts_.runs[part.run].rigMesh].mesh;
  }

  /// All primitives of a mesh must have the same number of targets: points and lines get some that
  /// move nothing.
  Result<void> widenOthers() {
    std::set<std::pair<std::size_t, std::size_t>> ofParts;
    for (const Part& part : parts_.parts) ofParts.emplace(meshOf(part), part.primitive);
    for (const auto& [mesh, unused] : meshes_) {
      Json& primitives = json_["meshes"][mesh]["primitives"];
      for (std::size_t p = 0; p < primitives.size(); ++p)
        if (!ofParts.contains({mesh, p}))
          if (auto ok = widenOther(primitives[p]); !ok) return ok;
    }
    return {};
  }

  Result<void> widenOther(Json& primitive) {
    const Json* const attributes = find(primitive, "attributes");
    const auto position =
        attributes ? findIndex(*attributes, "POSITION", document_.list("accessors").size())
                   : std::nullopt;
    if (listOf(primitive, "targets").empty() || !position) return {};
    const auto accessor = accessorAt(document_, *position);
    if (!accessor) return std::unexpected(accessor.error());
    const std::size_t hollow = addHollow(accessor->count);
    for (std::size_t k = 0; k < names_.size(); ++k)
      primitive["targets"].push_back({{"POSITION", hollow}});
    return {};
  }

  /// An accessor of vectors that are all zero.
  std::size_t addHollow(std::size_t count) {
    Json& accessors = json_["accessors"];
    accessors.push_back({{"componentType", static_cast<int>(Component::float32)},
                         {"count", count},
                         {"type", "VEC3"},
                         {"min", {0, 0, 0}},
                         {"max", {0, 0, 0}}});
    return accessors.size() - 1;
  }

  void widenWeights(Json& holder, std::size_t before) const {
    Json& weights = holder["weights"];
    if (!weights.is_array()) weights = Json::array();
    while (weights.size() > before) weights.erase(weights.size() - 1);  // of missing targets
    while (weights.size() < before + names_.size()) weights.push_back(0.0);
  }

  Result<void> widenAnimations() {
    if (!json_.contains("animations")) return {};
    Builder builder(document_);
    Widened outputs;
    for (Json& animation : json_["animations"])
      if (isList(animation, "channels") && isList(animation, "samplers")) {
        Widened wide;
        for (Json& channel : animation["channels"])
          if (auto ok = widenChannel(animation["samplers"], wide, channel, outputs, builder); !ok)
            return ok;
      }
    builder.finish();
    return {};
  }

  static bool isList(const Json& holder, const char* key) {
    const Json* const list = find(holder, key);
    return list && list->is_array();
  }

  /// The mesh all of whose weights a channel moves.
  std::optional<std::size_t> meshMovedBy(const Json& target) const {
    const auto moved = movedWeights(document_, target);
    if (!moved) return std::nullopt;
    if (moved->ofNode) return meshOf(document_.list("nodes")[moved->number]);
    return meshes_.contains(moved->number) ? std::optional(moved->number) : std::nullopt;
  }

  /// Keyed by the sampler of an animation, or the accessor, and by how many targets there were.
  using Widened = std::map<std::pair<std::size_t, std::size_t>, std::size_t>;

  Result<void> widenChannel(Json& samplers, Widened& known, Json& channel, Widened& outputs,
                            Builder& builder) {
    const Json* const target = find(channel, "target");
    const auto mesh = target ? meshMovedBy(*target) : std::nullopt;
    const auto sampler = findIndex(channel, "sampler", samplers.size());
    if (!mesh || !sampler || !samplers[*sampler].is_object()) return {};
    // Weights of no targets hold nothing worth keeping.
    const std::size_t before = meshes_.at(*mesh);
    if (before == 0) return {};
    // The old sampler keeps its width, as another node may use it.
    Json wide = samplers[*sampler];
    const auto output = findIndex(wide, "output", document_.list("accessors").size());
    if (!output) return {};
    const auto [own, isNew] = known.try_emplace({*sampler, before}, samplers.size());
    channel["sampler"] = own->second;
    if (!isNew) return {};
    const auto [place, isFirst] = outputs.try_emplace({*output, before}, 0);
    if (isFirst) {
      const auto accessor = accessorAt(document_, *output);
      if (!accessor) return std::unexpected(accessor.error());
      const auto values = decode(document_, *accessor);
      if (!values) return std::unexpected(values.error());
      place->second = builder.add(pack(widened(*values, before), 1), Use::other);
    }
    wide["output"] = place->second;
    samplers.push_back(std::move(wide));
    return {};
  }

  std::vector<double> widened(const std::vector<double>& values, std::size_t before) const {
    std::vector<double> wide;
    for (std::size_t k = 0; k + before <= values.size(); k += before) {
      wide.insert(wide.end(), values.begin() + static_cast<std::ptrdiff_t>(k),
                  values.begin() + static_cast<std::ptrdiff_t>(k + before));
      wide.insert(wide.end(), names_.size(), 0.0);
    }
    return wide;
  }

  Document& document_;
  Json& json_;
  const Parts& parts_;
  const std::vector<std::string>& names_;
  std::map<std::size_t, std::size_t> meshes_;  // mesh: how many targets it had
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> hollows_;  // by run and name
};

}  // namespace

Result<void> addTargets(Document& document, const Parts& parts,
                        const std::vector<std::string>& names) {
  return TargetAdder(document, parts, names).add();
}

}  // namespace sweepface::gltf
