#include "interrupts.hpp"

#include <csignal>
#include <string_view>
#include <tuple>
#include <unistd.h>

#include "output.hpp"

namespace sweepface::cli {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may not lock");

namespace {

// Some work asks seldom; files have no name until they are whole, so that it can end anywhere.
constexpr unsigned kPatience = 2;  // seconds

void endAnyway(int) {
  constexpr std::string_view text = "\nsweepface: Interrupted.\n";
  std::ignore = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(kInterrupted);
}

void ask(int) {
  interrupted = true;
  ::alarm(kPatience);
}

}  // namespace

void catchInterrupts() {
  std::signal(SIGALRM, endAnyway);
  struct sigaction action{};
  action.sa_handler = ask;
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
