#include "fit/pose_quantiser.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

#include "fit/pose_cost.hpp"

namespace sweepface {

using codec::CodedSite;
using codec::Coefficients;
using codec::Hierarchy;
using codec::Lattice;
using codec::Prediction;
using codec::Symmetry;

namespace {

class PoseQuantiser {
  using Four = PoseCost::Four;

 public:
  PoseQuantiser(const Lattice& lattice, const Columns& columns, PoseTask task, Coefficients& q,
                const std::function<bool()>& goesOn)
      : h_(lattice.hierarchy()),
        steps_(h_.prediction().steps),
        columns_(columns),
        axis_(lattice.axis()),
        task_(std::move(task)),
        errors_(columns, task_),
        q_(q),
        goesOn_(goesOn) {
    siteOf_.resize(q.size());
    for (const Prediction::Step& step : steps_) siteOf_[step.vector] = step.site;
    count();
  }

  void run() {
    search(6);
    repair();
    // Repairs cost many bits, so sweeps follow once more.
    errors_.press(1);
    search(3);
    repair();
  }

 private:
  // Bits are expensive at first and become cheaper from sweep to sweep, so that a few coefficients
  // do what many small ones would otherwise have shared: annealing without chance.
  void search(double dearest) {
    constexpr int kCooling = 6, kSweeps = 8;
    touched_.assign(vertexCount(), -1);
    for (sweep_ = 0; sweep_ < kSweeps && goesOn_(); ++sweep_) {
      price_ = dearest + (1 - dearest) * std::min(1.0, static_cast<double>(sweep_) / kCooling);
      Index changed = 0;
      findWanted();
      for (std::size_t k = steps_.size(); k-- > 0;) changed += improve(steps_[k].vector);
      if (changed == 0 && sweep_ >= kCooling) break;
    }
  }

  // Coefficients that are zero are considered only where an error is well on its way to the bound
  // or the surface is tilted.
  void findWanted() {
    constexpr float kOnItsWay = 0.3f, kTilted = 0.3f;
    wanted_.assign(q_.size(), 0);
    for (Index u = 0; u < vertexCount(); ++u)
      if (errors_.square(u) > kOnItsWay || errors_.tilt(u) > kTilted)
        for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r)
          wanted_[columns_.rowVector[r]] = 1;
  }

  // At vertices that are still beyond their bounds, makes whatever move helps most, with bits
  // hardly counting. Gives up if they are many or do not become fewer: other steps are needed then.
  void repair() {
    errors_.press(100);
    constexpr int kRounds = 40;
    Index most = vertexCount() / 50;
    for (int round = 0; round < kRounds && goesOn_(); ++round) {
      Index bad = 0, changed = 0;
      for (Index u = 0; u < vertexCount(); ++u) bad += errors_.square(u) > 1;
      if (bad == 0 || bad > most) return;
      most = bad - 1 - bad / 8;
      for (Index u = 0; u < vertexCount(); ++u)
        if (errors_.square(u) > 1) changed += repairAt(u);
      if (changed == 0) return;
    }
  }

  struct Move {
    float merit = 0;
    Index vector = -1;
    int axis = 0, by = 0;
    double cost = 0;
  };

  // Of the moves that bring the vertex itself nearer, tries those that move few others. If none
  // helps by itself, tries each together with the move that helps most where it did harm.
  bool repairAt(Index u) {
    constexpr double kHelps = -1e-3;
    std::vector<Move> moves = movesAt(u);
    if (const Move* best = cheapest(moves); best != nullptr && best->cost < kHelps) {
      change(best->vector, best->axis, best->by);
      return true;
    }
    for (const Move& m : moves) {
      change(m.vector, m.axis, m.by);
      std::vector<Move> next = movesAt(worstAround(m.vector));
      if (const Move* best = cheapest(next); best != nullptr && m.cost + best->cost < kHelps) {
        change(best->vector, best->axis, best->by);
        return true;
      }
      change(m.vector, m.axis, -m.by);
    }
    return false;
  }

  const Move* cheapest(std::vector<Move>& moves) const {
    const Move* best = nullptr;
    for (Move& m : moves) {
      const std::int32_t before = q_[m.vector][m.axis] - expected(m.vector, m.axis);
      m.cost = bits(m.vector, before, before + m.by) +
               errors_.growth(m.vector, m.axis, static_cast<float>(m.by));
      if (const auto image = follower(m.vector); image.vector >= 0)
        m.cost +=
            errors_.growth(image.vector, m.axis, static_cast<float>(signFor(image, m.axis) * m.by));
      if (best == nullptr || m.cost < best->cost) best = &m;
    }
    return best;
  }

  // Of the vertices that a coefficient moves, the one furthest off.
  Index worstAround(Index v) const {
    Index worst = columns_.vertex[columns_.start[v]];
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p)
      if (errors_.square(columns_.vertex[p]) > errors_.square(worst)) worst = columns_.vertex[p];
    return worst;
  }

  std::vector<Move> movesAt(Index u) const {
    constexpr std::size_t kMost = 24;
    constexpr float kWorthIt = 0.01f;
    const auto step = static_cast<float>(task_.step);
    std::vector<Move> moves;
    for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r) {
      const Index v = columns_.rowVector[r];
      const auto reaches = static_cast<float>(columns_.length(v));
      for (int a = 0; a < 3; ++a)
        for (const int by : {-2, -1, 1, 2}) {
          const float nearer =
              errors_.nearer(u, a, static_cast<float>(by) * step * columns_.rowWeight[r]);
          if (nearer > kWorthIt) moves.push_back({nearer / (10 + reaches), v, a, by});
        }
    }
    const std::size_t kept = std::min(kMost, moves.size());
    std::ranges::partial_sort(moves, moves.begin() + static_cast<std::ptrdiff_t>(kept),
                              [](const Move& a, const Move& b) {
                                return std::tie(b.merit, a.vector, a.axis, a.by) <
                                       std::tie(a.merit, b.vector, b.axis, b.by);
                              });
    moves.resize(kept);
    return moves;
  }

  // Moves a coefficient and the one that follows it.
  void change(Index v, int a, std::int32_t d) {
    const std::int32_t before = q_[v][a] - expected(v, a);
    const Hierarchy::Image image = follower(v);
    move(v, a, d);
    if (image.vector >= 0) move(image.vector, a, signFor(image, a) * d);
    const int more = (before + d != 0) - (before != 0);
    inSite_[siteOf_[v]] += more;
    inVector_[v] += more;
  }

  // The vector that changes along with another, if any, and the sign for a coordinate.
  Hierarchy::Image follower(Index v) const {
    const CodedSite& site = h_.sites()[siteOf_[v]];
    if (task_.symmetry != Symmetry::self || site.mirror <= siteOf_[v]) return {-1, 1};
    const Hierarchy::Image image = h_.images()[v];
    if (image.vector < 0 || h_.images()[image.vector].vector != v) return {-1, 1};
    return image;
  }
  int signFor(const Hierarchy::Image& image, int a) const {
    return a == axis_ ? -image.sign : image.sign;
  }
  std::int32_t expected(Index v, int a) const {
    if (task_.symmetry == Symmetry::none) return 0;
    const Index site = siteOf_[v], mirror = h_.sites()[site].mirror;
    if (task_.symmetry == Symmetry::partner) return mirror < 0 ? 0 : task_.expected[v][a];
    const Hierarchy::Image& image = h_.images()[v];
    if (mirror < 0 || mirror >= site || image.vector < 0) return 0;
    return signFor(image, a) * q_[image.vector][a];
  }

  void count() {
    const std::size_t vectors = q_.size();
    inSite_.assign(h_.sites().size(), 0);
    inVector_.assign(vectors, 0);
    for (Index v = 0; v < static_cast<Index>(vectors); ++v)
      for (int a = 0; a < 3; ++a)
        if (q_[v][a] != expected(v, a)) ++inSite_[siteOf_[v]], ++inVector_[v];
  }

  // About how many bits the first coefficient in a site takes: the more of the positions that
  // predict the site move, the fewer.
  double siteBits(Index site) const {
    constexpr std::array<double, 5> kBits{8, 6, 5, 4.5, 4};
    std::size_t moved = 0;
    for (const Term& t : h_.beside(site)) moved += inVector_[t.vector] > 0;
    return kBits[std::min(moved, kBits.size() - 1)];
  }

  // About how many bits a coefficient takes. The first one in a site or a vector also pays for the
  // information that there is one.
  static double magnitude(std::int32_t d) {
    d = std::abs(d);
    return d == 0 ? 0 : 1.2 + 1.7 * std::log2(static_cast<double>(d)) + (d > 1 ? 0.3 : 0);
  }
  double bits(Index v, std::int32_t before, std::int32_t after) const {
    const bool had = before != 0, has = after != 0;
    double sum = magnitude(after) - magnitude(before);
    if (had == has) return price_ * sum;
    const double opening = 0.6 + (inSite_[siteOf_[v]] - had == 0 ? siteBits(siteOf_[v]) : 0) +
                           (inVector_[v] - had == 0 ? 3 : 0);
    return price_ * (sum + (has ? opening : -opening));
  }

  void move(Index v, int a, std::int32_t d) {
    q_[v][a] += d;
    errors_.move(v, a, static_cast<float>(d));
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p)
      touched_[columns_.vertex[p]] = sweep_;
  }

  // Whether any vertex that a coefficient affects has moved in this sweep or the last.
  bool isTouched(Index v) const {
    if (sweep_ == 0) return true;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p)
      if (touched_[columns_.vertex[p]] >= sweep_ - 1) return true;
    return false;
  }

  // Returns how many coordinates of a coefficient changed.
  int improve(Index v) {
    if (!task_.frozen.empty() && task_.frozen[v]) return 0;
    const Hierarchy::Image image = follower(v);
    if (!isTouched(v) && (image.vector < 0 || !isTouched(image.vector))) return 0;
    int changed = 0;
    std::optional<Four> gradient;  // valid until something changes
    for (int a = 0; a < 3; ++a) {
      const std::int32_t before = q_[v][a] - expected(v, a);
      const std::int32_t best =
          before != 0 ? better(v, a, image, before) : opened(v, a, image, gradient);
      if (best == before) continue;
      change(v, a, best - before);
      gradient.reset();
      ++changed;
    }
    return changed;
  }

  // The best value for a coordinate that is not zero: itself, a step nearer to or further from
  // zero, or zero.
  std::int32_t better(Index v, int a, const Hierarchy::Image& image, std::int32_t before) const {
    const int out = before > 0 ? 1 : -1;
    std::array<std::int32_t, 3> tries{before - out, before + out};
    int count = 2;
    if (std::abs(before) > 1) tries = {before - out, 0, before + out}, count = 3;
    return best(v, a, image, before, std::span(tries).first(count));
  }

  // The same for one that is zero.
  std::int32_t opened(Index v, int a, const Hierarchy::Image& image,
                      std::optional<Four>& gradient) const {
    if (!wanted_[v] && (image.vector < 0 || !wanted_[image.vector])) return 0;
    if (!gradient) {
      gradient = errors_.gradient(v);
      if (image.vector >= 0) {
        const Four its = errors_.gradient(image.vector);
        for (int k = 0; k < 3; ++k)
          (*gradient)[k] += static_cast<float>(signFor(image, k)) * its[k];
      }
    }
    // A convex cost grows by no less than its slope.
    const float g = (*gradient)[a];
    const std::int32_t towards = g > 0 ? -1 : 1;
    if (std::abs(g) < bits(v, 0, towards)) return 0;
    return best(v, a, image, 0, std::array{towards});
  }

  std::int32_t best(Index v, int a, const Hierarchy::Image& image, std::int32_t before,
                    std::span<const std::int32_t> tries) const {
    Four by = {};
    for (std::size_t k = 0; k < tries.size(); ++k) by[k] = static_cast<float>(tries[k] - before);
    Four growth = errors_.growth(v, a, by);
    if (image.vector >= 0)
      growth += errors_.growth(image.vector, a, static_cast<float>(signFor(image, a)) * by);
    double least = -1e-3;
    std::int32_t best = before;
    for (std::size_t k = 0; k < tries.size(); ++k)
      if (const double cost = bits(v, before, tries[k]) + growth[k]; cost < least)
        least = cost, best = tries[k];
    return best;
  }

  Index vertexCount() const { return errors_.vertexCount(); }

  const Hierarchy& h_;
  const std::vector<Prediction::Step>& steps_;
  const Columns& columns_;
  int axis_;
  PoseTask task_;
  PoseCost errors_;
  Coefficients& q_;
  const std::function<bool()>& goesOn_;
  std::vector<Index> siteOf_;           // [S]
  std::vector<int> inSite_, inVector_;  // coefficients that are not as expected
  std::vector<char> wanted_;            // [S]
  std::vector<int> touched_;            // [vertices] the sweep in which it moved last
  int sweep_ = 0;
  double price_ = 1;  // of a bit
};

}  // namespace

void quantisePose(const Lattice& lattice, const Columns& columns, PoseTask task, Coefficients& q,
                  const std::function<bool()>& goesOn) {
  PoseQuantiser(lattice, columns, std::move(task), q, goesOn).run();
}

}  // namespace sweepface
