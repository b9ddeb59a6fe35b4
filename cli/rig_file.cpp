#include "rig_file.hpp"

#include <fmt/format.h>

#include "output.hpp"

namespace sweepface::cli {

void addRigFile(CLI::App& app, RigFileArguments& a) {
  app.add_flag("--morph-normals", a.morphNormals,
               "For .glb, .usda and .usdz: normals of the targets too; larger, and better shaded");
  app.add_flag("--quantize", a.quantize,
               "For .glb: 16 bits a coordinate (KHR_mesh_quantization); about half as large");
  app.add_option("--meters-per-unit", a.metersPerUnit,
                 "For .glb, .usda and .usdz: how long a unit of the face is, 0.01 for centimetres. "
                 "In a .glb 1 if not given, as always for a face with the scene of one; in a .usda "
                 "1 for such a face, what a drawing says its units are, or 0.01")
      ->check(positiveNumber(1e9))
      ->type_name("M");
  app.add_flag(
      "--z-up", a.zUp,
      "For .glb (but not with the scene of one), .usda and .usdz: z points up in the face, "
      "instead of y");
}

Result<void> checkRigFile(const RigFileArguments& a, std::string_view output) {
  const bool glb = isOfKind(output, ".glb"), usd = isUsd(output);
  const auto refuse = [](std::string_view options, std::string_view kinds) {
    return fail(
        fmt::format("{} for {} files; name the output so or leave that out.", options, kinds));
  };
  constexpr const char* kBoth = ".glb, .usda and .usdz";
  if (a.morphNormals && !glb && !usd) return refuse("--morph-normals is", kBoth);
  if (a.metersPerUnit > 0 && !glb && !usd) return refuse("--meters-per-unit is", kBoth);
  if (a.zUp && !glb && !usd) return refuse("--z-up is", kBoth);
  if (a.quantize && !glb) return refuse("--quantize is", ".glb");
  return {};
}

bool isUsd(std::string_view path) {
  return isOfKind(path, ".usda") || isOfKind(path, ".usd") || isOfKind(path, ".usdz");
}

Result<std::string> formatUsdFor(std::string_view path, const Rig& rig, const UsdOptions& options) {
  if (const std::string leftOut = leftOutOfUsd(rig); !leftOut.empty()) printWarning(leftOut);
  return (isOfKind(path, ".usdz") ? formatUsdz : formatUsd)(rig, options);
}

}  // namespace sweepface::cli
