#pragma once

#include <filesystem>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

struct Scene {
  std::string glb;
  std::vector<std::string> warnings;
};

/// Everything that the document holds but what the rig stands for: POSITION and NORMAL of its parts
/// and of their targets become accessors without data, one for each run and attribute, and TANGENT
/// is removed. Images are read from `folder` alone. Parts are found in it as they are in the
/// document.
Result<Scene> makeScene(Document document, const Parts& parts, const std::filesystem::path& folder);

}  // namespace sweepface::gltf
