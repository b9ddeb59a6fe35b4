#pragma once

#include <map>
#include <set>
#include <vector>

#include "sweepface/polygons.hpp"

#include "gltf/parts.hpp"

// A face has the triangles of its parts, and their first texture coordinates, as polygons. Its
// scene has accessors without data for these: they are left to the face.
namespace sweepface::gltf {

/// [faces] the part of every face. Faces are in the order of the parts, and each part has as many
/// as make up all its triangles. Messages say what does not fit.
Result<std::vector<Index>> partsOfFaces(const Document& document, const Parts& parts,
                                        const Polygons& polygons);

/// References in a document's JSON to what its scene leaves to the face.
struct LeftToFace {
  /// To the indices of parts, with their number in fans of the polygons. Not if those are other
  /// triangles, nor if an extension of the primitive or mesh may depend on their order.
  std::map<const Json*, std::size_t> indices;
  /// To TEXCOORD_0 of such parts, one accessor per run. Not if the face has different ones.
  std::set<const Json*> texcoords;
};
Result<LeftToFace> leftToFace(const Document& document, const Parts& parts,
                              const Polygons& polygons);

/// Gives a scene back what it left to its face, every face of which is in a part. Texture
/// coordinates are 0 for vertices of no face, and for all if the face has none. Fails if the type
/// of the indices cannot hold them.
Result<void> takeFromFace(Document& document, const Parts& parts, const Polygons& polygons,
                          const std::vector<Index>& facePart);

}  // namespace sweepface::gltf
