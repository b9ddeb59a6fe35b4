#pragma once

#include <set>
#include <string>
#include <string_view>

namespace sweepface::usd {

/// Names for prims with the same parent: ASCII letters, digits and '_', which every version of USD
/// reads, and each only once.
class PrimNames {
 public:
  /// The wanted name, with whatever it cannot hold replaced and a number added if it is taken.
  std::string take(std::string_view wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace sweepface::usd
