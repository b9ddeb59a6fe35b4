#include <algorithm>
#include <numeric>

#include "codec/blocks.hpp"
#include "codec/bones.hpp"
#include "codec/coefficients.hpp"
#include "codec/decoding.hpp"
#include "codec/grid_size.hpp"
#include "codec/limits.hpp"
#include "codec/name_coder.hpp"
#include "codec/pose_form.hpp"
#include "codec/source_coder.hpp"
#include "codec/turns.hpp"
#include "codec/wireframe_coder.hpp"

namespace sweepface::codec {

namespace {

void readBase(Decoding& d, Reader& in) {
  d.rig->tolerance = in.f64();
  if (d.rig->tolerance < 0) in.refuse("the tolerance is negative");
  Packing& packing = d.rig->packing;
  packing.neutralStep = in.f64();
  packing.targetStep = in.f64();
  if (packing.neutralStep < 0 || packing.targetStep < 0) in.refuse("a step is negative");
  d.targets = in.size();
  d.loose = in.size();
  d.affordTargets(in);
}

// Decodes the rest of a chunk with a range decoder.
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
  // A patch, an arc or a node may take only a fraction of a bit.
  const std::size_t most = std::min(
      d.memory / kBytesAPatch, within(kMostPatches, kPatchesAByte, kPatchesAnyway, d.fileSize));
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    CodedWireframe coded = readWireframe(symbols, most, kMostGridVertices);
    d.wireframe = std::move(coded.wireframe);
    d.connectivity = std::move(coded.connectivity);
    d.mirror = std::move(coded.mirror);
    d.rig->packing.axis = coded.seeds.axis;
    d.rig->packing.mirror = std::move(coded.seeds.pairs);
  });
  if (!in.ok() || !d.afford(in, d.wireframe.patches.size(), kBytesAPatch)) return;
  d.makeSurface(in);
  if (!in.ok()) return;
  if (d.affordVectors(in, d.stored, kBytesAVector))
    d.lattice.emplace(d.rig->surface, d.rig->packing, d.mirror);
}

void readTargetNames(Decoding& d, Reader& in) {
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    NameCoder names(symbols);
    std::size_t left = within(kMostLetters, kLettersAByte, kLettersAnyway, d.fileSize);
    for (std::size_t k = 0; k < d.targets && symbols.ok() && in.ok(); ++k) {
      const std::string name = names.code("");
      if (name.size() > left) return symbols.refuse("its names are too long for so few bytes");
      left -= name.size();
      if (d.afford(in, name.size(), kBytesALetter)) d.addTarget(in, name);
    }
  });
}

// Reads poses one after another. All but the current one are kept as sparse lists of what moves,
// which is little.
class PoseReader {
 public:
  PoseReader(Decoding& d, Reader& in, RangeDecoder& coder, Symbols<RangeDecoder>& symbols,
             bool neutral, std::size_t bytes)
      : d_(d),
        in_(in),
        lattice_(*d.lattice),
        symbols_(symbols),
        vectors_(lattice_.hierarchy(), coder, lattice_.axis(), neutral),
        current_(d.stored),
        moved_(d.targets + 1) {
    vectors_.setMostBits(kBitsAnyway + kBitsAByte * bytes);
  }

  void readBones() { bones_ = codeBones(symbols_, lattice_.hierarchy(), d_.rig->packing.bones); }

  void read(Index pose) {
    Packing& packing = d_.rig->packing;
    Packing::Pose& form = packing.poses[pose];
    codePose(symbols_, form, pose);
    if (!symbols_.ok()) return;
    Likeness like;
    codeLikeness(symbols_, form, like, pose);
    vectors_.countBits(codeCarries(symbols_, bones_, form.carries));
    if (!d_.afford(in_, form.carries.size(), kBytesACarry)) symbols_.refuse(kTooMuchMemory);
    if (!symbols_.ok()) return;
    vectors_.code(current_, symmetryOf(form, pose), partnerOf(packing, lattice_, moved_, pose),
                  hintsOf(like, lattice_, moved_));
    if (vectors_.hasTooManyBits()) symbols_.refuse("its numbers are too large for so few bytes");
    moved_[pose] = movedIn(current_);
    for (const Moved& m : moved_[pose]) current_[m.vector] = {};
  }

  // Restores the vectors, once all poses are read.
  void restore(Index first, Index end) {
    std::vector<Lattice::Restored> poses;
    for (Index pose = first; pose < end; ++pose) {
      std::vector<Vec3>& vectors = d_.rig->vectorsOf(pose);
      vectors.resize(d_.stored);
      poses.push_back({moved_[pose], stepOf(d_.rig->packing, pose), vectors});
    }
    bool fits = lattice_.restore(lattice_.prediction(first), poses);
    const Bones bones(d_.rig->surface, d_.rig->packing, d_.rig->neutral);
    for (Index pose = first; pose < end; ++pose)
      fits &= bones.add(d_.rig->packing.poses[pose].carries, 1, poses[pose - first].vectors);
    if (!fits) symbols_.refuse("a coordinate is too large");
  }

 private:
  Decoding& d_;
  Reader& in_;
  const Lattice& lattice_;
  Symbols<RangeDecoder>& symbols_;
  CoefficientCoder<RangeDecoder> vectors_;
  Coefficients current_;       // [S] of the pose being read; zero between poses
  std::vector<Sparse> moved_;  // [poses]
  Index bones_ = 0;
};

// Reads the poses from `first` up to `end`, 0 being the neutral.
void readPoses(Decoding& d, Reader& in, Index first, Index end) {
  const std::size_t bytes = in.left();
  decodeRest(in, [&](RangeDecoder& coder, Symbols<RangeDecoder>& symbols) {
    d.rig->packing.poses.resize(end);
    PoseReader poses(d, in, coder, symbols, first == 0, bytes);
    if (first > 0) poses.readBones();
    for (Index pose = first; pose < end && symbols.ok(); ++pose) poses.read(pose);
    if (symbols.ok()) poses.restore(first, end);
  });
}

void readRest(Decoding& d, Reader& in) { readPoses(d, in, 0, 1); }

void readMoves(Decoding& d, Reader& in) {
  if (d.rig->targets.size() < d.targets) return in.refuse("the targets have no names");
  if (d.targets > 0) d.lattice->learn(d.rig->surface, d.rig->neutral, stepOf(d.rig->packing, 0));
  readPoses(d, in, 1, static_cast<Index>(d.targets) + 1);
}

// The number of entries beyond the grid that may be read.
std::size_t affordable(const Decoding& d, const Reader& in) {
  return std::min(mostEntries(in.left()), d.memory / kBytesAnEntry);
}

// Entries coded by the grid of the patches take less than a bit each, so its size is checked here.
template <typename Read>
void readByGrid(Decoding& d, Reader& in, Read read) {
  if (d.quads > mostEntries(in.left()))
    return in.refuse("the patches have too many vertices for so few bytes");
  if (!d.levelOne) {
    if (!d.afford(in, d.quads, kBytesAQuad)) return;
    d.levelOne.emplace(d.rig->surface, d.mirror);
  }
  const std::size_t most = affordable(d, in);
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    read(symbols, *d.levelOne, most, d.rig->source);
  });
}
void readWalk(Decoding& d, Reader& in) { readByGrid(d, in, readOrder); }

// Without a source order the vertices are those of the grid.
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
  const std::size_t most = affordable(d, in);
  SourceMesh& source = d.rig->source;
  const std::vector<Index> images =
      d.levelOne ? cornerImages(d.levelOne->mirror(), source) : std::vector<Index>{};
  decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
    readTexture(symbols, most, source.polygons, images, d.rig->packing.textureBits);
  });
}

void readTargetTurns(Decoding& d, Reader& in) {
  // A turn takes at least a byte.
  if (d.afford(in, in.left(), sizeof(Turn))) d.rig->turns = readTurns(in, d.rig->targets.size());
}

}  // namespace

std::span<const ChunkHandler> version2() {
  static constexpr ChunkHandler kReaders[] = {{readBase, true},
                                              {readGrid, true},
                                              {readTargetNames},
                                              {readRest, true},
                                              {readMoves},
                                              {readExact},
                                              {readLoose},
                                              {readDrift},
                                              {readWalk},
                                              {readSourceOrder, false, false, "walk"},
                                              {readGridFaces},
                                              {readPolygons, false, false, "face"},
                                              {readTextureSteps},
                                              {readTexcoords, false, false, "text"},
                                              {readQuadCorners, false, false, "face"},
                                              {readScene},
                                              {readThingNames},
                                              {readTargetTurns},
                                              {readEnd}};
  return kReaders;
}

}  // namespace sweepface::codec
