#include <algorithm>
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

// A quad that goes once around a face of four corners is told by its first one alone.
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

// Whether a reader takes so much from so few bytes.
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

}  // namespace

// By the grid of the patches, unless there is so much that a reader would not trust so few bytes.
void writeSource(Writer& out, const Rig& rig, const Mirror& mirror, int textureBits) {
  const SourceMesh& source = rig.source;
  const Polygons& faces = source.polygons;
  const std::size_t quads = rig.surface.wireframe().quadCount();
  SourceMesh again;  // as a reader has it
  again.loose = source.loose;
  std::string order, polygonBytes;
  std::vector<Index> images;
  bool byGrid = quads <= kMostQuads, ownOrder = !source.gridVertex.empty();
  if (byGrid) {
    const LevelOne grid(rig.surface, mirror);
    order = ranged([&](auto& symbols) { writeOrder(symbols, grid, source); });
    polygonBytes = ranged([&](auto& symbols) { writeFaces(symbols, grid, source); });
    byGrid =
        quads <= mostEntries(std::min(order.size(), polygonBytes.size())) &&
        isReadable(order, [&](auto& in, auto most) { readOrder(in, grid, most, again); }) &&
        isReadable(polygonBytes, [&](auto& in, auto most) { readFaces(in, grid, most, again); });
    if (byGrid && hasFaces(faces)) images = cornerImages(grid.mirror(), source);
    if (byGrid && hasFaces(faces) && countsUp(grid, source)) ownOrder = false;
  }
  if (ownOrder)
    byGrid ? writeChunk(out, "walk", order)
           : writeChunk(out, "ordr", sourceOrder(source.gridVertex));
  if (hasFaces(faces))
    byGrid ? writeChunk(out, "face", polygonBytes) : writeChunk(out, "poly", polygons(faces));
  if (!faces.texcoords.empty() || !faces.cornerTexcoords.empty()) {
    std::string texture;
    if (textureBits > 0 && holdsTexture(faces, textureBits))
      texture = ranged([&](auto& to) { writeTexture(to, faces, images, textureBits); });
    again.polygons = faces;
    again.polygons.texcoords.clear();
    again.polygons.cornerTexcoords.clear();
    const auto readAgain = [&](auto& in, auto most) {
      int bits = textureBits;
      readTexture(in, most, again.polygons, images, bits);
    };
    if (!texture.empty() && isReadable(texture, readAgain))
      writeChunk(out, "text", texture);
    else
      writeChunk(out, "texc", texcoords(faces));
  }
  if (!source.quadCorners.empty() && !(byGrid && hasFaces(faces)))
    writeChunk(out, "quad", quadCorners(source));
}

}  // namespace sweepface::codec
