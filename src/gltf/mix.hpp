#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "gltf/accessor.hpp"
#include "gltf/column.hpp"

namespace sweepface::gltf {

/// A place in a quad: u from its first corner to its second, v from its first to its fourth.
struct Mix {
  std::array<Index, 4> corners{};  ///< vertices, counter-clockwise
  double u = 0, v = 0;

  static Mix at(Index vertex) { return {{vertex, vertex, vertex, vertex}, 0, 0}; }
  /// The place `step` / `steps` along an edge; the same from either side of the edge.
  static Mix between(Index from, Index to, Index step, Index steps);
  /// Whether it is just a corner.
  bool isVertex() const { return u == 0 && v == 0; }
  std::array<double, 4> weights() const {
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  }
};

/// An attribute's values at every place, in its own type. Integers that are not normalised cannot
/// be interpolated: they are those of the nearest corner.
Result<Column> mixed(const Document& document, const Accessor& attribute,
                     std::span<const Mix> places);

/// The joints that move a vertex, four per attribute, and their weights.
struct SkinAttributes {
  std::vector<Accessor> joints, weights;  ///< the same number of both
};
struct SkinColumns {
  std::vector<Column> joints, weights;
};
/// The joints of all corners merged at every place: as many of the strongest are kept as there is
/// room for, and their weights sum to one.
Result<SkinColumns> mixedSkin(const Document& document, const SkinAttributes& attributes,
                              std::span<const Mix> places);

}  // namespace sweepface::gltf
