#include <numbers>

#include "sweepface/fit.hpp"

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// A polynomial of degree ≤ 5 in u and in v, and its derivatives.
struct Polynomial {
  Vec3 coefficient(int a, int b) const { return anyVector(6 * a + b); }
  static double power(double x, int exponent, int order) {
    double factor = 1;
    for (int k = 0; k < order; ++k) factor *= exponent - k;
    return factor == 0 ? 0 : factor * std::pow(x, exponent - order);
  }
  Vec3 at(double u, double v, int du, int dv) const {
    Vec3 sum;
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) sum += power(u, a, du) * power(v, b, dv) * coefficient(a, b);
    return sum;
  }
};

// A corner's place in (u, v) and its axes (α, β): whether α runs along u, and their directions.
struct CornerAxes {
  int u, v;
  bool alphaIsU;
  double alphaSign, betaSign;
};
constexpr CornerAxes corners[4] = {
    {0, 0, true, 1, 1}, {1, 0, false, 1, -1}, {1, 1, true, -1, -1}, {0, 1, false, -1, 1}};

TEST(Patch, reproducesPolynomialsOfDegreeFive) {
  Wireframe w = onePatch(3, 2);
  w.ribbons = {{}, {}};
  const Surface surface = Surface::make(w).value();
  const Polynomial polynomial;
  std::vector<Vec3> pose(surface.vectorCount());
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const CornerAxes& c = corners[k];
        const JetRef ref = surface.cornerJet(0, k, i, j);
        const double sign = ref.sign * std::pow(c.alphaSign, i) * std::pow(c.betaSign, j);
        pose[ref.vector] =
            sign * polynomial.at(3 * c.u, 2 * c.v, c.alphaIsU ? i : j, c.alphaIsU ? j : i);
      }
  for (const Site& s : sitesOf(surface, 0))
    for (int du = 0; du < 4; ++du)
      for (int dv = 0; dv < 4; ++dv) {
        const Vec3 expected = polynomial.at(s.u, s.v, du, dv);
        EXPECT_LT(norm(surface.evaluate(pose, s, du, dv) - expected),
                  1e-10 * (1 + norm(polynomial.at(3, 2, du, dv))))
            << s.u << ", " << s.v << " order " << du << ", " << dv;
      }
}

TEST(Patch, isAParabolaWhereItsCornersTellOnlyTheirSlopes) {
  Wireframe w = onePatch(3, 2);
  for (Node& node : w.nodes) node.stored = 1 | 1 << 1 | 1 << 3;
  w.ribbons = {{}, {}};
  const Surface surface = Surface::make(w).value();
  std::vector<Vec3> pose(surface.vectorCount());
  for (int k = 0; k < 4; ++k) {
    const CornerAxes& c = corners[k];
    const double u = 3 * c.u, v = 2 * c.v;
    const auto tell = [&](int i, int j, const Vec3& value) {
      const JetRef ref = surface.cornerJet(0, k, i, j);
      pose[ref.vector] = ref.sign * value;
    };
    const Vec3 alongU{2 * u, 0, 0}, alongV{0, 2 * v, 0};
    tell(0, 0, {u * u, v * v, 0});
    tell(1, 0, c.alphaSign * (c.alphaIsU ? alongU : alongV));
    tell(0, 1, c.betaSign * (c.alphaIsU ? alongV : alongU));
  }
  surface.settle({pose.data(), static_cast<std::size_t>(surface.storedCount())}, pose);
  for (const Site& s : sitesOf(surface, 0))
    EXPECT_LT(norm(surface.evaluate(pose, s) - Vec3{s.u * s.u, s.v * s.v, 0}), 1e-12);
}

TEST(Patch, hasTheSameWeightsFromTheTableOfItsBases) {
  Wireframe w = onePatch(5, 40);  // one side is long
  const Surface surface = Surface::make(w).value();
  const Surface::PatchBasis basis = surface.patchBasis(0);
  for (const double u : {0.0, 1.0, 2.5, 4.0, 5.0, 5.5, -1.0})
    for (const double v : {0.0, 0.25, 3.0, 39.0, 40.0})
      for (int du = 0; du < 4; ++du)
        for (int dv = 0; dv < 4; ++dv) {
          const Surface::Weights own = surface.weights({0, u, v}, du, dv);
          EXPECT_EQ(own.factors, surface.weights({0, u, v}, basis, du, dv).factors)
              << u << ' ' << v;
        }
}

// φ = x^k (1 − x²)⁴ and its first three derivatives vanish at ±1, so integration by parts against
// φ reduces the sixth derivative of S to the second.
class TestFunction {
 public:
  explicit TestFunction(std::size_t k) : coefficients_(k + 9, 0) {
    for (auto [power, c] : {std::pair<std::size_t, double>{0, 1}, {2, -4}, {4, 6}, {6, -4}, {8, 1}})
      coefficients_[k + power] = c;
  }
  double at(double x, int order) const {
    double sum = 0;
    for (std::size_t p = 0; p < coefficients_.size(); ++p)
      sum += coefficients_[p] * Polynomial::power(x, static_cast<int>(p), order);
    return sum;
  }

 private:
  std::vector<double> coefficients_;
};

class SweepingEquation : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Patch, SweepingEquation,
                         ::testing::Values(Shape{1, 0, 0}, Shape{1, -0.5, 0.25}, Shape{2, -9, 4},
                                           Shape{1, 0, 3}, Shape{1, -20, 0}, Shape{3, -1, 1e-9}));

TEST_P(SweepingEquation, holdsAlongEverySweep) {
  const auto [rho, eta, lambda] = GetParam();
  Wireframe w = onePatch(3, 2);
  w.ribbons = {GetParam(), {1, -0.5, 0.25}};
  const Surface surface = Surface::make(w).value();
  const auto pose = anyPose(surface);
  for (double v : {0.0, 0.4, 1.1, 2.0})
    for (std::size_t k = 0; k < 4; ++k) {
      const TestFunction phi(k);
      constexpr int steps = 4000;
      Vec3 residual, largest;
      for (int s = 0; s <= steps; ++s) {  // Simpson
        const double x = 2.0 * s / steps - 1, weight = (s == 0 || s == steps ? 1
                                                        : s % 2              ? 4
                                                                             : 2) /
                                                       (1.5 * steps);
        const Vec3 second = surface.evaluate(pose, {0, 1.5 * (x + 1), v}, 2, 0);
        const double f4 = phi.at(x, 4) / std::pow(1.5, 4), f2 = phi.at(x, 2) / std::pow(1.5, 2),
                     f0 = phi.at(x, 0);
        residual += weight * (rho * f4 + eta * f2 + lambda * f0) * second;
        const Vec3 size{std::abs(second.x), std::abs(second.y), std::abs(second.z)};
        largest +=
            weight * (rho * std::abs(f4) + std::abs(eta * f2) + lambda * std::abs(f0)) * size;
      }
      EXPECT_LT(norm(residual), 1e-8 * norm(largest));
    }
}

TEST(Derivatives, areThoseOfThePoints) {
  constexpr double h = 1e-4;
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const auto pose = anyPose(surface);
    const double size = largest(pose);
    for (Index p = 0; p < surface.patchCount(); ++p) {
      const Site at{p, 0.37 * surface.edgesU(p), 0.61 * surface.edgesV(p)};
      for (auto [du, dv] : {std::pair{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}) {
        const bool alongU = du > 0;
        Site before = at, after = at;
        (alongU ? before.u : before.v) -= h;
        (alongU ? after.u : after.v) += h;
        const int lowU = du - alongU, lowV = dv - !alongU;
        const Vec3 difference = (surface.evaluate(pose, after, lowU, lowV) -
                                 surface.evaluate(pose, before, lowU, lowV)) *
                                (0.5 / h);
        EXPECT_LT(norm(surface.evaluate(pose, at, du, dv) - difference), 1e-5 * size) << du << dv;
      }
    }
  }
}

TEST(Weights, areThoseOfEvaluate) {
  const Surface surface = surfaceOf(MeshRig{dart(5), {}}, 5);
  const auto pose = anyPose(surface);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (const Site& s : sitesOf(surface, p)) {
      const auto w = surface.weights(s, 1, 1);
      Vec3 sum;
      for (std::size_t k = 0; k < 36; ++k) sum += w.factors[k] * pose[w.vectors[k]];
      EXPECT_EQ(sum, surface.evaluate(pose, s, 1, 1));
    }
}

TEST(Weights, addUpToOneWhereverTheSurfaceIs) {
  for (const auto& [name, surface] : everySurface()) {
    std::vector<Vec3> pose(surface.vectorCount());
    for (Index v = 0; v < surface.storedCount(); ++v)
      if (surface.stored(v).i == 0 && surface.stored(v).j == 0) pose[v] = {1, -2, 3};
    surface.settle({pose.data(), static_cast<std::size_t>(surface.storedCount())}, pose);
    for (Index p = 0; p < surface.patchCount(); ++p)
      for (const Site& s : sitesOf(surface, p))
        EXPECT_LT(norm(surface.evaluate(pose, s) - Vec3{1, -2, 3}), 1e-12) << name;
  }
}

TEST(Arcs, arePointsOfBothTheirPatches) {
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const auto pose = anyPose(surface);
    const Wireframe& w = surface.wireframe();
    for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a)
      for (double share : {0.0, 0.3, 0.75, 1.0}) {
        const double t = share * w.arcs[a].edges;
        const Vec3 point = surface.pointOnArc(pose, a, t);
        for (HalfArc h : {2 * a, 2 * a + 1})
          if (surface.connectivity().patchOf[h] >= 0) {
            const Site site = surface.siteOnArc(h, h & 1 ? w.arcs[a].edges - t : t);
            EXPECT_LT(norm(surface.evaluate(pose, site) - point), 1e-12 * largest(pose))
                << "arc " << a;
          }
      }
  }
}

TEST(Linearity, aBlendOfPosesIsTheBlendOfTheirPoints) {
  for (const auto& [name, surface] : everySurface()) {
    const auto a = anyPose(surface), b = anyPose(surface, 1000), c = anyPose(surface, 2000);
    std::vector<Vec3> mixed(surface.vectorCount());
    for (Index v = 0; v < surface.storedCount(); ++v)
      mixed[v] = 0.3 * a[v] + 1.7 * b[v] - 0.4 * c[v];
    surface.settle({mixed.data(), static_cast<std::size_t>(surface.storedCount())}, mixed);
    for (Index p = 0; p < surface.patchCount(); ++p)
      for (const Site& s : sitesOf(surface, p)) {
        const Vec3 expected = 0.3 * surface.evaluate(a, s) + 1.7 * surface.evaluate(b, s) -
                              0.4 * surface.evaluate(c, s);
        EXPECT_LT(norm(surface.evaluate(mixed, s) - expected), 1e-12 * largest(mixed)) << name;
      }
  }
}

TEST(Settling, worksInPlaceOrBeside) {
  const Surface surface = surfaceOf(MeshRig{cubeSphere(4), {}}, 4);
  const auto pose = anyPose(surface);
  const std::vector<Vec3> stored(pose.begin(), pose.begin() + surface.storedCount());
  std::vector<Vec3> beside(surface.vectorCount());
  surface.settle(stored, beside);
  EXPECT_EQ(beside, pose);
}

TEST(Normal, ofASphereIsUprightAtItsPoles) {
  ConvertOptions options;
  options.tolerance = 0.01;
  options.chooseShapes = false;
  const Rig rig = convert(MeshRig{uvSphere(), {}}, options).value().rig;
  const auto pose = blend(rig, {});
  int poles = 0;
  for (Index p = 0; p < rig.surface.patchCount(); ++p)
    for (const Site& s : sitesOf(rig.surface, p)) {
      const Vec3 place = rig.surface.evaluate(pose, s);
      if (std::hypot(place.x, place.y) > 1e-2) continue;
      ++poles;
      const Vec3 n = rig.surface.normal(pose, s);
      EXPECT_LT(std::hypot(n.x, n.y), std::sin(0.2 * std::numbers::pi / 180)) << p;
      EXPECT_GT(n.z * place.z, 0) << p;
    }
  EXPECT_GT(poles, 1);
}

TEST(Normal, isFiniteAndOfUnitLengthAtAPole) {
  const Surface surface = surfaceOf(MeshRig{uvSphere(), {}}, 6);
  const auto pose = anyPose(surface);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (const Site& s : sitesOf(surface, p)) {
      const Vec3 n = surface.normal(pose, s);
      EXPECT_TRUE(isFinite(n));
      EXPECT_NEAR(norm(n), 1, 1e-12);
    }
}

}  // namespace
}  // namespace sweepface
