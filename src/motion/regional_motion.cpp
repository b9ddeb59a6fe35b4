#include "sweepface/regional_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace sweepface {

Drive inMatter(Drive drive, const Matter& matter) {
  const double stretch = std::sqrt(matter.mass / matter.stiffness);
  drive.seconds *= stretch;
  drive.spring.frequency /= stretch;
  drive.spring.damping /= std::sqrt(matter.mass * matter.stiffness);
  drive.delay += matter.delay;
  return drive;
}

// ---- Clips ----

namespace {

/// What hangs on one recorded weight g: x″ = −2ζω (x′ − g′) − ω² (x − g). Its distance e = x − g
/// swings freely between two frames, where g is straight, and gets a blow where g changes speed.
class Hanging {
 public:
  explicit Hanging(const Spring& spring) : spring_(spring) {}

  double at() const { return distance_.position; }

  void step(double seconds, double way) {
    const double speed = way / seconds;
    const Start start{distance_.position, distance_.velocity + speed_ - speed};
    if (const auto swing = Trajectory::spring(start, 0, spring_))
      distance_ = swing->at(seconds);
    else
      distance_ = {};
    speed_ = speed;
  }

 private:
  Spring spring_;
  Kinematics distance_;
  double speed_ = 0;  // of what it hangs on
};

void hang(Clip& clip, const Spring& spring) {
  const std::size_t n = clip.names.size();
  for (std::size_t k = 0; k < n; ++k) {
    Hanging hanging(spring);
    double before = clip.times.empty() ? 0 : clip.weights[k];
    for (std::size_t f = 1; f < clip.times.size(); ++f) {
      double& weight = clip.weights[f * n + k];
      const double now = weight;
      hanging.step(clip.times[f] - clip.times[f - 1], now - before);
      weight += hanging.at();
      before = now;
    }
  }
}

void delay(Clip& clip, double seconds) {
  const Clip before = clip;
  const std::size_t n = clip.names.size();
  // It goes on, in frames as long as its own, until the end has arrived.
  if (const auto frames = static_cast<double>(before.times.size()); frames > 1) {
    constexpr double kShortest = 1.0 / 240;
    const double end = before.times.back();
    double step = std::max(kShortest, before.seconds() / (frames - 1));
    // But no more of them than a clip may hold.
    const std::size_t most = kMostClipWeights / std::max<std::size_t>(n, 1);
    const auto room = static_cast<double>(most - std::min(most, before.times.size()));
    step = std::max(step, seconds / std::max(1.0, room));
    for (int k = 1; clip.times.back() < end + seconds; ++k)
      clip.times.push_back(std::min(end + k * step, end + seconds));
    clip.weights.resize(n * clip.times.size());
  }
  for (std::size_t f = 0; f < clip.times.size(); ++f)
    before.at(clip.times[f] - clip.times.front() - seconds,
              std::span(clip.weights).subspan(f * n, n));
}

}  // namespace

Clip inMatter(const Clip& clip, const Matter& matter, const Spring& hold) {
  Clip late = clip;
  if (const double excess = matter.mass - 1; excess > 0)
    hang(late, {hold.frequency * std::sqrt(matter.stiffness / excess),
                hold.damping / std::sqrt(matter.stiffness * excess)});
  if (matter.delay > 0) delay(late, matter.delay);
  return late;
}

// ---- Live ----

Result<RegionalMotion> RegionalMotion::make(std::span<const double> weights,
                                            std::span<const Matter> matters) {
  if (matters.empty() || matters.size() > kMostRegions)
    return failCall("A motion has 1 to ", kMostRegions, " regions.");
  RegionalMotion motion;
  for (const Matter& matter : matters) {
    if (auto ok = check(matter); !ok) return std::unexpected(ok.error());
    auto state = MotionState::make(weights);
    if (!state) return std::unexpected(state.error());
    motion.matters_.push_back(matter);
    motion.states_.push_back(std::move(*state));
  }
  return motion;
}

void RegionalMotion::advance(double seconds) noexcept {
  for (MotionState& state : states_) state.advance(seconds);
}

Result<void> RegionalMotion::moveTo(std::size_t weight, double goal, const Drive& drive) {
  // All are asked before the first sets out, so that an error leaves everything as it was.
  for (std::size_t r = 0; r < states_.size(); ++r)
    if (auto ok = states_[r].check(weight, goal, inMatter(drive, matters_[r])); !ok) return ok;
  for (std::size_t r = 0; r < states_.size(); ++r)
    if (auto ok = states_[r].moveTo(weight, goal, inMatter(drive, matters_[r])); !ok) return ok;
  return {};
}

Result<void> RegionalMotion::moveTo(std::span<const double> goals, const Drive& drive) {
  if (goals.size() != size()) return states_.front().moveTo(goals, drive);
  for (std::size_t k = 0; k < goals.size(); ++k)
    for (std::size_t r = 0; r < states_.size(); ++r)
      if (auto ok = states_[r].check(k, goals[k], inMatter(drive, matters_[r])); !ok) return ok;
  for (std::size_t r = 0; r < states_.size(); ++r)
    if (auto ok = states_[r].moveTo(goals, inMatter(drive, matters_[r])); !ok) return ok;
  return {};
}

Result<void> RegionalMotion::checkRegion(std::size_t region) const {
  if (region < states_.size()) return {};
  return failCall("There is no region ", region, "; there are ", states_.size(), ".");
}

Result<void> RegionalMotion::moveTo(std::size_t region, std::size_t weight, double goal,
                                    const Drive& drive) {
  if (auto ok = checkRegion(region); !ok) return ok;
  return states_[region].moveTo(weight, goal, inMatter(drive, matters_[region]));
}

Result<void> RegionalMotion::put(std::size_t region, std::size_t weight, double value) {
  if (auto ok = checkRegion(region); !ok) return ok;
  return states_[region].moveTo(weight, value, {.kind = Drive::Kind::cut, .spring = {}});
}

Result<void> RegionalMotion::push(std::size_t weight, double velocityChange, double drag) {
  // All are asked before the first is pushed.
  for (std::size_t r = 0; r < states_.size(); ++r)
    if (auto ok =
            states_[r].pushed(weight, velocityChange / matters_[r].mass, drag / matters_[r].mass);
        !ok)
      return std::unexpected(ok.error());
  for (std::size_t r = 0; r < states_.size(); ++r)
    if (auto ok =
            states_[r].push(weight, velocityChange / matters_[r].mass, drag / matters_[r].mass);
        !ok)
      return ok;
  return {};
}

Kinematics RegionalMotion::sample(std::size_t region, std::size_t weight) const noexcept {
  return region < states_.size() ? states_[region].sample(weight) : Kinematics{};
}

void RegionalMotion::positions(std::span<double> out) const noexcept {
  for (std::size_t r = 0; r < states_.size(); ++r)
    states_[r].positions(out.subspan(std::min(out.size(), r * size())));
}

void RegionalMotion::velocities(std::span<double> out) const noexcept {
  for (std::size_t r = 0; r < states_.size(); ++r)
    states_[r].velocities(out.subspan(std::min(out.size(), r * size())));
}

}  // namespace sweepface
