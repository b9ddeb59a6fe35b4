#include "surface/basis_table.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <tuple>

#include "surface/sorting.hpp"

namespace sweepface {

namespace {

// The first ribbon of the same shape, for each.
std::vector<Index> findShapes(const std::vector<Shape>& ribbons) {
  const auto key = [&](Index r) {
    return std::make_tuple(ribbons[r].rho, ribbons[r].eta, ribbons[r].lambda, r);
  };
  std::vector<Index> order(ribbons.size()), first(ribbons.size());
  std::iota(order.begin(), order.end(), 0);
  sortSmall(std::span(order), [&](Index a, Index b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && ribbons[order[k]] == ribbons[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

}  // namespace

Result<BasisTable> BasisTable::make(const std::vector<Shape>& ribbons,
                                    std::vector<std::array<Index, 2>> ribbonsAndEdges) {
  BasisTable table;
  table.shapes_ = findShapes(ribbons);
  for (auto& [ribbon, edges] : ribbonsAndEdges) ribbon = table.shapes_[ribbon];
  sortSmall(std::span(ribbonsAndEdges));
  const auto repeated = std::ranges::unique(ribbonsAndEdges);
  table.keys_.assign(ribbonsAndEdges.begin(), repeated.begin());
  for (auto [ribbon, edges] : table.keys_) {
    auto basis = SweepBasis::make(ribbons[ribbon], edges);
    if (!basis) return fail("ribbon ", ribbon, ": ", basis.error().message);
    table.bases_.push_back(*basis);
  }
  return table;
}

Index BasisTable::find(Index ribbon, Index edges) const {
  return static_cast<Index>(std::ranges::lower_bound(keys_, keyOf(ribbon, edges)) - keys_.begin());
}

}  // namespace sweepface
