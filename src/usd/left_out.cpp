#include "gltf/left_out.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sweepface/usd.hpp"

#include "gltf/scene.hpp"

namespace sweepface {

std::string leftOutOfUsd(const Rig& rig) {
  if (rig.scene.empty()) return {};
  const auto document = gltf::parseScene(rig.scene);
  if (!document) return {};
  const auto parts = gltf::findPartsAnywhere(*document);
  if (!parts) return {};
  const auto has = [&](const char* list) { return !document->list(list).empty(); };
  const bool isColoured = std::ranges::any_of(parts->parts, [&](const gltf::Part& part) {
    const gltf::Json* const attributes =
        gltf::find(gltf::primitiveOf(*document, *parts, part), "attributes");
    return attributes && attributes->contains("COLOR_0");
  });
  const auto others = gltf::otherPrimitives(*document, *parts);
  const bool hasOthers = !gltf::leftOut(*document, *parts).empty() ||
                         !std::ranges::all_of(others, &std::set<std::size_t>::empty);
  std::vector<std::string> kinds;
  for (const auto& [isThere, kind] : {std::pair(hasOthers, "other meshes or copies"),
                                      {has("skins"), "skins"},
                                      {has("animations"), "animations"},
                                      {isColoured, "colours of vertices"}})
    if (isThere) kinds.emplace_back(kind);
  if (kinds.empty()) return {};
  return fmt::format(
      "A USD file leaves out {} of the scene that the face came with; a .glb keeps them.",
      fmt::join(kinds, " and "));
}

}  // namespace sweepface
