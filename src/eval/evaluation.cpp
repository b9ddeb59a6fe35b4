#include <algorithm>
#include <cmath>

#include "eval/tile_kernels.hpp"

namespace sweepface {
namespace {

/// Rounded up, as whole registers are read and written.
std::size_t weightBytes(const EvaluatorTables& tables) {
  return sizeof(std::int16_t) * roundUp64(static_cast<std::size_t>(tables.weights) + 1);
}

// Targets with 16-bit and with 8-bit coefficients are paired apart; either may be odd in number.
std::size_t pairsRoom(const EvaluatorTables& tables) {
  return roundUp64(static_cast<std::size_t>(tables.weights) / 2 + 1);
}

constexpr double kMostFactor = 1e6;  // beyond it, normals overflow single precision

/// The largest absolute value of a weight, but at least 1. Keeps four maxima, as each waits for the
/// one before.
double largest(std::span<const double> weights) {
  double most[4] = {1, 1, 1, 1};
  std::size_t k = 0;
  for (; k + 4 <= weights.size(); k += 4)
    for (std::size_t i = 0; i < 4; ++i) most[i] = std::max(most[i], std::abs(weights[k + i]));
  for (; k < weights.size(); ++k) most[0] = std::max(most[0], std::abs(weights[k]));
  return std::max({most[0], most[1], most[2], most[3]});
}

/// Writes weights in units of 2⁻¹⁴; returns what they were divided by, but at most kMostFactor.
float quantise(std::span<const double> weights, std::span<std::int16_t> out) {
  constexpr int kUp = 1 << 15;  // truncation rounds what is above 0
  const double most = largest(weights), scale = kWeightUnit / most;
  for (std::size_t k = 0; k < weights.size(); ++k)
    out[k] = static_cast<std::int16_t>(static_cast<int>(weights[k] * scale + (kUp + 0.5)) - kUp);
  std::ranges::fill(out.subspan(weights.size()), std::int16_t(0));
  return static_cast<float>(std::min(most, kMostFactor));
}

TileRange share(const TileTable& table, Index part, Index parts) {
  const auto cut = [&](std::int64_t p) {
    return static_cast<Index>(table.tileCount() * p / parts);
  };
  const Index first = cut(part);
  return {table, first, cut(part + std::int64_t(1)) - first};
}

std::size_t mostTiles(const EvaluatorTables& tables) {
  return static_cast<std::size_t>(
      std::max(tables.positions.tileCount(), tables.derivatives.tileCount()));
}

/// What a frame needs, in the order of the scratch memory.
struct Scratch {
  std::span<std::int16_t> weights, before;  // in units of 2⁻¹⁴
  std::uint32_t* pairs;
  Index* listed;  // tiles

  Scratch(const EvaluatorTables& tables, std::byte* memory) {
    const std::size_t count = weightBytes(tables) / sizeof(std::int16_t);
    weights = {reinterpret_cast<std::int16_t*>(memory), count};
    before = {weights.data() + count, count};
    pairs = reinterpret_cast<std::uint32_t*>(before.data() + count);
    listed = reinterpret_cast<Index*>(pairs + 4 * pairsRoom(tables));
  }
  static std::size_t bytes(const EvaluatorTables& tables) {
    return 2 * weightBytes(tables) + 16 * pairsRoom(tables) + sizeof(Index) * mostTiles(tables);
  }
};

/// The tiles with a target whose weight has changed.
TileRange changed(const TileRange& all, const Scratch& scratch) {
  Index count = 0;
  for (Index k = 0; k < all.count; ++k) {
    const Tile tile = tileAt(all.table.record(all[k]));
    const std::span targets(tile.targets, 2 * std::size_t(tile.head->pairs));
    const bool differs = std::ranges::any_of(
        targets, [&](auto target) { return scratch.weights[target] != scratch.before[target]; });
    if (differs) scratch.listed[count++] = all[k];
  }
  return {all.table, 0, count, scratch.listed};
}

Result<void> checkOut(const VectorsOut& out, const char* what) {
  if (!out.data) return {};
  if (out.count < 0) return fail("The number of ", what, " must not be negative.");
  if (out.stride < 3 * sizeof(float) || out.stride > kMostStride)
    return fail("The stride of ", what, " must be 12 bytes to a gigabyte.");
  return {};
}

}  // namespace

std::size_t Evaluator::scratchBytes() const {
  constexpr std::size_t toBeginWithALine = 64;
  return toBeginWithALine + Scratch::bytes(*tables_);
}

Result<void> Evaluation::validate() const {
  if (!evaluator || !evaluator->isMade()) return fail("An evaluation needs an evaluator.");
  if (weights.size() > static_cast<std::size_t>(evaluator->weightCount()))
    return fail("There are ", weights.size(), " weights for ", evaluator->weightCount(),
                " targets.");
  if (previous && previous->size() > static_cast<std::size_t>(evaluator->weightCount()))
    return fail("There are ", previous->size(), " previous weights for ", evaluator->weightCount(),
                " targets.");
  for (const auto& given : {weights, previous.value_or(weights)})
    for (std::size_t k = 0; k < given.size(); ++k)
      if (!std::isfinite(given[k])) return fail("Weight ", k, " is not finite.");
  if (scratch.size() < evaluator->scratchBytes())
    return fail("An evaluation needs ", evaluator->scratchBytes(), " bytes of scratch memory, not ",
                scratch.size(), ".");
  if (parts < 1 || part < 0 || part >= parts)
    return fail("There is no part ", part, " of ", parts, ".");
  const bool any = evaluator->vertexCount() > 0;
  if (positions.data && any && !evaluator->hasPositions())
    return fail("The evaluator was made without positions.");
  if ((normals.data || tangents.data) && any && !evaluator->hasNormals())
    return fail("The evaluator was made without normals.");
  for (const auto& [out, what] :
       {std::pair(&positions, "positions"), {&normals, "normals"}, {&tangents, "tangents"}})
    if (auto ok = checkOut(*out, what); !ok) return ok;
  return {};
}

namespace {

Scratch scratchOf(const EvaluatorTables& tables, std::span<std::byte> scratch) {
  const auto address = reinterpret_cast<std::uintptr_t>(scratch.data());
  return Scratch(tables, scratch.data() + (64 - address % 64) % 64);
}

}  // namespace

FrameWeights frameWeights(const EvaluatorTables& tables, std::span<const double> weights,
                          std::span<std::byte> scratch) {
  const Scratch memory = scratchOf(tables, scratch);
  const float factor = quantise(weights, memory.weights);
  return {memory.weights.data(), memory.pairs, pairsRoom(tables), factor, tables.weights + 1};
}

void Evaluation::run() const {
  const EvaluatorTables& tables = evaluator->tables();
  const Scratch memory = scratchOf(tables, scratch);
  FrameWeights frame = frameWeights(tables, weights, scratch);
  frame.cold = cold;
  const bool isPart = previous && quantise(*previous, memory.before) == frame.factor;
  const auto tilesOf = [&](const TileTable& table) {
    const TileRange all = share(table, part, parts);
    return isPart ? changed(all, memory) : all;
  };
  if (positions.data)
    evaluatePositions(tilesOf(tables.positions), frame, positions, tables.vertices);
  if (normals.data || tangents.data)
    evaluateNormals(tilesOf(tables.derivatives), frame, normals, tangents, tables.vertices);
}

}  // namespace sweepface
