#include "mesh/quads.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/quad_candidates.hpp"

namespace sweepface {

namespace {

// The order in which the program that cut quads wrote their halves: mostly one after the other,
// with the diagonal at the same corners. Which orders suggest a quad is learnt from the mesh
// itself: an order that shapes and edge flow do not confirm has no influence.
class Order {
 public:
  Order(const QuadCandidates& candidates, const Polygons& faces) {
    for (std::size_t p = 0; p < candidates.corners.size(); ++p) {
      const auto [first, second] = candidates.problem.pairs[p].triangles;
      const auto [a, b] = candidates.corners[p];
      way_.push_back((second == first + 1 ? 9 : 0) + 3 * (a - faces.faceStart[first]) +
                     (b - faces.faceStart[second]));
    }
  }

  /// Learns from the pairs that are joined; false if they say little.
  bool learn(const std::vector<char>& joined) {
    std::array<double, ways> all{}, yes{};
    for (std::size_t p = 0; p < way_.size(); ++p) all[way_[p]] += 1, yes[way_[p]] += joined[p];
    double count = 0, joinedCount = 0;
    for (int w = 0; w < ways; ++w) count += all[w], joinedCount += yes[w];
    if (joinedCount == 0 || joinedCount == count) return false;
    const double share = joinedCount / count;
    bool any = false;
    for (int w = 0; w < ways; ++w) {
      // A few additional cases with the usual odds keep rare orders from saying much.
      const double odds = (yes[w] + few * share) / (all[w] - yes[w] + few * (1 - share));
      evidence_[w] = std::log(odds * (1 - share) / share);
      any = any || std::abs(evidence_[w]) > slight;
    }
    return any;
  }

  double evidence(std::size_t pair) const { return evidence_[way_[pair]]; }

 private:
  static constexpr int ways = 18;
  static constexpr double few = 4, slight = 0.5;
  std::vector<int> way_;
  std::array<double, ways> evidence_{};
};

std::vector<char> choose(const QuadCandidates& candidates, const Polygons& faces) {
  constexpr int rounds = 3;
  Order order(candidates, faces);
  auto joined = choosePairs(candidates.problem);
  PairingProblem problem = candidates.problem;
  for (int round = 0; round < rounds && order.learn(joined); ++round) {
    for (std::size_t p = 0; p < problem.pairs.size(); ++p)
      problem.pairs[p].score = candidates.problem.pairs[p].score + order.evidence(p);
    auto better = choosePairs(problem);
    if (better == joined) break;
    joined = std::move(better);
  }
  return joined;
}

// Copies faces, and puts quads in the place of their first halves.
class Joiner {
 public:
  Joiner(const Polygons& faces, const QuadCandidates& candidates, const std::vector<char>& joined)
      : faces_(faces), candidates_(candidates), pairOf_(faces.faceCount(), -1) {
    for (std::size_t p = 0; p < joined.size(); ++p)
      if (joined[p])
        for (Index t : candidates.problem.pairs[p].triangles) pairOf_[t] = static_cast<Index>(p);
  }

  RecoveredQuads join() {
    Polygons& to = result_.polygons;
    to.texcoords = faces_.texcoords;
    to.materials = faces_.materials;
    to.groups = faces_.groups;
    to.materialFiles = faces_.materialFiles;
    for (Index f = 0; f < faces_.faceCount(); ++f)
      if (pairOf_[f] < 0 || candidates_.problem.pairs[pairOf_[f]].triangles[0] == f) copyFace(f);
    return std::move(result_);
  }

 private:
  void copyFace(Index f) {
    Polygons& to = result_.polygons;
    const Index pair = pairOf_[f], start = faces_.faceStart[f], size = faces_.faceSize(f);
    // A quad starts where its diagonal ends in the first half, so that a fan gives the halves.
    const Index first = pair < 0 ? 0 : candidates_.corners[pair][0] - start + 1;
    for (Index k = 0; k < size; ++k) copyCorner(start + (first + k) % size);
    if (pair >= 0) copyCorner(farCorner(pair));
    to.faceStart.push_back(static_cast<Index>(to.corners.size()));
    if (!faces_.faceMaterial.empty()) to.faceMaterial.push_back(faces_.faceMaterial[f]);
    if (!faces_.faceGroup.empty()) to.faceGroup.push_back(faces_.faceGroup[f]);
    result_.recovered += pair >= 0;
    result_.triangles += pair < 0 && faces_.faceSize(f) == 3;
  }

  void copyCorner(Index c) {
    result_.polygons.corners.push_back(faces_.corners[c]);
    if (!faces_.cornerTexcoords.empty())
      result_.polygons.cornerTexcoords.push_back(faces_.cornerTexcoords[c]);
  }

  // The corner of the second half that is not on the diagonal.
  Index farCorner(Index pair) const {
    const Index start = faces_.faceStart[candidates_.problem.pairs[pair].triangles[1]];
    return start + (candidates_.corners[pair][1] - start + 2) % 3;
  }

  const Polygons& faces_;
  const QuadCandidates& candidates_;
  std::vector<Index> pairOf_;
  RecoveredQuads result_;
};

}  // namespace

RecoveredQuads recoverQuads(const MeshRig& rig, std::span<const Index> copies,
                            std::span<const Index> parts) {
  const Polygons& faces = rig.neutral.polygons;
  const QuadCandidates candidates = findQuadCandidates(rig, copies, parts);
  return Joiner(faces, candidates, choose(candidates, faces)).join();
}

}  // namespace sweepface
