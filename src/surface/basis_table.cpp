#include "surface/basis_table.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

#include "ode/power.hpp"
#include "surface/sorting.hpp"

namespace sweepface {

namespace {

// For each ribbon the first one of the same shape.
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

// Most lengths are short. Those under 64 are marked per shape once seen, so that few keys remain to
// be sorted.
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
  constexpr std::size_t kMostBases = 1 << 14;  // near a resonance each takes 0.1 ms
  if (table.keys_.size() > kMostBases)
    return fail("the ribbons have more than ", kMostBases, " pairs of a shape and a length");
  for (const auto& key : table.keys_) {
    auto basis = SweepBasis::make(ribbons[key[0]], key[1]);
    if (!basis) {  // name a ribbon of that shape that has this length
      std::size_t k = 0;
      while (table.keyOf(ribbonsAndEdges[k][0], ribbonsAndEdges[k][1]) != key) ++k;
      return fail("ribbon ", ribbonsAndEdges[k][0], ": ", basis.error().message);
    }
    table.bases_.push_back(*basis);
  }
  table.tabulate();
  return table;
}

// Tabulates what is asked for most: whole t, the source's own vertices. There are usually few
// bases; the limits guard against many.
void BasisTable::tabulate() {
  constexpr Index kMostEdges = 16;
  constexpr std::size_t kMostValues = 1 << 13;
  for (std::size_t b = 0; b < bases_.size(); ++b) {
    const Index edges = keys_[b][1];
    const bool isShort = edges <= kMostEdges && values_.size() < kMostValues;
    firstValue_.push_back(isShort ? static_cast<Index>(values_.size()) : -1);
    for (int order = 0; isShort && order < 2; ++order)
      for (Index t = 0; t <= edges; ++t) values_.push_back(inEdges(bases_[b], t, edges, order));
  }
}

std::array<double, 6> BasisTable::values(Index basis, double t, int order) const {
  const Index edges = keys_[basis][1], first = firstValue_[basis];
  if (first >= 0 && order < 2 && t >= 0 && t <= edges)
    if (const auto whole = static_cast<Index>(t); whole == t)
      return values_[first + order * (edges + 1) + whole];
  return inEdges(bases_[basis], t, edges, order);
}

std::array<double, 6> BasisTable::inEdges(const SweepBasis& basis, double t, Index edges,
                                          int order) {
  auto values = basis.at(t / edges, order);
  const double h = edges, unit = ode::power(h, -order);
  for (int k = 0; k < 6; ++k) values[k] *= unit * (k % 3 == 0 ? 1 : k % 3 == 1 ? h : h * h);
  return values;
}

Index BasisTable::find(Index ribbon, Index edges) const {
  return static_cast<Index>(std::ranges::lower_bound(keys_, keyOf(ribbon, edges)) - keys_.begin());
}

}  // namespace sweepface
