#include "surface/basis_table.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_set>

namespace sweepface {

namespace {

// The first ribbon of the same shape, for each.
std::vector<Index> findShapes(const std::vector<Shape>& ribbons) {
  const auto key = [&](Index r) {
    return std::make_tuple(ribbons[r].rho, ribbons[r].eta, ribbons[r].lambda, r);
  };
  std::vector<Index> order(ribbons.size()), first(ribbons.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
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
  std::unordered_set<std::uint64_t> seen;
  for (auto [ribbon, edges] : ribbonsAndEdges) {
    const Key key = table.keyOf(ribbon, edges);
    if (seen.insert(std::uint64_t(key[0]) << 32 | std::uint32_t(edges)).second)
      table.keys_.push_back(key);
  }
  std::sort(table.keys_.begin(), table.keys_.end());
  for (auto [ribbon, edges] : table.keys_) {
    auto basis = SweepBasis::make(ribbons[ribbon], edges);
    if (!basis) return fail("ribbon " + std::to_string(ribbon) + ": " + basis.error().message);
    table.bases_.push_back(*basis);
  }
  return table;
}

Index BasisTable::find(Index ribbon, Index edges) const {
  return static_cast<Index>(std::ranges::lower_bound(keys_, keyOf(ribbon, edges)) - keys_.begin());
}

}  // namespace sweepface
