#pragma once

#include <string>
#include <vector>

#include "sweepface/trajectory.hpp"

namespace sweepface {

/// A law of motion as an example: from 0 to 1 in a second.
struct ShownLaw {
  std::string name;
  std::string use;  ///< what it is for, in a few words
  Trajectory path;
};

/// Every law that there is, those from rest to rest in time first.
std::vector<ShownLaw> everyLaw();

/// All of them side by side as a moving picture (SVG): position, velocity and force over time, and
/// a ball that goes that way, again and again.
std::string lawSheet();

}  // namespace sweepface
