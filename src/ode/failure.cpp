#include "sweepface/result.hpp"

namespace sweepface {

std::unexpected<Error> failWith(std::initializer_list<TextPart> parts) {
  return failCallWith(parts);
}

}  // namespace sweepface
