#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The bytes of a .sweep file (docs/file-format.md). The same rig gives the same bytes everywhere.
/// Vectors are held in single precision.
std::string encode(const Rig& rig);

/// Reads a .sweep file; `name` is what messages call it. Whatever the bytes, the answer is a sound
/// rig or an error: memory stays in proportion to the bytes given.
Result<Rig> decode(std::string_view bytes, std::string_view name);

/// What a part of a file costs.
struct FilePart {
  std::string name;
  std::size_t bytes = 0;
};

/// The parts of a file; their bytes sum to the file's size.
Result<std::vector<FilePart>> fileParts(std::string_view bytes, std::string_view name);

}  // namespace sweepface
