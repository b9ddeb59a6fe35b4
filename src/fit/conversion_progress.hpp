#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>

#include "sweepface/fit.hpp"

namespace sweepface {

/// Reports the progress of a conversion to its caller. Never goes backwards; thread-safe.
class ConversionProgress {
 public:
  explicit ConversionProgress(const ConvertOptions& options) : options_(options) {}

  bool cancelled() const { return options_.cancel && options_.cancel->load(); }
  /// Progress of the fit, and of packing after it.
  void reportFit(std::string_view what, double done) { report(what, fitShare() * done); }
  void reportPacking(std::string_view what, double done) {
    report(what, std::lerp(fitShare(), 1, done));
  }
  void end() { report("done", 1); }

 private:
  double fitShare() const { return options_.pack ? 0.3 : 1; }  // of the time, measured on heads

  void report(std::string_view what, double done) {
    const std::scoped_lock lock(telling_);
    done_ = std::max(done_, done);
    if (options_.progress) options_.progress(what, done_);
  }

  const ConvertOptions& options_;
  std::mutex telling_;
  double done_ = 0;
};

}  // namespace sweepface
