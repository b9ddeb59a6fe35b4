#pragma once

#include "performance.hpp"

namespace sweepface::cli {

/// What --clip-from and --clip-to leave of a performance, as one that begins at 0 s.
Result<Performance> partOf(Performance played, const PerformanceArguments& a);

}  // namespace sweepface::cli
