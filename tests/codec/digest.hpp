#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

// One number for everything that a decoder returns: it is the same wherever a face is read the
// same, bit for bit. Uses only what playback needs, so that it works in WebAssembly as well.
namespace sweepface::testing {

/// FNV-1a (Fowler, Noll and Vo) over eight-byte numbers, lowest byte first.
class Digest {
 public:
  std::uint64_t value() const { return value_; }

  void add(std::uint64_t number) {
    for (int k = 0; k < 8; ++k) value_ = (value_ ^ (number >> 8 * k & 255)) * 0x100000001b3;
  }
  void add(Index number) { add(static_cast<std::uint64_t>(std::int64_t{number})); }
  void add(bool flag) { add(std::uint64_t{flag}); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec2& v) { add(v.x), add(v.y); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  template <typename T, std::size_t kCount>
  void add(const std::array<T, kCount>& list) {
    for (const T& item : list) add(item);
  }
  template <typename T>
  void add(const std::vector<T>& list) {
    add(std::uint64_t{list.size()});
    for (const T& item : list) add(item);
  }

  void add(const Node& n) { add(n.point), add(Index{n.stored}); }
  void add(const Arc& a) {
    for (const Index number : {a.from, a.to, a.edges, a.ribbon}) add(number);
    add(a.collapsed), add(a.crease);
  }
  void add(const Patch& p) { add(p.sides); }
  void add(const Shape& s) { add(s.rho), add(s.eta), add(s.lambda); }
  void add(const Wireframe& w) {
    add(w.points), add(w.nodes), add(w.arcs), add(w.patches), add(w.loops), add(w.ribbons);
  }
  void add(const Target& t) { add(t.name), add(t.difference), add(t.looseDifference); }
  void add(const Turn& t) { add(t.target), add(t.pivot), add(t.axis); }
  void add(const Polygons& p) {
    add(p.faceStart), add(p.corners), add(p.texcoords), add(p.cornerTexcoords), add(p.materials);
    add(p.faceMaterial), add(p.groups), add(p.faceGroup), add(p.materialFiles);
  }
  void add(const SourceMesh& s) {
    add(s.gridVertex), add(s.ownOrder), add(s.loose), add(s.polygons), add(s.quadCorners);
  }
  void add(const Packing::Carry& c) {
    add(c.bone);
    for (const auto& by : c.by)
      for (const std::int32_t x : by) add(Index{x});
  }
  void add(const Packing::Pose& p) { add(Index{p.finer}), add(p.image), add(p.carries); }
  void add(const Packing& p) {
    add(p.neutralStep), add(p.targetStep), add(Index{p.axis}), add(p.mirror), add(p.poses);
    add(p.bones), add(p.rest), add(Index{p.textureBits});
  }
  void add(const Names& n) {
    add(n.units), add(n.nodes), add(n.curves), add(n.patches), add(n.ribbons);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// The digest of everything that was read.
inline std::uint64_t digestOf(const Rig& rig) {
  Digest digest;
  digest.add(rig.surface.wireframe()), digest.add(rig.neutral), digest.add(rig.targets);
  digest.add(rig.source), digest.add(rig.tolerance), digest.add(rig.scene), digest.add(rig.names);
  digest.add(rig.packing), digest.add(rig.turns);
  return digest.value();
}

/// The digest of the surface in one expression: positions and normals in double precision, at level
/// 2.
inline std::uint64_t digestOfSurface(const Rig& rig) {
  Weights weights;
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    weights.push_back(static_cast<double>(k % 7) / 8 + 0.125);
  const std::vector<Vec3> vectors = blend(rig, weights);
  const Tessellation points(rig.surface, 2);
  Digest digest;
  digest.add(points.positions(vectors)), digest.add(points.normals(vectors));
  return digest.value();
}

/// The number as sixteen hexadecimal digits.
inline std::string hexadecimal(std::uint64_t number) {
  std::string digits;
  for (int k = 16; k-- > 0;) digits += "0123456789abcdef"[number >> 4 * k & 15];
  return digits;
}

/// Both digests of a face, separated by a space.
inline std::string digestsOf(const Rig& rig) {
  return hexadecimal(digestOf(rig)) + ' ' + hexadecimal(digestOfSurface(rig));
}

}  // namespace sweepface::testing
