#include "interrupts.hpp"

#include <csignal>

#include "output.hpp"

namespace sweepface::cli {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may not lock");

void catchInterrupts() {
  struct sigaction action{};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  struct sigaction before{};
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &action, nullptr);
}

int endInterrupted() {
  printError("Interrupted; nothing was written.");
  return kInterrupted;
}

}  // namespace sweepface::cli
