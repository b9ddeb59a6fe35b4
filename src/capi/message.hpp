#pragma once

#include <string>
#include <string_view>

#include "sweepface/result.hpp"
#include "sweepface/sweepface.h"

namespace sweepface::capi {

/// Keeps the sentence for sweepface_message() and gives the status back.
sweepface_status refuse(sweepface_status status, std::string_view message);
inline sweepface_status refuse(std::string_view message) {
  return refuse(SWEEPFACE_BAD_ARGUMENT, message);
}
/// Not said by a module that is called by sweepface.js only (web/src/usual.cpp).
sweepface_status refuseWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline sweepface_status refuse(const char* first, const Parts&... rest) {
  return refuseWith({TextPart(first), TextPart(rest)...});
}
/// Always said.
sweepface_status refuseCallWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline sweepface_status refuseCall(const Parts&... parts) {
  return refuseCallWith({TextPart(parts)...});
}

/// The sentence about something that `count` there are of, and `index` is not one.
sweepface_status noSuch(const char* what, std::size_t index, std::size_t count);

/// What messages call something: the caller's name of it, if there is one.
inline const char* calledOr(const char* name, const char* usual) {
  return name && *name ? name : usual;
}

/// The status of a result without a value.
sweepface_status statusOf(Result<void> result);

}  // namespace sweepface::capi
