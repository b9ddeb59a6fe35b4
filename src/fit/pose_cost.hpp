#pragma once

#include <vector>

#include "fit/columns.hpp"
#include "fit/pose_quantiser.hpp"

namespace sweepface {

/// How far off a pose is at every vertex while its coefficients change, and what that costs in
/// bits: hardly anything well within the bounds, steeply more beyond them, and for tangents more
/// the further they lean or turn over.
class PoseCost {
 public:
  using Four [[gnu::vector_size(16)]] = float;

  PoseCost(const Columns& columns, const PoseTask& task);

  Index vertexCount() const { return static_cast<Index>(at_.size()); }
  /// The square of how far off a vertex is, as a share of its bound's.
  float square(Index u) const { return at_[u].square; }
  /// What the tangents of a vertex cost.
  float tilt(Index u) const;
  /// How much nearer to its bound a vertex comes if coordinate a of its place changes.
  float nearer(Index u, int a, float change) const {
    return -(2 * at_[u].error[a] + change) * change * at_[u].perSquare;
  }

  /// How much the cost grows when coordinate a of a coefficient grows by so many steps: four
  /// numbers of them at once.
  Four growth(Index v, int a, Four steps) const;
  float growth(Index v, int a, float steps) const { return growth(v, a, Four{steps})[0]; }
  /// Its derivatives by the three coordinates of a coefficient.
  Four gradient(Index v) const;
  void move(Index v, int a, float steps);

  /// From here on what is beyond a bound counts so many times more.
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
  // By what the cost grows with the place of a vertex and with its tangents.
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
