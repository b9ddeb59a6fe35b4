#include "surface/basis_table.hpp"

#include <algorithm>
#include <string>

namespace sweepface {

Result<BasisTable> BasisTable::make(const std::vector<Shape>& ribbons,
                                    std::vector<std::array<Index, 2>> keys) {
  BasisTable table;
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (auto [ribbon, edges] : keys) {
    auto basis = SweepBasis::make(ribbons[ribbon], edges);
    if (!basis) return fail("ribbon " + std::to_string(ribbon) + ": " + basis.error().message);
    table.bases_.push_back(*basis);
  }
  table.keys_ = std::move(keys);
  return table;
}

Index BasisTable::find(Index ribbon, Index edges) const {
  const std::array<Index, 2> key{ribbon, edges};
  return static_cast<Index>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
}

}  // namespace sweepface
