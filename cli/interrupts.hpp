#pragma once

#include <atomic>
#include <functional>

#include "sweepface/result.hpp"

namespace sweepface::cli {

/// Whether Ctrl-C has asked the work to stop, or SIGTERM (`timeout` sends it), or SIGHUP, as its
/// terminal was closed.
extern std::atomic<bool> interrupted;
inline constexpr int kInterrupted = 130;  // the exit code then

enum class Patience { endless, twoSeconds };

/// From here on the first such signal asks the work to stop, and a second of its kind ends the
/// program. So does the end of patience, for work that asks seldom and has nothing to clear away.
void catchInterrupts(Patience patience = Patience::endless);

/// Does long work on so many threads, 0: on all cores. It gives up where `interrupted` is set, or
/// is ended two seconds later.
Result<int> doLongWork(int threads, const std::function<Result<int>()>& work);

/// Says that the work was stopped and nothing written; the exit code.
int endInterrupted();
/// Ends work that failed and says how far it came where that is because it was stopped.
Result<int> endWith(const Error& error);

}  // namespace sweepface::cli
