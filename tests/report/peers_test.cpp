#include "report/peers.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/report.hpp"

#include "io/temporary_folder.hpp"
#include "picture/scenes.hpp"
#include "report/program.hpp"

namespace sweepface {
namespace {

using namespace testing;

Result<void> nothing() { return {}; }

/// A stand-in for gltfpack that runs a script; its input is $2 and its output $4.
std::string program(const TemporaryFolder& folder, const std::string& script) {
  const auto path = folder.file("pack", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.string();
}

TEST(Counterparts, FindVerticesInAnyOrder) {
  const MeshRig source = withTargets(plane(6, 5));
  const auto shuffled = [&](std::vector<Vec3> list) {
    std::ranges::reverse(list);
    std::ranges::rotate(list, list.begin() + 7);
    for (Vec3& p : list) p.y += 0.01;
    return list;
  };
  MeshRig found = source;
  found.neutral.positions = shuffled(found.neutral.positions);
  for (MeshTarget& target : found.targets) target.positions = shuffled(target.positions);
  const auto places = counterparts(source, found, 0.02);
  ASSERT_TRUE(places) << places.error().message;
  for (std::size_t v = 0; v < places->size(); ++v)
    EXPECT_LT(norm(found.neutral.positions[(*places)[v]] - source.neutral.positions[v]), 0.011);
  EXPECT_TRUE(failsWith(counterparts(source, found, 0.005), {"vertex 0 is missing"}));
  found.targets.pop_back();
  EXPECT_TRUE(failsWith(counterparts(source, found, 0.02), {"target", "is missing"}));
}

// Lips coincide until they open.
TEST(Counterparts, AreToldApartByTheirTargets) {
  MeshRig source = withTargets(plane(2, 2), 1);
  source.neutral.positions[4] = source.neutral.positions[0];
  MeshRig found = source;
  std::swap(found.targets[0].positions[0], found.targets[0].positions[4]);
  const auto places = counterparts(source, found, 0.001);
  ASSERT_TRUE(places) << places.error().message;
  EXPECT_EQ((*places)[0], 4);
  EXPECT_EQ((*places)[4], 0);
  EXPECT_EQ((*places)[8], 8);
}

TEST(Counterparts, LeaveOutVerticesOfNoFace) {
  MeshRig source = withTargets(plane(2, 2), 1);
  const MeshRig found = source;
  source.neutral.positions.push_back({9, 9, 9});
  source.targets[0].positions.push_back({9, 9, 9});
  const auto places = counterparts(source, found, 0.001);
  ASSERT_TRUE(places) << places.error().message;
  EXPECT_EQ(places->back(), -1);
}

TEST(Peers, AreMeasuredOnWhatTheyDecodeTo) {
  const TemporaryFolder folder;
  const MeshRig source = withTargets(plane(12, 10));
  MeshRig off = source;
  for (Vec3& p : off.neutral.positions) p.z += 0.001;
  for (MeshTarget& target : off.targets)
    for (Vec3& p : target.positions) p.z += 0.001;
  const auto given = folder / "given.glb", made = folder.file("made.glb", *formatGlb(off));
  const std::string script =
      fmt::format("cp \"$2\" {} && cp {} \"$4\"", given.string(), made.string());
  int steps = 0;
  const Peers peers = makePeers(source, program(folder, script), [&] {
    ++steps;
    return Result<void>();
  });
  EXPECT_EQ(steps, kPeerSteps);
  EXPECT_GT(peers.glb.bytes, 12 * 3 * source.neutral.positions.size());
  EXPECT_GT(peers.glb.distance.max, 0);
  EXPECT_LT(peers.glb.distance.max, 1e-6 * diagonal(source.neutral));
  EXPECT_EQ(std::filesystem::file_size(given), peers.glb.bytes);
  ASSERT_EQ(peers.packed.size(), 3u) << peers.left;
  const bool hasBrotli =
      run({"brotli", "--version"}) == Ran::well || run({"node", "--version"}) == Ran::well;
  for (const PeerFile& file : peers.packed) {
    EXPECT_EQ(file.bytes, std::filesystem::file_size(made));
    EXPECT_NEAR(file.distance.rms, 0.001, 1e-6);
    EXPECT_LT(file.displacement.max, 1e-5) << "the neutral is off as well";
    EXPECT_LT(file.brotliBytes, file.bytes);
    EXPECT_EQ(file.brotliBytes > 0, hasBrotli);
  }
}

TEST(Peers, SayInASentenceWhatIsLeftOut) {
  const TemporaryFolder folder;
  const MeshRig source = withTargets(plane(4, 4));
  const auto left = [&](const std::string& gltfpack) {
    const Peers peers = makePeers(source, gltfpack, nothing);
    EXPECT_GT(peers.glb.bytes, 0u);
    EXPECT_TRUE(peers.packed.empty());
    return peers.left;
  };
  EXPECT_NE(left("./no-such-gltfpack").find("npm install -g gltfpack"), std::string::npos);
  EXPECT_NE(left(program(folder, "exit 3")).find("failed"), std::string::npos);
  EXPECT_NE(left(program(folder, "echo no GLB >\"$4\"")).find("is left out: "), std::string::npos);
  EXPECT_NE(left(program(folder, "true")).find("is left out: "), std::string::npos);
}

TEST(Peers, LeaveNoFilesBehind) {
  const TemporaryFolder folder;
  const std::string before = std::filesystem::temp_directory_path().string();
  setenv("TMPDIR", (folder / "").c_str(), 1);
  makePeers(withTargets(plane(4, 4)), "/bin/false", nothing);
  setenv("TMPDIR", before.c_str(), 1);
  EXPECT_EQ(folder.fileCount(), 0u);
}

// The working directory is not ours to write to.
TEST(Peers, WriteNowhereElseWithoutTemporaryFiles) {
  const TemporaryFolder folder;
  const auto here = std::filesystem::current_path(),
             before = std::filesystem::temp_directory_path();
  std::filesystem::current_path(folder / "");
  setenv("TMPDIR", (folder / "none").c_str(), 1);
  const Peers peers = makePeers(withTargets(plane(4, 4)), "/bin/false", nothing);
  setenv("TMPDIR", before.c_str(), 1);
  std::filesystem::current_path(here);
  EXPECT_EQ(folder.fileCount(), 0u);
  EXPECT_NE(peers.left.find("TMPDIR"), std::string::npos) << peers.left;
  EXPECT_GT(peers.glb.bytes, 0u);
  EXPECT_TRUE(peers.packed.empty());
}

// The real gltfpack, where it is installed.
TEST(Peers, ArePackedByGltfpack) {
  const std::string gltfpack = SWEEPFACE_SOURCE_DIR "/tests/web/node_modules/.bin/gltfpack";
  if (!std::filesystem::exists(gltfpack)) GTEST_SKIP() << "there is no gltfpack";
  const MeshRig source = withTargets(plane(24, 20));
  const Peers peers = makePeers(source, gltfpack, nothing);
  ASSERT_EQ(peers.packed.size(), 3u) << peers.left;
  double error = 1e300;
  for (const PeerFile& file : peers.packed) {
    EXPECT_LT(file.bytes, peers.glb.bytes);
    EXPECT_LT(file.distance.max, 0.6 * error) << "every two bits make it finer";
    EXPECT_GT(file.displacement.max, 0);
    error = file.distance.max;
  }
  EXPECT_LT(error, 1e-3 * diagonal(source.neutral));
}

}  // namespace
}  // namespace sweepface
