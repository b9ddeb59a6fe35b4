#include "eval/planes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace sweepface {
namespace {

class Numbers : public ::testing::TestWithParam<int> {
 protected:
  std::vector<float> some(float most) {
    std::vector<float> values(GetParam());
    std::uniform_real_distribution<float> any(-most, most);
    for (float& x : values) x = any(random_);
    return values;
  }

 private:
  std::mt19937 random_{7};
};
INSTANTIATE_TEST_SUITE_P(Planes, Numbers, ::testing::Values(0, 8, 24, 120));

TEST_P(Numbers, HaveAnExtent) {
  const std::vector<float> values = some(3);
  const Extent extent = extentOf(values);
  float most = 0;
  double sum = 0;
  for (const float x : values) most = std::max(most, std::abs(x)), sum += std::abs(x);
  EXPECT_EQ(extent.most, most);
  EXPECT_NEAR(extent.sum, sum, 1e-6 * sum);
}

TEST_P(Numbers, AreRoundedToTheNearest) {
  const std::vector<float> values = some(32700);
  std::vector<std::int16_t> rounded(values.size());
  for (const float factor : {1.0f, 0.01f}) {
    roundAll(values, factor, rounded.data());
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_EQ(rounded[k], std::nearbyint(values[k] * factor)) << values[k];
  }
}

TEST_P(Numbers, AreClamped) {
  const std::vector<float> values = some(3);
  std::vector<float> clamped = values;
  clampAll(clamped, 2);
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_EQ(clamped[k], std::clamp(values[k], -2.0f, 2.0f));
}

TEST(Planes, AreSummedRowByRow) {
  Planes planes(2, 13);
  for (std::size_t k = 0; k < planes.values.size(); ++k)
    planes.values[k] = std::sin(static_cast<float>(k));
  std::vector<float> sum(planes.width()), same(planes.width());
  sumRows(std::vector<Scaled>{{2, planes.row(0)}, {-3, planes.row(1)}}, planes.width(), sum.data());
  const float factors[] = {2, -3};
  project(planes, factors, same.data());
  EXPECT_EQ(sum, same);
  for (int c = 0; c < planes.width(); ++c)
    EXPECT_NEAR(sum[c], 2 * planes.row(0)[c] - 3 * planes.row(1)[c], 1e-6);
}

}  // namespace
}  // namespace sweepface
