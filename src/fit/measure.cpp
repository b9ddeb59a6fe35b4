#include "sweepface/measure.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "sweepface/eval.hpp"

#include "eval/cells.hpp"
#include "eval/interpolated.hpp"
#include "fit/corner_places.hpp"
#include "fit/facets.hpp"
#include "fit/vertex_normals.hpp"
#include "parallel/parallel.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {

namespace {

struct PoseSamples {
  PoseErrors errors;
  // From the source's vertices to their points on the surface; those of other sheets come last.
  std::vector<Vec3> offsets;
  std::vector<double> distances, displacements, angles;
  double shadingSquares = 0, shadingCount = 0;  // of the angles at all vertices of level 4
};

/// The summary of errors in ascending order.
ErrorSummary summaryOfSorted(std::span<const double> errors) {
  if (errors.empty()) return {};
  // The smallest error that at least this share of them do not exceed.
  const auto quantile = [&](double q) {
    const double rank = std::ceil(q * static_cast<double>(errors.size()));
    return errors[static_cast<std::size_t>(std::max(rank - 1, 0.0))];
  };
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return {std::sqrt(sum / static_cast<double>(errors.size())), quantile(0.99), quantile(0.999),
          errors.back()};
}

double rootOfMean(double sum, double count) { return count > 0 ? std::sqrt(sum / count) : 0; }

/// A vertex that moves by d in the source moves by d + offset - offset of the neutral.
void summarize(PoseSamples& s, std::span<const Vec3> neutralOffsets) {
  for (std::size_t v = 0; v < s.offsets.size(); ++v)
    s.displacements.push_back(norm(s.offsets[v] - neutralOffsets[v]));
  s.errors.distance = summaryOf(s.distances);
  s.errors.displacement = summaryOf(s.displacements);
  s.errors.angle = summaryOf(s.angles);
}

class Meter {
 public:
  Meter(const Rig& rig, std::span<const Vec3> neutral, bool facets)
      : facets_(facets),
        rig_(rig),
        grid_(rig.surface, 1),
        fine_(rig.surface, kFineLevel),
        fineFaces_(fine_.faces()),
        map_(rig, cornerPlaces(rig.source, grid_), neutral),
        others_(otherPlaces(rig.source, map_.cornerPlaces)) {}

  PoseSamples measure(std::string name, const Weights& weights,
                      std::span<const Vec3> source) const {
    PoseSamples s;
    s.errors.name = std::move(name);
    const auto vectors = blend(rig_, weights);
    const auto expected = vertexNormals(rig_.source.polygons, source, map_.cornerPlaces,
                                        grid_.vertexCount(), rig_.source.quadCorners);
    atVertices(s, weights, vectors, source, expected);
    if (facets_) {
      betweenVertices(s, vectors, Facets(rig_.source, map_, source, expected, rig_.tolerance));
      compareShading(s, vectors, expected);
    }
    return s;
  }

 private:
  void atVertices(PoseSamples& s, const Weights& weights, std::span<const Vec3> vectors,
                  std::span<const Vec3> source, std::span<const Vec3> expected) const {
    const auto positions = sourcePositions(rig_, grid_, vectors, weights);
    for (std::size_t v = 0; v < positions.size(); ++v)
      s.offsets.push_back(positions[v] - source[v]);
    if (!others_.empty()) {
      const std::vector<Vec3> places = grid_.positions(vectors);
      for (const auto& [vertex, place] : others_)
        s.offsets.push_back(places[place] - source[vertex]);
    }
    for (const Vec3& offset : s.offsets) s.distances.push_back(norm(offset));
    s.angles = normalAngles(expected, grid_.normals(vectors));
  }

  void betweenVertices(PoseSamples& s, std::span<const Vec3> vectors, const Facets& facets) const {
    const auto positions = fine_.positions(vectors);
    forEachCell(rig_.surface, kFineLevel, [&](const Cell& cell) {
      s.errors.folds += facets.folds(fineFaces_[cell.face], positions, map_.faceOfQuad[cell.quad]);
    });
    forEachCell(rig_.surface, 1,
                [&](const Cell& quad) { compareFacet(s.errors, quad, positions, facets); });
  }

  void compareFacet(PoseErrors& e, const Cell& at, const std::vector<Vec3>& positions,
                    const Facets& facets) const {
    const Index face = map_.faceOfQuad[at.quad];
    const double sag = facets.sag(face);
    for (Index b = 0; b <= kFineLevel; ++b)
      for (Index a = 0; a <= kFineLevel; ++a) {
        const Index vertex = fine_.vertex(at.patch, kFineLevel * at.i + a, kFineLevel * at.j + b);
        const double distance = facets.distance(positions[vertex], face);
        e.facetDistance = std::max(e.facetDistance, distance);
        e.facetExcess = std::max(e.facetExcess, distance - sag);
      }
  }

  void compareShading(PoseSamples& s, std::span<const Vec3> vectors,
                      std::span<const Vec3> expected) const {
    const auto drawn = interpolated(rig_.surface, grid_, fine_, expected);
    for (const double angle : normalAngles(drawn, fine_.normals(vectors))) {
      s.shadingSquares += angle * angle;
      ++s.shadingCount;
    }
    s.errors.shadingRms = rootOfMean(s.shadingSquares, s.shadingCount);
  }

  bool facets_;
  const Rig& rig_;
  Tessellation grid_, fine_;
  std::vector<std::array<Index, 4>> fineFaces_;
  FaceMap map_;
  std::vector<OtherPlace> others_;
};

Result<std::vector<std::pair<Weights, const std::vector<Vec3>*>>> matchShapes(
    const Rig& rig, const MeshRig& source) {
  if (!rig.knowsTargets())
    return fail("the targets of the face are not decoded yet; decode them before it is measured");
  const std::size_t vertices = rig.source.gridVertex.size();
  if (source.neutral.positions.size() != vertices)
    return fail("the neutral has ", source.neutral.positions.size(),
                " vertices, the model was made from ", vertices,
                "; give the mesh it was converted from, chosen and subdivided in the same way");
  std::vector<std::pair<Weights, const std::vector<Vec3>*>> shapes;
  shapes.emplace_back(Weights(rig.targets.size(), 0.0), &source.neutral.positions);
  for (const MeshTarget& t : source.targets) {
    const Index k = rig.find(t.name);
    if (k < 0)
      return fail("the model has no target named '" + t.name +
                  "'; give the targets it was converted from");
    if (t.positions.size() != vertices)
      return fail("the target '" + t.name + "' has " + std::to_string(t.positions.size()) +
                  " vertices, and the neutral " + std::to_string(vertices));
    shapes.emplace_back(rig.weightsOf(k + 1), &t.positions);
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

/// Sums up the samples of the neutral and of the targets after it.
Measurement sumUp(std::vector<PoseSamples>& samples) {
  Measurement result;
  std::vector<double> distances, angles;
  double shadingSquares = 0, shadingCount = 0;
  PoseErrors& worst = result.worst;
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (PoseSamples& s : samples) {
    summarize(s, samples[0].offsets);
    append(distances, s.distances);
    append(angles, s.angles);
    if (&s != samples.data()) append(result.displacements, s.displacements);
    shadingSquares += s.shadingSquares;
    shadingCount += s.shadingCount;
    worst.facetDistance = std::max(worst.facetDistance, s.errors.facetDistance);
    worst.facetExcess = std::max(worst.facetExcess, s.errors.facetExcess);
    worst.folds += s.errors.folds;
    result.shapes.push_back(s.errors);
  }
  std::ranges::sort(result.displacements);
  worst.distance = summaryOf(std::move(distances));
  worst.displacement = summaryOfSorted(result.displacements);
  worst.angle = summaryOf(std::move(angles));
  worst.shadingRms = rootOfMean(shadingSquares, shadingCount);
  worst.name = "all";
  return result;
}

}  // namespace

ErrorSummary summaryOf(std::vector<double> errors) {
  std::ranges::sort(errors);
  return summaryOfSorted(errors);
}

Result<Measurement> measure(const Rig& rig, const MeshRig& source, const MeasureOptions& options) {
  if (!rig.source.ownOrder)
    return fail(
        "the face has no source order, it was left out, so that nobody knows which vertex is "
        "which; make the file again with its order");
  if (options.facets && !knowsQuads(rig))
    return fail(
        "the face does not tell which of its source's polygons lies where, so that its surface "
        "cannot be compared with them; convert the source again");
  const auto shapes = matchShapes(rig, source);
  if (!shapes) return std::unexpected(shapes.error());
  const Meter meter(rig, source.neutral.positions, options.facets);
  std::vector<PoseSamples> samples(shapes->size());
  const auto isCancelled = [&] { return options.cancel && *options.cancel; };
  parallelFor(std::size_t{0}, samples.size(), [&](std::size_t k) {
    if (isCancelled()) return;
    samples[k] = meter.measure(k == 0 ? "neutral" : source.targets[k - 1].name, (*shapes)[k].first,
                               *(*shapes)[k].second);
  });
  if (isCancelled()) return fail("measuring was interrupted");

  Measurement result = sumUp(samples);
  if (source.targets.empty()) return result;
  std::mt19937 random(options.seed);
  std::vector<Weights> mixtures;
  for (int k = 0; k < options.mixtures; ++k) mixtures.push_back(randomWeights(rig, source, random));
  result.mixtures.resize(mixtures.size());
  parallelFor(std::size_t{0}, mixtures.size(), [&](std::size_t k) {
    if (isCancelled()) return;
    PoseSamples s = meter.measure("mixture " + std::to_string(k + 1), mixtures[k],
                                  blendSource(rig, source, mixtures[k]));
    summarize(s, samples[0].offsets);
    result.mixtures[k] = std::move(s.errors);
  });
  if (isCancelled()) return fail("measuring was interrupted");
  return result;
}

}  // namespace sweepface
