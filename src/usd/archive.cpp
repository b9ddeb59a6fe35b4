#include "usd/archive.hpp"

#include <cstdint>
#include <zlib.h>

namespace sweepface::usd {
namespace {

// APPNOTE.TXT, the specification of PKWARE, 4.3.
constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEnd = 0x06054b50;
constexpr std::size_t kMostHeaderBytes = 192;  // of a file, names aside, or of the end
constexpr std::size_t kLocalBytes = 30, kAlignment = 64, kMost = 0xFFFFFFFF;
constexpr unsigned kVersion = 10, kUtf8 = 1 << 11, kDay = 0x21;  // the first of 1980
constexpr unsigned kPadding = 0x1986;                            // OpenUSD's kind of extra field

void append(std::string& bytes, std::size_t value, int width) {
  for (int k = 0; k < width; ++k) bytes += static_cast<char>(value >> (8 * k) & 255);
}

/// What a local header and one of the central directory have alike, from the version needed on.
std::string described(const ArchiveFile& file, std::size_t extra) {
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(file.bytes.data()), file.bytes.size());
  std::string bytes;
  for (const unsigned half : {kVersion, kUtf8, 0u, 0u, kDay}) append(bytes, half, 2);
  for (const std::size_t word : {std::size_t{crc}, file.bytes.size(), file.bytes.size()})
    append(bytes, word, 4);
  append(bytes, file.name.size(), 2);
  append(bytes, extra, 2);
  return bytes;
}

/// The extra field that brings the data of a file to its place.
std::string padding(std::size_t dataAt) {
  std::size_t missing = (kAlignment - dataAt % kAlignment) % kAlignment;
  if (missing == 0) return {};
  if (missing < 4) missing += kAlignment;  // its own header
  std::string extra;
  append(extra, kPadding, 2);
  append(extra, missing - 4, 2);
  extra.resize(missing);
  return extra;
}

}  // namespace

Result<std::string> archive(std::span<const ArchiveFile> files) {
  std::string bytes, directory;
  std::size_t size = kMostHeaderBytes;
  for (const ArchiveFile& file : files)
    size += file.bytes.size() + 2 * file.name.size() + kMostHeaderBytes;
  bytes.reserve(size);  // a layer is large: there is no room for it thrice
  for (const ArchiveFile& file : files) {
    const std::size_t start = bytes.size();
    const std::string extra = padding(start + kLocalBytes + file.name.size());
    append(bytes, kLocal, 4);
    bytes += described(file, extra.size());
    bytes += file.name;
    bytes += extra;
    bytes += file.bytes;

    append(directory, kCentral, 4);
    append(directory, kVersion, 2);
    directory += described(file, 0);
    for (int k = 0; k < 3; ++k) append(directory, 0, 2);  // no comment, disk 0, no attributes
    append(directory, 0, 4);
    append(directory, start, 4);
    directory += file.name;
    if (bytes.size() + directory.size() > kMost)
      return fail("The file would be larger than the 4 GiB of a USDZ.");
  }
  const std::size_t start = bytes.size();
  bytes += directory;
  append(bytes, kEnd, 4);
  for (const std::size_t half : {std::size_t{0}, std::size_t{0}, files.size(), files.size()})
    append(bytes, half, 2);
  append(bytes, directory.size(), 4);
  append(bytes, start, 4);
  append(bytes, 0, 2);
  return bytes;
}

}  // namespace sweepface::usd
