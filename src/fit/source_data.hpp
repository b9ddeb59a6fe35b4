#pragma once

#include <Eigen/Dense>
#include <vector>

#include "sweepface/mesh.hpp"

#include "fit/vertex_normals.hpp"
#include "layout/layout.hpp"
#include "mesh/grid_mesh.hpp"

namespace sweepface {

/// One row per point or sample, three columns per pose.
using PoseMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using PoseRow = Eigen::Matrix<double, 1, Eigen::Dynamic>;

/// What is fitted: the source's points and normals in all poses, and how much each point counts.
struct SourceData {
  double tolerance = 0;
  Index poses = 0;             ///< the neutral and all targets
  PoseMatrix points;           ///< [points × 3·poses]
  PoseMatrix normals;          ///< [points × 3·poses] unit vertex normals
  std::vector<double> weight;  ///< [points] 1 / edge²: an error counts relative to the mesh there
  double slopeWeight = 1;      ///< of a tangent, relative to a position
  std::vector<char> uneven;    ///< [vertices] a line passes from a long edge to a short one
  std::vector<double> placeEmphasis;  ///< [points] factor on the weight of the position there
  std::vector<double> slopeEmphasis;  ///< [points] factor on the weight of the tangents there

  Vec3 point(Index p, Index pose) const { return at(points, p, pose); }
  Vec3 normal(Index p, Index pose) const { return at(normals, p, pose); }
  static Vec3 at(const PoseMatrix& m, Index row, Index pose) {
    return {m(row, 3 * pose), m(row, 3 * pose + 1), m(row, 3 * pose + 2)};
  }
};

SourceData gatherSource(const MeshRig& rig, const GridMesh& mesh, double tolerance);

}  // namespace sweepface
