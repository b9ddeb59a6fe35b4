#include <vector>

#include "sweepface/result.hpp"

namespace sweepface {

namespace {

// One function for all integer types; the standard library has one for each.
void appendNumber(std::vector<char>& sentence, long long number) {
  char digits[20];
  char* first = digits + 20;
  auto rest = static_cast<unsigned long long>(number);
  if (number < 0) rest = 0 - rest;
  do *--first = static_cast<char>('0' + rest % 10);
  while (rest /= 10);
  if (number < 0) *--first = '-';
  sentence.insert(sentence.end(), first, digits + 20);
}

}  // namespace

std::string joined(std::initializer_list<TextPart> parts) {
  std::vector<char> sentence;
  for (const TextPart& part : parts)
    if (part.text.data() != &TextPart::kIsNumber)
      sentence.insert(sentence.end(), part.text.begin(), part.text.end());
    else
      appendNumber(sentence, part.number);
  return {sentence.begin(), sentence.end()};
}

std::unexpected<Error> failCallWith(std::initializer_list<TextPart> parts) {
  return std::unexpected(Error(joined(parts)));
}

}  // namespace sweepface
