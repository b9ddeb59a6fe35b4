// JSON according to RFC 8259; a byte order mark before it is skipped.
#include "drawing/json_reader.hpp"

#include <algorithm>
#include <charconv>

#include "codec/utf8.hpp"
#include "io/text.hpp"

namespace sweepface::drawing {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// The length of the number at the start of a text, in JSON's grammar; 0 if there is none.
std::size_t numberLength(std::string_view text) {
  std::size_t k = 0;
  const auto digits = [&] {
    const std::size_t start = k;
    while (k < text.size() && isDigit(text[k])) ++k;
    return k - start;
  };
  if (k < text.size() && text[k] == '-') ++k;
  const std::size_t first = k;
  const std::size_t whole = digits();
  if (whole == 0 || (whole > 1 && text[first] == '0')) return 0;
  if (k < text.size() && text[k] == '.') {
    ++k;
    if (digits() == 0) return 0;
  }
  if (k < text.size() && (text[k] == 'e' || text[k] == 'E')) {
    ++k;
    if (k < text.size() && (text[k] == '+' || text[k] == '-')) ++k;
    if (digits() == 0) return 0;
  }
  return k;
}

void appendUtf8(std::string& out, unsigned code) {
  const auto byte = [&](unsigned value) { out += static_cast<char>(value); };
  if (code < 0x80) return byte(code);
  if (code < 0x800) {
    byte(0xC0 | code >> 6);
  } else {
    if (code < 0x10000) {
      byte(0xE0 | code >> 12);
    } else {
      byte(0xF0 | code >> 18);
      byte(0x80 | (code >> 12 & 63));
    }
    byte(0x80 | (code >> 6 & 63));
  }
  byte(0x80 | (code & 63));
}

}  // namespace

void JsonReader::refuse(const TextPlace& place, std::string problem) {
  if (!ok()) return;
  problem_ = std::move(problem);
  problemPlace_ = place;
}

void JsonReader::skipBlanks() {
  if (at_ == 0 && text_.starts_with("\xEF\xBB\xBF")) at_ = lineStart_ = 3;
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
      lineStart_ = at_ + 1;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      return;
    }
  }
}

// What is found at the current place, for messages.
std::string JsonReader::found() const {
  if (at_ >= text_.size()) return "the text ends";
  constexpr std::string_view ends = " \t\r\n,:[]{}\"";
  std::size_t end = at_ + 1;
  if (ends.find(text_[at_]) == std::string_view::npos)
    while (end < text_.size() && end - at_ < 24 && ends.find(text_[end]) == std::string_view::npos)
      ++end;
  return "there is " + io::inQuotes(text_.substr(at_, end - at_));
}

void JsonReader::expected(std::string_view what) {
  if (ok()) refuse(place(), std::string(what) + " is expected where " + found());
}

bool JsonReader::open(char bracket, std::string_view what, std::string_view kind) {
  if (peek() != bracket) expected(std::string(what) + ", " + std::string(kind) + ",");
  if (!ok()) return false;
  ++at_;
  skipBlanks();
  return true;
}

bool JsonReader::closes(char bracket) {
  if (peek() != bracket) return false;
  ++at_;
  skipBlanks();
  return true;
}

bool JsonReader::continues(char bracket) {
  if (!ok() || closes(bracket)) return false;
  return take(',', std::string("',' or '") + bracket + "'");
}

bool JsonReader::take(char c, std::string_view what) {
  if (peek() != c) {
    expected(what);
    return false;
  }
  ++at_;
  skipBlanks();
  return true;
}

std::string JsonReader::text(std::string_view what) {
  if (peek() != '"') expected(what);
  if (!ok()) return {};
  const TextPlace start = place();
  std::string out;
  for (++at_; at_ < text_.size() && text_[at_] != '"' && ok();) {
    const char c = text_[at_];
    if (static_cast<unsigned char>(c) < ' ') {
      refuse(place(), c == '\n' || c == '\r'
                          ? "a text in quotes goes over the end of its line"
                          : "a text in quotes has a tab or another control character; write \\t or "
                            "a space");
    } else if (c == '\\') {
      escape(out);
    } else {
      out += c;
      ++at_;
    }
  }
  if (at_ >= text_.size()) refuse(start, "a text has no closing quote");
  if (!ok()) return {};
  ++at_;
  skipBlanks();
  return out;
}

// Reads an escape sequence, starting at its backslash.
void JsonReader::escape(std::string& out) {
  constexpr std::string_view letters = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
  const TextPlace start = place();
  const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
  at_ += 2;
  if (c == 'u') {
    unsigned code = hex4();
    if (code >= 0xD800 && code < 0xDC00 && text_.substr(std::min(at_, text_.size()), 2) == "\\u") {
      at_ += 2;
      const unsigned low = hex4();
      code = low >= 0xDC00 && low < 0xE000 ? 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00)
                                           : 0x110000;
    }
    if (code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
      return refuse(start, "an escape \\u stands for no character");
    return appendUtf8(out, code);
  }
  const std::size_t k = letters.find(c);
  if (c == '\0' || k == std::string_view::npos)
    return refuse(start, "a backslash in a text stands before no escape of JSON");
  out += meanings[k];
}

unsigned JsonReader::hex4() {
  unsigned code = 0;
  const std::string_view digits = text_.substr(std::min(at_, text_.size()), 4);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
  if (digits.size() < 4 || error != std::errc{} || end != digits.data() + 4) return 0x110000;
  at_ += 4;
  return code;
}

double JsonReader::number(std::string_view what) {
  if (!ok()) return 0;
  const std::size_t length = numberLength(text_.substr(at_));
  const std::string_view word = text_.substr(at_, length);
  const char after = at_ + length < text_.size() ? text_[at_ + length] : ' ';
  const bool ends = std::string_view(" \t\r\n,:[]{}\"").find(after) != std::string_view::npos;
  if (length == 0 || !ends) {
    expected(what);
    return 0;
  }
  double value = 0;
  if (std::from_chars(word.data(), word.data() + length, value).ec != std::errc{}) {
    refuse(place(), io::inQuotes(word) + " is beyond what a double can hold");
    return 0;
  }
  at_ += length;
  skipBlanks();
  return value;
}

bool JsonReader::flag(std::string_view what) {
  for (const std::string_view word : {std::string_view("true"), std::string_view("false")})
    if (ok() && text_.substr(at_).starts_with(word)) {
      at_ += word.size();
      skipBlanks();
      return word == "true";
    }
  expected(what);
  return false;
}

void JsonReader::finish() {
  if (ok() && at_ < text_.size()) refuse(place(), "the text goes on after its end");
}

}  // namespace sweepface::drawing
