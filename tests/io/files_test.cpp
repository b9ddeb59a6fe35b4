#include <gtest/gtest.h>
#include <unistd.h>

#include "sweepface/io.hpp"

#include "io/temporary_folder.hpp"

namespace sweepface {
namespace {

namespace fs = std::filesystem;
using testing::failsWith;
using testing::TemporaryFolder;

TEST(Files, AreWrittenAndReadWhole) {
  const TemporaryFolder folder;
  std::string bytes("\0\r\n\xff", 4);
  bytes.append(300'000, 'x');
  ASSERT_TRUE(writeFile(folder / "a.bin", bytes).has_value());
  EXPECT_EQ(readFile(folder / "a.bin").value(), bytes);
  ASSERT_TRUE(writeFile(folder / "a.bin", "").has_value());
  EXPECT_EQ(readFile(folder / "a.bin").value(), "");
  EXPECT_EQ(folder.fileCount(), 1u) << "no temporary file stays";
}

TEST(Files, AreWrittenBesideWhatBrokenOffWritingLeft) {
  const TemporaryFolder folder;
  const fs::path left = folder.file(".sweepface-0.tmp", "half");
  ASSERT_TRUE(writeFile(folder / "a.bin", "new").has_value());
  EXPECT_EQ(readFile(folder / "a.bin").value(), "new");
  EXPECT_EQ(readFile(left).value(), "half");
  EXPECT_EQ(folder.fileCount(), 2u);
}

TEST(Files, OfBareNamesAreInTheCurrentFolder) {
  EXPECT_EQ(folderOf("a.txt"), ".");
  EXPECT_EQ(folderOf("sub/a.txt"), "sub");
  EXPECT_EQ(folderOf("/a.txt"), "/");
}

TEST(Files, HaveExtensionsInSmallLetters) {
  EXPECT_EQ(extensionOf("sub.d/face.GLB"), ".glb");
  EXPECT_EQ(extensionOf("sub.d/face"), "");
  EXPECT_EQ(extensionOf("sub/.glb"), ".glb");
  EXPECT_EQ(extensionOf("sub/.hidden.obj"), ".obj");
}

TEST(Files, MayHaveTheLongestOfNames) {
  const TemporaryFolder folder;
  EXPECT_TRUE(writeFile(folder / std::string(255, 'n'), "x").has_value());
  EXPECT_TRUE(failsWith(writeFile(folder / std::string(256, 'n'), "x"), {"choose a shorter name"}));
}

TEST(Files, MayBeCalledAnythingInUtf8) {
  const TemporaryFolder folder;
  const fs::path path = folder / "" / utf8Path("Köpfe 顔.txt");
  ASSERT_TRUE(writeFile(path, "old"));
  ASSERT_TRUE(writeFile(path, "new"));
  EXPECT_EQ(readFile(path).value(), "new");
  EXPECT_TRUE(
      failsWith(readFile(folder / "" / utf8Path("größer.txt")), {"größer.txt", "no such file"}));
}

TEST(Files, ThatCannotBeReadSayWhy) {
  const TemporaryFolder folder;
  EXPECT_TRUE(failsWith(readFile(folder / "none.obj"), {"none.obj", "no such file"}));
  EXPECT_TRUE(failsWith(readFile(folder / ""), {"is a folder"}));
  EXPECT_TRUE(failsWith(readFile(""), {"no such file"}));
}

#ifndef _WIN32  // links are for administrators there, and permissions of another kind

TEST(Files, AreWrittenThroughLinks) {
  const TemporaryFolder folder;
  folder.file("real/a.txt", "old");
  fs::create_symlink(folder / "real/a.txt", folder / "link");
  ASSERT_TRUE(writeFile(folder / "link", "new").has_value());
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readFile(folder / "real/a.txt").value(), "new");
}

TEST(Files, AreWrittenThroughLinksToWhatIsNotThereYet) {
  const TemporaryFolder folder;
  folder.file("real/other", "x");
  fs::create_symlink("real/second", folder / "first");
  fs::create_symlink("new.txt", folder / "real/second");
  ASSERT_TRUE(writeFile(folder / "first", "new").has_value());
  EXPECT_TRUE(fs::is_symlink(folder / "first"));
  EXPECT_TRUE(fs::is_symlink(folder / "real/second"));
  EXPECT_EQ(readFile(folder / "real/new.txt").value(), "new");
}

TEST(Files, AreNotWrittenThroughLinksInACircle) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_TRUE(failsWith(writeFile(folder / "a", "x"), {"Cannot write", "round in a circle"}));
  EXPECT_TRUE(fs::is_symlink(folder / "a"));
}

TEST(Files, KeepTheirPermissionsWhenReplaced) {
  const TemporaryFolder folder;
  const fs::path file = folder.file("mine", "old");
  constexpr fs::perms own = fs::perms::owner_read | fs::perms::owner_write;
  for (const fs::perms kept : {own, own | fs::perms::others_write}) {
    fs::permissions(file, kept);
    ASSERT_TRUE(writeFile(file, "new").has_value());
    EXPECT_EQ(fs::status(file).permissions(), kept);
  }
}

TEST(Files, WithoutPermissionSaySo) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is forbidden to root";
  const TemporaryFolder folder;
  const fs::path file = folder.file("locked/secret.obj", "v 0 0 0\n");
  fs::permissions(file, fs::perms::none);
  EXPECT_TRUE(failsWith(readFile(file), {"secret.obj", "ermission"}));
  EXPECT_TRUE(failsWith(writeFile(file, "v 1 1 1\n"), {"secret.obj", "ermission"}));
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_TRUE(
      failsWith(writeFile(folder / "locked/new.obj", "x"), {"new.obj", "takes no new file"}));
  fs::permissions(folder / "locked", fs::perms::owner_all);
}

#endif

TEST(Files, ThatCannotBeWrittenSayWhy) {
  const TemporaryFolder folder;
  folder.file("file", "kept");
  EXPECT_TRUE(failsWith(writeFile(folder / "none/a.obj", "x"),
                        {"none/a.obj", "does not exist", "create it"}));
  EXPECT_TRUE(failsWith(writeFile(folder / "file/a.obj", "x"), {"file/a.obj", "is not a folder"}));
  EXPECT_TRUE(failsWith(writeFile(folder / "", "x"), {"is a folder"}));
  EXPECT_TRUE(failsWith(writeFile("", "x"), {"without a name"}));
  EXPECT_EQ(readFile(folder / "file").value(), "kept");
}

TEST(Files, OnAFullDiskSaySo) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no full device here";
  EXPECT_TRUE(failsWith(writeFile("/dev/full", "x"), {"/dev/full", "No space left"}));
  EXPECT_TRUE(failsWith(writeFile("/dev/full", std::string(1 << 20, 'x')), {"No space left"}));
  EXPECT_FALSE(fs::is_regular_file("/dev/full")) << "a device is not replaced";
}

}  // namespace
}  // namespace sweepface
