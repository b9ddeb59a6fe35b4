#include "codec/mirror_spreader.hpp"

namespace sweepface::codec {

std::span<const HalfArc> MirrorSpreader::spread(HalfArc h, HalfArc g) {
  queue_.clear();
  pair(h, g);
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const HalfArc here = queue_[k], there = bound_[here];
    pair(loops_.next[here], loops_.prev[there]);
    pair(loops_.prev[here], loops_.next[there]);
    pair(twin(here), twin(there));
  }
  return queue_;
}

void MirrorSpreader::undo() {
  for (const HalfArc h : queue_) {
    bound_[bound_[h]] = -1;
    bound_[h] = -1;
  }
}

void MirrorSpreader::noteEnds(HalfArc h, std::span<Index> images) const {
  images[w_.start(h)] = w_.end(bound_[h]);
  images[w_.end(h)] = w_.start(bound_[h]);
}

void MirrorSpreader::pair(HalfArc h, HalfArc g) {
  if (loops_.next[h] < 0 || loops_.next[g] < 0 || bound_[h] >= 0 || bound_[g] >= 0) return;
  const Arc &a = w_.arcs[arcOf(h)], &b = w_.arcs[arcOf(g)];
  if (a.edges != b.edges || a.collapsed != b.collapsed) return;
  if ((loops_.cornerAt[h] >= 0) != (loops_.cornerAt[loops_.next[g]] >= 0)) return;
  bound_[h] = g;
  bound_[g] = h;
  queue_.push_back(h);
}

}  // namespace sweepface::codec
