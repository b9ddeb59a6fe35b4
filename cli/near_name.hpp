#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sweepface::cli {

/// The one of `names` that a wrong name was probably meant to be: one that clips would match with
/// it, or else the closest within two letters; empty if there is none.
std::string nearName(std::string_view name, std::span<const std::string> names);

}  // namespace sweepface::cli
