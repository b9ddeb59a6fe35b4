#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The bytes of a .sweep file (docs/file-format.md). The same rig gives the same bytes everywhere.
/// Vectors are held bit for bit: as multiples of the packing's steps where they are, else as they
/// are. Numbers must be finite, and names of targets all different, of 1 to 4096 bytes of UTF-8
/// without control characters: decode() refuses what was written of another rig, or reads less of
/// it. Indices of the source must be in range, and no more curves may meet at a node than readers
/// search (some ten thousand, docs/file-format.md). Targets that are still to come (NeutralFirst)
/// are written as if they did not move.
std::string encode(const Rig& rig);

/// What reading a file may take. What is still takes hardly any bytes, so that a small file may ask
/// for much memory.
struct DecodeLimits {
  std::size_t memory = std::size_t{2} << 30;  ///< bytes, about: of the rig and of its reading
};

/// Reads a .sweep file; `name` is what messages call it. Whatever the bytes, the answer is a sound
/// rig or an error: memory stays in proportion to the bytes given, and below the limit.
Result<Rig> decode(std::string_view bytes, std::string_view name, const DecodeLimits& limits = {});

struct NeutralFirst;

/// What `decodeNeutral` left for later.
class TargetsToCome {
 public:
  TargetsToCome();  ///< none
  TargetsToCome(TargetsToCome&&) noexcept;
  TargetsToCome& operator=(TargetsToCome&&) noexcept;
  ~TargetsToCome();

  bool any() const { return rest_ != nullptr; }
  /// Fills in the differences of the targets of the rig that came with this, whose neutral,
  /// surface and packing must still be as they came; after an error they are as empty as before.
  Result<void> decode(Rig& rig);

 private:
  friend Result<NeutralFirst> decodeNeutral(std::string_view, std::string_view,
                                            const DecodeLimits&);
  struct Rest;
  std::unique_ptr<Rest> rest_;
};

/// A rig that can show its neutral only: its targets have names, and empty differences until they
/// are decoded. Until then they move nothing.
struct NeutralFirst {
  Rig rig;
  TargetsToCome targets;
};

/// The same in two steps, so that a face shows before it can move: the first takes about half of
/// the time. Nothing is to come of a file that holds vectors of targets as they are.
Result<NeutralFirst> decodeNeutral(std::string_view bytes, std::string_view name,
                                   const DecodeLimits& limits = {});

/// What a part of a file costs.
struct FilePart {
  std::string name;
  std::size_t bytes = 0;
};

/// The parts of a file; their bytes sum to the file's size.
Result<std::vector<FilePart>> fileParts(std::string_view bytes, std::string_view name);

}  // namespace sweepface
