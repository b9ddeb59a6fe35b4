#pragma once

#include "sweepface/gltf.hpp"
#include "sweepface/usd.hpp"

#include "command.hpp"

namespace sweepface::cli {

/// Options for files that hold the face with all its targets.
struct RigFileArguments {
  bool morphNormals = false, quantize = false, zUp = false;
  double metersPerUnit = 0;  // 0: not given

  GlbOptions glb(Index lod) const {
    return {.lod = lod,
            .morphNormals = morphNormals,
            .quantize = quantize,
            .metersPerUnit = metersPerUnit,
            .zUp = zUp};
  }
  UsdOptions usd(Index lod) const {
    return {.lod = lod, .morphNormals = morphNormals, .metersPerUnit = metersPerUnit, .zUp = zUp};
  }
};
void addRigFile(CLI::App& app, RigFileArguments& a);
/// Refuses options that a file of this name cannot have.
Result<void> checkRigFile(const RigFileArguments& a, std::string_view output);

/// Whether it is a .usda, .usd or .usdz.
bool isUsd(std::string_view path);
/// What a file of that name holds.
Result<std::string> formatUsdFor(std::string_view path, const Rig& rig, const UsdOptions& options);

}  // namespace sweepface::cli
