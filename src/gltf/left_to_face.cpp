#include "gltf/left_to_face.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "gltf/slots.hpp"
#include "gltf/texcoords.hpp"
#include "gltf/triangles.hpp"

namespace sweepface::gltf {
namespace {

/// The accessor that a reference names, if it has no data.
std::optional<Accessor> emptyAccessor(const Document& document, const Json* reference) {
  const auto index =
      reference ? asIndex(*reference, document.list("accessors").size()) : std::nullopt;
  if (!index) return {};
  const auto accessor = accessorAt(document, *index);
  return accessor && !accessor->hasData() ? std::optional(*accessor) : std::nullopt;
}

const Json* indicesOf(const Json& primitive) { return find(primitive, "indices"); }
const Json* texcoordsOf(const Json& primitive) {
  return find(primitive["attributes"], "TEXCOORD_0");
}
Json* texcoordsOf(Json& primitive) { return find(primitive["attributes"], "TEXCOORD_0"); }

bool keepsOrder(const Json& holder) {
  const Json* const extensions = find(holder, "extensions");
  if (!extensions || !extensions->is_object()) return false;
  return std::ranges::any_of(extensions->items(),
                             [](const auto& entry) { return countsOnOrder(entry.key()); });
}

/// Vertices of a part's run, three for each triangle of a fan around each of its faces.
std::vector<Index> fans(const Parts& parts, const Part& part, const Polygons& polygons,
                        std::span<const Index> faces) {
  const Run& run = parts.runs[part.run];
  // A mirrored mesh shows the side from which its corners go clockwise.
  const bool mirrored = parts.meshes[run.rigMesh].mirrors;
  std::vector<Index> vertices;
  for (const Index face : faces) {
    const Index* const corners = &polygons.corners[polygons.faceStart[face]];
    for (Index k = 1; k + 1 < polygons.faceSize(face); ++k)
      for (const Index corner : {Index{0}, mirrored ? k + 1 : k, mirrored ? k : k + 1})
        vertices.push_back(corners[corner] - static_cast<Index>(run.first));
  }
  return vertices;
}

/// Triangles in ascending order, each beginning with its smallest vertex.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(triangles);
  return triangles;
}
std::vector<Triangle> sorted(const std::vector<Index>& vertices) {
  std::vector<Triangle> triangles(vertices.size() / 3);
  for (std::size_t k = 0; k < vertices.size(); ++k) triangles[k / 3][k % 3] = vertices[k];
  return sorted(std::move(triangles));
}

std::vector<std::vector<Index>> facesOfParts(const Parts& parts,
                                             const std::vector<Index>& facePart) {
  std::vector<std::vector<Index>> faces(parts.parts.size());
  for (std::size_t f = 0; f < facePart.size(); ++f)
    faces[facePart[f]].push_back(static_cast<Index>(f));
  return faces;
}

/// How many triangles a part has, and how many vertices its indices name.
struct Counts {
  std::size_t triangles = 0, named = 0;
};
Result<Counts> countsOf(const Document& document, const Parts& parts, const Part& part) {
  // Indices without data are the face's: only their number is known.
  if (const auto left = emptyAccessor(document, indicesOf(primitiveOf(document, parts, part))))
    return Counts{left->count / 3, left->count};
  const auto found = trianglesOf(document, parts, part);
  if (!found) return std::unexpected(found.error());
  return Counts{found->triangles.size(), found->named};
}

/// Gives back what a scene left to its face.
class Taker {
 public:
  Taker(Document& document, const Parts& parts, const Polygons& polygons,
        const std::vector<Index>& facePart)
      : document_(document),
        parts_(parts),
        polygons_(polygons),
        faces_(facesOfParts(parts, facePart)),
        builder_(document),
        slots_(document, parts, builder_),
        texcoords_(parts.runs.size()) {}

  Result<void> take() {
    for (std::size_t p = 0; p < faces_.size(); ++p) {
      Json& primitive = primitiveOf(document_, parts_, parts_.parts[p]);
      const auto left = emptyAccessor(document_, indicesOf(primitive));
      if (!left) continue;
      noteTexcoords(p, primitive);
      if (auto ok = takeTriangles(p, primitive, *left); !ok) return ok;
    }
    for (const Texcoords& run : texcoords_) {
      if (run.holders.empty()) continue;
      const std::size_t accessor = slots_.put(run.accessor, pack(run.values), Use::vertices);
      for (Json* const holder : run.holders) *holder = accessor;
    }
    return {};
  }

 private:
  /// Texture coordinates that parts of a run share.
  struct Texcoords {
    std::size_t accessor = 0;
    std::vector<Json*> holders;
    std::vector<Vec2> values;
  };

  Result<void> takeTriangles(std::size_t part, Json& primitive, const Accessor& left) {
    const std::vector<Index> vertices = fans(parts_, parts_.parts[part], polygons_, faces_[part]);
    const Column column = pack(std::vector<double>(vertices.begin(), vertices.end()), 1, left.type);
    if (!isOfIndices(left.type) || !column.sound)
      return fail(fmt::format("accessor {} cannot hold indices", left.index));
    primitive["indices"] = slots_.put(left.index, column, Use::indices);
    if (Json* const mode = find(primitive, "mode")) *mode = listMode;
    return {};
  }

  void noteTexcoords(std::size_t part, Json& primitive) {
    if (polygons_.cornerTexcoords.empty() || !hasPlainTexcoords(document_, primitive)) return;
    Json* const holder = texcoordsOf(primitive);
    const auto left = emptyAccessor(document_, holder);
    if (!left) return;
    Texcoords& texcoords = texcoords_[parts_.parts[part].run];
    if (texcoords.holders.empty()) texcoords.accessor = left->index;
    if (texcoords.accessor != left->index) return;
    const Run& run = parts_.runs[parts_.parts[part].run];
    texcoords.holders.push_back(holder);
    texcoords.values.resize(run.count);
    for (const Index face : faces_[part])
      for (Index c = polygons_.faceStart[face]; c < polygons_.faceStart[face + 1]; ++c)
        if (const Index t = polygons_.cornerTexcoords[c]; t >= 0)
          texcoords.values[polygons_.corners[c] - static_cast<Index>(run.first)] = {
              polygons_.texcoords[t].x, 1 - polygons_.texcoords[t].y};
  }

  Document& document_;
  const Parts& parts_;
  const Polygons& polygons_;
  std::vector<std::vector<Index>> faces_;  // [parts]
  Builder builder_;
  Slots slots_;
  std::vector<Texcoords> texcoords_;  // [runs]
};

}  // namespace

Result<std::vector<Index>> partsOfFaces(const Document& document, const Parts& parts,
                                        const Polygons& polygons) {
  std::vector<Index> facePart;
  std::size_t named = 0;
  Index face = 0;
  const auto isInNone = [&] { return fail(fmt::format("face {} is in no mesh of it", face)); };
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const auto counts = countsOf(document, parts, parts.parts[p]);
    if (!counts) return std::unexpected(counts.error());
    // Parts that share indices could take very long.
    named += counts->named;
    if (named > document.mostElements()) return fail("it has far more triangles");
    const Run& run = parts.runs[parts.parts[p].run];
    std::size_t left = counts->triangles;
    for (; left > 0 && face < polygons.faceCount(); ++face) {
      const std::span corners(&polygons.corners[polygons.faceStart[face]],
                              static_cast<std::size_t>(polygons.faceSize(face)));
      const bool fits = corners.size() - 2 <= left && std::ranges::all_of(corners, [&](Index v) {
                          return static_cast<std::size_t>(v) - run.first < run.count;
                        });
      if (!fits) return isInNone();
      left -= corners.size() - 2;
      facePart.push_back(static_cast<Index>(p));
    }
    if (left > 0) return fail("it has more triangles");
  }
  if (face < polygons.faceCount()) return isInNone();
  return facePart;
}

Result<LeftToFace> leftToFace(const Document& document, const Parts& parts,
                              const Polygons& polygons) {
  const auto facePart = partsOfFaces(document, parts, polygons);
  if (!facePart) return std::unexpected(facePart.error());
  const auto faces = facesOfParts(parts, *facePart);
  LeftToFace left;
  std::vector<std::optional<Json>> texcoords(parts.runs.size());  // the accessor that is left
  for (std::size_t p = 0; p < faces.size(); ++p) {
    const Part& part = parts.parts[p];
    const Json& primitive = primitiveOf(document, parts, part);
    const Json* const indices = indicesOf(primitive);
    const Json& mesh = document.list("meshes")[parts.meshes[parts.runs[part.run].rigMesh].mesh];
    if (!indices || faces[p].empty() || keepsOrder(primitive) || keepsOrder(mesh)) continue;
    const std::vector<Index> vertices = fans(parts, part, polygons, faces[p]);
    if (!emptyAccessor(document, indices)) {  // empty if the document is a scene itself
      const auto found = trianglesOf(document, parts, part);
      if (!found) return std::unexpected(found.error());
      // Quads may have been made across duplicated vertices.
      if (sorted(found->triangles) != sorted(vertices)) continue;
    }
    left.indices.emplace(indices, vertices.size());
    if (!hasPlainTexcoords(document, primitive)) continue;
    const Json* const reference = texcoordsOf(primitive);
    if (!texcoords[part.run]) texcoords[part.run] = *reference;
    if (texcoords[part.run] == *reference) left.texcoords.insert(reference);
  }
  return left;
}

Result<void> takeFromFace(Document& document, const Parts& parts, const Polygons& polygons,
                          const std::vector<Index>& facePart) {
  return Taker(document, parts, polygons, facePart).take();
}

}  // namespace sweepface::gltf
