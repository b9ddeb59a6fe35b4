#pragma once

#include <filesystem>

#include "sweepface/polygons.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

struct Scene {
  std::string glb;
  std::vector<std::string> warnings;
};

/// Everything in the document except what the rig stands for: POSITION and NORMAL of its parts and
/// of their targets become accessors without data, one for each run and attribute, and so does what
/// leftToFace() finds; TANGENT is removed. Images are read only from `folder`. The scene has the
/// same parts as the document.
Result<Scene> makeScene(Document document, const Parts& parts, const Polygons& polygons,
                        const std::filesystem::path& folder);

/// A scene's GLB as rigs store it: deflated, with numbers in planes where that is smaller, or as it
/// is if the stream would hold more than inflated() accepts.
std::string formatScene(const std::string& glb);
Result<std::string> glbOf(std::string_view scene);
Result<Document> parseScene(std::string_view scene);

}  // namespace sweepface::gltf
