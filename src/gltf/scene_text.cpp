#include <algorithm>
#include <tuple>
#include <vector>

#include "gltf/accessor.hpp"
#include "gltf/byte_planes.hpp"
#include "gltf/deflate.hpp"
#include "gltf/scene.hpp"

namespace sweepface::gltf {
namespace {

/// Precedes a zlib stream of planes. No zlib stream and no GLB begins with it.
constexpr char planesMark = '\1';

/// The rows of numbers that an accessor lies in, with those of others interleaved with it.
ByteTable rowsOf(const Document& document, const Accessor& accessor) {
  const BufferView& view = document.views[*accessor.view];
  const std::size_t width = view.stride ? view.stride : accessor.elementSize();
  // The last row of a view may end early.
  const std::size_t whole = (view.length - accessor.offset) / width;
  return {view.offset + accessor.offset, width, std::min(accessor.count, whole)};
}

/// Tables in ascending order that do not overlap: of overlapping ones, the first and then the
/// longest.
std::vector<ByteTable> tablesOf(const Document& document) {
  std::vector<ByteTable> tables;
  for (std::size_t a = 0; a < document.list("accessors").size(); ++a)
    if (const auto accessor = accessorAt(document, a); accessor && accessor->view)
      tables.push_back(rowsOf(document, *accessor));
  std::ranges::sort(tables, [](const ByteTable& a, const ByteTable& b) {
    return std::tuple(a.begin, b.size(), b.width) < std::tuple(b.begin, a.size(), a.width);
  });
  std::size_t end = 0;
  std::erase_if(tables, [&](const ByteTable& table) {
    if (table.begin < end) return true;
    end = table.end();
    return false;
  });
  return tables;
}

/// The same, at their places in a GLB.
std::vector<ByteTable> tablesOf(std::string_view glb) {
  const auto document = parseDocument(glb, {});
  if (!document || document->buffers.empty()) return {};
  const std::size_t padded = (document->buffers[0].size() + 3) / 4 * 4;
  std::vector<ByteTable> tables = tablesOf(*document);
  for (ByteTable& table : tables) table.begin += glb.size() - padded;
  return tables;
}

}  // namespace

std::string formatScene(const std::string& glb) {
  const std::string planes = toPlanes(glb, tablesOf(glb));
  const std::string& text = planes.empty() ? glb : planes;
  const std::string stream = deflated(text);
  if (text.size() > mostInflated(stream.size())) return glb;
  return planes.empty() ? stream : planesMark + stream;
}

Result<std::string> glbOf(std::string_view scene) {
  if (scene.starts_with("glTF")) return std::string(scene);
  if (!scene.starts_with(planesMark)) return inflated(scene);
  const auto planes = inflated(scene.substr(1));
  return planes ? fromPlanes(*planes) : planes;
}

Result<Document> parseScene(std::string_view scene) {
  const auto glb = glbOf(scene);
  if (!glb) return std::unexpected(glb.error());
  return parseDocument(*glb, {});
}

}  // namespace sweepface::gltf
