#include <gtest/gtest.h>
#include <random>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

PolygonMesh anyMesh(std::mt19937& random) {
  const auto size = [&](Index least) { return least + static_cast<Index>(random() % 8); };
  switch (random() % 7) {
    case 0:
      return plane(size(4), size(4));
    case 1:
      return cylinder(size(6), size(4), random() % 2);
    case 2:
      return torus(size(8), size(6));
    case 3:
      return annulus(size(8), size(3));
    case 4:
      return cubeSphere(2 + static_cast<Index>(random() % 4));
    case 5:
      return uvSphere(size(6), size(5));
    default:
      return joined(plane(size(3), size(3)), cubeSphere(3, 2), {4, 3, 12});
  }
}

/// A mesh with smooth and rough targets in units from micrometres to kilometres.
MeshRig anyRig(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  MeshRig rig{anyMesh(random), {}};
  const double unit = std::pow(10, std::uniform_int_distribution<int>(-6, 5)(random));
  const std::size_t targets = random() % 4;
  for (std::size_t k = 0; k < targets; ++k) {
    MeshTarget target;
    target.name = "t" + std::to_string(k);
    target.positions = rig.neutral.positions;
    const double rough = random() % 2 ? 0.3 : 0.002, smooth = random() % 2 ? 1 : 0;
    const double a = share(random), b = share(random);
    for (Vec3& p : target.positions) {
      const double wave = smooth * std::sin(a * p.x + b * p.y);
      p += {wave + rough * share(random), rough * share(random), wave * 0.5};
    }
    rig.targets.push_back(std::move(target));
  }
  for (Vec3& p : rig.neutral.positions) p = unit * p;
  for (MeshTarget& target : rig.targets)
    for (Vec3& p : target.positions) p = unit * p;
  return rig;
}

double worst(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  double most = 0;
  for (std::size_t k = 0; k <= rig.targets.size(); ++k) {
    Weights weights(rig.targets.size(), 0.0);
    if (k > 0) weights[k - 1] = 1;
    const auto found = sourcePositions(rig, grid, blend(rig, weights), weights);
    const auto& goal = k == 0 ? source.neutral.positions : source.targets[k - 1].positions;
    for (std::size_t v = 0; v < found.size(); ++v) {
      const double distance = norm(found[v] - goal[v]);
      if (!(distance <= most)) most = distance;
    }
  }
  return most;
}

void expectBounds(unsigned first, unsigned count) {
  for (unsigned seed = first; seed < first + count; ++seed) {
    const MeshRig source = anyRig(seed);
    ConvertOptions options;
    options.tolerance = diagonal(source.neutral) * std::pow(10, -2.0 - seed % 3);
    const auto conversion = convert(source, options);
    ASSERT_TRUE(conversion) << seed << ": " << conversion.error().message;
    const std::string bytes = encode(conversion->rig);
    const auto back = decode(bytes, "face");
    ASSERT_TRUE(back) << seed << ": " << back.error().message;
    EXPECT_LE(worst(*back, source), options.tolerance) << seed;
    EXPECT_EQ(encode(*back), bytes) << seed;
    const auto parts = fileParts(bytes, "face").value();
    for (const FilePart& part : parts) EXPECT_NE(part.name, "exact vectors") << seed;
  }
}

TEST(RandomRigs, StayWithinTheirToleranceThroughAFile) { expectBounds(0, 12); }
TEST(RandomRigsLong, StayWithinTheirToleranceThroughAFile) { expectBounds(100, 300); }

}  // namespace
}  // namespace sweepface
