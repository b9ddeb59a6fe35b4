// Builds a model from a drawing. Jets that are not given are found from the curves.
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <ranges>
#include <set>

#include "sweepface/eval.hpp"

#include "codec/limits.hpp"
#include "drawing/bend.hpp"
#include "drawing/jet_axes.hpp"
#include "drawing/materials.hpp"
#include "drawing/misses.hpp"
#include "drawing/naming.hpp"
#include "drawing/told_jets.hpp"
#include "drawing/weave.hpp"
#include "drawing/wishes.hpp"
#include "drawing/words.hpp"
#include "fit/defaults.hpp"
#include "mesh/grid_source.hpp"

namespace sweepface {

namespace drawing {
namespace {

// Derivatives of an expression below this fraction of the diagonal are dropped.
constexpr double kTrace = 1e-5;
// Nodes at one point may be this fraction of the diagonal apart, since models round each of them.
constexpr double kSamePoint = 0.01;

class Builder {
 public:
  Builder(const Drawing& drawing, Woven woven)
      : d_(drawing),
        woven_(std::move(woven)),
        w_(woven_.wireframe),
        diagonal_(diagonalOf(drawing)) {}

  Result<Built> build() {
    for (const auto step : {&Builder::makeSurfaces, &Builder::placeNodes, &Builder::addExpressions,
                            &Builder::bend, &Builder::assemble})
      if (auto ok = (this->*step)(); !ok) return std::unexpected(ok.error());
    return std::move(built_);
  }

 private:
  Index nodeCount() const { return static_cast<Index>(w_.nodes.size()); }
  NodeKind kind(Index n) const { return woven_.connectivity.kinds[n]; }

  std::unexpected<Error> refuse(const TextPlace& place, const std::string& what) const {
    return failAt(d_, place, what);
  }

  // The jets are those of a surface with plain ribbons; shape parameters then bend what has been
  // drawn.
  Result<void> makeSurfaces() {
    auto axes = chooseStored(d_, woven_);
    if (!axes) return std::unexpected(axes.error());
    auto surface = Surface::make(w_);
    if (!surface) return failNamed(d_, w_, surface.error().message);
    built_.rig.surface = std::move(*surface);
    Wireframe plain = w_;
    std::ranges::fill(plain.ribbons, Shape{});
    surface = Surface::make(std::move(plain));
    if (!surface) return failNamed(d_, w_, surface.error().message);
    plain_ = std::move(*surface);
    const std::size_t poses = 1 + d_.expressions.size();
    if (static_cast<std::uint64_t>(plain_.storedCount()) * poses > codec::kMostVectors)
      return refuse({}, fmt::format("it stores {} vectors in each of {} shapes, together more than "
                                    "the {} of a file; give fewer expressions",
                                    plain_.storedCount(), poses, codec::kMostVectors));
    told_.emplace(d_, woven_, plain_, std::move(*axes));
    return {};
  }

  Result<void> placeNodes() {
    for (const Drawing::Node& node : d_.nodes)
      if (!node.with.empty() && node.at &&
          norm(*node.at - *d_.nodes[woven_.nodes.at(node.with)].at) > kSamePoint * diagonal_)
        return refuse(node.place, fmt::format("node '{}' stands with '{}', but is drawn at another "
                                              "place; leave out one of 'at' and 'with'",
                                              node.name, node.with));
    for (Index n = 0; n < nodeCount(); ++n) {
      if (kind(n) == NodeKind::hanging) continue;
      const Drawing::Node& node = d_.nodes[n];
      if (node.with.empty()) told_->place(0, n, *woven_.placeOf(d_, n));
      for (std::size_t f = 0; f < node.jets.size(); ++f)
        if (auto ok = told_->tellNeutral(n, f); !ok) return ok;
    }
    return {};
  }

  Result<void> addExpressions() {
    for (std::size_t e = 0; e < d_.expressions.size(); ++e) {
      auto offsets = offsetsOf(d_, woven_, d_.expressions[e]);
      if (!offsets) return std::unexpected(offsets.error());
      if (auto ok = shareMoves(d_.expressions[e], *offsets); !ok) return ok;
      for (Index n = 0; n < nodeCount(); ++n)
        if (offsets->nodes[n] && kind(n) != NodeKind::hanging)
          told_->place(1 + e, n, *offsets->nodes[n]);
      for (const Drawing::Move& move : d_.expressions[e].moves)
        if (auto ok = moveJets(1 + e, move); !ok) return ok;
      offsets_.push_back(std::move(*offsets));
    }
    return {};
  }

  // Nodes at one point move together. Those with positions of their own, as drawings of models
  // have, may differ a little.
  Result<void> shareMoves(const Drawing::Expression& expression, Offsets& offsets) const {
    for (Index n = 0; n < nodeCount(); ++n) {
      if (d_.nodes[n].with.empty()) continue;
      auto &own = offsets.nodes[n], &host = offsets.nodes[woven_.nodes.at(d_.nodes[n].with)];
      const double least = d_.nodes[n].at ? kSamePoint * diagonal_ : 0;
      if (own && host && norm(*own - *host) > least)
        return refuse(expression.place,
                      fmt::format("nodes '{}' and '{}' are one point and cannot move to different "
                                  "places",
                                  d_.nodes[n].with, d_.nodes[n].name));
      if (own && !host && norm(*own) > least) host = own;
    }
    for (Index n = 0; n < nodeCount(); ++n)
      if (!d_.nodes[n].with.empty() && !offsets.nodes[n])
        offsets.nodes[n] = offsets.nodes[woven_.nodes.at(d_.nodes[n].with)];
    return {};
  }

  Result<void> moveJets(std::size_t pose, const Drawing::Move& move) {
    if (move.jets.empty()) return {};
    const Index n = woven_.nodes.at(move.name);
    const auto& jets = d_.nodes[n].jets;
    if (jets.empty())
      return refuse(move.place, fmt::format("node '{}' has no jet that could move; give it one, or "
                                            "move it 'by' a vector alone",
                                            move.name));
    if (move.jets.size() != jets.size())
      return refuse(move.place, fmt::format("node '{}' has {} jets and {} move", move.name,
                                            jets.size(), move.jets.size()));
    for (std::size_t f = 0; f < jets.size(); ++f) {
      ToldJets::Derivatives offsets;
      for (const auto& [k, offset] : move.jets[f]) {
        if (!jets[f].vectors[k])
          return refuse(move.place, fmt::format("the jet of node '{}' has no '{}' that could move",
                                                move.name, kJetWords[static_cast<std::size_t>(k)]));
        offsets[k] = offset;
      }
      if (auto ok = told_->tell(pose, n, f, offsets); !ok) return ok;
    }
    return {};
  }

  Result<void> bend() {
    auto drawn = gatherWishes(d_, woven_, plain_, offsets_);
    if (!drawn) return std::unexpected(drawn.error());
    if (auto ok = bendLeast(plain_, patchSizes(d_, woven_), told_->isTold(), drawn->wishes,
                            told_->poses());
        !ok)
      return refuse({}, ok.error().message);
    if (auto ok = told_->checkRepeated(); !ok) return ok;
    forgetTraces();
    for (const Pose& pose : told_->poses())
      for (const Vec3& v : pose)
        for (const double x : {v.x, v.y, v.z})
          if (!(std::abs(x) <= std::numeric_limits<float>::max()))
            return refuse({}, "a vector of the model is beyond what a float can hold");
    return measureMiss(*drawn);
  }

  // Bending dies away along the curves but never becomes zero. What does not visibly move anything
  // is not kept, as it would make every expression as large as the neutral.
  void forgetTraces() {
    const double trace = kTrace * diagonal_;
    for (Pose& pose : told_->poses() | std::views::drop(1))
      for (std::size_t v = 0; v < pose.size(); ++v)
        if (!told_->isTold()[v] && norm(pose[v]) < trace) pose[v] = {};
  }

  Result<void> measureMiss(const DrawnWishes& drawn) {
    const Miss miss = largestMiss(drawn, plain_, told_->poses());
    if (miss.wish < 0) return {};
    built_.largestMiss = miss.by;
    built_.missed = nameOf(d_, drawn, miss.wish);
    built_.missedIn = miss.pose == 0 ? "" : d_.expressions[miss.pose - 1].name;
    if (d_.tolerance == 0 || miss.by <= d_.tolerance) return {};
    const std::string in = built_.missedIn.empty() ? "" : fmt::format(" in '{}'", built_.missedIn);
    return refuse(placeOf(d_, drawn, miss.wish),
                  fmt::format("{} misses a point by {:.4g}{} and the tolerance is {:.4g}; put a "
                              "node between, or another point",
                              built_.missed, miss.by, in, d_.tolerance));
  }

  Result<void> assemble() {
    Rig& rig = built_.rig;
    std::vector<Pose>& poses = told_->poses();
    built_.diagonal = diagonal_;
    rig.neutral = std::move(poses[0]);
    for (std::size_t e = 0; e < d_.expressions.size(); ++e)
      rig.targets.push_back({d_.expressions[e].name, std::move(poses[1 + e]), {}});
    rig.source = gridSource(rig.surface);
    addMaterials(rig.source, rig.surface, d_);
    rig.tolerance = d_.tolerance > 0 ? d_.tolerance : defaultTolerance();
    return nameThings(d_, rig);
  }

  double defaultTolerance() const {
    return std::max(built_.largestMiss, kDefaultTolerance * diagonal_);
  }

  const Drawing& d_;
  Woven woven_;
  Wireframe& w_;
  double diagonal_;
  Surface plain_;
  std::optional<ToldJets> told_;
  std::vector<Offsets> offsets_;  // [expressions]
  Built built_;
};

}  // namespace
}  // namespace drawing

namespace {

/// A drawing without the ribbons that no curve belongs to, since it may declare more than it uses.
Drawing withoutIdleRibbons(Drawing d) {
  std::set<std::string_view> used;
  for (const Drawing::Curve& curve : d.curves) used.insert(curve.ribbon);
  std::erase_if(d.ribbons, [&](const Drawing::Ribbon& r) { return !used.contains(r.name); });
  return d;
}

}  // namespace

Result<Built> build(const Drawing& whole) {
  const Drawing d = withoutIdleRibbons(whole);
  auto woven = drawing::weave(d);
  if (!woven) return std::unexpected(woven.error());
  return drawing::Builder(d, std::move(*woven)).build();
}

}  // namespace sweepface
