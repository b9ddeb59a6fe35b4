#include <algorithm>
#include <cmath>
#include <limits>

#include "sweepface/arcs.hpp"
#include "sweepface/head.hpp"

#include "ode/elementary.hpp"

namespace sweepface {
namespace {

constexpr double kUsualLook = 0.5;  // radians at weight 1, for targets that turn no eye themselves

Vec3 acrossX(const Vec3& v) { return cross({1, 0, 0}, v); }
Vec3 acrossY(const Vec3& v) { return cross({0, 1, 0}, v); }

constexpr std::size_t kTerms = EyeTurns::kTerms;

/// A target: a term of the rotation, with a sign.
struct TurnTarget {
  std::string_view name;
  std::size_t term;
  double sign;
};
constexpr std::array<TurnTarget, EyeTurns::kTargets> kTurnTargets{{{".down", 0, 1},
                                                                   {".up", 0, -1},
                                                                   {".left", 1, 1},
                                                                   {".right", 1, -1},
                                                                   {".xx", 2, 1},
                                                                   {".yy", 3, 1},
                                                                   {".xy", 4, 1},
                                                                   {".yx", 4, -1}}};

/// Factors of the terms for a rotation vector (x, y, 0).
std::array<double, kTerms> factorsOf(double x, double y) {
  const double angle = std::sqrt(x * x + y * y);
  // sin θ / θ and (1 − cos θ) / θ², both smooth at 0.
  const double half = ode::sineCosine(angle / 2).sine;
  const double s = angle > 1e-8 ? ode::sineCosine(angle).sine / angle : 1;
  const double c = angle > 1e-8 ? 2 * half * half / (angle * angle) : 0.5;
  return {s * x, s * y, c * x * x, c * y * y, c * x * y};
}

std::array<Vec3, kTerms> termsOf(const Vec3& arm) {
  const Vec3 x = acrossX(arm), y = acrossY(arm);
  return {x, y, acrossX(x), acrossY(y), acrossX(y) + acrossY(x)};
}

/// A position relative to the centre of the eye; a derivative as it is.
Vec3 armOf(const Rig& rig, const Eye& eye, Index stored) {
  const Vec3& vector = rig.neutral[stored];
  return rig.surface.stored(stored).isPosition() ? vector - eye.centre : vector;
}

/// What turning by (x, y, 0) adds to a stored vector.
Vec3 added(const Rig& rig, const Eye& eye, Index stored, double x, double y) {
  const auto terms = termsOf(armOf(rig, eye, stored));
  const auto factors = factorsOf(x, y);
  Vec3 sum;
  for (std::size_t k = 0; k < kTerms; ++k) sum += factors[k] * terms[k];
  return sum;
}

/// The rotation vector by which a target turns an eye: a least-squares fit over the positions, both
/// components zero if the target does not move the eye.
struct Fit {
  double x = 0, y = 0;
  double moves = 0, left = 0;  // sums of squares: of the movements, and of what the turn leaves
};

double squaresLeft(const Rig& rig, const Eye& eye, const Target& target, double x, double y) {
  double sum = 0;
  for (const Index v : eye.stored)
    if (rig.surface.stored(v).isPosition()) {
      const Vec3 d = target.difference[v] - added(rig, eye, v, x, y);
      sum += dot(d, d);
    }
  return sum;
}

Fit fitTurn(const Rig& rig, const Eye& eye, const Target& target) {
  Fit fit;
  fit.moves = fit.left = squaresLeft(rig, eye, target, 0, 0);
  if (!(fit.moves > 0)) return fit;
  // Gauss-Newton with finite differences from no turn: two unknowns and a smooth function.
  constexpr double h = 1e-5;
  for (int round = 0; round < 20; ++round) {
    double xx = 0, xy = 0, yy = 0, rx = 0, ry = 0;
    for (const Index v : eye.stored) {
      if (!rig.surface.stored(v).isPosition()) continue;
      const Vec3 here = added(rig, eye, v, fit.x, fit.y);
      const Vec3 dx = (1 / h) * (added(rig, eye, v, fit.x + h, fit.y) - here);
      const Vec3 dy = (1 / h) * (added(rig, eye, v, fit.x, fit.y + h) - here);
      const Vec3 left = target.difference[v] - here;
      xx += dot(dx, dx), xy += dot(dx, dy), yy += dot(dy, dy);
      rx += dot(dx, left), ry += dot(dy, left);
    }
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 0)) break;
    const double x = (rx * yy - ry * xy) / determinant, y = (ry * xx - rx * xy) / determinant;
    fit.x += x, fit.y += y;
    if (x * x + y * y < 1e-24) break;
  }
  fit.left = squaresLeft(rig, eye, target, fit.x, fit.y);
  return fit;
}

}  // namespace

Quaternion quaternionOf(const Angles& angles) {
  const auto [sy, cy] = ode::sineCosine(angles.yaw / 2);
  const auto [sp, cp] = ode::sineCosine(angles.pitch / 2);
  const auto [sr, cr] = ode::sineCosine(angles.roll / 2);
  return {cy * sp * cr + sy * cp * sr, sy * cp * cr - cy * sp * sr, cy * cp * sr - sy * sp * cr,
          cy * cp * cr + sy * sp * sr};
}

Vec3 turned(const Quaternion& by, const Vec3& v) {
  const Vec3 axis{by[0], by[1], by[2]};
  const Vec3 t = 2 * cross(axis, v);
  return v + by[3] * t + cross(axis, t);
}

// ---- Clips ----

Angles betweenHands(const Angles& angles) {
  return {0 - angles.yaw, angles.pitch, 0 - angles.roll};
}

ClipAngles::ClipAngles(const Clip& clip) {
  const std::array<std::string, 9> names{"HeadYaw",     "HeadPitch",     "HeadRoll",
                                         "LeftEyeYaw",  "LeftEyePitch",  "LeftEyeRoll",
                                         "RightEyeYaw", "RightEyePitch", "RightEyeRoll"};
  columns_.fill(-1);
  const ClipMatch match = matchClip(clip, names);
  for (std::size_t k = 0; k < match.targets.size(); ++k)
    for (const Index angle : match.targets[k]) {
      columns_[angle] = static_cast<std::ptrdiff_t>(k);
      turns_[angle] = turns_[angle] || clip.moves(k);
    }
}

bool ClipAngles::tells(const std::string& name) {
  const ClipAngles angles(Clip{{name}, {}, {}});
  return std::ranges::any_of(angles.columns_, [](std::ptrdiff_t column) { return column >= 0; });
}

bool movesAnything(const Clip& clip, const ClipMatch& match) {
  return !std::ranges::all_of(match.targets, &std::vector<Index>::empty) ||
         std::ranges::all_of(clip.names, ClipAngles::tells);
}

HeadPose ClipAngles::at(const Clip& clip, double seconds) const noexcept {
  const Clip::Moment moment = clip.momentAt(seconds);
  const auto angles = [&](std::size_t first) {
    std::array<double, 3> three{};
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto c = columns_[first + k];
          c >= 0 && static_cast<std::size_t>(c) < clip.names.size())
        three[k] = clip.weight(moment, static_cast<std::size_t>(c));
    return betweenHands({three[0], three[1], three[2]});
  };
  return {angles(0), angles(3), angles(6)};
}

// ---- Eyes ----

EyeTurns EyeTurns::addTo(Rig& rig, std::span<const Eye> eyes) {
  EyeTurns turns;
  for (const Eye& eye : eyes) {
    Turning turning;
    turning.left = eye.centre.x >= 0;
    turning.stored = eye.stored;
    addLooks(rig, eye, turning);
    turning.first = static_cast<Index>(rig.targets.size());
    for (const auto& [name, term, sign] : kTurnTargets) {
      Target target{eye.name + std::string(name), std::vector<Vec3>(rig.neutral.size()),
                    std::vector<Vec3>(rig.source.loose.size())};
      for (const Index v : eye.stored)
        target.difference[v] = sign * termsOf(armOf(rig, eye, v))[term];
      while (rig.find(target.name) >= 0) target.name += '_';
      rig.targets.push_back(std::move(target));
    }
    turns.eyes_.push_back(std::move(turning));
  }
  return turns;
}

void EyeTurns::addLooks(Rig& rig, const Eye& eye, Turning& turning) {
  const double outwards = turning.left ? 1 : -1;
  const std::string side = turning.left ? "Left" : "Right";
  const Clip shapes{
      {"eyeLookDown" + side, "eyeLookUp" + side, "eyeLookOut" + side, "eyeLookIn" + side}, {}, {}};
  const std::array<std::array<double, 2>, 4> usual{
      {{1, 0}, {-1, 0}, {0, outwards}, {0, -outwards}}};
  const ClipMatch match = matchClip(shapes, rig.targetNames());
  const auto places = static_cast<double>(std::ranges::count_if(
      eye.stored, [&](Index v) { return rig.surface.stored(v).isPosition(); }));
  for (std::size_t k = 0; k < usual.size(); ++k)
    for (const Index index : match.targets[k]) {
      Target& target = rig.targets[index];
      const Fit fit = rig.knows(target) ? fitTurn(rig, eye, target) : Fit{};
      constexpr double kMoves = 0.02, kRigid = 0.1;  // of the radius, and of the movement
      if (!(fit.moves > places * kMoves * kMoves * eye.radius * eye.radius)) {
        turning.looks.push_back({index, kUsualLook * usual[k][0], kUsualLook * usual[k][1]});
      } else if (fit.left <= kRigid * kRigid * fit.moves) {
        turning.looks.push_back({index, fit.x, fit.y});
        for (const Index v : eye.stored) target.difference[v] -= added(rig, eye, v, fit.x, fit.y);
        // The arc target bends straight paths; the eye now turns by itself and must not follow it.
        if (const Index arc = rig.find(arcName(target.name)); arc >= 0)
          for (const Index v : eye.stored) rig.targets[arc].difference[v] = {};
      }
    }
}

/// `share(region, vector)` is the region's share of a stored vector.
template <typename Share>
void EyeTurns::keepWhole(std::size_t regions, const Share& share) const {
  for (const Turning& eye : eyes_) {
    std::size_t home = 0;
    double most = 0;
    for (std::size_t r = 0; r < regions; ++r) {
      double sum = 0;
      for (const Index v : eye.stored) sum += share(r, v);
      if (sum > most) home = r, most = sum;
    }
    for (std::size_t r = 0; r < regions; ++r)
      for (const Index v : eye.stored) share(r, v) = r == home ? 1 : 0;
  }
}

void EyeTurns::keepWhole(const Surface& surface, std::span<Region> regions) const {
  keepWhole(regions.size(), [&](std::size_t region, Index v) -> double& {
    return regions[region].shares[surface.stored(v).node];
  });
}

void EyeTurns::keepWhole(std::span<std::vector<float>> influences) const {
  keepWhole(influences.size(),
            [&](std::size_t region, Index v) -> float& { return influences[region][v]; });
}

void EyeTurns::set(const Turning& eye, const Factors& factors, std::span<double> weights) noexcept {
  for (std::size_t k = 0; k < kTargets; ++k)
    if (const auto t = static_cast<std::size_t>(eye.first) + k; t < weights.size())
      weights[t] = std::max(0.0, kTurnTargets[k].sign * factors[kTurnTargets[k].term]);
}

void EyeTurns::apply(std::span<double> weights) const noexcept {
  for (const Turning& eye : eyes_) {
    double x = 0, y = 0;
    for (const Look& look : eye.looks)
      if (const auto t = static_cast<std::size_t>(look.target); t < weights.size())
        x += weights[t] * look.x, y += weights[t] * look.y;
    set(eye, factorsOf(x, y), weights);
  }
}

void EyeTurns::apply(const HeadPose& pose, std::span<double> weights) const noexcept {
  for (const Turning& eye : eyes_) {
    const Angles& angles = eye.left ? pose.leftEye : pose.rightEye;
    // The rotation about an axis across the view that looks in the same direction.
    const Vec3 view = turned(quaternionOf({angles.yaw, angles.pitch, 0}), {0, 0, 1});
    const double x = -view.y, y = view.x;  // sin θ times the axis
    // (1 − cos θ) / sin² θ, in whichever form does not cancel.
    constexpr double kLeast = std::numeric_limits<double>::min();
    const double c = view.z > 0 ? 1 / (1 + view.z) : (1 - view.z) / std::max(x * x + y * y, kLeast);
    set(eye, {x, y, c * x * x, c * y * y, c * x * y}, weights);
  }
}

}  // namespace sweepface
