#include "interrupts.hpp"

#include <string_view>

#ifndef __wasi__
#include <chrono>
#include <csignal>
#include <thread>
#include <tuple>
#include <unistd.h>
#endif

#include "output.hpp"
#include "thread_limit.hpp"

namespace sweepface::cli {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may not lock");

#ifdef __wasi__

/// There are no signals: whoever runs the module ends it.
void catchInterrupts(Patience) {}

#else

namespace {

bool leavesBar = false;  // messages then start on a new line

void endAnyway(int) {
  std::string_view text = "\nsweepface: Interrupted; nothing was written.\n";
  if (!leavesBar) text.remove_prefix(1);
  std::ignore = ::write(STDERR_FILENO, text.data(), static_cast<unsigned>(text.size()));
  ::_exit(kInterrupted);
}

#ifdef _WIN32

std::atomic<Patience> patienceNow{};

/// Windows has no alarms, but handles each signal in a thread of its own, which may wait, and after
/// which it may end the program.
void ask(int) {
  interrupted = true;
  std::this_thread::sleep_for(std::chrono::seconds(2));
  if (patienceNow == Patience::twoSeconds) endAnyway(0);
}

}  // namespace

void catchInterrupts(Patience patience) {
  patienceNow = patience;
  leavesBar = ::isatty(STDERR_FILENO) != 0;
  for (const int signal : {SIGINT, SIGBREAK}) std::signal(signal, ask);
}

#else

void ask(int) { interrupted = true; }

void askForTwoSeconds(int) {
  interrupted = true;
  ::alarm(2);
}

}  // namespace

void catchInterrupts(Patience patience) {
  ::alarm(0);
  leavesBar = ::isatty(STDERR_FILENO) != 0;
  std::signal(SIGALRM, endAnyway);
  struct sigaction action{};
  action.sa_handler = patience == Patience::endless ? ask : askForTwoSeconds;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before{};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

#endif
#endif

Result<int> doLongWork(int threads, const std::function<Result<int>()>& work) {
  const ThreadLimit limit(static_cast<std::size_t>(threads));
  catchInterrupts(Patience::twoSeconds);
  Result<int> code = work();
  // Whatever failed after an interrupt failed because of it.
  return interrupted && code != 0 ? endInterrupted() : code;
}

int endInterrupted() {
  printError("Interrupted; nothing was written.");
  return kInterrupted;
}

Result<int> endWith(const Error& error) {
  if (!interrupted) return std::unexpected(error);
  printError(error.message);
  return kInterrupted;
}

}  // namespace sweepface::cli
