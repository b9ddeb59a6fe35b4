#pragma once

#include <cstddef>

#ifndef __wasi__
#include <optional>
#include <tbb/global_control.h>
#endif

namespace sweepface {

/// While it lives, long work takes no more threads than that; 0 means one a core.
class ThreadLimit {
 public:
#ifdef __wasi__
  explicit ThreadLimit(std::size_t) {}  // has one thread
#else
  explicit ThreadLimit(std::size_t threads) {
    if (threads > 0) control_.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }

 private:
  std::optional<tbb::global_control> control_;
#endif
};

}  // namespace sweepface
