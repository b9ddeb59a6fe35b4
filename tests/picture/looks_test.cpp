#include <cstdlib>
#include <fstream>
#include <iterator>

#include "sweepface/io.hpp"

#include "picture/read_png.hpp"
#include "picture/scenes.hpp"

// Compares a picture of each thing that is drawn with looks.png, which contains them all. After an
// intended change, regenerate it with SWEEPFACE_LOOKS=tests/picture/looks.png and inspect it.
namespace sweepface {
namespace {

using namespace testing;

constexpr PictureSize kPanel{160, 128};
constexpr Index kColumns = 4;

/// A hill with two targets, striped in every material that has its own colour.
MeshRig stripedHill() {
  MeshRig source = withTargets(plane(12, 10));
  Polygons& polygons = source.neutral.polygons;
  polygons.materials = {"skin",  "lip",    "teeth", "gum",     "tongue",  "iris",
                        "pupil", "sclera", "hair",  "eyebrow", "nostril", "beard"};
  for (Index f = 0; f < polygons.faceCount(); ++f) polygons.faceMaterial.push_back(f % 12);
  return source;
}

/// A ball in front of a wall, whose shadows and stripes show the light, with a stroke and a label.
Scene still(Finish finish) {
  Scene scene = sphere(1.2);
  scene.finish = finish;
  scene.colour = {0.87F, 0.70F, 0.61F};
  for (const Vec3& n : scene.normals)
    scene.vertexColours.push_back({0.8F + 0.2F * static_cast<float>(n.y), 0.7F, 0.6F});
  addSquare(scene, {0.3, -0.3, -1.3}, 1.6, kBlue);
  scene.strokes.push_back({{{-1.5, -0.2, 1.3}, {0, 1.4, 0.4}, {1.5, 0.5, 1.3}}, kGreen, 9});
  scene.labels.push_back({{-0.4, 0.5, 1.05}, "n7", kRed});
  return scene;
}

Image letters() {
  Image image = Image::filled(kPanel, kPaper);
  double y = 14;
  for (const char* line :
       {"ABCDEFGHIJKLM", "NOPQRSTUVWXYZ", "abcdefghijklmno", "pqrstuvwxyz.,:;", "0123456789!?\"-",
        "+=<>*/|_~^`()[]", "{}#$%&@°²³·×±", "µ–—…→ \xC3\x9F"}) {
    drawText(image, line, 4, y, 9, {0.1F, 0.1F, 0.2F});
    y += 15.5;
  }
  return image;
}

Image marks() {
  Image image = Image::filled(kPanel, kPaper);
  drawBoxes(image, std::array{PictureBox{0.1, 0.2, 0.3, 0.5}, PictureBox{0.3, 0.4, 0.6, 0.2},
                              PictureBox{0.5, 0.1, 0.2, 0.8}, PictureBox{0.7, 0.6, 0.2, 0.3}});
  drawLine(image, std::array{Vec2{10, 120}, Vec2{60, 90}, Vec2{150, 122}}, 5, kRed);
  drawLine(image, std::array{Vec2{140, 12}, Vec2{140, 12}}, 9, kGreen);
  fillRectangle(image, 60.5, 4.5, 20, 9, kBlue);
  drawRectangle(image, 90.5, 4.5, 30, 12, 3, kRed);
  return image;
}

Image page(bool scale) {
  Page made = Page::make(kPanel, {2, 1, true, true}).value();
  made.place(0, 0, Image::filled(made.panel(), kRed), "front");
  made.place(1, 0, Image::filled(made.panel(), kGreen), "side");
  if (scale)
    made.addScale(0.25, "distance");
  else
    made.addLegend(std::array{Key{kRed, "arcs"}, Key{kBlue, "joins (3)"}});
  return made.image();
}

Image face(const Scene& scene, const std::vector<Vec3>& points) {
  return picture(scene, frameCamera(points, {20, -35}, kPanel), kPanel);
}

std::vector<Image> everything() {
  const MeshRig source = stripedHill();
  const Rig rig = converted(source, 0.05);
  const FaceScenes scenes(rig, 3);
  const Weights posed{0.7, 0};
  const auto points = scenes.drawn(posed);
  std::vector<Image> pictures;
  for (const Style style : {Style::shaded, Style::patches, Style::wireframe, Style::joins,
                            Style::normals, Style::zebra})
    pictures.push_back(face(scenes.scene(posed, style), points));
  auto original = originalPositions(rig, source, posed).value();
  for (Vec3& p : original) p.z += 0.01 * p.x;
  for (const Style style : {Style::error, Style::angle})
    pictures.push_back(face(scenes.heatMap(posed, original, style).scene, points));
  pictures.push_back(face(scenes.original(original), points));
  for (const Finish finish : {Finish::skin, Finish::matte, Finish::zebra})
    pictures.push_back(picture(still(finish), before(), kPanel));
  pictures.push_back(letters());
  pictures.push_back(marks());
  for (const bool scale : {false, true}) pictures.push_back(page(scale));
  return pictures;
}

Image sheetOf(const std::vector<Image>& pictures) {
  const auto rows = (static_cast<Index>(pictures.size()) + kColumns - 1) / kColumns;
  Image sheet = Image::filled({kColumns * kPanel.width, rows * kPanel.height}, kPaper);
  for (Index k = 0; k < static_cast<Index>(pictures.size()); ++k)
    paste(sheet, pictures[k], k % kColumns * kPanel.width, k / kColumns * kPanel.height);
  return sheet;
}

/// The mean of a colour over a square of pixels.
double meanOf(const Image& image, Index x, Index y, Index size, int channel) {
  double sum = 0;
  for (Index j = 0; j < size; ++j)
    for (Index i = 0; i < size; ++i)
      sum += image.rgb[3 * ((y + j) * image.width + x + i) + channel];
  return sum / (size * size);
}

TEST(Looks, AreAsTheyWere) {
  const Image found = sheetOf(everything());
  if (const char* const path = std::getenv("SWEEPFACE_LOOKS")) {
    ASSERT_TRUE(writeFile(path, encodePng(found).value()));
    return;
  }
  std::ifstream file(SWEEPFACE_SOURCE_DIR "/tests/picture/looks.png", std::ios::binary);
  const Image wanted = readPng(std::string(std::istreambuf_iterator<char>(file), {}));
  ASSERT_EQ(found.width, wanted.width);
  ASSERT_EQ(found.height, wanted.height);
  // Compilers may round a pixel at an edge the other way.
  constexpr Index kSquare = 4;
  constexpr double kMost = 4;
  for (Index y = 0; y < found.height; y += kSquare)
    for (Index x = 0; x < found.width; x += kSquare)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(meanOf(found, x, y, kSquare, c), meanOf(wanted, x, y, kSquare, c), kMost)
            << "at " << x << ", " << y << " of looks.png; SWEEPFACE_LOOKS=FILE writes the new one";
}

}  // namespace
}  // namespace sweepface
