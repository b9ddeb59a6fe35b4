#include "codec/near_sites.hpp"

#include <algorithm>
#include <functional>

namespace sweepface::codec {

namespace {
constexpr std::size_t kEnough = 12, kMostReached = 128, kMostQueued = 1024;
}

std::vector<Index> NearSites::around(Index own, Index image) {
  std::vector<Index> found;
  ++search_;
  reachedBy_.resize(lines_.siteCount() + w_.nodes.size(), 0);
  queue_.assign(1, Waiting(0, lines_.nodesOf(own)[0]));
  Index last = 0;
  for (std::size_t reached = 0; !queue_.empty() && reached < kMostReached;) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater{});
    const Index distance = queue_.back().distance(), node = queue_.back().node();
    queue_.pop_back();
    if (reachedBy(node) == search_) continue;
    reachedBy(node) = search_;
    ++reached;
    const Index site = lines_.siteOf(node);
    if (site < 0) {
      goOn(node, distance);
      continue;
    }
    if (site != own && site != image) {
      if (found.size() >= kEnough && distance > last) break;
      found.push_back(site);
      last = distance;
      if (found.size() == kMost) break;
    }
    const auto nodes = lines_.nodesOf(site);
    for (const Index n : nodes.first(std::min(nodes.size(), kMostReached))) goOn(n, distance);
  }
  return found;
}

void NearSites::goOn(Index node, Index distance) {
  for (const HalfArc arm : c_.stars[node].arms) {
    if (queue_.size() >= kMostQueued) return;
    if (w_.arcs[arcOf(arm)].collapsed) continue;
    const Lines::Link link = lines_.walk(arm);
    if (link.back < 0 || reachedBy(w_.start(link.back)) == search_) continue;
    queue_.emplace_back(distance + link.distance, w_.start(link.back));
    std::push_heap(queue_.begin(), queue_.end(), std::greater{});
  }
}

Index& NearSites::reachedBy(Index node) {
  const Index site = lines_.siteOf(node);
  return reachedBy_[site >= 0 ? site : lines_.siteCount() + node];
}

}  // namespace sweepface::codec
