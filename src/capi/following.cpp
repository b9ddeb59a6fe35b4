#include <algorithm>

#include "capi/handles.hpp"

using namespace sweepface;
using namespace sweepface::capi;

const Weights& sweepface::capi::followAll(const Following& following, sweepface_face& face) {
  const Mesh& mesh = *face.mesh;
  const std::size_t targets = mesh.rig->targets.size();
  std::ranges::fill(face.followed, 0.0);
  for (std::size_t r = 0; r < mesh.division->count(); ++r) {
    const std::span region = std::span(face.followed).subspan(r * targets, targets);
    std::copy_n(face.weights.data() + r * mesh.shown, mesh.shown, region.begin());
    if (following.eyes && face.looks)
      following.eyes->apply(*face.looks, region);
    else if (following.eyes)
      following.eyes->apply(region);
    if (following.followers) following.followers->apply(region);
  }
  return face.followed;
}
