#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::codec {

inline constexpr std::string_view kConvertAgain = "; convert the source again.";
/// Problems that the memory limit may have caused.
inline constexpr std::string_view kTooMuchMemory = "it needs more memory than it is allowed",
                                  kTooLarge =
                                      "the wireframe is larger than its bytes or the memory allow";

/// Whether the data read so far is valid, and if not, the first problem. A program without messages
/// links its own implementation (web/src/usual.cpp).
class Refusal {
 public:
  bool ok() const { return ok_; }
  const std::string& problem() const { return problem_; }
  /// What a user can do about it.
  std::string_view advice() const;

  void refuse(std::string_view problem);
  void refuseWith(std::initializer_list<TextPart> parts);
  /// Refuses a number that is not a valid `what`.
  void refuseNumber(const char* what, long long number);
  /// Refuses a number of entries that cannot fit.
  void refuseCount(const char* what, long long entries);

 private:
  bool ok_ = true;
  std::string problem_;
};

}  // namespace sweepface::codec
