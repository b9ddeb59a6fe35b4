#include "budget_grid.hpp"

#include <fmt/format.h>

#include "sweepface/evaluator.hpp"

#include "output.hpp"

namespace sweepface::cli {
namespace {

Budget budgetOf(const BudgetArguments& a) {
  if (a.vertices > 0) return {Budget::Kind::vertices, a.vertices};
  if (a.error > 0) return {Budget::Kind::error, a.error};
  return {Budget::Kind::edgeLength, a.edgeLength};
}

/// How many curves are cut as finely as possible and may still be too coarse.
Index cutMost(const Wireframe& wireframe, const Density& density) {
  Index count = 0;
  for (std::size_t a = 0; a < wireframe.arcs.size(); ++a)
    count +=
        !wireframe.arcs[a].collapsed && density.arcs[a] >= kMostLevel * wireframe.arcs[a].edges;
  return count;
}

}  // namespace

void addBudget(CLI::App& app, BudgetArguments& a, std::initializer_list<CLI::Option*> others) {
  const auto add = [&](const std::string& name, double& value, const std::string& type,
                       const std::string& what) {
    CLI::Option* const option = app.add_option(name, value, what)->type_name(type);
    for (CLI::Option* const other : others) option->excludes(other);
    return option;
  };
  CLI::Option* const vertices =
      add("--vertices", a.vertices, "N", "Write the best mesh with at most N vertices")
          ->transform(wholeNumber(1, 1 << 24));
  CLI::Option* const error =
      add("--error", a.error, "E",
          "Write a mesh whose edges are no further from the surface than this")
          ->check(positiveNumber());
  add("--edge-length", a.edgeLength, "L", "Write a mesh without longer edges along curves")
      ->check(positiveNumber())
      ->excludes(vertices)
      ->excludes(error);
  error->excludes(vertices);
}

Result<Tessellation> gridWithin(const BudgetArguments& a, const Rig& rig,
                                const std::string& output) {
  const Budget budget = budgetOf(a);
  auto density = densityFor(rig.surface, blend(rig, {}), budget);
  if (!density) return std::unexpected(density.error());
  const bool isBound = budget.kind != Budget::Kind::vertices;
  if (const Index most = isBound ? cutMost(rig.surface.wireframe(), *density) : 0; most > 0)
    printWarning(
        fmt::format("{}: {} curves are cut as finely as can be, into {} for every edge of the "
                    "source, and may still be coarser than {} asks.",
                    output, most, kMostLevel, a.error > 0 ? "--error" : "--edge-length"));
  return Tessellation(rig.surface, std::move(*density));
}

}  // namespace sweepface::cli
