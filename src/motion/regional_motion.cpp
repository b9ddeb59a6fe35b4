#include "sweepface/regional_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace sweepface {

Drive inMatter(Drive drive, const Matter& matter) {
  const double stretch = std::sqrt(matter.mass / matter.stiffness);
  drive.seconds *= stretch;
  drive.spring.frequency /= stretch;
  drive.spring.damping /= std::sqrt(matter.mass * matter.stiffness);
  return drive;
}

// ---- Clips ----

namespace {

// Frames closer than this count as one, as the speed between them has no significant digits.
constexpr double kJump = 1e-7;  // seconds

/// A mass hanging on one recorded weight g: x″ = −2ζω (x′ − g′) − ω² (x − g). Between two frames,
/// where g is linear, its distance e = x − g swings freely; where g changes speed, it gets an
/// impulse.
class Hanging {
 public:
  explicit Hanging(const Spring& spring) : spring_(spring) {}

  double step(double seconds, double way) {
    if (seconds < kJump) return jump(way);
    const double speed = way / seconds;
    const Start start{distance_.position, distance_.velocity + speed_ - speed};
    if (const auto swing = Trajectory::spring(start, 0, spring_))
      distance_ = swing->at(seconds);
    else
      distance_ = {};
    speed_ = speed;
    return distance_.position;
  }

  /// A bound on the acceleration of the mass from now on, if what it hangs on goes on at a constant
  /// speed. A swing only loses energy, v² + ω² x². Beyond critical damping the acceleration
  /// consists of 2σ (v + s x) and s² x, where s is the slower of the two decay rates.
  double bend(double speed) const {
    const double omega = pull(), sigma = spring_.damping * omega;
    const double x = distance_.position, v = distance_.velocity + speed_ - speed;
    if (sigma < omega)
      return std::sqrt((4 * sigma * sigma + omega * omega) * (v * v + omega * omega * x * x));
    const double s = omega * omega / (sigma + std::sqrt((sigma - omega) * (sigma + omega)));
    return 2 * sigma * std::abs(v + s * x) + s * s * std::abs(x);
  }

  /// Whether the mass swings about what it hangs on, and whether it would if that stopped.
  bool swings() const { return isMuch(distance_.velocity); }
  bool swingsOn() const { return isMuch(distance_.velocity + speed_); }

 private:
  double pull() const { return 2 * std::numbers::pi * spring_.frequency; }

  // A jump takes no time, so that only the damper changes the speed of the mass.
  double jump(double way) {
    distance_.position -= way;
    distance_.velocity += speed_ + 2 * spring_.damping * pull() * way;
    speed_ = 0;
    return distance_.position;
  }

  bool isMuch(double speed) const {
    constexpr double kSmall = 3e-5;
    return std::abs(distance_.position) > kSmall || std::abs(speed) > kSmall * pull();
  }

  Spring spring_;
  Kinematics distance_;
  double speed_ = 0;  // of what it hangs on
};

/// The clip of the masses that hang on a clip. While anything swings, there are enough frames for
/// straight lines between them to be as good as exact, up to ten seconds after each frame of the
/// clip and `mostWeights` weights in all: half of the frames are for even spacing, the rest for
/// closer ones. The result goes on until all masses hang still, or for ten seconds.
Clip hanging(const Clip& clip, const Spring& spring, std::size_t mostWeights) {
  constexpr double kFrame = 1.0 / 120, kLongest = 10;
  const std::size_t n = clip.names.size();
  if (clip.times.empty() || n == 0) return clip;
  double swinging = kLongest;
  for (std::size_t f = 1; f < clip.times.size(); ++f)
    swinging += std::min(clip.times[f] - clip.times[f - 1], kLongest);
  // Frames left for each of the two kinds, beyond the clip's own.
  double room =
      (static_cast<double>(mostWeights / n) - 2 * static_cast<double>(clip.times.size())) / 2;
  const double frame = std::max(kFrame, room > 0 ? swinging / room : HUGE_VAL);

  std::vector<double> before(clip.weights.begin(), clip.weights.begin() + std::ssize(clip.names));
  std::vector<double> now(n);
  std::vector<Hanging> hangs(n, Hanging(spring));
  Clip result{clip.names, {clip.times.front()}, before};
  const auto goTo = [&](double time) {
    const double seconds = time - result.times.back();
    clip.at(time - clip.times.front(), now);
    result.times.push_back(time);
    for (std::size_t k = 0; k < n; ++k)
      result.weights.push_back(now[k] + hangs[k].step(seconds, now[k] - before[k]));
    before.swap(now);
  };
  const auto any = [&](auto swings) { return std::ranges::any_of(hangs, swings); };
  // Adds one piece at least, then more while anything swings; the last is a quarter longer at most.
  // With an acceleration b, a path is off its straight line by b h² / 8 in a piece of length h.
  // What settles within the shortest piece has not gone far, and clocks may not resolve shorter
  // ones.
  const auto goOn = [&](double from, double span, double piece, double share, auto speedOf,
                        auto swings) {
    constexpr double kMiss = 6e-5, kShortest = 1e-4;
    const double least = room > 0 ? std::max(kShortest, span / (share * room)) : HUGE_VAL;
    const auto next = [&] {
      double bend = 0;
      for (std::size_t k = 0; k < n; ++k) bend = std::max(bend, hangs[k].bend(speedOf(k)));
      return std::min(std::max(least, std::sqrt(8 * kMiss / bend)), piece);
    };
    double step = next();
    for (double at = step; at + step / 4 <= span && at <= kLongest; at += step) {
      goTo(from + at);
      --room;
      if (!any(swings)) return;
      step = next();
    }
  };
  const std::size_t count = clip.times.size();
  for (std::size_t f = 1; f < count; ++f) {
    const double from = clip.times[f - 1], span = clip.times[f] - from;
    const double piece = span / std::ceil(span / frame);
    const auto speedOf = [&](std::size_t k) {
      return (clip.weights[f * n + k] - clip.weights[(f - 1) * n + k]) / span;
    };
    if (span >= kJump)
      goOn(from, span, piece, 1 / static_cast<double>(count - f + 1), speedOf, &Hanging::swings);
    goTo(clip.times[f]);
  }
  if (any(&Hanging::swingsOn))
    goOn(
        clip.times.back(), kLongest, frame, 1, [](std::size_t) { return 0.0; }, &Hanging::swingsOn);
  return result;
}

void delay(Clip& clip, double seconds) {
  if (clip.times.empty()) return;
  const std::vector<double> first(clip.weights.begin(),
                                  clip.weights.begin() + std::ssize(clip.names));
  const double start = clip.times.front();
  for (double& time : clip.times) time += seconds;
  clip.times.insert(clip.times.begin(), start);
  clip.weights.insert(clip.weights.begin(), first.begin(), first.end());
}

}  // namespace

Clip inMatter(const Clip& clip, const Matter& matter, const Spring& hold, std::size_t regions) {
  const double excess = matter.mass - 1;
  Clip late = excess > 0 ? hanging(clip,
                                   {hold.frequency * std::sqrt(matter.stiffness / excess),
                                    hold.damping / std::sqrt(matter.stiffness * excess)},
                                   kMostClipWeights / std::max<std::size_t>(regions, 1))
                         : clip;
  if (matter.delay > 0) delay(late, matter.delay);
  return late;
}

// ---- Live ----

void RegionalMotion::Region::advance(double seconds) noexcept {
  double left = seconds <= kMostSeconds ? seconds : 0;
  const double until = state.now() + left;
  for (; const LateGoals::Goal* goal = late.due(until); late.removeFirst()) {
    const double step = std::max(0.0, goal->at - state.now());
    state.advance(step);
    left -= step;
    // This fails only if no number can hold the path from where the weight is by now.
    std::ignore = state.moveTo(goal->weight, goal->value, goal->drive);
  }
  state.advance(left);
}

Result<void> RegionalMotion::Region::check(std::size_t weight, double goal,
                                           const Drive& drive) const {
  return state.check(weight, goal, inMatter(drive, matter));
}

Result<void> RegionalMotion::Region::moveTo(std::size_t weight, double goal, const Drive& drive) {
  const Drive own = inMatter(drive, matter);
  if (matter.delay == 0) return state.moveTo(weight, goal, own);
  if (auto ok = state.check(weight, goal, own); !ok) return ok;
  late.add({state.now() + matter.delay, weight, goal, own});
  return {};
}

Result<RegionalMotion> RegionalMotion::make(std::span<const double> weights,
                                            std::span<const Matter> matters) {
  if (matters.empty() || matters.size() > kMostRegions)
    return failCall("A motion has 1 to ", kMostRegions, " regions.");
  RegionalMotion motion;
  for (const Matter& matter : matters) {
    if (auto ok = check(matter); !ok) return std::unexpected(ok.error());
    auto state = MotionState::make(weights);
    if (!state) return std::unexpected(state.error());
    motion.regions_.push_back({matter, std::move(*state), {weights.size(), matter.delay}});
  }
  return motion;
}

void RegionalMotion::advance(double seconds) noexcept {
  for (Region& region : regions_) region.advance(seconds);
}

Result<void> RegionalMotion::moveTo(std::size_t weight, double goal, const Drive& drive) {
  // All are checked before the first sets out, so that an error leaves everything as it was.
  for (const Region& region : regions_)
    if (auto ok = region.check(weight, goal, drive); !ok) return ok;
  for (Region& region : regions_)
    if (auto ok = region.moveTo(weight, goal, drive); !ok) return ok;
  return {};
}

Result<void> RegionalMotion::moveTo(std::span<const double> goals, const Drive& drive) {
  if (goals.size() != size()) return regions_.front().state.moveTo(goals, drive);
  for (std::size_t k = 0; k < goals.size(); ++k)
    for (const Region& region : regions_)
      if (auto ok = region.check(k, goals[k], drive); !ok) return ok;
  for (std::size_t k = 0; k < goals.size(); ++k)
    for (Region& region : regions_)
      if (auto ok = region.moveTo(k, goals[k], drive); !ok) return ok;
  return {};
}

Result<void> RegionalMotion::checkRegion(std::size_t region) const {
  if (region < regions_.size()) return {};
  return failCall("There is no region ", region, "; there are ", regions_.size(), ".");
}

Result<void> RegionalMotion::moveTo(std::size_t region, std::size_t weight, double goal,
                                    const Drive& drive) {
  if (auto ok = checkRegion(region); !ok) return ok;
  return regions_[region].moveTo(weight, goal, drive);
}

Result<void> RegionalMotion::put(std::size_t region, std::size_t weight, double value) {
  if (auto ok = checkRegion(region); !ok) return ok;
  auto& [matter, state, late] = regions_[region];
  auto ok = state.moveTo(weight, value, {.kind = Drive::Kind::cut, .spring = {}});
  if (ok) late.forget(weight);
  return ok;
}

Result<void> RegionalMotion::push(std::size_t weight, double velocityChange, double drag) {
  // All are checked before the first is pushed.
  for (const auto& [matter, state, late] : regions_)
    if (auto ok = state.pushed(weight, velocityChange / matter.mass, drag / matter.mass); !ok)
      return std::unexpected(ok.error());
  for (auto& [matter, state, late] : regions_) {
    late.forget(weight);
    if (auto ok = state.push(weight, velocityChange / matter.mass, drag / matter.mass); !ok)
      return ok;
  }
  return {};
}

Kinematics RegionalMotion::sample(std::size_t region, std::size_t weight) const noexcept {
  return region < regions_.size() ? regions_[region].state.sample(weight) : Kinematics{};
}

void RegionalMotion::positions(std::span<double> out) const noexcept {
  for (std::size_t r = 0; r < regions_.size(); ++r)
    regions_[r].state.positions(out.subspan(std::min(out.size(), r * size())));
}

void RegionalMotion::velocities(std::span<double> out) const noexcept {
  for (std::size_t r = 0; r < regions_.size(); ++r)
    regions_[r].state.velocities(out.subspan(std::min(out.size(), r * size())));
}

bool RegionalMotion::moves(double tolerance) const noexcept {
  return std::ranges::any_of(regions_, [&](const Region& region) {
    return !region.late.isEmpty() || region.state.moves(tolerance);
  });
}

}  // namespace sweepface
