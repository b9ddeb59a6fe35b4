#include <algorithm>
#include <cmath>
#include <numeric>

#include "codec/blocks.hpp"
#include "codec/decoding.hpp"
#include "codec/limits.hpp"
#include "codec/name_coder.hpp"
#include "codec/pose_form.hpp"
#include "codec/source_coder.hpp"
#include "codec/turns.hpp"
#include "codec/wire_version1.hpp"
#include "codec/wireframe_coder.hpp"

namespace sweepface::codec {

namespace {

void readBase(Decoding& d, Reader& in) {
  d.rig.tolerance = in.f64();
  if (d.rig.tolerance < 0) in.refuse("the tolerance is negative");
  Packing& packing = d.rig.packing;
  packing.neutralStep = in.f64();
  packing.targetStep = in.f64();
  if (packing.neutralStep < 0 || packing.targetStep < 0) in.refuse("a step is negative");
  d.targets = in.size();
  d.loose = in.size();
}

// All that follows of a chunk, through a range decoder.
template <typename Read>
void decodeRest(Reader& in, Read read) {
  const std::string_view payload = in.raw(in.left());
  if (payload.ends_with('\0')) in.refuse("the chunk goes on after its last value");
  RangeDecoder coder(payload);
  Symbols<RangeDecoder> symbols(coder);
  if (in.ok()) read(coder, symbols);
  if (!symbols.ok()) in.refuse(symbols.problem());
  if (!coder.exhausted()) in.refuse("the chunk goes on after its last value");
}

void readGrid(Decoding& d, Reader& in) {
  // A patch, an arc or a node takes a fraction of a bit at best.
  const std::size_t most = std::min(d.memory / kBytesAPatch,
                                    within(kMostPatches, kPatchesAByte, kPatchesAnyway, in.left()));
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    MirrorSeeds mirror;
    d.wireframe = readWireframe(symbols, most, kMostGridVertices, mirror);
    d.rig.packing.axis = mirror.axis;
    d.rig.packing.mirror = std::move(mirror.pairs);
  });
  if (!in.ok()) return;
  d.makeSurface(in);
  if (!in.ok()) return;
  // What is still costs nothing, so that memory is limited here.
  if (d.targets + 1 > kMostVectors / std::max<std::size_t>(1, d.stored) ||
      (d.targets + 1) * d.stored > kVectorsAByte * d.fileSize + kVectorsAnyway)
    return in.refuse("there are more targets than the file can hold");
  if (!d.afford(in, (d.targets + 1) * d.stored, kBytesAVector)) return;
  d.lattice.emplace(d.rig.surface, d.rig.packing);
}

void readTargetNames(Decoding& d, Reader& in) {
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    NameCoder names(symbols);
    for (std::size_t k = 0; k < d.targets && symbols.ok() && in.ok(); ++k) {
      const std::string name = names.code("");
      if (d.afford(in, name.size(), kBytesALetter)) d.addTarget(in, name);
    }
  });
}

void readPose(Decoding& d, Symbols<RangeDecoder>& symbols, CoefficientCoder<RangeDecoder>& vectors,
              std::vector<Coefficients>& poses, Index pose, std::vector<Vec3>& out) {
  Packing::Pose& form = d.rig.packing.poses[pose];
  codePose(symbols, form, pose);
  if (!symbols.ok()) return;
  Likeness like;
  codeLikeness(symbols, form, like, pose);
  if (!symbols.ok()) return;
  poses[pose].resize(d.stored);
  vectors.code(poses[pose], symmetryOf(form, pose),
               partnerOf(d.rig.packing, *d.lattice, poses, pose), movedIn(like, *d.lattice, poses),
               pose == 0);
  out.resize(d.stored);
  if (!d.lattice->restore(pose, poses[pose], stepOf(d.rig.packing, pose), out))
    symbols.refuse("a coordinate is not finite");
}

void readRest(Decoding& d, Reader& in) {
  decodeRest(in, [&](RangeDecoder& coder, Symbols<RangeDecoder>& symbols) {
    d.rig.packing.poses.resize(1);
    CoefficientCoder<RangeDecoder> vectors(d.lattice->hierarchy(), coder, d.lattice->axis(),
                                           kNeutralMemory);
    std::vector<Coefficients> poses(1);
    readPose(d, symbols, vectors, poses, 0, d.rig.neutral);
  });
}

void readMoves(Decoding& d, Reader& in) {
  if (d.rig.targets.size() < d.targets) return in.refuse("the targets have no names");
  if (d.targets > 0) d.lattice->learn(d.rig.surface, d.rig.neutral, stepOf(d.rig.packing, 0));
  decodeRest(in, [&](RangeDecoder& coder, Symbols<RangeDecoder>& symbols) {
    d.rig.packing.poses.resize(d.targets + 1);
    CoefficientCoder<RangeDecoder> vectors(d.lattice->hierarchy(), coder, d.lattice->axis(),
                                           kTargetMemory);
    std::vector<Coefficients> poses(d.targets + 1);
    for (std::size_t k = 0; k < d.targets && symbols.ok(); ++k)
      readPose(d, symbols, vectors, poses, static_cast<Index>(k) + 1, d.rig.targets[k].difference);
  });
  for (Target& target : d.rig.targets) target.looseDifference.resize(d.loose);
}

std::size_t mostQuads(const Reader& in) {
  return within(kMostQuads, kQuadsAByte, kQuadsAnyway, in.left());
}

// What is told by the grid of the patches takes less than a bit each; its size is checked here.
template <typename Read>
void readByGrid(Decoding& d, Reader& in, Read read) {
  const std::size_t most = mostQuads(in);
  if (d.quads > most) return in.refuse("the patches have too many vertices for so few bytes");
  if (!d.levelOne) {
    if (!d.afford(in, d.quads, kBytesAQuad)) return;
    const Surface& surface = d.rig.surface;
    d.levelOne.emplace(
        surface, spreadMirror(surface.wireframe(), surface.connectivity(), d.rig.packing.mirror));
  }
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    read(symbols, *d.levelOne, most, d.rig.source);
  });
}
void readWalk(Decoding& d, Reader& in) { readByGrid(d, in, readOrder); }

// Without an order the vertices are those of the grid.
void readGridFaces(Decoding& d, Reader& in) {
  readByGrid(d, in, [](auto& symbols, const LevelOne& grid, std::size_t most, SourceMesh& source) {
    if (source.gridVertex.empty()) {
      source.gridVertex.resize(static_cast<std::size_t>(grid.vertexCount()));
      std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
    }
    readFaces(symbols, grid, most, source);
  });
}

void readTextureSteps(Decoding& d, Reader& in) {
  const std::size_t most = mostQuads(in);
  SourceMesh& source = d.rig.source;
  const std::vector<Index> images =
      d.levelOne ? cornerImages(d.levelOne->mirror(), source) : std::vector<Index>{};
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    readTexture(symbols, most, source.polygons, images, d.rig.packing.textureBits);
  });
}

void readTargetTurns(Decoding& d, Reader& in) { d.rig.turns = readTurns(in, d.rig.targets.size()); }

}  // namespace

std::span<const ChunkHandler> version2() {
  static constexpr ChunkHandler kReaders[] = {
      {readBase, true}, {readGrid, true}, {readTargetNames},  {readRest, true}, {readMoves},
      {readExact},      {readLoose},      {readDrift},        {readWalk},       {readSourceOrder},
      {readGridFaces},  {readPolygons},   {readTextureSteps}, {readTexcoords},  {readQuadCorners},
      {readScene},      {readThingNames}, {readTargetTurns},  {readEnd}};
  return kReaders;
}

}  // namespace sweepface::codec
