#pragma once

#include <span>
#include <vector>

#include "performance.hpp"

namespace sweepface::cli {

/// Parses the text of the --clip file; one performance for every region [R].
Result<std::vector<Performance>> byClip(const PerformanceArguments& a, const std::string& text,
                                        const Rig& rig, std::span<const Region> regions);

}  // namespace sweepface::cli
