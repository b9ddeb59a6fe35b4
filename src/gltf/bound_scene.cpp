#include "gltf/bound_scene.hpp"

#include <fmt/format.h>

namespace sweepface::gltf {
namespace {

std::unexpected<Error> doesNotFit(std::string_view why) {
  return fail(fmt::format("The face and its scene do not fit: {}; convert the source again.", why));
}

}  // namespace

Result<BoundScene> sceneOf(const Rig& rig) {
  auto document = parseDocument(rig.scene, {});
  if (!document) return doesNotFit(document.error().message);
  return doesNotFit("not yet");
}

}  // namespace sweepface::gltf
