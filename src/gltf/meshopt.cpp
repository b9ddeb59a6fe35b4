#include "gltf/meshopt.hpp"

#include <cstdint>
#include <fmt/format.h>
#include <meshoptimizer.h>

namespace sweepface::gltf {
namespace {

// The most that a byte can stand for: vertices take two bits for 16 equal bytes, triangles a byte
// for three indices, a sequence a byte per index.
bool isPlausible(const MeshoptStream& s) {
  const std::uint64_t bytes = std::uint64_t{s.count} * s.stride;  // below 2^53 · 2^8
  if (bytes > std::string().max_size()) return false;
  if (s.mode == "ATTRIBUTES") return bytes / 64 <= s.length;
  return s.count / (s.mode == "TRIANGLES" ? 3 : 1) <= s.length;
}

void checkShape(Members& in, const MeshoptStream& s) {
  if (s.mode == "ATTRIBUTES") {
    if (s.stride == 0 || s.stride > 256 || s.stride % 4 != 0)
      in.refuse("the byteStride of a compressed view is not 4, 8, ... 256");
  } else if (s.mode == "TRIANGLES" || s.mode == "INDICES") {
    if (s.stride != 2 && s.stride != 4)
      in.refuse("the byteStride of compressed indices is neither 2 nor 4");
    if (s.mode == "TRIANGLES" && s.count % 3 != 0)
      in.refuse("the count of compressed triangles is not a multiple of 3");
    if (s.filter != "NONE") in.refuse("compressed indices have a filter");
  } else {
    in.refuse("the mode of a compressed view is missing or unknown");
  }
}

void checkFilter(Members& in, const MeshoptStream& s) {
  if (s.filter == "OCTAHEDRAL") {
    if (s.stride != 4 && s.stride != 8)
      in.refuse("the filter OCTAHEDRAL has a byteStride not 4 or 8");
  } else if (s.filter == "QUATERNION") {
    if (s.stride != 8) in.refuse("the filter QUATERNION has a byteStride other than 8");
  } else if (s.filter != "EXPONENTIAL" && s.filter != "NONE") {
    in.refuse(fmt::format("the filter '{}' of a compressed view is unknown", s.filter));
  }
}

int decodeStream(const MeshoptStream& s, std::string_view bytes, char* to) {
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  if (s.mode == "ATTRIBUTES")
    return meshopt_decodeVertexBuffer(to, s.count, s.stride, from, bytes.size());
  if (s.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(to, s.count, s.stride, from, bytes.size());
  return meshopt_decodeIndexSequence(to, s.count, s.stride, from, bytes.size());
}

void undoFilter(const MeshoptStream& s, char* elements) {
  if (s.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(elements, s.count, s.stride);
  if (s.filter == "QUATERNION") meshopt_decodeFilterQuat(elements, s.count, s.stride);
  if (s.filter == "EXPONENTIAL") meshopt_decodeFilterExp(elements, s.count, s.stride);
}

/// Whether a stream begins like one of its mode, whatever its version.
bool isOfMode(const MeshoptStream& s, std::string_view bytes) {
  const unsigned kind = s.mode == "ATTRIBUTES" ? 0xA0 : s.mode == "TRIANGLES" ? 0xE0 : 0xD0;
  return !bytes.empty() && (static_cast<unsigned char>(bytes[0]) & 0xF0) == kind;
}

}  // namespace

const Json* meshoptOf(const Json& view) {
  const Json* const extensions = find(view, "extensions");
  if (!extensions) return nullptr;
  for (const char* name : {"KHR_meshopt_compression", "EXT_meshopt_compression"})
    if (const Json* found = find(*extensions, name)) return found;
  return nullptr;
}

MeshoptStream readMeshopt(Members& in, std::size_t buffers) {
  MeshoptStream s;
  s.buffer = in.index("buffer", buffers, "buffers");
  s.offset = in.size("byteOffset", 0);
  s.length = in.size("byteLength");
  s.count = in.size("count");
  s.stride = in.size("byteStride");
  s.mode = in.text("mode");
  s.filter = in.has("filter") ? in.text("filter") : "NONE";
  checkShape(in, s);
  checkFilter(in, s);
  if (in.ok() && s.count == 0) in.refuse("a compressed view has a count of 0");
  if (in.ok() && !isPlausible(s))
    in.refuse(
        fmt::format("{} bytes of compressed view cannot hold {} elements", s.length, s.count));
  return s;
}

std::string decodeMeshopt(Members& in, const MeshoptStream& s, std::string_view bytes) {
  std::string elements(s.count * s.stride, '\0');
  const int code = decodeStream(s, bytes, elements.data());
  if (code == 0) {
    undoFilter(s, elements.data());
    return elements;
  }
  // The library's code for a first byte that it does not know.
  if (code == -1 && isOfMode(s, bytes))
    in.refuse(fmt::format("it is compressed with version {} of meshopt, which this program does "
                          "not read",
                          bytes[0] & 15),
              "decompress the file with `npx gltfpack -i IN.glb -o OUT.glb -noq -kn -km -ke`");
  in.refuse("what it holds compressed is damaged");
  return {};
}

}  // namespace sweepface::gltf
