#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "gltf/accessor.hpp"
#include "gltf/column.hpp"

namespace sweepface::gltf {

/// A place in a quad, or beyond: u from its first corner to its second, v from its first to its
/// fourth.
struct Mix {
  std::array<Index, 4> corners{};  ///< vertices, counter-clockwise
  double u = 0, v = 0;             ///< 0 to 1 within the quad

  static Mix at(Index vertex) { return {{vertex, vertex, vertex, vertex}, 0, 0}; }
  /// The place `step` / `steps` along an edge; the same from either side of the edge.
  static Mix between(Index from, Index to, std::int64_t step, Index steps);
  /// The place i of m and j of n steps into a quad; on its edges, as between() gives it.
  static Mix within(const std::array<Index, 4>& corners, std::int64_t i, Index m, std::int64_t j,
                    Index n);
  /// Whether it is just a corner.
  bool isVertex() const { return u == 0 && v == 0; }
  bool isBeyond() const { return !(u >= 0 && u <= 1 && v >= 0 && v <= 1); }
  std::array<double, 4> weights() const {
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  }
  friend bool operator==(const Mix&, const Mix&) = default;
};

/// Texture coordinates go on beyond the quad from which a place is seen; others stay as they are at
/// its rim. Integers that are not normalised are interpolated only as texture coordinates, which
/// KHR_mesh_quantization allows; others are those of the nearest corner.
enum class Meaning { texcoord, other };

/// An attribute's values at every place, in its own type.
Result<Column> mixed(const Document& document, const Accessor& attribute, Meaning meaning,
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
