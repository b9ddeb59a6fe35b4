#pragma once

#include <span>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/late_goals.hpp"
#include "sweepface/regions.hpp"

namespace sweepface {

/// What a drive becomes in a part of a face. The pull is that of the rest times the stiffness, and
/// m q″ = f: everything takes √(mass / stiffness) times as long, and a spring's damping, whose
/// damper stays the same, is divided by √(mass · stiffness). How late the part sets out is not the
/// drive's: its own delay stays.
Drive inMatter(Drive drive, const Matter& matter);

/// What a clip becomes in a matter that check() takes, with a spring. The recorded face has the
/// mass 1 already; what is beyond that hangs on the recorded weights by a spring and a damper,
/// follows late and swings on. Where it swings it has so many frames that straight lines between
/// them are as good as exact, as far as `regions` such clips together hold kMostClipWeights, and it
/// goes on until all of it has arrived: until what swings hangs still, or for ten seconds.
Clip inMatter(const Clip& clip, const Matter& matter, const Spring& hold = {},
              std::size_t regions = 1);

/// R regions × K weights in motion: a goal sends a weight off everywhere, and each region moves by
/// its own matter. One region of matter 1 is a MotionState, bit for bit. A late region does all
/// that it would do at once, later. Nothing allocates after `make`, but the texts of errors.
class RegionalMotion {
 public:
  /// All regions start from the same weights [K]. Refuses what MotionState or check() refuse.
  static Result<RegionalMotion> make(std::span<const double> weights,
                                     std::span<const Matter> matters);

  std::size_t regionCount() const noexcept { return regions_.size(); }
  std::size_t size() const noexcept { return regions_.front().state.size(); }  ///< K

  void advance(double seconds) noexcept;

  /// On an error nothing changes.
  Result<void> moveTo(std::size_t weight, double goal, const Drive& drive = {});
  Result<void> moveTo(std::span<const double> goals, const Drive& drive = {});
  /// Only in one region.
  Result<void> moveTo(std::size_t region, std::size_t weight, double goal, const Drive& drive);
  /// At once, whatever the matter; no goal waits for it any more.
  Result<void> put(std::size_t region, std::size_t weight, double value);
  /// A blow, which a heavy region feels less and a late one at once: no goal waits for the weight
  /// any more. On an error nothing changes.
  Result<void> push(std::size_t weight, double velocityChange, double drag);

  Kinematics sample(std::size_t region, std::size_t weight) const noexcept;
  /// All weights [R × K], as an Evaluation of the same regions takes them.
  void positions(std::span<double> out) const noexcept;
  void velocities(std::span<double> out) const noexcept;
  /// Like MotionState::moves, in any region.
  bool moves(double tolerance = 1e-6) const noexcept;

 private:
  struct Region {
    Matter matter;
    MotionState state;
    LateGoals late;

    void advance(double seconds) noexcept;
    /// Whether moveTo() would be an error.
    Result<void> check(std::size_t weight, double goal, const Drive& drive) const;
    Result<void> moveTo(std::size_t weight, double goal, const Drive& drive);
  };

  RegionalMotion() = default;
  Result<void> checkRegion(std::size_t region) const;

  std::vector<Region> regions_;  // [R]
};

}  // namespace sweepface
