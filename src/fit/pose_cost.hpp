#pragma once

#include <vector>

#include "fit/columns.hpp"
#include "fit/pose_quantiser.hpp"

namespace sweepface {

/// Tracks how far off a pose is at every vertex while its coefficients change, and what that costs
/// in bits: hardly anything well within the bounds, steeply more beyond them. Tangents cost more
/// the further they lean or turn over.
class PoseCost {
 public:
  using Four [[gnu::vector_size(16)]] = float;

  PoseCost(const Columns& columns, const PoseTask& task);

  Index vertexCount() const { return static_cast<Index>(at_.size()); }
  /// The squared error of a vertex, relative to the square of its bound.
  float square(Index u) const { return at_[u].square; }
  /// What the tangents of a vertex cost.
  float tilt(Index u) const;
  /// How much `square` falls if coordinate a of the vertex's position changes.
  float nearer(Index u, int a, float change) const {
    return -(2 * at_[u].error[a] + change) * change * at_[u].perSquare;
  }

  /// How much the cost grows if coordinate a of a coefficient grows by each of four `steps`.
  Four growth(Index v, int a, Four steps) const;
  float growth(Index v, int a, float steps) const { return growth(v, a, Four{steps})[0]; }
  /// Its derivatives with respect to the three coordinates of a coefficient.
  Four gradient(Index v) const;
  void move(Index v, int a, float steps);

  /// From now on, errors beyond a bound count `times` as much as they do at first.
  void press(float times);

 private:
  struct Tangent {
    float error[3], normal[3];
    float lean, perLength, strain, overturn;
  };
  struct Vertex {
    float error[3], perSquare, square, penalty;
    Tangent tangent[2];
  };
  // Half the gradient of the cost with respect to a vertex's position and to its tangents.
  struct Pull {
    Four place, along[2];
  };

  void refresh(Index u);

  const Columns& columns_;
  float step_, slopeWeight_, beyond_;
  std::vector<Vertex> at_;   // [vertices]
  std::vector<Pull> pulls_;  // [vertices]
};

}  // namespace sweepface
