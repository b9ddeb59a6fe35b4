#pragma once

#include <optional>
#include <vector>

#include "gltf/builder.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Places for the values of parts: the accessors that they have, unless something else uses those
/// too or they were given values before.
class Slots {
 public:
  Slots(const Document& document, const Parts& parts, Builder& builder);

  /// The accessor in which the values are now.
  std::size_t put(std::optional<std::size_t> accessor, const Column& column, Use use);

 private:
  std::vector<bool> taken_;  // [accessors]
  Builder& builder_;
};

}  // namespace sweepface::gltf
