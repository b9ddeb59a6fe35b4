#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sweepface/picture.hpp"

// Pieces of HTML. Texts are passed unescaped, and escaped here.
namespace sweepface::html {

/// Escapes a text. If it is not UTF-8, as file names may be, bytes that are not ASCII become
/// U+FFFD.
std::string escaped(std::string_view text);
std::string base64(std::string_view bytes);
/// "#rrggbb".
std::string hex(const Colour& colour);

/// A picture with its caption below.
Result<std::string> figure(const Image& image, std::string_view caption);

/// A table whose first column is text and whose others are numbers.
class Table {
 public:
  explicit Table(const std::vector<std::string>& head);
  void add(const std::vector<std::string>& row, bool strong = false);
  std::string html() const;

 private:
  std::string head_, body_;
};

/// The colours of heat maps from 0 to `top`, and what they represent.
std::string scale(double top, std::string_view title);
/// Coloured lines and their meanings.
std::string legend(const std::vector<Key>& keys);

/// The whole page.
std::string page(std::string_view title, std::string_view body);

}  // namespace sweepface::html
