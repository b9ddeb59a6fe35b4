#pragma once

#include <unordered_map>
#include <vector>

#include "gltf/fine_mesh.hpp"

namespace sweepface::gltf {

/// A vertex of a run.
struct Home {
  std::size_t run = 0;
  Index vertex = 0;
};

/// Where the vertices of a fine mesh are at home: those that a triangle sees beyond a seam are also
/// seen from where they lie, as a rule. All copies of a vertex in a mesh have one home.
class Homes {
 public:
  Homes(const Parts& parts, const FineMesh& mesh);

  /// [vertices] of a run that are not at home themselves.
  const std::vector<Index>& strangers(std::size_t run) const { return strangers_[run]; }
  Home of(std::size_t run, Index stranger) const;

 private:
  const Parts& parts_;
  const FineMesh& mesh_;
  std::vector<std::unordered_map<Index, Home>> homes_;  // [parts.meshes] by grid vertex
  std::vector<std::vector<Index>> strangers_;           // [runs]
};

}  // namespace sweepface::gltf
