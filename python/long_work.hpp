#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <string_view>

#include "values.hpp"

namespace sweepface::python {

/// Work that takes seconds, done by another thread, while this one calls `progress(what, done)` now
/// and then (unless it is None) and lets Ctrl-C, or an exception of `progress`, end the work.
class LongWork {
 public:
  explicit LongWork(py::object progress = py::none());

  /// For the options of the work.
  std::function<void(std::string_view, double)> report();
  const std::atomic<bool>* cancel() const { return &cancelled_; }

  /// What `work()` returns; it must not touch Python.
  template <typename Work>
  auto run(const Work& work) {
    auto result = std::async(std::launch::async, work);
    const auto isDone = [&] {
      const Released others;
      return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    };
    try {
      while (!isDone()) attend();
      attend();  // the last report
    } catch (...) {
      cancelled_ = true;
      const Released others;
      result.wait();
      throw;
    }
    return result.get();
  }

 private:
  void attend();

  py::object progress_;
  std::atomic<bool> cancelled_ = false;
  std::mutex telling_;
  std::string what_;  // the latest report
  double done_ = 0;
  bool isNew_ = false;
};

}  // namespace sweepface::python
