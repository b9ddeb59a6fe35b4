#include "mesh/quads.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mesh/quad_candidates.hpp"

namespace sweepface {

namespace {

// How the triangles of each pair stand to each other in the file
struct OrderClasses {
  static constexpr int count = 27;
  static int of(const QuadCandidate& c, const PairingProblem::Pair& pair, const Polygons& faces) {
    const Index a = c.corners[0] - faces.faceStart[pair.triangles[0]];
    const Index b = c.corners[1] - faces.faceStart[pair.triangles[1]];
    const Index apart = pair.triangles[1] - pair.triangles[0];
    return (apart == 1 ? 0 : 1) * 9 + a * 3 + b;
  }
};

}  // namespace

RecoveredQuads recoverQuads(const MeshRig& rig, std::span<const Index> copies) {
  const Polygons& faces = rig.neutral.polygons;
  auto candidates = findQuadCandidates(rig, copies);
  auto& pairs = candidates.problem.pairs;
  std::vector<double> shape;
  for (auto& p : pairs) shape.push_back(p.score);
  std::vector<char> chosen = choosePairs(candidates.problem);
  const int rounds = std::getenv("ROUNDS") ? atoi(std::getenv("ROUNDS")) : 3;
  for (int round = 0; round < rounds; ++round) {
    double yes[27] = {}, all[27] = {};
    double Y = 0, N = 0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const int k = OrderClasses::of(candidates.list[p], pairs[p], faces);
      yes[k] += chosen[p], all[k] += 1, Y += chosen[p], N += 1;
    }
    if (std::getenv("VERBOSE"))
      for (int k = 0; k < 27; ++k)
        if (all[k]) printf("class %d: %g of %g\n", k, yes[k], all[k]);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const int k = OrderClasses::of(candidates.list[p], pairs[p], faces);
      const double s = 4;
      const double prior = Y / N;
      pairs[p].score = shape[p] +
                       std::log((yes[k] + s * prior) / (all[k] - yes[k] + s * (1 - prior))) -
                       std::log(prior / (1 - prior));
    }
    chosen = choosePairs(candidates.problem);
  }
  RecoveredQuads result;
  // assembly
  const auto count = static_cast<std::size_t>(faces.faceCount());
  std::vector<Index> pairOf(count, -1);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (chosen[p])
      pairOf[pairs[p].triangles[0]] = pairOf[pairs[p].triangles[1]] = static_cast<Index>(p);
  Polygons& out = result.polygons;
  out.texcoords = faces.texcoords, out.materials = faces.materials, out.groups = faces.groups,
  out.materialFiles = faces.materialFiles;
  const auto corner = [&](Index c) {
    out.corners.push_back(faces.corners[c]);
    if (!faces.cornerTexcoords.empty()) out.cornerTexcoords.push_back(faces.cornerTexcoords[c]);
  };
  for (Index f = 0; f < faces.faceCount(); ++f) {
    const Index p = pairOf[f];
    if (p >= 0 && pairs[p].triangles[1] == f) continue;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c) {
      corner(c);
      if (p >= 0 && candidates.list[p].corners[0] == c) {
        const Index g = pairs[p].triangles[1],
                    t = candidates.list[p].corners[1] - faces.faceStart[g];
        corner(faces.faceStart[g] + (t + 2) % 3);
      }
    }
    out.faceStart.push_back(static_cast<Index>(out.corners.size()));
    if (!faces.faceMaterial.empty()) out.faceMaterial.push_back(faces.faceMaterial[f]);
    if (!faces.faceGroup.empty()) out.faceGroup.push_back(faces.faceGroup[f]);
    if (p >= 0)
      ++result.recovered;
    else
      result.triangles += faces.faceSize(f) == 3;
  }
  return result;
}

}  // namespace sweepface
