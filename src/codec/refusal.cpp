#include "codec/refusal.hpp"

#include <utility>

namespace sweepface::codec {

std::string_view Refusal::advice() const {
  const bool isMemory = problem_ == kTooMuchMemory || problem_ == kTooLarge;
  return isMemory ? "; allow more, or do not open it." : kConvertAgain;
}

void Refusal::refuse(std::string_view problem) { refuseWith({problem}); }

void Refusal::refuseWith(std::initializer_list<TextPart> parts) {
  if (!std::exchange(ok_, false)) return;
  problem_ = joined(parts);
  if (problem_.ends_with('.')) problem_.pop_back();  // the advice follows
}

void Refusal::refuseNumber(const char* what, long long number) {
  refuseWith({what, " ", number, " is out of range"});
}

void Refusal::refuseCount(const char* what, long long entries) {
  refuseWith({"there are said to be ", entries, " ", what, ", more than the chunk can hold"});
}

}  // namespace sweepface::codec
