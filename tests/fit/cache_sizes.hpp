#pragma once

#include <Eigen/Core>

namespace sweepface::testing {

/// While it lives, Eigen takes the processor's caches for so large.
class CacheSizes {
 public:
  CacheSizes(std::ptrdiff_t first, std::ptrdiff_t second, std::ptrdiff_t third)
      : first_(Eigen::l1CacheSize()), second_(Eigen::l2CacheSize()), third_(Eigen::l3CacheSize()) {
    Eigen::setCpuCacheSizes(first, second, third);
  }
  CacheSizes(const CacheSizes&) = delete;
  ~CacheSizes() { Eigen::setCpuCacheSizes(first_, second_, third_); }

 private:
  std::ptrdiff_t first_, second_, third_;
};

}  // namespace sweepface::testing
