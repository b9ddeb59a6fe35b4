#pragma once

#include <string>

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface::bench {

/// The face that everything is measured on: the .sweep file that SWEEPFACE_BENCH_FACE names, or
/// else a small one made here. It is read on the first call; failure ends the program.
const Rig& face();
/// What `face()` is, for the report.
std::string faceName();

/// How many weights are not zero.
enum class Active { ten, all };
/// Weights for all targets of `face()`; the active ones are spread evenly over the targets.
Weights someWeights(Active active);

}  // namespace sweepface::bench
