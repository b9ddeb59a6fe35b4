#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "morphs.hpp"

// Other ways to blend morph targets: the kernels of engines, as fast as they get.
namespace sweepface::bench {

/// How many floats are blended at once; arrays are padded to a multiple of it.
inline constexpr std::size_t kChunk = 64;

/// The most targets that the kernels have room for.
inline constexpr std::size_t kMostTargets = 1024;

/// The most floats that they have room for: blocks of 16 are numbered in 16 bits.
inline constexpr std::size_t kMostFloats = 16 * 65536;

/// 64-byte aligned memory.
template <typename T>
class Aligned {
 public:
  explicit Aligned(std::size_t size = 0);
  Aligned(const std::vector<T>& from);
  T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }

 private:
  std::shared_ptr<T> data_;
  std::size_t size_;
};

/// Everything a kernel may read. Chunk q holds floats [64q, 64q + 64) of all vertices.
struct PeerData {
  std::size_t chunks = 0, targets = 0;
  Aligned<float> neutral{0};
  std::vector<float> steps;  ///< [targets] the value of 1 in 16 bits
  float step = 0;            ///< the same for all targets together

  Aligned<float> floats{0};             ///< dense: [chunks][targets][64]
  Aligned<std::int16_t> shorts{0};      ///< dense: the same; sparse: only what is kept
  std::vector<std::uint32_t> starts;    ///< [chunks + 1] or [targets + 1], in what is kept
  std::vector<std::uint16_t> places;    ///< kept: the target, or the block of 16 floats
  std::vector<std::uint32_t> vertices;  ///< kept: where the vertex's floats begin
  std::vector<float> vectors;           ///< [vertices × 3]

  std::size_t bytes() const;
};

/// A way to store morph targets and to blend them.
struct Peer {
  std::string name;
  PeerData data;
  void (*run)(const PeerData& data, const double* weights, float* out);
};

/// All kinds are made from the same arrays; a vertex, block or chunk of a target is kept if any
/// difference in it is at least its value in `drops`.
enum class PeerKind { dense32, dense16, sparse32, block16, chunk16, paired16 };
inline constexpr PeerKind kPeerKinds[] = {PeerKind::dense32, PeerKind::dense16, PeerKind::sparse32,
                                          PeerKind::block16, PeerKind::chunk16, PeerKind::paired16};
Peer makePeer(PeerKind kind, const Floats& neutral, const std::vector<Floats>& differences,
              std::span<const float> drops);

/// Normalises contiguous vectors.
void normalise(float* vectors, std::size_t count);

}  // namespace sweepface::bench
