#include <set>

#include "sweepface/codec.hpp"

#include "codec/blocks.hpp"
#include "codec/chunks.hpp"
#include "codec/faces.hpp"
#include "codec/names.hpp"
#include "codec/utf8.hpp"
#include "codec/wire.hpp"

namespace sweepface {

namespace codec {
namespace {

class Decoder {
 public:
  Decoder(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Result<Rig> run() {
    const auto chunks = readChunks(bytes_, name_);
    if (!chunks) return std::unexpected(chunks.error());
    for (const Chunk& chunk : *chunks) {
      if (chunk.rank < 0) continue;
      if (auto ok = admit(chunk); !ok) return std::unexpected(ok.error());
      if (auto ok = readChunk(chunk); !ok) return std::unexpected(ok.error());
    }
    return std::move(rig_);
  }

 private:
  std::unexpected<Error> failAt(const Chunk& chunk, std::size_t byte,
                                const std::string& what) const {
    return fail(name_ + ", chunk '" + std::string(kKinds[chunk.rank].code) + "', byte " +
                std::to_string(byte) + ": " + what + "; convert the source again.");
  }

  // Chunks come in the order of the registry, targets as many as the head says.
  Result<void> admit(const Chunk& chunk) {
    static constexpr int kCreases = 2, kTarget = 5, kRequired = 5;
    if (chunk.rank < rank_ || (chunk.rank == rank_ && chunk.rank != kTarget))
      return failAt(chunk, chunk.offset, "it comes twice or out of its order");
    const int due = rank_ + 1 == kCreases && chunk.rank != kCreases ? kCreases + 1 : rank_ + 1;
    if (chunk.rank > due && due < kRequired)
      return failAt(chunk, chunk.offset,
                    "chunk '" + std::string(kKinds[due].code) + "' is missing before it");
    if (chunk.rank > kTarget && rig_.targets.size() < targets_)
      return failAt(chunk, chunk.offset, "targets are missing before it");
    rank_ = chunk.rank;
    return {};
  }

  Result<void> readChunk(const Chunk& chunk) {
    static constexpr void (Decoder::* read[kKinds.size()])(Reader&) = {
        &Decoder::head,     &Decoder::wireframe, &Decoder::creases,     &Decoder::shapes,
        &Decoder::neutral,  &Decoder::target,    &Decoder::loose,       &Decoder::sourceOrder,
        &Decoder::polygons, &Decoder::texcoords, &Decoder::quadCorners, &Decoder::scene,
        &Decoder::names,    &Decoder::end};
    Reader in(chunk.payload, chunk.offset);
    (this->*read[chunk.rank])(in);
    if (in.left() > 0) in.refuse("the chunk goes on after its last value");
    if (!in.ok()) return failAt(chunk, in.place(), in.problem());
    return {};
  }

  void head(Reader& in) {
    rig_.tolerance = in.f64();
    if (rig_.tolerance < 0) in.refuse("the tolerance is negative");
    stored_ = in.size();
    targets_ = in.size();
    looseCount_ = in.size();
  }

  void wireframe(Reader& in) { wireframe_ = readWireframe(in); }

  void creases(Reader& in) {
    const auto arcs = static_cast<Index>(wireframe_.arcs.size());
    Index last = -1;
    for (std::size_t count = in.count(1, "creases"); count > 0 && in.ok(); --count) {
      const Index arc = in.step(last, last + std::int64_t{1}, arcs, "crease");
      if (in.ok()) wireframe_.arcs[last = arc].crease = true;
    }
  }

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

  void scene(Reader& in) { rig_.scene = in.text(); }
  void names(Reader& in) { rig_.names = readNames(in, rig_.surface.wireframe()); }

  void end(Reader& in) {
    if (rig_.source.loose.size() != looseCount_) in.refuse("the loose vertices are missing");
  }

  std::string_view bytes_;
  std::string name_;
  int rank_ = -1;  // of the last chunk
  std::size_t stored_ = 0, targets_ = 0, looseCount_ = 0;
  std::size_t quads_ = 0;
  std::set<std::string_view> names_;
  Wireframe wireframe_;
  Rig rig_;
};

}  // namespace
}  // namespace codec

Result<Rig> decode(std::string_view bytes, std::string_view name) {
  return codec::Decoder(bytes, name).run();
}

}  // namespace sweepface
