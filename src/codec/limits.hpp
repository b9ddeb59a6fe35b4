#pragma once

#include <cstddef>
#include <cstdint>

namespace sweepface::codec {

/// So much for each byte and something anyway, but no more than the most.
constexpr std::size_t within(std::size_t most, std::size_t eachByte, std::size_t anyway,
                             std::size_t bytes) {
  return bytes > (most - anyway) / eachByte ? most : eachByte * bytes + anyway;
}

/// Vectors of all poses that a file may ask for: still ones take no bytes.
inline constexpr std::size_t kMostVectors = std::size_t{1} << 25, kVectorsAByte = 1024,
                             kVectorsAnyway = std::size_t{1} << 20;

/// Bits of all coefficients and carries of a chunk, without leading zeros: where all are alike they
/// take hardly any bytes, but time.
inline constexpr std::uint64_t kBitsAByte = 1024, kBitsAnyway = std::uint64_t{1} << 22;

/// Letters of all targets' names: what comes again takes hardly any bytes, but time.
inline constexpr std::size_t kMostLetters = std::size_t{1} << 28, kLettersAByte = 128,
                             kLettersAnyway = std::size_t{1} << 20;

/// Nodes, arcs and patches that a wireframe may have.
inline constexpr std::size_t kMostPatches = std::size_t{1} << 19, kPatchesAByte = 256,
                             kPatchesAnyway = 16384;

/// Pairs of half-arcs from which a mirror image spreads: one for each part that has two sides.
inline constexpr std::size_t kMostMirrorPairs = 64;

/// Quads of the grid at level 1 that the source's order and faces may be told by.
inline constexpr std::size_t kMostQuads = std::size_t{1} << 22, kQuadsAByte = 1024,
                             kQuadsAnyway = std::size_t{1} << 20;

/// Entries of the source's order, faces or texture, told by so many bytes.
constexpr std::size_t mostEntries(std::size_t bytes) {
  return within(kMostQuads, kQuadsAByte, kQuadsAnyway, bytes);
}

/// What these take while a file is read, in bytes, rounded up from measurements: a patch with its
/// nodes and arcs, a stored vector of a pose, a quad at level 1 with its corners, a letter of a
/// name, and what a bone carries in a pose.
inline constexpr std::size_t kBytesAPatch = 4000, kBytesAVector = 40, kBytesAQuad = 400,
                             kBytesALetter = 4, kBytesACarry = 128;

/// The same for whatever else the source's order, faces and texture have; a name takes as much as
/// some letters.
inline constexpr std::size_t kBytesAnEntry = 64, kLettersAName = 8;

/// Of texture coordinates.
inline constexpr int kMostTextureBits = 24;

/// Vectors that are told in steps and come out beyond some 10²⁵ are refused, as weights would take
/// them beyond what a float holds: so much times a sum of theirs is infinite.
inline constexpr double kScaleToMost = 1e283;

/// Bytes of a target's name.
inline constexpr std::size_t kLongestName = 4096;

}  // namespace sweepface::codec
