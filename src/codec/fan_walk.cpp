#include "codec/fan_walk.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace sweepface::codec {

void FanWalk::around(Index centre, std::span<const Step> steps, std::vector<Index>& neighbours) {
  const auto count = static_cast<Index>(steps.size());
  next_.resize(steps.size());
  taken_.assign(steps.size(), 0);
  ++walk_;
  for (Index s = count; s-- > 0;) {
    next_[s] = std::exchange(first_[steps[s][0]], s);
    ++arriving_[steps[s][1]];
  }
  for (Index s = 0; s < count; ++s)
    if (first_[steps[s][0]] == s) offerRest(steps[s][0]);
  const auto meet = [&](Index vertex) {
    if (vertex != centre && std::exchange(metIn_[vertex], walk_) != walk_)
      neighbours.push_back(vertex);
  };
  for (Index least = 0; least < count; ++least)
    while (!taken_[least])
      for (Index s = takeHead(least); s >= 0; s = first_[steps[s][1]]) {
        const auto [from, to] = steps[s];
        taken_[s] = 1;
        first_[from] = next_[s];
        --arriving_[to];
        meet(from);
        meet(to);
        offerRest(from);
      }
  heads_.clear();
}

// Offers the first remaining step from a vertex as a head, if no remaining step leads there.
void FanWalk::offerRest(Index vertex) {
  if (arriving_[vertex] > 0 || first_[vertex] < 0) return;
  heads_.push_back(first_[vertex]);
  std::push_heap(heads_.begin(), heads_.end(), std::greater{});
}

// The first head; `otherwise` if every remaining step has another that leads to it.
Index FanWalk::takeHead(Index otherwise) {
  while (!heads_.empty()) {
    std::pop_heap(heads_.begin(), heads_.end(), std::greater{});
    const Index step = heads_.back();
    heads_.pop_back();
    if (!taken_[step]) return step;
  }
  return otherwise;
}

}  // namespace sweepface::codec
