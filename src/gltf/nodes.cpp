#include "gltf/nodes.hpp"

#include <fmt/format.h>

namespace sweepface::gltf {
namespace {

constexpr std::size_t nobody = -1;

std::string placeOf(std::size_t node) { return fmt::format("node {}", node); }

Affine fromMatrix(Members& in, const std::array<double, 16>& m) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    in.refuse("the last row of its matrix is not 0 0 0 1");
  return affineOf(m);
}

Affine fromParts(const std::array<double, 3>& move, const std::array<double, 4>& turn,
                 const std::array<double, 3>& scale) {
  const auto [x, y, z, w] = turn;
  return {{{scale[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            scale[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            scale[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}},
          {move[0], move[1], move[2]}};
}

/// A node's local transform.
Result<Affine> localMatrix(const Json& node, std::size_t index) {
  Members in(node, placeOf(index));
  const auto matrix = in.numbers<16>("matrix");
  const auto move = in.numbers<3>("translation");
  const auto turn = in.numbers<4>("rotation");
  const auto scale = in.numbers<3>("scale");
  const Affine local = matrix ? fromMatrix(in, *matrix)
                              : fromParts(move.value_or(std::array{0.0, 0.0, 0.0}),
                                          turn.value_or(std::array{0.0, 0.0, 0.0, 1.0}),
                                          scale.value_or(std::array{1.0, 1.0, 1.0}));
  if (!in.ok()) return in.error();
  return local;
}

Result<std::vector<std::size_t>> parentsOf(const Json& nodes) {
  std::vector<std::size_t> parents(nodes.size(), nobody);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Members in(nodes[n], placeOf(n));
    for (const Json& entry : in.array("children")) {
      const auto child = asIndex(entry, nodes.size());
      if (!child)
        in.refuse(fmt::format("one of its children is none of the {} nodes", nodes.size()));
      else if (parents[*child] != nobody)
        in.refuse(fmt::format("its child {} is also one of node {}", *child, parents[*child]));
      if (!in.ok()) return in.error();
      parents[*child] = n;
    }
    if (!in.ok()) return in.error();
  }
  return parents;
}

/// Nodes in an order in which parents come before their children.
Result<std::vector<std::size_t>> downwards(const std::vector<std::size_t>& parents) {
  std::vector<std::vector<std::size_t>> children(parents.size());
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < parents.size(); ++n)
    parents[n] == nobody ? order.push_back(n) : children[parents[n]].push_back(n);
  for (std::size_t k = 0; k < order.size(); ++k)
    order.insert(order.end(), children[order[k]].begin(), children[order[k]].end());
  if (order.size() == parents.size()) return order;
  return fail("its nodes are children of each other in a circle; export the file again.");
}

void addRoots(const Document& document, const Json& scene, std::vector<std::size_t>& roots) {
  for (const Json& entry : listOf(scene, "nodes"))
    if (const auto node = asIndex(entry, document.list("nodes").size())) roots.push_back(*node);
}

}  // namespace

Result<std::vector<Affine>> worldMatrices(const Document& document) {
  const Json& nodes = document.list("nodes");
  const auto parents = parentsOf(nodes);
  if (!parents) return std::unexpected(parents.error());
  const auto order = downwards(*parents);
  if (!order) return std::unexpected(order.error());
  std::vector<Affine> world(nodes.size());
  for (std::size_t n : *order) {
    const auto local = localMatrix(nodes[n], n);
    if (!local) return std::unexpected(local.error());
    const std::size_t parent = (*parents)[n];
    world[n] = parent == nobody ? *local : world[parent] * *local;
  }
  return world;
}

std::vector<bool> nodesBelow(const Document& document, std::vector<std::size_t> roots) {
  const Json& nodes = document.list("nodes");
  std::vector<bool> found(nodes.size());
  for (const std::size_t root : roots) found[root] = true;
  for (std::size_t k = 0; k < roots.size(); ++k)
    for (const Json& entry : listOf(nodes[roots[k]], "children"))
      if (const auto child = asIndex(entry, nodes.size()); child && !found[*child]) {
        found[*child] = true;
        roots.push_back(*child);
      }
  return found;
}

std::vector<bool> nodesOfScenes(const Document& document) {
  const Json& scenes = document.list("scenes");
  if (scenes.empty()) return std::vector<bool>(document.list("nodes").size(), true);
  std::vector<std::size_t> roots;
  for (const Json& scene : scenes) addRoots(document, scene, roots);
  return nodesBelow(document, std::move(roots));
}

std::vector<bool> shownNodes(const Document& document) {
  const Json& scenes = document.list("scenes");
  if (scenes.empty()) return nodesOfScenes(document);
  std::vector<std::size_t> roots;
  addRoots(document, scenes[findIndex(document.json, "scene", scenes.size()).value_or(0)], roots);
  return nodesBelow(document, std::move(roots));
}

}  // namespace sweepface::gltf
