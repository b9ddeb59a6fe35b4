#include "picture/font.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace sweepface {
namespace {

/// A font of single strokes, drawn for this project. A letter is a path of
///   m x y  start a line here       h x y  a quarter of an ellipse that sets out sideways
///   l x y  a straight line here    v x y  the same, setting out up or down
///   d x y  a dot here         a lone m leaves space
struct Letter {
  char32_t code;
  const char* path;
};

constexpr Letter kLetters[] = {
    {U'A', "m 0 0 l 7.2 20 l 14.4 0 m 2.5 7 l 11.9 7"},
    {U'B', "m 0 10.6 l 6.4 10.6 h 11.2 15.3 v 6.4 20 l 0 20 l 0 0 l 6.6 0 h 12.2 5.3 v 6.4 10.6"},
    {U'C', "m 13.6 15.2 v 7.5 20 h 0 10 v 7.5 0 h 13.6 4.8"},
    {U'D', "m 0 0 l 0 20 l 5.2 20 h 13.4 10 v 5.2 0 l 0 0"},
    {U'E', "m 11 20 l 0 20 l 0 0 l 11 0 m 0 10.4 l 9.4 10.4"},
    {U'F', "m 11 20 l 0 20 l 0 0 m 0 9.8 l 9.4 9.8"},
    {U'G', "m 13.6 15.2 v 7.5 20 h 0 10 v 7.5 0 h 14 5.4 l 14 9 l 8.6 9"},
    {U'H', "m 0 0 l 0 20 m 13 0 l 13 20 m 0 10.4 l 13 10.4"},
    {U'I', "m 0 0 l 0 20"},
    {U'J', "m 9 20 l 9 5 v 4.4 0 h 0 4.2"},
    {U'K', "m 0 0 l 0 20 m 12 20 l 0 7.6 m 4.6 12.4 l 12.6 0"},
    {U'L', "m 0 20 l 0 0 l 10.4 0"},
    {U'M', "m 0 0 l 0 20 l 8 6.5 l 16 20 l 16 0"},
    {U'N', "m 0 0 l 0 20 l 13 0 l 13 20"},
    {U'O', "m 7.7 20 h 0 10 v 7.7 0 h 15.4 10 v 7.7 20"},
    {U'P', "m 0 0 l 0 20 l 6.4 20 h 12.2 14.5 v 6.4 9 l 0 9"},
    {U'Q', "m 7.7 20 h 0 10 v 7.7 0 h 15.4 10 v 7.7 20 m 10 4.5 l 15 -1.2"},
    {U'R', "m 0 0 l 0 20 l 6.4 20 h 12.2 14.5 v 6.4 9 l 0 9 m 7 9 l 12.8 0"},
    {U'S', "m 11.9 15.8 v 6.3 20 h 0.6 15.2 v 6.3 10.4 h 12.5 5.2 v 6.2 0 h 0 4.4"},
    {U'T', "m 0 20 l 13 20 m 6.5 20 l 6.5 0"},
    {U'U', "m 0 20 l 0 6.3 v 6.5 0 h 13 6.3 l 13 20"},
    {U'V', "m 0 20 l 7 0 l 14 20"},
    {U'W', "m 0 20 l 5 0 l 10.2 20 l 15.4 0 l 20.4 20"},
    {U'X', "m 0 0 l 12.8 20 m 0 20 l 12.8 0"},
    {U'Y', "m 0 20 l 6.6 9.4 l 13.2 20 m 6.6 9.4 l 6.6 0"},
    {U'Z', "m 0 20 l 12.4 20 l 0 0 l 12.4 0"},
    {U'a', "m 0.9 11.3 v 5.4 14 h 10.2 9.4 l 10.2 0 m 10.2 8 l 5 8 h 0 4 v 4.6 0 h 10.2 4.6"},
    {U'b', "m 0 20 l 0 0 m 0 7 v 5.5 14 h 11 7 v 5.5 0 h 0 7"},
    {U'c', "m 9.9 11 v 5.4 14 h 0 7 v 5.4 0 h 9.9 3"},
    {U'd', "m 11 20 l 11 0 m 11 7 v 5.5 14 h 0 7 v 5.5 0 h 11 7"},
    {U'e', "m 0 7.3 l 10.9 7.3 v 5.5 14 h 0 7 v 5.5 0 h 10.3 2.7"},
    {U'f', "m 7.6 20 l 7 20 h 3 15.6 l 3 0 m 0 14 l 7.2 14"},
    {U'g', "m 11 14 l 11 -0.8 v 5.5 -6 h 0.7 -3 m 11 7 v 5.5 14 h 0 7 v 5.5 0 h 11 7"},
    {U'h', "m 0 20 l 0 0 m 0 8.6 v 5.3 14 h 10.3 8.8 l 10.3 0"},
    {U'i', "m 0 14 l 0 0 d 0 19.3"},
    {U'j', "m 3.4 14 l 3.4 -2.4 v 0 -6 d 3.4 19.3"},
    {U'k', "m 0 20 l 0 0 m 9.4 14 l 0 5 m 3.8 8.7 l 9.9 0"},
    {U'l', "m 0 20 l 0 3.6 v 3.2 0"},
    {U'm', "m 0 14 l 0 0 m 0 8.8 v 4.5 14 h 8.7 9 l 8.7 0 m 8.7 8.8 v 13.2 14 h 17.4 9 l 17.4 0"},
    {U'n', "m 0 14 l 0 0 m 0 8.6 v 5.3 14 h 10.3 8.8 l 10.3 0"},
    {U'o', "m 5.7 14 h 0 7 v 5.7 0 h 11.4 7 v 5.7 14"},
    {U'p', "m 0 14 l 0 -6 m 0 7 v 5.5 14 h 11 7 v 5.5 0 h 0 7"},
    {U'q', "m 11 14 l 11 -6 m 11 7 v 5.5 14 h 0 7 v 5.5 0 h 11 7"},
    {U'r', "m 0 14 l 0 0 m 0 8.2 v 5.6 14 l 6.6 14"},
    {U's', "m 9.4 11.2 v 4.9 14 h 0.5 10.6 v 4.9 7.2 h 9.8 3.7 v 4.8 0 h 0 3"},
    {U't', "m 3 18.6 l 3 4 v 6.8 0 l 7.8 0 m 0 14 l 7.6 14"},
    {U'u', "m 0 14 l 0 5.3 v 5.1 0 h 10.3 5.6 m 10.3 14 l 10.3 0"},
    {U'v', "m 0 14 l 5.3 0 l 10.6 14"},
    {U'w', "m 0 14 l 4 0 l 8.2 14 l 12.4 0 l 16.4 14"},
    {U'x', "m 0 0 l 9.8 14 m 0 14 l 9.8 0"},
    {U'y', "m 0 14 l 5.5 0.2 m 10.8 14 l 3.1 -6"},
    {U'z', "m 0 14 l 9.4 14 l 0 0 l 9.4 0"},
    {U'0', "m 6 20 h 0 10 v 6 0 h 12 10 v 6 20"},
    {U'1', "m 2 15.6 l 7 20 l 7 0 m 12 0"},
    {U'2', "m 0.6 14.8 v 6 20 h 11.6 14.6 v 9.6 9.6 l 0.2 0 l 12 0"},
    {U'3', "m 0.9 16.2 v 5.8 20 h 11 15.3 v 5.6 10.7 l 4.4 10.7 m 5.6 10.7 h 12 5.2 v 5.8 0 h 0 4"},
    {U'4', "m 9 0 l 9 20 l 0 5.8 l 12 5.8"},
    {U'5', "m 10.8 20 l 1.9 20 l 1.2 11.4 v 5.9 13 h 12 6.4 v 5.8 0 h 0 4"},
    {U'6', "m 10.8 17 v 6.8 20 h 0 9 l 0 6.4 v 6 0 h 12 6.4 v 6 12.8 h 0 6.4"},
    {U'7', "m 0 20 l 12 20 l 4 0"},
    {U'8',
     "m 6 20 h 0.8 15.4 v 6 10.8 h 11.2 15.4 v 6 20 m 6 10.8 h 0 5.4 v 6 0 h 12 5.4 v 6 10.8"},
    {U'9', "m 1.2 3 v 5.2 0 h 12 11 l 12 13.6 v 6 20 h 0 13.6 v 6 7.2 h 12 13.6"},
    {U' ', "m 0 0 m 4 0"},
    {U'.', "d 0 0.2"},
    {U',', "m 1.2 0.6 l 0 -3.6"},
    {U':', "d 0 0.2 d 0 12"},
    {U';', "m 1.2 0.6 l 0 -3.6 d 1.2 12"},
    {U'!', "m 0 20 l 0 6 d 0 0.2"},
    {U'?', "m 0 15.6 v 5 20 h 10.2 15.2 v 7.6 10.6 h 5 7.6 l 5 6 d 5 0.2"},
    {U'\'', "m 0 20 l 0 15"},
    {U'"', "m 0 20 l 0 15 m 5 20 l 5 15"},
    {U'-', "m 0 7.4 l 6.6 7.4"},
    {U'+', "m 0 8 l 12 8 m 6 2 l 6 14"},
    {U'=', "m 0 5.4 l 12 5.4 m 0 10.8 l 12 10.8"},
    {U'<', "m 11 14 l 0 8 l 11 2"},
    {U'>', "m 0 14 l 11 8 l 0 2"},
    {U'*', "m 4.4 20 l 4.4 11 m 0.4 17.8 l 8.4 13.2 m 8.4 17.8 l 0.4 13.2"},
    {U'/', "m 0 -2 l 8 21"},
    {U'\\', "m 0 21 l 8 -2"},
    {U'|', "m 0 -4 l 0 22"},
    {U'_', "m 0 -3 l 11 -3"},
    {U'~', "m 0 7 v 3.4 9.8 l 8.6 6.4 h 12 9.2"},
    {U'^', "m 0 13 l 5 20 l 10 13"},
    {U'`', "m 0 20 l 3 16.4"},
    {U'(', "m 4.2 22 h 0 9 v 4.2 -4"},
    {U')', "m 0 22 h 4.2 9 v 0 -4"},
    {U'[', "m 4.4 22 l 0 22 l 0 -4 l 4.4 -4"},
    {U']', "m 0 22 l 4.4 22 l 4.4 -4 l 0 -4"},
    {U'{', "m 5.6 22 h 2.6 18 l 2.6 12.4 v 0 9 h 2.6 5.6 l 2.6 0 v 5.6 -4"},
    {U'}', "m 0 22 h 3 18 l 3 12.4 v 5.6 9 h 3 5.6 l 3 0 v 0 -4"},
    {U'#', "m 4 0 l 6 20 m 10 0 l 12 20 m 1 13.4 l 15.6 13.4 m 0 6.4 l 14.6 6.4"},
    {U'$', "m 11.9 15.4 v 6.3 19 h 0.6 14.6 v 6.3 10.2 h 12.5 5.6 v 6.2 1 h 0 5 m 6.3 22 l 6.3 -2"},
    {U'%',
     "m 3.6 20 h 0 15.8 v 3.6 11.6 h 7.2 15.8 v 3.6 20 "
     "m 14.4 8.4 h 10.8 4.2 v 14.4 0 h 18 4.2 v 14.4 8.4 m 14 20 l 4 0"},
    {U'&', "m 14 0 l 2.4 13 v 6 20 h 9.8 16.6 v 7.4 11.8 l 3.4 9.2 h 0 4.8 v 5.6 0 h 13.4 9"},
    {U'@',
     "m 14 6 v 9.4 14 h 5.4 9 v 9.4 4.4 h 14 9.4 l 14 6.4 v 16.6 4.6 h 19 10 v 9.6 19 "
     "h 0 9 v 9.6 -2 l 13 -1"},
    {U'°', "m 3.2 20 h 0 16.8 v 3.2 13.6 h 6.4 16.8 v 3.2 20"},
    {U'²', "m 0.2 17.6 v 3.2 20 h 6.2 17.2 v 5 14.6 l 0 10 l 6.4 10"},
    {U'³', "m 0.4 18.2 v 3 20 h 5.8 17.6 v 3 15.2 m 3 15.2 h 6.2 12.4 v 3 9.8 h 0 11.8"},
    {U'·', "d 0 8"},
    {U'×', "m 0 3 l 10 13 m 0 13 l 10 3"},
    {U'±', "m 0 10.4 l 12 10.4 m 6 4.8 l 6 16 m 0 0.6 l 12 0.6"},
    {U'µ', "m 0 14 l 0 -6 m 0 5.3 v 5.1 0 h 10.3 5.6 m 10.3 14 l 10.3 0"},
    {U'–', "m 0 7.4 l 10 7.4"},
    {U'—', "m 0 7.4 l 18 7.4"},
    {U'…', "d 0 0.2 d 6 0.2 d 12 0.2"},
    {U'→', "m 0 8 l 15 8 m 9.6 13 l 15 8 l 9.6 3"},
    {U'\uFFFD', "m 0 0 l 0 20 l 11 20 l 11 0 l 0 0"},
};

/// A quarter of an ellipse from one point to another.
void addQuarter(std::vector<Vec2>& line, const Vec2& to, bool sideways) {
  constexpr int steps = 10;
  const Vec2 from = line.back();
  for (int k = 1; k <= steps; ++k) {
    const double a = std::numbers::pi / 2 * k / steps;
    const double early = std::sin(a), late = 1 - std::cos(a);
    const double x = sideways ? early : late, y = sideways ? late : early;
    line.push_back({from.x + x * (to.x - from.x), from.y + y * (to.y - from.y)});
  }
}

Glyph parse(std::string_view path) {
  Glyph glyph;
  const char *at = path.data(), *const end = at + path.size();
  const auto number = [&] {
    double value = 0;
    while (at != end && *at == ' ') ++at;
    at = std::from_chars(at, end, value).ptr;
    return value;
  };
  while (at != end) {
    const char command = *at++;
    if (command == ' ') continue;
    const double x = number(), y = number();
    glyph.width = std::max(glyph.width, x);
    if (command == 'm' || command == 'd') glyph.lines.emplace_back();
    std::vector<Vec2>& line = glyph.lines.back();
    if (command == 'h' || command == 'v')
      addQuarter(line, {x, y}, command == 'h');
    else
      line.push_back({x, y});
    if (command == 'd') line.push_back({x, y});
  }
  return glyph;
}

}  // namespace

const Glyph& glyphOf(char32_t letter) {
  static const std::map<char32_t, Glyph> glyphs = [] {
    std::map<char32_t, Glyph> all;
    for (const Letter& l : kLetters) all.emplace(l.code, parse(l.path));
    return all;
  }();
  const auto found = glyphs.find(letter);
  return found != glyphs.end() ? found->second : glyphs.at(U'\uFFFD');
}

std::vector<char32_t> codePoints(std::string_view text) {
  std::vector<char32_t> points;
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = [&](std::size_t i) -> unsigned {
      return k + i < text.size() ? static_cast<unsigned char>(text[k + i]) : 0u;
    };
    const std::size_t length = byte(0) < 0x80             ? 1
                               : (byte(0) & 0xe0) == 0xc0 ? 2
                               : (byte(0) & 0xf0) == 0xe0 ? 3
                               : (byte(0) & 0xf8) == 0xf0 ? 4
                                                          : 0;
    char32_t code = length == 1 ? byte(0) : byte(0) & (0x7fu >> length);
    bool whole = length > 0;
    for (std::size_t i = 1; i < length; ++i) {
      whole = whole && (byte(i) & 0xc0) == 0x80;
      code = code << 6 | (byte(i) & 0x3f);
    }
    points.push_back(whole ? code : U'\uFFFD');
    k += whole ? length : 1;
  }
  return points;
}

}  // namespace sweepface
