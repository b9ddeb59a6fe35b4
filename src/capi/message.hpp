#pragma once

#include <string>
#include <string_view>

#include "sweepface/result.hpp"
#include "sweepface/sweepface.h"

namespace sweepface::capi {

/// Keeps the message for sweepface_message() and returns the status.
sweepface_status refuse(sweepface_status status, std::string_view message);
inline sweepface_status refuse(std::string_view message) {
  return refuse(SWEEPFACE_BAD_ARGUMENT, message);
}
/// Gives no message in a module that only sweepface.js calls (web/src/usual.cpp).
sweepface_status refuseWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline sweepface_status refuse(const char* first, const Parts&... rest) {
  return refuseWith({TextPart(first), TextPart(rest)...});
}
/// Gives its message in every module.
sweepface_status refuseCallWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline sweepface_status refuseCall(const Parts&... parts) {
  return refuseCallWith({TextPart(parts)...});
}

/// Refuses an `index` of something of which there are only `count`.
sweepface_status noSuch(const char* what, std::size_t index, std::size_t count);

/// What messages call something: the caller's name for it, if there is one.
inline const char* calledOr(const char* name, const char* usual) {
  return name && *name ? name : usual;
}

/// The status of a result without a value.
sweepface_status statusOf(Result<void> result);

}  // namespace sweepface::capi
