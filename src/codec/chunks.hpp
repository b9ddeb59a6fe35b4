#pragma once

#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "codec/writer.hpp"

namespace sweepface::codec {

inline constexpr std::string_view kMagic = "SWEEPFC";
inline constexpr int kVersion = 2;             // the version written
inline constexpr std::size_t kHeaderSize = 8;  // magic and version
inline constexpr std::size_t kFrameSize = 12;  // kind, length and checksum

/// The registry: the concatenated chunk codes of a version, in the order of the chunks in a file. A
/// code never changes its meaning. A chunk whose code begins with a capital is required: a reader
/// that does not know it must refuse the file.
constexpr std::string_view codesOf(int version) {
  using namespace std::string_view_literals;
  return version == 1
             ? "HEADWIRECREASHAPNEUTTARGloosordrpolytexcquadscennameEND "sv
             : "BASEGRIDTNAMRESTMOVEEXACloosdrifwalkordrfacepolytexttexcquadscennameturnEND "sv;
}
constexpr std::string_view codeAt(int rank, int version) {
  return codesOf(version).substr(4 * static_cast<std::size_t>(rank), 4);
}
/// Position of a code in the registry of a version, or -1.
int rankOf(std::string_view code, int version = kVersion);

struct Chunk {
  int rank = -1;  ///< -1: an optional chunk of a kind unknown here
  std::string_view payload;
  std::size_t offset = 0;  ///< of the payload in the file
};

/// All chunks up to and including the last, with verified checksums.
struct Chunks {
  int version = 0;
  std::vector<Chunk> list;
};
Result<Chunks> readChunks(std::string_view bytes, std::string_view name);

void writeHeader(Writer& out);
void writeChunk(Writer& out, std::string_view code, std::string_view payload);

}  // namespace sweepface::codec
