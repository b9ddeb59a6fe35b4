#include "codec/near_sites.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace sweepface::codec {

namespace {
constexpr std::size_t kEnough = 12, kMostReached = 128, kMostQueued = 1024;
}

std::span<const Index> NearSites::around(Index own, Index image) {
  found_.clear();
  ++search_;
  reachedBy_.resize(lines_.siteCount() + c_.stars.size(), 0);
  queue_.assign(1, Waiting(0, lines_.nodesOf(own)[0]));
  Index last = 0;
  for (std::size_t reached = 0; !queue_.empty() && reached < kMostReached;) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater{});
    const Index distance = queue_.back().distance(), node = queue_.back().node();
    queue_.pop_back();
    if (std::exchange(reachedBy(node), search_) == search_) continue;
    ++reached;
    const Index site = lines_.siteOf(node);
    if (site < 0) {
      goOn(node, distance);
      continue;
    }
    if (site != own && site != image) {
      if (found_.size() >= kEnough && distance > last) break;
      found_.push_back(site);
      last = distance;
      if (found_.size() == kMost) break;
    }
    const auto nodes = lines_.nodesOf(site);
    for (const Index n : nodes.first(std::min(nodes.size(), kMostReached))) goOn(n, distance);
  }
  return found_;
}

void NearSites::goOn(Index node, Index distance) {
  for (const HalfArc arm : c_.stars[node].arms) {
    if (queue_.size() >= kMostQueued) return;
    const Lines::Link& link = lines_.walk(arm);
    if (link.collapsed || link.back < 0 || reachedBy(link.node) == search_) continue;
    queue_.emplace_back(distance + link.distance, link.node);
    std::push_heap(queue_.begin(), queue_.end(), std::greater{});
  }
}

NearTable::NearTable(const Surface& surface, const Hierarchy& hierarchy) {
  const auto& sites = hierarchy.sites();
  Lines lines(surface);
  NearSites search(surface, lines);
  std::vector<Index> rank(sites.size());  // by site number in `lines`
  const auto numbered = [&](Index s) { return s < 0 ? -1 : lines.siteOf(sites[s].node); };
  for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) rank[numbered(s)] = s;
  range_.resize(sites.size());
  // Remove the sites once more, from the last to the first, images together.
  for (auto s = static_cast<Index>(sites.size()) - 1; s >= 0 && sites[s].span > 0;) {
    const Index first = sites[s].mirror == s - 1 ? s - 1 : s;
    for (Index k = first; k <= s; ++k) {
      range_[k][0] = static_cast<Index>(near_.size());
      for (const Index other : search.around(numbered(k), numbered(sites[k].mirror)))
        near_.push_back(rank[other]);
      range_[k][1] = static_cast<Index>(near_.size());
    }
    for (; s >= first; --s) lines.takeOut(numbered(s));
  }
}

}  // namespace sweepface::codec
