#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sweepface/vec.hpp"

// The tables of an Evaluator. Rows (positions or derivatives of vertices) are divided into tiles of
// 32 vertices that are near each other. Within a tile, the rows of all poses are combinations of a
// few modes:
//
//   row(v) = neutral(v) + scale · Σ_m basis(v, m) · c_m,   c_m = Σ_k weight_k · coefficient(m, k)
//
// Basis, coefficients and weights are 16-bit integers and their sums are exact in 32 bits, so that
// every instruction set gives the same bits. Where 8 bits suffice, they are used for the
// coefficients of targets that move a tile little, and for the basis of later modes, which add
// little.
namespace sweepface {

inline constexpr int kTileVertices = 32;
inline constexpr int kGroup = 16;  // rows or coefficients processed together
inline constexpr int kMostRows = 64;
inline constexpr int kMostBlocks = 3 * kMostRows / kGroup;

// Weights within [-1, 1] are in units of 2⁻¹⁴. The coefficients of a mode's component add up to no
// more than kMostSum over all targets, so that their weighted sum fits 32 bits; shifted right by 16
// bits, that sum is c_m. The basis of a row adds up to no more than kMostBasis over all modes.
inline constexpr int kWeightUnit = 1 << 14;
inline constexpr double kMostSum = 131000, kMostBasis = 65000, kMostShort = 32767;
inline constexpr int kMostShift = 12;  // of 8-bit coefficients
inline constexpr int kBasisShift = 8;  // of an 8-bit basis

/// The head of a tile's record, followed by
///   pairs         [blocks] BlockPairs
///   shifts        [blocks][16] uint8: of 8-bit coefficients
///   targets       [2 × pairs] uint16, those with 16-bit coefficients first
///   coefficients  [blocks]: coefficients 16b to 16b + 15 in block b, two targets side by side:
///                 [wide][16 × 2] int16 and then [narrow][16 × 2] int8 · 2^shift;
///                 coefficient 6p + 2c + h is component c of mode 2p + h
///   basis         [groups][modePairs][16 × 2], two modes side by side: int16, and from
///                 wideModePairs on int8 in units of 2⁸
///   neutral       [groups][3][16] int16 · step + origin
///   vertices      [32] uint16 or uint32: where they go
struct TileHead {
  std::uint32_t bytes = 0;  ///< of the whole record
  float scale = 0;
  std::uint32_t coefficientsAt = 0, basisAt = 0, neutralAt = 0;  ///< offsets in the record
  std::uint16_t pairs = 0, widePairs = 0;                        ///< of targets
  std::uint8_t vertices = 0, groups = 0;
  std::uint8_t modePairs = 0, wideModePairs = 0;
  std::uint8_t blocks = 0, wideVertices = 0;  ///< whether vertices are uint32
  std::array<std::uint8_t, 2> unused{};
  float step = 0;
  std::array<float, 3> origin{};
  std::uint64_t windows = 0;  ///< bit k: a target is in 64k ... 64k + 63; 0 if any is beyond
};
static_assert(sizeof(TileHead) == 56);

/// How many pairs of targets have coefficients in a block: the first `wide` of those with 16 bits,
/// and the first `narrow` of those with 8.
struct BlockPairs {
  std::uint16_t wide = 0, narrow = 0;
};

inline constexpr std::size_t kNeutralBytes = 6 * kGroup;  // of a group

/// Bytes of a group's basis.
inline std::size_t basisBytes(const TileHead& head) {
  return 2 * kGroup * (std::size_t(head.modePairs) + head.wideModePairs);
}

/// Pointers to the parts of a tile's record.
struct Tile {
  const TileHead* head = nullptr;
  const BlockPairs* pairs = nullptr;
  const std::uint8_t* shifts = nullptr;
  const std::uint16_t* targets = nullptr;
  const std::byte* coefficients = nullptr;
  const std::byte* basis = nullptr;
  const std::int16_t* neutral = nullptr;
  const std::byte* vertices = nullptr;
};

inline std::uint32_t vertexOf(const Tile& tile, int k) {
  if (tile.head->wideVertices) return reinterpret_cast<const std::uint32_t*>(tile.vertices)[k];
  return reinterpret_cast<const std::uint16_t*>(tile.vertices)[k];
}

constexpr std::size_t roundUp32(std::size_t bytes) { return (bytes + 31) / 32 * 32; }
inline std::size_t roundUp64(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

inline Tile tileAt(const std::byte* record) {
  const auto* head = reinterpret_cast<const TileHead*>(record);
  const auto* pairs = reinterpret_cast<const BlockPairs*>(head + 1);
  const auto* shifts = reinterpret_cast<const std::uint8_t*>(pairs + head->blocks);
  return {head,
          pairs,
          shifts,
          reinterpret_cast<const std::uint16_t*>(shifts + kGroup * head->blocks),
          record + head->coefficientsAt,
          record + head->basisAt,
          reinterpret_cast<const std::int16_t*>(record + head->neutralAt),
          record + head->neutralAt + kNeutralBytes * head->groups};
}

/// Records, one after another. Once the table is finished, the first starts at a cache line.
class TileTable {
 public:
  explicit TileTable(int groups = 0) : groups_(groups) {}
  TileTable(TileTable&&) = default;

  int groups() const { return groups_; }  ///< of 16 rows in a tile
  Index tileCount() const { return static_cast<Index>(starts_.size()); }
  const std::byte* record(Index tile) const { return memory_.data() + first_ + starts_[tile]; }
  std::size_t bytes() const { return size_; }

  /// Adds room for one more record, all zero, and returns it.
  std::byte* add(std::size_t bytes);
  void finish();

 private:
  int groups_;
  std::vector<std::byte> memory_;
  std::size_t first_ = 0, size_ = 0;  // bytes before and of the records
  std::vector<std::size_t> starts_;
};

/// How far the tables may be from what they represent.
struct TableErrors {
  std::vector<double> ofTarget;  ///< [weights] at weight 1
  double rounding = 0;           ///< in addition, for weights within [-1, 1]
};

/// The data of an Evaluator.
struct EvaluatorTables {
  Index vertices = 0, weights = 0;
  TileTable positions{2};
  TileTable derivatives{4};  ///< 32 rows of ∂u and 32 of ∂v per tile
  TableErrors positionErrors, derivativeErrors;
};

}  // namespace sweepface
