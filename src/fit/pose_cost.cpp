#include "fit/pose_cost.hpp"

#include <algorithm>

namespace sweepface {

namespace {

using Four = PoseCost::Four;

// A penalty in bits: hardly any well within the bound, steep beyond it.
constexpr float kInside = 2, kBeyond = 400;
[[gnu::always_inline]] inline Four penalty(Four square, float beyond) {
  const Four s2 = square * square, past = square - 1;
  return kInside * s2 * s2 * square + beyond * (past > 0 ? past : Four{});
}
float slope(float square, float beyond) {
  const float s2 = square * square;
  return 5 * kInside * s2 * s2 + (square > 1 ? beyond : 0);
}

// A tangent that is off by about half of its length may turn the surface over.
constexpr float kMostStrain = 0.2f, kTorn = 4, kOverturn = 40;
[[gnu::always_inline]] inline Four overturn(Four strain) {
  const Four past = (strain < kTorn ? strain : Four{} + kTorn) - kMostStrain;
  return kOverturn * (past > 0 ? past : Four{});
}
float overturn(float strain) {
  return kOverturn * std::max(0.0f, std::min(strain, kTorn) - kMostStrain);
}

}  // namespace

PoseCost::PoseCost(const Columns& columns, const PoseTask& task)
    : columns_(columns),
      step_(static_cast<float>(task.step)),
      slopeWeight_(task.slopes.weight),
      beyond_(kBeyond),
      at_(task.errors.size()),
      pulls_(task.errors.size()) {
  for (Index u = 0; u < vertexCount(); ++u) {
    Vertex& vertex = at_[u];
    const Vec3& e = task.errors[u];
    const float bound = task.bounds[u];
    vertex = {{static_cast<float>(e.x), static_cast<float>(e.y), static_cast<float>(e.z)},
              1 / (bound * bound),
              0,
              0,
              {}};
    const float stress = task.stress.empty() ? 1 : task.stress[u];
    for (int side = 0; side < 2; ++side) {
      const Slopes::Tangent& t = task.slopes.at[u][side];
      vertex.tangent[side] = {{stress * t.error[0], stress * t.error[1], stress * t.error[2]},
                              {t.normal[0], t.normal[1], t.normal[2]},
                              stress * t.lean,
                              stress * t.perLength,
                              0,
                              0};
    }
    refresh(u);
  }
}

void PoseCost::press(float times) {
  beyond_ = times * kBeyond;
  for (Index u = 0; u < vertexCount(); ++u) refresh(u);
}

void PoseCost::refresh(Index u) {
  Vertex& x = at_[u];
  Pull& pull = pulls_[u];
  const auto squared = [](const float* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  const auto four = [](const float* v) { return Four{v[0], v[1], v[2], 0}; };
  x.square = squared(x.error) * x.perSquare;
  x.penalty = penalty(Four{x.square}, beyond_)[0];
  pull.place = slope(x.square, beyond_) * x.perSquare * four(x.error);
  for (int side = 0; side < 2; ++side) {
    Tangent& t = x.tangent[side];
    t.strain = squared(t.error);
    t.overturn = overturn(t.strain);
    const float torn = t.strain > kMostStrain && t.strain < kTorn ? kOverturn : 0;
    pull.along[side] =
        t.perLength * (slopeWeight_ * t.lean * four(t.normal) + torn * four(t.error));
  }
}

float PoseCost::tilt(Index u) const {
  float sum = 0;
  for (const Tangent& t : at_[u].tangent) sum += slopeWeight_ * t.lean * t.lean + t.overturn;
  return sum;
}

PoseCost::Four PoseCost::growth(Index v, int a, Four steps) const {
  const Four x = steps * step_;
  Four sum = {}, tilted = {}, over = {};
  for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
    const Vertex& at = at_[columns_.vertex[p]];
    const auto& weight = columns_.weight[p];
    const Four shift = x * weight[0];
    sum +=
        penalty(at.square + (2 * at.error[a] + shift) * shift * at.perSquare, beyond_) - at.penalty;
    for (int side = 0; side < 2; ++side) {
      const Tangent& t = at.tangent[side];
      const Four change = x * (weight[1 + side] * t.perLength), turn = change * t.normal[a];
      tilted += (2 * t.lean + turn) * turn;
      over += overturn(t.strain + (2 * t.error[a] + change) * change) - t.overturn;
    }
  }
  return sum + slopeWeight_ * tilted + over;
}

PoseCost::Four PoseCost::gradient(Index v) const {
  Four sum = {};
  for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
    const Pull& pull = pulls_[columns_.vertex[p]];
    const auto& weight = columns_.weight[p];
    sum += weight[0] * pull.place + weight[1] * pull.along[0] + weight[2] * pull.along[1];
  }
  return 2 * step_ * sum;
}

void PoseCost::move(Index v, int a, float steps) {
  const float x = steps * step_;
  for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
    const Index u = columns_.vertex[p];
    const auto& weight = columns_.weight[p];
    at_[u].error[a] += x * weight[0];
    for (int side = 0; side < 2; ++side) {
      Tangent& t = at_[u].tangent[side];
      const float change = x * weight[1 + side] * t.perLength;
      t.error[a] += change;
      t.lean += change * t.normal[a];
    }
    refresh(u);
  }
}

}  // namespace sweepface
