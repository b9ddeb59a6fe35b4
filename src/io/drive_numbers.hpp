#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "sweepface/live_motion.hpp"

namespace sweepface::io {

/// The numbers of a drive, by the names that users call them.
inline std::array<std::pair<const char*, double*>, 6> numbersOf(Drive& drive) {
  return {{{"seconds", &drive.seconds},
           {"turn", &drive.turn},
           {"frequency", &drive.spring.frequency},
           {"damping", &drive.spring.damping},
           {"restitution", &drive.restitution},
           {"delay", &drive.delay}}};
}

/// Whether a kind of drive uses a number; all use the delay.
inline bool takes(Drive::Kind kind, std::string_view number) {
  using Kind = Drive::Kind;
  if (number == "seconds") return kind != Kind::cut && kind != Kind::spring;
  if (number == "turn") return kind == Kind::accelerateBrake;
  if (number == "frequency" || number == "damping") return kind == Kind::spring;
  if (number == "restitution") return kind == Kind::bounce;
  return true;
}

}  // namespace sweepface::io
