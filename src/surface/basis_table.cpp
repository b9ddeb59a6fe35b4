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

// Most lengths are short: those that were there are marked by shape, so that few are sorted.
Result<BasisTable> BasisTable::make(const std::vector<Shape>& ribbons,
                                    const std::vector<std::array<Index, 2>>& ribbonsAndEdges) {
  BasisTable table;
  table.shapes_ = findShapes(ribbons);
  std::vector<std::uint64_t> marked(ribbons.size(), 0);
  for (const auto& [ribbon, edges] : ribbonsAndEdges) {
    std::uint64_t& marks = marked[table.shapes_[ribbon]];
    const std::uint64_t mark = edges < 64 ? std::uint64_t{1} << edges : 0;
    if (!(marks & mark)) table.keys_.push_back(table.keyOf(ribbon, edges));
    marks |= mark;
  }
  sortSmall(std::span(table.keys_));
  table.keys_.erase(std::ranges::unique(table.keys_).begin(), table.keys_.end());
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
