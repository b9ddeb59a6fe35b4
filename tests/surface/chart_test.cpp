#include "surface/chart.hpp"

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using Complex = std::complex<double>;

void expectNear(Complex a, Complex b) { EXPECT_LT(std::abs(a - b), 1e-12) << a << " is not " << b; }

TEST(CharacteristicMap, isTheIdentityOnAValenceOfFour) {
  for (double scale : {1.0, 2.5}) {
    const PlaneJet jet = characteristicCorner(0, turn(0.25), scale);
    for (std::size_t k = 0; k < 9; ++k)
      expectNear(jet[k], k == 3 ? Complex(1) : k == 1 ? Complex(0, 1) : Complex(0));
    const auto spoke = characteristicSpoke(0, turn(0.25), scale);
    expectNear(spoke[0], 1);
    expectNear(spoke[1], 0);
  }
}

class Valence : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(CharacteristicMap, Valence, ::testing::Values(3, 4, 5, 6, 7, 8, 12));

TEST_P(Valence, turnsFromSectorToSector) {
  const double step = turn(1.0 / GetParam());
  const PlaneJet first = characteristicCorner(0, step, 1.5),
                 second = characteristicCorner(step, step, 1.5);
  for (std::size_t k = 0; k < 9; ++k) expectNear(second[k], std::polar(1.0, step) * first[k]);
}

TEST_P(Valence, sectorsMeetAlongTheirSpokes) {
  const double step = turn(1.0 / GetParam());
  const PlaneJet jet = characteristicCorner(0, step, 1.5);
  const auto spoke = characteristicSpoke(0, step, 1.5), next = characteristicSpoke(step, step, 1.5);
  for (std::size_t order : {1u, 2u}) {
    expectNear(jet[3 * order], spoke[order - 1]);
    expectNear(jet[order], next[order - 1]);
  }
}

TEST_P(Valence, isSymmetricAboutASectorsMiddle) {
  const double step = turn(1.0 / GetParam());
  const PlaneJet jet = characteristicCorner(0, step, 2);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      expectNear(jet[3 * i + j], std::polar(1.0, step) * std::conj(jet[3 * j + i]));
}

TEST_P(Valence, keepsItsOrientation) {
  const PlaneJet jet = characteristicCorner(0.3, turn(1.0 / GetParam()), 1);
  EXPECT_GT((std::conj(jet[3]) * jet[1]).imag(), 0.1);
}

// The arms dₖ are affine images of those of the regular star, which lie at angles kθ.
void expectAffineStar(const Surface& surface, Index node) {
  const auto pose = anyPose(surface);
  const Star& star = surface.connectivity().stars[node];
  const double step = turn(1.0 / static_cast<double>(star.arms.size()));
  const auto along = [&](std::size_t k) {
    const JetRef ref = surface.alongJet(star.arms[k], 1);
    return ref.sign * pose[ref.vector];
  };
  const Vec3 a = along(0), b = (along(1) - std::cos(step) * a) * (1 / std::sin(step));
  for (std::size_t k = 2; k < star.arms.size(); ++k) {
    const double angle = step * static_cast<double>(k);
    EXPECT_LT(norm(along(k) - std::cos(angle) * a - std::sin(angle) * b), 1e-12 * largest(pose))
        << "arm " << k;
  }
}

TEST(Spokes, leaveAnIrregularNodeAsAnAffineStar) {
  for (const PolygonMesh& mesh : {cubeSphere(4), pinwheel(5), pinwheel(6), pinwheel(9)}) {
    const Surface surface = surfaceOf(MeshRig{mesh, {}});
    int seen = 0;
    for (Index n = 0; n < static_cast<Index>(surface.wireframe().nodes.size()); ++n) {
      const Star& star = surface.connectivity().stars[n];
      const bool pole = std::ranges::any_of(
          star.arms, [&](HalfArc h) { return surface.wireframe().arcs[arcOf(h)].collapsed; });
      if (surface.connectivity().kinds[n] != NodeKind::irregular || !star.closed || pole) continue;
      ++seen;
      expectAffineStar(surface, n);
    }
    EXPECT_GT(seen, 0);
  }
}

}  // namespace
}  // namespace sweepface
