#include <cstdint>

#include "sweepface/arcs.hpp"
#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"

#include "codec/chunks.hpp"
#include "codec/grid_size.hpp"
#include "codec/wire_version1.hpp"
#include "repaired.hpp"
#include "require.hpp"

namespace {

using namespace sweepface;
using fuzzing::repaired;
using fuzzing::require;

void play(const Surface& surface, const std::vector<Vec3>& vectors) {
  double sum = 0;  // whatever the vectors are, nothing may be read out of bounds
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (const double t : {0.0, 0.3, 1.0})
      sum += norm(surface.evaluate(vectors, {p, t * surface.edgesU(p), t * surface.edgesV(p)}));
  const auto arcs = static_cast<Index>(surface.wireframe().arcs.size());
  for (Index a = 0; a < arcs; ++a) sum += norm(surface.pointOnArc(vectors, a, 0.5));
  require(!(sum < 0));
}

/// A few bytes may stand for many vertices, which take long and reveal nothing more.
bool isSmall(const Wireframe& wireframe) { return wireframe.quadCount() < 2000; }

void play(const Rig& rig) {
  const Weights weights(rig.targets.size(), 0.5);
  const auto vectors = blend(rig, weights);
  play(rig.surface, vectors);
  if (!isSmall(rig.surface.wireframe())) return;
  const Tessellation grid(rig.surface, 1);
  require(sourcePositions(rig, grid, vectors, weights).size() == rig.source.gridVertex.size());
  for (Index v : rig.source.gridVertex) require(v < grid.vertexCount());
}

/// A wireframe alone gets further than in a file, where the number of vectors must be what it
/// stores.
void playWireframe(std::string_view payload) {
  codec::Reader in(payload, 0);
  Wireframe wireframe = codec::readWireframe(in);
  if (!in.ok()) return;
  wireframe.ribbons.resize(8);
  const auto surface = Surface::make(std::move(wireframe));
  if (surface) play(*surface, std::vector<Vec3>(surface->vectorCount()));
}

void requireSame(const SourceMesh& a, const SourceMesh& b) {
  const Polygons &p = a.polygons, &q = b.polygons;
  require(a.gridVertex == b.gridVertex && a.ownOrder == b.ownOrder && a.loose == b.loose);
  require(a.quadCorners == b.quadCorners);
  require(p.faceStart == q.faceStart && p.corners == q.corners);
  require(p.texcoords == q.texcoords && p.cornerTexcoords == q.cornerTexcoords);
  require(p.materials == q.materials && p.faceMaterial == q.faceMaterial);
  require(p.groups == q.groups && p.faceGroup == q.faceGroup);
  require(p.materialFiles == q.materialFiles);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = repaired({reinterpret_cast<const char*>(data), size});
  if (const auto chunks = codec::readChunks(bytes, "input.sweep"))
    for (const auto& chunk : chunks->list)
      if (chunks->version == 1 && chunk.rank == codec::rankOf("WIRE", 1))
        playWireframe(chunk.payload);
  const auto rig = decode(bytes, "input.sweep");
  const auto parts = fileParts(bytes, "input.sweep");
  if (!rig) {
    require(rig.error().message.starts_with("input.sweep"));
    return 0;
  }
  std::size_t sum = 0;
  for (const FilePart& part : parts.value()) sum += part.bytes;
  require(sum == bytes.size());
  play(*rig);
  if (!rig->turns.empty()) {
    Rig turning = *rig;
    addArcs(turning, turning.turns);
    play(turning);
  }

  // Decoded and encoded once more, the file stays as it is.
  const std::string again = encode(*rig);
  const auto back = decode(again, "again.sweep");
  require(back.has_value());
  require(back->neutral == rig->neutral && back->targets == rig->targets);
  require(back->turns == rig->turns && back->scene == rig->scene);
  require(back->names == rig->names && back->tolerance == rig->tolerance);
  requireSame(back->source, rig->source);
  require(encode(*back) == again);
  return 0;
}
