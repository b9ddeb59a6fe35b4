#include "sweepface/rig.hpp"

#include <algorithm>

#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::string refusal(const Rig& rig, std::string_view text) {
  const auto weights = parseWeights(rig, text);
  return weights ? "" : weights.error().message;
}

Rig named() {
  Rig rig = makeRig(onePatch(2, 2));
  rig.targets[0].name = "jawOpen";
  rig.targets[1].name = "a=b";
  rig.targets[2].name = "rest";
  return rig;
}

TEST(WeightText, givesEachNamedTargetItsWeight) {
  const Rig rig = named();
  EXPECT_EQ(parseWeights(rig, "").value(), (Weights{0, 0, 0}));
  EXPECT_EQ(parseWeights(rig, "jawOpen=0.5,rest=-2e-1").value(), (Weights{0.5, 0, -0.2}));
  EXPECT_EQ(parseWeights(rig, "rest").value(), (Weights{0, 0, 1}));
  EXPECT_EQ(parseWeights(rig, " jawOpen = 0.5 , rest").value(), (Weights{0.5, 0, 1}));
  EXPECT_EQ(parseWeights(rig, "jawOpen=1,,rest=0.25,").value(), (Weights{1, 0, 0.25}));
}

TEST(WeightText, takesTheLastEqualsSign) {
  EXPECT_EQ(parseWeights(named(), "a=b=3").value(), (Weights{0, 3, 0}));
}

TEST(WeightText, refusesWhatItDoesNotKnowAndSaysWhatThereIs) {
  EXPECT_EQ(refusal(named(), "jawopen=1"),
            "There is no target named 'jawopen'; its targets are jawOpen, a=b, rest.");
  EXPECT_EQ(refusal(named(), "jawOpen=1, r est=1"),
            "There is no target named 'r est'; its targets are jawOpen, a=b, rest.");
  EXPECT_EQ(refusal(named(), "jawOpen=1,rest,jawOpen=1"),
            "The weight of 'jawOpen' is told twice; tell it once.");
  Rig none = named();
  none.targets.clear();
  EXPECT_EQ(refusal(none, "x"), "There is no target named 'x'; this face has no targets.");
  Rig many;
  many.targets.resize(61, {"t", {}, {}});
  const std::string list = refusal(many, "x");
  EXPECT_EQ(std::ranges::count(list, ','), 60);
  EXPECT_TRUE(list.ends_with("t, t, ...")) << list;
}

TEST(WeightText, refusesWhatIsNoNumberWithinAMillion) {
  EXPECT_EQ(refusal(named(), "jawOpen=1000000,rest=-1000000"), "");
  for (const char* text :
       {"1000001", "-1000001", "nan", "inf", "-inf", "1e999", "", "1x", "1 1", "0x1", "1.5.2"})
    EXPECT_EQ(refusal(named(), std::string("jawOpen=") + text),
              std::string("The weight of 'jawOpen' must be a number within ±1,000,000, not '") +
                  text + "'.");
}

TEST(Rig, atRestAsksNothingOfTargets) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.source.loose = {{1, 2, 3}};  // no target has a difference for it yet
  for (Target& target : rig.targets) target.looseDifference.clear();
  EXPECT_FALSE(rig.knowsTargets());
  EXPECT_EQ(blendLoose(rig, Weights(rig.targets.size(), 0.0)), rig.source.loose);
}

TEST(Find, answersByExactName) {
  const Rig rig = named();
  EXPECT_EQ(rig.find("rest"), 2);
  EXPECT_EQ(rig.find("Rest"), -1);
}

TEST(Find, thingsWithoutANameHaveTheirLetterAndNumber) {
  Rig rig = named();
  rig.names.nodes = {"", "tip"};
  EXPECT_EQ(rig.nameOf(Thing::node, 0), "n0");
  EXPECT_EQ(rig.nameOf(Thing::node, 1), "tip");
  for (const auto& [name, node] : {std::pair{"n0", 0}, {"0", 0}, {"tip", 1}, {"n1", 1}, {"3", 3}})
    EXPECT_EQ(rig.find(Thing::node, name).value(), node) << name;
  for (const char* name : {"", "n", "n4", "c0", "n4294967296", "n-1"})
    EXPECT_FALSE(rig.find(Thing::node, name)) << name;
}

class Blend : public ::testing::TestWithParam<std::size_t> {
 protected:
  Rig rig() const { return someRigs()[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(SomeRigs, Blend, ::testing::Range(std::size_t{0}, someRigs().size()));

TEST_P(Blend, atRestIsTheNeutral) {
  const Rig r = rig();
  std::vector<Vec3> expected(r.surface.vectorCount());
  r.surface.settle(r.neutral, expected);
  EXPECT_EQ(blend(r, Weights{0, 0, 0}), expected);
  EXPECT_EQ(blend(r, Weights{}), expected);
  EXPECT_EQ(blendLoose(r, Weights{0, 0, 0}), r.source.loose);
}

TEST_P(Blend, addsDifferencesOnStoredVectors) {
  const Rig r = rig();
  const auto vectors = blend(r, Weights{0.5, -2, 1});
  for (std::size_t v = 0; v < r.neutral.size(); ++v) {
    Vec3 expected = r.neutral[v];
    expected += 0.5 * r.targets[0].difference[v];
    expected += -2.0 * r.targets[1].difference[v];
    EXPECT_EQ(vectors[v], expected);
  }
}

TEST_P(Blend, commutesWithEvaluation) {
  const Rig r = rig();
  const Site site{0, 0.4 * r.surface.edgesU(0), 0.7 * r.surface.edgesV(0)};
  const auto at = [&](const Weights& w) { return r.surface.evaluate(blend(r, w), site); };
  const Vec3 neutral = at({0, 0, 0}), open = at({1, 0, 0}) - neutral,
             wink = at({0, 1, 0}) - neutral;
  EXPECT_LT(norm(at({0.3, 1.6, 0}) - (neutral + 0.3 * open + 1.6 * wink)),
            1e-12 * (1 + norm(neutral)));
}

TEST(BlendLoose, movesLooseVerticesByTheSameWeights) {
  const Rig r = dressed(makeRig(onePatch(2, 3)));
  const auto loose = blendLoose(r, Weights{0.5, 1, 0});
  EXPECT_EQ(loose[0], r.source.loose[0]);
  EXPECT_LT(norm(loose[1] - Vec3{4.75, 5, 6 + 1.5e-9}), 1e-14);
}

}  // namespace
}  // namespace sweepface
