#include "fit/columns.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"
#include "surface/terms.hpp"

namespace sweepface {

using codec::Prediction;

namespace {

// Expands every vertex of level 1 in coefficients and sorts the terms by coefficient.
class ColumnBuilder {
 public:
  ColumnBuilder(const Surface& surface, const Tessellation& grid, const Prediction& prediction,
                const std::vector<std::vector<Term>>& inStored)
      : surface_(surface), grid_(grid), prediction_(prediction), inStored_(inStored) {
    stepOf_.resize(surface.storedCount());
    for (std::size_t k = 0; k < prediction.steps.size(); ++k)
      stepOf_[prediction.steps[k].vector] = static_cast<Index>(k);
  }

  Columns build() const {
    const Index vertices = grid_.vertexCount();
    std::vector<std::vector<Entry>> rows(vertices);
    parallelRanges(vertices, [&](Index begin, Index end) {
      std::vector<Sums> sum(surface_.storedCount());
      for (Index v = begin; v != end; ++v) rows[v] = coefficientRow(v, sum);
    });
    Columns columns;
    columns.start.assign(surface_.storedCount() + 1, 0);
    for (const auto& row : rows)
      for (const Entry& e : row) ++columns.start[e.vector + 1];
    for (Index v = 0; v < surface_.storedCount(); ++v) columns.start[v + 1] += columns.start[v];
    columns.vertex.resize(columns.start.back());
    columns.weight.resize(columns.start.back());
    columns.rowVector.reserve(columns.start.back());
    columns.rowWeight.reserve(columns.start.back());
    columns.rowStart.push_back(0);
    std::vector<Index> at = columns.start;
    for (Index v = 0; v < vertices; ++v) {
      for (const Entry& e : rows[v]) {
        columns.vertex[at[e.vector]] = v;
        columns.weight[at[e.vector]++] = e.weight;
        columns.rowVector.push_back(e.vector);
        columns.rowWeight.push_back(e.weight[0]);
      }
      columns.rowStart.push_back(static_cast<Index>(columns.rowVector.size()));
      rows[v] = {};
    }
    return columns;
  }

 private:
  struct Entry {
    Index vector = -1;
    std::array<float, 3> weight{};
  };
  using Sums = std::array<double, 3>;  // position, tangents along u and v

  // From the finest vector to the coarsest, adds the weights of each to the vectors that predict
  // it. `sum` is zero before and after.
  std::vector<Entry> coefficientRow(Index vertex, std::vector<Sums>& sum) const {
    constexpr double kNothing = 1e-4;  // of a step: results are verified anyway
    std::vector<Index> heap;
    const auto add = [&](Index vector, const Sums& more, double factor) {
      Sums& own = sum[vector];
      if (own == Sums{}) {
        heap.push_back(stepOf_[vector]);
        std::ranges::push_heap(heap);
      }
      for (int k = 0; k < 3; ++k) own[k] += factor * more[k];
    };
    for (int part = 0; part < 3; ++part) {
      const auto weights = surface_.weights(grid_.site(vertex), part == 1, part == 2);
      Sums unit{};
      unit[part] = 1;
      for (int k = 0; k < 36; ++k)
        if (weights.factors[k] != 0)
          for (const Term& t : inStored_[weights.vectors[k]])
            add(t.vector, unit, t.factor * weights.factors[k]);
    }
    std::vector<Entry> row;
    Index last = -1;
    while (!heap.empty()) {
      std::ranges::pop_heap(heap);
      const Index top = heap.back();
      heap.pop_back();
      if (top == last) continue;  // a sum that had cancelled is in the heap twice
      last = top;
      const Prediction::Step& step = prediction_.steps[top];
      const Sums factors = sum[step.vector];
      sum[step.vector] = {};
      const double most =
          std::max({std::abs(factors[0]), std::abs(factors[1]), std::abs(factors[2])});
      if (most < 1e-12) continue;
      for (const Term& t : prediction_.of(step)) add(t.vector, factors, t.factor);
      if (most / step.reach <= kNothing) continue;
      Entry entry{step.vector, {}};
      for (int k = 0; k < 3; ++k) entry.weight[k] = static_cast<float>(factors[k] / step.reach);
      row.push_back(entry);
    }
    row.shrink_to_fit();
    return row;
  }

  const Surface& surface_;
  const Tessellation& grid_;
  const Prediction& prediction_;
  const std::vector<std::vector<Term>>& inStored_;
  std::vector<Index> stepOf_;
};

}  // namespace

Columns columnsOf(const Surface& surface, const Tessellation& grid, const Prediction& prediction,
                  const std::vector<std::vector<Term>>& inStored) {
  return ColumnBuilder(surface, grid, prediction, inStored).build();
}

}  // namespace sweepface
