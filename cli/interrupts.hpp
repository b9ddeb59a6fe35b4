#pragma once

#include <atomic>

namespace sweepface::cli {

/// Whether Ctrl-C has asked the work to stop.
extern std::atomic<bool> interrupted;
inline constexpr int kInterrupted = 130;  // the exit code then

/// From here on the first Ctrl-C asks the work to stop, and ends the program where it has not done
/// so two seconds later; a second one ends it at once.
void catchInterrupts();

/// Says that the work was stopped and nothing written; the exit code.
int endInterrupted();

}  // namespace sweepface::cli
