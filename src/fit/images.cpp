#include "fit/images.hpp"

#include <array>
#include <string_view>

namespace sweepface {

namespace {

using codec::Coefficients;

// About how many bits coefficients take if others are expected.
double bitsOf(const Coefficients& q, const Coefficients& expected) {
  double sum = 0;
  for (std::size_t v = 0; v < q.size(); ++v) sum += codec::bitsOf(q[v], expected[v]);
  return sum;
}

}  // namespace

std::string otherSide(std::string name) {
  constexpr std::array<std::array<std::string_view, 2>, 6> kSides{{{"Left", "Right"},
                                                                   {"Right", "Left"},
                                                                   {"left", "right"},
                                                                   {"right", "left"},
                                                                   {"LEFT", "RIGHT"},
                                                                   {"RIGHT", "LEFT"}}};
  std::size_t first = std::string::npos;
  std::array<std::string_view, 2> side;
  for (const auto& words : kSides)
    if (const std::size_t at = name.find(words[0]); at < first) first = at, side = words;
  if (first < name.size()) return name.replace(first, side[0].size(), side[1]);
  const std::size_t size = name.size();
  if (size < 2 || std::string_view("_.- ").find(name[size - 2]) == std::string_view::npos)
    return name;
  constexpr std::string_view kLetters = "LRlr", kOthers = "RLrl";
  if (const auto letter = kLetters.find(name.back()); letter != std::string_view::npos)
    name.back() = kOthers[letter];
  return name;
}

void chooseImages(const Rig& rig, const codec::Lattice& lattice, Packing& packing) {
  const auto poses = static_cast<Index>(rig.targets.size()) + 1;
  packing.poses.resize(poses);
  if (packing.mirror.empty()) return;
  const auto coefficients = [&](Index pose) {
    return lattice.round(pose, rig.vectorsOf(pose),
                         pose == 0 ? packing.neutralStep : packing.targetStep);
  };
  for (Index pose = 0; pose < poses; ++pose) {
    const Coefficients own = coefficients(pose);
    double least = 0.9 * bitsOf(own, Coefficients(own.size()));
    Index& image = packing.poses[pose].image;
    image = -1;
    // Its own image predicts only the second half.
    if (const double s = 0.5 * least + 0.5 * bitsOf(own, lattice.image(own)); s < least)
      least = s, image = pose;
    if (pose == 0) continue;
    const Index other = rig.find(otherSide(rig.targets[pose - 1].name)) + 1;
    if (other < 1 || other >= pose) continue;
    if (bitsOf(own, lattice.image(coefficients(other))) < least) image = other;
  }
}

}  // namespace sweepface
