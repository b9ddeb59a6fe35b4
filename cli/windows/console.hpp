#pragma once

#include <windows.h>

namespace sweepface::cli {

/// While it lives, the console shows UTF-8, and obeys the escape sequences of the progress bar.
class Console {
 public:
  Console() : errors_(GetStdHandle(STD_ERROR_HANDLE)) {
    SetConsoleOutputCP(CP_UTF8);
    if (GetConsoleMode(errors_, &mode_)) {
      SetConsoleMode(errors_, mode_ | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    } else {
      errors_ = nullptr;
    }
  }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console() {
    SetConsoleOutputCP(codePage_);
    if (errors_ != nullptr) SetConsoleMode(errors_, mode_);
  }

 private:
  unsigned codePage_ = GetConsoleOutputCP();
  HANDLE errors_;  ///< null if they go elsewhere
  DWORD mode_ = 0;
};

}  // namespace sweepface::cli
