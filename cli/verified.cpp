#include "verified.hpp"

#include <fmt/format.h>

#include "command.hpp"
#include "interrupts.hpp"

namespace sweepface::cli {

namespace fs = std::filesystem;

std::string nameOfShape(const Rig& rig, Index target) {
  return target < 0 ? "the neutral" : rig.targets[target].name;
}

Result<Verified> verify(std::string_view bytes, const std::string& name, const MeshRig& source,
                        const Rig& made, double tolerance, const Rig* before) {
  Result<Rig> rig = readBack(bytes, name);
  if (!rig) return std::unexpected(rig.error());
  if (!rig->source.ownOrder && rig->targets.size() == made.targets.size()) {
    rig->source = made.source;
    for (std::size_t k = 0; k < rig->targets.size(); ++k)
      rig->targets[k].looseDifference = made.targets[k].looseDifference;
  }
  if (rig->targets.size() != source.targets.size() ||
      rig->source.gridVertex.size() != source.neutral.positions.size())
    return fail(
        "The encoded face lacks vertices or targets of the source; nothing was written. "
        "This is a fault of sweepface, please report it.");
  const FurthestVertex worst =
      before ? furthestVertex(*rig, *before) : furthestVertex(*rig, source);
  std::string shape = nameOfShape(*rig, worst.target);
  if (worst.distance <= tolerance)
    return Verified{tolerance,
                    worst,
                    std::move(shape),
                    normalErrors(*rig, source),
                    countFolds(*rig, source),
                    keptMovement(*rig, source)};
  return fail(
      fmt::format("Vertex {} of {} would be {:.6g} away from the source, beyond the "
                  "tolerance of {:.6g}; nothing was written. This is a fault of sweepface, "
                  "please report it.",
                  worst.vertex, shape, worst.distance, tolerance));
}

void printDistance(const Verified& verified) {
  const auto& [tolerance, worst, shape, angle, folds, kept] = verified;
  fmt::print("worst distance {:.4g} of {:.4g} allowed, at vertex {} of {}\n", worst.distance,
             tolerance, worst.vertex, shape);
}

Result<int> writeAndReadBack(const fs::path& path, std::string_view bytes) {
  catchInterrupts();  // it must not end half-way
  if (interrupted) return kInterrupted;
  if (auto written = writeFile(path, bytes); !written) return std::unexpected(written.error());
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return 0;
  const Result<std::string> back = readFile(path);
  if (!back) return std::unexpected(back.error());
  if (*back == bytes) return 0;
  return fail(fmt::format("{} reads back differently from what was written; check the disk.",
                          path.string()));
}

}  // namespace sweepface::cli
