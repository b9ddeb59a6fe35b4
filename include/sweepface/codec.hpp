#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The bytes of a .sweep file (docs/file-format.md). The same rig gives the same bytes everywhere.
/// Vectors are stored bit for bit: as multiples of the packing's steps if they are such multiples,
/// otherwise as they are. Numbers must be finite, and names of targets all different, of 1 to 4096
/// bytes of UTF-8 without control characters: decode() refuses a file of any other rig, or reads
/// less of it. Indices of the source must be in range, and no more curves may meet at a node than
/// readers search (some ten thousand, docs/file-format.md). Targets that are not decoded yet
/// (NeutralFirst) are written as if they moved nothing.
std::string encode(const Rig& rig);

/// How much reading a file may take. What does not move takes hardly any bytes in a file, so even a
/// small file may need a lot of memory.
struct DecodeLimits {
  std::size_t memory = std::size_t{2} << 30;  ///< about this many bytes, for rig and reading
};

/// Reads a .sweep file; `name` is what messages call it. Whatever the bytes, the result is a valid
/// rig or an error, and memory is bounded by the number of bytes, by fixed limits and by `limits`.
Result<Rig> decode(std::string_view bytes, std::string_view name, const DecodeLimits& limits = {});

struct NeutralFirst;

/// What `decodeNeutral` leaves for later.
class TargetsToCome {
 public:
  TargetsToCome();  ///< none
  TargetsToCome(TargetsToCome&&) noexcept;
  TargetsToCome& operator=(TargetsToCome&&) noexcept;
  ~TargetsToCome();

  bool any() const { return rest_ != nullptr; }
  /// Fills in the differences of the targets of the rig that came with this. The rig's neutral,
  /// surface and packing must not have changed. After an error the differences are still empty.
  Result<void> decode(Rig& rig);

 private:
  friend Result<NeutralFirst> decodeNeutral(std::string_view, std::string_view,
                                            const DecodeLimits&);
  struct Rest;
  std::unique_ptr<Rest> rest_;
};

/// A rig that can only show its neutral: its targets have names, but their differences are empty
/// and move nothing until they are decoded.
struct NeutralFirst {
  Rig rig;
  TargetsToCome targets;
};

/// Like decode() in two steps, so that a face can be shown before it can move; the first takes
/// about half of the time. A file that stores the vectors of targets as they are is read whole:
/// nothing is left for later.
Result<NeutralFirst> decodeNeutral(std::string_view bytes, std::string_view name,
                                   const DecodeLimits& limits = {});

/// The size of a part of a file.
struct FilePart {
  std::string name;
  std::size_t bytes = 0;
};

/// The parts of a file; their bytes sum to the file's size.
Result<std::vector<FilePart>> fileParts(std::string_view bytes, std::string_view name);

}  // namespace sweepface
