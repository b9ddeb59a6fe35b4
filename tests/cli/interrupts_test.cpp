#include "cli/interrupts.hpp"

#include <csignal>
#include <gtest/gtest.h>
#include <unistd.h>

namespace sweepface::cli {
namespace {

[[noreturn]] void workWithoutAsking() {
  std::signal(SIGINT, SIG_DFL);  // background jobs ignore it
  catchInterrupts(Patience::twoSeconds);
  std::raise(SIGINT);
  if (!interrupted) ::_exit(1);
  for (;;) ::pause();
}

TEST(Interrupts, EndWorkThatDoesNotAsk) {
  EXPECT_EXIT(workWithoutAsking(), ::testing::ExitedWithCode(kInterrupted),
              "sweepface: Interrupted; nothing was written.");
}

[[noreturn]] void workThatClearsAway() {
  std::signal(SIGINT, SIG_DFL);
  catchInterrupts(Patience::twoSeconds);
  catchInterrupts();
  std::raise(SIGINT);
  ::sleep(3);
  ::_exit(interrupted ? 0 : 1);
}

TEST(Interrupts, WaitForWorkThatClearsAway) {
  EXPECT_EXIT(workThatClearsAway(), ::testing::ExitedWithCode(0), "");
}

[[noreturn]] void workInTheBackground() {
  std::signal(SIGINT, SIG_IGN);
  const auto code = doLongWork(0, [] {
    std::raise(SIGINT);
    return Result<int>(interrupted ? 1 : 0);
  });
  ::_exit(*code);
}

TEST(Interrupts, LeaveWorkAloneThatIgnoresThem) {
  EXPECT_EXIT(workInTheBackground(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sweepface::cli
