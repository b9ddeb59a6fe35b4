#pragma once

#include <span>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Attributes that the surface provides itself, or that would not fit its normals.
inline bool isGeometry(std::string_view attribute) {
  return attribute == "POSITION" || attribute == "NORMAL" || attribute == "TANGENT";
}

/// For every vertex of the parts, the first vertex of its run at the same place that agrees with it
/// in all other attributes: authors duplicate vertices for the sake of normals.
Result<std::vector<Index>> sameVertices(const Document& document, const Parts& parts,
                                        std::span<const Index> places);

}  // namespace sweepface::gltf
