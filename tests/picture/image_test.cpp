#include <thread>

#include "io/temporary_folder.hpp"
#include "picture/font.hpp"
#include "picture/read_png.hpp"
#include "picture/scenes.hpp"

namespace sweepface {
namespace {

using namespace testing;

const Colour kBlack{0, 0, 0};

/// The extent of the pixels that are not paper.
struct Extent {
  Index left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Extent inkOf(const Image& image) {
  Extent e;
  for (Index y = 0; y < image.height; ++y)
    for (Index x = 0; x < image.width; ++x)
      if (!near(image.at(x, y), kPaper, 40)) {
        e.left = std::min(e.left, x), e.right = std::max(e.right, x);
        e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
      }
  return e;
}

Image written(std::string_view text, double height = 40, Align align = Align::left, double x = 50) {
  Image image = Image::filled({600, 120}, kPaper);
  drawText(image, text, x, 80, height, kBlack, align);
  return image;
}

TEST(Text, IsAsHighAndWideAsItSays) {
  const Extent e = inkOf(written("HAND"));
  EXPECT_NEAR(e.top, 80 - 40 - 2.5, 1.5);
  EXPECT_NEAR(e.bottom, 80 + 2.5, 1.5);
  EXPECT_NEAR(e.left, 50 - 2.5, 1.5);
  EXPECT_NEAR(e.right, 50 + textWidth("HAND", 40) + 2.5, 1.5);
  EXPECT_NEAR(textWidth("HAND", 80), 2 * textWidth("HAND", 40), 1e-9);
  EXPECT_EQ(textWidth("", 40), 0);
}

TEST(Text, Aligns) {
  const double width = textWidth("mm", 40);
  EXPECT_NEAR(inkOf(written("mm", 40, Align::centre, 300)).left, 300 - width / 2 - 2.5, 1.5);
  EXPECT_NEAR(inkOf(written("mm", 40, Align::right, 300)).right, 300 + 2.5, 1.5);
}

TEST(Text, HasEveryLetterOfAscii) {
  const Image box = written("\xff");
  std::vector<Image> letters;
  for (char c = '!'; c <= '~'; ++c) {
    letters.push_back(written(std::string(1, c)));
    EXPECT_NE(letters.back(), box) << c;
    EXPECT_GE(inkOf(letters.back()).right, 0) << c;
    for (std::size_t k = 0; k + 1 < letters.size(); ++k) EXPECT_NE(letters[k], letters.back()) << c;
  }
  EXPECT_EQ(inkOf(written(" ")).right, -1);
}

TEST(Text, ReadsUtf8) {
  EXPECT_EQ(codePoints("a°²"), (std::vector<char32_t>{U'a', U'°', U'²'}));
  EXPECT_EQ(codePoints("\xc2"), (std::vector<char32_t>{U'\uFFFD'}));
  EXPECT_EQ(codePoints("\xe4\xb8\xad"), (std::vector<char32_t>{U'中'}));
  EXPECT_EQ(codePoints("\x80z"), (std::vector<char32_t>{U'\uFFFD', U'z'}));
  EXPECT_EQ(written("中"), written("\xff")) << "a box for what the font lacks";
}

TEST(Text, IsCutOffAtTheEdge) {
  Image image = Image::filled({40, 40}, kPaper);
  drawText(image, "wide text", -30, 45, 30, kBlack);
  drawText(image, "far away", 1e9, -1e9, 30, kBlack);
  EXPECT_GE(inkOf(image).right, 30);
}

TEST(Drawing, CoversPixelsByTheirShare) {
  Image image = Image::filled({40, 40}, {1, 1, 1});
  fillRectangle(image, 10, 10, 10.5, 10, kBlack);
  EXPECT_TRUE(near(image.at(15, 15), kBlack));
  EXPECT_TRUE(near(image.at(20, 15), {0.5f, 0.5f, 0.5f}, 1.5));
  EXPECT_TRUE(near(image.at(21, 15), {1, 1, 1}));
  drawLine(image, std::array{Vec2{0, 30.5}, Vec2{40, 30.5}}, 3, kBlack);
  for (const Index y : {29, 30, 31}) EXPECT_TRUE(near(image.at(20, y), kBlack)) << y;
  for (const Index y : {28, 32}) EXPECT_TRUE(near(image.at(20, y), {1, 1, 1})) << y;
}

TEST(Drawing, FramesAndPastes) {
  Image image = Image::filled({60, 60}, kPaper);
  drawRectangle(image, 10, 10, 40, 30, 2, kBlack);
  EXPECT_TRUE(near(image.at(10, 10), kBlack));
  EXPECT_TRUE(near(image.at(49, 39), kBlack));
  EXPECT_TRUE(near(image.at(30, 25), kPaper));
  EXPECT_TRUE(near(image.at(50, 40), kPaper));
  paste(image, Image::filled({20, 20}, kRed), 50, -10);
  EXPECT_TRUE(near(image.at(59, 9), kRed));
  EXPECT_TRUE(near(image.at(59, 10), kPaper));
  paste(image, Image::filled({20, 20}, kRed), -100, 300);
}

TEST(Png, NeedsAllPixels) {
  EXPECT_TRUE(failsWith(encodePng(Image{100, 100, {}}), {"100 × 100 pixels", "has 0"}));
}

TEST(Png, ReadsBackAsTheSamePixels) {
  const Image image = picture(sphere(), before(), {123, 77});
  const auto png = encodePng(image);
  ASSERT_TRUE(png.has_value());
  EXPECT_EQ(readPng(*png), image);
  EXPECT_LT(png->size(), image.rgb.size() / 3);
  EXPECT_TRUE(failsWith(encodePng({}), {"cannot be made"}));
}

TEST(Png, IsWrittenByManyThreadsAtOnce) {
  const Image image = picture(sphere(), before(), {123, 77});
  std::array<std::string, 4> pngs;
  {
    std::vector<std::jthread> threads;
    for (std::string& png : pngs) threads.emplace_back([&] { png = encodePng(image).value(); });
  }
  for (const std::string& png : pngs) EXPECT_EQ(png, encodePng(image).value());
}

TEST(Sizes, AreReadAndChecked) {
  const auto size = parseSize("640x480");
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(size->width, 640);
  EXPECT_EQ(size->height, 480);
  for (const std::string_view text :
       {"", "640", "640x", "x480", "640x480x3", "640*480", " 640x480"})
    EXPECT_TRUE(failsWith(parseSize(text), {"no size"})) << text;
  for (const std::string_view text : {"0x0", "640x0", "16x20000", "16000x16000", "-3x40"})
    EXPECT_TRUE(failsWith(parseSize(text), {"cannot be made"})) << text;
  EXPECT_TRUE(failsWith(parseSize("99999999999x3"), {"no size"}));
}

}  // namespace
}  // namespace sweepface
