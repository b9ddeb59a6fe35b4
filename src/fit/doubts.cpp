#include "fit/doubts.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

#include "sweepface/fit.hpp"

#include "fit/coarseness.hpp"
#include "fit/listed.hpp"
#include "io/text.hpp"
#include "mesh/each_edge.hpp"
#include "mesh/median.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {
namespace {

// A tolerance is doubtful above this share of the diagonal, about a head's nose, or so many edges.
constexpr double kOfSize = 0.05, kOfEdges = 4;
// No expression makes most edges this many times as long, or as short.
constexpr double kStretch = 2;
// If a target has other axes, changing them leaves less than this share of its squared movement. No
// sensible rig moves most targets by this share of the diagonal.
constexpr double kLeft = 0.25, kWay = 0.5;

// Creases between vertices show if half of the faces lean this many degrees from their normals and
// the tolerance is below this many times the height by which that makes them stand out. Meshes of
// fewer faces than this are not expected to be smooth.
constexpr double kLean = 2.5, kSmoothly = 5;
constexpr Index kManyFaces = 1000;

/// The edges and the vertices of faces, each once.
struct Outline {
  std::vector<std::pair<Index, Index>> edges;
  std::vector<Index> vertices;

  explicit Outline(const Polygons& faces) : vertices(faces.corners) {
    eachEdge(faces, [&](Index a, Index b, Index) { edges.push_back(std::minmax({a, b})); });
    sortOut(edges);
    sortOut(vertices);
  }

 private:
  static void sortOut(auto& list) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
  }
};

/// The median length of edges longer than 0; 0 if there are none.
double medianEdge(const Outline& outline, const std::vector<Vec3>& positions) {
  std::vector<double> lengths;
  for (const auto& [a, b] : outline.edges)
    if (const double length = norm(positions[a] - positions[b]); length > 0)
      lengths.push_back(length);
  return median(std::move(lengths));
}

/// The median factor by which a target stretches edges, of those longer than 0 in the neutral.
double stretchOf(const Outline& outline, const std::vector<Vec3>& neutral,
                 const std::vector<Vec3>& target) {
  std::vector<double> stretches;
  for (const auto& [a, b] : outline.edges)
    if (const double length = norm(neutral[a] - neutral[b]); length > 0)
      stretches.push_back(norm(target[a] - target[b]) / length);
  return stretches.empty() ? 1 : median(std::move(stretches));
}

Vec3 centreOf(const Outline& outline, const std::vector<Vec3>& positions) {
  Vec3 sum;
  for (const Index v : outline.vertices) sum += positions[v];
  return sum * (1.0 / static_cast<double>(outline.vertices.size()));
}

/// How a target lies relative to the neutral as a whole: the motion that brings the neutral nearest
/// to it (Kabsch 1976).
struct Attitude {
  bool mirrored = false;
  bool swapsAxes = false;  ///< nearly a turn that maps axes to axes; heads do not turn like that
  double degrees = 0;      ///< to the nearest 30: such turns are by 90, 120 or 180
  double left = 0;         ///< share of the target's squared movement about its centre that is left
};
Attitude attitudeOf(const Outline& outline, const std::vector<Vec3>& neutral,
                    const std::vector<Vec3>& target) {
  constexpr double kClearly = 0.02;  // flat faces fit as well mirrored
  constexpr double kNearly = 0.99;   // the cosine of 8 degrees
  const Vec3 from = centreOf(outline, neutral), to = centreOf(outline, target);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double sizes = 0, movement = 0;
  for (const Index v : outline.vertices) {
    const Vec3 a = neutral[v] - from, b = target[v] - to;
    covariance += Eigen::Vector3d(b.x, b.y, b.z) * Eigen::RowVector3d(a.x, a.y, a.z);
    sizes += dot(a, a) + dot(b, b);
    movement += dot(b - a, b - a);
  }
  const Eigen::JacobiSVD svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d values = svd.singularValues();
  Eigen::Matrix3d u = svd.matrixU();
  const bool reflects = (u * svd.matrixV().transpose()).determinant() < 0;
  Attitude attitude;
  attitude.mirrored = reflects && values[2] > kClearly * values.sum();
  double fit = values.sum();
  if (reflects && !attitude.mirrored) u.col(2) *= -1, fit -= 2 * values[2];
  const Eigen::Matrix3d turn = u * svd.matrixV().transpose();
  attitude.swapsAxes = (turn.cwiseAbs().rowwise().maxCoeff().array() > kNearly).all();
  const double cosine = (turn.trace() - 1) / 2;
  attitude.degrees =
      30 * std::round(std::acos(std::clamp(cosine, -1.0, 1.0)) * 6 / std::numbers::pi);
  attitude.left = movement > 0 ? (sizes - 2 * fit) / movement : 1;
  return attitude;
}

/// What may be wrong with a target; the first that applies.
struct TargetDoubt {
  enum Kind { none, neutral, units, axes, origin } kind = none;
  std::string detail;
};

TargetDoubt doubtAbout(const Outline& outline, const std::vector<Vec3>& neutral,
                       const std::vector<Vec3>& target, double size) {
  if (std::ranges::all_of(outline.vertices, [&](Index v) { return target[v] == neutral[v]; }))
    return {TargetDoubt::neutral, {}};
  const double stretch = stretchOf(outline, neutral, target);
  if (!(stretch < kStretch && stretch > 1 / kStretch))
    return {TargetDoubt::units, fmt::format(" (edges {:.3g} times as long)", stretch)};
  const Attitude attitude = attitudeOf(outline, neutral, target);
  if (attitude.left < kLeft && attitude.mirrored) return {TargetDoubt::axes, " (mirrored)"};
  if (attitude.left < kLeft && attitude.swapsAxes && attitude.degrees > 45)
    return {TargetDoubt::axes, fmt::format(" (turned by {:.0f} degrees)", attitude.degrees)};
  const double way = norm(centreOf(outline, target) - centreOf(outline, neutral));
  if (way > kWay * size) return {TargetDoubt::origin, fmt::format(" ({:.3g} away)", way)};
  return {};
}

/// Empty if a surface is smooth between the vertices that it follows. Beyond a tolerance of `most`,
/// finer forms are lost.
std::string doubtBetweenVertices(const PolygonMesh& neutral, double tolerance, double most) {
  if (neutral.polygons.faceCount() < kManyFaces) return {};
  const Coarseness coarse = coarsenessOf(neutral);
  const double smooth = kSmoothly * coarse.height;
  if (!(coarse.degrees > kLean && tolerance < smooth)) return {};
  const double digit = std::pow(10, std::floor(std::log10(smooth)));
  const double better = std::ceil(smooth / digit) * digit;
  return fmt::format(
      "The mesh is coarse for its shape, as if it were made to be subdivided: half of its faces "
      "lean {:.2g} degrees or more from the normals of their vertices. A surface within {:.3g} of "
      "every vertex may look creased between them. If it is a cage, give --subdivide, or a higher "
      "level of it; otherwise compare pictures{}.",
      coarse.degrees, tolerance,
      better < most ? fmt::format(", and try a tolerance of {:.3g}", better) : "");
}

bool isCalledNeutral(std::string_view name) {
  constexpr std::array names{"neutral", "basis", "rest"};
  return std::ranges::any_of(names, [&](const char* each) { return io::sameLetters(name, each); });
}

}  // namespace

std::vector<std::string> doubtsAbout(const MeshRig& source, double tolerance) {
  const Outline outline(source.neutral.polygons);
  if (outline.vertices.empty()) return {};
  const std::vector<Vec3>& neutral = source.neutral.positions;
  std::vector<std::string> sentences;
  const double size = diagonal(source.neutral), edge = medianEdge(outline, neutral);
  const double most = std::min(kOfSize * size, edge > 0 ? kOfEdges * edge : HUGE_VAL);
  if (tolerance > most)
    sentences.push_back(fmt::format(
        "The tolerance, {:.3g}, is {:.2g} % of the mesh's size and {:.2g} times as long as most "
        "edges, so that finer forms are lost; give a finer one if it was meant in other units, or "
        "if some part makes the mesh look large.",
        tolerance, 100 * tolerance / size, edge > 0 ? tolerance / edge : 0));
  if (auto sentence = doubtBetweenVertices(source.neutral, tolerance, most); !sentence.empty())
    sentences.push_back(std::move(sentence));

  std::vector<TargetDoubt> doubts(source.targets.size());
  parallelFor(std::size_t{0}, doubts.size(), [&](std::size_t t) {
    doubts[t] = doubtAbout(outline, neutral, source.targets[t].positions, size);
  });
  using Doubts = std::vector<std::pair<std::string, std::string>>;
  const auto of = [&](TargetDoubt::Kind kind) {
    Doubts found;
    for (std::size_t t = 0; t < doubts.size(); ++t)
      if (doubts[t].kind == kind) found.emplace_back(source.targets[t].name, doubts[t].detail);
    return found;
  };
  const auto tell = [&](const Doubts& found, std::string_view what) {
    if (!found.empty())
      sentences.push_back(fmt::format("Targets that {}: {}.", what, listed(found)));
  };
  const Doubts still = of(TargetDoubt::neutral), away = of(TargetDoubt::origin);
  tell(still, "are the same as the neutral");
  Doubts neutrals;
  for (std::size_t t = 0; t < doubts.size(); ++t)
    if (doubts[t].kind != TargetDoubt::neutral && isCalledNeutral(source.targets[t].name))
      neutrals.emplace_back(source.targets[t].name, "");
  if (!neutrals.empty())
    sentences.push_back(
        fmt::format("Targets that are called like a neutral but are others: {}; the neutral may be "
                    "an expression that was given instead.",
                    listed(neutrals)));
  tell(of(TargetDoubt::units), "may be in other units, or have their vertices in another order");
  tell(of(TargetDoubt::axes), "may have other axes");
  // Lower teeth move far for their size, but hardly in most targets.
  if (2 * away.size() > doubts.size() - still.size()) tell(away, "may have another origin");
  return sentences;
}

}  // namespace sweepface
