#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sweepface/clip.hpp"
#include "sweepface/head.hpp"

namespace sweepface {
namespace {

constexpr Angles kTurned{0.5, -0.3, 0.2};

/// The columns of a rotation, twice as long as they need to be.
std::array<Vec3, 3> columnsOf(const Angles& angles) {
  const Quaternion q = quaternionOf(angles);
  return {2 * turned(q, {1, 0, 0}), 2 * turned(q, {0, 1, 0}), 2 * turned(q, {0, 0, 1})};
}

/// The frame of a face with these members.
Result<Clip> clipOf(const std::string& members) {
  return parseClipJson(
      R"([{"categories": [{"categoryName": "jawOpen", "score": 0.5}], )" + members + "}]",
      "take.json", 30);
}

Result<Clip> withTransform(const std::string& matrix) {
  return clipOf(R"("facialTransformationMatrixes": [)" + matrix + "]");
}

void expectTurned(const Result<Clip>& clip) {
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_TRUE(clip->warnings.empty());
  EXPECT_EQ(clip->names, (std::vector<std::string>{"HeadPitch", "HeadRoll", "HeadYaw", "jawOpen"}));
  const Angles head = ClipAngles(*clip).at(*clip, 0).head;
  EXPECT_NEAR(head.yaw, kTurned.yaw, 1e-12);
  EXPECT_NEAR(head.pitch, kTurned.pitch, 1e-12);
  EXPECT_NEAR(head.roll, kTurned.roll, 1e-12);
}

TEST(FaceTransform, GoesDownItsColumnsInJavaScript) {
  std::string data;
  for (const Vec3& c : columnsOf(kTurned)) data += fmt::format("{}, {}, {}, 0, ", c.x, c.y, c.z);
  expectTurned(withTransform(R"({"rows": 4, "columns": 4, "data": [)" + data + "1, -20, -40, 1]}"));
}

TEST(FaceTransform, IsAListOfRowsInPython) {
  const auto [x, y, z] = columnsOf(kTurned);
  expectTurned(clipOf(fmt::format(
      R"("facial_transformation_matrixes": [[[{}, {}, {}, 1], [{}, {}, {}, -20], [{}, {}, {}, -40],
      [0, 0, 0, 1]]])",
      x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z)));
}

TEST(FaceTransform, MayBeMissing) {
  for (const char* none : {R"("facialTransformationMatrixes": [])",
                           R"("facialTransformationMatrixes": null)", R"("face": 1)"}) {
    const auto clip = clipOf(none);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, std::vector<std::string>{"jawOpen"});
    EXPECT_TRUE(clip->warnings.empty());
  }
}

TEST(FaceTransform, GoesOnFromTheFrameBeforeWhereThereIsNone) {
  const auto frame = [](double turned, bool tells) {
    const std::string matrix =
        fmt::format(R"([[{0}, 0, {1}, 0], [0, 1, 0, 0], [-{1}, 0, {0}, 0], [0, 0, 0, 1]])",
                    std::cos(turned), std::sin(turned));
    return R"({"categories": [{"categoryName": "jawOpen", "score": 1}])" +
           (tells ? R"(, "facial_transformation_matrixes": [)" + matrix + "]}" : "}");
  };
  const auto clip = parseClipJson("[" + frame(0, false) + "," + frame(0.5, true) + "," +
                                      frame(0, false) + "," + frame(0.25, true) + "]",
                                  "take.json", 1);
  ASSERT_TRUE(clip) << clip.error().message;
  const ClipAngles angles(*clip);
  for (const auto& [seconds, yaw] : {std::pair(0, 0.5), {1, 0.5}, {2, 0.5}, {3, 0.25}})
    EXPECT_NEAR(angles.at(*clip, seconds).head.yaw, yaw, 1e-12) << seconds;
}

TEST(FaceTransform, OfAnotherShapeIsLeftOutWithAWarning) {
  for (const char* wrong :
       {"5", "[1, 0, 0, 0]", R"({"data": [1, 0, 0]})", "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]",
        R"({"data": [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})",
        R"([[1, 0, 0, 0], [0, "1", 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])"}) {
    const auto clip = withTransform(wrong);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, std::vector<std::string>{"jawOpen"}) << wrong;
    EXPECT_EQ(clip->warnings,
              std::vector<std::string>{
                  "take.json: 1 of 1 frames have a transformation of the face that is no matrix of "
                  "4 × 4 numbers; the head stands there as in the frame before."});
  }
}

}  // namespace
}  // namespace sweepface
