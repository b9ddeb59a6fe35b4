#include "gltf/moved_weights.hpp"

#include <charconv>

namespace sweepface::gltf {
namespace {

/// N of "/nodes/N/weights", if it is below `count`.
std::optional<std::size_t> numberIn(std::string_view pointer, std::string_view start,
                                    std::size_t count) {
  constexpr std::string_view end = "/weights";
  if (!pointer.starts_with(start) || !pointer.ends_with(end)) return std::nullopt;
  std::size_t number = 0;
  const char* const digits = pointer.data() + start.size();
  const auto [after, error] = std::from_chars(digits, pointer.data() + pointer.size(), number);
  const bool alone = std::string_view(after, pointer.data() + pointer.size()) == end;
  return error == std::errc() && alone && number < count ? std::optional(number) : std::nullopt;
}

std::string_view pointerOf(const Json& target) {
  const Json* const extensions = find(target, "extensions");
  const Json* const extension = extensions ? find(*extensions, "KHR_animation_pointer") : nullptr;
  const Json* const pointer = extension ? find(*extension, "pointer") : nullptr;
  if (!pointer || !pointer->is_string()) return {};
  return pointer->get_ref<const std::string&>();
}

}  // namespace

std::optional<MovedWeights> movedWeights(const Document& document, const Json& target) {
  const Json* const path = find(target, "path");
  if (!path) return std::nullopt;
  const std::size_t nodes = document.list("nodes").size();
  std::optional<std::size_t> node;
  if (*path == "weights") node = findIndex(target, "node", nodes);
  const std::string_view pointer = *path == "pointer" ? pointerOf(target) : std::string_view();
  if (!node) node = numberIn(pointer, "/nodes/", nodes);
  if (node) return MovedWeights{true, *node};
  const auto mesh = numberIn(pointer, "/meshes/", document.list("meshes").size());
  return mesh ? std::optional(MovedWeights{false, *mesh}) : std::nullopt;
}

}  // namespace sweepface::gltf
