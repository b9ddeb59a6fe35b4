// Which triangles to join is a labelling of edges: each is a diagonal or is not. Pairs, triangles
// and stars are the factors of its score. The labels are found by max-product linear programming
// (Globerson, Jaakkola: Fixing max-product, 2007), whose messages travel far: a quad continues the
// edge loops of its neighbours. Where the labels still do not fit, they are repaired along
// alternating paths.
#include "mesh/quad_pairing.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace sweepface {

namespace {

constexpr double never = 1e3;  // beyond all scores
constexpr int maxSweeps = 100;
constexpr double settled = 1e-3;

using Four = Eigen::Array4d;

/// [16] for four bits: what makes a score less than never where a bit has that value, elsewhere 0.
std::array<Four, 16> unlikely(bool value) {
  std::array<Four, 16> table;
  for (unsigned bits = 0; bits < table.size(); ++bits)
    for (int k = 0; k < 4; ++k) table[bits][k] = (bits >> k & 1) == value ? 2 * never : 0;
  return table;
}

using PairsOfTriangle = std::vector<std::array<Index, 3>>;

PairsOfTriangle pairsOfTriangles(const PairingProblem& problem) {
  PairsOfTriangle result(problem.triangles, {-1, -1, -1});
  for (Index p = 0; p < static_cast<Index>(problem.pairs.size()); ++p)
    for (Index t : problem.pairs[p].triangles)
      *std::find(result[t].begin(), result[t].end(), -1) = p;
  return result;
}

// Each factor in turn shares what it knows of its pairs evenly among them.
class Beliefs {
 public:
  Beliefs(const PairingProblem& problem, const PairsOfTriangle& pairsOf)
      : problem_(problem),
        pairsOf_(pairsOf),
        belief_(problem.pairs.size()),
        fromTriangle_(3 * pairsOf.size(), 0),
        fromSpoke_(problem.spokes.size(), 0) {
    for (std::size_t p = 0; p < belief_.size(); ++p) belief_[p] = problem.pairs[p].score;
  }

  std::vector<double> settle() {
    change_ = 1;
    for (int sweep = 0; sweep < maxSweeps && change_ > settled; ++sweep) {
      change_ = 0;
      for (Index t = 0; t < problem_.triangles; ++t) askTriangle(t);
      for (const auto& star : problem_.stars) askStar(star);
    }
    return belief_;
  }

 private:
  // At most one of the triangle's pairs is joined.
  void askTriangle(Index t) {
    double* messages = fromTriangle_.data() + 3 * static_cast<std::size_t>(t);
    const auto& pairs = pairsOf_[t];
    const int count = static_cast<int>(std::find(pairs.begin(), pairs.end(), -1) - pairs.begin());
    std::array<double, 3> in{};
    for (int k = 0; k < count; ++k) in[k] = belief_[pairs[k]] - messages[k];
    for (int k = 0; k < count; ++k) {
      double without = -problem_.loneCost;
      for (int l = 0; l < count; ++l)
        if (l != k) without = std::max(without, in[l]);
      tell(pairs[k], messages[k], in[k], (in[k] - without) / count);
    }
  }

  void askStar(const PairingProblem::Star& star) {
    if (star.firstChoice == star.endChoice) return;
    const int size = star.endSpoke - star.firstSpoke;
    const Index* spokes = problem_.spokes.data() + star.firstSpoke;
    double* messages = fromSpoke_.data() + star.firstSpoke;
    std::array<double, 16> in{};
    std::array<Four, 4> with, without;
    with.fill(Four::Constant(-never)), without.fill(Four::Constant(-never));
    int count = 0;
    for (int k = 0; k < size; ++k)
      if (spokes[k] >= 0) in[k] = belief_[spokes[k]] - messages[k], ++count;
    for (Index c = star.firstChoice; c < star.endChoice; ++c) {
      const unsigned diagonals = problem_.choices[c].diagonals;
      double score = problem_.choices[c].score;
      for (unsigned left = diagonals; left != 0; left &= left - 1)
        score += in[std::countr_zero(left)];
      // Most of the time is spent here, and branches could not be predicted.
      for (int k = 0; 4 * k < size; ++k) {
        const unsigned four = diagonals >> 4 * k & 15;
        with[k] = with[k].max(score - ifClear_[four]);
        without[k] = without[k].max(score - ifSet_[four]);
      }
    }
    for (int k = 0; k < size; ++k)
      if (spokes[k] >= 0)
        tell(spokes[k], messages[k], in[k], (with[k / 4][k % 4] - without[k / 4][k % 4]) / count);
  }

  void tell(Index pair, double& message, double in, double belief) {
    change_ = std::max(change_, std::abs(belief - in - message));
    message = belief - in;
    belief_[pair] = belief;
  }

  const PairingProblem& problem_;
  const PairsOfTriangle& pairsOf_;
  std::array<Four, 16> ifClear_ = unlikely(false), ifSet_ = unlikely(true);
  std::vector<double> belief_, fromTriangle_, fromSpoke_;
  double change_ = 0;
};

// A choice of pairs, and how much the score gains with every change of it.
class Pairing {
 public:
  explicit Pairing(const PairingProblem& problem)
      : problem_(problem),
        joined_(problem.pairs.size(), 0),
        pairOf_(problem.triangles, -1),
        diagonals_(problem.stars.size(), 0),
        spokesOf_(problem.pairs.size()) {
    for (Index s = 0; s < static_cast<Index>(problem.stars.size()); ++s) {
      const auto& star = problem.stars[s];
      if (star.firstChoice == star.endChoice) continue;
      for (Index k = star.firstSpoke; k < star.endSpoke; ++k)
        if (const Index p = problem.spokes[k]; p >= 0)
          spokesOf_[p][spokesOf_[p][0].star >= 0] = {s, k - star.firstSpoke};
    }
  }

  void decode(const std::vector<double>& belief) {
    std::vector<Index> order(belief.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::pair(-belief[a], a) < std::pair(-belief[b], b);
    });
    for (Index p : order) {
      if (belief[p] <= 0) break;
      const auto [a, b] = problem_.pairs[p].triangles;
      if (pairOf_[a] < 0 && pairOf_[b] < 0 && flip(p) < -never / 2) flip(p);
    }
  }

  double flip(Index p) {
    double gain = (joined_[p] ? -1 : 1) * problem_.pairs[p].score;
    for (const Spoke& spoke : spokesOf_[p]) {
      if (spoke.star < 0) continue;
      gain -= starScore(spoke.star);
      diagonals_[spoke.star] ^= 1u << spoke.number;
      gain += starScore(spoke.star);
    }
    joined_[p] = !joined_[p];
    for (Index t : problem_.pairs[p].triangles) {
      gain += (joined_[p] ? 1 : -1) * problem_.loneCost;
      pairOf_[t] = joined_[p] ? p : -1;
    }
    return gain;
  }

  Index pairOf(Index triangle) const { return pairOf_[triangle]; }
  const std::vector<char>& joined() const { return joined_; }

 private:
  struct Spoke {
    Index star = -1, number = -1;
  };

  double starScore(Index s) const {
    const auto begin = problem_.choices.begin() + problem_.stars[s].firstChoice;
    const auto end = problem_.choices.begin() + problem_.stars[s].endChoice;
    const auto it = std::lower_bound(begin, end, diagonals_[s],
                                     [](const auto& c, unsigned d) { return c.diagonals < d; });
    return it != end && it->diagonals == diagonals_[s] ? it->score : -never;
  }

  const PairingProblem& problem_;
  std::vector<char> joined_;
  std::vector<Index> pairOf_;  // [triangles] the pair it is joined in, or -1
  std::vector<unsigned> diagonals_;
  std::vector<std::array<Spoke, 2>> spokesOf_;
};

// Improves a choice along alternating paths. Such a path begins at a lone triangle: joining it to
// another one frees that one's partner, where the path continues.
class Repair {
 public:
  Repair(const PairingProblem& problem, const PairsOfTriangle& pairsOf, Pairing& pairing)
      : problem_(problem), pairsOf_(pairsOf), pairing_(pairing), visited_(problem.triangles, 0) {}

  void run() {
    bool better = true;
    for (int pass = 0; pass < maxPasses && better; ++pass) {
      better = false;
      for (Index t = 0; t < problem_.triangles; ++t)
        if (pairing_.pairOf(t) < 0 && pairsOf_[t][0] >= 0) better |= takeBestPath(t);
    }
  }

 private:
  static constexpr int maxPasses = 2;
  static constexpr std::size_t maxSteps = 64;

  struct Step {
    Index join = -1, part = -1;  // part: -1 at the end of a path between lone triangles
    Index freed = -1;
    int before = -1;
    double gain = 0;  // of the path so far
  };

  bool takeBestPath(Index start) {
    ++search_;
    visited_[start] = search_;
    steps_.assign(1, {.freed = start});
    const auto less = [&](int a, int b) {
      return std::pair(steps_[a].gain, -a) < std::pair(steps_[b].gain, -b);
    };
    std::vector<int> open{0};
    int best = 0;
    while (!open.empty() && steps_.size() < maxSteps) {
      std::pop_heap(open.begin(), open.end(), less);
      const int at = open.back();
      open.pop_back();
      walk(at, true);
      const auto before = static_cast<int>(steps_.size());
      for (Index join : pairsOf_[steps_[at].freed])
        if (join >= 0) tryStep(at, join);
      walk(at, false);
      for (int k = before; k < static_cast<int>(steps_.size()); ++k) {
        if (steps_[k].gain > steps_[best].gain + 1e-6) best = k;
        if (steps_[k].freed < 0) continue;
        open.push_back(k);
        std::push_heap(open.begin(), open.end(), less);
      }
    }
    walk(best, true);
    return best != 0;
  }

  void tryStep(int at, Index join) {
    Step step{.join = join, .before = at, .gain = steps_[at].gain};
    const auto& [a, b] = problem_.pairs[join].triangles;
    const Index other = a == steps_[at].freed ? b : a;
    if (visited_[other] == search_) return;
    step.part = pairing_.pairOf(other);
    if (step.part >= 0) {
      const auto& [c, d] = problem_.pairs[step.part].triangles;
      step.freed = c == other ? d : c;
      visited_[other] = visited_[step.freed] = search_;
    }
    step.gain += apply(step, true);
    apply(step, false);
    steps_.push_back(step);
  }

  double apply(const Step& step, bool forward) {
    double gain = 0;
    if (!forward) gain += pairing_.flip(step.join);
    if (step.part >= 0) gain += pairing_.flip(step.part);
    if (forward) gain += pairing_.flip(step.join);
    return gain;
  }

  void walk(int last, bool forward) {
    std::vector<int> path;
    for (int k = last; k > 0; k = steps_[k].before) path.push_back(k);
    if (forward) std::reverse(path.begin(), path.end());
    for (int k : path) apply(steps_[k], forward);
  }

  const PairingProblem& problem_;
  const PairsOfTriangle& pairsOf_;
  Pairing& pairing_;
  std::vector<Index> visited_;  // [triangles] the last search that came by
  Index search_ = 0;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<char> choosePairs(const PairingProblem& problem) {
  const auto pairsOf = pairsOfTriangles(problem);
  const auto belief = Beliefs(problem, pairsOf).settle();
  Pairing pairing(problem);
  pairing.decode(belief);
  Repair(problem, pairsOf, pairing).run();
  return pairing.joined();
}

}  // namespace sweepface
