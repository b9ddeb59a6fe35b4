#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/trajectory.hpp"

namespace sweepface {

/// The springs that pull K weights now, a few kinds of them: springs of one frequency and damping.
/// All of a kind have begun together, so that an exponential and a sine serve them all. What sets
/// out later makes the others begin again there, from where they are: the same paths to rounding.
/// Allocates nothing once made.
class SpringBank {
 public:
  explicit SpringBank(std::size_t weights = 0);

  /// False where there are too many kinds already: nothing pulls the weight then.
  bool pull(std::size_t weight, const path::Swing& swing, double began) noexcept;
  void release(std::size_t weight) noexcept;
  bool pulls(std::size_t weight) const noexcept { return kindOf_[weight] != kNone; }
  bool pullsAll() const noexcept { return pulled_ == kindOf_.size(); }

  /// Of a weight that a spring pulls, at a time since it began.
  Kinematics at(std::size_t weight, double time) const noexcept;
  /// Of all weights [≤ K] that a spring pulls; others stay as they are.
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
