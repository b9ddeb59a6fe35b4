#include <algorithm>
#include <span>

#include "sweepface/codec.hpp"

#include "codec/blocks.hpp"
#include "codec/chunks.hpp"
#include "codec/faces.hpp"
#include "codec/lattice.hpp"
#include "codec/limits.hpp"
#include "codec/names.hpp"
#include "codec/source_coder.hpp"
#include "codec/wire_version1.hpp"
#include "codec/wireframe_coder.hpp"

namespace sweepface {

namespace codec {
namespace {

std::string base(const Rig& rig, const Packing& packing) {
  Writer out;
  out.f64(rig.tolerance);
  out.f64(packing.neutralStep);
  out.f64(packing.targetStep);
  out.number(rig.targets.size());
  out.number(rig.source.loose.size());
  return out.take();
}

std::string grid(const Wireframe& wireframe, const Packing& packing) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  writeWireframe(out, wireframe);
  const auto halves = static_cast<std::uint32_t>(2 * wireframe.arcs.size());
  out.index(kMirrorAxis, 3, static_cast<std::uint32_t>(packing.axis));
  out.number(kMirrorCount, 0, 0, packing.mirror.size());
  for (const auto& pair : packing.mirror)
    for (const HalfArc h : pair) out.index(kMirrorArc, halves, static_cast<std::uint32_t>(h));
  return coder.finish();
}

std::string names(const std::vector<Target>& targets) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  for (const Target& target : targets) codeName(out, target.name);
  return coder.finish();
}

// Poses from `first` up to `end`, 0 the neutral.
std::string poses(const Rig& rig, const Packing& packing, const Lattice& lattice, Index first,
                  Index end) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  CoefficientCoder<RangeEncoder> vectors(lattice.hierarchy(), coder, lattice.axis());
  std::vector<Coefficients> all(end);
  for (Index pose = first; pose < end; ++pose) {
    Packing::Pose form = packing.poses[pose];
    codePose(out, form, pose);
    all[pose] = lattice.round(pose == 0 ? rig.neutral : rig.targets[pose - 1].difference,
                              stepOf(packing, pose));
    vectors.code(all[pose], symmetryOf(form, pose), partnerOf(packing, all, pose), pose == 0);
  }
  return coder.finish();
}

std::string vectors(const std::vector<Vec3>& vectors, Precision precision) {
  Writer out;
  writeVectors(out, vectors, precision);
  return out.take();
}

std::string drift(const std::vector<Target>& targets) {
  Writer out;
  for (const Target& target : targets) writeVectors(out, target.looseDifference, Precision::exact);
  return out.take();
}

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

template <typename Write>
std::string ranged(Write write) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  write(out);
  return coder.finish();
}

// By the grid of the patches, unless that is so large that a reader would not trust so few bytes.
void writeSource(Writer& out, const Rig& rig, int textureBits) {
  const SourceMesh& source = rig.source;
  const Polygons& faces = source.polygons;
  const std::size_t quads = gridQuads(rig.surface.wireframe());
  const auto trusted = [&](const std::string& bytes) {
    return quads <= within(kMostQuads, kQuadsAByte, kQuadsAnyway, bytes.size());
  };
  std::string order, polygonBytes;
  bool byGrid = quads <= kMostQuads;
  if (byGrid) {
    const LevelOne grid(rig.surface);
    order = ranged([&](auto& symbols) { writeOrder(symbols, grid, source); });
    polygonBytes = ranged([&](auto& symbols) { writeFaces(symbols, grid, source); });
    byGrid = trusted(order) && trusted(polygonBytes);
  }
  if (!source.gridVertex.empty())
    byGrid ? writeChunk(out, "walk", order)
           : writeChunk(out, "ordr", sourceOrder(source.gridVertex));
  if (hasFaces(faces))
    byGrid ? writeChunk(out, "face", polygonBytes) : writeChunk(out, "poly", polygons(faces));
  if (!faces.texcoords.empty() || !faces.cornerTexcoords.empty()) {
    if (textureBits > 0)
      writeChunk(out, "text",
                 ranged([&](auto& symbols) { writeTexture(symbols, faces, textureBits); }));
    else
      writeChunk(out, "texc", texcoords(faces));
  }
  if (!source.quadCorners.empty() && !(byGrid && hasFaces(faces)))
    writeChunk(out, "quad", quadCorners(source));
}

}  // namespace
}  // namespace codec

std::string encode(const Rig& rig) {
  using namespace codec;
  const SourceMesh& source = rig.source;
  Writer out;
  writeHeader(out);
  const Packing packing = completed(rig);
  const Lattice lattice(rig.surface, packing);
  writeChunk(out, "BASE", base(rig, packing));
  writeChunk(out, "GRID", grid(rig.surface.wireframe(), packing));
  if (!rig.targets.empty()) writeChunk(out, "NAME", names(rig.targets));
  writeChunk(out, "REST", poses(rig, packing, lattice, 0, 1));
  if (!rig.targets.empty())
    writeChunk(out, "MOVE",
               poses(rig, packing, lattice, 1, static_cast<Index>(rig.targets.size()) + 1));
  if (!source.loose.empty()) {
    writeChunk(out, "loos", vectors(source.loose, Precision::exact));
    if (!rig.targets.empty()) writeChunk(out, "drif", drift(rig.targets));
  }
  writeSource(out, rig, packing.textureBits);
  writeChunk(out, "END ", {});
  return out.take();
}

}  // namespace sweepface
