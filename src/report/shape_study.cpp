#include "report/shape_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sweepface {
namespace {

/// eta h² / rho and lambda h⁴ / rho for a sweep of length h: from none to as stiff as a stretched
/// skin.
constexpr std::array<std::pair<double, double>, 4> kShapes{
    {{0, 0}, {-10'000, 0}, {0, 30'000}, {0, 3'000'000}}};
constexpr Index kSteps = 40;

class SweptPatch {
 public:
  SweptPatch(const Surface& surface, std::span<const Vec3> vectors, Index patch)
      : surface_(surface),
        vectors_(vectors),
        patch_(patch),
        m_(surface.edgesU(patch)),
        n_(surface.edgesV(patch)) {}

  /// The sweep's basis for parameters relative to its whole length.
  Result<SweepBasis> basis(double eta, double lambda) const {
    return SweepBasis::make({1, eta / (m_ * m_), lambda / (m_ * m_ * m_ * m_)}, m_);
  }

  /// ∂u^du ∂v^dv at fractions s, t of the way along u and v.
  Vec3 at(const SweepBasis& sweep, double s, double t, int du = 0, int dv = 0) const {
    Surface::PatchBasis bases = surface_.patchBasis(patch_);
    bases.u = &sweep;
    const auto w = surface_.weights({patch_, s * m_, t * n_}, bases, du, dv);
    Vec3 sum;
    for (std::size_t k = 0; k < w.vectors.size(); ++k) sum += w.factors[k] * vectors_[w.vectors[k]];
    return sum;
  }

  Vec3 normal(const SweepBasis& sweep, double s, double t) const {
    return normalized(cross(at(sweep, s, t, 1, 0), at(sweep, s, t, 0, 1)));
  }

  /// The largest distance between two sweeps.
  double distance(const SweepBasis& a, const SweepBasis& b, Index steps) const {
    double largest = 0;
    for (Index j = 0; j <= steps; ++j)
      for (Index i = 0; i <= steps; ++i) {
        const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
        largest = std::max(largest, norm(at(a, s, t) - at(b, s, t)));
      }
    return largest;
  }

  /// The side of a square of the same area.
  double size(const SweepBasis& sweep) const {
    const Vec3 a = at(sweep, 1, 1) - at(sweep, 0, 0), b = at(sweep, 0, 1) - at(sweep, 1, 0);
    return std::sqrt(0.5 * norm(cross(a, b)));
  }

  Scene scene(const SweepBasis& sweep) const {
    Scene scene;
    const auto place = [](Index k) { return static_cast<double>(k) / kSteps; };
    for (Index j = 0; j <= kSteps; ++j)
      for (Index i = 0; i <= kSteps; ++i) {
        scene.positions.push_back(at(sweep, place(i), place(j)));
        scene.normals.push_back(normal(sweep, place(i), place(j)));
      }
    for (Index j = 0; j < kSteps; ++j)
      for (Index i = 0; i < kSteps; ++i) {
        const Index a = j * (kSteps + 1) + i, b = a + kSteps + 1;
        scene.triangles.push_back({a, a + 1, b + 1});
        scene.triangles.push_back({a, b + 1, b});
      }
    scene.colour = {0.87f, 0.83f, 0.79f};
    scene.finish = Finish::skin;
    for (int k = 0; k <= 8; ++k) {
      Stroke alongU{{}, {0.10f, 0.42f, 0.66f}, k % 8 == 0 ? 5.0 : 2.0}, alongV = alongU;
      for (Index step = 0; step <= kSteps; ++step) {
        alongU.points.push_back(at(sweep, place(step), k / 8.0));
        alongV.points.push_back(at(sweep, k / 8.0, place(step)));
      }
      scene.strokes.push_back(alongU);
      scene.strokes.push_back(alongV);
    }
    return scene;
  }

  /// Heights along the middle of the sweep in the direction in which `plain` rises.
  std::vector<Vec2> profile(const SweepBasis& sweep, const SweepBasis& plain) const {
    const Vec3 first = at(plain, 0, 0.5), last = at(plain, 1, 0.5);
    const auto over = [&](const SweepBasis& b, double s) {
      return at(b, s, 0.5) - (first + s * (last - first));
    };
    Vec3 up;
    for (const double s : {0.25, 0.5, 0.75})
      if (norm(over(plain, s)) > norm(up)) up = over(plain, s);
    up = normalized(norm(up) > 0 ? up : normal(plain, 0.5, 0.5));
    std::vector<Vec2> points;
    for (Index k = 0; k <= kSteps; ++k) {
      const double s = static_cast<double>(k) / kSteps;
      points.push_back({s, dot(up, over(sweep, s))});
    }
    return points;
  }

 private:
  const Surface& surface_;
  std::span<const Vec3> vectors_;
  Index patch_;
  double m_, n_;
};

bool hasFourSides(const Surface& surface, Index patch) {
  const Wireframe& w = surface.wireframe();
  for (int s = 0; s < 4; ++s)
    if (std::ranges::any_of(w.side(patch, s),
                            [&](HalfArc h) { return w.arcs[arcOf(h)].collapsed; }))
      return false;
  return true;
}

/// Of the larger patches, the one that strong parameters move most.
Index mostTelling(const Surface& surface, std::span<const Vec3> vectors) {
  const SweepBasis plain;
  double largest = 0;
  std::vector<std::pair<Index, double>> sizes;
  for (Index p = 0; p < surface.patchCount(); ++p)
    if (hasFourSides(surface, p)) {
      sizes.emplace_back(p, SweptPatch(surface, vectors, p).size(plain));
      largest = std::max(largest, sizes.back().second);
    }
  Index best = -1;
  double furthest = -1;
  for (const auto& [p, size] : sizes) {
    if (size < 0.6 * largest) continue;
    const SweptPatch patch(surface, vectors, p);
    const auto none = patch.basis(0, 0), strong = patch.basis(0, 30'000);
    if (!none || !strong) continue;
    if (const double moved = patch.distance(*none, *strong, 6) / size; moved > furthest)
      best = p, furthest = moved;
  }
  return best;
}

/// A view from the side, to show how it bulges.
View viewOf(const Vec3& normal) {
  constexpr double degree = std::numbers::pi / 180;
  const double elevation = std::asin(std::clamp(normal.y, -1.0, 1.0)) / degree;
  return {std::atan2(normal.x, normal.z) / degree + 48,
          std::clamp(elevation + (elevation > 40 ? -30.0 : 22.0), -80.0, 80.0)};
}

}  // namespace

ShapeStudy studyShapes(const Surface& surface, std::span<const Vec3> vectors) {
  ShapeStudy study;
  study.patch = mostTelling(surface, vectors);
  if (study.patch < 0) return study;
  const SweptPatch patch(surface, vectors, study.patch);
  const auto plain = patch.basis(0, 0);
  if (!plain) return study;
  study.view = viewOf(patch.normal(*plain, 0.5, 0.5));
  for (const auto& [eta, lambda] : kShapes) {
    const auto basis = patch.basis(eta, lambda);
    if (!basis) continue;
    study.shapes.push_back({eta, lambda, patch.scene(*basis),
                            patch.distance(*plain, *basis, kSteps), patch.profile(*basis, *plain)});
  }
  return study;
}

}  // namespace sweepface
