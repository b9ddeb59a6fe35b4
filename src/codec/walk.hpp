#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "codec/level_one.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

// Tags shared by the coders of the source's parts. They form one list because one model used to
// code all parts, and numbers never change.
enum SharedTag : std::uint32_t {
  kCount = 0,
  kNear = 3,
  kSteps = 4,
  kFar = 6,
  kNext = 38,
  kMirroredStep = 40
};

/// Codes a sequence of items, most of which neighbour a recently visited one. An item is coded by
/// its place among the unvisited neighbours of recent items, the latest item first and its
/// neighbour straight ahead first. The next number, and the image of the step that was taken from
/// the mirror image of the last item, are tried before that.
template <typename Coder>
class Walk {
 public:
  /// `images` [items] must outlive the walk.
  Walk(Symbols<Coder>& symbols, Neighbours neighbours, std::span<const Index> images)
      : s_(symbols),
        neighbours_(std::move(neighbours)),
        images_(images),
        visited_(neighbours_.items(), 0),
        after_(neighbours_.items(), -1) {}

  Index next(Index item) {
    const Step follow{kNext, kFollows, following()}, mirror{kMirroredStep, kMirrors, mirrored()};
    for (const Step& step :
         last_ == kFollows ? std::array{follow, mirror} : std::array{mirror, follow})
      if (isTaken(step, item)) return visit(step.to);
    Index found = -1;
    const bool near = !trail_.empty() && s_.bit(kNear, last_, 0, kWrites<Coder> && isNear(item));
    if (near) {
      const std::uint32_t place =
          s_.number(kSteps, std::min(last_, kFarStep), 0, kWrites<Coder> ? placeOf(item) : 0);
      found = at(place);
      last_ = std::min(place, kFurther);
      if (found < 0) s_.refuse("a step leads nowhere");
    } else {
      const std::int64_t step = s_.signedNumber(kFar, 0, 0, std::int64_t{item} - far_);
      const std::int64_t there = far_ + step;
      if (there < 0 || there >= static_cast<std::int64_t>(neighbours_.items()))
        s_.refuse("a vertex or a face is out of range");
      else
        found = static_cast<Index>(there);
      last_ = kFarStep;
    }
    if (s_.ok() && visited_[found]) s_.refuse("a vertex or a face comes twice");
    return s_.ok() ? visit(found) : 0;
  }
  bool visited(Index item) const {
    return item < static_cast<Index>(visited_.size()) && visited_[item];
  }

 private:
  static constexpr std::size_t kTrail = 64;
  // The kind of the last step. Values below 14 are places among the neighbours; the others are, in
  // order: a later place, a jump to any number, the next number, the step of the mirror image.
  static constexpr std::uint32_t kFurther = 14, kFarStep = 15, kFollows = 16, kMirrors = 17;

  struct Step {
    SharedTag tag;
    std::uint32_t kind;
    Index to;
  };
  bool isTaken(const Step& step, Index item) {
    if (step.to < 0 || visited_[step.to]) return false;
    if (!s_.bit(step.tag, last_ == step.kind, 0, kWrites<Coder> && item == step.to)) return false;
    last_ = step.kind;
    return true;
  }
  Index following() const { return far_ < static_cast<Index>(neighbours_.items()) ? far_ : -1; }
  Index mirrored() const {
    const Index image = trail_.empty() ? -1 : images_[trail_.back()];
    return image < 0 || after_[image] < 0 ? -1 : images_[after_[image]];
  }

  Index visit(Index item) {
    if (!trail_.empty()) after_[trail_.back()] = item;
    far_ = item + 1;
    visited_[item] = 1;
    trail_.push_back(item);
    return item;
  }

  // Calls `use` with every unvisited neighbour of recently visited items, until it returns true.
  template <typename Use>
  void candidates(Use use) const {
    const std::size_t end = trail_.size() > kTrail ? trail_.size() - kTrail : 0;
    for (std::size_t k = trail_.size(); k-- > end;) {
      const auto around = neighbours_.of(trail_[k]);
      const std::size_t size = around.size();
      std::size_t ahead = 0;
      if (k > 0) {
        const auto back = std::ranges::find(around, trail_[k - 1]);
        if (back != around.end())
          ahead = (static_cast<std::size_t>(back - around.begin()) + size / 2) % size;
      }
      for (std::size_t j = 0; j < size; ++j) {
        if (ahead == size) ahead = 0;
        const Index item = around[ahead++];
        if (item >= 0 && !visited_[item] && use(item)) return;
      }
    }
  }
  bool isNear(Index item) const {
    bool found = false;
    candidates([&](Index candidate) { return found = candidate == item; });
    return found;
  }
  std::uint32_t placeOf(Index item) const {
    std::uint32_t place = 0;
    candidates([&](Index candidate) {
      if (candidate == item) return true;
      ++place;
      return false;
    });
    return place;
  }
  Index at(std::uint32_t place) const {
    Index found = -1;
    candidates([&](Index candidate) {
      if (place-- > 0) return false;
      found = candidate;
      return true;
    });
    return found;
  }

  Symbols<Coder>& s_;
  Neighbours neighbours_;
  std::span<const Index> images_;
  std::vector<char> visited_;
  std::vector<Index> after_;  // [items] the item visited next
  std::vector<Index> trail_;
  std::uint32_t last_ = kFarStep;
  Index far_ = 0;
};

/// A number of entries, at most `most`.
template <typename Coder>
std::size_t codeCount(Symbols<Coder>& s, std::uint32_t what, std::size_t count, std::size_t most) {
  const std::size_t n = s.number(kCount, what, 0, count);
  if (n > most) s.refuse("there are more entries than the chunk or the memory can hold");
  return s.ok() ? n : 0;
}

}  // namespace sweepface::codec
