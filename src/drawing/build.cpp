// From a drawing to a model: the jets that nobody gave are found from the curves.
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"

#include "codec/limits.hpp"
#include "drawing/bend.hpp"
#include "drawing/frames.hpp"
#include "drawing/materials.hpp"
#include "drawing/misses.hpp"
#include "drawing/naming.hpp"
#include "drawing/weave.hpp"
#include "drawing/wishes.hpp"
#include "drawing/words.hpp"
#include "fit/defaults.hpp"
#include "mesh/grid_source.hpp"
#include "surface/jet_numbers.hpp"
#include "surface/wireframe_checks.hpp"

namespace sweepface {

namespace drawing {
namespace {

// An expression's derivatives below this share of the diagonal are none.
constexpr double kTrace = 1e-5;
// Nodes at one point may stand apart by such a share of the diagonal: models round each.
constexpr double kSamePoint = 0.01;

double diagonalOf(const Drawing& d) {
  Box box;
  for (const Drawing::Node& node : d.nodes)
    if (node.at) box.include(*node.at);
  for (const Drawing::Curve& curve : d.curves)
    for (const Vec3& point : curve.points) box.include(point);
  return norm(box.size());
}

class Builder {
 public:
  Builder(const Drawing& drawing, Woven woven)
      : d_(drawing),
        woven_(std::move(woven)),
        w_(woven_.wireframe),
        diagonal_(diagonalOf(drawing)) {}

  Result<Built> build() {
    for (const auto step : {&Builder::chooseStored, &Builder::makeSurfaces, &Builder::placeNodes,
                            &Builder::addExpressions, &Builder::bend, &Builder::assemble})
      if (auto ok = (this->*step)(); !ok) return std::unexpected(ok.error());
    return std::move(built_);
  }

 private:
  Index nodeCount() const { return static_cast<Index>(w_.nodes.size()); }
  NodeKind kind(Index n) const { return woven_.connectivity.kinds[n]; }

  std::unexpected<Error> refuse(const TextPlace& place, const std::string& what) const {
    return failAt(d_, place, what);
  }

  // A crossing stores what its jet gives, or all there is where the curves must say it.
  Result<void> chooseStored() {
    axes_.resize(w_.nodes.size());
    for (Index n = 0; n < nodeCount(); ++n) {
      if (auto ok = checkJets(n); !ok) return ok;
      if (kind(n) != NodeKind::crossing) continue;
      if (d_.nodes[n].jets.empty()) {
        w_.nodes[n].stored = kWholeJet;
        continue;
      }
      const auto quarter = placeInStar(woven_.connectivity, n, armOf(d_.nodes[n].jets[0]));
      if (!quarter) return leavesNot(n, 0);
      for (int k = 0; k < 9; ++k) {
        axes_[n][k] = turned(*quarter, k / 3, k % 3);
        if (k > 0 && d_.nodes[n].jets[0].vectors[k])
          w_.nodes[n].stored |= static_cast<JetMask>(1 << axes_[n][k].component);
      }
      if (!isClosed(w_.nodes[n].stored))
        return refuse(d_.nodes[n].place,
                      fmt::format("the jet of node '{}' has a derivative without those before it: "
                                  "xx needs x, xy needs x and y",
                                  d_.nodes[n].name));
    }
    return {};
  }

  Result<void> checkJets(Index n) const {
    const auto given = d_.nodes[n].jets.size();
    const auto fans = std::max<std::size_t>(1, woven_.connectivity.fans[n].size());
    if (given == 0 || given == fans) return {};
    return refuse(d_.nodes[n].place,
                  fmt::format("node '{}' has {} jets and needs {}; only creases that meet cut a "
                              "node into parts with a jet each",
                              d_.nodes[n].name, given, fans));
  }

  HalfArc armOf(const Drawing::Jet& jet) const { return woven_.halfArc(jet.along); }

  std::unexpected<Error> leavesNot(Index n, std::size_t jet) const {
    return refuse(d_.nodes[n].place,
                  fmt::format("a jet of node '{}' runs along '{}', which is no curve that leaves "
                              "it so; a '-' stands before a curve that arrives",
                              d_.nodes[n].name, d_.nodes[n].jets[jet].along));
  }

  // The jets are those of plain ribbons: shape parameters then bend what has been drawn.
  Result<void> makeSurfaces() {
    auto surface = Surface::make(w_);
    if (!surface) return failNamed(d_, w_, surface.error().message);
    built_.rig.surface = std::move(*surface);
    Wireframe plain = w_;
    std::ranges::fill(plain.ribbons, Shape{});
    surface = Surface::make(std::move(plain));
    if (!surface) return failNamed(d_, w_, surface.error().message);
    plain_ = std::move(*surface);
    const std::size_t poses = 1 + d_.expressions.size();
    if (static_cast<std::size_t>(plain_.storedCount()) * poses > codec::kMostVectors)
      return refuse({}, fmt::format("it stores {} vectors in each of {} shapes, together more than "
                                    "the {} of a file; give fewer expressions",
                                    plain_.storedCount(), poses, codec::kMostVectors));
    jets_.emplace(plain_);
    known_.assign(plain_.storedCount(), false);
    poses_.assign(poses, Pose(plain_.storedCount()));
    return {};
  }

  void set(std::size_t pose, Index node, int component, const Vec3& value, int fan = 0) {
    const Index v = jets_->at(node, component, fan);
    poses_[pose][v] = value;
    known_[v] = true;
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
      if (node.with.empty()) set(0, n, 0, *woven_.placeOf(d_, n));
      for (std::size_t f = 0; f < node.jets.size(); ++f) {
        if (auto ok = checkComplete(n, f); !ok) return ok;
        if (auto ok = setJet(0, n, f, node.jets[f].vectors); !ok) return ok;
      }
    }
    return {};
  }

  using Derivatives = std::array<std::optional<Vec3>, 9>;

  // Where nothing is predicted a jet has all its vectors.
  Result<void> checkComplete(Index n, std::size_t f) const {
    if (kind(n) == NodeKind::crossing) return {};
    const Drawing::Node& node = d_.nodes[n];
    const auto fan = fanOf(n, f);
    if (!fan) return leavesNot(n, f);
    for (std::size_t other = 0; other < f; ++other)
      if (fanOf(n, other) == fan)
        return refuse(node.place, fmt::format("two jets of node '{}' are of the part along '{}'",
                                              node.name, node.jets[f].along));
    std::string needed, unknown;
    for (int k = 1; k < 9; ++k) {
      const std::string word = fmt::format(" {}", kJetWords[static_cast<std::size_t>(k)]);
      const bool stored = jets_->at(n, k, *fan) >= 0;
      if (stored && !node.jets[f].vectors[k]) needed += word;
      if (!stored && kind(n) == NodeKind::irregular && node.jets[f].vectors[k]) unknown += word;
    }
    if (!needed.empty())
      return refuse(node.place, fmt::format("the jet of node '{}' along '{}' lacks{}", node.name,
                                            node.jets[f].along, needed));
    if (!unknown.empty())
      return refuse(
          node.place,
          fmt::format("other than four patches meet at node '{}', so that its jet has no{}",
                      node.name, unknown));
    return {};
  }

  // The fan of a creased node that a jet is of; 0 elsewhere. Nothing if its curve begins none.
  std::optional<int> fanOf(Index n, std::size_t f) const {
    if (kind(n) != NodeKind::creased) return 0;
    const auto place = placeInStar(woven_.connectivity, n, armOf(d_.nodes[n].jets[f]));
    const auto& fans = woven_.connectivity.fans[n];
    const int arms = static_cast<int>(woven_.connectivity.stars[n].arms.size());
    for (std::size_t k = 0; place && k < fans.size(); ++k)
      if (fans[k].first % arms == *place) return static_cast<int>(k);
    return std::nullopt;
  }

  Result<void> setJet(std::size_t pose, Index n, std::size_t f, const Derivatives& given) {
    if (kind(n) == NodeKind::irregular) return setIrregular(pose, n, given);
    const int fan = fanOf(n, f).value_or(0);
    for (int k = 1; k < 9; ++k) {
      const Turned axis = kind(n) == NodeKind::crossing ? axes_[n][k] : Turned{k, 1};
      if (!given[k]) continue;
      if (jets_->at(n, axis.component, fan) >= 0)
        set(pose, n, axis.component, axis.sign * *given[k], fan);
      else if (kind(n) == NodeKind::creased && woven_.connectivity.fans[n][fan].regular)
        repeated_.push_back({pose, n, f, k, *given[k]});
    }
    return {};
  }

  Result<void> setIrregular(std::size_t pose, Index n, const Derivatives& given) {
    const auto angle = angleAt(n);
    if (!angle) return leavesNot(n, 0);
    Jet jet{};
    for (int k = 1; k < 9; ++k) jet[k] = given[k].value_or(Vec3{});
    jet = turnedJet(jet, *angle);
    for (int k = 1; k < 9; ++k) {
      const Index v = jets_->at(n, k);
      if (v < 0) continue;
      const auto [told, isFirst] = irregular_.try_emplace({pose, v}, n);
      if (!isFirst && !isSame(poses_[pose][v], jet[k]))
        return refuse(placeIn(pose, n),
                      fmt::format("nodes '{}' and '{}' are one point and their jets say different "
                                  "things of it; give it one jet",
                                  d_.nodes[told->second].name, d_.nodes[n].name));
      set(pose, n, k, jet[k]);
    }
    return {};
  }

  /// Whether vectors of a jet differ by rounding alone.
  bool isSame(const Vec3& a, const Vec3& b) const {
    return norm(a - b) <= 1e-6 * std::max(norm(b), diagonal_);
  }
  /// Where it is said how a node stands in a pose.
  TextPlace placeIn(std::size_t pose, Index n) const {
    return pose == 0 ? d_.nodes[n].place : d_.expressions[pose - 1].place;
  }

  // Where the x axis of an irregular node's jet lies in the chart; nothing if its curve leaves none
  // of the nodes at the point.
  std::optional<double> angleAt(Index n) const {
    const HalfArc arm = armOf(d_.nodes[n].jets[0]);
    if (arm < 0 || w_.arcs[arcOf(arm)].collapsed) return std::nullopt;
    const Index start = w_.start(arm);
    if (kind(start) != NodeKind::irregular || jets_->home(start) != jets_->home(n))
      return std::nullopt;
    return chartAngle(plain_, *jets_, n, arm);
  }

  Result<void> addExpressions() {
    for (std::size_t e = 0; e < d_.expressions.size(); ++e) {
      auto offsets = offsetsOf(d_, woven_, d_.expressions[e]);
      if (!offsets) return std::unexpected(offsets.error());
      if (auto ok = shareMoves(d_.expressions[e], *offsets); !ok) return ok;
      for (Index n = 0; n < nodeCount(); ++n)
        if (offsets->nodes[n] && kind(n) != NodeKind::hanging) set(1 + e, n, 0, *offsets->nodes[n]);
      for (const Drawing::Move& move : d_.expressions[e].moves)
        if (auto ok = moveJets(1 + e, move); !ok) return ok;
      offsets_.push_back(std::move(*offsets));
    }
    return {};
  }

  // Nodes at one point move together; those with places of their own, as models have them, but for
  // a little.
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
    if (move.jets.size() != jets.size())
      return refuse(move.place, fmt::format("node '{}' has {} jets and {} move", move.name,
                                            jets.size(), move.jets.size()));
    for (std::size_t f = 0; f < jets.size(); ++f) {
      Derivatives offsets;
      for (const auto& [k, offset] : move.jets[f]) {
        if (!jets[f].vectors[k])
          return refuse(move.place, fmt::format("the jet of node '{}' has no '{}' that could move",
                                                move.name, kJetWords[static_cast<std::size_t>(k)]));
        offsets[k] = offset;
      }
      if (auto ok = setJet(pose, n, f, offsets); !ok) return ok;
    }
    return {};
  }

  Result<void> bend() {
    auto drawn = gatherWishes(d_, woven_, plain_, offsets_);
    if (!drawn) return std::unexpected(drawn.error());
    if (auto ok = bendLeast(plain_, patchSizes(d_, woven_), known_, drawn->wishes, poses_); !ok)
      return refuse({}, ok.error().message);
    if (auto ok = checkRepeated(); !ok) return ok;
    forgetTraces();
    for (const Pose& pose : poses_)
      for (const Vec3& v : pose)
        for (const double x : {v.x, v.y, v.z})
          if (!(std::abs(x) <= std::numeric_limits<float>::max()))
            return refuse({}, "a vector of the model is beyond what a float can hold");
    return measureMiss(*drawn);
  }

  // What a creased node's jet has from the part beside it must be said the same in both.
  Result<void> checkRepeated() const {
    std::vector<Vec3> vectors(plain_.vectorCount());
    std::size_t settled = poses_.size();
    for (const Repeated& r : repeated_) {
      if (r.pose != settled) plain_.settle(poses_[settled = r.pose], vectors);
      const Index v = jetVector(plain_, *jets_, r.node, r.component, *fanOf(r.node, r.jet));
      if (isSame(vectors[v], r.value)) continue;
      const Drawing::Node& node = d_.nodes[r.node];
      return refuse(placeIn(r.pose, r.node),
                    fmt::format("the jet of node '{}' along '{}' has its '{}' from the part of the "
                                "node before it, which says another; change it there, too",
                                node.name, node.jets[r.jet].along,
                                kJetWords[static_cast<std::size_t>(r.component)]));
    }
    return {};
  }

  // Bending dies away along the curves and is never nothing. What moves nobody visibly is not kept:
  // it would make every expression as large as the neutral.
  void forgetTraces() {
    const double trace = kTrace * diagonal_;
    for (std::size_t pose = 1; pose < poses_.size(); ++pose)
      for (std::size_t v = 0; v < known_.size(); ++v)
        if (!known_[v] && norm(poses_[pose][v]) < trace) poses_[pose][v] = {};
  }

  Result<void> measureMiss(const DrawnWishes& drawn) {
    const Miss miss = largestMiss(drawn, plain_, poses_);
    if (miss.wish < 0) return {};
    built_.largestMiss = miss.by;
    built_.missed = nameOf(d_, drawn, miss.wish);
    built_.missedIn = miss.pose == 0 ? "" : d_.expressions[miss.pose - 1].name;
    if (d_.tolerance == 0 || miss.by <= d_.tolerance) return {};
    const std::string in = built_.missedIn.empty() ? "" : fmt::format(" in '{}'", built_.missedIn);
    return refuse(placeOf(d_, drawn, miss.wish),
                  fmt::format("{} misses a point by {:.3g}{} and the tolerance is {:.3g}; put a "
                              "node between, or another point",
                              built_.missed, miss.by, in, d_.tolerance));
  }

  Result<void> assemble() {
    Rig& rig = built_.rig;
    built_.diagonal = diagonal_;
    rig.neutral = std::move(poses_[0]);
    for (std::size_t e = 0; e < d_.expressions.size(); ++e)
      rig.targets.push_back({d_.expressions[e].name, std::move(poses_[1 + e]), {}});
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
  std::vector<std::array<Turned, 9>>
      axes_;  // [nodes] where a crossing stores its jet's derivatives
  Surface plain_;
  std::optional<StoredJets> jets_;
  std::vector<bool> known_;       // [storedCount]
  std::vector<Pose> poses_;       // the neutral, then what every expression adds
  std::vector<Offsets> offsets_;  // [expressions]
  // What jets tell that other ones decide, in the order of poses.
  struct Repeated {
    std::size_t pose;
    Index node;
    std::size_t jet;
    int component;
    Vec3 value;
  };
  std::vector<Repeated> repeated_;
  std::map<std::pair<std::size_t, Index>, Index>
      irregular_;  // pose and vector → the node that said it
  Built built_;
};

}  // namespace
}  // namespace drawing

namespace {

/// Without the ribbons that no curve belongs to: a drawing may declare more than it uses.
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
