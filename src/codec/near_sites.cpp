#include "codec/near_sites.hpp"

#include <algorithm>
#include <functional>

namespace sweepface::codec {

namespace {
constexpr std::size_t kEnough = 12, kMostReached = 128, kMostQueued = 1024;
}

NearSites::NearSites(const Surface& surface, Lines& lines) : lines_(lines) {
  const Wireframe& w = surface.wireframe();
  firstArm_.reserve(w.nodes.size() + 1);
  arms_.reserve(2 * w.arcs.size());
  place_ = lines.siteOf();
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    firstArm_.push_back(static_cast<Index>(arms_.size()));
    for (const HalfArc arm : surface.connectivity().stars[n].arms)
      if (!w.arcs[arcOf(arm)].collapsed) arms_.push_back(arm);
    if (place_[n] < 0) place_[n] = lines.siteCount() + static_cast<Index>(n);
  }
  firstArm_.push_back(static_cast<Index>(arms_.size()));
  reachedBy_.assign(static_cast<std::size_t>(lines.siteCount()) + w.nodes.size(), 0);
}

std::span<const Index> NearSites::around(Index own, Index image) {
  found_.clear();
  ++search_;
  queue_.assign(1, Waiting(0, lines_.nodesOf(own)[0]));
  Index last = 0;
  for (std::size_t reached = 0; !queue_.empty() && reached < kMostReached;) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater{});
    const Index distance = queue_.back().distance(), node = queue_.back().node();
    queue_.pop_back();
    Index& reachedBy = reachedBy_[place_[node]];
    if (reachedBy == search_) continue;
    reachedBy = search_;
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
  for (Index k = firstArm_[node]; k < firstArm_[node + 1]; ++k) {
    if (queue_.size() >= kMostQueued) return;
    const Lines::Link link = lines_.walk(arms_[k]);
    if (link.back < 0 || reachedBy_[place_[link.node]] == search_) continue;
    queue_.emplace_back(distance + link.distance, link.node);
    std::push_heap(queue_.begin(), queue_.end(), std::greater{});
  }
}

}  // namespace sweepface::codec
