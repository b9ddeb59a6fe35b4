#include "sweepface/result.hpp"

namespace sweepface {

namespace {

// One function for all types, where the standard library has one for each.
void appendNumber(std::string& sentence, long long number) {
  char digits[20];
  char* first = digits + 20;
  auto rest = static_cast<unsigned long long>(number);
  if (number < 0) rest = 0 - rest;
  do *--first = static_cast<char>('0' + rest % 10);
  while (rest /= 10);
  if (number < 0) *--first = '-';
  sentence.append(first, static_cast<std::size_t>(digits + 20 - first));
}

}  // namespace

std::string joined(std::initializer_list<TextPart> parts) {
  std::string sentence;
  for (const TextPart& part : parts)
    if (part.text.data())
      sentence.append(part.text.data(), part.text.size());
    else
      appendNumber(sentence, part.number);
  return sentence;
}

std::unexpected<Error> failCallWith(std::initializer_list<TextPart> parts) {
  return std::unexpected(Error(joined(parts)));
}

}  // namespace sweepface
