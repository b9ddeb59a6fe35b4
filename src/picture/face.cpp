#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "sweepface/box.hpp"
#include "sweepface/picture.hpp"

#include "eval/cells.hpp"
#include "eval/interpolated.hpp"
#include "eval/triangulate.hpp"
#include "fit/corner_places.hpp"
#include "fit/vertex_normals.hpp"
#include "picture/lowered.hpp"
#include "picture/materials.hpp"
#include "picture/number.hpp"
#include "picture/styles.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {
namespace {

constexpr Colour kClay{0.90f, 0.875f, 0.85f};
constexpr Colour kLabel{0.15f, 0.15f, 0.17f};

/// The end of a scale that holds all but a hundredth of the values: a number whose quarters are
/// easy to read.
double scaleEnd(std::vector<double> values) {
  if (values.empty()) return 1;
  const auto k = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + k);
  if (!(values[k] > 0)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(values[k])));
  for (const double nice : {1.0, 1.2, 1.6, 2.0, 2.4, 3.0, 4.0, 6.0, 8.0})
    if (nice * decade >= values[k]) return nice * decade;
  return 10 * decade;
}

/// Original meshes are divided into at least this many triangles, so that light is computed all
/// over them.
constexpr std::size_t kTrianglesLit = 50'000;

/// Gives the triangles of a scene the colours of the faces they belong to, and removes clear ones.
void addMaterials(Scene& scene, const std::vector<std::optional<Colour>>& colours,
                  const std::vector<Index>& faceOfTriangle) {
  std::vector<std::array<Index, 3>> kept;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    if (const auto& colour = colours[faceOfTriangle[t]]) {
      kept.push_back(scene.triangles[t]);
      scene.triangleColours.push_back(*colour);
    }
  scene.triangles = std::move(kept);
}

/// Divides each triangle into four in its plane, so that light is computed in more places.
void refine(Scene& scene) {
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [place, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<Index>(scene.positions.size()));
    if (isNew) {
      scene.positions.push_back(0.5 * (scene.positions[a] + scene.positions[b]));
      scene.normals.push_back(normalized(scene.normals[a] + scene.normals[b]));
    }
    return place->second;
  };
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Colour> colours;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto [a, b, c] = scene.triangles[t];
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      triangles.push_back(part);
      colours.push_back(scene.triangleColours[t]);
    }
  }
  scene.triangles = std::move(triangles);
  scene.triangleColours = std::move(colours);
}

}  // namespace

Index lodFor(const Surface& surface, Style style, PictureSize size) {
  // Shading hides corners between edges a few pixels long; reflections show them.
  const double pixels = style == Style::zebra ? 1.5 : 6;
  const auto quads = static_cast<double>(surface.wireframe().quadCount());
  const double shown = 0.35 * size.width * size.height / pixels;
  return std::clamp(static_cast<Index>(std::lround(std::sqrt(shown / std::max(quads, 1.0)))), 1,
                    16);
}

FaceScenes::FaceScenes(const Rig& rig, Index lod)
    : rig_(rig),
      grid_(rig.surface, lod),
      source_(rig.surface, 1),
      cornerPlaces_(cornerPlaces(rig.source, source_)) {
  const std::vector<std::array<Index, 4>> faces = grid_.faces();
  forEachCell(rig.surface, grid_.level(), [&](const Cell& cell) {
    const auto& [a, b, c, d] = faces[cell.face];
    for (const auto& triangle : {std::array{a, b, c}, {a, c, d}}) {
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
        continue;
      triangles_.push_back(triangle);
      patchOf_.push_back(cell.patch);
      quadOf_.push_back(cell.quad);
    }
  });
}

std::vector<Vec3> FaceScenes::points(std::span<const double> weights) const {
  return source_.positions(blend(rig_, weights));
}

std::vector<Vec3> FaceScenes::drawn(std::span<const double> weights) const {
  return grid_.positions(blend(rig_, weights));
}

Scene FaceScenes::scene(std::span<const double> weights, Style style) const {
  const std::vector<Vec3> vectors = blend(rig_, weights);
  Scene scene;
  scene.positions = grid_.positions(vectors);
  scene.normals = grid_.normals(vectors);
  scene.triangles = triangles_;
  scene.colour = kClay;
  scene.finish = Finish::matte;
  switch (style) {
    case Style::shaded: {
      scene.finish = Finish::skin;
      const std::vector<Index> faces = faceOfQuads(rig_);
      if (faces.empty()) {
        scene.colour = *materialColour("");  // skin
        break;
      }
      std::vector<Index> faceOfTriangle;
      for (const Index q : quadOf_) faceOfTriangle.push_back(faces[q]);
      addMaterials(scene, faceColours(rig_.source.polygons), faceOfTriangle);
      break;
    }
    case Style::patches: {
      const std::vector<Colour> tints = patchTints(rig_.surface);
      for (const Index p : patchOf_) scene.triangleColours.push_back(tints[p]);
      break;
    }
    case Style::wireframe:
      scene.strokes = wireStrokes(rig_.surface, vectors);
      break;
    case Style::joins:
      scene.strokes = joinStrokes(rig_.surface, vectors);
      break;
    case Style::normals:
      for (const Vec3& n : scene.normals)
        scene.vertexColours.push_back({static_cast<float>(0.5 + 0.5 * n.x),
                                       static_cast<float>(0.5 + 0.5 * n.y),
                                       static_cast<float>(0.5 + 0.5 * n.z)});
      scene.finish = Finish::flat;
      break;
    case Style::zebra:
      scene.finish = Finish::zebra;
      break;
    case Style::error:
    case Style::angle:
      break;  // heatMap
  }
  return scene;
}

HeatMap FaceScenes::heatMap(std::span<const double> weights, std::span<const Vec3> original,
                            Style style, double top) const {
  const bool angles = style == Style::angle;
  HeatMap map{scene(weights, style), 0, 0, {}};
  const std::vector<double> values =
      angles ? this->angles(map.scene.normals, original)
             : interpolated<double>(rig_.surface, source_, grid_, distances(weights, original));
  const auto worst = std::ranges::max_element(values);
  const double rounding = angles ? 1e-6 : 1e-12 * diagonal(map.scene.positions);
  if (worst != values.end() && *worst > rounding) map.worst = *worst;
  map.top = top > 0 ? top : angles ? scaleEnd(values) : std::max(map.worst, rig_.tolerance);
  map.title =
      angles
          ? fmt::format("angle between the normals in degrees, {} at worst", number(map.worst))
          : fmt::format("distance from the original in its units, {} at worst", number(map.worst));
  for (const double value : values)
    map.scene.vertexColours.push_back(heatColour(map.top > 0 ? value / map.top : 0));
  if (map.worst > 0)
    map.scene.labels.push_back(
        {map.scene.positions[worst - values.begin()], number(map.worst), kLabel});
  return map;
}

std::vector<double> FaceScenes::distances(std::span<const double> weights,
                                          std::span<const Vec3> original) const {
  const std::vector<Vec3> places = points(weights);
  std::vector<double> distances(places.size(), 0);
  const auto compare = [&](std::size_t vertex, Index place) {
    distances[place] = std::max(distances[place], norm(places[place] - original[vertex]));
  };
  for (std::size_t v = 0; v < original.size(); ++v)
    if (const Index place = rig_.source.gridVertex[v]; place >= 0) compare(v, place);
  for (const auto& [v, place] : otherPlaces(rig_.source, cornerPlaces_)) compare(v, place);
  return distances;
}

std::vector<double> FaceScenes::angles(std::span<const Vec3> normals,
                                       std::span<const Vec3> original) const {
  const SourceMesh& source = rig_.source;
  const std::vector<Vec3> corners = vertexNormals(source.polygons, original, cornerPlaces_,
                                                  source_.vertexCount(), source.quadCorners);
  const auto expected = interpolated<Vec3>(rig_.surface, source_, grid_, corners);
  std::vector<double> angles;
  for (std::size_t v = 0; v < expected.size(); ++v)
    angles.push_back(norm(expected[v]) > 0 ? angleDegrees(normals[v], expected[v]) : 0);
  return angles;
}

Scene FaceScenes::original(std::span<const Vec3> positions) const {
  const SourceMesh& source = rig_.source;
  const Polygons& polygons = source.polygons;
  // Faces may have loose corners; their vertices come after the grid's.
  const Index gridCount = source_.vertexCount();
  const Index count = gridCount + static_cast<Index>(source.loose.size());
  std::vector<Index> places = cornerPlaces_;
  for (Index& place : places)
    if (place < 0) place = gridCount - 1 - place;
  Scene scene;
  scene.positions.resize(count);
  for (std::size_t c = 0; c < places.size(); ++c)
    scene.positions[places[c]] = positions[polygons.corners[c]];
  scene.normals = vertexNormals(polygons, positions, places, count, source.quadCorners);
  std::vector<Index> faceOfTriangle;
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const auto corner = [&](Index k) { return places[polygons.faceStart[f] + k]; };
    for (const auto& [a, b, c] : triangulate(cornerPositions(polygons, positions, f))) {
      scene.triangles.push_back({corner(a), corner(b), corner(c)});
      faceOfTriangle.push_back(f);
    }
  }
  addMaterials(scene, faceColours(polygons), faceOfTriangle);
  while (!scene.triangles.empty() && scene.triangles.size() < kTrianglesLit) refine(scene);
  return scene;
}

Result<std::vector<Index>> FaceScenes::region(std::string_view name, std::size_t count) const {
  constexpr double share = 0.5;  // relative to the largest distance that a vertex moves
  const std::vector<Vec3> rest = points(rig_.weightsOf(0));
  std::vector<Index> moved;
  for (std::size_t k = 0; k < std::min(count, rig_.targets.size()); ++k) {
    if (lowered(rig_.targets[k].name).find(lowered(name)) == std::string::npos) continue;
    const std::vector<Vec3> pose = points(rig_.weightsOf(static_cast<Index>(k) + 1));
    double furthest = 0;
    for (std::size_t v = 0; v < rest.size(); ++v)
      furthest = std::max(furthest, norm(pose[v] - rest[v]));
    for (std::size_t v = 0; v < rest.size(); ++v)
      if (furthest > 0 && norm(pose[v] - rest[v]) >= share * furthest)
        moved.push_back(static_cast<Index>(v));
  }
  if (!moved.empty()) return moved;
  return fail(fmt::format(
      "No target whose name contains '{}' moves anything; give the name of one that does.", name));
}

std::vector<Index> FaceScenes::around(std::span<const Index> vertices) const {
  std::vector<bool> given(source_.vertexCount()), near(source_.vertexCount());
  for (const Index v : vertices) given[v] = true;
  for (const auto& quad : source_.faces())
    if (std::ranges::any_of(quad, [&](Index v) { return given[v]; }))
      for (const Index v : quad) near[v] = true;
  std::vector<Index> corners;
  for (Index v = 0; v < source_.vertexCount(); ++v)
    if (near[v]) corners.push_back(v);
  return corners;
}

std::vector<Key> FaceScenes::legend(Style style) const {
  if (style == Style::wireframe) return wireLegend();
  if (style == Style::joins) return joinLegend(rig_.surface);
  return {};
}

Result<std::vector<Vec3>> originalPositions(const Rig& rig, const MeshRig& source,
                                            std::span<const double> weights) {
  if (!rig.source.ownOrder)
    return fail(
        "The face has no source order, it was left out, so that nobody knows which vertex is "
        "which; make the file again with its order.");
  const std::size_t vertices = rig.source.gridVertex.size();
  if (source.neutral.positions.size() != vertices)
    return fail(
        fmt::format("The neutral has {} vertices, but the face was made from {}; give the mesh it "
                    "was converted from, chosen and subdivided in the same way.",
                    source.neutral.positions.size(), vertices));
  std::vector<Vec3> positions = source.neutral.positions;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    const auto target = std::ranges::find(source.targets, rig.targets[k].name, &MeshTarget::name);
    if (target == source.targets.end())
      return fail(
          fmt::format("There is no mesh of '{}' to compare with; give the targets that the face "
                      "was converted from.",
                      rig.targets[k].name));
    if (target->positions.size() != vertices)
      return fail(fmt::format("The mesh of '{}' has {} vertices, but the neutral has {}.",
                              target->name, target->positions.size(), vertices));
    for (std::size_t v = 0; v < vertices; ++v)
      positions[v] += weights[k] * (target->positions[v] - source.neutral.positions[v]);
  }
  return positions;
}

}  // namespace sweepface
