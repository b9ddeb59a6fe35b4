#pragma once

#include "sweepface/gltf.hpp"

#include "command.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// Whether the model turns as a head, and about what.
struct HeadArguments {
  std::string turns = "off", pivot;
  bool on() const { return turns == "on"; }
};
void addHead(CLI::App& app, HeadArguments& a);

/// How the head turns at these times, if that is wanted.
Result<std::optional<HeadTrack>> headTrack(const HeadArguments& a, const Rig& rig,
                                           const Performance& performance,
                                           const std::vector<double>& times);

}  // namespace sweepface::cli
