// Stores skin weights in 16 bits.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "sweepface/gltf.hpp"

#include "gltf/accessor.hpp"
#include "gltf/accessor_uses.hpp"
#include "gltf/binary.hpp"
#include "gltf/scene.hpp"

namespace sweepface {
namespace gltf {
namespace {

constexpr int kUint16 = static_cast<int>(Component::uint16);
constexpr double kOne = 65535;

/// The accessors of WEIGHTS_0, WEIGHTS_1 ... of a primitive, which together sum to one at each
/// vertex, and of JOINTS_0, JOINTS_1 ...
struct Binding {
  std::vector<std::size_t> weights, joints;
  friend auto operator<=>(const Binding&, const Binding&) = default;
};

Binding bindingOf(const Json& primitive, std::size_t accessors) {
  Binding binding;
  const Json* const attributes = find(primitive, "attributes");
  if (!attributes || !attributes->is_object()) return binding;
  for (const auto& [name, reference] : attributes->items()) {
    if (!name.starts_with("WEIGHTS_")) continue;
    const std::string joints = "JOINTS_" + name.substr(8);
    if (const auto index = asIndex(reference, accessors)) binding.weights.push_back(*index);
    if (const auto index = findIndex(*attributes, joints, accessors))
      binding.joints.push_back(*index);
  }
  return binding;
}

/// Rounds the weights of a vertex and their sum: the largest weight takes the remainder. False if
/// that makes it no valid weight.
bool roundTogether(std::span<double> weights) {
  double sum = 0, rounded = 0;
  for (double& w : weights) {
    sum += w;
    w = std::round(w * kOne);
    rounded += w;
  }
  double& largest = *std::ranges::max_element(weights);
  largest += std::min(std::round(sum * kOne), kOne) - rounded;
  return largest >= 0 && largest <= kOne;
}

class WeightRounder {
 public:
  explicit WeightRounder(Document& document)
      : document_(document), touched_(document.views.size()) {}

  /// Returns whether anything changed.
  bool run() {
    std::map<std::vector<std::size_t>, std::size_t> uses;
    std::map<Binding, std::size_t> bindings;
    for (const Json& mesh : document_.list("meshes"))
      for (const Json& primitive : listOf(mesh, "primitives")) {
        const Binding binding = bindingOf(primitive, document_.list("accessors").size());
        ++uses[binding.weights];
        ++bindings[binding];
      }
    const std::vector<std::size_t> all = accessorUseCounts(document_);
    const auto areOwn = [&](const std::vector<std::size_t>& accessors, std::size_t count) {
      return std::ranges::all_of(accessors, [&](std::size_t a) { return all[a] == count; });
    };
    std::map<std::vector<std::size_t>, std::vector<std::vector<double>>> weights;
    for (const auto& [sets, count] : uses) {
      if (!areOwn(sets, count)) continue;
      const auto& values = weights[sets] = rounded(sets);
      for (std::size_t k = 0; k < values.size(); ++k) replace(sets[k], values[k], kUint16, true);
    }
    for (const auto& [binding, count] : bindings) {
      const auto& [sets, joints] = binding;
      const auto& values = weights[sets];
      if (values.size() == joints.size() && areOwn(joints, count))
        for (std::size_t k = 0; k < values.size(); ++k) letGo(joints[k], values[k]);
    }
    return isChanged_;
  }

  std::vector<bool> touched() {
    touched_.resize(document_.views.size());
    return touched_;
  }

 private:
  /// Four plain numbers per vertex, or nothing.
  std::vector<double> plain(std::size_t index, std::initializer_list<Component> types) const {
    const auto accessor = accessorAt(document_, index);
    const bool isPlain = accessor && std::ranges::find(types, accessor->type) != types.end() &&
                         accessor->view && !accessor->sparse && accessor->rows == 4 &&
                         accessor->columns == 1;
    return isPlain ? decode(document_, *accessor).value_or(std::vector<double>{})
                   : std::vector<double>{};
  }

  /// The weights of each accessor, in 65535ths; nothing if they stay as they are.
  std::vector<std::vector<double>> rounded(const std::vector<std::size_t>& sets) const {
    std::vector<std::vector<double>> values;
    for (const std::size_t a : sets) {
      values.push_back(plain(a, {Component::float32}));
      const auto isWeight = [](double w) { return w >= 0 && w <= 1; };
      if (values.back().empty() || !std::ranges::all_of(values.back(), isWeight)) return {};
      if (values.back().size() != values.front().size()) return {};
    }
    if (values.empty()) return {};
    std::vector<double> vertex(4 * sets.size());
    for (std::size_t at = 0; at < values.front().size(); at += 4) {
      for (std::size_t k = 0; k < vertex.size(); ++k) vertex[k] = values[k / 4][at + k % 4];
      // Weights that do not sum to one have a meaning of their own.
      if (std::abs(std::accumulate(vertex.begin(), vertex.end(), 0.0) - 1) > 0.01) return {};
      if (!roundTogether(vertex)) return {};
      for (std::size_t k = 0; k < vertex.size(); ++k) values[k / 4][at + k % 4] = vertex[k];
    }
    return values;
  }

  /// Makes joints that move nothing joint 0.
  void letGo(std::size_t joints, const std::vector<double>& weights) {
    std::vector<double> values = plain(joints, {Component::uint8, Component::uint16});
    Json& json = document_.json["accessors"][joints];
    if (values.size() != weights.size() || json.value("normalized", Json()) == true) return;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (weights[k] == 0) values[k] = 0;
    replace(joints, values, json["componentType"], false);
  }

  void replace(std::size_t accessor, const std::vector<double>& values, int type, bool normalized) {
    std::string bytes;
    for (const double value : values) {
      const auto whole = static_cast<unsigned>(value);
      bytes += static_cast<char>(whole & 0xff);
      if (type == kUint16) bytes += static_cast<char>(whole >> 8);
    }
    Json& json = document_.json["accessors"][accessor];
    touched_[*asIndex(json["bufferView"], touched_.size())] = true;
    for (const char* key : {"byteOffset", "min", "max"}) json.erase(key);
    json["componentType"] = type;
    if (normalized) json["normalized"] = true;
    json["bufferView"] = document_.addBuffer(std::move(bytes));
    isChanged_ = true;
  }

  Document& document_;
  std::vector<bool> touched_;
  bool isChanged_ = false;
};

}  // namespace
}  // namespace gltf

std::string packedScene(std::string scene) {
  auto document = gltf::parseScene(scene);
  if (!document) return scene;
  gltf::WeightRounder rounder(*document);
  if (!rounder.run()) return scene;
  const std::string binary = gltf::gatherBinary(*document, rounder.touched());
  return gltf::formatScene(gltf::formatContainer(document->json, binary));
}

}  // namespace sweepface
