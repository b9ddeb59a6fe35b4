#include "fit/doubts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sweepface/fit.hpp"

#include "io/text.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {
namespace {

// Of the mesh's diagonal: of a head's it is about the nose.
constexpr double kCoarse = 0.05;
// How many times as long, or as short, most edges of a target are where something else is wrong
// with it than that somebody opens the mouth.
constexpr double kUnlike = 4;
constexpr std::size_t kNamed = 6;

/// "'a', 'b' and 3 more", of the targets in question.
std::string listed(const MeshRig& source, const std::vector<char>& inQuestion) {
  std::vector<std::string> names;
  std::size_t count = 0;
  for (std::size_t t = 0; t < inQuestion.size(); ++t)
    if (inQuestion[t] && ++count <= kNamed) names.push_back(io::inQuotes(source.targets[t].name));
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return count <= kNamed ? list : fmt::format("{} and {} more", list, count - kNamed);
}

/// How much longer the edge in the middle of all, in the order of how much longer they are, is in a
/// target; 1 if the neutral has no edge of any length.
double stretchOf(const MeshRig& source, const MeshTarget& target) {
  const auto& [neutral, faces] = source.neutral;
  std::vector<double> stretches;
  stretches.reserve(faces.corners.size());
  for (Index f = 0; f < faces.faceCount(); ++f)
    for (Index k = 0; k < faces.faceSize(f); ++k) {
      const Index a = faces.corners[faces.faceStart[f] + k],
                  b = faces.corners[faces.faceStart[f] + (k + 1) % faces.faceSize(f)];
      const double length = norm(neutral[a] - neutral[b]);
      if (length > 0) stretches.push_back(norm(target.positions[a] - target.positions[b]) / length);
    }
  if (stretches.empty()) return 1;
  const auto middle = stretches.begin() + static_cast<std::ptrdiff_t>(stretches.size() / 2);
  std::ranges::nth_element(stretches, middle);
  return *middle;
}

bool moves(const MeshRig& source, const MeshTarget& target, double further) {
  return std::ranges::any_of(source.neutral.polygons.corners, [&](Index v) {
    return norm(target.positions[v] - source.neutral.positions[v]) > further;
  });
}

}  // namespace

std::vector<std::string> doubtsAbout(const MeshRig& source, double tolerance) {
  std::vector<std::string> doubts;
  const double size = diagonal(source.neutral);
  if (tolerance > kCoarse * size)
    doubts.push_back(
        fmt::format("The tolerance, {:.3g}, is {:.0f} % of the mesh's size, {:.3g}, and much of "
                    "its form may be "
                    "lost; it may be meant in other units.",
                    tolerance, 100 * tolerance / size, size));

  const std::size_t targets = source.targets.size();
  std::vector<char> unlike(targets), still(targets);
  parallelFor(std::size_t{0}, targets, [&](std::size_t t) {
    const double stretch = stretchOf(source, source.targets[t]);
    unlike[t] = stretch > kUnlike || stretch < 1 / kUnlike;
    still[t] = !moves(source, source.targets[t], tolerance);
  });
  if (std::ranges::count(unlike, 1) > 0)
    doubts.push_back(fmt::format(
        "Most edges are more than {} times as long, or as short, as the neutral's in {}: vertices "
        "may be in another order there, or in other units.",
        kUnlike, listed(source, unlike)));
  if (std::ranges::count(still, 1) > 0)
    doubts.push_back(
        fmt::format("No vertex moves by more than the tolerance in {}, which may be lost.",
                    listed(source, still)));
  return doubts;
}

}  // namespace sweepface
