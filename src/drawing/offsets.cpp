// Resolves what an expression moves.
#include <fmt/format.h>

#include "drawing/wishes.hpp"

namespace sweepface::drawing {

namespace {

class Mover {
 public:
  Mover(const Drawing& drawing, const Woven& woven)
      : d_(drawing), woven_(woven), taken_(woven.wireframe.nodes.size(), -1) {
    offsets_.nodes.resize(woven.wireframe.nodes.size());
    offsets_.curves.resize(woven.wireframe.arcs.size());
    offsets_.points.resize(woven.wireframe.arcs.size());
  }

  Result<Offsets> move(const std::vector<Drawing::Move>& moves) {
    // Nodes first, since a node's own entry takes precedence.
    for (const bool nodes : {true, false})
      for (const Drawing::Move& move : moves)
        if (woven_.nodes.contains(move.name) == nodes)
          if (auto ok = moveOne(move); !ok) return std::unexpected(ok.error());
    return std::move(offsets_);
  }

 private:
  Result<void> moveOne(const Drawing::Move& move) {
    if (const auto node = woven_.nodes.find(move.name); node != woven_.nodes.end())
      return moveNode(move, node->second);
    if (const auto curve = woven_.curves.find(move.name); curve != woven_.curves.end())
      return moveCurve(move, curve->second);
    return failAt(d_, move.place, fmt::format("'{}' is no node and no curve", move.name));
  }

  Result<void> moveNode(const Drawing::Move& move, Index node) {
    if (!move.points.empty())
      return failAt(d_, move.place, fmt::format("'{}' is a node and has no points", move.name));
    const Drawing::Node& drawn = d_.nodes[node];
    if (!drawn.at && drawn.with.empty())
      return failAt(d_, move.place,
                    fmt::format("node '{}' stands on the side of a patch and goes with it; move "
                                "the curves there",
                                move.name));
    offsets_.nodes[node] = move.by;
    taken_[node] = kItself;
    return {};
  }

  Result<void> moveCurve(const Drawing::Move& move, Index curve) {
    const Drawing::Curve& drawn = d_.curves[curve];
    if (!move.jets.empty())
      return failAt(d_, move.place, fmt::format("'{}' is a curve and has no jet", move.name));
    if (!move.points.empty() && move.points.size() != drawn.points.size())
      return failAt(d_, move.place,
                    fmt::format("{} offsets are given for the {} points of curve '{}'",
                                move.points.size(), drawn.points.size(), move.name));
    offsets_.curves[curve] = move.by;
    if (!move.points.empty()) offsets_.points[curve] = &move.points;
    for (Index node : {woven_.wireframe.arcs[curve].from, woven_.wireframe.arcs[curve].to})
      if (auto ok = takeAlong(move, curve, node); !ok) return ok;
    return {};
  }

  // A node with an entry of its own moves by that alone. A node on a side without a drawn position
  // goes where the surface takes it.
  Result<void> takeAlong(const Drawing::Move& move, Index curve, Index node) {
    auto& offset = offsets_.nodes[node];
    if (taken_[node] == kItself) return {};
    const bool isDrawn = d_.nodes[node].at || !d_.nodes[node].with.empty();
    if (isDrawn && offset && *offset != move.by)
      return failAt(d_, move.place,
                    fmt::format("curves '{}' and '{}' take node '{}' to different places; move the "
                                "node itself",
                                d_.curves[taken_[node]].name, move.name, d_.nodes[node].name));
    offset = move.by;
    taken_[node] = curve;
    return {};
  }

  static constexpr Index kItself = -2;

  const Drawing& d_;
  const Woven& woven_;
  Offsets offsets_;
  std::vector<Index> taken_;  // [nodes] the curve that moved it, or kItself, or -1
};

}  // namespace

Result<Offsets> offsetsOf(const Drawing& drawing, const Woven& woven,
                          const Drawing::Expression& expression) {
  return Mover(drawing, woven).move(expression.moves);
}

}  // namespace sweepface::drawing
