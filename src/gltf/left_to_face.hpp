#pragma once

#include <set>

#include "sweepface/polygons.hpp"

#include "gltf/bound_scene.hpp"

// The triangles of parts and their first texture coordinates are what the face has as polygons. Its
// scene has accessors without data for them.
namespace sweepface::gltf {

/// The references, in the document's JSON, to what a scene leaves to its face: "indices", unless an
/// extension of the primitive may count on their order, and TEXCOORD_0, unless the face has them
/// otherwise.
std::set<const Json*> leftToFace(const Document& document, const Parts& parts);

/// Triangles of a part that name three vertices; of indices without data as many as these stand
/// for.
Result<std::size_t> triangleCount(const Document& document, const Parts& parts, const Part& part);

/// Gives a scene the data that it left to its face: triangles are fans from the first corners of
/// polygons, in their order. Vertices of no face, and all if the face has no texture coordinates,
/// have 0 for these.
Result<void> takeFromFace(BoundScene& scene, const Polygons& polygons);

}  // namespace sweepface::gltf
