#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Cuts faces into convex quads and triangles of distinct vertices. Triangles and quads stay whole.
class FaceCutter {
 public:
  /// A face corner with the welded vertex it stands at.
  struct Corner {
    Index vertex, corner;
  };
  using Piece = std::vector<Corner>;

  explicit FaceCutter(std::span<const Vec3> positions) : positions_(positions) {}

  void cut(Piece face);

  std::vector<Piece> pieces;

 private:
  std::vector<Piece> cutLarge(Piece face) const;
  double worthOf(const std::vector<Piece>& cuts, const Vec3& normal) const;
  void keep(Piece piece);

  std::span<const Vec3> positions_;
};

}  // namespace sweepface
