#include "report/peers.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "sweepface/box.hpp"
#include "sweepface/gltf.hpp"

#include "report/program.hpp"

namespace sweepface {
namespace {

constexpr std::array kBits{10, 12, 14};  // of positions; gltfpack's default is 14

/// The most that coordinates of this many bits can be off: gltfpack's grid has room for the neutral
/// and for what all targets may add to it.
double reachOf(const MeshRig& source, int bits) {
  Box box(source.neutral.positions);
  for (const MeshTarget& target : source.targets)
    for (const Vec3& p : target.positions) box.include(p);
  const Vec3 size = box.size();
  return 2 * std::max({size.x, size.y, size.z}) / ((1 << bits) - 1);
}

Result<void> measureFile(PeerFile& file, std::string_view bytes, const MeshRig& source,
                         double radius) {
  file.bytes = bytes.size();
  const Result<RigSource> decoded = parseGltf(bytes, "GLB", {}, {.withScene = false});
  if (!decoded) return std::unexpected(decoded.error());
  const MeshRig& found = decoded->rig;
  const auto places = counterparts(source, found, radius);
  if (!places) return std::unexpected(places.error());
  std::vector<double> distances, displacements;
  std::vector<Vec3> neutral(places->size());
  const auto add = [&](const std::vector<Vec3>& is, const std::vector<Vec3>& shouldBe, bool rest) {
    for (std::size_t v = 0; v < neutral.size(); ++v) {
      if ((*places)[v] < 0) continue;
      const Vec3 offset = is[(*places)[v]] - shouldBe[v];
      distances.push_back(norm(offset));
      if (rest)
        neutral[v] = offset;
      else
        displacements.push_back(norm(offset - neutral[v]));
    }
  };
  add(found.neutral.positions, source.neutral.positions, true);
  for (const MeshTarget& target : source.targets)
    add(std::ranges::find(found.targets, target.name, &MeshTarget::name)->positions,
        target.positions, false);
  file.distance = summaryOf(std::move(distances));
  file.displacement = summaryOf(std::move(displacements));
  return {};
}

/// The size of a file compressed by brotli, with whichever program has it; 0 if none has.
std::size_t brotliBytes(const std::string& file) {
  const std::string out = file + ".br";
  constexpr const char* script =
      "const fs = require('fs'), [from, to] = process.argv.slice(1);"
      "fs.writeFileSync(to, require('zlib').brotliCompressSync(fs.readFileSync(from)))";
  if (run({"brotli", "-q", "11", "-f", "-o", out, file}) != Ran::well &&
      run({"node", "-e", script, file, out}) != Ran::well)
    return 0;
  std::error_code none;
  const auto size = std::filesystem::file_size(utf8Path(out), none);
  return none ? 0 : static_cast<std::size_t>(size);
}

/// The source's GLB packed with this many bits, or why there is none.
Result<PeerFile> packed(const std::string& gltfpack, const std::filesystem::path& folder,
                        const MeshRig& source, int bits) {
  PeerFile file{fmt::format("-vp {}", bits), 0, 0, {}, {}};
  const std::string out = (folder / fmt::format("{}.glb", bits)).string();
  // -kv keeps texture coordinates although no texture uses them.
  switch (run({gltfpack, "-i", (folder / "face.glb").string(), "-o", out, "-cc", "-kv", "-vp",
               std::to_string(bits)})) {
    case Ran::missing:
      return fail(fmt::format(
          "There is no program '{}', so that GLBs packed by it are left out; install it with npm "
          "install -g gltfpack, or say where it is with --gltfpack.",
          gltfpack));
    case Ran::badly:
      return fail(fmt::format("'{}' failed, so that GLBs packed by it are left out.", gltfpack));
    case Ran::well:
      break;
  }
  const Result<std::string> bytes = readFile(utf8Path(out));
  const auto measured = bytes ? measureFile(file, *bytes, source, reachOf(source, bits))
                              : std::unexpected(bytes.error());
  if (!measured)
    return fail(
        fmt::format("What '{}' packed is left out: {}", gltfpack, measured.error().message));
  file.brotliBytes = brotliBytes(out);
  return file;
}

}  // namespace

Peers makePeers(const MeshRig& source, const std::string& gltfpack,
                const std::function<Result<void>()>& step) {
  Peers peers;
  if (!step()) return peers;
  const auto glb = formatGlb(source);
  const auto measured = glb ? measureFile(peers.glb, *glb, source, reachOf(source, 16))
                            : std::unexpected(glb.error());
  if (!runsPrograms) {
    peers.left = "GLBs packed by gltfpack are left out: on Windows it is not run.";
    return peers;
  }
  const ScratchFolder folder;
  if (folder.path().empty()) {
    peers.left =
        "No folder for temporary files can be made, so that GLBs packed by gltfpack are left out; "
        "let TMPDIR name one that can be written to.";
    return peers;
  }
  const auto ready = measured ? writeFile(folder.path() / "face.glb", *glb) : measured;
  if (!ready) {
    peers.left = "The source as GLB is left out: " + ready.error().message;
    return peers;
  }
  for (const int bits : kBits) {
    if (!step()) return peers;
    Result<PeerFile> file = packed(gltfpack, folder.path(), source, bits);
    if (!file) {
      peers.left = file.error().message;
      return peers;
    }
    peers.packed.push_back(std::move(*file));
  }
  if (peers.packed[0].brotliBytes == 0)
    peers.left = "Neither brotli nor Node is there, so that files packed by brotli are left out.";
  return peers;
}

}  // namespace sweepface
