// convert_meshes NEUTRAL TARGETS OUTPUT: meshes of a face and a folder of its expressions become a
// packed .sweep file (docs/cpp.md).
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <sweepface/codec.hpp>
#include <sweepface/fit.hpp>
#include <sweepface/gltf.hpp>
#include <sweepface/io.hpp>
#include <sweepface/measure.hpp>

using namespace sweepface;

namespace {

Result<std::size_t> convertFiles(const std::filesystem::path& neutral,
                                 const std::filesystem::path& targets,
                                 const std::filesystem::path& output) {
  const auto source = readSource(neutral, {&targets, 1});
  if (!source) return std::unexpected(source.error());

  ConvertOptions options;
  options.tolerance = 0.001 * diagonal(source->rig.neutral);
  options.pack = true;
  auto made = convert(source->rig, options);
  if (!made) return std::unexpected(made.error());
  for (const auto& list : {source->faceWarnings, source->warnings, made->warnings})
    for (const std::string& warning : list) fmt::print(stderr, "warning: {}\n", warning);

  const FurthestVertex furthest = furthestVertex(made->rig, source->rig);
  fmt::print("{} targets, at most {:.4f} of {:.4f} off\n", made->rig.targets.size(),
             furthest.distance, options.tolerance);

  made->rig.scene = packedScene(source->scene);  // what came with a .glb goes back into one
  const std::string bytes = encode(made->rig);
  if (const auto written = writeFile(output, bytes); !written)
    return std::unexpected(written.error());
  return bytes.size();
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    fmt::print(stderr, "Usage: convert_meshes NEUTRAL TARGETS OUTPUT\n");
    return 2;
  }
  const auto bytes = convertFiles(arguments[1], arguments[2], arguments[3]);
  if (!bytes) {
    fmt::print(stderr, "convert_meshes: {}\n", bytes.error().message);
    return 1;
  }
  fmt::print("{}: {} bytes\n", arguments[3], *bytes);
}
