#include <algorithm>
#include <bit>

#include "sweepface/codec.hpp"

#include "codec/blocks.hpp"
#include "codec/bones.hpp"
#include "codec/chunks.hpp"
#include "codec/coefficients.hpp"
#include "codec/encoding.hpp"
#include "codec/lattice.hpp"
#include "codec/likeness.hpp"
#include "codec/name_coder.hpp"
#include "codec/names.hpp"
#include "codec/pose_form.hpp"
#include "codec/turns.hpp"
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
  return ranged([&](auto& out) { writeWireframe(out, wireframe, {packing.axis, packing.mirror}); });
}

std::string targetNames(const std::vector<Target>& targets) {
  return ranged([&](auto& out) {
    NameCoder names(out);
    for (const Target& target : targets) names.code(target.name);
  });
}

bool isSame(const Vec3& a, const Vec3& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

// The coefficients of all poses, and the vectors that they do not reproduce.
struct Poses {
  std::vector<Coefficients> coefficients;
  std::vector<std::vector<Index>> exact;

  // `lattice` learns the neutral.
  Poses(const Rig& rig, const Packing& packing, Lattice& lattice) : packing_(packing) {
    for (Index pose = 0; pose < static_cast<Index>(packing.poses.size()); ++pose) {
      const bool edited = pose == 0 && !packing.rest.empty();
      Coded coded = code(pose, edited ? packing.rest : rig.vectorsOf(pose), lattice);
      if (pose == 0 && packing.poses.size() > 1)
        lattice.learn(rig.surface, coded.restored, stepOf(packing, 0));
      if (pose == 0) bones_ = Bones(rig.surface, packing, coded.restored);
      exact.push_back(differing(rig.vectorsOf(pose), coded.restored));
      coefficients.push_back(std::move(coded.q));
    }
  }

 private:
  struct Coded {
    Coefficients q;
    std::vector<Vec3> restored;
  };
  Coded code(Index pose, const std::vector<Vec3>& vectors, const Lattice& lattice) const {
    const double step = stepOf(packing_, pose);
    const auto& carries = packing_.poses[pose].carries;
    Coded coded{Coefficients(vectors.size()), std::vector<Vec3>(vectors.size())};
    if (!(step > 0)) return coded;
    coded.q = lattice.round(pose, bones_.beyond(carries, vectors), step);
    lattice.restore(pose, coded.q, step, coded.restored);
    bones_.add(carries, 1, coded.restored);
    // If most vectors are not multiples of the steps, coefficients only cost bytes.
    if (2 * differing(vectors, coded.restored).size() > vectors.size()) {
      coded.q.assign(vectors.size(), Steps3{});
      coded.restored.assign(vectors.size(), Vec3{});
      bones_.add(carries, 1, coded.restored);
    }
    return coded;
  }
  static std::vector<Index> differing(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    std::vector<Index> result;
    for (Index v = 0; v < static_cast<Index>(a.size()); ++v)
      if (!isSame(a[v], b[v])) result.push_back(v);
    return result;
  }

  const Packing& packing_;
  Bones bones_;
};

// Writes the poses from `first` up to `end`, 0 being the neutral.
std::string writePoses(Poses& poses, const Packing& packing, const Lattice& lattice,
                       const Likenesses& likenesses, Index first, Index end) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  CoefficientCoder<RangeEncoder> vectors(lattice.hierarchy(), coder, lattice.axis(), first == 0);
  std::vector<Index> hangs = packing.bones;
  const Index bones = first > 0 ? codeBones(out, lattice.hierarchy(), hangs) : 0;
  for (Index pose = first; pose < end; ++pose) {
    Packing::Pose form = packing.poses[pose];
    codePose(out, form, pose);
    Likeness like = likenesses.of(pose);
    codeLikeness(out, form, like, pose);
    codeCarries(out, bones, form.carries);
    vectors.code(poses.coefficients[pose], symmetryOf(form, pose),
                 partnerOf(packing, lattice, poses.coefficients, pose),
                 hintsOf(like, lattice, poses.coefficients));
  }
  return coder.finish();
}

std::string exactVectors(const Rig& rig, const Poses& poses) {
  Writer out;
  Index before = -1;
  for (Index pose = 0; pose < static_cast<Index>(poses.exact.size()); ++pose) {
    const std::vector<Index>& places = poses.exact[pose];
    if (places.empty()) continue;
    out.number(static_cast<std::uint64_t>(pose - before - 1));
    before = pose;
    out.number(places.size());
    Index last = -1;
    std::vector<Vec3> values;
    for (const Index v : places) {
      out.signedNumber(v - last - 1);
      last = v;
      values.push_back(rig.vectorsOf(pose)[v]);
    }
    writeVectors(out, values, Precision::exact);
  }
  return out.take();
}

bool movesLoose(const Target& target) {
  return std::ranges::any_of(target.looseDifference, [](const Vec3& v) { return v != Vec3{}; });
}

void writeDrift(Writer& out, const std::vector<Target>& targets) {
  for (const Target& target : targets) writeVectors(out, target.looseDifference, Precision::exact);
}

/// Writes a chunk of what `write(to)` writes.
template <typename Write>
void writeChunkOf(Writer& out, std::string_view kind, Write write) {
  Writer to;
  write(to);
  writeChunk(out, kind, to.take());
}

}  // namespace
}  // namespace codec

std::string encode(const Rig& rig) {
  using namespace codec;
  if (!rig.knowsTargets()) {
    Rig still = rig;
    for (Target& target : still.targets) {
      target.difference.resize(rig.neutral.size());
      target.looseDifference.resize(rig.source.loose.size());
    }
    return encode(still);
  }
  Writer out;
  writeHeader(out);
  Packing packing = sound(rig);
  const Mirror mirror =
      spreadMirror(rig.surface.wireframe(), rig.surface.connectivity(), packing.mirror);
  Lattice lattice(rig.surface, packing, mirror);
  levelOut(lattice.hierarchy(), packing.bones);
  Poses poses(rig, packing, lattice);
  const Likenesses likenesses(lattice, poses.coefficients);
  const auto count = static_cast<Index>(packing.poses.size());
  writeChunk(out, "BASE", base(rig, packing));
  writeChunk(out, "GRID", grid(rig.surface.wireframe(), packing));
  if (count > 1) writeChunk(out, "TNAM", targetNames(rig.targets));
  writeChunk(out, "REST", writePoses(poses, packing, lattice, likenesses, 0, 1));
  if (count > 1) writeChunk(out, "MOVE", writePoses(poses, packing, lattice, likenesses, 1, count));
  if (const std::string exact = exactVectors(rig, poses); !exact.empty())
    writeChunk(out, "EXAC", exact);
  if (!rig.source.loose.empty()) {
    writeChunkOf(out, "loos",
                 [&](Writer& to) { writeVectors(to, rig.source.loose, Precision::exact); });
    if (std::ranges::any_of(rig.targets, movesLoose))
      writeChunkOf(out, "drif", [&](Writer& to) { writeDrift(to, rig.targets); });
  }
  writeSource(out, rig, mirror, packing.textureBits);
  if (!rig.scene.empty()) writeChunkOf(out, "scen", [&](Writer& to) { to.text(rig.scene); });
  if (hasNames(rig.names))
    writeChunkOf(out, "name", [&](Writer& to) { writeNames(to, rig.names); });
  if (const auto turns = storedTurns(rig); !turns.empty())
    writeChunkOf(out, "turn", [&](Writer& to) { writeTurns(to, turns); });
  writeChunk(out, "END ", {});
  return out.take();
}

}  // namespace sweepface
