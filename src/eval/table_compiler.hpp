#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "sweepface/box.hpp"
#include "sweepface/evaluator.hpp"

#include "eval/clusters.hpp"
#include "eval/row_differences.hpp"
#include "eval/tile_packer.hpp"
#include "eval/tiles.hpp"

namespace sweepface {

/// A first derivative at a vertex: its value in the neutral, and the weights that give it in any
/// pose.
struct Derivative {
  Vec3 neutral;
  Surface::Weights weights;
};
using Derivatives = std::array<Derivative, 2>;  // ∂u, ∂v

/// Compiles a rig into the tables of src/eval/tiles.hpp, tile by tile. `Vertices` maps a vertex to
/// its point, and may replace its derivatives by others that span the same plane.
template <class Vertices>
class TableCompiler {
 public:
  TableCompiler(const Rig& rig, const Tessellation& grid, const EvaluatorOptions& options,
                const Vertices& vertices)
      : rig_(rig),
        options_(options),
        grid_(grid),
        neutral_(blend(rig, {})),
        gridPositions_(grid_.positions(neutral_)),
        vertices_(vertices) {
    if (options.targets) differences_.emplace(rig, options.influences);
  }

  EvaluatorTables compile() {
    placeVertices();
    tables_.vertices = static_cast<Index>(positions_.size());
    tables_.weights = static_cast<Index>(rig_.targets.size() *
                                         std::max<std::size_t>(1, options_.influences.size()));
    tables_.positionErrors.ofTarget.assign(tables_.weights, 0.0);
    tables_.derivativeErrors.ofTarget.assign(tables_.weights, 0.0);
    size_ = sizeOfNeutral();
    tolerance_ = usedTolerance();
    for (const auto& vertices : cluster(positions_, kTileVertices)) addTile(vertices);
    roundPositions();
    tables_.positions.finish();
    tables_.derivatives.finish();
    return std::move(tables_);
  }

 private:
  static float toFloat(double x) {
    constexpr double most = std::numeric_limits<float>::max() / 4;  // room for what targets add
    return static_cast<float>(std::clamp(x, -most, most));
  }
  static std::array<float, 3> toFloats(const Vec3& p) {
    return {toFloat(p.x), toFloat(p.y), toFloat(p.z)};
  }

  /// A vertex of the grid, or -1 - k: loose vertex k.
  Index gridVertex(Index vertex) const {
    const Index point = vertices_.point(vertex);
    return inSourceOrder() ? rig_.source.gridVertex[point] : point;
  }
  bool inSourceOrder() const { return options_.level == 0 && grid_.level() > 0; }

  void placeVertices() {
    const std::size_t count =
        inSourceOrder() ? rig_.source.gridVertex.size() : gridPositions_.size();
    for (Index v = 0; v < vertices_.count(static_cast<Index>(count)); ++v) {
      const Index g = gridVertex(v);
      positions_.push_back(g >= 0 ? gridPositions_[g] : rig_.source.loose[-1 - g]);
    }
  }

  double sizeOfNeutral() const {
#ifndef __wasm__  // which has no tessellations of single sites
    if (grid_.isOfSites()) return diagonal(Tessellation(rig_.surface, 1).positions(neutral_));
#endif
    return diagonal(gridPositions_);
  }

  double usedTolerance() const {
    const double wanted = options_.tolerance;
    if (!(wanted > 0)) return std::max({0.3 * rig_.tolerance, 1e-5 * size_, 1e-30});
    // Squares of differences, in units of the tolerance, must fit single precision.
    return std::clamp(wanted, std::max(1e-8 * size_, 1e-30), std::max(1e12 * size_, 1.0));
  }
  double usedDerivativeTolerance() const {
    return std::clamp(options_.derivativeTolerance, 1e-8, 1e12);
  }

  /// Adds the error of the neutral's coordinates in single precision.
  void roundPositions() {
    double largest = 0;
    for (const Vec3& p : positions_) largest = std::max(largest, norm(p));
    tables_.positionErrors.rounding += std::ldexp(largest, -21);
    tables_.derivativeErrors.rounding += std::ldexp(1.0, -21);
  }

  void addTile(std::span<const Index> vertices) {
    TileSource tile;
    tile.vertices.assign(vertices.begin(), vertices.end());
    if (options_.positions) addPositions(vertices, tile);
    if (options_.normals) addDerivatives(vertices, tile);
  }

  void start(TileSource& tile, std::size_t rows) {
    tile.neutral.assign(rows, {});
    rows_.assign(rows, {});
  }

  void addPositions(std::span<const Index> vertices, TileSource& tile) {
    start(tile, kTileVertices);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Index g = gridVertex(vertices[k]);
      tile.neutral[k] = toFloats(positions_[vertices[k]]);
      if (g < 0) {
        rows_[k].loose = -1 - g;
        continue;
      }
      const auto [vectors, factors] = grid_.terms(g);
      rows_[k] = {vectors, factors};
    }
    pack(tile, tolerance_, tables_.positions, tables_.positionErrors);
  }

  void pack(TileSource& tile, double unit, TileTable& table, TableErrors& errors) {
    tile.unit = unit;
    // Rows without a vertex repeat the first one.
    for (auto first = tile.neutral.begin(); first != tile.neutral.end(); first += kTileVertices)
      std::fill(first + std::ssize(tile.vertices), first + kTileVertices, *first);
    tile.targets.clear();
    if (options_.targets)
      differences_->of(rows_, 1 / unit, tile.targets, tile.differences);
    else
      tile.differences.reshape(static_cast<int>(rows_.size()), 0);
    if (&table == &tables_.derivatives) tellInLargerUnits(tile);
    const auto found = packTile(tile, static_cast<std::uint16_t>(tables_.weights), table);
    errors.rounding = std::max(errors.rounding, found.rounding * tile.unit);
    for (std::size_t k = 0; k < tile.targets.size(); ++k) {
      double& worst = errors.ofTarget[tile.targets[k]];
      worst = std::max(worst, found.ofTarget[k] * tile.unit);
    }
  }

  Derivatives derivatives(const Site& site) const {
    Derivatives both;
    for (int d = 0; d < 2; ++d) {
      both[d].weights = rig_.surface.weights(site, 1 - d, d);
      const auto& [vectors, factors] = both[d].weights;
      for (std::size_t t = 0; t < vectors.size(); ++t)
        both[d].neutral += factors[t] * neutral_[vectors[t]];
    }
    return both;
  }

  /// Where the neutral has no normal, at a collapsed side, takes the derivatives a little inside.
  Derivatives regularDerivatives(const Site& site) const {
    const Derivatives here = derivatives(site);
    const Vec3 &u = here[0].neutral, &v = here[1].neutral;
    if (norm(cross(u, v)) > 1e-9 * norm(u) * norm(v) && norm(u) > 0 && norm(v) > 0) return here;
    return derivatives(rig_.surface.inside(site));
  }

  /// Stores derivatives that a target makes more than a hundred times as long, as happens where it
  /// opens what the neutral holds shut, in larger units; only their directions count. The units are
  /// powers of two, so that what nothing moves stays the same to the last bit.
  static void tellInLargerUnits(TileSource& tile) {
    constexpr double kMost = 100;
    const auto width = static_cast<std::size_t>(tile.differences.width());
    for (int r = 0; r < tile.differences.rows; ++r) {
      const std::span row(tile.differences.row(r), width);
      const double most = extentOf(row).most * tile.unit;
      if (most <= kMost) continue;
      float factor = 1;
      while (most * factor > kMost) factor /= 2;
      const Scaled scaled{factor, row.data()};
      sumRows({&scaled, 1}, tile.differences.width(), row.data());
      for (float& x : tile.neutral[r]) x *= factor;
    }
  }

  /// ∂u and ∂v of vertices in units of their neutral lengths, unless these are nothing but rounding
  /// errors. The normals of loose vertices point along z.
  void addDerivatives(std::span<const Index> vertices, TileSource& tile) {
    start(tile, kMostRows);
    derivatives_.resize(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Index g = gridVertex(vertices[k]);
      if (g < 0) {
        tile.neutral[k] = {1, 0, 0}, tile.neutral[kTileVertices + k] = {0, 1, 0};
        continue;
      }
      derivatives_[k] = regularDerivatives(grid_.site(g));
      vertices_.turn(vertices[k], derivatives_[k]);
      for (int d = 0; d < 2; ++d) {
        const auto& [whole, weights] = derivatives_[k][d];
        const double length = std::max(norm(whole), 1e-9 * size_),
                     scale = length > 0 ? 1 / length : 1;
        tile.neutral[d * kTileVertices + k] = toFloats(scale * whole);
        rows_[d * kTileVertices + k] = {weights.vectors, weights.factors, scale};
      }
    }
    pack(tile, usedDerivativeTolerance(), tables_.derivatives, tables_.derivativeErrors);
  }

  const Rig& rig_;
  const EvaluatorOptions& options_;
  const Tessellation& grid_;
  std::vector<Vec3> neutral_;        // settled
  std::vector<Vec3> gridPositions_;  // of the neutral
  std::vector<Vec3> positions_;      // [vertices] of the neutral
  std::optional<RowDifferences> differences_;
  std::vector<Row> rows_;                 // of a tile
  std::vector<Derivatives> derivatives_;  // of a tile's vertices
  double size_ = 0, tolerance_ = 0;
  EvaluatorTables tables_;
  const Vertices vertices_;
};

}  // namespace sweepface
