#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// The loops around patches, as far as they are known: -1 at half-arcs that bound no patch.
struct Loops {
  std::span<const HalfArc> next, prev;  ///< [half-arcs]
  std::span<const Index> cornerAt;      ///< [half-arcs] -1 unless a side starts with it
};

/// Pairs half-arcs that bound mirrored patches on mirrored arcs. They run in opposite directions:
/// walking on from one is walking back from the other. Stops where the two sides differ.
class MirrorSpreader {
 public:
  /// Views `wireframe` and `loops`, which may grow; half-arcs are as many as `loops` has.
  MirrorSpreader(const Wireframe& wireframe, const Loops& loops)
      : w_(wireframe), loops_(loops), bound_(loops.next.size(), -1) {}

  /// Pairs two half-arcs and all that follows; the half-arcs that have a partner now and had none
  /// before, without those partners.
  std::span<const HalfArc> spread(HalfArc h, HalfArc g);
  /// Takes back what was spread last.
  void undo();

  /// The half-arc that bounds the image of the patch there, or -1.
  HalfArc bound(HalfArc h) const { return bound_[h]; }
  /// Notes the images [nodes] of both ends of a half-arc that has a partner.
  void noteEnds(HalfArc h, std::span<Index> images) const;

 private:
  void pair(HalfArc h, HalfArc g);

  const Wireframe& w_;
  Loops loops_;
  std::vector<HalfArc> bound_, queue_;
};

}  // namespace sweepface::codec
