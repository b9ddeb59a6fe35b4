// Which triangles to join is a labelling of the edges: each is a diagonal or not. Scores, triangles
// and stars are the factors of its energy, and max-sum belief propagation (Bayati, Shah, Sharma:
// Max-product for maximum weight matching, 2008) finds labels that agree over long distances: a
// quad continues the edge loops of its neighbours. Augmenting repairs what greedy decoding leaves.
#include "mesh/quad_pairing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace sweepface {

namespace {

constexpr double loneCost = 2;       // of a triangle that stays one
constexpr double valenceCost = 1.5;  // of each edge too many or too few at a vertex
constexpr double never = 60;
constexpr int maxSpokes = 12;  // larger stars are poles: they have no opinion
constexpr int sweeps = 80;

double starScore(const PairingProblem::Star& star, int diagonals) {
  const int edges = star.end - star.begin - diagonals;
  if (star.closed && edges < 3 && diagonals > 0) return -never;
  return -valenceCost * std::abs(edges - star.edges);
}

// All ways to choose spokes of a star of which no two are neighbours, by the star's size.
std::vector<std::vector<std::uint16_t>> choicesOfSpokes(bool closed) {
  std::vector<std::vector<std::uint16_t>> result(maxSpokes + 1);
  for (unsigned size = 1; size <= maxSpokes; ++size)
    for (unsigned mask = 0; mask < 1u << size; ++mask) {
      const unsigned turned = closed ? (mask >> 1) | (mask & 1) << (size - 1) : mask >> 1;
      if (!(mask & turned)) result[size].push_back(static_cast<std::uint16_t>(mask));
    }
  return result;
}

class Beliefs {
 public:
  explicit Beliefs(const PairingProblem& problem)
      : problem_(problem),
        belief_(problem.pairs.size()),
        fromTriangle_(problem.pairs.size()),
        fromSpoke_(problem.spokes.size(), 0),
        pairsOf_(problem.triangles, {-1, -1, -1}) {
    for (std::size_t p = 0; p < belief_.size(); ++p) {
      belief_[p] = problem.pairs[p].score;
      for (int side : {0, 1}) {
        auto& list = pairsOf_[problem.pairs[p].triangles[side]];
        *std::find(list.begin(), list.end(), -1) = static_cast<Index>(p);
      }
    }
  }

  std::vector<double> settle() {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (Index t = 0; t < problem_.triangles; ++t) askTriangle(t);
      for (const auto& star : problem_.stars) askStar(star);
    }
    return belief_;
  }

 private:
  static double damped(double before, double now) {
    return 0.5 * before + 0.5 * std::clamp(now, -never, never);
  }
  void askTriangle(Index t) {
    std::array<double, 3> in{};
    for (int k = 0; k < 3; ++k)
      if (const Index p = pairsOf_[t][k]; p >= 0) in[k] = belief_[p] - fromTriangle_[p][side(p, t)];
    for (int k = 0; k < 3; ++k)
      if (const Index p = pairsOf_[t][k]; p >= 0) {
        double other = -loneCost;
        for (int l = 0; l < 3; ++l)
          if (l != k && pairsOf_[t][l] >= 0) other = std::max(other, in[l]);
        double& message = fromTriangle_[p][side(p, t)];
        message = damped(message, -other);
        belief_[p] = in[k] + message;
      }
  }
  void askStar(const PairingProblem::Star& star) {
    const int size = star.end - star.begin;
    if (size > maxSpokes) return;
    const Index* spokes = problem_.spokes.data() + star.begin;
    double* messages = fromSpoke_.data() + star.begin;
    std::array<double, maxSpokes> in{}, with, without;
    with.fill(-1e9), without.fill(-1e9);
    unsigned possible = 0;
    for (int k = 0; k < size; ++k)
      if (spokes[k] >= 0) {
        possible |= 1u << k;
        in[k] = belief_[spokes[k]] - messages[k];
      }
    static const auto closed = choicesOfSpokes(true), open = choicesOfSpokes(false);
    for (const unsigned mask : (star.closed ? closed : open)[size]) {
      if (mask & ~possible) continue;
      double score = starScore(star, std::popcount(mask));
      for (int k = 0; k < size; ++k)
        if (mask >> k & 1) score += in[k];
      for (int k = 0; k < size; ++k) {
        double& best = mask >> k & 1 ? with[k] : without[k];
        best = std::max(best, score);
      }
    }
    for (int k = 0; k < size; ++k)
      if (spokes[k] >= 0) {
        messages[k] = damped(messages[k], with[k] - without[k]);
        belief_[spokes[k]] = in[k] + messages[k];
      }
  }
  int side(Index pair, Index triangle) const {
    return problem_.pairs[pair].triangles[1] == triangle;
  }

  const PairingProblem& problem_;
  std::vector<double> belief_;
  std::vector<std::array<double, 2>> fromTriangle_;
  std::vector<double> fromSpoke_;
  std::vector<std::array<Index, 3>> pairsOf_;
};

}  // namespace

std::vector<char> choosePairs(const PairingProblem& problem) {
  const auto belief = Beliefs(problem).settle();
  std::vector<Index> order(belief.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return belief[a] > belief[b]; });
  std::vector<char> chosen(belief.size(), 0), taken(problem.triangles, 0);
  for (Index p : order) {
    if (belief[p] <= 0) break;
    auto [a, b] = problem.pairs[p].triangles;
    if (taken[a] || taken[b]) continue;
    chosen[p] = taken[a] = taken[b] = 1;
  }
  return chosen;
}

}  // namespace sweepface
