#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// The loops around patches, as far as they are known; -1 for half-arcs that bound no patch.
struct Loops {
  std::span<const HalfArc> next, prev;  ///< [half-arcs]
  std::span<const Index> cornerAt;      ///< [half-arcs] -1 unless a side starts with it
};

/// Pairs half-arcs that bound mirrored patches on mirrored arcs. They run in opposite directions: a
/// step forwards from one is a step backwards from the other. Stops where the two sides differ.
class MirrorSpreader {
 public:
  /// Keeps references to `wireframe` and to the arrays of `loops`, which may be filled in later;
  /// their size is the number of half-arcs.
  MirrorSpreader(const Wireframe& wireframe, const Loops& loops)
      : w_(wireframe), loops_(loops), bound_(loops.next.size(), -1) {}

  /// Pairs two half-arcs and all that follow from them. Returns one half-arc of each new pair.
  std::span<const HalfArc> spread(HalfArc h, HalfArc g);
  /// Undoes the last spread.
  void undo();

  /// The partner of a half-arc, which bounds the image of its patch, or -1.
  HalfArc bound(HalfArc h) const { return bound_[h]; }
  /// Enters the images of both ends of a half-arc that has a partner into `images` [nodes].
  void noteEnds(HalfArc h, std::span<Index> images) const;

 private:
  void pair(HalfArc h, HalfArc g);

  const Wireframe& w_;
  Loops loops_;
  std::vector<HalfArc> bound_, queue_;
};

}  // namespace sweepface::codec
