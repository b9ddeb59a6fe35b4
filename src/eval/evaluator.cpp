// Compiles a rig into the tables of src/eval/tiles.hpp, tile by tile.
#include "sweepface/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "eval/clusters.hpp"
#include "eval/row_differences.hpp"
#include "eval/tile_packer.hpp"

namespace sweepface {
namespace {

float toFloat(double x) {
  constexpr double most = std::numeric_limits<float>::max() / 4;  // room for what targets add
  return static_cast<float>(std::clamp(x, -most, most));
}
std::array<float, 3> toFloats(const Vec3& p) { return {toFloat(p.x), toFloat(p.y), toFloat(p.z)}; }

double diagonal(std::span<const Vec3> points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return norm(high - low);
}

class Compiler {
 public:
  Compiler(const Rig& rig, const Tessellation& grid, const EvaluatorOptions& options)
      : rig_(rig),
        options_(options),
        grid_(grid),
        neutral_(blend(rig, {})),
        gridPositions_(grid_.positions(neutral_)),
        differences_(rig, options.influences) {}

  EvaluatorTables compile() {
    placeVertices();
    tables_.vertices = static_cast<Index>(positions_.size());
    tables_.weights = differences_.columns();
    tables_.positionErrors.ofTarget.assign(tables_.weights, 0.0);
    tables_.derivativeErrors.ofTarget.assign(tables_.weights, 0.0);
    const double tolerance = usedTolerance();
    for (const auto& vertices : cluster(positions_, kTileVertices)) {
      addPositions(vertices, tolerance);
      if (options_.normals) addDerivatives(vertices);
    }
    roundPositions();
    tables_.positions.finish();
    tables_.derivatives.finish();
    return std::move(tables_);
  }

 private:
  /// A vertex of the grid, or -1 - k: loose vertex k.
  Index gridVertex(Index v) const { return options_.level == 0 ? rig_.source.gridVertex[v] : v; }

  void placeVertices() {
    const std::size_t count =
        options_.level == 0 ? rig_.source.gridVertex.size() : gridPositions_.size();
    for (Index v = 0; v < static_cast<Index>(count); ++v) {
      const Index g = gridVertex(v);
      positions_.push_back(g >= 0 ? gridPositions_[g] : rig_.source.loose[-1 - g]);
    }
  }

  double usedTolerance() const {
    if (options_.tolerance > 0) return options_.tolerance;
    return std::max({0.1 * rig_.tolerance, 1e-5 * diagonal(gridPositions_), 1e-30});
  }

  /// Single precision: what a coordinate of the neutral may be off.
  void roundPositions() {
    double largest = 0;
    for (const Vec3& p : positions_) largest = std::max(largest, norm(p));
    tables_.positionErrors.rounding += std::ldexp(largest, -21);
    tables_.derivativeErrors.rounding += std::ldexp(1.0, -21);
  }

  void addPositions(std::span<const Index> vertices, double tolerance) {
    TileSource tile{{vertices.begin(), vertices.end()}, {}, {}, {}, tolerance};
    tile.neutral.resize(kTileVertices);
    std::vector<Row> rows(kTileVertices);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      tile.neutral[k] = toFloats(positions_[vertices[k]]);
      rows[k] = positionRow(gridVertex(vertices[k]));
    }
    pack(tile, rows, tables_.positions, tables_.positionErrors);
  }

  Row positionRow(Index g) const {
    Row row;
    if (g < 0) {
      row.loose = -1 - g;
      return row;
    }
    const auto [vectors, factors] = grid_.terms(g);
    for (std::size_t t = 0; t < vectors.size(); ++t)
      if (factors[t] != 0) row.terms.push_back({vectors[t], factors[t]});
    return row;
  }

  void addDerivatives(std::span<const Index> vertices) {
    TileSource tile{{vertices.begin(), vertices.end()}, {}, {}, {}, options_.derivativeTolerance};
    tile.neutral.resize(kMostRows);
    std::vector<Row> rows(kMostRows);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      for (const int d : {0, 1}) {
        const std::size_t row = k + static_cast<std::size_t>(d) * kTileVertices;
        std::tie(tile.neutral[row], rows[row]) = derivative(gridVertex(vertices[k]), d);
      }
    pack(tile, rows, tables_.derivatives, tables_.derivativeErrors);
  }

  /// ∂u (d = 0) or ∂v of a vertex in units of its neutral length. Loose vertices look along z.
  std::pair<std::array<float, 3>, Row> derivative(Index g, int d) const {
    if (g < 0) return {toFloats({d == 0 ? 1.0 : 0, d == 1 ? 1.0 : 0, 0}), {}};
    const Site site = regularSite(grid_.site(g));
    const Vec3 whole = rig_.surface.evaluate(neutral_, site, 1 - d, d);
    const double length = norm(whole), scale = length > 0 ? 1 / length : 1;
    Row row;
    const Surface::Weights w = rig_.surface.weights(site, 1 - d, d);
    for (std::size_t t = 0; t < w.vectors.size(); ++t)
      if (w.factors[t] != 0) row.terms.push_back({w.vectors[t], scale * w.factors[t]});
    return {toFloats(scale * whole), std::move(row)};
  }

  /// Where the neutral has no normal, at a collapsed side, a little inside the patch.
  Site regularSite(const Site& site) const {
    const Surface& s = rig_.surface;
    const Vec3 u = s.evaluate(neutral_, site, 1, 0), v = s.evaluate(neutral_, site, 0, 1);
    if (norm(cross(u, v)) > 1e-9 * norm(u) * norm(v) && norm(u) > 0 && norm(v) > 0) return site;
    const double m = s.edgesU(site.patch), n = s.edgesV(site.patch);
    return {site.patch, site.u + (m * 0.5 - site.u) * 1e-3, site.v + (n * 0.5 - site.v) * 1e-3};
  }

  void pack(TileSource& tile, std::span<const Row> rows, TileTable& table, TableErrors& errors) {
    tile.differences = differences_.of(rows, tile.unit, tile.targets);
    const auto found = packTile(tile, static_cast<std::uint16_t>(tables_.weights), table);
    errors.rounding = std::max(errors.rounding, found.rounding * tile.unit);
    for (std::size_t k = 0; k < tile.targets.size(); ++k) {
      double& worst = errors.ofTarget[tile.targets[k]];
      worst = std::max(worst, found.ofTarget[k] * tile.unit);
    }
  }

  const Rig& rig_;
  const EvaluatorOptions& options_;
  const Tessellation& grid_;
  std::vector<Vec3> neutral_;        // settled
  std::vector<Vec3> gridPositions_;  // of the neutral
  std::vector<Vec3> positions_;      // [vertices] of the neutral
  RowDifferences differences_;
  EvaluatorTables tables_;
};

double bound(const TableErrors& errors, std::span<const double> weights) {
  double sum = 0, most = 1;
  for (std::size_t k = 0; k < std::min(weights.size(), errors.ofTarget.size()); ++k) {
    sum += std::abs(weights[k]) * errors.ofTarget[k];
    most = std::max(most, std::abs(weights[k]));
  }
  return sum + most * errors.rounding;
}

bool isShare(double x) { return x >= 0 && std::isfinite(x); }

Result<void> check(const Rig& rig, const EvaluatorOptions& options) {
  if (options.level < 0) return fail("The level of an evaluator must be 0 or more.");
  if (options.level == 0 && rig.source.gridVertex.empty())
    return fail("The face came without its source's vertices; ask for level 1.");
  if (!isShare(options.tolerance) ||
      !(isShare(options.derivativeTolerance) && options.derivativeTolerance > 0))
    return fail("The tolerances of an evaluator must be positive.");
  const auto stored = static_cast<std::size_t>(rig.surface.storedCount());
  for (const auto& region : options.influences) {
    if (region.size() != stored)
      return fail("A region has " + std::to_string(region.size()) + " influences for " +
                  std::to_string(stored) + " stored vectors.");
    if (!std::ranges::all_of(region, [](float x) { return std::isfinite(x); }))
      return fail("The influences of a region must be finite.");
  }
  constexpr std::size_t most = 65534;
  if (rig.targets.size() * std::max<std::size_t>(1, options.influences.size()) > most)
    return fail("An evaluator takes at most " + std::to_string(most) + " weights.");
  return {};
}

}  // namespace

Result<Evaluator> Evaluator::make(const Rig& rig, const EvaluatorOptions& options) {
  if (auto ok = check(rig, options); !ok) return std::unexpected(ok.error());
  return make(rig, Tessellation(rig.surface, std::max<Index>(1, options.level)), options);
}

Result<Evaluator> Evaluator::make(const Rig& rig, const Tessellation& grid,
                                  const EvaluatorOptions& options) {
  if (auto ok = check(rig, options); !ok) return std::unexpected(ok.error());
  if (grid.level() != std::max<Index>(1, options.level))
    return fail("The tessellation of an evaluator must be of its level.");
  Evaluator made;
  made.tables_ = std::make_shared<const EvaluatorTables>(Compiler(rig, grid, options).compile());
  return made;
}

Index Evaluator::vertexCount() const { return tables_->vertices; }
Index Evaluator::weightCount() const { return tables_->weights; }
bool Evaluator::hasNormals() const { return tables_->derivatives.tileCount() > 0; }
std::size_t Evaluator::positionBytes() const { return tables_->positions.bytes(); }
std::size_t Evaluator::normalBytes() const { return tables_->derivatives.bytes(); }
double Evaluator::positionBound(std::span<const double> weights) const {
  return bound(tables_->positionErrors, weights);
}
double Evaluator::derivativeBound(std::span<const double> weights) const {
  return bound(tables_->derivativeErrors, weights);
}

}  // namespace sweepface
