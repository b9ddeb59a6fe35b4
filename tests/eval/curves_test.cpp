#include <algorithm>
#include <set>

#include "sweepface/eval.hpp"
#include "sweepface/ode.hpp"

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Curves : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(, Curves, eachFace(), faceName);

TEST_P(Curves, StartAndEndAtNodes) {
  const Surface surface = surfaceOf(GetParam().rig, 3);
  const CurveNetwork net = curveNetwork(surface, anyPose(surface), 3);
  const std::set<Index> nodes(net.nodes.begin(), net.nodes.end());
  EXPECT_EQ(nodes.size(), net.nodes.size());
  const auto& arcs = surface.wireframe().arcs;
  EXPECT_EQ(static_cast<std::ptrdiff_t>(net.boundary.size()),
            std::ranges::count(arcs, false, &Arc::collapsed));
  for (const Curve& curve : net.boundary) {
    EXPECT_EQ(static_cast<Index>(curve.points.size()), 3 * arcs[arcOf(curve.along)].edges + 1);
    EXPECT_TRUE(nodes.contains(curve.points.front()));
    EXPECT_TRUE(nodes.contains(curve.points.back()));
  }
}

TEST(CurveNetwork, OfAFanMeetsInItsPole) {
  const Surface surface = Surface::make(fan(4)).value();
  const CurveNetwork net = curveNetwork(surface, anyPose(surface), 3);
  EXPECT_EQ(net.nodes.size(), 5u);
  EXPECT_EQ(std::ranges::count(net.boundary, net.nodes[0],
                               [](const Curve& curve) { return curve.points.front(); }),
            4);
}

/// A boundary curve and its two control curves determine the cross-boundary derivatives.
TEST_P(Curves, HoldTheDerivativesAcross) {
  const Surface surface = surfaceOf(GetParam().rig, 3);
  const std::vector<Vec3> vectors = anyPose(surface);
  const CurveNetwork net = curveNetwork(surface, vectors, 2);
  for (std::size_t k = 0; k < net.control.size(); k += 2) {
    const Curve &second = net.control[k], &third = net.control[k + 1];
    ASSERT_EQ(second.along, third.along);
    const Site site = surface.siteOnArc(second.along, 0.5);
    const auto across =
        derivativesFromControls(surface.evaluate(vectors, site), net.points[second.points[1]],
                                net.points[third.points[1]], {0.1, 0.25});
    ASSERT_TRUE(across.has_value());
    // The direction across is u or v, whichever the arc does not follow, and is measured over the
    // whole patch rather than one edge.
    const auto differsBy = [&](bool alongV) {
      const double length = alongV ? surface.edgesV(site.patch) : surface.edgesU(site.patch);
      const auto derivative = [&](int order) {
        return surface.evaluate(vectors, site, alongV ? 0 : order, alongV ? order : 0);
      };
      const Vec3 first = length * derivative(1), d2 = length * length * derivative(2);
      return (std::min(norm(across->first - first), norm(across->first + first)) +
              norm(across->second - d2)) /
             (1 + norm(first) + norm(d2));
    };
    EXPECT_LE(std::min(differsBy(false), differsBy(true)), 1e-10);
  }
}

}  // namespace
}  // namespace sweepface
