#include <algorithm>

#include "sweepface/codec.hpp"

#include "codec/chunks.hpp"

namespace sweepface {

namespace codec {
namespace {

/// The part of a file that a kind of chunk counts towards.
struct KindPart {
  std::string_view code, part;
};
constexpr KindPart kParts[] = {{"HEAD", "container"},
                               {"WIRE", "wireframe"},
                               {"CREA", "wireframe"},
                               {"SHAP", "shape parameters"},
                               {"NEUT", "neutral"},
                               {"TARG", "targets"},
                               {"BASE", "container"},
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
                               {"END ", "container"}};

constexpr const KindPart* find(std::string_view code) {
  return std::ranges::find(kParts, code, &KindPart::code);
}
constexpr bool knowsAll(int version) {
  for (std::size_t at = 0; at < codesOf(version).size(); at += 4)
    if (find(codesOf(version).substr(at, 4)) == std::end(kParts)) return false;
  return true;
}
static_assert(knowsAll(1) && knowsAll(2));

std::string_view partOf(std::string_view code) { return find(code)->part; }

}  // namespace
}  // namespace codec

Result<std::vector<FilePart>> fileParts(std::string_view bytes, std::string_view name) {
  const auto chunks = codec::readChunks(bytes, name);
  if (!chunks) return std::unexpected(chunks.error());
  std::vector<FilePart> parts;
  const auto add = [&](std::string_view part, std::size_t size) {
    auto found = std::ranges::find(parts, part, &FilePart::name);
    if (found == parts.end()) found = parts.insert(parts.end(), {std::string(part), 0});
    found->bytes += size;
  };
  add("container", codec::kHeaderSize + chunks->list.size() * codec::kFrameSize);
  for (const codec::Chunk& chunk : chunks->list)
    add(chunk.rank < 0 ? "unknown" : codec::partOf(codec::codeAt(chunk.rank, chunks->version)),
        chunk.payload.size());
  return parts;
}

}  // namespace sweepface
