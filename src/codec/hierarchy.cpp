#include "codec/hierarchy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweepface::codec {

namespace {

// Where a line leads from a half-arc: to the half-arc that comes back from the next node that is
// still there.
struct Link {
  HalfArc back = -1;
  Index distance = 0;
};

// How strongly derivatives of order 1 and 2 move a curve of length 1: the largest values of the
// quintic Hermite polynomials.
constexpr double kReach[3] = {1, 0.16, 0.0173};

}  // namespace

class HierarchyBuilder {
 public:
  HierarchyBuilder(const Surface& surface, const Mirror& mirror, Hierarchy& out)
      : surface_(surface),
        w_(surface.wireframe()),
        c_(surface.connectivity()),
        mirror_(mirror),
        out_(out) {}

  void build() {
    measureReach();
    gatherSites();
    links_.resize(2 * w_.arcs.size());
    for (HalfArc h = 0; h < static_cast<HalfArc>(links_.size()); ++h)
      links_[h] = {twin(c_.rails[h].last), c_.rails[h].edges};
    takeOut();
    orderRoots();
    arrange();
    addDerivatives(1);
    addDerivatives(2);
    mirrorVectors();
  }

 private:
  using Terms = std::vector<Term>;

  // How far one unit of a vector moves the surface: what it does to the corners of patches, there
  // by the largest values of the basis, and to what is derived from it.
  void measureReach() {
    reach_.assign(surface_.vectorCount(), 0);
    for (Index p = 0; p < surface_.patchCount(); ++p)
      for (int corner = 0; corner < 4; ++corner) {
        const double alpha = corner % 2 ? surface_.edgesV(p) : surface_.edgesU(p),
                     beta = corner % 2 ? surface_.edgesU(p) : surface_.edgesV(p);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            const double r = kReach[i] * kReach[j] *
                             (i == 0   ? 1
                              : i == 1 ? alpha
                                       : alpha * alpha) *
                             (j == 0   ? 1
                              : j == 1 ? beta
                                       : beta * beta);
            double& reach = reach_[surface_.cornerJet(p, corner, i, j).vector];
            reach = std::max(reach, r);
          }
      }
    for (Index v = surface_.vectorCount(); v-- > surface_.storedCount();)
      for (const Term& t : surface_.derivation(v))
        reach_[t.vector] = std::max(reach_[t.vector], std::abs(t.factor) * reach_[v]);
  }

  // Two values an octave: no rounding in the last digit can tip them.
  static double rounded(double reach) {
    if (!(reach > 1e-6)) return 1e-6;
    int exponent = 0;
    const double mantissa = std::frexp(std::min(reach, 1e12), &exponent);
    const double step = mantissa < 0.5843 ? 0.5 : mantissa < 0.8217 ? 0.703125 : 1;
    return std::ldexp(step, exponent);
  }

  struct Candidate {  // a site while it is being placed
    CodedSite site;
    Terms terms;
    bool alive = true, hub = false;
    Index image = -1;
  };

  void gatherSites() {
    siteOf_.assign(w_.nodes.size(), -1);
    std::vector<Index> ofPoint(w_.points, -1);
    for (Index v = 0; v < surface_.storedCount(); ++v) {
      const StoredVector& s = surface_.stored(v);
      if (s.i == 0 && s.j == 0) {
        Candidate c;
        c.site.node = s.node;
        c.site.first = v;
        c.hub = c_.kinds[s.node] == NodeKind::irregular;
        siteOf_[s.node] = static_cast<Index>(all_.size());
        if (c.hub) ofPoint[w_.nodes[s.node].point] = siteOf_[s.node];
        all_.push_back(std::move(c));
      }
      ++all_.back().site.count;
    }
    for (std::size_t n = 0; n < w_.nodes.size(); ++n)
      if (c_.kinds[n] == NodeKind::irregular) siteOf_[n] = ofPoint[w_.nodes[n].point];
    for (Candidate& c : all_) {
      const Index image = mirror_.node[c.site.node];
      const bool creased = c_.kinds[c.site.node] == NodeKind::creased;
      c.image = image < 0 || creased ? -1 : siteOf_[image];
    }
    // A mirror is one only if it leads back.
    for (std::size_t s = 0; s < all_.size(); ++s) {
      Index& image = all_[s].image;
      if (image >= 0 && (all_[image].image != static_cast<Index>(s) ||
                         all_[image].site.count != all_[s].site.count))
        image = -1;
    }
    for (std::size_t s = 0; s < all_.size(); ++s)
      if (all_[s].image >= 0 && all_[all_[s].image].image != static_cast<Index>(s))
        all_[s].image = -1;
  }

  bool isSite(Index node) const { return siteOf_[node] >= 0; }
  bool isGuessed(Index node) const { return node == guessed_ || node == guessedToo_; }
  Index position(Index node) const { return all_[siteOf_[node]].site.first; }

  HalfArc oppositeOf(HalfArc h) const {
    const Index node = w_.start(h);
    const auto& arms = c_.stars[node].arms;
    const auto arm = std::ranges::find(arms, h) - arms.begin();
    const int on = c_.opposite(node, static_cast<int>(arm));
    return on < 0 ? -1 : arms[on];
  }

  // The first living site or T-node along a line.
  Link walk(HalfArc h) const {
    if (h < 0) return {};
    Link link = links_[h];
    for (std::size_t steps = 0; steps < w_.arcs.size(); ++steps) {
      const Index node = w_.start(link.back);
      if (!isSite(node) || all_[siteOf_[node]].alive) return link;
      const HalfArc on = oppositeOf(link.back);
      if (on < 0) return {};
      link = {links_[on].back, link.distance + links_[on].distance};
    }
    return {};
  }

  // One more site beyond a living one, on the same line.
  Link beyond(const Link& link) const {
    const Index node = w_.start(link.back);
    if (!isSite(node) || all_[siteOf_[node]].hub) return {};
    const HalfArc on = oppositeOf(link.back);
    if (on < 0) return {};
    Link next = walk(on);
    if (next.back < 0 || !isSite(w_.start(next.back))) return {};
    next.distance += link.distance;
    return next;
  }

  static void add(Terms& terms, const Terms& more, double factor) {
    for (const Term& t : more) terms.push_back({t.vector, factor * t.factor});
  }

  // The position of a site, or of a T-node by what stands on the line it hangs on.
  bool place(Index node, Terms& terms, int depth = 0) const {
    if (isSite(node)) {
      terms.push_back({position(node), 1});
      return all_[siteOf_[node]].alive;
    }
    if (depth > 3) return false;
    const Star& star = c_.stars[node];
    const auto straight = std::ranges::find(star.sectors, kStraight) - star.sectors.begin();
    Index span = 0;
    return between(star.arms[(straight + 1) % 3], star.arms[straight], terms, span, depth + 1);
  }

  // Interpolates at the place from which two half-arcs leave along a line, from one or two sites on
  // both sides.
  bool between(HalfArc ahead, HalfArc behind, Terms& terms, Index& span, int depth = 0) const {
    std::array<double, 4> at;
    std::array<Terms, 4> value;
    int count = 0;
    const std::array<Link, 2> near{walk(ahead), walk(behind)};
    for (const Link& link : near)
      if (link.back < 0 || isGuessed(w_.start(link.back))) return false;
    span = near[0].distance + near[1].distance;
    for (int side = 0; side < 2; ++side) {
      const int sign = side == 0 ? 1 : -1;
      if (!place(w_.start(near[side].back), value[count], depth)) return false;
      at[count++] = sign * near[side].distance;
      const Link far = beyond(near[side]);
      if (far.back < 0 || isGuessed(w_.start(far.back))) continue;
      if (far.distance > 3 * near[side].distance + 2 * span) continue;
      if (!place(w_.start(far.back), value[count], depth)) return false;
      at[count++] = sign * far.distance;
    }
    for (int k = 0; k < count; ++k) {
      double factor = 1;
      for (int other = 0; other < count; ++other)
        if (other != k) factor *= at[other] / (at[other] - at[k]);
      add(terms, value[k], factor);
    }
    return true;
  }

  // How a crossing follows from what stands beside it on its lines: those that are shorter count
  // more.
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
    std::array<Terms, 2> terms;
    std::array<Index, 2> span{};
    const int lines = star.closed ? 2 : star.sectors.size() == 2 ? 1 : 0;
    for (int line = 0; line < lines; ++line) {
      const HalfArc ahead = star.arms[line], behind = star.arms[line + 2];
      if (!between(ahead, behind, terms[line], span[line])) {
        span[line] = 0;
        continue;
      }
      for (int side = 0; side < 2; ++side) {
        const Link link = walk(side ? behind : ahead);
        const Index node = w_.start(link.back);
        if (isSite(node)) g.beside[2 * line + side] = siteOf_[node];
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
      if (span[line] > 0) add(g.terms, terms[line], weight[line] / sum);
    return g;
  }

  // Only nodes that stand on lines through them can be taken out.
  bool isRemovable(const Candidate& c) const {
    if (!c.alive || c_.kinds[c.site.node] != NodeKind::crossing) return false;
    const Star& star = c_.stars[c.site.node];
    return star.closed ? star.arms.size() == 4 : star.sectors.size() == 2;
  }

  void takeOut() {
    std::vector<char> blocked(all_.size(), 0);
    Index longest = 2;
    for (const Link& link : links_) longest = std::max(longest, link.distance);
    longest = std::min<Index>(longest, 1 << 12) * 8;
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
    if (blocked[s] || !isRemovable(all_[s]) || (image >= 0 && image < s)) return false;
    const Guess own = guess(all_[s]);
    if (own.span == 0 || own.span > most) return false;
    if (image < 0 || image == s) {
      remove(s, own, blocked);
      return true;
    }
    if (blocked[image] || !isRemovable(all_[image])) return false;
    const Guess other = guess(all_[image]);
    if (other.span != own.span) return false;
    remove(image, other, blocked);
    remove(s, own, blocked);
    return true;
  }

  void remove(Index s, const Guess& g, std::vector<char>& blocked) {
    Candidate& c = all_[s];
    c.terms = g.terms;
    c.site.span = g.span;
    c.alive = false;
    for (const Index b : g.beside)
      if (b >= 0) blocked[b] = 1;
    double most = 0;  // the parent counts most
    for (const Term& t : g.terms)
      if (std::abs(t.factor) > most + 1e-9) {
        most = std::abs(t.factor);
        c.site.parent = siteOfVector(t.vector);
      }
    order_.push_back(s);
  }

  Index siteOfVector(Index vector) const { return siteOf_[surface_.stored(vector).node]; }

  // What is left is predicted from its neighbours among what is left, in the order in which it is
  // reached from the first; mirror images together.
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
      if (!all_[s].alive) continue;
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

  std::vector<std::array<Index, 2>> around(Index s) const {
    std::vector<std::array<Index, 2>> result;
    const auto visit = [&](Index node) {
      for (const HalfArc arm : c_.stars[node].arms) {
        if (w_.arcs[arcOf(arm)].collapsed) continue;
        const Link link = walk(arm);
        if (link.back < 0) continue;
        const Index end = w_.start(link.back);
        if (isSite(end) && siteOf_[end] != s) result.push_back({siteOf_[end], link.distance});
      }
    };
    if (!all_[s].hub) {
      visit(all_[s].site.node);
      return result;
    }
    if (hubNodes_.empty()) {
      hubNodes_.resize(all_.size());
      for (std::size_t n = 0; n < w_.nodes.size(); ++n)
        if (isSite(static_cast<Index>(n))) hubNodes_[siteOf_[n]].push_back(static_cast<Index>(n));
    }
    for (const Index node : hubNodes_[s]) visit(node);
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

  // Numbers sites in coding order and writes the steps of their positions.
  void arrange() {
    std::vector<Index> rank(all_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) rank[order_[k]] = static_cast<Index>(k);
    for (const Index s : order_) {
      CodedSite site = all_[s].site;
      site.parent = site.parent < 0 ? -1 : rank[site.parent];
      site.mirror = all_[s].image < 0 ? -1 : rank[all_[s].image];
      if (site.parent >= 0) out_.sites_[site.parent].leaf = false;
      out_.sites_.push_back(site);
      addStep(site.first, all_[s].terms);
    }
    for (Index& s : siteOf_)
      if (s >= 0) s = rank[s];
    for (Candidate& c : all_) c.alive = true;  // from now on all positions are known
  }

  void addStep(Index vector, const Terms& terms) {
    Hierarchy::Step step;
    step.vector = vector;
    step.site = siteOf_[surface_.stored(vector).node];
    step.terms = static_cast<Index>(out_.terms_.size());
    for (const Term& t : terms)
      if (t.factor != 0) out_.terms_.push_back(t);
    step.termsEnd = static_cast<Index>(out_.terms_.size());
    step.reach = rounded(reach_[vector]);
    out_.steps_.push_back(step);
  }

  // ---- Derivatives ----

  void addDerivatives(int order) {
    for (std::size_t k = 0; k < out_.sites_.size(); ++k) {
      const CodedSite site = out_.sites_[k];
      for (Index v = site.first; v < site.first + site.count; ++v) {
        const StoredVector& s = surface_.stored(v);
        if (std::min(2, s.i + s.j) != order) continue;
        Terms terms;
        if (c_.kinds[site.node] == NodeKind::irregular)
          atHub(site, s, terms);
        else if (c_.kinds[site.node] == NodeKind::crossing)
          atCrossing(site, s, terms);
        addStep(v, terms);
      }
    }
  }

  // The stored derivative of a node, or -1.
  Index derivative(Index node, int i, int j) const {
    const CodedSite& site = out_.sites_[siteOf_[node]];
    for (Index v = site.first; v < site.first + site.count; ++v)
      if (surface_.stored(v).i == i && surface_.stored(v).j == j) return v;
    return -1;
  }

  struct Neighbour {
    bool has = false;
    double distance = 0;
    Index node = -1;
    HalfArc back = -1;
    Terms value;
  };
  Neighbour neighbour(Index node, int arm) const {
    Neighbour n;
    const Star& star = c_.stars[node];
    if (arm >= static_cast<int>(star.arms.size())) return n;
    const Rail& rail = c_.rails[star.arms[arm]];
    n.distance = rail.edges;
    n.back = twin(rail.last);
    n.node = w_.start(n.back);
    n.has = placeAll(n.node, n.value);
    return n;
  }
  // As place(), with all sites known.
  bool placeAll(Index node, Terms& terms) const {
    if (isSite(node)) {
      terms.push_back({out_.sites_[siteOf_[node]].first, 1});
      return true;
    }
    const Star& star = c_.stars[node];
    const auto straight = std::ranges::find(star.sectors, kStraight) - star.sectors.begin();
    const Rail &a = c_.rails[star.arms[(straight + 1) % 3]], &b = c_.rails[star.arms[straight]];
    const Index to = w_.end(a.last), from = w_.end(b.last);
    if (!isSite(to) || !isSite(from)) return false;
    const double length = a.edges + b.edges;
    // Hermite's cubic where both ends know their slopes along the line, else a straight one.
    const double t = b.edges / length;
    Terms slopeTo, slopeFrom;
    if (slope(to, twin(a.last), slopeTo) && slope(from, twin(b.last), slopeFrom)) {
      const double s = 1 - t;
      terms.push_back({out_.sites_[siteOf_[from]].first, s * s * (1 + 2 * t)});
      terms.push_back({out_.sites_[siteOf_[to]].first, t * t * (1 + 2 * s)});
      add(terms, slopeFrom, t * s * s * length);
      add(terms, slopeTo, s * t * t * length);
    } else {
      terms.push_back({out_.sites_[siteOf_[from]].first, 1 - t});
      terms.push_back({out_.sites_[siteOf_[to]].first, t});
    }
    return true;
  }

  // The slope along a half-arc that leaves a node: by the parabola through the node and its
  // neighbours, both sites.
  bool slope(Index node, HalfArc h, Terms& terms) const {
    if (c_.kinds[node] != NodeKind::crossing) return false;
    const HalfArc back = oppositeOf(h);
    if (back < 0) return false;
    const Rail &ahead = c_.rails[h], &behind = c_.rails[back];
    if (!isSite(w_.end(ahead.last)) || !isSite(w_.end(behind.last))) return false;
    const double a = ahead.edges, b = behind.edges, s = 1 / (a * b * (a + b));
    terms.push_back({position(w_.end(ahead.last), 0), b * b * s});
    terms.push_back({position(w_.end(behind.last), 0), -a * a * s});
    terms.push_back({position(node, 0), (a * a - b * b) * s});
    return true;
  }
  Index position(Index node, int) const { return out_.sites_[siteOf_[node]].first; }

  void atCrossing(const CodedSite& site, const StoredVector& s, Terms& terms) const {
    const Index node = site.node;
    const std::array<std::array<Neighbour, 2>, 2> at{
        std::array{neighbour(node, 0), neighbour(node, 2)},
        std::array{neighbour(node, 1), neighbour(node, 3)}};
    const int d = s.i > 0 ? 0 : 1;
    if (s.i + s.j == 1)
      along(at[d], site.first, -1, 1, terms);
    else if (s.i == 1 && s.j == 1)
      mixed(node, at, terms);
    else if (std::max(s.i, s.j) == 2 && std::min(s.i, s.j) == 0)
      along(at[d], site.first, derivative(node, d == 0, d == 1), 2, terms);
  }

  // Derivative 1 or 2 of the polynomial through the neighbours on a line and what the node knows.
  void along(const std::array<Neighbour, 2>& at, Index own, Index slope, int order,
             Terms& terms) const {
    if (slope >= 0) {
      for (int e = 0; e < 2; ++e) {
        if (!at[e].has) continue;
        const double h = at[e].distance, outward = e == 0 ? 1 : -1;
        const double weight = at[1 - e].has ? at[1 - e].distance / (h + at[1 - e].distance) : 1;
        const double s = 2 * weight / (h * h);
        add(terms, at[e].value, s);
        terms.push_back({own, -s});
        terms.push_back({slope, -outward * h * s});
      }
      return;
    }
    if (!at[0].has || !at[1].has) {
      if (order == 1)
        for (int e = 0; e < 2; ++e)
          if (at[e].has) {
            const double s = (e == 0 ? 1 : -1) / at[e].distance;
            add(terms, at[e].value, s);
            terms.push_back({own, -s});
          }
      return;
    }
    const double a = at[0].distance, b = at[1].distance;
    const double s = (order == 1 ? 1 : 2) / (a * b * (a + b));
    add(terms, at[0].value, order == 1 ? b * b * s : b * s);
    add(terms, at[1].value, order == 1 ? -a * a * s : a * s);
    terms.push_back({own, order == 1 ? (a * a - b * b) * s : -(a + b) * s});
  }

  // ∂x∂y: how the slope along x changes from neighbour to neighbour along y, and the other way
  // round; the mean where both are known.
  void mixed(Index node, const std::array<std::array<Neighbour, 2>, 2>& at, Terms& terms) const {
    std::array<Terms, 2> change;
    int known = 0;
    for (int d = 0; d < 2; ++d) known += changeAcross(node, at[1 - d], d, change[d]);
    for (const Terms& t : change) add(terms, t, 1.0 / std::max(1, known));
  }

  // How the slope along axis d changes along the other one.
  bool changeAcross(Index node, const std::array<Neighbour, 2>& at, int d, Terms& terms) const {
    const Index own = derivative(node, d == 0, d == 1);
    if (own < 0) return false;
    std::array<Terms, 2> across;
    std::array<bool, 2> has{};
    for (int e = 0; e < 2; ++e)
      has[e] =
          at[e].has && isSite(at[e].node) && slopeAcross(at[e], (d == 0) == (e == 0), across[e]);
    if (has[0] && has[1]) {
      const double a = at[0].distance, b = at[1].distance, s = 1 / (a * b * (a + b));
      add(terms, across[0], b * b * s);
      add(terms, across[1], -a * a * s);
      terms.push_back({own, (a * a - b * b) * s});
      return true;
    }
    for (int e = 0; e < 2; ++e)
      if (has[e]) {
        const double s = (e == 0 ? 1 : -1) / at[e].distance;
        add(terms, across[e], s);
        terms.push_back({own, -s});
        return true;
      }
    return false;
  }

  // The slope at a neighbour to the right of travel, or to the left of it.
  bool slopeAcross(const Neighbour& n, bool right, Terms& terms) const {
    if (c_.kinds[n.node] != NodeKind::crossing || !c_.stars[n.node].closed) return false;
    const auto& arms = c_.stars[n.node].arms;
    if (arms.size() != 4) return false;
    const auto back = std::ranges::find(arms, n.back) - arms.begin();
    // `back` points against travel; the arm after it, counter-clockwise, points to the right.
    const int arm = static_cast<int>(back + (right ? 1 : 3)) % 4;
    const Index stored = derivative(n.node, arm % 2 == 0, arm % 2 == 1);
    if (stored >= 0) {
      terms.push_back({stored, arm < 2 ? 1.0 : -1.0});
      return true;
    }
    return slope(n.node, arms[arm], terms);
  }

  // First derivatives at an irregular point: least squares over the slopes of its spokes, which are
  // combinations of A and B.
  void atHub(const CodedSite& site, const StoredVector& s, Terms& terms) const {
    if (s.i + s.j != 1) return;
    double xx = 0, xy = 0, yy = 0;
    Terms x, y;
    for (const auto& [node, arm] : spokes(site)) {
      const HalfArc h = c_.stars[node].arms[arm];
      const Neighbour n = neighbour(node, arm);
      if (!n.has) continue;
      double a = 0, b = 0;
      for (const Term& t : surface_.derivation(surface_.alongJet(h, 1).vector)) {
        const double rounded = std::round(t.factor * 1048576) / 1048576;
        if (t.vector == site.first + 1) a = rounded;
        if (t.vector == site.first + 2) b = rounded;
      }
      xx += a * a, xy += a * b, yy += b * b;
      const double out = 1 / n.distance;
      add(x, n.value, a * out), x.push_back({site.first, -a * out});
      add(y, n.value, b * out), y.push_back({site.first, -b * out});
    }
    const double d = xx * yy - xy * xy;
    if (!(d > 1e-3)) return;
    add(terms, x, (s.i == 1 ? yy : -xy) / d);
    add(terms, y, (s.i == 1 ? -xy : xx) / d);
  }

  std::vector<std::pair<Index, int>> spokes(const CodedSite& site) const {
    std::vector<std::pair<Index, int>> result;
    const Index point = w_.nodes[site.node].point;
    const auto visit = [&](Index node) {
      const auto& arms = c_.stars[node].arms;
      for (int arm = 0; arm < static_cast<int>(arms.size()); ++arm)
        if (!w_.arcs[arcOf(arms[arm])].collapsed) result.emplace_back(node, arm);
    };
    if (hubOfPoint_.empty()) {
      hubOfPoint_.resize(w_.points);
      for (std::size_t n = 0; n < w_.nodes.size(); ++n)
        if (w_.nodes[n].point >= 0) hubOfPoint_[w_.nodes[n].point].push_back(static_cast<Index>(n));
    }
    for (const Index node : hubOfPoint_[point])
      if (c_.kinds[node] == NodeKind::irregular) visit(node);
    return result;
  }

  // ---- Mirror ----

  // Frames of mirrored nodes: their x axes are images of each other, or x is the image of y.
  void mirrorVectors() {
    out_.images_.resize(surface_.storedCount());
    for (const CodedSite& site : out_.sites_) {
      if (site.mirror < 0) continue;
      const CodedSite& other = out_.sites_[site.mirror];
      for (Index v = site.first; v < site.first + site.count; ++v) {
        const StoredVector& s = surface_.stored(v);
        out_.images_[v] = imageOf(site, other, s.i, s.j);
      }
    }
  }

  Hierarchy::Image imageOf(const CodedSite& site, const CodedSite& other, int i, int j) const {
    if (i == 0 && j == 0) return {other.first, 1};
    const auto& arms = c_.stars[site.node].arms;
    const HalfArc x = mirror_.halfArc[arms[0]];
    const Index node = mirror_.node[site.node];
    if (x < 0) return {};
    const auto& there = c_.stars[node].arms;
    const auto arm = std::ranges::find(there, x) - there.begin();
    if (arm == static_cast<std::ptrdiff_t>(there.size())) return {};
    if (c_.kinds[site.node] == NodeKind::irregular) {
      // The chart turns with the first spoke: an image only where that is the image of the other's.
      if (arm != 0 || !c_.stars[site.node].closed) return {};
      const Index k = vectorAt(other, i, j);
      return {k, j % 2 ? -1 : 1};
    }
    // x becomes the direction of arm `arm` there, y the one a quarter turn clockwise from it.
    const auto axis = [&](std::ptrdiff_t a) {
      a = (a % 4 + 4) % 4;
      return std::pair<int, int>(static_cast<int>(a % 2), a < 2 ? 1 : -1);
    };
    const auto [xAxis, xSign] = axis(arm);
    const int yAxis = 1 - xAxis;
    const int ySign = axis(arm + 3).second;
    const int sign = (i % 2 ? xSign : 1) * (j % 2 ? ySign : 1);
    const Index v = vectorAt(other, xAxis == 0 ? i : j, xAxis == 0 ? j : i);
    (void)yAxis;
    return {v, sign};
  }

  Index vectorAt(const CodedSite& site, int i, int j) const {
    for (Index v = site.first; v < site.first + site.count; ++v)
      if (surface_.stored(v).i == i && surface_.stored(v).j == j) return v;
    return -1;
  }

  const Surface& surface_;
  const Wireframe& w_;
  const Connectivity& c_;
  const Mirror& mirror_;
  Hierarchy& out_;
  std::vector<Candidate> all_;
  std::vector<Index> siteOf_;  // [nodes]
  std::vector<Link> links_;    // [half-arcs]
  std::vector<Index> order_;
  std::vector<double> reach_;             // [vectors]
  Index guessed_ = -1, guessedToo_ = -1;  // nodes that may not predict themselves or each other
  mutable std::vector<std::vector<Index>> hubNodes_, hubOfPoint_;
  std::vector<char> placed_;  // [sites] roots that have their place in the order
};

Hierarchy::Hierarchy(const Surface& surface, const Mirror& mirror) {
  HierarchyBuilder(surface, mirror, *this).build();
}

}  // namespace sweepface::codec
