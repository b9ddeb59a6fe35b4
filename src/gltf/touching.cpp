#include "gltf/touching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <set>

#include "sweepface/box.hpp"

#include "gltf/left_out.hpp"
#include "gltf/nodes.hpp"
#include "io/text.hpp"
#include "mesh/each_edge.hpp"

namespace sweepface::gltf {
namespace {

// Vertices that stand together differ by less than this share of the face's diagonal.
constexpr double kTogether = 1e-5;
// Meshes that meet share an edge at least; a single vertex may stand there by chance.
constexpr std::size_t kFewest = 3;
// Elements that are looked at: many primitives may share an accessor, and many nodes show a mesh.
constexpr std::size_t kMostLookedAt = std::size_t{1} << 22;

using Cell = std::array<std::int64_t, 3>;

/// [vertices] whether each is on the rim of the faces: on an edge that has a face on one side only.
std::vector<bool> onRim(const Polygons& faces, std::span<const Index> places) {
  std::vector<std::pair<Index, Index>> edges;
  eachEdge(faces,
           [&](Index a, Index b, Index) { edges.push_back(std::minmax(places[a], places[b])); });
  std::ranges::sort(edges);
  std::vector<bool> isOnRim(places.size());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::find_if(edge, edges.end(), [&](auto& e) { return e != *edge; });
    if (next - edge == 1) isOnRim[edge->first] = isOnRim[edge->second] = true;
    edge = next;
  }
  return isOnRim;
}

/// Where the face's vertices are, and its rim as far as no target moves it.
class Rim {
 public:
  Rim(const MeshRig& rig, std::span<const Index> places)
      : size_(kTogether * diagonal(rig.neutral.positions)) {
    if (!(size_ > 0)) return;
    const std::vector<bool> isOnRim = onRim(rig.neutral.polygons, places);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const Vec3& p = rig.neutral.positions[v];
      if (!isInReach(p)) continue;
      all_.insert(cellOf(p));
      if (isOnRim[places[v]] && std::ranges::none_of(rig.targets, [&](const MeshTarget& target) {
            return norm(target.positions[v] - p) > size_;
          }))
        rim_.insert(cellOf(p)), box_.include(p);
    }
  }

  /// Whether a box is no further away than that.
  bool isNear(const Box& box) const {
    const Vec3 below = box_.high - box.low, above = box.high - box_.low;
    return std::min({below.x, below.y, below.z, above.x, above.y, above.z}) >= -size_;
  }

  /// Whether vertices stand at several places of the rim, and are not mostly a copy of the face.
  bool meets(const std::vector<Vec3>& vertices, const Affine& world) const {
    std::set<Cell> found;
    std::size_t copied = 0;
    for (const Vec3& vertex : vertices) {
      const Vec3 p = world.point(vertex);
      if (!isInReach(p)) continue;
      const Cell cell = cellOf(p);
      copied += all_.contains(cell);
      if (rim_.contains(cell)) found.insert(cell);
    }
    return found.size() >= kFewest && 2 * copied <= vertices.size();
  }

 private:
  /// Whether cells can be counted up to there.
  bool isInReach(const Vec3& p) const { return norm(p) < 1e15 * size_; }
  Cell cellOf(const Vec3& p) const {
    return {std::llround(p.x / size_), std::llround(p.y / size_), std::llround(p.z / size_)};
  }

  double size_;
  std::set<Cell> all_, rim_;
  Box box_;
};

/// Reads what may not be sound, as far as there are elements left that may be looked at.
class Reader {
 public:
  Reader(const Document& document, std::size_t& left) : document_(document), left_(left) {}

  /// The vertices of the triangles of a primitive; none if it has none or cannot be read.
  std::vector<Vec3> verticesOf(const Json& primitive) {
    const Json* const attributes = find(primitive, "attributes");
    if (!attributes || findIndex(primitive, "mode", fanMode + 1).value_or(listMode) < listMode)
      return {};
    const std::vector<Vec3> all = asVectors(valuesOf(*attributes, "POSITION"));
    if (!find(primitive, "indices")) return all;
    std::vector<bool> isUsed(all.size());
    for (const double index : valuesOf(primitive, "indices"))
      if (index >= 0 && index < static_cast<double>(all.size()))
        isUsed[static_cast<std::size_t>(index)] = true;
    std::vector<Vec3> used;
    for (std::size_t v = 0; v < all.size(); ++v)
      if (isUsed[v]) used.push_back(all[v]);
    return used;
  }

 private:
  std::vector<double> valuesOf(const Json& holder, std::string_view key) {
    const auto index = findIndex(holder, key, document_.list("accessors").size());
    if (!index) return {};
    const auto accessor = accessorAt(document_, *index);
    if (!accessor || accessor->count > left_) return {};
    left_ -= accessor->count;
    return decode(document_, *accessor).value_or(std::vector<double>{});
  }

  const Document& document_;
  std::size_t& left_;
};

/// The box around what a transform makes of a box.
Box placed(const Box& box, const Affine& world) {
  Box result;
  for (int corner = 0; corner < 8; ++corner)
    result.include(
        world.point({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                     corner & 4 ? box.high.z : box.low.z}));
  return result;
}

}  // namespace

std::string touchingMeshes(const Document& document, const Parts& parts, const MeshRig& rig,
                           std::span<const Index> places) {
  const auto others = otherPrimitives(document, parts);
  const auto worlds = worldMatrices(document);
  if (!worlds || std::ranges::all_of(others, &std::set<std::size_t>::empty)) return {};
  const Rim rim(rig, places);
  const Json& nodes = document.list("nodes");
  const std::vector<bool> isShown = nodesOfScenes(document);
  std::vector<std::vector<std::size_t>> shownBy(others.size());  // [meshes]
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const auto mesh = findIndex(nodes[n], "mesh", others.size()); mesh && isShown[n])
      shownBy[*mesh].push_back(n);
  std::vector<std::string> touching;
  std::size_t left = kMostLookedAt;
  Reader reader(document, left);
  for (std::size_t m = 0; m < others.size(); ++m) {
    if (shownBy[m].empty()) continue;
    for (const std::size_t p : others[m]) {
      const auto vertices = reader.verticesOf(document.list("meshes")[m]["primitives"][p]);
      const Box box(vertices);
      const auto meets = [&](std::size_t n) {
        const Affine world = find(nodes[n], "skin") ? Affine{} : (*worlds)[n];
        if (!rim.isNear(placed(box, world)) || vertices.size() > left) return false;
        left -= vertices.size();
        return rim.meets(vertices, world);
      };
      if (std::ranges::any_of(shownBy[m], meets)) touching.push_back(placeOf(document, m, p));
    }
  }
  if (touching.empty()) return {};
  return fmt::format(
      "Slits as wide as the tolerance may show between the face and {}; to close them, have that "
      "be part of the face: choose all meshes of the face by their names (--mesh), and give "
      "--tolerance, as what is assumed grows with them.",
      io::fewOf(touching, 3));
}

}  // namespace sweepface::gltf
