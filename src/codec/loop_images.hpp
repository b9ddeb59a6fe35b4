#pragma once

#include <array>
#include <span>
#include <vector>

#include "codec/mirror_spreader.hpp"

namespace sweepface::codec {

/// A half-arc of the loop of a patch, and its side.
struct LoopPiece {
  HalfArc h;
  int side;
};

/// The mirror of a wireframe onto itself, as far as its patches have been coded.
class LoopImages {
 public:
  using Seeds = std::span<const std::array<HalfArc, 2>>;

  /// Keeps references to `wireframe`, whose arcs are known once a patch with them is coded, and to
  /// `seeds`.
  LoopImages(const Wireframe& wireframe, Seeds seeds, std::size_t nodes, std::size_t arcs)
      : seeds_(seeds),
        next_(2 * arcs, -1),
        prev_(2 * arcs, -1),
        cornerAt_(2 * arcs, -1),
        node_(nodes, -1),
        mirror_(wireframe, {next_, prev_, cornerAt_}) {}

  void tell(Index patch, std::span<const LoopPiece> loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const LoopPiece &before = loop[k > 0 ? k - 1 : loop.size() - 1], &piece = loop[k];
      next_[before.h] = piece.h;
      prev_[piece.h] = before.h;
      if (k == 0 || piece.side != before.side) cornerAt_[piece.h] = 4 * patch + piece.side;
    }
    for (const auto& [h, g] : seeds_) spread(h, g);
    for (const LoopPiece& piece : loop)
      if (const HalfArc image = across(piece.h); image >= 0) spread(piece.h, image);
  }

  /// Whether a half-arc bounds a coded patch.
  bool isTold(HalfArc h) const { return next_[h] >= 0; }
  bool startsSide(HalfArc h) const { return cornerAt_[h] >= 0; }
  HalfArc before(HalfArc h) const { return prev_[h]; }
  HalfArc behind(HalfArc h) const { return next_[h]; }

  /// The mirror image of a half-arc, known from the patch on its other side, or -1.
  HalfArc across(HalfArc h) const {
    const HalfArc beside = mirror_.bound(twin(h));
    return beside < 0 ? -1 : twin(beside);
  }
  /// The same if the image bounds a coded patch, else -1.
  HalfArc of(HalfArc h) const {
    const HalfArc image = across(h);
    return image >= 0 && isTold(image) ? image : -1;
  }
  Index node(Index node) const { return node_[node]; }

 private:
  void spread(HalfArc from, HalfArc to) {
    for (const HalfArc here : mirror_.spread(from, to))
      for (const HalfArc h : {here, mirror_.bound(here)}) mirror_.noteEnds(h, node_);
  }

  Seeds seeds_;
  std::vector<HalfArc> next_, prev_;  // [half-arcs] in coded loops, else -1
  std::vector<Index> cornerAt_;       // [half-arcs]
  std::vector<Index> node_;           // [nodes] the image of each, or -1
  MirrorSpreader mirror_;
};

}  // namespace sweepface::codec
