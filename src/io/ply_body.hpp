#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "io/ply_header.hpp"
#include "io/text.hpp"

namespace sweepface::io {

/// The values of a PLY file in binary. A call that fails says why in problem().
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes),
        at_(header.byteCount),
        swapped_((header.format == PlyFormat::bigEndian) !=
                 (std::endian::native == std::endian::big)) {}

  bool beginRow() { return true; }
  bool endRow() { return true; }
  /// Whether nothing but a line break or padding is left.
  bool isAtEnd() const {
    return bytes_.find_first_not_of(std::string_view("\0\r\n ", 4), at_) == bytes_.npos;
  }
  std::size_t bytesLeft() const { return bytes_.size() - at_; }
  std::string place() const { return "byte " + std::to_string(at_); }
  std::string problem() const { return "the file ends within it"; }

  /// The fewest bytes that a value can take.
  static std::size_t leastSize(PlyScalar type) { return byteSize(type); }

  bool read(PlyScalar type, double& value) {
    const std::size_t size = byteSize(type);
    if (bytesLeft() < size) return false;
    value = load(type);
    at_ += size;
    return true;
  }

 private:
  double load(PlyScalar type) const {
    switch (type) {
      case PlyScalar::int8:
        return as<std::int8_t>();
      case PlyScalar::uint8:
        return as<std::uint8_t>();
      case PlyScalar::int16:
        return as<std::int16_t>();
      case PlyScalar::uint16:
        return as<std::uint16_t>();
      case PlyScalar::int32:
        return as<std::int32_t>();
      case PlyScalar::uint32:
        return as<std::uint32_t>();
      case PlyScalar::float32:
        return as<float>();
      case PlyScalar::float64:
        return as<double>();
    }
    return 0;
  }

  template <typename T>
  double as() const {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
    if (swapped_) std::ranges::reverse(raw);
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  std::string_view bytes_;
  std::size_t at_;
  bool swapped_;
};

/// The values of a PLY file in ASCII, one row a line. A call that fails says why in problem().
class AsciiBody {
 public:
  AsciiBody(std::string_view bytes, const PlyHeader& header)
      : lines_(bytes.substr(header.byteCount), header.lineBreak), headerLines_(header.lineCount) {}

  bool beginRow() {
    do {
      if (!lines_.next()) return failed("the file ends before it");
    } while (trimmed(lines_.line()).empty());
    words_ = Words(lines_.line());
    return true;
  }

  bool endRow() {
    return words_.rest().empty() || failed("there are more values than the header's properties");
  }

  /// Whether no row is left; if one is, place() is now its place.
  bool isAtEnd() { return !beginRow(); }

  std::size_t bytesLeft() const { return words_.bytesLeft() + lines_.rest().size(); }
  std::string place() const { return "line " + std::to_string(headerLines_ + lines_.number()); }
  const std::string& problem() const { return problem_; }

  static std::size_t leastSize(PlyScalar) { return 1; }

  bool read(PlyScalar type, double& value) {
    const std::string_view word = words_.next();
    if (word.empty()) return failed("a value is missing");
    if (isInteger(type)) {
      const auto number = toNumber<std::int64_t>(word);
      if (!number) return failed(inQuotes(word) + " is not an integer or beyond range");
      value = static_cast<double>(*number);
    } else {
      const auto number = toNumber<double>(word);
      if (!number) return failed(inQuotes(word) + " is not a number or beyond range");
      value = *number;
    }
    return true;
  }

 private:
  bool failed(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }

  LineCursor lines_;
  std::size_t headerLines_;
  Words words_{{}};
  std::string problem_;
};

}  // namespace sweepface::io
