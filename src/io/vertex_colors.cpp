#include "io/vertex_colors.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include "sweepface/io.hpp"

#include "io/ply_header.hpp"
#include "io/text.hpp"

namespace sweepface::io {
namespace {

bool isColoredPly(std::string_view bytes) {
  const auto header = parsePlyHeader(bytes, {});
  const PlyElement* const vertex = header ? header->find("vertex") : nullptr;
  return vertex && vertex->find({"red", "diffuse_red", "r"}) >= 0;
}

/// Whether the first vertex has three numbers or more after its position; one is a weight.
bool isColoredObj(std::string_view text) {
  LineCursor lines(withoutMark(text));
  while (lines.next()) {
    Words words(lines.line());
    if (words.next() != "v") continue;
    int count = 0;
    while (toNumber<double>(words.next())) ++count;
    return count >= 6;
  }
  return false;
}

}  // namespace

bool hasVertexColors(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe is read only once
  std::string start(std::size_t{1} << 20, '\0');  // where headers and the first vertex are
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return extensionOf(path) == ".ply" ? isColoredPly(start) : isColoredObj(start);
}

}  // namespace sweepface::io
