#pragma once

#include <filesystem>

#include "sweepface/polygons.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

struct Scene {
  std::string glb;
  std::vector<std::string> warnings;
};

/// Everything that the document holds but what the rig stands for: POSITION and NORMAL of its parts
/// and of their targets become accessors without data, one for each run and attribute, and so does
/// what leftToFace() tells; TANGENT is removed. Images are read from `folder` alone. Parts are
/// found in it as they are in the document.
Result<Scene> makeScene(Document document, const Parts& parts, const Polygons& polygons,
                        const std::filesystem::path& folder);

/// A scene's GLB as rigs have it: numbers in planes where that is smaller, deflated, or as it is
/// where nobody would believe what that holds.
std::string formatScene(const std::string& glb);
Result<std::string> glbOf(std::string_view scene);
Result<Document> parseScene(std::string_view scene);

}  // namespace sweepface::gltf
