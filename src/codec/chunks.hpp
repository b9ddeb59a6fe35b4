#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "codec/writer.hpp"

namespace sweepface::codec {

inline constexpr std::string_view kMagic = "SWEEPFC";
inline constexpr int kVersion = 2;             // that is written
inline constexpr std::size_t kHeaderSize = 8;  // magic and version
inline constexpr std::size_t kFrameSize = 12;  // kind, length and checksum

/// A kind of chunk and the part of a file it counts for.
struct Kind {
  std::string_view code, part;
};

/// The registry: in the order in which chunks stand in a file of each version. A code never changes
/// its meaning. One that begins with a capital is required: who does not know it must refuse the
/// file.
inline constexpr std::array<Kind, 14> kKinds1{{{"HEAD", "container"},
                                               {"WIRE", "wireframe"},
                                               {"CREA", "wireframe"},
                                               {"SHAP", "shape parameters"},
                                               {"NEUT", "neutral"},
                                               {"TARG", "targets"},
                                               {"loos", "loose vertices"},
                                               {"ordr", "source order"},
                                               {"poly", "polygons"},
                                               {"texc", "texture coordinates"},
                                               {"quad", "quad corners"},
                                               {"scen", "scene"},
                                               {"name", "names"},
                                               {"END ", "container"}}};
inline constexpr std::array<Kind, 19> kKinds2{{{"BASE", "container"},
                                               {"GRID", "wireframe"},
                                               {"TNAM", "names"},
                                               {"REST", "neutral"},
                                               {"MOVE", "targets"},
                                               {"EXAC", "exact vectors"},
                                               {"loos", "loose vertices"},
                                               {"drif", "loose vertices"},
                                               {"walk", "source order"},
                                               {"ordr", "source order"},
                                               {"face", "polygons"},
                                               {"poly", "polygons"},
                                               {"text", "texture coordinates"},
                                               {"texc", "texture coordinates"},
                                               {"quad", "quad corners"},
                                               {"scen", "scene"},
                                               {"name", "names"},
                                               {"turn", "turns"},
                                               {"END ", "container"}}};

/// The kinds of a version.
constexpr std::span<const Kind> kindsOf(int version) {
  return version == 1 ? std::span<const Kind>(kKinds1) : std::span<const Kind>(kKinds2);
}
/// Place of a code among the kinds of a version, or -1.
int rankOf(std::string_view code, int version = kVersion);

struct Chunk {
  int rank = -1;  ///< -1: an optional chunk of a kind unknown here
  std::string_view payload;
  std::size_t offset = 0;  ///< of the payload in the file
};

/// All chunks up to and with the last, with their checksums verified.
struct Chunks {
  int version = 0;
  std::vector<Chunk> list;
};
Result<Chunks> readChunks(std::string_view bytes, std::string_view name);

void writeHeader(Writer& out);
void writeChunk(Writer& out, std::string_view code, std::string_view payload);

}  // namespace sweepface::codec
