#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include "sweepface/codec.hpp"

#include "codec/blocks.hpp"
#include "codec/chunks.hpp"
#include "codec/faces.hpp"
#include "codec/lattice.hpp"
#include "codec/limits.hpp"
#include "codec/names.hpp"
#include "codec/source_coder.hpp"
#include "codec/utf8.hpp"
#include "codec/wire_version1.hpp"
#include "codec/wireframe_coder.hpp"

namespace sweepface {

namespace codec {
namespace {

class Decoder {
 public:
  Decoder(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Result<Rig> run() {
    const auto chunks = readChunks(bytes_, name_);
    if (!chunks) return std::unexpected(chunks.error());
    kinds_ = kindsOf(chunks->version);
    handlers_ = chunks->version == 1 ? kHandlers1 : kHandlers2;
    for (const Chunk& chunk : chunks->list) {
      if (chunk.rank < 0) continue;
      if (auto ok = admit(chunk); !ok) return std::unexpected(ok.error());
      if (auto ok = readChunk(chunk); !ok) return std::unexpected(ok.error());
    }
    return std::move(rig_);
  }

 private:
  struct Handler {
    void (Decoder::*read)(Reader&);
    bool required = false, repeated = false;
  };
  static const Handler kHandlers1[], kHandlers2[];

  std::unexpected<Error> failAt(const Chunk& chunk, std::size_t byte,
                                const std::string& what) const {
    return fail(name_ + ", chunk '" + std::string(kinds_[chunk.rank].code) + "', byte " +
                std::to_string(byte) + ": " + what + "; convert the source again.");
  }

  // Chunks come in the order of the registry; targets of version 1 as many as the head says.
  Result<void> admit(const Chunk& chunk) {
    if (chunk.rank < rank_ || (chunk.rank == rank_ && !handlers_[chunk.rank].repeated))
      return failAt(chunk, chunk.offset, "it comes twice or out of its order");
    for (int rank = rank_ + 1; rank < chunk.rank; ++rank)
      if (handlers_[rank].required)
        return failAt(chunk, chunk.offset,
                      "chunk '" + std::string(kinds_[rank].code) + "' is missing before it");
    if (rank_ >= 0 && handlers_[rank_].repeated && chunk.rank > rank_ &&
        rig_.targets.size() < targets_)
      return failAt(chunk, chunk.offset, "targets are missing before it");
    rank_ = chunk.rank;
    return {};
  }

  Result<void> readChunk(const Chunk& chunk) {
    Reader in(chunk.payload, chunk.offset);
    (this->*handlers_[chunk.rank].read)(in);
    if (in.left() > 0) in.refuse("the chunk goes on after its last value");
    if (!in.ok()) return failAt(chunk, in.place(), in.problem());
    return {};
  }

  // ---- Version 2 ----

  void base(Reader& in) {
    rig_.tolerance = in.f64();
    if (rig_.tolerance < 0) in.refuse("the tolerance is negative");
    rig_.packing.neutralStep = in.f64();
    rig_.packing.targetStep = in.f64();
    if (!(rig_.packing.neutralStep > 0) || !(rig_.packing.targetStep > 0))
      in.refuse("a step is not positive");
    targets_ = in.size();
    looseCount_ = in.size();
  }

  // All that follows of a chunk, through a range decoder.
  template <typename Read>
  void decodeRest(Reader& in, Read read) {
    RangeDecoder coder(in.raw(in.left()));
    Symbols<RangeDecoder> symbols(coder);
    if (in.ok()) read(coder, symbols);
    if (!symbols.ok()) in.refuse(symbols.problem());
    if (!coder.exhausted()) in.refuse("the chunk goes on after its last value");
  }

  void grid(Reader& in) {
    // A patch, an arc or a node takes a fraction of a bit at best.
    const std::size_t most = within(kMostPatches, kPatchesAByte, kPatchesAnyway, in.left());
    decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
      Wireframe wireframe = readWireframe(symbols, most, kMostGridVertices);
      const auto halves = static_cast<std::uint32_t>(2 * wireframe.arcs.size());
      rig_.packing.axis = static_cast<int>(symbols.index(kMirrorAxis, 3, 0));
      auto& pairs = rig_.packing.mirror;
      pairs.resize(std::min<std::size_t>(symbols.number(kMirrorCount, 0, 0, 0), halves));
      for (auto& pair : pairs)
        for (HalfArc& h : pair) h = static_cast<HalfArc>(symbols.index(kMirrorArc, halves, 0));
      if (!symbols.ok()) return;
      quads_ = gridQuads(wireframe);
      auto surface = Surface::make(std::move(wireframe));
      if (!surface) return symbols.refuse("the wireframe is unsound: " + surface.error().message);
      rig_.surface = std::move(*surface);
    });
    if (!in.ok()) return;
    stored_ = static_cast<std::size_t>(rig_.surface.storedCount());
    // What is still costs nothing, so that memory is limited here.
    if (targets_ + 1 > kMostVectors / std::max<std::size_t>(1, stored_) ||
        (targets_ + 1) * stored_ > kVectorsAByte * bytes_.size() + kVectorsAnyway)
      return in.refuse("there are more targets than the file can hold");
    lattice_.emplace(rig_.surface, rig_.packing);
  }

  void names(Reader& in) {
    decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
      for (std::size_t k = 0; k < targets_ && symbols.ok(); ++k) {
        Target target;
        target.name = codeName(symbols, "");
        if (target.name.empty() || !isUtf8(target.name))
          symbols.refuse("the target's name is empty or not UTF-8");
        if (!allNames_.insert(target.name).second)
          symbols.refuse("there are two targets named '" + target.name + "'");
        rig_.targets.push_back(std::move(target));
      }
    });
  }

  void rest(Reader& in) {
    decodeRest(in, [&](RangeDecoder& coder, Symbols<RangeDecoder>& symbols) {
      rig_.packing.poses.resize(1);
      CoefficientCoder<RangeDecoder> vectors(lattice_->hierarchy(), coder, lattice_->axis());
      std::vector<Coefficients> poses(1);
      readPose(symbols, vectors, poses, 0, rig_.neutral);
    });
  }

  void moves(Reader& in) {
    decodeRest(in, [&](RangeDecoder& coder, Symbols<RangeDecoder>& symbols) {
      rig_.packing.poses.resize(targets_ + 1);
      CoefficientCoder<RangeDecoder> vectors(lattice_->hierarchy(), coder, lattice_->axis());
      std::vector<Coefficients> poses(targets_ + 1);
      for (std::size_t k = 0; k < targets_ && symbols.ok(); ++k)
        readPose(symbols, vectors, poses, static_cast<Index>(k) + 1, rig_.targets[k].difference);
    });
    for (Target& target : rig_.targets) target.looseDifference.resize(looseCount_);
  }

  void readPose(Symbols<RangeDecoder>& symbols, CoefficientCoder<RangeDecoder>& vectors,
                std::vector<Coefficients>& poses, Index pose, std::vector<Vec3>& out) {
    Packing::Pose& form = rig_.packing.poses[pose];
    codePose(symbols, form, pose);
    if (!symbols.ok()) return;
    poses[pose].resize(stored_);
    vectors.code(poses[pose], symmetryOf(form, pose), partnerOf(rig_.packing, poses, pose),
                 pose == 0);
    out.resize(stored_);
    lattice_->restore(poses[pose], stepOf(rig_.packing, pose), out);
    if (!std::ranges::all_of(out, isFinite)) symbols.refuse("a coordinate is not finite");
  }

  // What is told by the grid of the patches takes less than a bit each; its size is checked here.
  const LevelOne* levelOne(Reader& in) {
    if (quads_ > within(kMostQuads, kQuadsAByte, kQuadsAnyway, in.left())) {
      in.refuse("the patches have too many vertices for so few bytes");
      return nullptr;
    }
    if (!levelOne_) levelOne_.emplace(rig_.surface);
    return &*levelOne_;
  }

  void walk(Reader& in) {
    const LevelOne* grid = levelOne(in);
    const std::size_t most = within(kMostQuads, kQuadsAByte, kQuadsAnyway, in.left());
    if (grid)
      decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
        readOrder(symbols, *grid, most, rig_.source);
      });
  }

  void faces(Reader& in) {
    const LevelOne* grid = levelOne(in);
    const std::size_t most = within(kMostQuads, kQuadsAByte, kQuadsAnyway, in.left());
    if (grid)
      decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
        readFaces(symbols, *grid, most, rig_.source);
      });
  }

  void texture(Reader& in) {
    const std::size_t most = within(kMostQuads, kQuadsAByte, kQuadsAnyway, in.left());
    decodeRest(in, [&](RangeDecoder&, Symbols<RangeDecoder>& symbols) {
      readTexture(symbols, most, rig_.source.polygons, rig_.packing.textureBits);
    });
  }

  void drift(Reader& in) {
    for (Target& target : rig_.targets)
      target.looseDifference = readVectors<Vec3>(in, looseCount_, Precision::exact);
    if (rig_.source.loose.empty()) in.refuse("there are no loose vertices that could move");
  }

  // ---- Version 1 ----

  void head(Reader& in) {
    rig_.tolerance = in.f64();
    if (rig_.tolerance < 0) in.refuse("the tolerance is negative");
    stored_ = in.size();
    targets_ = in.size();
    looseCount_ = in.size();
  }

  void wireframe(Reader& in) { wireframe_ = readWireframe(in); }

  void shapes(Reader& in) {
    const std::size_t count = in.size();
    if (count / 8 > in.left()) in.refuse("there are more ribbons than the chunk can hold");
    if (!in.ok()) return;
    wireframe_.ribbons.resize(count);
    const std::vector<bool> chosen = readMask(in, count);
    for (std::size_t r = 0; r < count && in.ok(); ++r)
      if (chosen[r]) wireframe_.ribbons[r] = {in.f64(), in.f64(), in.f64()};
    if (in.ok()) makeSurface(in);
  }

  void makeSurface(Reader& in) {
    quads_ = gridQuads(wireframe_);
    auto surface = Surface::make(std::move(wireframe_));
    if (!surface) return in.refuse("the wireframe is unsound: " + surface.error().message);
    rig_.surface = std::move(*surface);
    if (static_cast<std::size_t>(rig_.surface.storedCount()) != stored_)
      in.refuse("the wireframe stores " + std::to_string(rig_.surface.storedCount()) +
                " vectors and the file " + std::to_string(stored_));
  }

  void neutral(Reader& in) { rig_.neutral = readVectors<Vec3>(in, stored_, Precision::single); }

  void target(Reader& in) {
    if (rig_.targets.size() == targets_) in.refuse("there are more targets than announced");
    Target target;
    const std::string_view name = in.text();
    if (name.empty() || !isUtf8(name)) in.refuse("the target's name is empty or not UTF-8");
    if (!names_.insert(name).second)
      in.refuse("there are two targets named '" + std::string(name) + "'");
    target.name = name;
    target.difference = readVectors<Vec3>(in, stored_, Precision::single);
    target.looseDifference = readVectors<Vec3>(in, looseCount_, Precision::exact);
    rig_.targets.push_back(std::move(target));
  }

  void loose(Reader& in) {
    rig_.source.loose = readVectors<Vec3>(in, looseCount_, Precision::exact);
  }

  void sourceOrder(Reader& in) {
    auto& order = rig_.source.gridVertex;
    order.resize(in.count(1, "vertices"));
    const std::int64_t low = -static_cast<std::int64_t>(rig_.source.loose.size());
    const std::int64_t high = gridVertices();
    Index last = -1;
    for (Index& v : order) v = last = in.step(last + 1, low, high, "vertex");
  }

  // One vertex a point, one a T-node, and those within arcs and patches.
  std::int64_t gridVertices() const {
    const Wireframe& w = rig_.surface.wireframe();
    std::vector<bool> seen(w.points);
    std::int64_t count = 0;
    for (const Node& node : w.nodes) {
      count += node.point < 0 || !seen[node.point];
      if (node.point >= 0) seen[node.point] = true;
    }
    for (const Arc& arc : w.arcs) count += arc.collapsed ? 0 : arc.edges - 1;
    for (Index p = 0; p < rig_.surface.patchCount(); ++p)
      count += (rig_.surface.edgesU(p) - std::int64_t{1}) * (rig_.surface.edgesV(p) - 1);
    return count;
  }

  void polygons(Reader& in) {
    Polygons& faces = rig_.source.polygons;
    readFaceSizes(in, faces);
    const auto vertices = static_cast<Index>(rig_.source.gridVertex.size());
    faces.corners.resize(in.ok() ? faces.faceStart.back() : 0);
    Index last = 0;
    for (Index& v : faces.corners) v = last = in.step(last, 0, vertices, "vertex");
    faces.materials = readTexts(in, "materials");
    faces.faceMaterial = readFaceNames(in, faces, faces.materials);
    faces.groups = readTexts(in, "groups");
    faces.faceGroup = readFaceNames(in, faces, faces.groups);
    faces.materialFiles = readTexts(in, "material files");
  }

  // Every corner takes a byte of what follows, so that many faces need many bytes.
  static void readFaceSizes(Reader& in, Polygons& faces) {
    const std::size_t most = in.left();
    const auto sizes = readRuns(in, 3, INT32_MAX, most, "size of a face");
    std::int64_t corners = 0;
    for (Index size : sizes) {
      corners += size;
      if (corners > static_cast<std::int64_t>(most))
        return in.refuse("the faces have too many corners");
      faces.faceStart.push_back(static_cast<Index>(corners));
    }
  }

  static std::vector<Index> readFaceNames(Reader& in, const Polygons& faces,
                                          const std::vector<std::string>& names) {
    const auto count = static_cast<std::size_t>(faces.faceCount());
    auto chosen = readRuns(in, -1, static_cast<Index>(names.size()), count, "name of a face");
    if (!chosen.empty() && chosen.size() != count) in.refuse("some faces have no name");
    return chosen;
  }

  void texcoords(Reader& in) {
    Polygons& faces = rig_.source.polygons;
    const std::size_t count = in.size();
    faces.texcoords = readVectors<Vec2>(in, count, Precision::exact);
    if (in.number(0, 2, "flag") == 0) return;
    if (faces.corners.size() > in.left()) in.refuse("texture coordinates of corners are missing");
    if (!in.ok()) return;
    faces.cornerTexcoords.resize(faces.corners.size());
    Index last = -1;
    for (Index& t : faces.cornerTexcoords)
      t = last =
          in.step(last, -1, static_cast<Index>(faces.texcoords.size()), "texture coordinate");
  }

  void quadCorners(Reader& in) {
    if (quads_ > in.left()) return in.refuse("corners of quads are missing");
    const Polygons& faces = rig_.source.polygons;
    const auto corners = static_cast<Index>(faces.corners.size());
    Index first = 0;
    for (std::size_t q = 0; q < quads_ && in.ok(); ++q) {
      const std::int64_t told = in.signedNumber();
      std::array<Index, 4> quad = aroundQuad(faces, -1);
      const std::int64_t moved = first + (told >> 1);
      if (moved < 0 || moved >= corners) return in.refuse("a corner is out of range");
      quad[0] = first = static_cast<Index>(moved);
      if (told & 1)
        for (int k = 1; k < 4; ++k) quad[k] = in.step(quad[k - 1], 0, corners, "corner");
      else
        quad = aroundQuad(faces, first);
      if (quad[3] < 0) return in.refuse("a quad goes around a face that has not four corners");
      rig_.source.quadCorners.insert(rig_.source.quadCorners.end(), quad.begin(), quad.end());
    }
  }

  void end(Reader& in) {
    if (rig_.targets.size() < targets_) in.refuse("targets are missing");
    for (const Target& target : rig_.targets)
      if (target.difference.size() != stored_) in.refuse("the targets' vectors are missing");
    if (rig_.source.loose.size() != looseCount_) in.refuse("the loose vertices are missing");
  }

  std::string_view bytes_;
  std::string name_;
  std::span<const Kind> kinds_;
  const Handler* handlers_ = nullptr;
  int rank_ = -1;  // of the last chunk
  std::size_t stored_ = 0, targets_ = 0, looseCount_ = 0;
  std::size_t quads_ = 0;
  std::set<std::string_view> names_;
  std::set<std::string> allNames_;
  std::optional<Lattice> lattice_;
  std::optional<LevelOne> levelOne_;
  Wireframe wireframe_;
  Rig rig_;
};

const Decoder::Handler Decoder::kHandlers1[] = {{&Decoder::head, true},
                                                {&Decoder::wireframe, true},
                                                {&Decoder::shapes, true},
                                                {&Decoder::neutral, true},
                                                {&Decoder::target, false, true},
                                                {&Decoder::loose},
                                                {&Decoder::sourceOrder},
                                                {&Decoder::polygons},
                                                {&Decoder::texcoords},
                                                {&Decoder::quadCorners},
                                                {&Decoder::end}};
const Decoder::Handler Decoder::kHandlers2[] = {
    {&Decoder::base, true},  {&Decoder::grid, true},  {&Decoder::names},    {&Decoder::rest, true},
    {&Decoder::moves},       {&Decoder::loose},       {&Decoder::drift},    {&Decoder::walk},
    {&Decoder::sourceOrder}, {&Decoder::faces},       {&Decoder::polygons}, {&Decoder::texture},
    {&Decoder::texcoords},   {&Decoder::quadCorners}, {&Decoder::end}};

}  // namespace
}  // namespace codec

Result<Rig> decode(std::string_view bytes, std::string_view name) {
  return codec::Decoder(bytes, name).run();
}

}  // namespace sweepface
