#include "eval/tiles.hpp"

#include <algorithm>

namespace sweepface {

std::byte* TileTable::add(std::size_t bytes) {
  starts_.push_back(size_);
  size_ += roundUp32(bytes);
  memory_.resize(size_);
  return memory_.data() + starts_.back();
}

void TileTable::finish() {
  constexpr std::size_t line = 64, behind = 64;  // whole registers are read
  std::vector<std::byte> aligned(size_ + line + behind);
  first_ = (line - reinterpret_cast<std::uintptr_t>(aligned.data()) % line) % line;
  std::ranges::copy(memory_, aligned.begin() + static_cast<std::ptrdiff_t>(first_));
  memory_ = std::move(aligned);
}

}  // namespace sweepface
