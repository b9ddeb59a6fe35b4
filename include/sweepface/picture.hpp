#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/mesh.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

// ---- Images ----

/// A colour in sRGB, each component from 0 to 1.
struct Colour {
  float r = 0, g = 0, b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// The background of pictures and pages.
inline constexpr Colour kPaper{0.957f, 0.949f, 0.941f};

struct PictureSize {
  Index width = 0, height = 0;  ///< in pixels
};

/// Pictures are between 16 and 16384 pixels wide and high, and have no more than 2^26 pixels.
Result<void> checkSize(PictureSize size);
/// Parses "1200x900".
Result<PictureSize> parseSize(std::string_view text);

/// Rows from the top, pixels from the left.
struct Image {
  Index width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< [height × width × 3]

  /// All of one colour; the size must have passed checkSize.
  static Image filled(PictureSize size, const Colour& colour);
  Colour at(Index x, Index y) const;
  friend bool operator==(const Image&, const Image&) = default;
};

/// The bytes of a PNG file.
Result<std::string> encodePng(const Image& image);

// ---- Drawing on images: x to the right, y down, in pixels; parts outside are cut off ----

enum class Align { left, centre, right };

/// Text on one line with its baseline at y; capitals are `height` pixels high. Text is UTF-8; what
/// the font lacks is drawn as a box.
void drawText(Image& image, std::string_view text, double x, double y, double height,
              const Colour& colour, Align align = Align::left);
double textWidth(std::string_view text, double height);
/// A line through points with round ends.
void drawLine(Image& image, std::span<const Vec2> points, double width, const Colour& colour);
void fillRectangle(Image& image, double x, double y, double width, double height,
                   const Colour& colour);
void drawRectangle(Image& image, double x, double y, double width, double height, double line,
                   const Colour& colour);
/// Copies `part` with its upper left corner at (x, y).
void paste(Image& image, const Image& part, Index x, Index y);

/// A box at the same place in several pictures, to measure by: shares of their width and height
/// from the upper left corner.
struct PictureBox {
  double x = 0, y = 0, width = 0, height = 0;
};
/// Parses "0.3,0.6,0.4,0.2".
Result<PictureBox> parseBox(std::string_view text);
/// Draws boxes in colours that tell them apart: green, blue, orange, purple, and again.
void drawBoxes(Image& image, std::span<const PictureBox> boxes);

// ---- Pages ----

/// An entry of a legend.
struct Key {
  Colour colour;
  std::string text;
};

/// Pictures in rows and columns on one page, with captions below them and a legend or the scale of
/// a heat map at the foot.
class Page {
 public:
  struct Plan {
    Index columns = 1, rows = 1;
    bool captions = false, foot = false;
  };
  /// Fails if the size is out of range or leaves too little room.
  static Result<Page> make(PictureSize size, const Plan& plan);
  /// The size of a page whose pictures have the given size.
  static PictureSize sizeFor(PictureSize panel, const Plan& plan);

  /// The size of each picture.
  PictureSize panel() const { return panel_; }
  void place(Index column, Index row, const Image& image, std::string_view caption = {});
  void addLegend(std::span<const Key> keys);
  /// A scale from 0 to `top`; `text` says of what.
  void addScale(double top, std::string_view text);
  const Image& image() const { return image_; }

 private:
  Page() = default;
  Plan plan_;
  PictureSize panel_;
  Image image_;
};

// ---- Views ----

/// Where the eye is, in degrees: azimuth 0 looks into the face (+z), 90 sees its left side (+x);
/// elevation 90 looks down on it.
struct View {
  double azimuth = 0, elevation = 0;
  friend bool operator==(const View&, const View&) = default;
};

/// "front", "side", "three-quarter", "back" or "AZIMUTH,ELEVATION".
Result<View> parseView(std::string_view text);
/// Several of them, separated by commas.
Result<std::vector<View>> parseViews(std::string_view text);
/// The view's name, or its angles.
std::string nameOf(const View& view);

/// A perspective view with +y upwards.
struct Camera {
  Vec3 eye, right, up, forward;
  double focal = 1;  ///< the picture's height at distance 1 is 1 / focal

  /// Pixels from the picture's upper left corner, and the distance along `forward`.
  Vec3 project(const Vec3& p, PictureSize size) const;
};

/// A camera with a portrait lens that has all points in the picture. `margin` is the share of the
/// picture left free at each side.
Camera frameCamera(std::span<const Vec3> points, const View& view, PictureSize size,
                   double margin = 0.05);
/// Cameras for several views of the same points, all of which show them at the same size.
std::vector<Camera> frameCameras(std::span<const Vec3> points, std::span<const View> views,
                                 PictureSize size, double margin = 0.05);

/// The smallest box around some points as a camera sees them, with a little room.
PictureBox boxAround(std::span<const Vec3> points, const Camera& camera, PictureSize size);

// ---- Scenes ----

enum class Finish {
  skin,   ///< soft, with a little shine
  matte,  ///< colours stay what they are, lit just enough to show the form
  flat,   ///< colours unlit
  zebra,  ///< a mirror in a room of stripes: kinks in the surface show as kinks in the lines
};

/// A line in space. What lies behind the surface is not drawn.
struct Stroke {
  std::vector<Vec3> points;
  Colour colour;
  double width = 1;  ///< in thousandths of the picture's height
};

/// A mark with a text at a point in space, drawn where the point is seen.
struct Label {
  Vec3 at;
  std::string text;
  Colour colour;
};

struct Scene {
  std::vector<Vec3> positions;                  ///< [V × 3], model units
  std::vector<Vec3> normals;                    ///< [V × 3] outward unit normals
  std::vector<std::array<Index, 3>> triangles;  ///< [T], counter-clockwise seen from outside
  Colour colour{0.87f, 0.70f, 0.61f};
  std::vector<Colour> vertexColours;    ///< [V], or empty
  std::vector<Colour> triangleColours;  ///< [T], or empty
  Finish finish = Finish::skin;
  std::vector<Stroke> strokes;  ///< later ones above
  std::vector<Label> labels;
  Colour background = kPaper;
};

struct StudioParts;

/// A scene under the project's lights: a soft sky, a large lamp beside the camera, a weak one on
/// the other side and one from behind. What can be computed before the camera is known is computed
/// once. Pictures are the same for any number of threads.
class Studio {
 public:
  /// Fails if the scene makes no sense: an index out of range, a position that is not finite. Once
  /// `cancel` is true, this and shoot() fail soon; it must outlive the studio.
  static Result<Studio> make(Scene scene, const std::atomic<bool>* cancel = nullptr);
  Studio(Studio&&) noexcept;
  Studio& operator=(Studio&&) noexcept;
  ~Studio();

  Result<Image> shoot(const Camera& camera, PictureSize size) const;

 private:
  explicit Studio(std::unique_ptr<StudioParts> parts);
  std::unique_ptr<StudioParts> parts_;
};

/// One picture of a scene. Fails soon once `cancel` is true.
Result<Image> render(Scene scene, const Camera& camera, PictureSize size,
                     const std::atomic<bool>* cancel = nullptr);

// ---- Faces ----

enum class Style {
  shaded,     ///< skin, eyes, teeth by the names of their materials
  patches,    ///< patches in tints, no two neighbours in the same
  wireframe,  ///< boundary curves and control curves
  joins,      ///< boundary curves coloured by the class of their join
  error,      ///< distance of the vertices from the meshes, as a heat map
  angle,      ///< angle between the surface's normals and the meshes', blended across their faces
  normals,    ///< the surface's normals as colours
  zebra,      ///< reflected stripes
};
inline constexpr std::array styles{Style::shaded, Style::patches, Style::wireframe, Style::joins,
                                   Style::error,  Style::angle,   Style::normals,   Style::zebra};
/// The error lists the names.
Result<Style> styleFromName(std::string_view name);
std::string_view nameOf(Style style);

/// From pale to dark with `share` from 0 to 1.
Colour heatColour(double share);

/// The positions of the source's meshes under some weights: their own linear blend [V]. Fails with
/// a sentence if the meshes do not belong to the rig or lack a target whose weight is not 0.
Result<std::vector<Vec3>> originalPositions(const Rig& rig, const MeshRig& source,
                                            std::span<const double> weights);

/// A heat map, and what its scale says.
struct HeatMap {
  Scene scene;
  double top = 0;    ///< the value of the darkest colour
  double worst = 0;  ///< the largest value
  std::string title;
};

/// The number of pieces to cut every edge into so that a picture of this size looks smooth.
Index lodFor(const Surface& surface, Style style, PictureSize size);

/// Makes scenes of one rig.
class FaceScenes {
 public:
  /// Cuts every edge into `lod` ≥ 1. The rig must outlive the maker.
  FaceScenes(const Rig& rig, Index lod);

  /// Any style but error and angle.
  Scene scene(std::span<const double> weights, Style style) const;
  /// The face coloured by its error or angle (the style) against the positions of its source's
  /// vertices. The scale of errors ends at the rig's tolerance, unless errors go beyond it or `top`
  /// says where.
  HeatMap heatMap(std::span<const double> weights, std::span<const Vec3> original, Style style,
                  double top = 0) const;
  /// The source's own polygons with other positions.
  Scene original(std::span<const Vec3> positions) const;

  /// What the colours of a style mean; empty where they speak for themselves.
  std::vector<Key> legend(Style style) const;
  /// Positions of the vertices of level 1 in a pose.
  std::vector<Vec3> points(std::span<const double> weights) const;
  /// Positions of all vertices that are drawn, for framing: the surface may bulge beyond its
  /// source's vertices.
  std::vector<Vec3> drawn(std::span<const double> weights) const;
  /// Which of points() move most under the targets whose names contain `name`, ignoring case. Only
  /// the first `count` targets are searched, since followers may come after them.
  Result<std::vector<Index>> region(std::string_view name,
                                    std::size_t count = static_cast<std::size_t>(-1)) const;
  /// The corners of all quads of level 1 that have one of these vertices, in ascending order: the
  /// part of the surface that moves with them.
  std::vector<Index> around(std::span<const Index> vertices) const;

 private:
  /// From the positions of the source's vertices, at those of level 1.
  std::vector<double> distances(std::span<const double> weights,
                                std::span<const Vec3> original) const;
  /// Of the normals that are drawn, in degrees; 0 where the source has none.
  std::vector<double> angles(std::span<const Vec3> normals, std::span<const Vec3> original) const;

  const Rig& rig_;
  Tessellation grid_, source_;
  std::vector<Index> cornerPlaces_;  // [C] of the source on source_
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<Index> patchOf_, quadOf_;  // [T]
};

}  // namespace sweepface
