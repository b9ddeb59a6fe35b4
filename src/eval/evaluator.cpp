#include "sweepface/evaluator.hpp"

#include <algorithm>
#include <cmath>

#include "eval/table_compiler.hpp"

namespace sweepface {
namespace {

/// Vertices are the points of a tessellation, or of the source.
struct EveryPoint {
  Index count(Index points) const { return points; }
  Index point(Index vertex) const { return vertex; }
  void turn(Index, Derivatives&) const {}
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

Result<void> checkOptions(const Rig& rig, const EvaluatorOptions& options) {
  if (!isShare(options.tolerance) ||
      !(isShare(options.derivativeTolerance) && options.derivativeTolerance > 0))
    return fail("The tolerances of an evaluator must be positive.");
  if (options.targets && !rig.knowsTargets())
    return fail("What the targets do must be decoded before an evaluator moves them.");
  const auto stored = static_cast<std::size_t>(rig.surface.storedCount());
  for (const auto& region : options.influences) {
    if (region.size() != stored)
      return fail("A region has ", region.size(), " influences for ", stored, " stored vectors.");
    if (!std::ranges::all_of(region, [](float x) { return std::isfinite(x); }))
      return fail("The influences of a region must be finite.");
  }
  constexpr std::size_t most = 65534;
  if (rig.targets.size() * std::max<std::size_t>(1, options.influences.size()) > most)
    return fail("An evaluator takes at most ", most, " weights.");
  return {};
}

}  // namespace

Result<Evaluator> Evaluator::make(const Rig& rig, const EvaluatorOptions& options) {
  if (options.level < 0 || options.level > kMostLevel)
    return fail("The level of an evaluator must be 0 to ", kMostLevel, ".");
  return make(rig, Tessellation(rig.surface, std::max<Index>(1, options.level)), options);
}

Result<void> Evaluator::check(const Rig& rig, const Tessellation& grid,
                              const EvaluatorOptions& options) {
  if (auto ok = checkOptions(rig, options); !ok) return ok;
  const bool hasLevel = grid.level() > 0, inSourceOrder = hasLevel && options.level == 0;
  if (inSourceOrder && rig.source.gridVertex.empty())
    return fail("The face came without its source's vertices; ask for level 1.");
  const auto isKnown = [count = grid.vertexCount()](Index vertex) { return vertex < count; };
  if (!grid.fits(rig.surface) || (hasLevel && grid.level() != std::max<Index>(1, options.level)) ||
      (inSourceOrder && !std::ranges::all_of(rig.source.gridVertex, isKnown)))
    return fail("The tessellation of an evaluator must be of its rig's surface and of its level.");
  return {};
}

Result<Evaluator> Evaluator::make(const Rig& rig, const Tessellation& grid,
                                  const EvaluatorOptions& options) {
  if (auto ok = check(rig, grid, options); !ok) return std::unexpected(ok.error());
  Evaluator made;
  made.tables_ = std::make_shared<const EvaluatorTables>(
      TableCompiler(rig, grid, options, EveryPoint{}).compile());
  return made;
}

Index Evaluator::vertexCount() const { return tables_->vertices; }
Index Evaluator::weightCount() const { return tables_->weights; }
bool Evaluator::hasPositions() const { return tables_->positions.tileCount() > 0; }
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
