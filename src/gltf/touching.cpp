#include "gltf/touching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <set>

#include "sweepface/box.hpp"

#include "gltf/nodes.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

// Vertices that stand together differ by less than this share of the face's diagonal.
constexpr double kTogether = 1e-5;
// Meshes that meet share an edge at least; a single vertex may stand there by chance.
constexpr std::size_t kFewest = 3;

using Cell = std::array<std::int64_t, 3>;

/// The places of vertices that no target moves.
class StillPlaces {
 public:
  explicit StillPlaces(const MeshRig& rig) : size_(kTogether * diagonal(rig.neutral.positions)) {
    for (std::size_t v = 0; v < rig.neutral.positions.size() && size_ > 0; ++v)
      if (std::ranges::none_of(rig.targets, [&](const MeshTarget& target) {
            return norm(target.positions[v] - rig.neutral.positions[v]) > size_;
          }))
        cells_.insert(cellOf(rig.neutral.positions[v]));
  }

  /// The places of the face at which there are any of these.
  std::size_t shared(const std::vector<double>& positions, const Affine& world) const {
    std::set<Cell> found;
    for (std::size_t k = 0; k + 2 < positions.size() && size_ > 0; k += 3) {
      const Vec3 p = world.point({positions[k], positions[k + 1], positions[k + 2]});
      if (!(norm(p) < 1e15 * size_)) continue;  // beyond whole numbers of cells
      if (const Cell cell = cellOf(p); cells_.contains(cell)) found.insert(cell);
    }
    return found.size();
  }

 private:
  Cell cellOf(const Vec3& p) const {
    return {std::llround(p.x / size_), std::llround(p.y / size_), std::llround(p.z / size_)};
  }

  double size_;
  std::set<Cell> cells_;
};

/// [meshes] the primitives of triangles that are not of the face.
std::vector<std::set<std::size_t>> othersOf(const Document& document, const Parts& parts) {
  const Json& meshes = document.list("meshes");
  std::vector<std::set<std::size_t>> others(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (std::size_t p = 0; p < listOf(meshes[m], "primitives").size(); ++p) others[m].insert(p);
  for (const Part& part : parts.parts)
    others[parts.meshes[parts.runs[part.run].rigMesh].mesh].erase(part.primitive);
  return others;
}

/// x, y and z of the vertices of triangles; nothing if there are none that can be read.
std::vector<double> positionsOf(const Document& document, const Json& primitive) {
  const Json* const attributes = find(primitive, "attributes");
  if (!attributes || findIndex(primitive, "mode", fanMode + 1).value_or(listMode) < listMode)
    return {};
  const auto index = findIndex(*attributes, "POSITION", document.list("accessors").size());
  if (!index) return {};
  const auto accessor = accessorAt(document, *index);
  if (!accessor || accessor->components() != 3) return {};
  return decode(document, *accessor).value_or(std::vector<double>{});
}

}  // namespace

std::string touchingMeshes(const Document& document, const Parts& parts, const MeshRig& rig) {
  const auto others = othersOf(document, parts);
  const auto worlds = worldMatrices(document);
  if (!worlds || std::ranges::all_of(others, &std::set<std::size_t>::empty)) return {};
  const StillPlaces still(rig);
  const std::vector<bool> isShown = nodesOfScenes(document);
  std::vector<std::string> touching;
  const Json& nodes = document.list("nodes");
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto mesh = findIndex(nodes[n], "mesh", others.size());
    if (!mesh || !isShown[n]) continue;
    const Affine world = find(nodes[n], "skin") ? Affine{} : (*worlds)[n];
    for (const std::size_t p : others[*mesh])
      if (still.shared(positionsOf(document, document.list("meshes")[*mesh]["primitives"][p]),
                       world) >= kFewest)
        touching.push_back(placeOf(document, *mesh, p));
  }
  if (touching.empty()) return {};
  return fmt::format(
      "Beside the face, up to the tolerance from it, slits may show at {}; to close them, give "
      "what meets the face there a morph target that moves nothing, so that it is part of the "
      "face.",
      io::fewOf(touching, 3));
}

}  // namespace sweepface::gltf
