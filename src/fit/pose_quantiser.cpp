#include "fit/pose_quantiser.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sweepface {

using codec::CodedSite;
using codec::Coefficients;
using codec::Hierarchy;
using codec::Lattice;
using codec::Prediction;
using codec::Symmetry;

namespace {

class PoseQuantiser {
 public:
  PoseQuantiser(const Lattice& lattice, const Columns& columns, PoseTask task, Coefficients& q)
      : h_(lattice.hierarchy()),
        steps_(h_.prediction().steps),
        columns_(columns),
        axis_(lattice.axis()),
        task_(std::move(task)),
        step_(static_cast<float>(task_.step)),
        q_(q),
        touched_(task_.errors.size(), 0) {
    siteOf_.resize(q.size());
    for (const Prediction::Step& step : steps_) siteOf_[step.vector] = step.site;
    for (int a = 0; a < 3; ++a)
      for (const Vec3& e : task_.errors)
        error_[a].push_back(static_cast<float>(a == 0 ? e.x : a == 1 ? e.y : e.z));
    for (const float bound : task_.bounds) perSquare_.push_back(1 / (bound * bound));
    count();
  }

  void run() {
    constexpr int kSweeps = 10;
    for (sweep_ = 0; sweep_ < kSweeps; ++sweep_) {
      Index changed = 0;
      findWanted();
      for (std::size_t k = steps_.size(); k-- > 0;)
        for (int a = 0; a < 3; ++a) changed += improve(steps_[k].vector, a);
      if (changed == 0) break;
    }
    repair();
  }

 private:
  // Coefficients that are zero may be wanted only where an error is well on its way to the bound or
  // the surface is tilted.
  void findWanted() {
    constexpr float kOnItsWay = 0.3f, kTilted = 0.3f;
    wanted_.assign(q_.size(), 0);
    for (Index u = 0; u < vertexCount(); ++u)
      if (squareAt(u) > kOnItsWay || tilt(u) > kTilted)
        for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r)
          wanted_[columns_.rowVector[r]] = 1;
  }

  // Vertices that are still beyond their bounds: whatever move helps most there, bits hardly
  // counting. Given up where they are many or do not become fewer: other steps must do.
  void repair() {
    beyond_ = 100 * kBeyond;
    constexpr int kRounds = 40;
    Index most = vertexCount() / 50;
    for (int round = 0; round < kRounds; ++round) {
      Index bad = 0, changed = 0;
      for (Index u = 0; u < vertexCount(); ++u) bad += squareAt(u) > 1;
      if (bad == 0 || bad > most) return;
      most = bad - 1 - bad / 8;
      for (Index u = 0; u < vertexCount(); ++u)
        if (squareAt(u) > 1) changed += repairAt(u);
      if (changed == 0) return;
    }
  }

  // Of the moves that bring the vertex itself nearer, those are tried that move few others.
  bool repairAt(Index u) {
    gatherMoves(u);
    double least = -1e-3;
    const Move* best = nullptr;
    for (const Move& m : moves_) {
      const std::int32_t before = q_[m.vector][m.axis] - expected(m.vector, m.axis);
      double cost = bits(m.vector, before, before + m.by) +
                    growth(m.vector, m.axis, static_cast<float>(m.by));
      if (const auto image = follower(m.vector); image.vector >= 0)
        cost += growth(image.vector, m.axis, static_cast<float>(signFor(image, m.axis) * m.by));
      if (cost < least) least = cost, best = &m;
    }
    if (best == nullptr) return false;
    change(best->vector, best->axis, best->by);
    return true;
  }

  struct Move {
    float merit = 0;
    Index vector = -1;
    int axis = 0, by = 0;
  };
  void gatherMoves(Index u) {
    constexpr std::size_t kMost = 24;
    constexpr float kWorthIt = 0.01f;
    moves_.clear();
    for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r) {
      const Index v = columns_.rowVector[r];
      const auto reaches = static_cast<float>(columns_.length(v));
      for (int a = 0; a < 3; ++a)
        for (const int by : {-2, -1, 1, 2}) {
          const float shift = static_cast<float>(by) * step_ * columns_.rowWeight[r];
          const float nearer = -(2 * error_[a][u] + shift) * shift * perSquare_[u];
          if (nearer > kWorthIt) moves_.push_back({nearer / (10 + reaches), v, a, by});
        }
    }
    const std::size_t kept = std::min(kMost, moves_.size());
    std::ranges::partial_sort(moves_, moves_.begin() + static_cast<std::ptrdiff_t>(kept),
                              [](const Move& a, const Move& b) {
                                return std::tie(b.merit, a.vector, a.axis, a.by) <
                                       std::tie(a.merit, b.vector, b.axis, b.by);
                              });
    moves_.resize(kept);
  }

  // Moves a coefficient and what follows it.
  void change(Index v, int a, std::int32_t d) {
    const std::int32_t before = q_[v][a] - expected(v, a);
    const Hierarchy::Image image = follower(v);
    move(v, a, d);
    if (image.vector >= 0) move(image.vector, a, signFor(image, a) * d);
    const int more = (before + d != 0) - (before != 0);
    inSite_[siteOf_[v]] += more;
    inVector_[v] += more;
  }

  // A penalty in bits: hardly any well within the bound, steep beyond it.
  static constexpr float kInside = 2, kBeyond = 400;
  float penalty(float square) const {
    const float s2 = square * square;
    return kInside * s2 * s2 * square + (square > 1 ? beyond_ * (square - 1) : 0);
  }
  float slope(float square) const {
    const float s2 = square * square;
    return 5 * kInside * s2 * s2 + (square > 1 ? beyond_ : 0);
  }

  // Which vector follows by itself when one changes, and the sign for a coordinate.
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

  // About how many bits a first coefficient in a site takes: the fewer, the more of what predicts
  // the site moves.
  double siteBits(Index site) const {
    constexpr std::array<double, 5> kBits{8, 6, 5, 4.5, 4};
    std::size_t moved = 0;
    for (const Term& t : h_.beside(site)) moved += inVector_[t.vector] > 0;
    return kBits[std::min(moved, kBits.size() - 1)];
  }

  // About how many bits a coefficient takes: a first one in a site or a vector also pays for
  // saying that there is one.
  static double magnitude(std::int32_t d) {
    d = std::abs(d);
    return d == 0 ? 0 : 1.2 + 1.7 * std::log2(static_cast<double>(d)) + (d > 1 ? 0.3 : 0);
  }
  double bits(Index v, std::int32_t before, std::int32_t after) const {
    const bool had = before != 0, has = after != 0;
    double sum = magnitude(after) - magnitude(before);
    if (had == has) return sum;
    const double opening = 0.6 + (inSite_[siteOf_[v]] - had == 0 ? siteBits(siteOf_[v]) : 0) +
                           (inVector_[v] - had == 0 ? 3 : 0);
    return sum + (has ? opening : -opening);
  }

  float squareAt(Index u) const {
    return (error_[0][u] * error_[0][u] + error_[1][u] * error_[1][u] +
            error_[2][u] * error_[2][u]) *
           perSquare_[u];
  }
  // A tangent that is off by about half of its length may turn the surface over.
  static constexpr float kMostStrain = 0.2f, kTorn = 4, kOverturn = 40;
  static float overturn(float strain) {
    return strain > kMostStrain ? kOverturn * (std::min(strain, kTorn) - kMostStrain) : 0;
  }
  float tilt(Index u) const {
    float sum = 0;
    for (const Slopes::Tangent& t : task_.slopes.at[u])
      sum += task_.slopes.weight * t.lean * t.lean + overturn(t.strain());
    return sum;
  }
  // How much the penalty grows when a coefficient grows by d steps.
  float growth(Index v, int a, float steps) const {
    const float x = steps * step_;
    const float* own = error_[a].data();
    float sum = 0, tilted = 0, over = 0;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
      const Index u = columns_.vertex[p];
      const auto& weight = columns_.weight[p];
      const float square = squareAt(u), shift = x * weight[0];
      sum += penalty(square + (2 * own[u] + shift) * shift * perSquare_[u]) - penalty(square);
      for (int side = 0; side < 2; ++side) {
        const Slopes::Tangent& t = task_.slopes.at[u][side];
        const float change = x * weight[1 + side] * t.perLength, turn = change * t.normal[a];
        tilted += (2 * t.lean + turn) * turn;
        const float strain = t.strain();
        over += overturn(strain + (2 * t.error[a] + change) * change) - overturn(strain);
      }
    }
    return sum + task_.slopes.weight * tilted + over;
  }
  float gradient(Index v, int a) const {
    float sum = 0, tilted = 0, over = 0;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
      const Index u = columns_.vertex[p];
      const auto& weight = columns_.weight[p];
      sum += slope(squareAt(u)) * error_[a][u] * weight[0] * perSquare_[u];
      for (int side = 0; side < 2; ++side) {
        const Slopes::Tangent& t = task_.slopes.at[u][side];
        const float change = weight[1 + side] * t.perLength;
        tilted += change * t.lean * t.normal[a];
        if (const float s = t.strain(); s > kMostStrain && s < kTorn) over += change * t.error[a];
      }
    }
    return 2 * (sum + task_.slopes.weight * tilted + kOverturn * over) * step_;
  }
  void move(Index v, int a, std::int32_t d) {
    q_[v][a] += d;
    const float x = static_cast<float>(d) * step_;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
      const Index u = columns_.vertex[p];
      const auto& weight = columns_.weight[p];
      error_[a][u] += x * weight[0];
      touched_[u] = sweep_;
      for (int side = 0; side < 2; ++side) {
        Slopes::Tangent& t = task_.slopes.at[u][side];
        const float change = x * weight[1 + side] * t.perLength;
        t.error[a] += change;
        t.lean += change * t.normal[a];
      }
    }
  }

  // Whether anything that a coefficient moves has moved in this sweep or the last.
  bool isTouched(Index v) const {
    if (sweep_ == 0) return true;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p)
      if (touched_[columns_.vertex[p]] >= sweep_ - 1) return true;
    return false;
  }

  bool improve(Index v, int a) {
    if (!task_.frozen.empty() && task_.frozen[v]) return false;
    const Hierarchy::Image image = follower(v);
    const int sign = signFor(image, a);
    if (!isTouched(v) && (image.vector < 0 || !isTouched(image.vector))) return false;
    const std::int32_t before = q_[v][a] - expected(v, a);
    std::array<std::int32_t, 3> tries{};
    int count = 0;
    if (before != 0) {
      const int out = before > 0 ? 1 : -1;
      tries[count++] = before - out;
      if (std::abs(before) > 1) tries[count++] = 0;
      tries[count++] = before + out;
    } else {
      if (!wanted_[v] && (image.vector < 0 || !wanted_[image.vector])) return false;
      float g = gradient(v, a);
      if (image.vector >= 0) g += static_cast<float>(sign) * gradient(image.vector, a);
      if (std::abs(g) < 1) return false;
      tries[count++] = g > 0 ? -1 : 1;
    }
    double least = -1e-3;
    std::int32_t best = before;
    for (int k = 0; k < count; ++k) {
      const std::int32_t d = tries[k] - before;
      double cost = bits(v, before, tries[k]) + growth(v, a, static_cast<float>(d));
      if (image.vector >= 0) cost += growth(image.vector, a, static_cast<float>(sign * d));
      if (cost < least) least = cost, best = tries[k];
    }
    if (best == before) return false;
    change(v, a, best - before);
    return true;
  }

  Index vertexCount() const { return static_cast<Index>(perSquare_.size()); }

  const Hierarchy& h_;
  const std::vector<Prediction::Step>& steps_;
  const Columns& columns_;
  int axis_;
  PoseTask task_;
  float step_;
  Coefficients& q_;
  std::vector<Index> siteOf_;     // [S]
  std::vector<float> perSquare_;  // [vertices] 1 / bound²
  std::array<std::vector<float>, 3> error_;
  std::vector<int> inSite_, inVector_;  // coefficients that are not zero
  std::vector<char> wanted_;            // [S]
  std::vector<int> touched_;            // [vertices] the sweep in which it moved last
  std::vector<Move> moves_;
  int sweep_ = 0;
  float beyond_ = kBeyond;
};

}  // namespace

void quantisePose(const Lattice& lattice, const Columns& columns, PoseTask task, Coefficients& q) {
  PoseQuantiser(lattice, columns, std::move(task), q).run();
}

}  // namespace sweepface
