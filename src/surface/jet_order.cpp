#include "surface/jet_order.hpp"

#include <algorithm>

namespace sweepface {

namespace {

// Whoever moves a vertex settles all vectors that it is derived from, step by step. On faces of any
// size there are a dozen steps.
constexpr int kMostSteps = 64;

// For each derived vector, the derived vectors that need it, in ascending order.
class Dependents {
 public:
  Dependents(const JetNumbers& numbers, const JetRows& rows)
      : starts_(numbers.count() + 1, 0), needs_(numbers.count(), 0) {
    const Index vectors = numbers.count();
    const auto eachNeed = [&](const auto& use) {
      for (Index v = 0; v < vectors; ++v)
        for (const Term& t : rows.of(v))
          if (!numbers.isStored(t.vector)) use(t.vector, v);
    };
    eachNeed([&](Index needed, Index v) { ++starts_[needed + 1], ++needs_[v]; });
    for (Index v = 0; v < vectors; ++v) starts_[v + 1] += starts_[v];
    all_.resize(starts_.back());
    std::vector<Index> next(starts_.begin(), starts_.end() - 1);
    eachNeed([&](Index needed, Index v) { all_[next[needed]++] = v; });
  }

  std::span<const Index> of(Index vector) const {
    return {all_.data() + starts_[vector], all_.data() + starts_[vector + 1]};
  }
  /// [vectors] how many derived vectors each needs.
  const std::vector<Index>& needs() const { return needs_; }

 private:
  std::vector<Index> starts_, needs_, all_;
};

// Finds cycles of rows by following unmet needs until they repeat. For each cycle it names one node
// that could break it: one that predicts if there is any, else a T-node.
class Circles {
 public:
  Circles(const JetNumbers& numbers, const JetRows& rows, const Connectivity& connectivity,
          std::span<const Index> place)
      : numbers_(numbers), rows_(rows), c_(connectivity), place_(place) {}

  std::vector<Index> breakers() const {
    std::vector<Index> seenFrom(place_.size(), -1), found;
    for (Index start = 0; start < static_cast<Index>(place_.size()); ++start) {
      Index v = start;
      while (place_[v] < 0 && seenFrom[v] < 0) {
        seenFrom[v] = start;
        v = unmet(v);
      }
      if (place_[v] < 0 && seenFrom[v] == start) found.push_back(breaker(v));
    }
    return found;
  }

 private:
  Index unmet(Index v) const {
    return std::ranges::find_if(rows_.of(v), [&](const Term& t) { return place_[t.vector] < 0; })
        ->vector;
  }
  Index breaker(Index first) const {
    Index v = first;
    do {
      if (c_.kinds[numbers_.owner(v).node] == NodeKind::crossing) break;
      v = unmet(v);
    } while (v != first);
    return numbers_.owner(v).node;
  }

  const JetNumbers& numbers_;
  const JetRows& rows_;
  const Connectivity& c_;
  std::span<const Index> place_;
};

}  // namespace

Result<JetTable> orderJets(const JetNumbers& numbers, const JetRows& rows,
                           const Connectivity& connectivity, std::vector<Index>& place,
                           std::vector<Index>* circle) {
  const Index vectors = numbers.count();
  JetTable table;
  place.assign(vectors, -1);
  for (Index v = 0; v < vectors; ++v)
    if (numbers.isStored(v)) {
      place[v] = static_cast<Index>(table.stored.size());
      table.stored.push_back(numbers.owner(v));
    }
  const Dependents dependents(numbers, rows);
  std::vector<Index> waitsFor = dependents.needs(), ready;
  ready.reserve(vectors - table.stored.size());
  for (Index v = 0; v < vectors; ++v)
    if (!numbers.isStored(v) && waitsFor[v] == 0) ready.push_back(v);
  table.terms.reserve(rows.termCount());
  table.rowStart.reserve(ready.capacity() + 1);
  Index node = -1;  // where derivatives take too many steps
  std::size_t nextStep = 0;
  for (std::size_t k = 0, left = kMostSteps; k < ready.size(); ++k) {
    const Index v = ready[k];
    if (k == nextStep) {  // those before it need fewer steps, and all later ones as many or more
      if (left-- == 0) {
        node = numbers.owner(v).node;
        break;
      }
      nextStep = ready.size();
    }
    place[v] = static_cast<Index>(table.stored.size() + k);
    for (const Term& t : rows.of(v)) table.terms.push_back({place[t.vector], t.factor});
    table.rowStart.push_back(static_cast<Index>(table.terms.size()));
    for (Index d : dependents.of(v))
      if (--waitsFor[d] == 0) ready.push_back(d);
  }
  const char *why = " take too many steps",
             *advice = ": nodes on sides stand on each other's; make one a corner on both sides";
  if (node < 0) {
    if (table.stored.size() + ready.size() == static_cast<std::size_t>(vectors)) return table;
    const std::vector<Index> breakers = Circles(numbers, rows, connectivity, place).breakers();
    if (circle) *circle = breakers;
    node = breakers.front();
    why = " are derived from themselves";
    advice = connectivity.kinds[node] == NodeKind::hanging
                 ? ": nodes on sides stand on each other's in a circle; make one of them a corner "
                   "on both sides"
                 : "; let it store its own";
  }
  return fail("the derivatives at node ", node, why, advice);
}

}  // namespace sweepface
