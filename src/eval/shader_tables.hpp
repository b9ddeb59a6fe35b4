#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/evaluator.hpp"

#include "eval/tiles.hpp"

namespace sweepface {

/// The tables of an Evaluator, laid out for a vertex shader. The modes of a tile lie side by side
/// in one texture, a texel each. The rows of its basis are in the other, with the numbers for four
/// modes in each texel:
///
///   row = neutral + factor · scale · Σ_t Σ_k basis[first + t][k] · modes[modesAt + 4 t + k]
///
/// A vertex's place is: first; modesAt · 64 + the texels of a row; the bits of scale.
struct ShaderTables {
  std::vector<std::int16_t> basis;    ///< [texels × 4]
  std::vector<std::uint32_t> places;  ///< [vertices × 3]
  std::vector<float> neutral;         ///< [vertices × rows × 3]
  Index rows = 1;                     ///< of a vertex, one after the other: 1, or 2 for ∂u and ∂v
  Index modes = 0;                    ///< texels of the texture of modes
};

ShaderTables shaderTables(const TileTable& table, Index vertices);

/// Writes the modes for these weights [modes × 4], the fourth number 0; returns their factor.
/// Allocates nothing; `scratch` is that of an evaluation.
float blendModes(const EvaluatorTables& tables, const TileTable& table,
                 std::span<const double> weights, std::span<std::byte> scratch,
                 std::span<std::int16_t> out);

}  // namespace sweepface
