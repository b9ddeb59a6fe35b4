#include "io/rig_output.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "sweepface/lod_polygons.hpp"

#include "mesh/grid_source.hpp"
#include "rig/source_quads.hpp"

namespace sweepface::io {
namespace {

Result<void> checkClip(const Clip& clip) {
  if (clip.times.empty()) return fail("The clip has no frames.");
  if (clip.weights.size() == clip.times.size() * clip.names.size()) return {};
  return fail("The clip has not as many weights as it has frames times names.");
}

Result<void> checkGrid(const Rig& rig, const Tessellation& grid, Index lod) {
  if (lod != 0)
    return fail("A tessellation takes the place of a level of detail; ask for one of them.");
  if (grid.isOfSites() || grid.level() != 0 || !grid.fits(rig.surface))
    return fail("The tessellation is not one of the face with a density.");
  return {};
}

/// Replaces polygons that a rig does not know by those of its surface. Loose vertices stay.
void takeFacesOfSurface(Rig& rig) {
  const auto loose = static_cast<Index>(rig.source.loose.size());
  SourceMesh source = gridSource(rig.surface);
  source.loose = std::move(rig.source.loose);
  for (Index k = 0; k < loose; ++k) source.gridVertex.push_back(-1 - k);
  rig.source = std::move(source);
}

void takeMeshOf(Rig& rig, const Tessellation& grid) {
  SourceMesh source;
  source.polygons = densityPolygons(rig, grid);
  source.gridVertex.resize(grid.vertexCount());
  std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
  rig.source = std::move(source);
  for (Target& target : rig.targets) target.looseDifference.clear();
}

}  // namespace

Result<void> checkOutput(const Rig& rig, const RigOutput& output) {
  if (!rig.knowsTargets())
    return fail("The targets of the face are not decoded yet; decode them before it is written.");
  const std::size_t targets = rig.targets.size();
  const auto differ = [&](std::string_view what, std::size_t count) {
    return fail(
        fmt::format("The {} has {} weights, but the face {} targets.", what, count, targets));
  };
  if (!output.weights.empty() && output.weights.size() != targets)
    return differ("expression", output.weights.size());
  if (output.clip && output.clip->names.size() != targets)
    return differ("clip", output.clip->names.size());
  if (output.clip)
    if (auto ok = checkClip(*output.clip); !ok) return ok;
  if (const double m = output.metersPerUnit; m != 0 && !(m >= 1e-9 && m <= 1e9))
    return fail("Metres a unit are between 1e-9 and 1e9, or 0 for what is usual.");
  if (output.lod < 0) return fail("A level of detail is 0 or more.");
  return output.grid ? checkGrid(rig, *output.grid, output.lod) : Result<void>{};
}

OutputGrid::OutputGrid(const Rig& rig, Index lod, const Tessellation* given) : given_(given) {
  if (!given) own_.emplace(rig.surface, std::max(lod, 1));
}

std::optional<Rig> withOtherMesh(const Rig& rig, Index lod, const Tessellation* grid) {
  const bool knowsFaces = rig.source.polygons.faceCount() > 0 && (lod == 0 || knowsQuads(rig));
  if (!grid && knowsFaces) return std::nullopt;
  Rig other = rig;
  if (grid)
    takeMeshOf(other, *grid);
  else
    takeFacesOfSurface(other);
  return other;
}

}  // namespace sweepface::io
