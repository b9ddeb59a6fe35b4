#include "sweepface/measure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tbb/parallel_for.h>

#include "sweepface/eval.hpp"

#include "fit/vertex_normals.hpp"

namespace sweepface {

namespace {

constexpr Index kLevel = 4;  // of the tessellation that is compared with the facets

// The distance from p to the triangle abc (Ericson, Real-Time Collision Detection, 5.1.5).
double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return norm(ap);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return norm(ap - ab * (d1 - d3 > 0 ? d1 / (d1 - d3) : 0));
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return norm(ap - ac * (d2 - d6 > 0 ? d2 / (d2 - d6) : 0));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double sum = d4 - d3 + d5 - d6;
    return norm(bp - (c - b) * (sum > 0 ? (d4 - d3) / sum : 0));
  }
  const double sum = va + vb + vc;
  return norm(p - (a + ab * (vb / sum) + ac * (vc / sum)));
}

// Which source face each grid quad belongs to, and which faces lie round it.
struct FaceMap {
  std::vector<Index> faceOfQuad;
  std::vector<std::vector<Index>> around;  // [F] faces that share a vertex, itself first
  std::map<std::pair<Index, Index>, std::pair<Index, Index>>
      rims;  // boundary edge → corners before and after

  FaceMap(const SourceMesh& source) {
    const Polygons& p = source.polygons;
    std::vector<Index> faceOfCorner(p.corners.size());
    std::vector<std::vector<Index>> facesAt(source.gridVertex.size());
    for (Index f = 0; f < p.faceCount(); ++f)
      for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) {
        faceOfCorner[c] = f;
        facesAt[p.corners[c]].push_back(f);
      }
    for (std::size_t q = 0; q < source.quadCorners.size(); q += 4)
      faceOfQuad.push_back(faceOfCorner[source.quadCorners[q]]);
    around.resize(p.faceCount());
    for (Index f = 0; f < p.faceCount(); ++f) {
      std::vector<Index>& list = around[f];
      for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c)
        list.insert(list.end(), facesAt[p.corners[c]].begin(), facesAt[p.corners[c]].end());
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      std::iter_swap(list.begin(), std::find(list.begin(), list.end(), f));
    }
    findRims(source);
  }

 private:
  // The edges that one face alone has, each with the vertices before and after it along the
  // boundary.
  void findRims(const SourceMesh& source) {
    const Polygons& p = source.polygons;
    std::map<std::pair<Index, Index>, std::pair<Index, Index>> edges;  // welded ends → corners
    for (Index f = 0; f < p.faceCount(); ++f)
      for (Index k = 0; k < p.faceSize(f); ++k) {
        const Index a = p.faceStart[f] + k, b = p.faceStart[f] + (k + 1) % p.faceSize(f);
        edges[{source.gridVertex[p.corners[a]], source.gridVertex[p.corners[b]]}] = {a, b};
      }
    std::map<Index, Index> before, after;
    for (const auto& [ends, corners] : edges)
      if (!edges.contains({ends.second, ends.first})) {
        after[ends.first] = corners.second;
        before[ends.second] = corners.first;
      }
    for (const auto& [ends, corners] : edges)
      if (!edges.contains({ends.second, ends.first}) && before.contains(ends.first) &&
          after.contains(ends.second))
        rims[{corners.first, corners.second}] = {before[ends.first], after[ends.second]};
  }
};

// The facets of one pose of the source.
class Facets {
 public:
  Facets(const SourceMesh& source, const FaceMap& map, std::span<const Vec3> positions,
         std::span<const Vec3> gridNormals, double tolerance)
      : polygons_(source.polygons),
        gridVertex_(source.gridVertex),
        map_(map),
        positions_(positions),
        gridNormals_(gridNormals),
        tolerance_(tolerance) {}

  double distance(const Vec3& p, Index face) const {
    double best = 1e300;
    for (Index f : map_.around[face]) best = std::min(best, distanceToFace(p, f));
    return best;
  }
  // Twice the vector area.
  Vec3 normal(Index face) const {
    Vec3 sum;
    const Index begin = polygons_.faceStart[face], size = polygons_.faceSize(face);
    for (Index k = 1; k + 1 < size; ++k)
      sum += cross(at(begin + k) - at(begin), at(begin + k + 1) - at(begin));
    return sum;
  }
  // How far a smooth surface with the source's vertex normals rises above the flat face: an edge
  // whose end normals differ by a small angle is the chord of an arc that rises by length · angle /
  // 8, and a face bulges by the sum of its two directions. A boundary edge rises within the surface
  // as well: by an eighth of the second difference of the boundary's vertices.
  double sag(Index face) const {
    const Index begin = polygons_.faceStart[face], size = polygons_.faceSize(face);
    double rise[2] = {0, 0};
    for (Index k = 0; k < size; ++k) {
      const Index a = begin + k, b = begin + (k + 1) % size;
      rise[k % 2] =
          std::max(rise[k % 2], std::abs(dot(normalAt(b) - normalAt(a), at(b) - at(a))) / 8);
    }
    double rim = 0;
    for (Index k = 0; k < size; ++k) {
      const Index a = begin + k, b = begin + (k + 1) % size;
      if (const auto it = map_.rims.find({a, b}); it != map_.rims.end())
        rim = std::max({rim, norm(at(it->second.first) - 2 * at(a) + at(b)) / 8,
                        norm(at(a) - 2 * at(b) + at(it->second.second)) / 8});
    }
    return rise[0] + rise[1] + rim;
  }
  // A face that is folded, thinner than its vertices may move, or turned against the source's own
  // normal at a corner says nothing about which way is out.
  bool isSound(Index face) const {
    const Vec3 n = normal(face);
    const Index begin = polygons_.faceStart[face], size = polygons_.faceSize(face);
    double longest = 0;
    for (Index k = 0; k < size; ++k) {
      const Vec3 p = at(begin + k), next = at(begin + (k + 1) % size) - p;
      longest = std::max(longest, norm(next));
      const Vec3 corner = cross(next, at(begin + (k + size - 1) % size) - p);
      if (dot(corner, n) <= 0.05 * dot(n, n) / size) return false;
      if (dot(normalAt(begin + k), n) < 0) return false;
    }
    return norm(n) / 2 > tolerance_ * longest;
  }

 private:
  Vec3 at(Index corner) const { return positions_[polygons_.corners[corner]]; }
  Vec3 normalAt(Index corner) const {
    const Index g = gridVertex_[polygons_.corners[corner]];
    return g >= 0 ? gridNormals_[g] : Vec3{};
  }
  double distanceToFace(const Vec3& p, Index f) const {
    double best = 1e300;
    const Index begin = polygons_.faceStart[f], size = polygons_.faceSize(f);
    for (Index k = 1; k + 1 < size; ++k)
      best = std::min(best, distanceToTriangle(p, at(begin), at(begin + k), at(begin + k + 1)));
    if (size == 4)  // both diagonals are as good
      best = std::min({best, distanceToTriangle(p, at(begin + 1), at(begin + 2), at(begin + 3)),
                       distanceToTriangle(p, at(begin + 1), at(begin + 3), at(begin))});
    return best;
  }

  const Polygons& polygons_;
  const std::vector<Index>& gridVertex_;
  const FaceMap& map_;
  std::span<const Vec3> positions_, gridNormals_;
  double tolerance_;
};

struct PoseSamples {
  PoseErrors errors;
  std::vector<double> distances, angles;
};

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::size_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

void summarize(PoseErrors& e, std::vector<double>& distances, std::vector<double>& angles) {
  e.distanceRms = rms(distances);
  e.distance999 = quantile(distances, 0.999);
  e.distanceMax = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
  e.angleRms = rms(angles);
  e.angle999 = quantile(angles, 0.999);
  e.angleMax = angles.empty() ? 0 : *std::max_element(angles.begin(), angles.end());
}

class Meter {
 public:
  explicit Meter(const Rig& rig)
      : rig_(rig),
        grid_(rig.surface, 1),
        fine_(rig.surface, kLevel),
        fineFaces_(fine_.faces()),
        map_(rig.source) {}

  PoseSamples measure(std::string name, const Weights& weights,
                      std::span<const Vec3> source) const {
    PoseSamples s;
    s.errors.name = std::move(name);
    const auto vectors = blend(rig_, weights);
    const auto expected =
        vertexNormals(rig_.source.polygons, source, rig_.source.gridVertex, grid_.vertexCount());
    atVertices(s, weights, vectors, source, expected);
    betweenVertices(s, vectors, Facets(rig_.source, map_, source, expected, rig_.tolerance));
    summarize(s.errors, s.distances, s.angles);
    return s;
  }

 private:
  void atVertices(PoseSamples& s, const Weights& weights, std::span<const Vec3> vectors,
                  std::span<const Vec3> source, std::span<const Vec3> expected) const {
    const auto positions = sourcePositions(rig_, grid_, vectors, weights);
    const auto normals = grid_.normals(vectors);
    std::vector<char> seen(grid_.vertexCount(), 0);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      s.distances.push_back(norm(positions[v] - source[v]));
      const Index g = rig_.source.gridVertex[v];
      if (g < 0 || seen[g] || norm(expected[g]) == 0) continue;
      seen[g] = 1;
      s.angles.push_back(angleDegrees(normals[g], expected[g]));
    }
  }

  void betweenVertices(PoseSamples& s, std::span<const Vec3> vectors, const Facets& facets) const {
    const auto positions = fine_.positions(vectors);
    std::size_t face = 0, quad = 0;
    for (Index p = 0; p < rig_.surface.patchCount(); ++p) {
      const Index m = rig_.surface.edgesU(p), n = rig_.surface.edgesV(p);
      for (Index j = 0; j < kLevel * n; ++j)
        for (Index i = 0; i < kLevel * m; ++i, ++face) {
          const Index sourceFace = map_.faceOfQuad[quad + (j / kLevel) * m + i / kLevel];
          s.errors.folds += folds(fineFaces_[face], positions, facets, sourceFace);
        }
      for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < m; ++i)
          compareFacet(s.errors, p, i, j, positions, facets, map_.faceOfQuad[quad + j * m + i]);
      quad += static_cast<std::size_t>(m) * n;
    }
  }

  static Index folds(const std::array<Index, 4>& q, const std::vector<Vec3>& x,
                     const Facets& facets, Index face) {
    const Vec3 n = facets.normal(face);
    Index count = 0;
    for (const auto& [a, b, c] : {std::array{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}) {
      const Vec3 t = cross(x[b] - x[a], x[c] - x[a]);
      if (dot(t, n) < 0 && facets.isSound(face)) ++count;
    }
    return count;
  }

  void compareFacet(PoseErrors& e, Index patch, Index i, Index j,
                    const std::vector<Vec3>& positions, const Facets& facets, Index face) const {
    const double sag = facets.sag(face);
    for (Index b = 0; b <= kLevel; ++b)
      for (Index a = 0; a <= kLevel; ++a) {
        const double distance =
            facets.distance(positions[fine_.vertex(patch, kLevel * i + a, kLevel * j + b)], face);
        e.facetDistance = std::max(e.facetDistance, distance);
        e.facetExcess = std::max(e.facetExcess, distance - sag);
      }
  }

  const Rig& rig_;
  Tessellation grid_, fine_;
  std::vector<std::array<Index, 4>> fineFaces_;
  FaceMap map_;
};

Result<std::vector<std::pair<Weights, const std::vector<Vec3>*>>> matchShapes(
    const Rig& rig, const MeshRig& source) {
  const std::size_t vertices = rig.source.gridVertex.size();
  if (source.neutral.positions.size() != vertices)
    return fail("the neutral has " + std::to_string(source.neutral.positions.size()) +
                " vertices, the model was made from " + std::to_string(vertices) +
                "; give the mesh it was converted from");
  std::vector<std::pair<Weights, const std::vector<Vec3>*>> shapes;
  shapes.emplace_back(Weights(rig.targets.size(), 0.0), &source.neutral.positions);
  for (const MeshTarget& t : source.targets) {
    const Index k = rig.find(t.name);
    if (k < 0)
      return fail("the model has no target named '" + t.name +
                  "'; give the targets it was converted from");
    shapes.emplace_back(Weights(rig.targets.size(), 0.0), &t.positions);
    shapes.back().first[k] = 1;
  }
  return shapes;
}

// The source's own linear blend under weights for some of its targets.
std::vector<Vec3> blendSource(const Rig& rig, const MeshRig& source, const Weights& weights) {
  std::vector<Vec3> positions = source.neutral.positions;
  for (const MeshTarget& t : source.targets) {
    const double w = weights[rig.find(t.name)];
    if (w == 0) continue;
    for (std::size_t v = 0; v < positions.size(); ++v)
      positions[v] += w * (t.positions[v] - source.neutral.positions[v]);
  }
  return positions;
}

Weights randomWeights(const Rig& rig, const MeshRig& source, std::mt19937& random) {
  Weights weights(rig.targets.size(), 0.0);
  const auto unit = [&] { return static_cast<double>(random() >> 8) / (1 << 24); };
  const std::size_t active = 1 + random() % std::min<std::size_t>(10, source.targets.size());
  for (std::size_t k = 0; k < active; ++k)
    weights[rig.find(source.targets[random() % source.targets.size()].name)] = unit();
  return weights;
}

}  // namespace

Result<Measurement> measure(const Rig& rig, const MeshRig& source, const MeasureOptions& options) {
  if (!rig.source.ownOrder)
    return fail(
        "the face has no source order, it was left out, so that nobody knows which vertex is "
        "which; convert the source again without --strip order");
  const auto shapes = matchShapes(rig, source);
  if (!shapes) return std::unexpected(shapes.error());
  const Meter meter(rig);
  std::vector<PoseSamples> samples(shapes->size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t k) {
    samples[k] = meter.measure(k == 0 ? "neutral" : source.targets[k - 1].name, (*shapes)[k].first,
                               *(*shapes)[k].second);
  });

  Measurement result;
  std::vector<double> distances, angles;
  PoseErrors& worst = result.worst;
  for (PoseSamples& s : samples) {
    distances.insert(distances.end(), s.distances.begin(), s.distances.end());
    angles.insert(angles.end(), s.angles.begin(), s.angles.end());
    worst.facetDistance = std::max(worst.facetDistance, s.errors.facetDistance);
    worst.facetExcess = std::max(worst.facetExcess, s.errors.facetExcess);
    worst.folds += s.errors.folds;
    result.shapes.push_back(std::move(s.errors));
  }
  summarize(worst, distances, angles);
  worst.name = "all";

  if (source.targets.empty()) return result;
  std::mt19937 random(options.seed);
  std::vector<Weights> mixtures;
  for (int k = 0; k < options.mixtures; ++k) mixtures.push_back(randomWeights(rig, source, random));
  result.mixtures.resize(mixtures.size());
  tbb::parallel_for(std::size_t{0}, mixtures.size(), [&](std::size_t k) {
    result.mixtures[k] = meter
                             .measure("mixture " + std::to_string(k + 1), mixtures[k],
                                      blendSource(rig, source, mixtures[k]))
                             .errors;
  });
  return result;
}

}  // namespace sweepface
