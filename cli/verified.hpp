#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/measure.hpp"

namespace sweepface::cli {

/// What a reader of the bytes of a face will see, compared with the meshes it is to be near to.
struct Verified {
  double tolerance = 0;
  FurthestVertex worst;
  std::string worstShape;
  double angleRms = 0;
  std::vector<Index> folds;  // of the neutral and every target
  std::vector<double> kept;  // of every target's movement
};

/// Fails where a vertex is further from the source's than the tolerance, or if there is a face
/// `before`, from where that has it. `made` is what the bytes were made of and tells where the
/// source's vertices are, if its order was left out.
Result<Verified> verify(std::string_view bytes, const std::string& name, const MeshRig& source,
                        const Rig& made, double tolerance, const Rig* before = nullptr);

/// "the neutral", or the name of a target.
std::string nameOfShape(const Rig& rig, Index target);

void printDistance(const Verified& verified);

/// Writes and makes sure that the disk holds what was meant.
Result<void> writeAndReadBack(const std::filesystem::path& path, std::string_view bytes);

}  // namespace sweepface::cli
