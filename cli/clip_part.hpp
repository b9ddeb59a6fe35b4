#pragma once

#include "performance.hpp"

namespace sweepface::cli {

/// The part of a performance between --clip-from and --clip-to, shifted to begin at 0 s.
Result<Performance> partOf(Performance played, const PerformanceArguments& a);

}  // namespace sweepface::cli
