#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::codec {

inline constexpr std::string_view kConvertAgain = "; convert the source again.";
/// What the limit of memory may be to blame for.
inline constexpr std::string_view kTooMuchMemory = "it needs more memory than it is allowed",
                                  kTooLarge =
                                      "the wireframe is larger than its bytes or the memory allow";

/// Whether what is read holds, and if not, what was wrong first. A program without words links its
/// own (web/src/usual.cpp).
class Refusal {
 public:
  bool ok() const { return ok_; }
  const std::string& problem() const { return problem_; }
  /// What a user can do about it.
  std::string_view advice() const;

  void refuse(std::string_view problem);
  void refuseWith(std::initializer_list<TextPart> parts);
  /// A number that is no `what`.
  void refuseNumber(const char* what, long long number);
  /// More entries than there can be.
  void refuseCount(const char* what, long long entries);

 private:
  bool ok_ = true;
  std::string problem_;
};

}  // namespace sweepface::codec
