#include "codec/hierarchy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "codec/derivative_rules.hpp"
#include "codec/lines.hpp"
#include "codec/reach.hpp"

namespace sweepface::codec {

class HierarchyBuilder {
 public:
  HierarchyBuilder(const Surface& surface, const Mirror& mirror, Hierarchy& out)
      : surface_(surface),
        w_(surface.wireframe()),
        c_(surface.connectivity()),
        mirror_(mirror),
        out_(out),
        lines_(surface) {}

  void build() {
    reach_ = reachOf(surface_);
    gatherSites();
    takeOut();
    orderRoots();
    arrange();
    const DerivativeRules rules(surface_, out_.sites_, siteOf_);
    addDerivatives(rules, 1);
    addDerivatives(rules, 2);
    out_.images_ = imagesOf(surface_, mirror_, out_.sites_);
  }

 private:
  using Link = Lines::Link;

  // Vectors that many vertices depend on get finer steps, since an error there would have to be
  // corrected at all of those vertices.
  double finer(Index vector, Index span) const {
    const StoredVector& s = surface_.stored(vector);
    if (!s.isPosition()) return 3;
    return span == 0    ? 2
           : span <= 2  ? 1
           : span <= 4  ? 1.25
           : span <= 8  ? 1.5
           : span <= 16 ? 1.9
                        : 2.3;
  }

  struct Candidate {  // a site while it is being placed
    CodedSite site;
    Terms terms;
    Index image = -1;
    Index atLeast = 0;  // lower bound of its span
  };

  void gatherSites() {
    all_.reserve(static_cast<std::size_t>(lines_.siteCount()));
    for (Index v = 0; v < surface_.storedCount(); ++v) {
      const StoredVector& s = surface_.stored(v);
      if (s.isPosition()) {
        Candidate& c = all_.emplace_back();
        c.site.node = s.node;
        c.site.first = v;
      }
      ++all_.back().site.count;
    }
    for (Candidate& c : all_) {
      const Index image = mirror_.node[c.site.node];
      const bool creased = c_.kinds[c.site.node] == NodeKind::creased;
      c.image = image < 0 || creased ? -1 : lines_.siteOf(image);
    }
    // Images count only if they are mutual.
    for (std::size_t s = 0; s < all_.size(); ++s) {
      Index& image = all_[s].image;
      if (image >= 0 && (all_[image].image != static_cast<Index>(s) ||
                         all_[image].site.count != all_[s].site.count))
        image = -1;
    }
  }

  bool isGuessed(Index node) const { return node == guessed_ || node == guessedToo_; }
  Index position(Index node) const { return all_[lines_.siteOf(node)].site.first; }

  // The position of a site, or of a T-node by interpolation along the line that it lies on.
  bool place(Index node, Terms& terms, int depth = 0) {
    if (lines_.isSite(node)) {
      terms.push_back({position(node), 1});
      return lines_.isLeft(lines_.siteOf(node));
    }
    if (depth > 3) return false;
    const auto [ahead, behind] = c_.stars[node].line();
    Index span = 0;
    return between(ahead, behind, terms, span, depth + 1);
  }

  // Interpolates along a line at the node that two half-arcs leave, from one or two sites on each
  // side: appends the terms of each site, then multiplies them by its Lagrange factor.
  bool between(HalfArc ahead, HalfArc behind, Terms& terms, Index& span, int depth = 0) {
    std::array<double, 4> at;
    std::array<std::size_t, 5> first;  // of the terms of each site
    int count = 0;
    const std::size_t before = terms.size();
    const auto add = [&](const Link& link, int sign) {
      first[count] = terms.size();
      at[count++] = sign * link.distance;
      if (place(link.node, terms, depth)) return true;
      terms.resize(before);
      return false;
    };
    const std::array<Link, 2> near{lines_.walk(ahead), lines_.walk(behind)};
    for (const Link& link : near)
      if (link.back < 0 || isGuessed(link.node)) return false;
    span = near[0].distance + near[1].distance;
    for (int side = 0; side < 2; ++side) {
      const int sign = side == 0 ? 1 : -1;
      if (!add(near[side], sign)) return false;
      const Link far = lines_.beyond(near[side]);
      if (far.back < 0 || isGuessed(far.node)) continue;
      if (far.distance > 3 * near[side].distance + 2 * span) continue;
      if (!add(far, sign)) return false;
    }
    first[count] = terms.size();
    for (int k = 0; k < count; ++k) {
      double factor = 1;
      for (int other = 0; other < count; ++other)
        if (other != k) factor *= at[other] / (at[other] - at[k]);
      scale(terms, first[k], first[k + 1], factor);
    }
    return true;
  }

  static void scale(Terms& terms, std::size_t first, std::size_t end, double factor) {
    for (std::size_t k = first; k < end; ++k) terms[k].factor *= factor;
  }

  // The prediction of a crossing from its neighbours on its lines; shorter lines count more.
  struct Guess {
    Terms terms;
    Index span = 0;  // of the shortest line; 0 if there is none
    std::array<Index, 4> beside{-1, -1, -1, -1};
  };
  Guess guess(const Candidate& candidate) {
    Guess g;
    guessed_ = candidate.site.node;
    guessedToo_ = candidate.image < 0 ? guessed_ : all_[candidate.image].site.node;
    const Star& star = c_.stars[candidate.site.node];
    std::array<std::size_t, 3> first{};  // of the terms of each line
    std::array<Index, 2> span{};
    const int lines = linesThrough(star);
    for (int line = 0; line < lines; ++line) {
      const HalfArc ahead = star.arms[line], behind = star.arms[line + 2];
      const bool found = between(ahead, behind, g.terms, span[line]);
      first[line + 1] = g.terms.size();
      if (!found) {
        span[line] = 0;
        continue;
      }
      for (int side = 0; side < 2; ++side) {
        const Index node = lines_.walk(side ? behind : ahead).node;
        if (lines_.isSite(node)) g.beside[2 * line + side] = lines_.siteOf(node);
      }
    }
    double sum = 0;
    std::array<double, 2> weight{};
    for (int line = 0; line < lines; ++line)
      if (span[line] > 0) {
        const double s = span[line];
        sum += weight[line] = 1 / (s * s * s);
        g.span = g.span == 0 ? span[line] : std::min(g.span, span[line]);
      }
    for (int line = 0; line < lines; ++line)
      if (span[line] > 0) scale(g.terms, first[line], first[line + 1], weight[line] / sum);
    return g;
  }

  static int linesThrough(const Star& star) {
    return star.closed ? 2 : star.sectors.size() == 2 ? 1 : 0;
  }

  // Whether the nearest neighbours are too far apart for a guess on every line. The distance never
  // decreases, so it is kept as a lower bound.
  bool isTooWide(Candidate& c, Index most) {
    if (c.atLeast > most) return true;
    const Star& star = c_.stars[c.site.node];
    Index least = INT32_MAX;
    for (int line = 0; line < linesThrough(star); ++line) {
      const Link ahead = lines_.walk(star.arms[line]), behind = lines_.walk(star.arms[line + 2]);
      if (ahead.back >= 0 && behind.back >= 0)
        least = std::min(least, ahead.distance + behind.distance);
    }
    c.atLeast = least;
    return least > most;
  }

  // Only nodes with lines running through them can be removed.
  bool isRemovable(Index s) const {
    const Candidate& c = all_[s];
    if (!lines_.isLeft(s) || c_.kinds[c.site.node] != NodeKind::crossing) return false;
    return linesThrough(c_.stars[c.site.node]) > 0;
  }

  void takeOut() {
    std::vector<char> blocked(all_.size(), 0);
    const Index longest = std::clamp<Index>(lines_.longest(), 2, 1 << 12) * 8;
    for (Index most = 2; most <= longest; most += std::max<Index>(1, most / 3)) {
      bool any = true;
      while (any) {
        any = false;
        std::ranges::fill(blocked, 0);
        for (Index s = 0; s < static_cast<Index>(all_.size()); ++s)
          any |= takeOut(s, most, blocked);
      }
    }
  }

  bool takeOut(Index s, Index most, std::vector<char>& blocked) {
    const Index image = all_[s].image;
    if (blocked[s] || !isRemovable(s) || (image >= 0 && image < s)) return false;
    if (isTooWide(all_[s], most)) return false;
    Guess own = guess(all_[s]);
    if (own.span == 0 || own.span > most) return false;
    if (image < 0 || image == s) {
      remove(s, own, blocked);
      return true;
    }
    if (blocked[image] || !isRemovable(image)) return false;
    Guess other = guess(all_[image]);
    if (other.span != own.span) return false;
    remove(image, other, blocked);
    remove(s, own, blocked);
    return true;
  }

  void remove(Index s, Guess& g, std::vector<char>& blocked) {
    Candidate& c = all_[s];
    c.terms = std::move(g.terms);
    c.site.span = g.span;
    lines_.takeOut(s);
    for (const Index b : g.beside)
      if (b >= 0) blocked[b] = 1;
    double most = 0;  // the parent has the largest factor
    for (const Term& t : c.terms)
      if (std::abs(t.factor) > most + 1e-9) {
        most = std::abs(t.factor);
        c.site.parent = siteOfVector(t.vector);
      }
    order_.push_back(s);
  }

  Index siteOfVector(Index vector) const { return lines_.siteOf(surface_.stored(vector).node); }

  // Orders the remaining sites breadth first, mirror images together, and predicts each from those
  // of its remaining neighbours that were placed before it.
  void orderRoots() {
    std::vector<Index> roots;
    std::vector<char> reached(all_.size(), 0);
    placed_.assign(all_.size(), 0);
    std::vector<Index> queue;
    const auto reach = [&](Index s) {
      const Index image = all_[s].image < 0 ? s : all_[s].image;
      if (reached[s] || reached[image]) return;
      reached[s] = reached[image] = 1;
      queue.push_back(std::min(s, image));
    };
    for (Index s = 0; s < static_cast<Index>(all_.size()); ++s) {
      if (!lines_.isLeft(s)) continue;
      queue.clear();
      reach(s);
      for (std::size_t k = 0; k < queue.size(); ++k) {
        const Index own = queue[k], image = all_[own].image < 0 ? own : all_[own].image;
        placeRoot(own);
        if (image != own) placeRoot(image);
        for (const Index placed : {own, image}) {
          if (!placed_[placed]) roots.push_back(placed);
          placed_[placed] = 1;
          for (const auto& [next, distance] : around(placed)) reach(next);
        }
      }
    }
    std::ranges::reverse(order_);
    order_.insert(order_.begin(), roots.begin(), roots.end());
  }

  std::vector<std::array<Index, 2>> around(Index s) {
    std::vector<std::array<Index, 2>> result;
    for (const Index node : lines_.nodesOf(s))
      for (const HalfArc arm : c_.stars[node].arms) {
        const Link& link = lines_.walk(arm);
        if (link.collapsed || link.back < 0) continue;
        if (lines_.isSite(link.node) && lines_.siteOf(link.node) != s)
          result.push_back({lines_.siteOf(link.node), link.distance});
      }
    return result;
  }

  void placeRoot(Index s) {
    Candidate& c = all_[s];
    double sum = 0;
    for (const auto& [next, distance] : around(s)) {
      if (!placed_[next]) continue;
      c.terms.push_back({all_[next].site.first, 1.0 / distance});
      sum += c.terms.back().factor;
    }
    for (Term& t : c.terms) t.factor /= sum;
  }

  // Numbers sites in coding order and adds the prediction steps of their positions.
  void arrange() {
    std::vector<Index> rank(all_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) rank[order_[k]] = static_cast<Index>(k);
    siteOf_ = lines_.siteOf();
    for (Index& s : siteOf_)
      if (s >= 0) s = rank[s];
    for (const Index s : order_) {
      CodedSite site = all_[s].site;
      site.parent = site.parent < 0 ? -1 : rank[site.parent];
      site.mirror = all_[s].image < 0 ? -1 : rank[all_[s].image];
      if (site.parent >= 0) out_.sites_[site.parent].leaf = false;
      out_.sites_.push_back(site);
      addStep(site.first, all_[s].terms);
    }
  }

  void addStep(Index vector, const Terms& terms) {
    Prediction::Step step;
    step.vector = vector;
    step.site = siteOf_[surface_.stored(vector).node];
    step.terms = static_cast<Index>(out_.prediction_.terms.size());
    for (const Term& t : terms)
      if (t.factor != 0) out_.prediction_.terms.push_back(t);
    step.termsEnd = static_cast<Index>(out_.prediction_.terms.size());
    step.reach = roundedReach(reach_[vector] * finer(vector, out_.sites_[step.site].span));
    out_.prediction_.steps.push_back(step);
  }

  void addDerivatives(const DerivativeRules& rules, int order) {
    Terms terms;
    for (const CodedSite& site : out_.sites_)
      for (Index v = site.first; v < site.first + site.count; ++v)
        if (const StoredVector& s = surface_.stored(v); std::min(2, s.i + s.j) == order) {
          terms.clear();
          rules.predict(site, s, terms);
          addStep(v, terms);
        }
  }

  const Surface& surface_;
  const Wireframe& w_;
  const Connectivity& c_;
  const Mirror& mirror_;
  Hierarchy& out_;
  Lines lines_;
  std::vector<Candidate> all_;  // [sites] in the numbering of lines_
  std::vector<Index> siteOf_;   // [nodes] numbered in coding order
  std::vector<Index> order_;
  std::vector<double> reach_;             // [vectors]
  Index guessed_ = -1, guessedToo_ = -1;  // nodes that must not predict themselves or each other
  std::vector<char> placed_;              // [sites] roots already placed in the order
};

Hierarchy::Hierarchy(const Surface& surface, const Mirror& mirror) {
  HierarchyBuilder(surface, mirror, *this).build();
}

}  // namespace sweepface::codec
