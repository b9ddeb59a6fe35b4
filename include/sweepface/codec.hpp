#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The bytes of a .sweep file (docs/file-format.md). The same rig gives the same bytes everywhere.
/// Vectors are held in single precision.
std::string encode(const Rig& rig);

/// What reading a file may take. What is still takes hardly any bytes, so that a small file may ask
/// for much memory.
struct DecodeLimits {
  std::size_t memory = std::size_t{2} << 30;  ///< bytes, about: of the rig and of its reading
};

/// Reads a .sweep file; `name` is what messages call it. Whatever the bytes, the answer is a sound
/// rig or an error: memory stays in proportion to the bytes given, and below the limit.
Result<Rig> decode(std::string_view bytes, std::string_view name, const DecodeLimits& limits = {});

/// What a part of a file costs.
struct FilePart {
  std::string name;
  std::size_t bytes = 0;
};

/// The parts of a file; their bytes sum to the file's size.
Result<std::vector<FilePart>> fileParts(std::string_view bytes, std::string_view name);

}  // namespace sweepface
