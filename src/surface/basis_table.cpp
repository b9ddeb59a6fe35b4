#include "surface/basis_table.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <tuple>

#include "surface/sorting.hpp"

namespace sweepface {

namespace {

// The first ribbon of the same shape, for each. Those beside each other are mostly alike.
std::vector<Index> findShapes(const std::vector<Shape>& ribbons) {
  const auto key = [&](Index r) {
    return std::make_tuple(ribbons[r].rho, ribbons[r].eta, ribbons[r].lambda, r);
  };
  std::vector<Index> order, first(ribbons.size());
  for (Index r = 0; r < static_cast<Index>(ribbons.size()); ++r)
    if (r == 0 || ribbons[r] != ribbons[r - 1]) order.push_back(r);
  sortSmall(std::span(order), [&](Index a, Index b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && ribbons[order[k]] == ribbons[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  for (std::size_t r = 1; r < ribbons.size(); ++r)
    if (ribbons[r] == ribbons[r - 1]) first[r] = first[r - 1];
  return first;
}

// Each key once, sorted. Most lengths are short: those that were there are marked by shape.
std::vector<std::array<Index, 2>> eachOnce(const std::vector<std::array<Index, 2>>& keys,
                                           std::size_t shapes) {
  std::vector<std::uint64_t> marked(shapes, 0);
  std::vector<std::array<Index, 2>> once;
  for (const auto& key : keys) {
    const std::uint64_t mark = key[1] < 64 ? std::uint64_t{1} << key[1] : 0;
    if (!(marked[key[0]] & mark)) once.push_back(key);
    marked[key[0]] |= mark;
  }
  sortSmall(std::span(once));
  once.erase(std::ranges::unique(once).begin(), once.end());
  return once;
}

}  // namespace

Result<BasisTable> BasisTable::make(const std::vector<Shape>& ribbons,
                                    std::vector<std::array<Index, 2>> ribbonsAndEdges) {
  BasisTable table;
  table.shapes_ = findShapes(ribbons);
  for (auto& [ribbon, edges] : ribbonsAndEdges) ribbon = table.shapes_[ribbon];
  table.keys_ = eachOnce(ribbonsAndEdges, ribbons.size());
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
