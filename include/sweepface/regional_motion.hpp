#pragma once

#include <span>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/late_goals.hpp"
#include "sweepface/regions.hpp"

namespace sweepface {

/// What a drive becomes in a part of a face. The force is that of the rest times the stiffness, and
/// m q″ = f, so everything takes √(mass / stiffness) times as long. A spring keeps its damper, so
/// its damping is divided by √(mass · stiffness). The drive keeps its own delay: that of the matter
/// is not added.
Drive inMatter(Drive drive, const Matter& matter);

/// What a clip becomes in a matter that check() accepts. The recorded face already has a mass of 1;
/// any mass beyond that hangs on the recorded weights by a spring and a damper (`hold`), follows
/// late and swings on. Where it swings, frames are added until straight lines between them are as
/// good as exact, as far as `regions` such clips fit into kMostClipWeights together. The clip goes
/// on until all of it has arrived: until what swings hangs still, or for ten seconds.
Clip inMatter(const Clip& clip, const Matter& matter, const Spring& hold = {},
              std::size_t regions = 1);

/// R regions × K weights in motion: a goal sends a weight off in all regions, and each moves by its
/// own matter. One region of matter 1 is a MotionState, bit for bit. A late region does everything
/// that it would do at once, later. After `make` nothing allocates except error messages.
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
  /// Puts a weight there at once, whatever the matter. Goals that wait for the weight are dropped.
  Result<void> put(std::size_t region, std::size_t weight, double value);
  /// An impulse, which a heavy region feels less and a late one at once. Goals that wait for the
  /// weight are dropped. On an error nothing changes.
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
    /// Whether moveTo() would fail.
    Result<void> check(std::size_t weight, double goal, const Drive& drive) const;
    Result<void> moveTo(std::size_t weight, double goal, const Drive& drive);
  };

  RegionalMotion() = default;
  Result<void> checkRegion(std::size_t region) const;

  std::vector<Region> regions_;  // [R]
};

}  // namespace sweepface
