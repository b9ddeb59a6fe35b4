#include <fmt/format.h>

#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"

#include "face_page.hpp"

namespace sweepface::cli {
namespace {

/// What the face is compared with.
struct Original {
  std::string name;
  std::vector<Vec3> positions;
  double diagonal;
};

class ExpressionPage {
 public:
  explicit ExpressionPage(const Rendering& what) : what_(what), page_(what) {}

  Result<Image> portraits(const Weights& weights) {
    const bool many = viewCount() > 1;
    if (auto ok = page_.layOut({viewCount(), 1, many, isKeyed()},
                               many ? PictureSize{640, 800} : PictureSize{960, 1200});
        !ok)
      return std::unexpected(ok.error());
    const Result<Studio> studio = Studio::make(page_.scenes().scene(weights, what_.style));
    if (!studio) return std::unexpected(studio.error());
    const auto cameras = camerasFor(weights);
    if (!cameras) return std::unexpected(cameras.error());
    for (Index k = 0; k < viewCount(); ++k)
      if (auto ok = page_.shoot(*studio, (*cameras)[k], k, 0, many ? nameOf(what_.views[k]) : "");
          !ok)
        return std::unexpected(ok.error());
    if (isKeyed()) page_.addLegend();
    return page_.image();
  }

  Result<Image> besideMeshes(const Weights& weights) {
    const std::vector<std::string>& paths = what_.arguments.compare;
    const MeshArguments meshes{paths.front(),
                               {paths.begin() + 1, paths.end()},
                               what_.arguments.chosen,
                               what_.arguments.subdivisions};
    const Result<RigSource> read = [&] {
      ProgressBar bar(what_.arguments.quiet);
      return readMeshes(meshes, bar);
    }();
    if (!read) return std::unexpected(read.error());
    warnOfOtherMeshes(what_.rig, read->rig);
    const Result<std::vector<Vec3>> positions = originalPositions(what_.rig, read->rig, weights);
    if (!positions) return std::unexpected(positions.error());
    return beside({"original", *positions, diagonal(read->rig.neutral)}, "recreated", weights);
  }

  /// Shows what arcs and the like change in the plain blend.
  Result<Image> besideStraight(const Weights& weights) {
    const FollowingArguments& following = what_.arguments.following;
    const bool followsArcsOnly =
        following.arcs == "on" && following.eyes != "on" && !following.combine;
    PolygonMesh rest;
    rest.positions = sourceVertices(what_.rig, {});
    return beside({"straight", what_.straight, diagonal(rest)},
                  followsArcsOnly ? "on arcs" : "followed", weights);
  }

 private:
  Result<Image> beside(const Original& original, const std::string& name, const Weights& weights) {
    const bool heat = isHeat(what_.style), oneView = viewCount() == 1;
    if (auto ok = page_.layOut(
            {oneView ? 2 : viewCount(), oneView ? 1 : 2, true, heat || isKeyed()}, {640, 800});
        !ok)
      return std::unexpected(ok.error());
    HeatMap map = heat ? page_.scenes().heatMap(weights, original.positions, what_.style)
                       : HeatMap{page_.scenes().scene(weights, what_.style), 0, 0, {}};
    const auto cameras = camerasFor(weights);
    if (!cameras) return std::unexpected(cameras.error());
    const Result<Studio> first = Studio::make(page_.scenes().original(original.positions));
    if (!first) return std::unexpected(first.error());
    const Result<Studio> second = Studio::make(std::move(map.scene));
    if (!second) return std::unexpected(second.error());
    for (Index k = 0; k < viewCount(); ++k) {
      const Camera& camera = (*cameras)[k];
      const std::string view = oneView ? "" : ", " + nameOf(what_.views[k]);
      const Index column = oneView ? 1 : k, row = oneView ? 0 : 1;
      if (auto ok = page_.shoot(*first, camera, k, 0, original.name + view); !ok)
        return std::unexpected(ok.error());
      if (auto ok = page_.shoot(*second, camera, column, row, name + view); !ok)
        return std::unexpected(ok.error());
    }
    if (heat)
      page_.addScale(map.top, titleOf(map, original));
    else if (isKeyed())
      page_.addLegend();
    return page_.image();
  }

  std::string titleOf(const HeatMap& map, const Original& original) const {
    if (what_.style != Style::error) return map.title;
    return fmt::format(
        "{} ({:.2g} % of the diagonal)",
        what_.arguments.compare.empty()
            ? fmt::format("distance from the straight blend, {:.3g} at worst", map.worst)
            : map.title,
        100 * map.worst / original.diagonal);
  }

  Result<std::vector<Camera>> camerasFor(const Weights& weights) const {
    const auto points = page_.shown(weights);
    if (!points) return std::unexpected(points.error());
    return frameCameras(*points, what_.views, page_.panel());
  }

  Index viewCount() const { return static_cast<Index>(what_.views.size()); }
  bool isKeyed() const { return what_.style == Style::wireframe || what_.style == Style::joins; }

  const Rendering& what_;
  FacePage page_;
};

}  // namespace

std::vector<Vec3> sourceVertices(const Rig& rig, const Weights& weights) {
  return sourcePositions(rig, Tessellation(rig.surface, 1), blend(rig, weights), weights);
}

Result<Image> drawExpression(const Rendering& what, Weights weights) {
  what.following.apply(weights);
  ExpressionPage page(what);
  if (!what.arguments.compare.empty()) return page.besideMeshes(weights);
  return isHeat(what.style) ? page.besideStraight(weights) : page.portraits(weights);
}

}  // namespace sweepface::cli
