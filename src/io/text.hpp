#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

#include "codec/utf8.hpp"

namespace sweepface::io {

/// Files beyond this could hold more corners than an Index can count.
inline constexpr std::size_t maxFileBytes = std::numeric_limits<Index>::max();

inline bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Whether two texts are equal but for the case of ASCII letters.
inline bool sameLetters(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::ranges::equal(a, b, {}, small, small);
}

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// "a, b and 3 more": lists at most `most` of the texts.
inline std::string fewOf(std::span<const std::string> texts, std::size_t most) {
  std::string list;
  for (const std::string& text : texts.first(std::min(texts.size(), most)))
    list += (list.empty() ? "" : ", ") + text;
  return texts.size() <= most ? list
                              : list + " and " + std::to_string(texts.size() - most) + " more";
}

/// Removes the byte order mark that some programs write before UTF-8.
inline std::string_view withoutMark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// Whether a text begins with a byte order mark of UTF-16, as some Windows programs write it.
inline bool isUtf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

/// The lines of a text, one after the other, counted from 1.
class LineCursor {
 public:
  /// Lines end in '\r' alone only if the text has no '\n' at all.
  explicit LineCursor(std::string_view text)
      : LineCursor(text, text.find('\n') == std::string_view::npos ? '\r' : '\n') {}
  LineCursor(std::string_view text, char lineBreak) : rest_(text), break_(lineBreak) {}

  /// Moves to the next line; false at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t length = rest_.find(break_);
    endsInBreak_ = length != std::string_view::npos;
    line_ = rest_.substr(0, length);
    rest_.remove_prefix(endsInBreak_ ? length + 1 : rest_.size());
    ++number_;
    return true;
  }

  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }
  char lineBreak() const { return break_; }
  /// What follows the line.
  std::string_view rest() const { return rest_; }
  /// Whether the line has no line break, as the last one of a file that was cut short.
  bool cutShort() const { return !endsInBreak_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
  char break_;
  bool endsInBreak_ = true;
};

/// The words of a line.
class Words {
 public:
  explicit Words(std::string_view line) : at_(line.data()), end_(at_ + line.size()) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ != end_ && isBlank(*at_)) ++at_;
    const char* const start = at_;
    while (at_ != end_ && !isBlank(*at_)) ++at_;
    return {start, at_};
  }

  /// All that is left, without blanks around it.
  std::string_view rest() const { return trimmed({at_, end_}); }
  std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  const char* at_;
  const char* end_;
};

/// The number that a word spells, if it spells one.
template <typename Number>
std::optional<Number> toNumber(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Checks the frame rate of a recording with timecodes.
inline Result<void> checkFrameRate(double framesPerSecond) {
  if (std::isfinite(framesPerSecond) && framesPerSecond > 0) return {};
  return fail("The frames per second of a recording must be greater than 0.");
}
/// The same, but 0 means that none was given.
inline Result<void> checkFrameRateIfGiven(double framesPerSecond) {
  return framesPerSecond == 0 ? Result<void>{} : checkFrameRate(framesPerSecond);
}

/// A word for a message: in quotes, printable and short. If the part that is shown is not UTF-8,
/// what is not ASCII becomes '?'. No more than that part of a long word is looked at.
inline std::string inQuotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  const auto isInside = [](char c) { return (c & 0xC0) == 0x80; };  // of a character
  std::size_t length = std::min(word.size(), longest);
  while (length < word.size() && length + 3 > longest && isInside(word[length])) --length;
  const bool isUtf8 = codec::isUtf8(word.substr(0, length));
  if (!isUtf8) length = std::min(word.size(), longest);
  std::string text = "'";
  for (const char c : word.substr(0, length)) {
    const auto code = static_cast<unsigned char>(c);
    text += code < ' ' || code == 0x7f || (code > 0x7f && !isUtf8) ? '?' : c;
  }
  return text += length < word.size() ? "...'" : "'";
}

/// A sentence to be continued within another one.
inline std::string withoutPeriod(std::string sentence) {
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

/// The same for "what is wrong; what to do.", of which only the first part stays: the advice would
/// not help there.
inline std::string withoutAdvice(const std::string& sentence) {
  return withoutPeriod(sentence.substr(0, sentence.rfind(';')));
}

/// Numbers names in the order in which they first appear.
class NameIndex {
 public:
  explicit NameIndex(std::vector<std::string>& names) : names_(names) {}

  Index operator()(std::string_view name) {
    if (name.empty()) return -1;
    const auto found = indices_.find(name);
    if (found != indices_.end()) return found->second;
    names_.emplace_back(name);
    return indices_.emplace(name, static_cast<Index>(names_.size() - 1)).first->second;
  }

 private:
  std::vector<std::string>& names_;
  std::map<std::string, Index, std::less<>> indices_;
};

}  // namespace sweepface::io
