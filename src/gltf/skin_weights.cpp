// Weights of skins in 16 bits.
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

constexpr int kUint16 = 5123;
constexpr double kOne = 65535;

/// The accessors of WEIGHTS_0, WEIGHTS_1 ... of a primitive: those of a vertex sum to one together.
using WeightSets = std::vector<std::size_t>;

WeightSets weightSetsOf(const Json& primitive, std::size_t accessors) {
  WeightSets sets;
  const Json* const attributes = find(primitive, "attributes");
  if (!attributes || !attributes->is_object()) return sets;
  for (const auto& [name, reference] : attributes->items())
    if (name.starts_with("WEIGHTS_"))
      if (const auto index = asIndex(reference, accessors)) sets.push_back(*index);
  return sets;
}

/// Rounds the weights of a vertex so that their sum is rounded, too: the largest takes what the
/// others leave.
void roundTogether(std::span<double> weights) {
  double sum = 0, rounded = 0;
  for (double& w : weights) {
    sum += w;
    w = std::round(w * kOne);
    rounded += w;
  }
  *std::ranges::max_element(weights) += std::min(std::round(sum * kOne), kOne) - rounded;
}

class WeightRounder {
 public:
  explicit WeightRounder(Document& document)
      : document_(document), touched_(document.views.size()) {}

  /// Whether anything changes.
  bool run() {
    std::map<WeightSets, std::size_t> uses;
    for (const Json& mesh : document_.list("meshes"))
      for (const Json& primitive : listOf(mesh, "primitives"))
        ++uses[weightSetsOf(primitive, document_.list("accessors").size())];
    const std::vector<std::size_t> all = accessorUseCounts(document_);
    for (const auto& [sets, count] : uses)
      if (std::ranges::all_of(sets, [&](std::size_t a) { return all[a] == count; })) round(sets);
    return isChanged_;
  }

  std::vector<bool> touched() {
    touched_.resize(document_.views.size());
    return touched_;
  }

 private:
  void round(const WeightSets& sets) {
    std::vector<std::vector<double>> values;
    for (const std::size_t a : sets) {
      const auto accessor = accessorAt(document_, a);
      const bool isPlain = accessor && accessor->type == Component::float32 && accessor->view &&
                           !accessor->sparse && accessor->rows == 4 && accessor->columns == 1;
      auto decoded = isPlain ? decode(document_, *accessor) : std::vector<double>{};
      const auto isWeight = [](double w) { return w >= 0 && w <= 1; };
      if (!decoded || decoded->empty() || !std::ranges::all_of(*decoded, isWeight)) return;
      if (!values.empty() && decoded->size() != values.front().size()) return;
      values.push_back(std::move(*decoded));
    }
    if (values.empty()) return;
    std::vector<double> vertex(4 * sets.size());
    for (std::size_t at = 0; at < values.front().size(); at += 4) {
      for (std::size_t k = 0; k < vertex.size(); ++k) vertex[k] = values[k / 4][at + k % 4];
      // Weights that are no shares are somebody's own.
      if (std::abs(std::accumulate(vertex.begin(), vertex.end(), 0.0) - 1) > 0.01) return;
      roundTogether(vertex);
      for (std::size_t k = 0; k < vertex.size(); ++k) values[k / 4][at + k % 4] = vertex[k];
    }
    for (std::size_t k = 0; k < sets.size(); ++k) replace(sets[k], values[k]);
  }

  void replace(std::size_t accessor, const std::vector<double>& values) {
    std::string bytes;
    for (const double value : values) {
      const auto whole = static_cast<unsigned>(value);
      bytes += {static_cast<char>(whole & 0xff), static_cast<char>(whole >> 8)};
    }
    Json& json = document_.json["accessors"][accessor];
    touched_[*asIndex(json["bufferView"], touched_.size())] = true;
    for (const char* key : {"byteOffset", "min", "max"}) json.erase(key);
    json["componentType"] = kUint16;
    json["normalized"] = true;
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
