// Turns a drawing into a wireframe: names become indices.
#include "drawing/weave.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "surface/union_find.hpp"

namespace sweepface::drawing {

namespace {

class Weaver {
 public:
  explicit Weaver(const Drawing& drawing) : d_(drawing), w_(woven_.wireframe) {}

  Result<Woven> weave() {
    for (const auto step :
         {&Weaver::nameThings, &Weaver::addNodes, &Weaver::addCurves, &Weaver::addPatches,
          &Weaver::checkUse, &Weaver::checkPlaces, &Weaver::addCreases, &Weaver::setEdges,
          &Weaver::connect, &Weaver::checkCreases})
      if (auto ok = (this->*step)(); !ok) return std::unexpected(ok.error());
    return std::move(woven_);
  }

 private:
  std::unexpected<Error> refuse(const TextPlace& place, const std::string& what) const {
    return failAt(d_, place, what);
  }

  template <typename Things>
  Result<void> number(const Things& things, std::map<std::string, Index, std::less<>>& numbers,
                      std::string_view what) const {
    Index k = 0;
    for (const auto& thing : things) {
      if (!thing.name.empty() && !numbers.emplace(thing.name, k).second)
        return refuse(thing.place, fmt::format("there are two {} named '{}'", what, thing.name));
      ++k;
    }
    return {};
  }

  Result<void> nameThings() {
    if (d_.patches.empty()) return refuse({}, "there is no patch, so there is no surface");
    std::map<std::string, Index, std::less<>> expressions;
    if (auto ok = number(d_.nodes, woven_.nodes, "nodes"); !ok) return ok;
    if (auto ok = number(d_.curves, woven_.curves, "curves"); !ok) return ok;
    if (auto ok = number(d_.patches, woven_.patches, "patches"); !ok) return ok;
    if (auto ok = number(d_.ribbons, woven_.ribbons, "ribbons"); !ok) return ok;
    if (auto ok = number(d_.expressions, expressions, "expressions"); !ok) return ok;
    for (const Drawing::Curve& curve : d_.curves)
      if (woven_.nodes.contains(curve.name))
        return refuse(curve.place, fmt::format("a node and a curve are both named '{}'; an "
                                               "expression could not tell them apart",
                                               curve.name));
    return {};
  }

  Index find(const std::map<std::string, Index, std::less<>>& numbers,
             std::string_view name) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? -1 : found->second;
  }

  // At first every node has a point of its own or shares one. checkUse() removes those of nodes
  // that turn out to lie on sides of patches.
  Result<void> addNodes() {
    for (const Drawing::Node& node : d_.nodes) {
      if (node.at && !isFinite(*node.at))
        return refuse(node.place, fmt::format("node '{}' is at no finite place", node.name));
      const Index host = node.with.empty() ? -1 : find(woven_.nodes, node.with);
      if (!node.with.empty() && (host < 0 || !d_.nodes[host].with.empty() || !d_.nodes[host].at))
        return refuse(node.place, fmt::format("node '{}' stands with '{}', which is no node with "
                                              "an 'at' and a point of its own",
                                              node.name, node.with));
      w_.nodes.push_back({-1, kPosition});
    }
    for (std::size_t n = 0; n < d_.nodes.size(); ++n) {
      const std::string& with = d_.nodes[n].with;
      Index& own = w_.nodes[with.empty() ? n : find(woven_.nodes, with)].point;
      if (own < 0) own = w_.points++;
      w_.nodes[n].point = own;
    }
    return {};
  }

  Result<void> addCurves() {
    for (const Drawing::Curve& curve : d_.curves) {
      const Index from = find(woven_.nodes, curve.from), to = find(woven_.nodes, curve.to);
      if (from < 0 || to < 0)
        return refuse(curve.place, fmt::format("curve '{}' ends at '{}', which is no node",
                                               curve.name, from < 0 ? curve.from : curve.to));
      if (!std::ranges::all_of(curve.points, isFinite))
        return refuse(curve.place, fmt::format("a point of curve '{}' is not finite", curve.name));
      const bool onePoint = w_.nodes[from].point == w_.nodes[to].point;
      if (curve.collapsed && !onePoint)
        return refuse(curve.place,
                      fmt::format("curve '{}' is collapsed, so it must join two nodes at one "
                                  "point: give one of them \"with\": the other",
                                  curve.name));
      if (curve.collapsed && !curve.points.empty())
        return refuse(curve.place, fmt::format("curve '{}' is collapsed into a point and can have "
                                               "no points between its ends",
                                               curve.name));
      w_.arcs.push_back({from, to, curve.edges, 0, curve.collapsed});
    }
    return {};
  }

  Result<void> addPatches() {
    usedBy_.assign(2 * w_.arcs.size(), -1);
    for (Index p = 0; p < static_cast<Index>(d_.patches.size()); ++p) {
      const Drawing::Patch& patch = d_.patches[p];
      if (patch.sides.size() != 4)
        return refuse(patch.place,
                      fmt::format("{} has {} sides; a patch has four, and where there are three "
                                  "one is a collapsed curve at the tip",
                                  quoted(p), patch.sides.size()));
      auto& sides = w_.patches.emplace_back().sides;
      for (std::size_t s = 0; s < 4; ++s) {
        sides[s] = static_cast<Index>(w_.loops.size());
        if (patch.sides[s].empty())
          return refuse(patch.place, fmt::format("side {} of {} has no curve", s + 1, quoted(p)));
        for (const std::string& reference : patch.sides[s])
          if (auto ok = addToLoop(p, reference); !ok) return ok;
      }
      sides[4] = static_cast<Index>(w_.loops.size());
      if (auto ok = checkLoop(p); !ok) return ok;
    }
    return {};
  }

  std::string quoted(Index patch) const { return quotedPatch(d_, patch); }

  Result<void> addToLoop(Index p, const std::string& reference) {
    const TextPlace& place = d_.patches[p].place;
    const HalfArc h = woven_.halfArc(reference);
    if (h < 0)
      return refuse(place, fmt::format("{} names '{}', which is no curve", quoted(p), reference));
    if (usedBy_[h] >= 0)
      return refuse(place, fmt::format("curve '{}' is used twice in the same direction, by {} and "
                                       "by {}; every patch goes round counter-clockwise seen from "
                                       "outside",
                                       nameOf(h), quoted(usedBy_[h]), quoted(p)));
    usedBy_[h] = p;
    w_.loops.push_back(h);
    return {};
  }

  const std::string& nameOf(HalfArc h) const { return d_.curves[arcOf(h)].name; }
  const std::string& nodeName(Index n) const { return d_.nodes[n].name; }

  Result<void> checkLoop(Index p) const {
    const auto& sides = w_.patches[p].sides;
    for (Index k = sides[0]; k < sides[4]; ++k) {
      const HalfArc h = w_.loops[k], next = w_.loops[k + 1 < sides[4] ? k + 1 : sides[0]];
      if (w_.end(h) != w_.start(next))
        return refuse(d_.patches[p].place,
                      fmt::format("the curves of {} do not meet: '{}' ends at node '{}' and '{}' "
                                  "begins at node '{}'; a '-' before a curve turns it round",
                                  quoted(p), nameOf(h), nodeName(w_.end(h)), nameOf(next),
                                  nodeName(w_.start(next))));
    }
    if (std::all_of(w_.loops.begin() + sides[0], w_.loops.begin() + sides[4],
                    [&](HalfArc h) { return w_.arcs[arcOf(h)].collapsed; }))
      return refuse(d_.patches[p].place,
                    fmt::format("all curves of {} are collapsed, so that it is a point; leave it "
                                "out, or give it curves with a length",
                                quoted(p)));
    return {};
  }

  // Checks that everything belongs to a patch, and removes the points of nodes within sides. All
  // other nodes need a position.
  Result<void> checkUse() {
    for (std::size_t a = 0; a < w_.arcs.size(); ++a)
      if (usedBy_[2 * a] < 0 && usedBy_[2 * a + 1] < 0)
        return refuse(d_.curves[a].place,
                      fmt::format("curve '{}' bounds no patch", d_.curves[a].name));
    std::vector<bool> used(w_.nodes.size()), stands(w_.nodes.size());
    for (Index p = 0; p < static_cast<Index>(w_.patches.size()); ++p)
      for (int s = 0; s < 4; ++s)
        for (HalfArc h : w_.side(p, s)) {
          used[w_.start(h)] = true;
          if (h != w_.side(p, s)[0]) stands[w_.start(h)] = true;
        }
    std::vector<Index> pointOf(w_.points, -1);  // without the points of nodes that need none
    w_.points = 0;
    for (std::size_t n = 0; n < w_.nodes.size(); ++n) {
      const Drawing::Node& node = d_.nodes[n];
      if (!used[n]) return refuse(node.place, fmt::format("node '{}' is on no curve", node.name));
      if (stands[n] && (!node.jets.empty() || !node.with.empty()))
        return refuse(node.place,
                      fmt::format("node '{}' stands on the side of a patch, whose curve has its "
                                  "derivatives; leave out 'jet' and 'with'",
                                  node.name));
      if (!stands[n] && !node.at && node.with.empty())
        return refuse(node.place, fmt::format("node '{}' needs 'at': only a node on the side of a "
                                              "patch, between two curves, goes without",
                                              node.name));
      Index& point = w_.nodes[n].point;
      if (stands[n]) {
        point = -1;
        continue;
      }
      if (pointOf[point] < 0) pointOf[point] = w_.points++;
      point = pointOf[point];
    }
    return {};
  }

  // Checks that points that determine where a curve runs differ from their neighbours on it.
  Result<void> checkPlaces() {
    double size = 0;
    const Drawing::Node* reference = nullptr;
    for (const Drawing::Node& node : d_.nodes) {
      if (!node.at) continue;
      if (!reference) reference = &node;
      size = std::max(size, norm(*node.at - *reference->at));
    }
    for (const Drawing::Curve& curve : d_.curves) {
      const Index start = find(woven_.nodes, curve.from), end = find(woven_.nodes, curve.to);
      const auto first = woven_.placeOf(d_, start), second = woven_.placeOf(d_, end);
      const bool drawn = !curve.points.empty() || !hasJets(start) || !hasJets(end);
      if (curve.collapsed || !drawn || !first || !second) continue;
      // How a point coincides with the one before it, if it does: with a node that is far too far
      // away, all others do.
      const auto coinciding = [&](const Vec3& point,
                                  const Vec3& before) -> std::optional<std::string> {
        if (norm(point - before) > 1e-9 * size) return std::nullopt;
        if (point == before) return "";
        return fmt::format(", in a drawing that is {:.3g} wide", size);
      };
      Vec3 last = *first;
      std::size_t number = 0;
      for (const Vec3& point : curve.points) {
        ++number;
        if (const auto how = coinciding(point, last))
          return refuse(curve.place,
                        fmt::format("point {} of curve '{}' coincides with the one before it{}",
                                    number, curve.name, *how));
        last = point;
      }
      if (const auto how = coinciding(*second, last))
        return refuse(curve.place, fmt::format("the last point of curve '{}' coincides with the "
                                               "one before it{}; a curve needs a length",
                                               curve.name, *how));
    }
    return {};
  }
  // Whether a node has jets, its own or those of the node it is with.
  bool hasJets(Index node) const {
    const Drawing::Node& n = d_.nodes[node];
    return !n.jets.empty() ||
           (!n.with.empty() && !d_.nodes[find(woven_.nodes, n.with)].jets.empty());
  }
  Result<void> setEdges() { return chooseEdges(d_, woven_); }

  Result<void> connect() {
    w_.ribbons = {{}};  // one for all, just to connect
    auto connectivity = Connectivity::make(w_);
    if (!connectivity) return failNamed(d_, w_, connectivity.error().message);
    woven_.connectivity = std::move(*connectivity);
    if (auto ok = checkPoints(); !ok) return ok;
    return chooseRibbons(d_, woven_);
  }

  // Around an irregular point patches follow each other across curves that leave it or are
  // collapsed there. Nodes that no such curve leads to would be left without derivatives.
  Result<void> checkPoints() const {
    UnionFind around(w_.nodes.size());
    for (const Arc& arc : w_.arcs)
      if (arc.collapsed) around.join(arc.from, arc.to);
    std::vector<Index> first(w_.points, -1);
    for (Index n = 0; n < static_cast<Index>(w_.nodes.size()); ++n) {
      if (woven_.connectivity.kinds[n] != NodeKind::irregular) continue;
      Index& known = first[w_.nodes[n].point];
      if (known < 0) known = n;
      if (around.find(known) != around.find(n))
        return refuse(d_.nodes[n].place,
                      fmt::format("nodes '{}' and '{}' are tips at one point, but no collapsed "
                                  "curve leads from one to the other; give one of them an 'at' of "
                                  "its own instead of 'with'",
                                  nodeName(known), nodeName(n)));
    }
    return {};
  }

  Result<void> addCreases() {
    for (const Drawing::Crease& crease : d_.creases) {
      const Index a = find(woven_.curves, crease.curve);
      if (a < 0)
        return refuse(crease.place, fmt::format("the crease '{}' is no curve", crease.curve));
      if (usedBy_[2 * a] < 0 || usedBy_[2 * a + 1] < 0)
        return refuse(crease.place, fmt::format("the crease '{}' bounds one patch only; a crease "
                                                "lies between two",
                                                crease.curve));
      if (w_.arcs[a].crease)
        return refuse(crease.place, fmt::format("the crease '{}' is given twice", crease.curve));
      w_.arcs[a].crease = true;
    }
    return {};
  }

  // Checks that each crease cuts the star of at least one of its ends; otherwise it would have no
  // effect.
  Result<void> checkCreases() {
    for (const Drawing::Crease& crease : d_.creases) {
      const Arc& arc = w_.arcs[find(woven_.curves, crease.curve)];
      const auto& kinds = woven_.connectivity.kinds;
      if (kinds[arc.from] != NodeKind::creased && kinds[arc.to] != NodeKind::creased)
        return refuse(crease.place,
                      fmt::format("the crease '{}' ends inside the surface at both ends, where it "
                                  "is smooth; a crease goes on to another one or to a boundary",
                                  crease.curve));
    }
    return {};
  }

  const Drawing& d_;
  Woven woven_;
  Wireframe& w_;
  std::vector<Index> usedBy_;  // [half-arcs] patch
};

}  // namespace

std::string quotedPatch(const Drawing& drawing, Index patch) {
  const std::string& name = drawing.patches[patch].name;
  return name.empty() ? fmt::format("patch 'p{}'", patch) : fmt::format("patch '{}'", name);
}

HalfArc Woven::halfArc(std::string_view reference) const {
  const bool backwards = reference.starts_with('-');
  const auto found = curves.find(reference.substr(backwards));
  return found == curves.end() ? -1 : 2 * found->second + backwards;
}

double Woven::lengthOf(const Drawing& drawing, Index curve) const {
  const Arc& arc = wireframe.arcs[curve];
  const auto from = placeOf(drawing, arc.from), to = placeOf(drawing, arc.to);
  if (!from || !to || arc.collapsed) return 0;
  double length = 0;
  Vec3 last = *from;
  for (const Vec3& p : drawing.curves[curve].points) length += norm(p - std::exchange(last, p));
  return length + norm(*to - last);
}

std::optional<Vec3> Woven::placeOf(const Drawing& drawing, Index node) const {
  const Drawing::Node& drawn = drawing.nodes[node];
  return drawn.at || drawn.with.empty() ? drawn.at : drawing.nodes[nodes.at(drawn.with)].at;
}

Result<Woven> weave(const Drawing& drawing) { return Weaver(drawing).weave(); }

}  // namespace sweepface::drawing
