#include "sweepface/limits.hpp"

#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(Limits, StopWeightsThatGoBeyond) {
  const Rig rig = makeRig(onePatch(1, 1));  // open, wink, rest
  const auto limits = Limits::parse(rig, "0:1,open=-0.5:0.8");
  ASSERT_TRUE(limits) << limits.error().message;
  std::vector<double> weights{1, 1.5, -0.2, 7};
  limits->apply(weights);
  EXPECT_EQ(weights, (std::vector<double>{0.8, 1, 0, 7}));
  weights = {-0.4, 0.5, 0};
  limits->apply(weights);
  EXPECT_EQ(weights, (std::vector<double>{-0.4, 0.5, 0}));
}

TEST(Limits, OfOneTargetLeaveTheOthersAlone) {
  const auto limits = Limits::parse(makeRig(onePatch(1, 1)), "rest=0:0");
  ASSERT_TRUE(limits);
  std::vector<double> weights{-9, 9, 9};
  limits->apply(weights);
  EXPECT_EQ(weights, (std::vector<double>{-9, 9, 0}));
}

TEST(Limits, OfOneTargetCountWhereverTheyAreTold) {
  const Rig rig = makeRig(onePatch(1, 1));
  std::vector<double> weights(rig.targets.size(), 1);
  const auto limits = Limits::parse(rig, "rest=0:0.5,0:0.75");
  ASSERT_TRUE(limits) << limits.error().message;
  limits->apply(weights);
  for (std::size_t k = 0; k < weights.size(); ++k)
    EXPECT_EQ(weights[k], rig.targets[k].name == "rest" ? 0.5 : 0.75);
}

TEST(Limits, AreToldOnce) {
  const auto limits = Limits::parse(makeRig(onePatch(1, 1)), "rest=0:1,rest=0:2");
  ASSERT_FALSE(limits);
  EXPECT_EQ(limits.error().message, "The limits of 'rest' are told twice; tell them once.");
}

TEST(Limits, ForAllAreToldOnce) {
  const auto limits = Limits::parse(makeRig(onePatch(1, 1)), "0:1,rest=0:2,0:2");
  ASSERT_FALSE(limits);
  EXPECT_EQ(limits.error().message, "Limits for all are told twice; tell them once.");
}

TEST(Limits, AreListedAsWeightsAre) {
  const Rig rig = makeRig(onePatch(1, 1));
  const auto plain = Limits::parse(rig, "0:1,open=-0.5:0.8"),
             spaced = Limits::parse(rig, " 0 : 1 , open = -0.5:0.8,,");
  ASSERT_TRUE(plain && spaced);
  std::vector<double> a{-9, 9, 0.5}, b = a;
  plain->apply(a);
  spaced->apply(b);
  EXPECT_EQ(a, b);
}

TEST(Limits, SayWhatIsWrong) {
  const Rig rig = makeRig(onePatch(1, 1));
  for (const char* text : {"1", "1:0", "0:x", "open=1", "open=:1", "0:1;", "0:inf"})
    EXPECT_FALSE(Limits::parse(rig, text)) << text;
  const auto unknown = Limits::parse(rig, "frown=0:1");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("'frown'"), std::string::npos);
}

}  // namespace
}  // namespace sweepface
