#pragma once

#include <span>
#include <vector>

#include "sweepface/box.hpp"
#include "sweepface/picture.hpp"

namespace sweepface {

/// What pictures of a rig are about: all of it, or where the face is a small part of what there is,
/// as of a whole body, that which its targets move.
class Subject {
 public:
  explicit Subject(const Rig& rig);

  /// A camera for each view, all of which show it at the same size at rest and in the expression.
  std::vector<Camera> cameras(const FaceScenes& scenes, const Weights& expression,
                              std::span<const View> views) const;
  /// The size for which the rig is cut into triangles: that of a larger picture of all of it.
  PictureSize cutFor(PictureSize size) const;

 private:
  Box part_;  // empty: all of it
};

}  // namespace sweepface
