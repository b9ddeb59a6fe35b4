#pragma once

#include <span>
#include <vector>

#include "performance.hpp"

namespace sweepface::cli {

/// What the file of --clip, of this text, tells, as every region [R] plays it.
Result<std::vector<Performance>> byClip(const PerformanceArguments& a, const std::string& text,
                                        const Rig& rig, std::span<const Region> regions);

}  // namespace sweepface::cli
