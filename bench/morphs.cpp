#include "morphs.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

#include "sweepface/io.hpp"

#include "bench_face.hpp"
#include "give_up.hpp"

namespace sweepface::bench {
namespace {

Floats toFloats(const std::vector<Vec3>& vectors) {
  Floats out;
  for (const Vec3& p : vectors)
    for (const double x : {p.x, p.y, p.z}) out.push_back(static_cast<float>(x));
  return out;
}

/// Normals of a mesh's vertices: its triangles' normals weighted by area, as engines compute them.
std::vector<Vec3> meshNormals(const std::vector<Vec3>& positions, const Polygons& polygons) {
  std::vector<Vec3> normals(positions.size());
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index* corners = polygons.corners.data() + polygons.faceStart[f];
    for (Index k = 1; k + 1 < polygons.faceSize(f); ++k) {
      const Vec3& a = positions[corners[0]];
      const Vec3 n = cross(positions[corners[k]] - a, positions[corners[k + 1]] - a);
      for (const Index c : {corners[0], corners[k], corners[k + 1]}) normals[c] += n;
    }
  }
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

std::vector<Vec3> minus(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  for (std::size_t v = 0; v < a.size(); ++v) a[v] -= b[v];
  return a;
}

struct Pose {
  std::vector<Vec3> positions, normals;
};

/// The neutral first, then every target.
std::vector<Pose> posesOfFace() {
  const Tessellation grid(face().surface, 1);
  const auto pose = [&](const Weights& weights) {
    const auto vectors = blend(face(), weights);
    return Pose{sourcePositions(face(), grid, vectors, weights),
                sourceNormals(face(), grid, vectors)};
  };
  Weights weights(face().targets.size(), 0.0);
  std::vector<Pose> poses{pose(weights)};
  for (double& weight : weights) {
    weight = 1;
    poses.push_back(pose(weights));
    weight = 0;
  }
  return poses;
}

std::vector<std::filesystem::path> pathsOf(const char* list) {
  std::vector<std::filesystem::path> paths;
  std::istringstream in(list ? list : "");
  for (std::string path; std::getline(in, path, ':');)
    if (!path.empty()) paths.emplace_back(path);
  return paths;
}

std::vector<Pose> posesOfSource(const char* neutral) {
  const auto source = orEnd(readRig(neutral, pathsOf(std::getenv("SWEEPFACE_BENCH_TARGETS"))));
  const auto& [positions, polygons] = source.neutral;
  if (positions.size() != face().source.gridVertex.size())
    giveUp("The neutral and the face are not of the same number of vertices.");
  std::vector<Pose> poses{{positions, meshNormals(positions, polygons)}};
  for (const Target& target : face().targets) {
    const auto found = std::ranges::find(source.targets, target.name, &MeshTarget::name);
    if (found == source.targets.end())
      giveUp("There is no mesh of the target " + target.name + ".");
    poses.push_back({found->positions, meshNormals(found->positions, polygons)});
  }
  return poses;
}

}  // namespace

const Morphs& morphs() {
  static const Morphs made = [] {
    const char* neutral = std::getenv("SWEEPFACE_BENCH_NEUTRAL");
    const auto poses = neutral && *neutral ? posesOfSource(neutral) : posesOfFace();
    Morphs result{toFloats(poses[0].positions), toFloats(poses[0].normals), {}, {}};
    for (std::size_t k = 1; k < poses.size(); ++k) {
      result.differences.push_back(toFloats(minus(poses[k].positions, poses[0].positions)));
      result.normalDifferences.push_back(toFloats(minus(poses[k].normals, poses[0].normals)));
    }
    return result;
  }();
  return made;
}

std::vector<double> exactBlend(const Floats& neutral, const std::vector<Floats>& differences,
                               const std::vector<double>& weights) {
  std::vector<double> out(neutral.begin(), neutral.end());
  for (std::size_t k = 0; k < differences.size(); ++k)
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] += weights[k] * static_cast<double>(differences[k][i]);
  return out;
}

}  // namespace sweepface::bench
