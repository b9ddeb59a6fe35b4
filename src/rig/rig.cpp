#include "sweepface/rig.hpp"

#include <algorithm>
#include <utility>

#include "rig/number.hpp"

namespace sweepface {

Weights Rig::weightsOf(Index pose) const {
  Weights weights(targets.size(), 0.0);
  if (pose > 0) weights[pose - 1] = 1;
  return weights;
}

bool Rig::knows(const Target& target) const {
  return target.difference.size() == neutral.size() &&
         target.looseDifference.size() == source.loose.size();
}

bool Rig::knowsTargets() const {
  return std::ranges::all_of(targets, [&](const Target& target) { return knows(target); });
}

Index Rig::find(std::string_view name) const {
  for (std::size_t k = 0; k < targets.size(); ++k)
    if (targets[k].name == name) return static_cast<Index>(k);
  return -1;
}

namespace {

std::string listNames(const Rig& rig, std::size_t count) {
  if (count == 0) return "this face has no targets.";
  constexpr std::size_t most = 60;
  std::string list = "its targets are ";
  for (std::size_t k = 0; k < std::min(count, most); ++k)
    list += (k ? ", " : "") + rig.targets[k].name;
  return list + (count > most ? ", ..." : ".");
}

}  // namespace

Result<Index> findTarget(const Rig& rig, std::string_view name, std::size_t count) {
  const Index target = rig.find(name);
  if (target >= 0 && static_cast<std::size_t>(target) < count) return target;
  return failCall("There is no target named '", name, "'; ", listNames(rig, count));
}

Result<Index> findTarget(const Rig& rig, std::string_view name) {
  return findTarget(rig, name, rig.targets.size());
}

Result<Weights> parseWeights(const Rig& rig, std::string_view text) {
  Weights weights(rig.targets.size(), 0.0);
  std::vector<char> isTold(rig.targets.size(), 0);
  while (!text.empty()) {
    const std::string_view item = takeItem(text);
    if (item.empty()) continue;
    const auto equals = item.rfind('=');
    const std::string_view name = trimmed(item.substr(0, equals));
    const Result<Index> target = findTarget(rig, name);
    if (!target) return std::unexpected(target.error());
    if (std::exchange(isTold[*target], 1))
      return failCall("The weight of '", name, "' is told twice; tell it once.");
    double value = 1;
    if (equals != std::string_view::npos) {
      const std::string_view digits = trimmed(item.substr(equals + 1));
      const std::optional<double> number = numberOf(digits);
      if (!number || !isPlausibleWeight(*number))
        return failCall("The weight of '", name, "' must be a number within ±1,000,000, not '",
                        digits, "'.");
      value = *number;
    }
    weights[*target] = value;
  }
  return weights;
}

std::vector<std::string> Rig::targetNames() const {
  std::vector<std::string> all;
  for (const Target& target : targets) all.push_back(target.name);
  return all;
}

void blend(const Rig& rig, std::span<const double> weights, std::span<Vec3> vectors) {
  const std::size_t stored = rig.neutral.size();
  for (std::size_t v = 0; v < stored; ++v) vectors[v] = rig.neutral[v];
  for (std::size_t k = 0; k < rig.targets.size() && k < weights.size(); ++k) {
    const auto& difference = rig.targets[k].difference;
    if (weights[k] == 0 || difference.empty()) continue;
    for (std::size_t v = 0; v < stored; ++v) vectors[v] += weights[k] * difference[v];
  }
  rig.surface.settle(vectors.first(stored), vectors);
}

std::vector<Vec3> blend(const Rig& rig, std::span<const double> weights) {
  std::vector<Vec3> vectors(rig.surface.vectorCount());
  blend(rig, weights, vectors);
  return vectors;
}

void blendLoose(const Rig& rig, std::span<const double> weights, std::span<Vec3> loose) {
  std::ranges::copy(rig.source.loose, loose.begin());
  for (std::size_t k = 0; k < rig.targets.size() && k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    for (std::size_t v = 0; v < loose.size(); ++v)
      loose[v] += weights[k] * rig.targets[k].looseDifference[v];
  }
}

std::vector<Vec3> blendLoose(const Rig& rig, std::span<const double> weights) {
  std::vector<Vec3> loose(rig.source.loose.size());
  blendLoose(rig, weights, loose);
  return loose;
}

}  // namespace sweepface
