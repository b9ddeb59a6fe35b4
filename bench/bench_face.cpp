#include "bench_face.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"

#include "give_up.hpp"

namespace sweepface::bench {
namespace {

constexpr Index kCells = 32, kTargets = 12;

/// A bulge at a place of the unit square.
double bulge(double x, double y, double atX, double atY, double width) {
  return std::exp(-(std::pow(x - atX, 2) + std::pow(y - atY, 2)) / (width * width));
}

std::vector<Vec3> gridPositions(int target) {
  std::vector<Vec3> positions;
  for (Index j = 0; j <= kCells; ++j)
    for (Index i = 0; i <= kCells; ++i) {
      const double x = static_cast<double>(i) / kCells, y = static_cast<double>(j) / kCells;
      Vec3 p{20 * x - 10, 30 * y - 15,
             8 * std::cos(2 * (x - 0.5)) + 3 * bulge(x, y, 0.5, 0.5, 0.2)};
      if (target >= 0) {
        const double push = bulge(x, y, 0.2 + 0.2 * (target % 4), 0.25 + 0.25 * (target / 4), 0.15);
        p += push * Vec3{0.3, -0.5, 1};
      }
      positions.push_back(p);
    }
  return positions;
}

/// A mask with a nose, and targets that push it here and there.
MeshRig gridRig() {
  MeshRig rig;
  rig.neutral.positions = gridPositions(-1);
  Polygons& polygons = rig.neutral.polygons;
  for (Index j = 0; j < kCells; ++j)
    for (Index i = 0; i < kCells; ++i) {
      const Index v = j * (kCells + 1) + i;
      for (Index corner : {v, v + 1, v + kCells + 2, v + kCells + 1})
        polygons.corners.push_back(corner);
      polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
    }
  for (int k = 0; k < kTargets; ++k)
    rig.targets.push_back({fmt::format("push{}", k), gridPositions(k)});
  return rig;
}

Result<Rig> loadFace(const char* path) {
  if (path == nullptr) {
    Result<Conversion> made = convert(gridRig());
    if (!made) return std::unexpected(made.error());
    return std::move(made->rig);
  }
  const Result<std::string> bytes = readFile(path);
  if (!bytes) return std::unexpected(bytes.error());
  return decode(*bytes, path);
}

const char* facePath() {
  const char* path = std::getenv("SWEEPFACE_BENCH_FACE");
  return path != nullptr && *path != '\0' ? path : nullptr;
}

}  // namespace

const Rig& face() {
  static const Rig rig = orEnd(loadFace(facePath()));
  return rig;
}

std::string faceName() { return facePath() != nullptr ? facePath() : "made-up grid"; }

Weights someWeights(Active active) {
  const std::size_t count = face().targets.size();
  const std::size_t wanted = active == Active::all ? count : std::min<std::size_t>(10, count);
  Weights weights(count, 0.0);
  for (std::size_t k = 0; k < wanted; ++k)
    weights[k * count / wanted] = 0.2 + 0.6 * static_cast<double>(k) / static_cast<double>(wanted);
  return weights;
}

}  // namespace sweepface::bench
