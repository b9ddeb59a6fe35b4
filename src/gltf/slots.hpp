#pragma once

#include <optional>
#include <vector>

#include "gltf/builder.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Finds accessors for the values of parts: those that they have, unless something else uses them
/// too or they have been given values before.
class Slots {
 public:
  Slots(const Document& document, const Parts& parts, Builder& builder);

  /// Stores the values and returns the accessor that has them now.
  std::size_t put(std::optional<std::size_t> accessor, const Column& column, Use use);

 private:
  std::vector<bool> taken_;  // [accessors]
  Builder& builder_;
};

}  // namespace sweepface::gltf
