#include "gltf/slots.hpp"

#include "gltf/accessor_uses.hpp"

namespace sweepface::gltf {

Slots::Slots(const Document& document, const Parts& parts, Builder& builder)
    : taken_(usedAccessors(document, parts, [](std::string_view, const Json&) { return false; })),
      builder_(builder) {}

std::size_t Slots::put(std::optional<std::size_t> accessor, const Column& column, Use use) {
  if (!accessor || *accessor >= taken_.size() || taken_[*accessor])
    return builder_.add(column, use);
  taken_[*accessor] = true;
  builder_.set(*accessor, column, use);
  return *accessor;
}

}  // namespace sweepface::gltf
