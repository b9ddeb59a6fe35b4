#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "sweepface/head.hpp"

namespace sweepface::io {

/// How a result of MediaPipe's face landmarker says that the first face turns, in angles as clips
/// have them, left-handed: the rotation of its facial transformation matrix, which leads from a
/// face that looks along +z to that before the camera. A matrix is an object whose data goes down
/// its columns, as in JavaScript, or a list of its rows, as in Python.
struct FaceTransform {
  std::optional<Angles> angles{};
  bool isBroken = false;  ///< something else is in its place
};
FaceTransform faceTransformOf(const nlohmann::json& frame);

}  // namespace sweepface::io
