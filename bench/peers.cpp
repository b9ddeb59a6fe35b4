#include "peers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

#include "peer_kernels.hpp"

namespace sweepface::bench {

template <typename T>
Aligned<T>::Aligned(std::size_t size)
    : data_(static_cast<T*>(std::aligned_alloc(64, (size * sizeof(T) + 127) / 64 * 64)), std::free),
      size_(size) {
  std::fill_n(data_.get(), size, T{});
}
template <typename T>
Aligned<T>::Aligned(const std::vector<T>& from) : Aligned(from.size()) {
  std::ranges::copy(from, data_.get());
}
template class Aligned<float>;
template class Aligned<std::int16_t>;

std::size_t PeerData::bytes() const {
  return neutral.bytes() + sizeof(float) * (steps.size() + vectors.size()) + floats.bytes() +
         shorts.bytes() + sizeof(std::uint32_t) * (starts.size() + vertices.size()) +
         sizeof(std::uint16_t) * places.size();
}

namespace {

constexpr std::size_t kBlock = 16;

/// The differences, padded to whole chunks.
class Source {
 public:
  Source(const std::vector<Floats>& differences, std::span<const float> drops)
      : differences_(differences), drops_(drops) {}

  float at(std::size_t target, std::size_t i) const {
    return i < drops_.size() ? differences_[target][i] : 0.0f;
  }
  bool keeps(std::size_t target, std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < std::min(first + count, drops_.size()); ++i)
      if (std::abs(differences_[target][i]) >= drops_[i]) return true;
    return false;
  }
  float largest(std::size_t target) const {
    float most = 1e-9f;
    for (const float x : differences_[target]) most = std::max(most, std::abs(x));
    return most;
  }
  std::size_t vertices() const { return drops_.size() / 3; }

 private:
  const std::vector<Floats>& differences_;
  std::span<const float> drops_;
};

std::int16_t toShort(float x, float step) {
  return static_cast<std::int16_t>(std::lround(x / step));
}

void fillDense(const Source& source, PeerData& data, bool shorts) {
  const std::size_t size = data.chunks * data.targets * kChunk;
  if (shorts)
    data.shorts = Aligned<std::int16_t>(size);
  else
    data.floats = Aligned<float>(size);
  std::size_t to = 0;
  for (std::size_t q = 0; q < data.chunks; ++q)
    for (std::size_t k = 0; k < data.targets; ++k)
      for (std::size_t i = 0; i < kChunk; ++i, ++to) {
        const float x = source.at(k, kChunk * q + i);
        if (shorts)
          data.shorts.data()[to] = toShort(x, data.steps[k]);
        else
          data.floats.data()[to] = x;
      }
}

void fillSparse(const Source& source, PeerData& data) {
  data.starts.push_back(0);
  for (std::size_t k = 0; k < data.targets; ++k) {
    for (std::size_t v = 0; v < source.vertices(); ++v)
      if (source.keeps(k, 3 * v, 3)) {
        data.vertices.push_back(static_cast<std::uint32_t>(3 * v));
        for (std::size_t c = 0; c < 3; ++c) data.vectors.push_back(source.at(k, 3 * v + c));
      }
    data.starts.push_back(static_cast<std::uint32_t>(data.vertices.size()));
  }
}

void fillBlocks(const Source& source, PeerData& data) {
  std::vector<std::int16_t> kept;
  data.starts.push_back(0);
  for (std::size_t k = 0; k < data.targets; ++k) {
    for (std::size_t b = 0; b < data.chunks * kChunk / kBlock; ++b)
      if (source.keeps(k, kBlock * b, kBlock)) {
        data.places.push_back(static_cast<std::uint16_t>(b));
        for (std::size_t i = 0; i < kBlock; ++i)
          kept.push_back(toShort(source.at(k, kBlock * b + i), data.steps[k]));
      }
    data.starts.push_back(static_cast<std::uint32_t>(data.places.size()));
  }
  data.shorts = kept;
}

void fillChunks(const Source& source, PeerData& data) {
  std::vector<std::int16_t> kept;
  data.starts.push_back(0);
  for (std::size_t q = 0; q < data.chunks; ++q) {
    for (std::size_t k = 0; k < data.targets; ++k)
      if (source.keeps(k, kChunk * q, kChunk)) {
        data.places.push_back(static_cast<std::uint16_t>(k));
        for (std::size_t i = 0; i < kChunk; ++i)
          kept.push_back(toShort(source.at(k, kChunk * q + i), data.steps[k]));
      }
    data.starts.push_back(static_cast<std::uint32_t>(data.places.size()));
  }
  data.shorts = kept;
}

/// Interleaves targets in pairs, for dot products of 16-bit integers; an odd one is paired with one
/// whose weight is always 0.
void fillPairs(const Source& source, PeerData& data) {
  std::vector<std::int16_t> kept;
  data.starts.push_back(0);
  for (std::size_t q = 0; q < data.chunks; ++q) {
    std::vector<std::size_t> targets;
    for (std::size_t k = 0; k < data.targets; ++k)
      if (source.keeps(k, kChunk * q, kChunk)) targets.push_back(k);
    if (targets.size() % 2 == 1) targets.push_back(data.targets);
    for (std::size_t p = 0; p < targets.size(); p += 2)
      for (std::size_t i = 0; i < kChunk; ++i)
        for (const std::size_t k : {targets[p], targets[p + 1]})
          kept.push_back(k < data.targets ? toShort(source.at(k, kChunk * q + i), data.step)
                                          : std::int16_t(0));
    for (const std::size_t k : targets) data.places.push_back(static_cast<std::uint16_t>(k));
    data.starts.push_back(static_cast<std::uint32_t>(data.places.size() / 2));
  }
  data.places.resize(data.places.size() + 64);  // padding, as they are read in whole vectors
  data.shorts = kept;
}

/// A common step with which no sum of weighted differences overflows 32 bits.
float commonStep(const Source& source, std::size_t targets, std::size_t floats) {
  float step = 0;
  for (std::size_t k = 0; k < targets; ++k) step = std::max(step, source.largest(k) / 32767);
  for (std::size_t i = 0; i < floats; ++i) {
    float sum = 0;
    for (std::size_t k = 0; k < targets; ++k) sum += std::abs(source.at(k, i));
    step = std::max(step, sum / 130000);
  }
  return step;
}

}  // namespace

Peer makePeer(PeerKind kind, const Floats& neutral, const std::vector<Floats>& differences,
              std::span<const float> drops) {
  const Source source(differences, drops);
  Peer peer;
  PeerData& data = peer.data;
  data.chunks = (neutral.size() + kChunk - 1) / kChunk;
  data.targets = differences.size();
  data.neutral = Aligned<float>(data.chunks * kChunk);
  std::ranges::copy(neutral, data.neutral.data());
  for (std::size_t k = 0; k < data.targets; ++k) data.steps.push_back(source.largest(k) / 32767);
  data.step = commonStep(source, data.targets, neutral.size());
  switch (kind) {
    case PeerKind::dense32:
      fillDense(source, data, false);
      peer.name = "dense float32", peer.run = runDense32;
      break;
    case PeerKind::dense16:
      fillDense(source, data, true);
      peer.name = "dense int16", peer.run = runDense16;
      break;
    case PeerKind::sparse32:
      fillSparse(source, data);
      peer.name = "index+delta", peer.run = runSparse32;
      break;
    case PeerKind::block16:
      fillBlocks(source, data);
      peer.name = "block-sparse int16", peer.run = runBlock16;
      break;
    case PeerKind::chunk16:
      fillChunks(source, data);
      peer.name = "chunk-sparse int16", peer.run = runChunk16;
      break;
    case PeerKind::paired16:
      fillPairs(source, data);
      peer.name = "chunk-sparse paired int16", peer.run = runPaired16;
      break;
  }
  return peer;
}

}  // namespace sweepface::bench
