#include "fit/quantise.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>
#include <tbb/parallel_for.h>

#include "sweepface/eval.hpp"

#include "codec/lattice.hpp"
#include "surface/terms.hpp"

namespace sweepface {

using codec::CodedSite;
using codec::Coefficients;
using codec::Hierarchy;
using codec::Lattice;
using codec::Steps3;
using codec::Symmetry;

namespace {

// Steps as shares of the tolerance. Small ones cost little: what counts is how many coefficients
// are not zero.
constexpr double kNeutralStep = 0.25, kTargetStep = 0.5;
// The neutral spends this share of the tolerance, so that its poses have room.
constexpr double kNeutralShare = 0.75;
// What a tangent that leans by the angle aimed at counts, in bits.
constexpr double kNeutralBits = 1, kTargetBits = 0.3;
constexpr int kMostFiner = 8;
// A quarter of a texel of a texture of 4096 x 4096.
constexpr int kTextureBits = 14;

// What one unit step of each coefficient does to the vertices: its column.
struct Columns {
  std::vector<Index> start;  // [S + 1]
  std::vector<Index> vertex;
  // For a step of 1: how it moves the vertex, and how it turns the tangents there.
  std::vector<std::array<float, 3>> weight;
  // The same the other way round: the coefficients that move a vertex.
  std::vector<Index> rowStart;  // [vertices + 1]
  std::vector<Index> rowVector;
};

// Every vertex of level 1 as a combination of coefficients, taken apart by coefficient.
class ColumnBuilder {
 public:
  ColumnBuilder(const Surface& surface, const Tessellation& grid, const Hierarchy& hierarchy)
      : surface_(surface), grid_(grid), hierarchy_(hierarchy) {
    expanded_.resize(surface.vectorCount());
    for (Index v = 0; v < surface.storedCount(); ++v) expanded_[v] = {{v, 1}};
    for (Index v = surface.storedCount(); v < surface.vectorCount(); ++v) {
      for (const Term& t : surface.derivation(v))
        for (const Term& s : expanded_[t.vector])
          expanded_[v].push_back({s.vector, s.factor * t.factor});
      mergeTerms(expanded_[v]);
    }
    stepOf_.resize(surface.storedCount());
    for (std::size_t k = 0; k < hierarchy.steps().size(); ++k)
      stepOf_[hierarchy.steps()[k].vector] = static_cast<Index>(k);
  }

  Columns build() const {
    const Index vertices = grid_.vertexCount();
    std::vector<std::vector<Entry>> rows(vertices);
    tbb::parallel_for(tbb::blocked_range<Index>(0, vertices),
                      [&](const tbb::blocked_range<Index>& range) {
                        std::vector<Sums> sum(surface_.storedCount());
                        for (Index v = range.begin(); v != range.end(); ++v)
                          rows[v] = coefficientRow(v, sum);
                      });
    Columns columns;
    columns.start.assign(surface_.storedCount() + 1, 0);
    for (const auto& row : rows)
      for (const Entry& e : row) ++columns.start[e.vector + 1];
    for (Index v = 0; v < surface_.storedCount(); ++v) columns.start[v + 1] += columns.start[v];
    columns.vertex.resize(columns.start.back());
    columns.weight.resize(columns.start.back());
    columns.rowStart.push_back(0);
    std::vector<Index> at = columns.start;
    for (Index v = 0; v < vertices; ++v) {
      for (const Entry& e : rows[v]) {
        columns.vertex[at[e.vector]] = v;
        columns.weight[at[e.vector]++] = e.weight;
        columns.rowVector.push_back(e.vector);
      }
      columns.rowStart.push_back(static_cast<Index>(columns.rowVector.size()));
    }
    return columns;
  }

 private:
  struct Entry {
    Index vector = -1;
    std::array<float, 3> weight{};
  };
  using Sums = std::array<double, 3>;  // position, tangents along u and v

  // From the finest to the coarsest, what a vector counts goes on to what predicts it. `sum` is
  // zero before and after.
  std::vector<Entry> coefficientRow(Index vertex, std::vector<Sums>& sum) const {
    constexpr double kNothing = 1e-4;  // of a step: verified anyway
    std::vector<Index> heap;
    const auto add = [&](Index vector, const Sums& more, double factor) {
      Sums& own = sum[vector];
      if (own == Sums{}) {
        heap.push_back(stepOf_[vector]);
        std::ranges::push_heap(heap);
      }
      for (int k = 0; k < 3; ++k) own[k] += factor * more[k];
    };
    for (int part = 0; part < 3; ++part) {
      const auto weights = surface_.weights(grid_.site(vertex), part == 1, part == 2);
      Sums unit{};
      unit[part] = 1;
      for (int k = 0; k < 36; ++k)
        if (weights.factors[k] != 0)
          for (const Term& t : expanded_[weights.vectors[k]])
            add(t.vector, unit, t.factor * weights.factors[k]);
    }
    std::vector<Entry> row;
    Index last = -1;
    while (!heap.empty()) {
      std::ranges::pop_heap(heap);
      const Index top = heap.back();
      heap.pop_back();
      if (top == last) continue;  // sums that had cancelled come twice
      last = top;
      const Hierarchy::Step& step = hierarchy_.steps()[top];
      const Sums factors = sum[step.vector];
      sum[step.vector] = {};
      const double most =
          std::max({std::abs(factors[0]), std::abs(factors[1]), std::abs(factors[2])});
      if (most < 1e-12) continue;
      for (const Term& t : hierarchy_.terms(step)) add(t.vector, factors, t.factor);
      if (most / step.reach <= kNothing) continue;
      Entry entry{step.vector, {}};
      for (int k = 0; k < 3; ++k) entry.weight[k] = static_cast<float>(factors[k] / step.reach);
      row.push_back(entry);
    }
    return row;
  }

  const Surface& surface_;
  const Tessellation& grid_;
  const Hierarchy& hierarchy_;
  std::vector<std::vector<Term>> expanded_;
  std::vector<Index> stepOf_;
};

// How far off the two tangents at each vertex are, as shares of their lengths.
struct Slopes {
  struct Tangent {
    std::array<float, 3> error{};   // the neutral's included
    float lean = 0;                 // this pose's own part along the normal: an angle in radians
    std::array<float, 3> normal{};  // of the surface
    float perLength = 0;
    float strain() const { return error[0] * error[0] + error[1] * error[1] + error[2] * error[2]; }
  };
  std::vector<std::array<Tangent, 2>> at;  // [vertices]
};

// One pose: looks for coefficients that cost few bits, vertex errors staying within a bound.
// Coordinate descent on  bits + penalty(errors), one coefficient after the other.
class PoseQuantiser {
 public:
  PoseQuantiser(const Lattice& lattice, const Columns& columns, const std::vector<Index>& siteOf,
                double step, double bound, double slopeWeight, Symmetry symmetry)
      : h_(lattice.hierarchy()),
        columns_(columns),
        siteOf_(siteOf),
        axis_(lattice.axis()),
        step_(static_cast<float>(step)),
        perSquare_(static_cast<float>(1 / (bound * bound))),
        slopeWeight_(static_cast<float>(slopeWeight)),
        symmetry_(symmetry) {}

  /// Improves `q`, whose vertices are off by `errors`; `expected` is what an image predicts.
  void run(Coefficients& q, const std::vector<Vec3>& errors, const Slopes& slopes,
           const Coefficients& expected) {
    q_ = &q;
    expected_ = &expected;
    slopes_ = slopes;
    for (auto& e : error_) e.resize(errors.size());
    for (std::size_t v = 0; v < errors.size(); ++v) {
      error_[0][v] = static_cast<float>(errors[v].x);
      error_[1][v] = static_cast<float>(errors[v].y);
      error_[2][v] = static_cast<float>(errors[v].z);
    }
    count();
    constexpr int kSweeps = 10;
    touched_.assign(errors.size(), 0);
    for (sweep_ = 0; sweep_ < kSweeps; ++sweep_) {
      Index changed = 0;
      findWanted();
      for (std::size_t k = h_.steps().size(); k-- > 0;)
        for (int a = 0; a < 3; ++a) changed += improve(h_.steps()[k].vector, a);
      if (changed == 0) break;
    }
    repair();
  }

 private:
  // Coefficients that are zero may be wanted only where an error is well on its way to the bound or
  // the surface is tilted.
  void findWanted() {
    constexpr float kOnItsWay = 0.3f, kTilted = 0.3f;
    wanted_.assign(q_->size(), 0);
    for (Index u = 0; u < static_cast<Index>(error_[0].size()); ++u)
      if (squareAt(u) > kOnItsWay || tilt(u) > kTilted)
        for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r)
          wanted_[columns_.rowVector[r]] = 1;
  }

  // Vertices that are still beyond the bound: whatever move helps most there, bits hardly counting.
  void repair() {
    beyond_ = 100 * kBeyond;
    constexpr int kRounds = 40;
    for (int round = 0; round < kRounds; ++round) {
      Index changed = 0, bad = 0;
      for (Index u = 0; u < static_cast<Index>(error_[0].size()); ++u) {
        if (squareAt(u) <= 1) continue;
        ++bad;
        changed += repairAt(u);
      }
      if (bad == 0 || changed == 0) return;
    }
  }
  bool repairAt(Index u) {
    double least = -1e-3;
    Index best = -1;
    int bestAxis = 0, bestMove = 0;
    for (Index r = columns_.rowStart[u]; r < columns_.rowStart[u + 1]; ++r)
      for (int a = 0; a < 3; ++a)
        for (const int d : {-2, -1, 1, 2}) {
          const Index v = columns_.rowVector[r];
          const std::int32_t before = (*q_)[v][a] - expected(v, a);
          double cost = bits(v, before, before + d) + growth(v, a, static_cast<float>(d));
          if (const auto image = follower(v); image.vector >= 0)
            cost += growth(image.vector, a, static_cast<float>(signFor(image, a) * d));
          if (cost < least) least = cost, best = v, bestAxis = a, bestMove = d;
        }
    if (best < 0) return false;
    change(best, bestAxis, bestMove);
    return true;
  }

  // Moves a coefficient and what follows it.
  void change(Index v, int a, std::int32_t d) {
    const std::int32_t before = (*q_)[v][a] - expected(v, a);
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
    if (symmetry_ != Symmetry::self || site.mirror <= siteOf_[v]) return {-1, 1};
    const Hierarchy::Image image = h_.images()[v];
    if (image.vector < 0 || h_.images()[image.vector].vector != v) return {-1, 1};
    return image;
  }
  int signFor(const Hierarchy::Image& image, int a) const {
    return a == axis_ ? -image.sign : image.sign;
  }
  std::int32_t expected(Index v, int a) const {
    if (symmetry_ == Symmetry::none) return 0;
    const Index site = siteOf_[v], mirror = h_.sites()[site].mirror;
    if (symmetry_ == Symmetry::partner) return mirror < 0 ? 0 : (*expected_)[v][a];
    const Hierarchy::Image& image = h_.images()[v];
    if (mirror < 0 || mirror >= site || image.vector < 0) return 0;
    return signFor(image, a) * (*q_)[image.vector][a];
  }

  void count() {
    const std::size_t vectors = q_->size();
    inSite_.assign(h_.sites().size(), 0);
    inVector_.assign(vectors, 0);
    for (Index v = 0; v < static_cast<Index>(vectors); ++v)
      for (int a = 0; a < 3; ++a)
        if ((*q_)[v][a] != expected(v, a)) ++inSite_[siteOf_[v]], ++inVector_[v];
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
    const double opening =
        0.6 + (inSite_[siteOf_[v]] - had == 0 ? 4.5 : 0) + (inVector_[v] - had == 0 ? 2.0 : 0);
    return sum + (has ? opening : -opening);
  }

  float squareAt(Index u) const {
    return (error_[0][u] * error_[0][u] + error_[1][u] * error_[1][u] +
            error_[2][u] * error_[2][u]) *
           perSquare_;
  }
  // A tangent that is off by about half of its length may turn the surface over.
  static constexpr float kMostStrain = 0.2f, kOverturn = 40;
  static float overturn(float strain) {
    return strain > kMostStrain ? kOverturn * (strain - kMostStrain) : 0;
  }
  float tilt(Index u) const {
    float sum = 0;
    for (const Slopes::Tangent& t : slopes_.at[u])
      sum += slopeWeight_ * t.lean * t.lean + overturn(t.strain());
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
      sum += penalty(square + (2 * own[u] + shift) * shift * perSquare_) - penalty(square);
      for (int side = 0; side < 2; ++side) {
        const Slopes::Tangent& t = slopes_.at[u][side];
        const float change = x * weight[1 + side] * t.perLength, turn = change * t.normal[a];
        tilted += (2 * t.lean + turn) * turn;
        const float strain = t.strain();
        over += overturn(strain + (2 * t.error[a] + change) * change) - overturn(strain);
      }
    }
    return sum + slopeWeight_ * tilted + over;
  }
  float gradient(Index v, int a) const {
    float sum = 0, tilted = 0, over = 0;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
      const Index u = columns_.vertex[p];
      const auto& weight = columns_.weight[p];
      sum += slope(squareAt(u)) * error_[a][u] * weight[0];
      for (int side = 0; side < 2; ++side) {
        const Slopes::Tangent& t = slopes_.at[u][side];
        const float change = weight[1 + side] * t.perLength;
        tilted += change * t.lean * t.normal[a];
        if (t.strain() > kMostStrain) over += change * t.error[a];
      }
    }
    return 2 * (sum * perSquare_ + slopeWeight_ * tilted + kOverturn * over) * step_;
  }
  void move(Index v, int a, std::int32_t d) {
    (*q_)[v][a] += d;
    const float x = static_cast<float>(d) * step_;
    for (Index p = columns_.start[v]; p < columns_.start[v + 1]; ++p) {
      const Index u = columns_.vertex[p];
      const auto& weight = columns_.weight[p];
      error_[a][u] += x * weight[0];
      touched_[u] = sweep_;
      for (int side = 0; side < 2; ++side) {
        Slopes::Tangent& t = slopes_.at[u][side];
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
    const Hierarchy::Image image = follower(v);
    const int sign = signFor(image, a);
    if (!isTouched(v) && (image.vector < 0 || !isTouched(image.vector))) return false;
    const std::int32_t before = (*q_)[v][a] - expected(v, a);
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

  const Hierarchy& h_;
  const Columns& columns_;
  const std::vector<Index>& siteOf_;
  int axis_;
  float step_, perSquare_, slopeWeight_;
  Symmetry symmetry_;
  Slopes slopes_;
  Coefficients* q_ = nullptr;
  const Coefficients* expected_ = nullptr;
  std::array<std::vector<float>, 3> error_;
  std::vector<int> inSite_, inVector_;
  std::vector<char> wanted_;  // [S]
  std::vector<int> touched_;  // [vertices] the sweep in which it moved last
  int sweep_ = 0;
  float beyond_ = kBeyond;
};

class Quantiser {
 public:
  Quantiser(Rig& rig, const MeshRig& source, double tolerance, double angle,
            const std::function<bool(double)>& proceed)
      : rig_(rig),
        source_(source),
        tolerance_(tolerance),
        angle_(angle),
        proceed_(proceed),
        grid_(rig.surface, 1) {
    rig.packing = {};
    rig.packing.neutralStep = kNeutralStep * tolerance;
    rig.packing.targetStep = kTargetStep * tolerance;
    rig.packing.textureBits = kTextureBits;
    const codec::MirrorSeeds seeds = codec::findMirror(rig.surface, rig.neutral);
    rig.packing.axis = seeds.axis;
    rig.packing.mirror = seeds.pairs;
    lattice_.emplace(rig.surface, rig.packing);
    codec::chooseImages(rig, *lattice_, rig.packing);
    columns_ = ColumnBuilder(rig.surface, grid_, lattice_->hierarchy()).build();
    siteOf_.resize(rig.surface.storedCount());
    for (const Hierarchy::Step& step : lattice_->hierarchy().steps())
      siteOf_[step.vector] = step.site;
  }

  Result<void> run() {
    const auto poses = static_cast<Index>(rig_.packing.poses.size());
    poses_.resize(poses);
    fittedNeutral_ = rig_.neutral;
    gather();
    neutralErrors_.assign(grid_.vertexCount(), Vec3{});
    // The neutral may spend more where the fit needs more.
    for (const double share : {kNeutralShare, 0.5 + kNeutralShare / 2, 0.98})
      if (settle(0, share * tolerance_)) break;
    if (!settled_) return failed(0);
    neutralErrors_ = errorsOf(0, poses_[0]);
    neutralOff_ = rig_.neutral;
    for (std::size_t v = 0; v < neutralOff_.size(); ++v) neutralOff_[v] -= fittedNeutral_[v];
    neutralOff_ = settled(std::move(neutralOff_));
    // Images first: what is compared with them needs them.
    std::vector<char> done(poses, 0);
    std::atomic<Index> bad = -1, count = 0;
    for (const bool images : {true, false}) {
      tbb::parallel_for(Index{1}, poses, [&](Index pose) {
        const Index image = rig_.packing.poses[pose].image;
        if (images != (image < 0 || image == pose)) return;
        if (!proceed_(static_cast<double>(++count) / poses)) return;
        if (!settle(pose, tolerance_)) bad = pose;
      });
    }
    if (!proceed_(1)) return fail("the conversion was interrupted");
    if (bad >= 0) return failed(bad);
    return {};
  }

 private:
  static std::unexpected<Error> failed(Index) {
    return fail("the tolerance could not be met everywhere; allow a larger one");
  }

  // Where the source's vertices are in each pose, at the vertices of level 1.
  void gather() {
    const auto& where = rig_.source.gridVertex;
    known_.assign(grid_.vertexCount(), 0);
    goals_.assign(poses_.size(), std::vector<Vec3>(grid_.vertexCount()));
    for (std::size_t s = 0; s < where.size(); ++s) {
      if (where[s] < 0) continue;
      known_[where[s]] = 1;
      goals_[0][where[s]] = source_.neutral.positions[s];
      for (std::size_t k = 0; k < source_.targets.size(); ++k)
        goals_[k + 1][where[s]] = source_.targets[k].positions[s] - source_.neutral.positions[s];
    }
  }

  std::vector<Vec3>& vectorsOf(Index pose) {
    return pose == 0 ? rig_.neutral : rig_.targets[pose - 1].difference;
  }

  std::vector<Vec3> errorsOf(Index pose, const Coefficients& q) const {
    std::vector<Vec3> vectors(rig_.surface.vectorCount());
    lattice_->restore(q, codec::stepOf(rig_.packing, pose), vectors);
    rig_.surface.settle(std::span(vectors).first(q.size()), vectors);
    std::vector<Vec3> errors = grid_.positions(vectors);
    for (std::size_t v = 0; v < errors.size(); ++v) {
      errors[v] -= goals_[pose][v];
      if (pose > 0) errors[v] += neutralErrors_[v];
      if (!known_[v]) errors[v] = {};
    }
    return errors;
  }
  // The neutral's errors are in every pose, those of a target only where it moves.
  double slopeWeight(Index pose) const {
    const double limit = angle_ * std::numbers::pi / 180;
    return (pose == 0 ? kNeutralBits : kTargetBits) / (limit * limit);
  }

  std::vector<Vec3> settled(std::vector<Vec3> stored) const {
    const std::size_t count = stored.size();
    stored.resize(rig_.surface.vectorCount());
    rig_.surface.settle(std::span(stored).first(count), stored);
    return stored;
  }

  Slopes slopesOf(Index pose, const Coefficients& q, const std::vector<Vec3>& fitted) const {
    std::vector<Vec3> off(q.size()), form = fitted;
    lattice_->restore(q, codec::stepOf(rig_.packing, pose), off);
    for (std::size_t v = 0; v < q.size(); ++v) off[v] -= fitted[v];
    if (pose > 0)
      for (std::size_t v = 0; v < q.size(); ++v) form[v] += fittedNeutral_[v];
    off = settled(std::move(off));
    form = settled(std::move(form));
    Slopes slopes;
    slopes.at.resize(grid_.vertexCount());
    for (Index v = 0; v < grid_.vertexCount(); ++v) {
      const Site site = grid_.site(v);
      const std::array<Vec3, 2> tangent{rig_.surface.evaluate(form, site, 1, 0),
                                        rig_.surface.evaluate(form, site, 0, 1)};
      const Vec3 across = cross(tangent[0], tangent[1]);
      const double area = norm(across), product = norm(tangent[0]) * norm(tangent[1]);
      if (!known_[v] || !(area > 0.02 * product)) continue;  // a pole, or nothing that has a side
      const Vec3 n = across * (1 / area);
      for (int d = 0; d < 2; ++d) {
        const double perLength = 1 / norm(tangent[d]);
        const Vec3 own = perLength * rig_.surface.evaluate(off, site, d == 0, d == 1);
        Vec3 error = own;
        if (pose > 0) error += perLength * rig_.surface.evaluate(neutralOff_, site, d == 0, d == 1);
        slopes.at[v][d] = {
            {static_cast<float>(error.x), static_cast<float>(error.y), static_cast<float>(error.z)},
            static_cast<float>(dot(n, own)),
            {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
            static_cast<float>(perLength)};
      }
    }
    return slopes;
  }

  static double largest(const std::vector<Vec3>& errors) {
    double most = 0;
    for (const Vec3& e : errors) most = std::max(most, norm(e));
    return most;
  }

  // Finds the coefficients of a pose and puts what they say into the rig. Finer steps where the
  // bound cannot be met: in the end they are as good as the fit.
  bool settle(Index pose, double bound) {
    Packing::Pose& form = rig_.packing.poses[pose];
    const Symmetry symmetry = form.image < 0       ? Symmetry::none
                              : form.image == pose ? Symmetry::self
                                                   : Symmetry::partner;
    const std::vector<Vec3> fitted = vectorsOf(pose);
    // From its image, then from itself, then in ever finer steps.
    bool met = false;
    const int first = symmetry == Symmetry::none ? 0 : -1;
    for (int attempt = first; attempt <= kMostFiner && !met; ++attempt) {
      form.finer = std::max(0, attempt);
      const double step = codec::stepOf(rig_.packing, pose);
      Coefficients expected;
      if (symmetry == Symmetry::partner)
        expected = lattice_->image(codec::inFinerSteps(
            poses_[form.image], form.finer - rig_.packing.poses[form.image].finer));
      Coefficients q = lattice_->round(fitted, step);
      if (attempt < 0) symmetrise(q, symmetry, expected);
      PoseQuantiser quantiser(*lattice_, columns_, siteOf_, step, 0.995 * bound, slopeWeight(pose),
                              symmetry);
      quantiser.run(q, errorsOf(pose, q), slopesOf(pose, q, fitted), expected);
      met = largest(errorsOf(pose, q)) <= bound;
      if (met) poses_[pose] = std::move(q);
    }
    if (!met) return false;
    if (pose == 0) settled_ = true;
    lattice_->restore(poses_[pose], codec::stepOf(rig_.packing, pose), vectorsOf(pose));
    return true;
  }

  // Starts from the image where there is one.
  void symmetrise(Coefficients& q, Symmetry symmetry, const Coefficients& expected) const {
    if (symmetry == Symmetry::none) return;
    const auto& sites = lattice_->hierarchy().sites();
    const auto& images = lattice_->hierarchy().images();
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const CodedSite& site = sites[s];
      if (site.mirror < 0 || (symmetry == Symmetry::self && site.mirror >= s)) continue;
      for (Index v = site.first; v < site.first + site.count; ++v) {
        if (images[v].vector < 0) continue;
        if (symmetry == Symmetry::partner) {
          q[v] = expected[v];
          continue;
        }
        for (int a = 0; a < 3; ++a)
          q[v][a] =
              (a == lattice_->axis() ? -images[v].sign : images[v].sign) * q[images[v].vector][a];
      }
    }
  }

  Rig& rig_;
  const MeshRig& source_;
  double tolerance_, angle_;
  const std::function<bool(double)>& proceed_;
  Tessellation grid_;
  std::optional<Lattice> lattice_;
  Columns columns_;
  std::vector<Index> siteOf_;
  std::vector<Coefficients> poses_;
  std::vector<std::vector<Vec3>> goals_;  // [poses][vertices] the neutral, then differences
  std::vector<char> known_;               // [vertices] that a source vertex stands for
  std::vector<Vec3> neutralErrors_, fittedNeutral_;
  std::vector<Vec3> neutralOff_;  // settled: how far the neutral is off the fit
  bool settled_ = false;
};

}  // namespace

Result<void> quantise(Rig& rig, const MeshRig& source, double tolerance, double angle,
                      const std::function<bool(double)>& proceed) {
  return Quantiser(rig, source, tolerance, angle, proceed).run();
}

}  // namespace sweepface
