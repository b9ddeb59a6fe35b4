#pragma once

#include <atomic>
#include <functional>

#include "sweepface/result.hpp"

namespace sweepface::cli {

/// Whether the work was asked to stop: by Ctrl-C, by SIGTERM (`timeout` sends it), or by SIGHUP, as
/// its terminal was closed.
extern std::atomic<bool> interrupted;
inline constexpr int kInterrupted = 130;  // the exit code then

enum class Patience { endless, twoSeconds };

/// From here on, the first such signal asks the work to stop, and a second one of its kind ends the
/// program. So does the end of patience, for work that polls seldom and has nothing to clean up.
void catchInterrupts(Patience patience = Patience::endless);

/// Does long work on this many threads; 0 means all cores. Work that does not stop within two
/// seconds of `interrupted` being set is ended.
Result<int> doLongWork(int threads, const std::function<Result<int>()>& work);

/// Reports that the work was stopped and nothing was written; returns the exit code.
int endInterrupted();
/// Ends work that failed. If it failed because it was stopped, prints how far it got.
Result<int> endWith(const Error& error);

}  // namespace sweepface::cli
