#include "sweepface/trajectory.hpp"

#include "ode/elementary.hpp"

namespace sweepface {
namespace {

// t − sin(wt) / w, where s is sin(wt); by its series where the difference would cancel.
double beyondSine(double w, double t, double s) {
  const double square = (w * t) * (w * t);
  if (square > 0.01) return t - s / w;
  return t * square / 6 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72)));
}

}  // namespace

// What the harmonics alone do to a coordinate that starts at rest at 0.
Kinematics path::Driven::periodic(double t) const noexcept {
  Kinematics sum;
  for (std::size_t k = 0; k < count; ++k) {
    const double w = static_cast<double>(k + 1) * omega, half = ode::sineCosine(w * t / 2).sine;
    const auto [sine, cosine] = ode::sineCosine(w * t);
    const double risen = 2 * half * half / w;
    const Harmonic& h = harmonics[k];
    sum.position += h.cosine * risen / w + h.sine * beyondSine(w, t, sine) / w;
    sum.velocity += h.cosine * sine / w + h.sine * risen;
    sum.acceleration += h.cosine * cosine + h.sine * sine;
  }
  return sum;
}

Kinematics path::Driven::at(double t) const noexcept {
  if (t > end) return {goal, 0, 0};
  const Kinematics a = mean.at(t), b = periodic(t);
  return {a.position + b.position, a.velocity + b.velocity, a.acceleration + b.acceleration};
}

}  // namespace sweepface
