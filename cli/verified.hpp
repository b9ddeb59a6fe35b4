#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/measure.hpp"

namespace sweepface::cli {

/// How a face decoded from its bytes compares with the meshes that it must stay close to.
struct Verified {
  double tolerance = 0;
  FurthestVertex worst;
  std::string worstShape;
  NormalErrors angle;
  std::vector<Index> folds;  // in the neutral and every target
  std::vector<double> kept;  // the share of every target's movement
};

/// Fails if a vertex is further than the tolerance from the source's or, given a face `before`,
/// from where that has it. `made` is the rig that was encoded; it locates the source's vertices if
/// their order was left out.
Result<Verified> verify(std::string_view bytes, const std::string& name, const MeshRig& source,
                        const Rig& made, double tolerance, const Rig* before = nullptr);

/// "the neutral", or the name of a target.
std::string nameOfShape(const Rig& rig, Index target);

void printDistance(const Verified& verified);

/// Writes a file and makes sure that the disk holds the same bytes: 0, or kInterrupted if the work
/// was to stop, when nothing is written.
Result<int> writeAndReadBack(const std::filesystem::path& path, std::string_view bytes);

}  // namespace sweepface::cli
