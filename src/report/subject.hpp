#pragma once

#include <span>
#include <vector>

#include "sweepface/box.hpp"
#include "sweepface/picture.hpp"

namespace sweepface {

/// What pictures of a rig show: all of it or, if the face is only a small part, as of a whole body,
/// the part that its targets move.
class Subject {
 public:
  explicit Subject(const Rig& rig);

  /// A camera for each view, all of which show it at the same size at rest and in the expression.
  std::vector<Camera> cameras(const FaceScenes& scenes, const Weights& expression,
                              std::span<const View> views) const;
  /// The picture size for which the rig is tessellated: that of a larger picture of all of it.
  PictureSize cutFor(PictureSize size) const;

 private:
  Box part_;  // empty: all of it
};

}  // namespace sweepface
