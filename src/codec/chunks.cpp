#include "codec/chunks.hpp"

#include <algorithm>

#include "codec/crc.hpp"

namespace sweepface::codec {

int rankOf(std::string_view code, int version) {
  const std::string_view codes = codesOf(version);
  for (std::size_t at = 0; at < codes.size(); at += 4)
    if (codes.substr(at, 4) == code) return static_cast<int>(at / 4);
  return -1;
}

void writeHeader(Writer& out) {
  out.raw(kMagic);
  out.byte(kVersion);
}

void writeChunk(Writer& out, std::string_view code, std::string_view payload) {
  out.raw(code);
  out.fixed(static_cast<std::uint32_t>(payload.size()));
  out.fixed(crc32(payload, crc32(code)));
  out.raw(payload);
}

namespace {

std::uint32_t fixed32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * k);
  return value;
}

bool isCode(std::string_view code) {
  return std::ranges::all_of(code, [](char c) { return c >= ' ' && c <= '~'; });
}
bool isOptional(std::string_view code) { return code[0] < 'A' || code[0] > 'Z'; }

class ChunkReader {
 public:
  ChunkReader(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  Result<Chunks> read() {
    if (auto ok = readHeader(); !ok) return std::unexpected(ok.error());
    Chunks chunks{version_, {}};
    do {
      auto chunk = readChunk();
      if (!chunk) return std::unexpected(chunk.error());
      chunks.list.push_back(*chunk);
    } while (chunks.list.back().rank != rankOf("END ", version_));
    if (at_ < bytes_.size()) return failHere("the file goes on after its last chunk");
    return chunks;
  }

 private:
  template <typename... Parts>
  [[gnu::always_inline]] std::unexpected<Error> failHere(const Parts&... what) const {
    return fail(name_, ", byte ", at_, ": ", what...,
                "; copy the file again or convert the source again.");
  }

  Result<void> readHeader() {
    if (bytes_.empty()) return failWith({name_, " is empty; convert the source again."});
    if (!bytes_.starts_with(kMagic))
      return failWith(
          {name_, " does not begin with ", kMagic, "; check that it is a .sweep file."});
    at_ = kMagic.size();
    if (bytes_.size() < kHeaderSize) return failHere("the file ends before its version");
    version_ = static_cast<unsigned char>(bytes_[at_]);
    if (version_ < 1 || version_ > kVersion)
      return failWith({name_, " is of version ", version_, " and this program reads versions 1 to ",
                       kVersion, "; get a program that fits or convert the source again."});
    at_ = kHeaderSize;
    return {};
  }

  Result<Chunk> readChunk() {
    if (bytes_.size() - at_ < kFrameSize) return failHere("the file ends before its last chunk");
    const std::string_view code = bytes_.substr(at_, 4);
    if (!isCode(code)) return failHere("there is no chunk where one must begin");
    const std::uint32_t size = fixed32(bytes_.substr(at_ + 4)),
                        sum = fixed32(bytes_.substr(at_ + 8));
    if (size > bytes_.size() - at_ - kFrameSize)
      return failHere("the file ends within chunk '", code, "'");
    const Chunk chunk{rankOf(code, version_), bytes_.substr(at_ + kFrameSize, size),
                      at_ + kFrameSize};
    if (crc32(chunk.payload, crc32(code)) != sum)
      return failHere("the checksum of chunk '", code, "' does not match");
    if (chunk.rank < 0 && !isOptional(code))
      return fail(name_, ", byte ", at_, ": chunk '", code,
                  "' is required and unknown to this program; get a newer one.");
    at_ = chunk.offset + size;
    return chunk;
  }

  std::string_view bytes_;
  std::string_view name_;
  std::size_t at_ = 0;
  int version_ = 0;
};

}  // namespace

Result<Chunks> readChunks(std::string_view bytes, std::string_view name) {
  return ChunkReader(bytes, name).read();
}

}  // namespace sweepface::codec
