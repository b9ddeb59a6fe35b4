#pragma once

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

#include "codec/chunks.hpp"

// Splits files into chunks and puts them together again.
namespace sweepface::testing {

/// The content of a file stored beside the tests.
inline std::string goldenFile(const std::string& name) {
  std::ifstream file(SWEEPFACE_SOURCE_DIR "/tests/codec/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct FileChunk {
  std::string code, payload;
};

/// The chunks of a file, and the header before them.
struct TakenApart : std::vector<FileChunk> {
  std::string header;
};

inline TakenApart takeApart(const std::string& bytes) {
  TakenApart chunks;
  chunks.header = bytes.substr(0, codec::kHeaderSize);
  const auto whole = codec::readChunks(bytes, "whole.sweep").value();
  for (const codec::Chunk& chunk : whole.list)
    chunks.push_back(
        {bytes.substr(chunk.offset - codec::kFrameSize, 4), std::string(chunk.payload)});
  return chunks;
}

/// A file made of the chunks, with matching checksums.
inline std::string putTogether(const TakenApart& chunks) {
  codec::Writer out;
  out.raw(chunks.header);
  for (const FileChunk& chunk : chunks) codec::writeChunk(out, chunk.code, chunk.payload);
  return out.take();
}

inline FileChunk& chunkOf(TakenApart& chunks, std::string_view code) {
  for (FileChunk& chunk : chunks)
    if (chunk.code == code) return chunk;
  ADD_FAILURE() << "no chunk " << code;
  return chunks.front();
}

/// The file with the payload of its first chunk with this code replaced.
inline std::string withPayload(const std::string& bytes, std::string_view code,
                               std::string payload) {
  auto chunks = takeApart(bytes);
  chunkOf(chunks, code).payload = std::move(payload);
  return putTogether(chunks);
}

/// The payload that `write` writes.
template <typename Write>
std::string payloadOf(Write write) {
  codec::Writer out;
  write(out);
  return out.take();
}

}  // namespace sweepface::testing
