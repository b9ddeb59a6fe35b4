#include <algorithm>

#include "sweepface/codec.hpp"

#include "codec/chunks.hpp"

namespace sweepface {

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
    add(chunk.rank < 0 ? "unknown" : codec::kindsOf(chunks->version)[chunk.rank].part,
        chunk.payload.size());
  return parts;
}

}  // namespace sweepface
