#pragma once

#include <algorithm>

#include "sweepface/fit.hpp"

namespace sweepface {

/// Tells who asked for a conversion how far it is, which never becomes less.
class ConversionProgress {
 public:
  explicit ConversionProgress(const ConvertOptions& options) : options_(options) {}

  bool cancelled() const { return options_.cancel && options_.cancel->load(); }
  void report(std::string_view what, double done) {
    done_ = std::max(done_, done);
    if (options_.progress) options_.progress(what, done_);
  }

 private:
  const ConvertOptions& options_;
  double done_ = 0;
};

}  // namespace sweepface
