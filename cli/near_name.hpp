#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sweepface::cli {

/// Which of the names somebody may have meant who wrote another: one that clips would match with
/// it, or else the nearest within two letters; empty where there is none.
std::string nearName(std::string_view name, std::span<const std::string> names);

}  // namespace sweepface::cli
