// Draws the sample face and writes it in every form: sample_face OUTDIR
//
//   sample.wire.json               the drawing, for people and for `sweepface build`
//   sample.sweep, sample.glb       the model made of it
//   neutral.obj, expressions/      meshes of it, for `sweepface convert`
#include <filesystem>
#include <fmt/format.h>

#include "sweepface/codec.hpp"
#include "sweepface/drawing.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"

#include "sample_face/face.hpp"
#include "sample_face/texture.hpp"

namespace {

using namespace sweepface;
namespace fs = std::filesystem;

/// The source mesh of an expression.
std::string objText(const Rig& rig, const Tessellation& grid, const Weights& weights) {
  const std::vector<Vec3> vectors = blend(rig, weights);
  return formatObj({grid.positions(vectors), {}, rig.source.polygons});
}

Result<void> writeMeshes(const fs::path& folder, const Rig& rig) {
  const Tessellation grid(rig.surface, 1);
  Weights weights(rig.targets.size());
  if (auto ok = writeFile(folder / "neutral.obj", objText(rig, grid, weights)); !ok) return ok;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k] = 1;
    const fs::path path = folder / "expressions" / (rig.targets[k].name + ".obj");
    if (auto ok = writeFile(path, objText(rig, grid, weights)); !ok) return ok;
    weights[k] = 0;
  }
  return {};
}

Result<void> writeAll(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / "expressions", error);
  const Drawing drawing = sample::drawFace();
  Result<Built> built = build(drawing);
  if (!built) return std::unexpected(built.error());
  Rig& rig = built->rig;
  const std::vector<Vec3> neutral = blend(rig, Weights(rig.targets.size()));
  sample::wrap(rig.source.polygons, Tessellation(rig.surface, 1).positions(neutral));
  const Result<std::string> glb = formatGlb(rig, {});
  if (!glb) return std::unexpected(glb.error());
  if (auto ok = writeFile(folder / "sample.wire.json", formatDrawing(drawing)); !ok) return ok;
  if (auto ok = writeFile(folder / "sample.sweep", encode(rig)); !ok) return ok;
  if (auto ok = writeFile(folder / "sample.glb", *glb); !ok) return ok;
  if (auto ok = writeMeshes(folder, rig); !ok) return ok;
  fmt::print(
      "{}: sample.wire.json, .sweep, .glb, neutral.obj and expressions/\n"
      "{} nodes, {} curves, {} patches, {} expressions; {} vertices and {} quads\n",
      folder.string(), drawing.nodes.size(), drawing.curves.size(), drawing.patches.size(),
      drawing.expressions.size(), rig.source.gridVertex.size(), rig.source.polygons.faceCount());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    fmt::print(stderr, "usage: sample_face OUTDIR\n");
    return 2;
  }
  if (const auto ok = writeAll(argv[1]); !ok) {
    fmt::print(stderr, "sample_face: {}\n", ok.error().message);
    return 1;
  }
  return 0;
}
