#pragma once

#include <map>
#include <set>
#include <vector>

#include "sweepface/polygons.hpp"

#include "gltf/parts.hpp"

// A face has the triangles of its parts, and their first texture coordinates, as polygons. Its
// scene has accessors without data for them: they are left to the face.
namespace sweepface::gltf {

/// The part of every face [faces]. They come in the order of the parts, as many as make all of
/// their triangles. Messages say what does not fit.
Result<std::vector<Index>> partsOfFaces(const Document& document, const Parts& parts,
                                        const Polygons& polygons);

/// References in a document's JSON to what its scene leaves to the face.
struct LeftToFace {
  /// To the indices of parts, with the number that fans of the polygons have. Not where these are
  /// other triangles, nor where an extension of the primitive or mesh may count on their order.
  std::map<const Json*, std::size_t> indices;
  /// To TEXCOORD_0 of such parts, one accessor a run. Not where the face has other ones.
  std::set<const Json*> texcoords;
};
Result<LeftToFace> leftToFace(const Document& document, const Parts& parts,
                              const Polygons& polygons);

/// Gives a scene what it left to its face, of which each is in a part. Vertices of no face, and all
/// if the face has no texture coordinates, have 0 for these. Fails where indices are of a type that
/// cannot hold them.
Result<void> takeFromFace(Document& document, const Parts& parts, const Polygons& polygons,
                          const std::vector<Index>& facePart);

}  // namespace sweepface::gltf
