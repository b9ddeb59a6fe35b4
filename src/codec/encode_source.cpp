#include <algorithm>
#include <optional>
#include <span>

#include "codec/blocks.hpp"
#include "codec/chunks.hpp"
#include "codec/encoding.hpp"
#include "codec/faces.hpp"
#include "codec/limits.hpp"
#include "codec/source_coder.hpp"

namespace sweepface::codec {

namespace {

std::string sourceOrder(const std::vector<Index>& gridVertex) {
  Writer out;
  out.number(gridVertex.size());
  Index last = -1;
  for (Index v : gridVertex) {
    out.signedNumber(v - std::int64_t{last} - 1);
    last = v;
  }
  return out.take();
}

bool hasFaces(const Polygons& polygons) {
  return polygons.faceCount() > 0 || !polygons.materials.empty() || !polygons.groups.empty() ||
         !polygons.materialFiles.empty();
}

std::string polygons(const Polygons& polygons) {
  Writer out;
  std::vector<Index> sizes;
  for (Index f = 0; f < polygons.faceCount(); ++f) sizes.push_back(polygons.faceSize(f));
  writeRuns(out, sizes);
  Index last = 0;
  for (Index v : polygons.corners) {
    out.signedNumber(v - std::int64_t{last});
    last = v;
  }
  writeTexts(out, polygons.materials);
  writeRuns(out, polygons.faceMaterial);
  writeTexts(out, polygons.groups);
  writeRuns(out, polygons.faceGroup);
  writeTexts(out, polygons.materialFiles);
  return out.take();
}

std::string texcoords(const Polygons& polygons) {
  Writer out;
  out.number(polygons.texcoords.size());
  writeVectors(out, polygons.texcoords, Precision::exact);
  out.byte(!polygons.cornerTexcoords.empty());
  Index last = -1;
  for (Index t : polygons.cornerTexcoords) {
    out.signedNumber(t - std::int64_t{last});
    last = t;
  }
  return out.take();
}

// A quad that goes once around a face of four corners is written as its first corner alone.
std::string quadCorners(const SourceMesh& source) {
  Writer out;
  Index last = 0;
  for (std::size_t q = 0; q + 4 <= source.quadCorners.size(); q += 4) {
    const Index* corner = &source.quadCorners[q];
    const std::int64_t step = corner[0] - std::int64_t{last};
    const bool whole =
        std::ranges::equal(aroundQuad(source.polygons, corner[0]), std::span(corner, 4));
    out.signedNumber(2 * step + !whole);
    for (int k = 1; k < 4 && !whole; ++k) out.signedNumber(corner[k] - std::int64_t{corner[k - 1]});
    last = corner[0];
  }
  return out.take();
}

// Whether a reader accepts this much from so few bytes.
template <typename Read>
bool isReadable(const std::string& bytes, Read read) {
  RangeDecoder coder(bytes);
  Symbols<RangeDecoder> symbols(coder);
  read(symbols, mostEntries(bytes.size()));
  return symbols.ok();
}

// Whether the vertices are those of the grid in its order.
bool countsUp(const LevelOne& grid, const SourceMesh& source) {
  const auto& order = source.gridVertex;
  if (static_cast<Index>(order.size()) != grid.vertexCount()) return false;
  for (Index v = 0; v < grid.vertexCount(); ++v)
    if (order[v] != v) return false;
  return true;
}

bool haveCorners(const Polygons& faces) {
  for (Index f = 0; f < faces.faceCount(); ++f)
    if (faces.faceSize(f) < 3) return false;
  return true;
}

/// The source as coded by the grid of the patches.
struct ByGrid {
  std::optional<std::string> order;  ///< none if there are faces on the grid's own vertices
  std::string faces;
  std::vector<Index> images;  ///< of corners, if there are faces
};

// Nothing if a reader would refuse so much from so few bytes, or would refuse the faces.
std::optional<ByGrid> byGrid(const Rig& rig, const Mirror& mirror) {
  const SourceMesh& source = rig.source;
  const std::size_t quads = rig.surface.wireframe().quadCount();
  if (quads > kMostQuads || !haveCorners(source.polygons)) return std::nullopt;
  const LevelOne grid(rig.surface, mirror);
  ByGrid told;
  SourceMesh again;  // as a reader sees it
  again.loose = source.loose;
  const auto isTaken = [&](const std::string& bytes, auto read) {
    return quads <= mostEntries(bytes.size()) && isReadable(bytes, read);
  };
  if (hasFaces(source.polygons) && countsUp(grid, source)) {
    again.gridVertex = source.gridVertex;
  } else {
    told.order = ranged([&](auto& out) { writeOrder(out, grid, source); });
    if (!isTaken(*told.order, [&](auto& in, auto most) { readOrder(in, grid, most, again); }))
      return std::nullopt;
  }
  told.faces = ranged([&](auto& out) { writeFaces(out, grid, source); });
  if (!isTaken(told.faces, [&](auto& in, auto most) { readFaces(in, grid, most, again); }))
    return std::nullopt;
  if (hasFaces(source.polygons)) told.images = cornerImages(grid.mirror(), source);
  return told;
}

// In steps, unless they are too fine for some coordinate or a reader would refuse so much from so
// few bytes.
void writeTexcoords(Writer& out, const Polygons& faces, std::span<const Index> images, int bits) {
  if (bits > 0 && holdsTexture(faces, bits)) {
    const std::string bytes = ranged([&](auto& to) { writeTexture(to, faces, images, bits); });
    Polygons again = faces;
    again.texcoords.clear();
    again.cornerTexcoords.clear();
    const auto readAgain = [&](auto& in, auto most) { readTexture(in, most, again, images, bits); };
    if (!bytes.empty() && isReadable(bytes, readAgain)) return writeChunk(out, "text", bytes);
  }
  writeChunk(out, "texc", texcoords(faces));
}

}  // namespace

void writeSource(Writer& out, const Rig& rig, const Mirror& mirror, int textureBits) {
  const SourceMesh& source = rig.source;
  const Polygons& faces = source.polygons;
  // A source without an order of vertices would get that of the grid from faces coded by it.
  const std::optional<ByGrid> grid = source.gridVertex.empty() ? std::nullopt : byGrid(rig, mirror);
  if (!source.gridVertex.empty()) {
    if (!grid)
      writeChunk(out, "ordr", sourceOrder(source.gridVertex));
    else if (grid->order)
      writeChunk(out, "walk", *grid->order);
  }
  if (hasFaces(faces))
    grid ? writeChunk(out, "face", grid->faces) : writeChunk(out, "poly", polygons(faces));
  if (!faces.texcoords.empty() || !faces.cornerTexcoords.empty())
    writeTexcoords(out, faces, grid ? grid->images : std::vector<Index>{}, textureBits);
  if (!source.quadCorners.empty() && !(grid && hasFaces(faces)))
    writeChunk(out, "quad", quadCorners(source));
}

}  // namespace sweepface::codec
