#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/tangents.hpp"

namespace sweepface {

struct EvaluatorTables;

inline constexpr Index kMostLevel = 64;

/// What an Evaluator is made for.
struct EvaluatorOptions {
  /// 0: the source's vertices in their order; N, at most kMostLevel: Tessellation(surface, N).
  Index level = 0;
  bool normals = true;    ///< whether normals and tangents can be asked for
  bool positions = true;  ///< whether positions can
  bool targets = true;    ///< whether weights move anything; if not, there is only the neutral
  /// How far a target of weight 1 in one region may take a vertex off the surface, in model units,
  /// as far as 16 bits can hold it. Rounding comes on top, in proportion to how far all targets
  /// together can move the vertex (positionBound includes both). 0: three tenths of the rig's own
  /// tolerance, but no less than a hundred-thousandth of the neutral's diagonal.
  double tolerance = 0;
  /// The same for the surface's first derivatives, as a share of their neutral length, or of a
  /// hundredth of the length that a target gives them if that is more.
  double derivativeTolerance = 0.03;
  /// Influences of regions [R][storedCount]: target k of region r adds weight[r·K + k] ·
  /// influence[r][v] · difference to stored vector v, the same seen from every patch. Empty: one
  /// region that is everywhere.
  std::vector<std::vector<float>> influences = {};
};

/// A rig prepared for playing: a linear map from weights to vertices and derivatives, in tables
/// small enough for the cache (docs/evaluation.md). It never changes, so any number of threads may
/// use it. Copies share the tables.
class Evaluator {
 public:
  /// Takes some 60 ms for a face of 11,000 vertices and 57 targets, half of that for normals. Fails
  /// if the options do not fit the rig.
  static Result<Evaluator> make(const Rig& rig, const EvaluatorOptions& options = {});
  /// The same with a tessellation at hand: one of that level (1 for level 0), or one with a
  /// density, whose vertices are then played whatever the level.
  static Result<Evaluator> make(const Rig& rig, const Tessellation& grid,
                                const EvaluatorOptions& options);
  /// The same for all vertices of a render mesh of that tessellation (level 0: of the source), with
  /// tangents for normal maps: `tangents` in the neutral, and in every pose the directions into
  /// which the surface carries these. Where a vertex has none, its tangent goes along the sweep.
  static Result<Evaluator> make(const Rig& rig, const Tessellation& grid, const RenderMesh& mesh,
                                const Tangents& tangents, const EvaluatorOptions& options);

  /// Whether it came from make(): one that did not may only be assigned to.
  bool isMade() const { return tables_ != nullptr; }
  Index vertexCount() const;
  Index weightCount() const;  ///< R · K
  bool hasPositions() const;
  bool hasNormals() const;
  /// Bytes of scratch memory that an Evaluation needs.
  std::size_t scratchBytes() const;
  /// Bytes that are read to evaluate positions, and normals on top.
  std::size_t positionBytes() const;
  std::size_t normalBytes() const;
  /// How far any vertex may be from the surface under these weights, in model units: what was
  /// dropped of each target, as measured when the tables were made, plus rounding. The bound does
  /// not hold for weights beyond ±10⁶, which are scaled back to that, nor if a target moves
  /// anything by more than 10³⁰.
  double positionBound(std::span<const double> weights) const;
  /// The same for a derivative, as a share like derivativeTolerance.
  double derivativeBound(std::span<const double> weights) const;

  const EvaluatorTables& tables() const { return *tables_; }

 private:
  static Result<void> check(const Rig& rig, const Tessellation& grid,
                            const EvaluatorOptions& options);

  std::shared_ptr<const EvaluatorTables> tables_;
};

/// Bytes from one vertex to the next, at the most.
inline constexpr std::size_t kMostStride = std::size_t{1} << 30;

/// Three floats every `stride` bytes; no data: not wanted.
struct VectorsOut {
  float* data = nullptr;
  Index count = 0;  ///< room for this many; vertices beyond are left out
  std::size_t stride = 3 * sizeof(float);
};

/// One frame of one face. Owns nothing and allocates nothing; several may run at once on the same
/// evaluator if each has its own scratch memory and its own outputs.
struct Evaluation {
  const Evaluator* evaluator = nullptr;
  /// [R × K], finite; missing ones are 0. If the largest is beyond ±1e6, all are scaled down so
  /// that it is not.
  std::span<const double> weights;
  std::span<std::byte> scratch;  ///< [scratchBytes], uninitialised
  VectorsOut positions;          ///< model units
  VectorsOut normals;            ///< outward, unit length; zero where a pose has none
  VectorsOut tangents;           ///< unit length, along the sweep of each vertex's patch or as
                                 ///< given
  Index part = 0, parts = 1;     ///< only this part of the vertices
  /// The weights of the evaluation whose results the outputs still hold. Only vertices moved by
  /// weights that differ are written again, with the same result. Not set: all are written.
  std::optional<std::span<const double>> previous = {};
  /// Whether the tables are likely to have left the cache since the last frame, as when many rigs
  /// take turns. They are then fetched ahead, and the evaluation takes a third of the time; if they
  /// are still in the cache, it takes a tenth longer.
  bool cold = false;

  Result<void> validate() const;
  /// Do not run what validate() refuses.
  void run() const;
};

}  // namespace sweepface
