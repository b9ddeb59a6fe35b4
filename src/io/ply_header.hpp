#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface::io {

enum class PlyFormat { ascii, littleEndian, bigEndian };
enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr bool isInteger(PlyScalar type) { return type < PlyScalar::float32; }

constexpr std::size_t byteSize(PlyScalar type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
  std::string name;
  PlyScalar type;
  std::optional<PlyScalar> countType;  ///< set for a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The index of the first property with one of the names, or -1.
  Index find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  std::size_t lineCount = 0;
  std::size_t byteCount = 0;
  char lineBreak = '\n';

  const PlyElement* find(std::string_view name) const;
};

Result<PlyHeader> parsePlyHeader(std::string_view bytes, std::string_view name);

}  // namespace sweepface::io
