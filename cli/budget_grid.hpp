#pragma once

#include "sweepface/eval.hpp"

#include "command.hpp"

namespace sweepface::cli {

/// A budget for the size of a mesh, instead of a level of detail.
struct BudgetArguments {
  double edgeLength = 0, error = 0, vertices = 0;  // 0: not given
  bool isGiven() const { return edgeLength > 0 || error > 0 || vertices > 0; }
};
/// Adds its options, which exclude these others.
void addBudget(CLI::App& app, BudgetArguments& a, std::initializer_list<CLI::Option*> others);

/// The tessellation that a budget asks for. A warning says if it may be coarser than that.
Result<Tessellation> gridWithin(const BudgetArguments& a, const Rig& rig,
                                const std::string& output);

}  // namespace sweepface::cli
