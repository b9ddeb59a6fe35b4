#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/trajectory.hpp"

namespace sweepface {

/// The springs that pull K weights now, of a few kinds: a kind is one frequency and damping. All
/// springs of a kind share a starting time, so that one exponential and one sine serve them all.
/// When another sets out later, those of its kind are restarted then from where they are, on the
/// same paths up to rounding. Allocates nothing once made.
class SpringBank {
 public:
  explicit SpringBank(std::size_t weights = 0);

  /// False if there are too many kinds already: then nothing pulls the weight.
  bool pull(std::size_t weight, const path::Swing& swing, double began) noexcept;
  void release(std::size_t weight) noexcept;
  bool pulls(std::size_t weight) const noexcept { return kindOf_[weight] != kNone; }
  bool pullsAll() const noexcept { return pulled_ == kindOf_.size(); }

  /// The state of a weight that a spring pulls, at a time from its start on.
  Kinematics at(std::size_t weight, double time) const noexcept;
  /// Writes those of all weights [≤ K] that a spring pulls and leaves the others as they are.
  void positions(double time, std::span<double> out) const noexcept;
  void velocities(double time, std::span<double> out) const noexcept;

 private:
  static constexpr std::size_t kMostKinds = 16;
  static constexpr std::uint8_t kNone = kMostKinds;

  struct Kind {
    path::Swing swing{};  // what all share: sigma, omega
    double began = 0;
    std::size_t count = 0;  // of weights
  };
  std::uint8_t kindFor(const path::Swing& swing, double began) noexcept;
  void beginAgain(std::uint8_t kind, double time) noexcept;
  template <typename Use>
  void eachRun(double time, std::size_t count, const Use& use) const noexcept;

  std::array<Kind, kMostKinds> kinds_;
  std::vector<std::uint8_t> kindOf_;  // [K]
  std::size_t pulled_ = 0;
  std::vector<double> goals_;          // [K]
  std::vector<double> ways_, speeds_;  // [K] from the goals, where the kind began
};

}  // namespace sweepface
