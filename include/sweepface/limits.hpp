#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The least and the greatest values of weights.
class Limits {
 public:
  struct Range {
    double low, high;
    friend bool operator==(const Range&, const Range&) = default;
  };

  /// No limits.
  Limits() = default;
  explicit Limits(std::vector<Range> ranges) : ranges_(std::move(ranges)) {}
  /// "0:1,jawOpen=0:0.8": all targets from 0 to 1, jawOpen no more than 0.8, in any order.
  static Result<Limits> parse(const Rig& rig, std::string_view text);

  bool empty() const noexcept { return ranges_.empty(); }
  std::span<const Range> ranges() const noexcept { return ranges_; }  ///< [K]

  /// Clamps weights [K] to their limits.
  void apply(std::span<double> weights) const noexcept;

 private:
  std::vector<Range> ranges_;
};

}  // namespace sweepface
