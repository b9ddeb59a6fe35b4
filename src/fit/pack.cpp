#include <mutex>

#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "fit/check_source.hpp"
#include "fit/defaults.hpp"
#include "fit/quantise.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

MeshRig meshesOf(const Rig& rig) {
  const Tessellation grid(rig.surface, 1);
  MeshRig meshes;
  meshes.targets.resize(rig.targets.size());
  parallelFor(Index{0}, static_cast<Index>(rig.targets.size()) + 1, [&](Index pose) {
    const Weights weights = rig.weightsOf(pose);
    std::vector<Vec3> positions = sourcePositions(rig, grid, blend(rig, weights), weights);
    if (pose == 0)
      meshes.neutral = {std::move(positions), rig.source.polygons};
    else
      meshes.targets[pose - 1] = {rig.targets[pose - 1].name, std::move(positions)};
  });
  return meshes;
}

namespace {

// For a rig that is already packed, the tolerance that its steps imply, so that its tolerance does
// not double each time.
double ownTolerance(const Rig& rig, double size) {
  if (rig.packing.neutralStep > 0) return rig.packing.neutralStep / kNeutralStep;
  return rig.tolerance > 0 ? rig.tolerance : kDefaultTolerance * size;
}

}  // namespace

Result<double> pack(Rig& rig, const PackOptions& options) {
  if (!rig.knowsTargets())
    return fail("the targets of the face are not decoded yet; decode them before it is packed");
  const int before = rig.packing.textureBits,
            textureBits = options.textureBits > 0 ? options.textureBits
                          : before > 0            ? before
                                                  : ConvertOptions{}.textureBits;
  if (auto ok = checkTextureBits(textureBits); !ok) return std::unexpected(ok.error());
  if (auto ok = checkFromZero(options.tolerance, "the tolerance"); !ok)
    return std::unexpected(ok.error());
  std::mutex telling;
  const auto proceed = [&](double done) {
    const std::scoped_lock lock(telling);
    if (options.progress) options.progress("packing", done);
    return !(options.cancel && options.cancel->load());
  };
  proceed(0);
  const MeshRig meshes = meshesOf(rig);
  const double size = diagonal(meshes.neutral),
               tolerance = options.tolerance > 0 ? options.tolerance : ownTolerance(rig, size);
  if (auto ok = checkTolerance(tolerance, size); !ok) return std::unexpected(ok.error());
  if (auto ok = checkPrecision(meshes, tolerance); !ok) return std::unexpected(ok.error());
  const double angle = kAngleShare * usualNormalLimit(tolerance, size);
  Rig packed = rig;
  if (auto ok = quantise(packed, meshes, goalsOf(rig), {tolerance, angle}, proceed); !ok)
    return std::unexpected(ok.error());
  packed.packing.textureBits = textureBits;
  packed.tolerance += tolerance;
  rig = std::move(packed);
  return tolerance;
}

}  // namespace sweepface
