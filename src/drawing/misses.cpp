#include "drawing/misses.hpp"

#include <fmt/format.h>

namespace sweepface::drawing {

namespace {

// The difference between each wish and the result; for an expression, that of what it adds.
std::vector<Vec3> missesOf(const Wishes& wishes, const Surface& surface,
                           const std::vector<Pose>& poses, std::size_t pose) {
  std::vector<Vec3> vectors(surface.vectorCount()), misses;
  surface.settle(poses[pose], vectors);
  for (std::size_t k = 0; k < wishes.sums.size(); ++k) {
    Vec3 miss = -wishes.places[pose][k];
    for (const Term& t : wishes.sums[k]) miss += t.factor * vectors[t.vector];
    misses.push_back(miss);
  }
  return misses;
}

}  // namespace

Miss largestMiss(const DrawnWishes& drawn, const Surface& surface, const std::vector<Pose>& poses) {
  Miss largest;
  const std::vector<Vec3> neutral = missesOf(drawn.wishes, surface, poses, 0);
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    const auto misses = pose == 0 ? neutral : missesOf(drawn.wishes, surface, poses, pose);
    for (std::size_t k = 0; k < misses.size(); ++k) {
      const double by = norm(pose == 0 ? misses[k] : neutral[k] + misses[k]);
      if (by > largest.by) largest = {by, static_cast<Index>(k), pose};
    }
  }
  // An expression is blamed only for what it adds.
  if (largest.wish >= 0 && norm(neutral[largest.wish]) > largest.by / 2) largest.pose = 0;
  return largest;
}

std::string nameOf(const Drawing& drawing, const DrawnWishes& drawn, Index wish) {
  if (const Drawing::Control* control = drawn.controls[wish])
    return fmt::format("the control of '{}' in '{}'", control->beside, control->in);
  return fmt::format("curve '{}'", drawing.curves[drawn.curves[wish]].name);
}

TextPlace placeOf(const Drawing& drawing, const DrawnWishes& drawn, Index wish) {
  const Drawing::Control* control = drawn.controls[wish];
  return control ? control->place : drawing.curves[drawn.curves[wish]].place;
}

}  // namespace sweepface::drawing
