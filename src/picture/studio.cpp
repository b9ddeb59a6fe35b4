#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/picture.hpp"

#include "parallel/parallel.hpp"
#include "picture/colour.hpp"
#include "picture/mask.hpp"
#include "picture/occlusion.hpp"
#include "picture/raster.hpp"
#include "picture/shading.hpp"

namespace sweepface {
namespace {

/// Refuses colours unless there is one for each of `count` things, or none.
Result<void> checkColours(const std::vector<Colour>& colours, std::size_t count,
                          std::string_view things) {
  if (colours.empty() || colours.size() == count) return {};
  return fail(fmt::format("The scene has {} colours for its {} {}; give one for each.",
                          colours.size(), count, things));
}

Result<void> checkScene(const Scene& scene) {
  const std::size_t vertices = scene.positions.size();
  if (scene.normals.size() != vertices)
    return fail(
        fmt::format("The scene has {} positions, but {} normals.", vertices, scene.normals.size()));
  if (auto ok = checkColours(scene.vertexColours, vertices, "vertices"); !ok) return ok;
  if (auto ok = checkColours(scene.triangleColours, scene.triangles.size(), "triangles"); !ok)
    return ok;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    for (const Index v : scene.triangles[t])
      if (v < 0 || static_cast<std::size_t>(v) >= vertices)
        return fail(fmt::format("Triangle {} of the scene has the vertex {}, but there are {}.", t,
                                v, vertices));
  for (std::size_t v = 0; v < vertices; ++v)
    if (!isFinite(scene.positions[v]) || !isFinite(scene.normals[v]))
      return fail(fmt::format("Vertex {} of the scene is not finite.", v));
  for (const Stroke& stroke : scene.strokes)
    if (!std::ranges::all_of(stroke.points, [](const Vec3& p) { return isFinite(p); }))
      return fail("A line of the scene has a point that is not finite.");
  for (const Label& label : scene.labels)
    if (!isFinite(label.at)) return fail("A label of the scene is at a point that is not finite.");
  return {};
}

template <typename Value>
auto between(const std::vector<Value>& values, const std::array<Index, 3>& at,
             const std::array<double, 3>& w) {
  return w[0] * values[at[0]] + w[1] * values[at[1]] + w[2] * values[at[2]];
}

std::vector<Light> toLights(const std::vector<Colour>& colours) {
  std::vector<Light> lights;
  for (const Colour& c : colours) lights.push_back(toLight(c));
  return lights;
}

}  // namespace

struct StudioParts {
  Scene scene;
  Obstacles obstacles;
  Light colour;
  std::vector<Light> vertexColours, triangleColours;
  std::vector<float> sky;  // [V], or empty where the finish has no shadows
  const std::atomic<bool>* cancel = nullptr;

  Light colourAt(Index triangle, const std::array<double, 3>& weights) const {
    if (!triangleColours.empty()) return triangleColours[triangle];
    if (!vertexColours.empty()) return between(vertexColours, scene.triangles[triangle], weights);
    return colour;
  }
};

namespace {

std::unexpected<Error> interrupted() { return fail("Drawing was interrupted."); }

/// Takes one picture.
class Photograph {
 public:
  Photograph(const StudioParts& studio, const Camera& camera, PictureSize size)
      : studio_(studio),
        scene_(studio.scene),
        camera_(camera),
        size_(size),
        lamps_(camera),
        background_(toLight(scene_.background)),
        raster_(scene_, camera, size) {
    if (!studio.sky.empty())
      lamp_ = lampExposure(studio.obstacles, scene_.positions, scene_.normals, lamps_.key,
                           kKeyRadius, studio.sky, studio.cancel);
  }

  Result<Image> take() const {
    Image image = Image::filled(size_, scene_.background);
    parallelFor(Index{0}, raster_.tileCount(), [&](Index tile) {
      if (!isCancelled(studio_.cancel)) develop(tile, image);
    });
    drawStrokes(image);
    drawLabels(image);
    if (isCancelled(studio_.cancel)) return interrupted();
    return image;
  }

 private:
  void develop(Index tile, Image& image) const {
    std::vector<Hit> hits;
    raster_.look(tile, hits);
    const Index left = raster_.tileX(tile), top = raster_.tileY(tile);
    for (Index y = top; y < std::min(top + kTile, size_.height); ++y)
      for (Index x = left; x < std::min(left + kTile, size_.width); ++x) {
        const Hit* const hit = &hits[((y - top) * kTile + x - left) * kSamples];
        const PixelHits seen(hit, kSamples);
        if (!std::ranges::all_of(seen, [](const Hit& h) { return h.triangle < 0; }))
          setPixel(image, x, y, toColour(lightOf(seen, x, y)));
      }
  }

  using PixelHits = std::span<const Hit, kSamples>;

  /// The mean of what a pixel's samples see. A triangle is shaded once, in the middle of the
  /// samples that see it, as light changes little within a pixel. Stripes may end within one, so
  /// they are shaded at every sample.
  Light lightOf(PixelHits hits, Index x, Index y) const {
    const bool isStriped = scene_.finish == Finish::zebra;
    Light sum;
    std::array<bool, kSamples> isLit{};
    for (int s = 0; s < kSamples; ++s) {
      if (isLit[s]) continue;
      const Index triangle = hits[s].triangle;
      double dx = 0, dy = 0, count = 0;
      for (int k = s; k < (isStriped ? s + 1 : kSamples); ++k) {
        if (hits[k].triangle != triangle) continue;
        dx += kSamplePlaces[k][0], dy += kSamplePlaces[k][1], ++count;
        isLit[k] = true;
      }
      sum +=
          count * (triangle < 0 ? background_ : lightAt(triangle, x + dx / count, y + dy / count));
    }
    return sum * (1.0 / kSamples);
  }

  static void setPixel(Image& image, Index x, Index y, const Colour& c) {
    std::uint8_t* const p = &image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x)];
    p[0] = toByte(c.r), p[1] = toByte(c.g), p[2] = toByte(c.b);
  }

  Light lightAt(Index triangle, double x, double y) const {
    const Raster::Place place = raster_.placeIn(triangle, x, y);
    const auto& corners = scene_.triangles[triangle];
    SurfacePoint p;
    p.colour = studio_.colourAt(triangle, place.weights);
    p.front = place.front;
    p.normal = normalized(between(scene_.normals, corners, place.weights));
    if (!p.front) p.normal = -p.normal;
    p.toEye = normalized(camera_.eye - between(scene_.positions, corners, place.weights));
    if (!studio_.sky.empty()) {
      p.sky = between(studio_.sky, corners, place.weights);
      p.lamp = between(lamp_, corners, place.weights);
    }
    return shade(scene_.finish, p, lamps_);
  }

  /// Whether a point is in front of the eye; what is behind it would be projected upside down.
  bool isAhead(const Vec3& p) const { return dot(p - camera_.eye, camera_.forward) > 0; }

  /// Whether nothing lies between a point and the eye. The first bit of the way does not count, as
  /// lines lie on the surface, whose triangles cut its corners.
  bool sees(const Vec3& p) const {
    const double slack = 0.0025 * studio_.obstacles.size();
    const Vec3 way = camera_.eye - p;
    const double distance = norm(way);
    if (!isAhead(p)) return false;
    return distance <= slack || !studio_.obstacles.blocks(p, way * (1 / distance), slack, distance);
  }

  Vec2 placeOf(const Vec3& p) const {
    const Vec3 seen = camera_.project(p, size_);
    return {seen.x, seen.y};
  }

  void drawStrokes(Image& image) const {
    const auto& strokes = scene_.strokes;
    // Neighbours of one colour share a mask, so that no joint shows where they meet.
    for (std::size_t first = 0; first < strokes.size();) {
      std::size_t last = first;
      while (last < strokes.size() && strokes[last].colour == strokes[first].colour) ++last;
      std::vector<std::vector<Vec2>> lines(last - first);
      parallelFor(first, last, [&](std::size_t k) {
        if (!isCancelled(studio_.cancel)) lines[k - first] = seen(strokes[k]);
      });
      Mask mask(image);
      for (std::size_t k = first; k < last; ++k)
        for (std::size_t p = 0; p + 1 < lines[k - first].size(); p += 2)
          mask.addLine(lines[k - first][p], lines[k - first][p + 1],
                       strokes[k].width * size_.height / 1000);
      mask.paint(image, strokes[first].colour);
      first = last;
    }
  }

  /// The visible parts of a stroke: pairs of ends.
  std::vector<Vec2> seen(const Stroke& stroke) const {
    std::vector<Vec2> ends;
    for (std::size_t k = 1; k < stroke.points.size(); ++k)
      addSeen(stroke.points[k - 1], stroke.points[k], ends);
    return ends;
  }

  /// Tests every few pixels, then finds the exact place where the line goes behind something.
  void addSeen(const Vec3& from, const Vec3& to, std::vector<Vec2>& ends) const {
    constexpr double step = 5;
    if (!isAhead(from) || !isAhead(to)) return;
    const Vec2 a = placeOf(from), b = placeOf(to);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length < 10.0 * size_.width * size_.height)) return;  // it passes the eye
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / step)));
    const auto at = [&](int k) { return from + (static_cast<double>(k) / pieces) * (to - from); };
    bool visible = sees(from);
    for (int k = 1; k <= pieces; ++k) {
      const bool was = visible;
      visible = sees(at(k));
      if (!visible && !was) continue;
      ends.push_back(placeOf(was ? at(k - 1) : lastSeen(at(k), at(k - 1))));
      ends.push_back(placeOf(visible ? at(k) : lastSeen(at(k - 1), at(k))));
    }
  }

  /// The last visible point between a visible and a hidden one.
  Vec3 lastSeen(Vec3 visible, Vec3 hidden) const {
    for (int k = 0; k < 6; ++k) {
      const Vec3 middle = 0.5 * (visible + hidden);
      (sees(middle) ? visible : hidden) = middle;
    }
    return visible;
  }

  void drawLabels(Image& image) const {
    const double unit = size_.height / 1000.0, height = std::max(14 * unit, 8.0);
    for (const Label& label : scene_.labels) {
      if (!sees(label.at)) continue;
      const Vec2 p = placeOf(label.at);
      const double width = textWidth(label.text, height);
      const bool left = p.x + 2 * height + width > size_.width;
      const double side = left ? -1 : 1;
      const Vec2 corner{p.x + side * 1.6 * height, p.y - 1.6 * height};
      // With a rim in the colour of paper, as the background may be of any colour.
      const double line = std::max(2 * unit, 1.0), point = std::max(8 * unit, 4.0), rim = line;
      const double beside = corner.x + side * 0.4 * height - (left ? width : 0);
      const double begin = std::clamp(beside, rim, std::max(rim, size_.width - width - rim));
      const auto write = [&](double x, double y, const Colour& colour) {
        drawText(image, label.text, begin + x, corner.y + 0.2 * height + y, height, colour,
                 Align::left);
      };
      drawLine(image, std::array{p, corner}, line + 2 * rim, kPaper);
      drawLine(image, std::array{p}, point + 2 * rim, kPaper);
      for (const double x : {-rim, 0.0, rim})
        for (const double y : {-rim, 0.0, rim}) write(x, y, kPaper);
      drawLine(image, std::array{p, corner}, line, label.colour);
      drawLine(image, std::array{p}, point, label.colour);
      write(0, 0, label.colour);
    }
  }

  const StudioParts& studio_;
  const Scene& scene_;
  const Camera& camera_;
  PictureSize size_;
  Lamps lamps_;
  Light background_;
  Raster raster_;
  std::vector<float> lamp_;  // [V]
};

}  // namespace

Studio::Studio(std::unique_ptr<StudioParts> parts) : parts_(std::move(parts)) {}
Studio::Studio(Studio&&) noexcept = default;
Studio& Studio::operator=(Studio&&) noexcept = default;
Studio::~Studio() = default;

Result<Studio> Studio::make(Scene scene, const std::atomic<bool>* cancel) {
  if (auto ok = checkScene(scene); !ok) return std::unexpected(ok.error());
  auto obstacles = Obstacles::make(scene.positions, scene.triangles);
  if (!obstacles) return std::unexpected(obstacles.error());
  auto parts = std::make_unique<StudioParts>(
      StudioParts{std::move(scene), std::move(*obstacles), {}, {}, {}, {}, cancel});
  const Scene& s = parts->scene;
  parts->colour = toLight(s.colour);
  parts->vertexColours = toLights(s.vertexColours);
  parts->triangleColours = toLights(s.triangleColours);
  if (s.finish == Finish::skin || s.finish == Finish::matte)
    parts->sky = skyExposure(parts->obstacles, s.positions, s.normals, cancel);
  if (isCancelled(cancel)) return interrupted();
  return Studio(std::move(parts));
}

Result<Image> Studio::shoot(const Camera& camera, PictureSize size) const {
  if (auto ok = checkSize(size); !ok) return std::unexpected(ok.error());
  return Photograph(*parts_, camera, size).take();
}

Result<Image> render(Scene scene, const Camera& camera, PictureSize size,
                     const std::atomic<bool>* cancel) {
  const Result<Studio> studio = Studio::make(std::move(scene), cancel);
  if (!studio) return std::unexpected(studio.error());
  return studio->shoot(camera, size);
}

}  // namespace sweepface
