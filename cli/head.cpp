#include "head.hpp"

#include <fmt/format.h>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"

namespace sweepface::cli {
namespace {

Result<Vec3> pivotOf(const HeadArguments& a, const Rig& rig) {
  if (a.pivot.empty()) {
    const Tessellation grid(rig.surface, 1);
    return Box(grid.positions(blend(rig, {}))).centre();
  }
  return pointGiven("--pivot", a.pivot);
}

}  // namespace

void addHead(CLI::App& app, HeadArguments& a) {
  CLI::Option* head = app.add_option("--head", a.turns,
                                     "on: the whole model turns by the head's angles in a capture")
                          ->check(onOrOff())
                          ->capture_default_str()
                          ->type_name("on|off");
  app.add_option("--pivot", a.pivot,
                 "What the head turns about, as X,Y,Z; the middle of the model if not given")
      ->needs(head)
      ->check(notEmpty())
      ->type_name("X,Y,Z");
}

Result<std::optional<HeadTrack>> headTrack(const HeadArguments& a, const Rig& rig,
                                           const Performance& performance,
                                           const std::vector<double>& times) {
  if (!a.on()) return std::nullopt;
  if (!performance.hasHead)
    return fail(fmt::format("{} has no angles of the head; leave --head out.", performance.called));
  const auto pivot = pivotOf(a, rig);
  if (!pivot) return std::unexpected(pivot.error());
  HeadTrack track{times, {}, *pivot};
  for (const double time : times)
    track.rotations.push_back(quaternionOf(performance.pose(time).head));
  return track;
}

}  // namespace sweepface::cli
