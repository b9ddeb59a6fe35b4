#pragma once

#include <algorithm>
#include <cmath>
#include <mutex>

#include "sweepface/fit.hpp"

namespace sweepface {

/// Tells who asked for a conversion how far it is, which never becomes less; from any thread.
class ConversionProgress {
 public:
  explicit ConversionProgress(const ConvertOptions& options) : options_(options) {}

  bool cancelled() const { return options_.cancel && options_.cancel->load(); }
  /// How far the fit is, and packing after it.
  void reportFit(std::string_view what, double done) { report(what, fitShare() * done); }
  void reportPacking(std::string_view what, double done) {
    report(what, std::lerp(fitShare(), 1, done));
  }
  void end() { report("done", 1); }

 private:
  double fitShare() const { return options_.pack ? 0.3 : 1; }  // of the time that heads take

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
