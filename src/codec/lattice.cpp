#include "codec/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "codec/bones.hpp"
#include "codec/kriging.hpp"
#include "codec/limits.hpp"

namespace sweepface::codec {

namespace {

std::int32_t nearest(double steps) {
  if (!(steps == steps)) return 0;
  return static_cast<std::int32_t>(std::lround(std::clamp<double>(steps, -kFarthest, kFarthest)));
}

Vec3 predict(std::span<const Term> terms, std::span<const Vec3> known) {
  Vec3 sum;
  for (const Term& t : terms) sum += t.factor * known[t.vector];
  return sum;
}

Vec3 scaled(const Steps3& steps, double unit) {
  return {steps[0] * unit, steps[1] * unit, steps[2] * unit};
}

}  // namespace

void Lattice::learn(const Surface& surface, std::span<const Vec3> neutral, double step) {
  constexpr double kTurned = 20;  // steps
  if (step > 0) moves_ = predictMoves(surface, hierarchy_, neutral, kTurned * step);
}

Coefficients Lattice::round(Index pose, std::span<const Vec3> vectors, double step,
                            Coefficients coefficients, std::span<const char> isFree) const {
  const Prediction& prediction = this->prediction(pose);
  std::vector<Vec3> known(vectors.size());
  for (const Prediction::Step& s : prediction.steps) {
    const double unit = step / s.reach;
    const Vec3 expected = predict(prediction.of(s), known), rest = vectors[s.vector] - expected;
    if (isFree[s.vector])
      coefficients[s.vector] = {nearest(rest.x / unit), nearest(rest.y / unit),
                                nearest(rest.z / unit)};
    known[s.vector] = expected + scaled(coefficients[s.vector], unit);
  }
  return coefficients;
}

bool Lattice::restore(Index pose, const Coefficients& coefficients, double step,
                      std::span<Vec3> vectors) const {
  const Sparse moved = movedIn(coefficients);
  return restore(prediction(pose), std::array{Restored{moved, step, vectors}});
}

namespace {

// The same vector in four poses, so that one pass over the terms serves all of them: the four x,
// then y, then z.
constexpr std::size_t kAbreast = 4;
/// For SIMD on any processor; each lane computes exactly what a scalar would.
using Two [[gnu::vector_size(16)]] = double;
using Abreast = std::array<Two, 6>;

// Compilers allow a SIMD vector to be accessed through its element type.
double* numberOf(Abreast& vector, std::size_t pose, std::size_t axis) {
  return reinterpret_cast<double*>(vector.data()) + kAbreast * axis + pose;
}

// `known` holds the steps of all vectors on entry and their values on return. False if any is too
// large.
bool complete(const Prediction& prediction, const std::array<Two, 2>& step, Abreast* known) {
  Two scaled{};  // finite until a value is too large
  for (const Prediction::Step& s : prediction.steps) {
    const std::array<Two, 2> unit{step[0] / s.reach, step[1] / s.reach};
    Abreast sum{}, &own = known[s.vector];
    for (const Term& t : prediction.of(s))
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += t.factor * known[t.vector][k];
    for (std::size_t k = 0; k < sum.size(); ++k) {
      own[k] = sum[k] + own[k] * unit[k % 2];
      scaled += kScaleToMost * own[k];
    }
  }
  return std::isfinite(scaled[0]) && std::isfinite(scaled[1]);
}

}  // namespace

bool Lattice::restore(const Prediction& prediction, std::span<const Restored> poses) const {
  std::vector<Abreast> known;
  bool fit = true;
  while (!poses.empty()) {
    const auto now = poses.first(std::min(kAbreast, poses.size()));
    poses = poses.subspan(now.size());
    known.assign(prediction.steps.size(), {});
    std::array<Two, 2> step{};
    for (std::size_t p = 0; p < now.size(); ++p) {
      step[p / 2][p % 2] = now[p].step;
      for (const Moved& m : now[p].moved)
        for (std::size_t a = 0; a < 3; ++a) *numberOf(known[m.vector], p, a) = m.steps[a];
    }
    fit &= complete(prediction, step, known.data());
    for (std::size_t v = 0; v < known.size(); ++v)
      for (std::size_t p = 0; p < now.size(); ++p) {
        const double* const x = numberOf(known[v], p, 0);
        now[p].vectors[v] = {x[0], x[kAbreast], x[2 * kAbreast]};
      }
  }
  return fit;
}

Coefficients Lattice::image(const Coefficients& coefficients) const {
  Coefficients image(coefficients.size());
  for (const Moved& m : moved(coefficients, true, 0)) image[m.vector] = m.steps;
  return image;
}

std::vector<Index> Lattice::mirrorsOf(const Hierarchy& hierarchy) {
  const auto& images = hierarchy.images();
  std::vector<Index> mirrors(images.size(), -1);
  for (Index v = 0; v < static_cast<Index>(images.size()); ++v)
    if (images[v].vector >= 0) mirrors[images[v].vector] = v;
  return mirrors;
}

Sparse Lattice::moved(const Sparse& moved, bool mirrored, int finer) const {
  Sparse result;
  result.reserve(moved.size());
  for (const Moved& m : moved) {
    const Steps3 steps = inFinerSteps(m.steps, finer);
    if (!mirrored)
      result.push_back({m.vector, steps});
    else if (const Index image = mirrors_[m.vector]; image >= 0)
      result.push_back({image, reflected(steps, hierarchy_.images()[image].sign, axis_)});
  }
  return result;
}

Sparse movedIn(const Coefficients& coefficients) {
  Sparse moved;
  const auto first = coefficients.begin(), end = coefficients.end();
  for (auto at = first; (at = std::find_if(at, end, isMoved)) != end; ++at)
    moved.push_back({static_cast<Index>(at - first), *at});
  return moved;
}

Packing sound(const Rig& rig) {
  Packing packing = rig.packing;
  if (!(packing.neutralStep > 0) || !(packing.targetStep > 0))
    packing.neutralStep = packing.targetStep = 0;
  packing.axis = std::clamp(packing.axis, 0, 2);
  packing.textureBits = std::clamp(packing.textureBits, 0, kMostTextureBits);
  const auto halves = static_cast<HalfArc>(2 * rig.surface.wireframe().arcs.size());
  std::erase_if(packing.mirror, [&](const auto& pair) {
    return std::ranges::min(pair) < 0 || std::ranges::max(pair) >= halves;
  });
  if (packing.mirror.size() > kMostMirrorPairs) packing.mirror.resize(kMostMirrorPairs);
  if (packing.rest.size() != rig.neutral.size()) packing.rest.clear();
  packing.poses.resize(rig.targets.size() + 1);
  for (Index pose = 0; pose < static_cast<Index>(packing.poses.size()); ++pose) {
    Packing::Pose& form = packing.poses[pose];
    form.finer = std::clamp(form.finer, 0, kMostFiner);
    if (form.image > pose || form.image < 0 || (form.image == 0 && pose > 0)) form.image = -1;
  }
  makeBonesSound(packing, rig.neutral.size());
  return packing;
}

}  // namespace sweepface::codec
