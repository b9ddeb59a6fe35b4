#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

Result<Drive> driveOf(const sweepface_drive* drive) {
  if (!drive) return Drive{};
  if (drive->kind < SWEEPFACE_CUT || drive->kind > SWEEPFACE_BOUNCE)
    return fail("There is no drive of kind ", drive->kind, "; kinds are 0 to ",
                int(SWEEPFACE_BOUNCE), ".");
  Drive result;
  result.kind = static_cast<Drive::Kind>(drive->kind);
  result.seconds = drive->seconds;
  result.turn = drive->turn;
  result.spring = {drive->frequency, drive->damping};
  result.restitution = drive->restitution;
  result.delay = drive->delay;
  return result;
}

static_assert(static_cast<int>(Drive::Kind::cut) == SWEEPFACE_CUT &&
              static_cast<int>(Drive::Kind::newton) == SWEEPFACE_NEWTON &&
              static_cast<int>(Drive::Kind::linearForce) == SWEEPFACE_LINEAR_FORCE &&
              static_cast<int>(Drive::Kind::accelerateBrake) == SWEEPFACE_ACCELERATE_BRAKE &&
              static_cast<int>(Drive::Kind::spring) == SWEEPFACE_SPRING &&
              static_cast<int>(Drive::Kind::bounce) == SWEEPFACE_BOUNCE);

sweepface_status checkCount(const sweepface_motion* motion, const double* out, size_t count) {
  if (!motion || (!out && count > 0)) return refuse("Reading a motion needs one and a place.");
  const std::size_t weights = motion->state.regionCount() * motion->state.size();
  if (count > weights) return refuse("The motion has only ", weights, " weights, not ", count, ".");
  return SWEEPFACE_OK;
}

}  // namespace

sweepface_drive sweepface_drive_of(sweepface_drive_kind kind) {
  const Drive usual;
  const bool known = kind >= SWEEPFACE_CUT && kind <= SWEEPFACE_BOUNCE;
  return {.kind = known ? kind : SWEEPFACE_SPRING,
          .delay = usual.delay,
          .seconds = usual.seconds,
          .turn = usual.turn,
          .frequency = usual.spring.frequency,
          .damping = usual.spring.damping,
          .restitution = usual.restitution};
}

sweepface_status sweepface_motion_create(const double* weights, size_t count,
                                         sweepface_motion** motion) {
  constexpr sweepface_matter plain{1, 1, 0};
  return sweepface_motion_create_regions(weights, count, &plain, 1, motion);
}

sweepface_status sweepface_motion_create_regions(const double* weights, size_t count,
                                                 const sweepface_matter* matters, size_t regions,
                                                 sweepface_motion** motion) {
  if (!motion || (!weights && count > 0) || (!matters && regions > 0))
    return refuse("Making a motion needs weights and a place for it.");
  if (regions > kMostRegions) return refuse("A motion has 1 to ", kMostRegions, " regions.");
  std::vector<Matter> given;
  for (size_t r = 0; r < regions; ++r)
    given.push_back({matters[r].mass, matters[r].stiffness, matters[r].delay});
  Result<RegionalMotion> state = RegionalMotion::make({weights, count}, given);
  if (!state) return refuse(state.error().message);
  *motion = new sweepface_motion{std::move(*state)};
  return SWEEPFACE_OK;
}

sweepface_status sweepface_motion_copy(const sweepface_motion* motion, sweepface_motion** copy) {
  if (!motion || !copy) return refuse("Copying a motion needs one and a place for the copy.");
  *copy = new sweepface_motion{*motion};
  return SWEEPFACE_OK;
}

void sweepface_motion_free(sweepface_motion* motion) { delete motion; }

void sweepface_motion_advance(sweepface_motion* motion, double seconds) {
  if (motion) motion->state.advance(seconds);
}

sweepface_status sweepface_motion_move_to(sweepface_motion* motion, uint32_t weight, double goal,
                                          const sweepface_drive* drive) {
  if (!motion) return refuse("Moving a weight needs a motion.");
  const Result<Drive> how = driveOf(drive);
  if (!how) return refuse(how.error().message);
  return statusOf(motion->state.moveTo(weight, goal, *how));
}

sweepface_status sweepface_motion_move_all(sweepface_motion* motion, const double* goals,
                                           size_t count, const sweepface_drive* drive) {
  if (!motion || (!goals && count > 0)) return refuse("Moving weights needs a motion and goals.");
  const Result<Drive> how = driveOf(drive);
  if (!how) return refuse(how.error().message);
  return statusOf(motion->state.moveTo({goals, count}, *how));
}

sweepface_status sweepface_motion_move_in(sweepface_motion* motion, uint32_t region,
                                          uint32_t weight, double goal,
                                          const sweepface_drive* drive) {
  if (!motion) return refuse("Moving a weight needs a motion.");
  const Result<Drive> how = driveOf(drive);
  if (!how) return refuse(how.error().message);
  return statusOf(motion->state.moveTo(region, weight, goal, *how));
}

sweepface_status sweepface_motion_put_in(sweepface_motion* motion, uint32_t region, uint32_t weight,
                                         double value) {
  if (!motion) return refuse("Moving a weight needs a motion.");
  return statusOf(motion->state.put(region, weight, value));
}

sweepface_status sweepface_motion_push(sweepface_motion* motion, uint32_t weight,
                                       double velocity_change, double drag) {
  if (!motion) return refuse("Pushing a weight needs a motion.");
  return statusOf(motion->state.push(weight, velocity_change, drag));
}

sweepface_status sweepface_motion_positions(const sweepface_motion* motion, double* out,
                                            size_t count) {
  if (const auto status = checkCount(motion, out, count)) return status;
  motion->state.positions({out, count});
  return SWEEPFACE_OK;
}

sweepface_status sweepface_motion_velocities(const sweepface_motion* motion, double* out,
                                             size_t count) {
  if (const auto status = checkCount(motion, out, count)) return status;
  motion->state.velocities({out, count});
  return SWEEPFACE_OK;
}

int32_t sweepface_motion_moves(const sweepface_motion* motion, double tolerance) {
  return motion && motion->state.moves(tolerance);
}
