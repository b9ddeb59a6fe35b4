#include "sweepface/rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sweepface {

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
  if (count == 0) return "this face has no targets";
  std::string list = "its targets are ";
  for (std::size_t k = 0; k < count; ++k) list += (k ? ", " : "") + rig.targets[k].name;
  return list;
}

}  // namespace

Result<Index> findTarget(const Rig& rig, std::string_view name, std::size_t count) {
  const Index target = rig.find(name);
  if (target >= 0 && static_cast<std::size_t>(target) < count) return target;
  return failCall("there is no target named '", name, "'; ", listNames(rig, count));
}

Result<Index> findTarget(const Rig& rig, std::string_view name) {
  return findTarget(rig, name, rig.targets.size());
}

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == text.npos ? "" : text.substr(first, last + 1 - first);
}

}  // namespace

Result<Weights> parseWeights(const Rig& rig, std::string_view text) {
  Weights weights(rig.targets.size(), 0.0);
  while (!text.empty()) {
    const auto comma = text.find(',');
    const std::string_view item = trimmed(text.substr(0, comma));
    text = comma == std::string_view::npos ? "" : text.substr(comma + 1);
    if (item.empty()) continue;
    const auto equals = item.rfind('=');
    const std::string_view name = trimmed(item.substr(0, equals));
    const Result<Index> target = findTarget(rig, name);
    if (!target) return std::unexpected(target.error());
    double value = 1;
    if (equals != std::string_view::npos) {
      const std::string digits(trimmed(item.substr(equals + 1)));
      char* end = nullptr;  // not from_chars: libc++ 19 has none for floating point
      value = std::strtod(digits.c_str(), &end);
      const bool plain =
          digits.find_first_not_of("0123456789+-.eE") == std::string::npos && digits[0] != '+';
      if (digits.empty() || !plain || *end != 0 || !isPlausibleWeight(value))
        return failCall("the weight of '", name, "' must be a number within ±1,000,000, not '",
                        digits, "'");
    }
    weights[*target] = value;
  }
  return weights;
}

void blend(const Rig& rig, std::span<const double> weights, std::span<Vec3> vectors) {
  const std::size_t stored = rig.neutral.size();
  for (std::size_t v = 0; v < stored; ++v) vectors[v] = rig.neutral[v];
  for (std::size_t k = 0; k < rig.targets.size() && k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    const auto& difference = rig.targets[k].difference;
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
  for (std::size_t k = 0; k < rig.targets.size() && k < weights.size(); ++k)
    for (std::size_t v = 0; v < loose.size(); ++v)
      loose[v] += weights[k] * rig.targets[k].looseDifference[v];
}

std::vector<Vec3> blendLoose(const Rig& rig, std::span<const double> weights) {
  std::vector<Vec3> loose(rig.source.loose.size());
  blendLoose(rig, weights, loose);
  return loose;
}

}  // namespace sweepface
