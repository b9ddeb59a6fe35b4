#include "report/subject.hpp"

#include <algorithm>
#include <iterator>

#include "report/words.hpp"

namespace sweepface {
namespace {

/// The stored vectors that are places of nodes.
std::vector<Index> placesOf(const Surface& surface) {
  std::vector<Index> places;
  for (Index v = 0; v < surface.storedCount(); ++v)
    if (surface.stored(v).isPosition()) places.push_back(v);
  return places;
}

/// A box round the places that any target moves by a good part of its largest displacement.
Box movedIn(const Rig& rig, const std::vector<Index>& places) {
  constexpr double kPart = 0.1;
  Box moved;
  for (const Target& target : rig.targets) {
    double most = 0;
    for (const Index v : places) most = std::max(most, norm(target.difference[v]));
    for (const Index v : places)
      if (most > rig.tolerance && norm(target.difference[v]) >= kPart * most)
        moved.include(rig.neutral[v]);
  }
  return moved;
}

bool isWithin(const Vec3& p, const Box& box) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y &&
         p.z >= box.low.z && p.z <= box.high.z;
}

}  // namespace

Subject::Subject(const Rig& rig) {
  constexpr double kSmall = 0.4, kRoom = 0.15;  // of the diagonal of the whole, and of the part
  const std::vector<Index> places = placesOf(rig.surface);
  Box all;
  for (const Index v : places) all.include(rig.neutral[v]);
  const Box moved = movedIn(rig, places);
  const double size = norm(moved.size()), room = kRoom * size;
  if (!(size > 0) || size > kSmall * norm(all.size())) return;
  part_.include(moved.low - Vec3{room, room, room});
  part_.include(moved.high + Vec3{room, room, room});
}

std::vector<Camera> Subject::cameras(const FaceScenes& scenes, const Weights& expression,
                                     std::span<const View> views) const {
  std::vector<Vec3> points = scenes.drawn(Weights(expression.size(), 0.0));
  std::ranges::copy(scenes.drawn(expression), std::back_inserter(points));
  if (!part_.isEmpty()) std::erase_if(points, [&](const Vec3& p) { return !isWithin(p, part_); });
  return frameCameras(points, views, kPanel);
}

PictureSize Subject::cutFor(PictureSize size) const {
  // Twice at most, as shadows of anything finer take too long.
  const int scale = part_.isEmpty() ? 1 : 2;
  return {scale * size.width, scale * size.height};
}

}  // namespace sweepface
