#include "io/temporary_folder.hpp"
#include "picture/scenes.hpp"

namespace sweepface {
namespace {

using namespace testing;

Image plain(PictureSize size, const Colour& colour) { return Image::filled(size, colour); }

TEST(Pages, DivideTheirRoom) {
  const Page::Plan plan{3, 2, true, true};
  const PictureSize panel{120, 150}, size = Page::sizeFor(panel, plan);
  auto page = Page::make(size, plan);
  ASSERT_TRUE(page.has_value());
  EXPECT_EQ(page->panel().width, panel.width);
  EXPECT_EQ(page->panel().height, panel.height);
  const std::array colours{kRed, kGreen, kBlue, kBlue, kRed, kGreen};
  for (Index k = 0; k < 6; ++k) page->place(k % 3, k / 3, plain(panel, colours[k]));
  // Panels do not overlap, and two pixels of paper separate neighbours.
  EXPECT_EQ(countNear(page->image(), kRed), (119 + 118) * 150);
  EXPECT_EQ(countNear(page->image(), kGreen), (118 + 119) * 150);
  EXPECT_EQ(countNear(page->image(), kBlue), (119 + 119) * 150);
}

TEST(Pages, TakeAnySizeThatHasRoom) {
  for (const PictureSize size : {PictureSize{301, 299}, {997, 211}, {5000, 400}}) {
    const auto page = Page::make(size, {2, 1, true, true});
    ASSERT_TRUE(page.has_value());
    EXPECT_EQ(page->image().width, size.width);
    EXPECT_LT(page->panel().height, size.height);
    EXPECT_LE(2 * page->panel().width, size.width);
  }
  EXPECT_TRUE(failsWith(Page::make({0, 0}, {}), {"cannot be made"}));
  EXPECT_TRUE(failsWith(Page::make({300, 300}, {0, 1, false, false}), {"at least one column"}));
  EXPECT_TRUE(failsWith(Page::make({100, 40}, {1, 1, true, true}), {"no room"}));
  EXPECT_TRUE(failsWith(Page::make({64, 64}, {32, 1, false, false}), {"no room"}));
}

TEST(Pages, HaveCaptions) {
  const Page::Plan plan{1, 1, true, false};
  const PictureSize panel{200, 200};
  const auto withCaption = [&](std::string_view text) {
    auto page = Page::make(Page::sizeFor(panel, plan), plan);
    page->place(0, 0, plain(panel, kRed), text);
    return page->image();
  };
  const auto ink = [](const Image& image) {
    int dark = 0;
    for (Index y = 200; y < image.height; ++y)
      for (Index x = 0; x < image.width; ++x) dark += brightness(image.at(x, y)) < 0.6;
    return dark;
  };
  EXPECT_EQ(ink(withCaption("")), 0);
  EXPECT_GT(ink(withCaption("front")), 20);
  // A long caption stays within the page, and one too long to be readable is left out.
  EXPECT_EQ(ink(withCaption(std::string(300, 'm'))), 0);
  const Image wide = withCaption(std::string(24, 'm'));
  EXPECT_GT(ink(wide), 20);
  for (Index y = 200; y < wide.height; ++y) {
    EXPECT_TRUE(near(wide.at(0, y), kPaper));
    EXPECT_TRUE(near(wide.at(199, y), kPaper));
  }
}

TEST(Pages, ExplainTheirColours) {
  const Page::Plan plan{1, 1, false, true};
  const PictureSize panel{300, 300};
  auto page = Page::make(Page::sizeFor(panel, plan), plan);
  ASSERT_TRUE(page.has_value());
  page->addLegend(std::array{Key{kRed, "smooth"}, Key{kBlue, "sharp"}});
  EXPECT_GT(countNear(page->image(), kRed), 10);
  EXPECT_GT(countNear(page->image(), kBlue), 10);
}

TEST(Pages, HaveAScaleFromPaleToDark) {
  const Page::Plan plan{1, 1, false, true};
  auto page = Page::make(Page::sizeFor({600, 600}, plan), plan);
  ASSERT_TRUE(page.has_value());
  page->addScale(0.02, "distance");
  const Image& image = page->image();
  // Find the bar's row by its darkest colour.
  Index row = 0;
  for (Index y = 600; y < image.height; ++y)
    for (Index x = 0; x < image.width; ++x)
      if (near(image.at(x, y), heatColour(0.999), 3)) row = y;
  ASSERT_GT(row, 600);
  std::vector<double> tones;
  for (Index x = 0; x < image.width; ++x)
    if (!near(image.at(x, row), kPaper)) tones.push_back(brightness(image.at(x, row)));
  ASSERT_GT(tones.size(), 200u);
  for (std::size_t k = 1; k < tones.size(); ++k)
    EXPECT_LE(tones[k], tones[k - 1] + 0.002) << "but for rounding";
}

}  // namespace
}  // namespace sweepface
