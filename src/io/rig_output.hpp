#pragma once

#include <optional>

#include "sweepface/clip.hpp"
#include "sweepface/eval.hpp"

// What the writers of files that hold a rig with all its targets have in common.
namespace sweepface::io {

/// What is to be written, as GlbOptions and UsdOptions have it.
struct RigOutput {
  Index lod = 0;
  const Tessellation* grid = nullptr;
  const Weights& weights;
  const Clip* clip = nullptr;
  double metersPerUnit = 0;
};
/// Refuses what no such file can hold.
Result<void> checkOutput(const Rig& rig, const RigOutput& output);

/// The tessellation to write: the given one, or that of the level.
class OutputGrid {
 public:
  OutputGrid(const Rig& rig, Index lod, const Tessellation* given);
  const Tessellation& get() const { return given_ ? *given_ : *own_; }

 private:
  const Tessellation* given_;
  std::optional<Tessellation> own_;
};

/// The rig with another mesh as its source, if it cannot be written with its own: the triangles of
/// `grid`, if that is given, or the surface's own faces where the rig does not know the source's.
/// `SourceMesh::gridVertex` refers to the tessellation that is written.
std::optional<Rig> withOtherMesh(const Rig& rig, Index lod, const Tessellation* grid);

}  // namespace sweepface::io
