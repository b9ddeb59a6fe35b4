#include "surface/jets.hpp"

#include "surface/chart_jets.hpp"
#include "surface/jet_numbers.hpp"
#include "surface/jet_order.hpp"
#include "surface/jet_rows.hpp"
#include "surface/line_jets.hpp"

namespace sweepface {

Result<JetTable> buildJets(const Wireframe& wireframe, const Connectivity& connectivity,
                           const BasisTable& bases, std::vector<Index>* circle) {
  const JetNumbers numbers(wireframe, connectivity);
  JetRows rows(numbers.count());
  predictCrossings(wireframe, connectivity, numbers, rows);
  hangNodes(wireframe, connectivity, bases, numbers, rows);
  if (auto ok = chartHubs(wireframe, connectivity, numbers, rows); !ok)
    return std::unexpected(ok.error());
  chartFans(connectivity, numbers, rows);

  std::vector<Index> place;  // [vectors] in the table, by number
  Result<JetTable> table = orderJets(numbers, rows, connectivity, place, circle);
  if (!table) return table;
  table->corners.reserve(36 * wireframe.patches.size());
  for (Index corner = 0; corner < static_cast<Index>(4 * wireframe.patches.size()); ++corner)
    for (const JetRef jet : numbers.atCorner(corner))
      table->corners.push_back({place[jet.vector], jet.sign});
  return table;
}

}  // namespace sweepface
