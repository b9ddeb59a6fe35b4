#pragma once

#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/head.hpp"

#include "values.hpp"

namespace sweepface::python {

/// Where eyes look in one frame or in many; not told: as weights say.
class Looks {
 public:
  /// From None or a dict of angles, 'left_eye' and 'right_eye', each for all frames or one a frame.
  static Looks from(const py::object& given, std::size_t frames);

  bool areTold() const { return !poses_.empty(); }
  const HeadPose* of(std::size_t frame) const {
    return poses_.empty() ? nullptr : &poses_[poses_.size() == 1 ? 0 : frame];
  }

 private:
  std::vector<HeadPose> poses_;  // none, one, or one a frame
};

/// How a whole model turns by the head's angles in a clip, about a pivot or its own middle.
HeadTrack headTrackOf(const Rig& rig, const Clip* clip, const py::object& pivot);

}  // namespace sweepface::python
