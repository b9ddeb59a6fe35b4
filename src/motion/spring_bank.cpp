#include "sweepface/spring_bank.hpp"

#include <algorithm>

namespace sweepface {

SpringBank::SpringBank(std::size_t weights)
    : kindOf_(weights, kNone), goals_(weights), ways_(weights), speeds_(weights) {}

// The kind of a spring: an existing one, else one no longer in use; kNone if there is neither.
std::uint8_t SpringBank::kindFor(const path::Swing& swing, double began) noexcept {
  std::uint8_t unused = kNone;
  for (std::uint8_t k = 0; k < kMostKinds; ++k) {
    const Kind& kind = kinds_[k];
    if (kind.count == 0)
      unused = std::min(unused, k);
    else if (kind.swing.sigma == swing.sigma && kind.swing.omega == swing.omega)
      return k;
  }
  if (unused != kNone) kinds_[unused] = {swing, began, 0};
  return unused;
}

void SpringBank::beginAgain(std::uint8_t kind, double time) noexcept {
  const path::Swing& swing = kinds_[kind].swing;
  const auto decay = swing.decay(time - kinds_[kind].began);
  for (std::size_t k = 0; k < kindOf_.size(); ++k) {
    if (kindOf_[k] != kind) continue;
    const Kinematics way = swing.wayAfter(decay, {ways_[k], speeds_[k]});
    ways_[k] = way.position, speeds_[k] = way.velocity;
  }
  kinds_[kind].began = time;
}

bool SpringBank::pull(std::size_t weight, const path::Swing& swing, double began) noexcept {
  release(weight);
  const std::uint8_t kind = kindFor(swing, began);
  if (kind == kNone) return false;
  Start way{swing.x - swing.goal, swing.v};
  if (began > kinds_[kind].began) {
    beginAgain(kind, began);
  } else if (began < kinds_[kind].began) {
    const Kinematics later = swing.wayAfter(swing.decay(kinds_[kind].began - began), way);
    way = {later.position, later.velocity};
  }
  kindOf_[weight] = kind;
  ++kinds_[kind].count, ++pulled_;
  goals_[weight] = swing.goal;
  ways_[weight] = way.position, speeds_[weight] = way.velocity;
  return true;
}

void SpringBank::release(std::size_t weight) noexcept {
  if (!pulls(weight)) return;
  --kinds_[kindOf_[weight]].count, --pulled_;
  kindOf_[weight] = kNone;
}

Kinematics SpringBank::at(std::size_t weight, double time) const noexcept {
  const auto& [swing, began, count] = kinds_[kindOf_[weight]];
  const Kinematics way =
      swing.wayAfter(swing.decay(time - began), {ways_[weight], speeds_[weight]});
  return {goals_[weight] + way.position, way.velocity, way.acceleration};
}

// Visits runs of neighbours of one kind, so that there is no branch within a run.
template <typename Use>
void SpringBank::eachRun(double time, std::size_t count, const Use& use) const noexcept {
  std::array<path::Swing::Decay, kMostKinds> decays;
  for (std::size_t k = 0; k < kMostKinds; ++k)
    if (kinds_[k].count > 0) decays[k] = kinds_[k].swing.decay(time - kinds_[k].began);
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    const std::uint8_t kind = kindOf_[first];
    const bool isAll = kind != kNone && kinds_[kind].count == kindOf_.size();
    for (end = isAll ? count : first + 1; end < count && kindOf_[end] == kind;) ++end;
    if (kind != kNone) use(first, end, kinds_[kind].swing, decays[kind]);
  }
}

void SpringBank::positions(double time, std::span<double> out) const noexcept {
  eachRun(time, std::min(out.size(), kindOf_.size()),
          [&](std::size_t first, std::size_t end, const path::Swing& swing, const auto& decay) {
            const double *const goals = goals_.data(), *const ways = ways_.data(),
                                *const speeds = speeds_.data();
            for (std::size_t k = first; k < end; ++k)
              out[k] = goals[k] + swing.wayAfter(decay, {ways[k], speeds[k]}).position;
          });
}

void SpringBank::velocities(double time, std::span<double> out) const noexcept {
  eachRun(time, std::min(out.size(), kindOf_.size()),
          [&](std::size_t first, std::size_t end, const path::Swing& swing, const auto& decay) {
            for (std::size_t k = first; k < end; ++k)
              out[k] = swing.wayAfter(decay, {ways_[k], speeds_[k]}).velocity;
          });
}

}  // namespace sweepface
