#include "usd/archive.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <vector>

namespace sweepface::usd {
namespace {

std::uint32_t word(const std::string& bytes, std::size_t at, std::size_t width = 4) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, width);
  return value;
}

// Names of all lengths, so that every padding is needed.
TEST(Archive, HasFilesAtMultiplesOf64Bytes) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= 70; ++k) names.emplace_back(k, 'n');
  std::vector<ArchiveFile> files;
  for (const std::string& name : names) files.push_back({name, "123456789"});
  const std::string bytes = archive(files).value();
  std::size_t at = 0;
  for (const std::string& name : names) {
    ASSERT_EQ(word(bytes, at), 0x04034b50u);
    EXPECT_EQ(word(bytes, at + 14), 0xCBF43926u) << "the checksum of 123456789";
    const std::size_t data = at + 30 + word(bytes, at + 26, 2) + word(bytes, at + 28, 2);
    EXPECT_EQ(bytes.substr(at + 30, name.size()), name);
    EXPECT_EQ(data % 64, 0u);
    EXPECT_EQ(bytes.substr(data, 9), "123456789");
    at = data + 9;
  }
}

TEST(Archive, EndsWithADirectory) {
  const std::vector<ArchiveFile> files{{"a.usda", "layer"}, {"b/c.png", ""}};
  const std::string bytes = archive(files).value();
  const std::size_t end = bytes.size() - 22, directory = word(bytes, end + 16);
  EXPECT_EQ(word(bytes, end), 0x06054b50u);
  EXPECT_EQ(word(bytes, end + 8, 2), 2u);
  EXPECT_EQ(word(bytes, end + 10, 2), 2u);
  EXPECT_EQ(directory + word(bytes, end + 12), end);
  EXPECT_EQ(word(bytes, directory), 0x02014b50u);
  EXPECT_EQ(word(bytes, directory + 20), 5u);
  EXPECT_EQ(word(bytes, directory + 42), 0u);
  const std::size_t second = directory + 46 + 6;
  EXPECT_EQ(bytes.substr(second + 46, 7), "b/c.png");
  EXPECT_EQ(word(bytes, word(bytes, second + 42)), 0x04034b50u);
}

}  // namespace
}  // namespace sweepface::usd
