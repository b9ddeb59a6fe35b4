#pragma once

#include <cstddef>
#include <cstdint>

namespace sweepface::codec {

/// `eachByte` for each of `bytes` plus `anyway`, but at most `most`.
constexpr std::size_t within(std::size_t most, std::size_t eachByte, std::size_t anyway,
                             std::size_t bytes) {
  return bytes > (most - anyway) / eachByte ? most : eachByte * bytes + anyway;
}

/// Vectors of all poses that a file may ask for, since vectors that do not move take no bytes.
inline constexpr std::size_t kMostVectors = std::size_t{1} << 25, kVectorsAByte = 1024,
                             kVectorsAnyway = std::size_t{1} << 20;

/// Bits of all coefficients and carries of a chunk, without leading zeros. If all are alike they
/// take hardly any bytes, but they do take time.
inline constexpr std::uint64_t kBitsAByte = 1024, kBitsAnyway = std::uint64_t{1} << 22;

/// Letters of all targets' names. Repeated text takes hardly any bytes, but it does take time.
inline constexpr std::size_t kMostLetters = std::size_t{1} << 28, kLettersAByte = 128,
                             kLettersAnyway = std::size_t{1} << 20;

/// Nodes, arcs and patches that a wireframe may have.
inline constexpr std::size_t kMostPatches = std::size_t{1} << 19, kPatchesAByte = 256,
                             kPatchesAnyway = 16384;

/// Pairs of half-arcs from which a mirror image spreads: one for each part that has two sides.
inline constexpr std::size_t kMostMirrorPairs = 64;

/// Quads of the grid at level 1 by which the source's order and faces may be coded.
inline constexpr std::size_t kMostQuads = std::size_t{1} << 22, kQuadsAByte = 1024,
                             kQuadsAnyway = std::size_t{1} << 20;

/// Entries of the source's order, faces or texture that so many bytes may hold.
constexpr std::size_t mostEntries(std::size_t bytes) {
  return within(kMostQuads, kQuadsAByte, kQuadsAnyway, bytes);
}

/// Memory in bytes while a file is read, rounded up from measurements, of a patch with its nodes
/// and arcs, a stored vector of a pose, a quad at level 1 with its corners, a letter of a name,
/// what a bone carries in a pose, and a ribbon that no patch has.
inline constexpr std::size_t kBytesAPatch = 4000, kBytesAVector = 40, kBytesAQuad = 400,
                             kBytesALetter = 4, kBytesACarry = 128, kBytesARibbon = 64;

/// The same for any other entry of the source's order, faces and texture. A name counts as this
/// many letters.
inline constexpr std::size_t kBytesAnEntry = 64, kLettersAName = 8;

/// Most bits of texture coordinates.
inline constexpr int kMostTextureBits = 24;

/// Vectors coded in steps are refused if they exceed some 10²⁵, since weights could take them
/// beyond the range of a float. The test is that a sum of them times this factor is infinite.
inline constexpr double kScaleToMost = 1e283;

/// Most bytes of a target's name.
inline constexpr std::size_t kLongestName = 4096;

}  // namespace sweepface::codec
