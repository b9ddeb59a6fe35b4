#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "codec/writer.hpp"

namespace sweepface::codec {

inline constexpr std::string_view kMagic = "SWEEPFC";
inline constexpr unsigned char kVersion = 1;
inline constexpr std::size_t kHeaderSize = 8;  // magic and version
inline constexpr std::size_t kFrameSize = 12;  // kind, length and checksum

/// A kind of chunk and the part of a file it counts for.
struct Kind {
  std::string_view code, part;
};

/// The registry: in the order in which chunks stand in a file. A code never changes its meaning.
/// One that begins with a capital is required: who does not know it must refuse the file.
inline constexpr std::array<Kind, 14> kKinds{{{"HEAD", "container"},
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

/// Place of a code in the registry, or -1.
int rankOf(std::string_view code);

struct Chunk {
  int rank = -1;  ///< -1: an optional chunk of a kind unknown here
  std::string_view payload;
  std::size_t offset = 0;  ///< of the payload in the file
};

/// All chunks up to and with the last, with their checksums verified.
Result<std::vector<Chunk>> readChunks(std::string_view bytes, std::string_view name);

void writeHeader(Writer& out);
void writeChunk(Writer& out, std::string_view code, std::string_view payload);

}  // namespace sweepface::codec
