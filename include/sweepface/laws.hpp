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

/// Every law there is, first those that go from rest to rest in a given time.
std::vector<ShownLaw> everyLaw();

/// All of them side by side as an animated picture (SVG): position, velocity and force over time,
/// and a ball that moves that way, in a loop.
std::string lawSheet();

}  // namespace sweepface
