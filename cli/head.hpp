#pragma once

#include "sweepface/head.hpp"

#include "command.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// Whether the whole model turns with the head, and about which point.
struct HeadArguments {
  std::string turns = "off", pivot;
  bool on() const { return turns == "on"; }
};
void addHead(CLI::App& app, HeadArguments& a);

/// The head's rotations at these times, if asked for.
Result<std::optional<HeadTrack>> headTrack(const HeadArguments& a, const Rig& rig,
                                           const Performance& performance,
                                           const std::vector<double>& times);

}  // namespace sweepface::cli
