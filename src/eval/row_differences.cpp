#include "eval/row_differences.hpp"

#include <algorithm>
#include <bit>

namespace sweepface {
namespace {

constexpr double kMostDifference = 1e30;

float clamped(double x) {
  return static_cast<float>(std::clamp(x, -kMostDifference, kMostDifference));
}

void write(const Vec3& difference, float* to) {
  to[0] = clamped(difference.x);
  to[1] = clamped(difference.y);
  to[2] = clamped(difference.z);
}

}  // namespace

RowDifferences::RowDifferences(const Rig& rig, std::span<const std::vector<float>> influences)
    : rig_(rig),
      influences_(influences),
      targets_(static_cast<Index>(rig.targets.size())),
      columns_(targets_ * static_cast<Index>(std::max<std::size_t>(1, influences.size()))),
      words_((columns_ + 63) / 64),
      moves_(words_ * rig.surface.storedCount()),
      placeOf_(rig.surface.vectorCount(), -1) {
  for (Index c = 0; c < columns_; ++c)
    for (Index v = 0; v < rig.surface.storedCount(); ++v)
      if (stored(v, c) != Vec3{}) moves_[words_ * v + c / 64] |= std::uint64_t(1) << c % 64;
}

Vec3 RowDifferences::stored(Index vector, Index column) const {
  const Vec3& difference = rig_.targets[column % targets_].difference[vector];
  return influences_.empty() ? difference : influences_[column / targets_][vector] * difference;
}

Vec3 RowDifferences::ofLoose(Index loose, Index column) const {
  return column < targets_ ? rig_.targets[column].looseDifference[loose] : Vec3{};
}

void RowDifferences::collect(std::span<const Row> rows) {
  for (const Index v : needed_) placeOf_[v] = -1;
  needed_.clear();
  const auto need = [&](Index v) {
    if (placeOf_[v] >= 0) return;
    placeOf_[v] = 0;
    needed_.push_back(v);
  };
  for (const Row& row : rows)
    for (const Term& t : row.terms) need(t.vector);
  const Index storedCount = rig_.surface.storedCount();
  for (std::size_t k = 0; k < needed_.size(); ++k)
    if (needed_[k] >= storedCount)
      for (const Term& t : rig_.surface.derivation(needed_[k])) need(t.vector);
  std::ranges::sort(needed_);
  for (std::size_t k = 0; k < needed_.size(); ++k) placeOf_[needed_[k]] = static_cast<Index>(k);
}

std::vector<std::uint16_t> RowDifferences::findMoving(std::span<const Row> rows) const {
  std::vector<std::uint64_t> any(words_);
  for (const Index v : needed_) {
    if (v >= rig_.surface.storedCount()) break;
    for (std::size_t w = 0; w < words_; ++w) any[w] |= moves_[words_ * v + w];
  }
  for (const Row& row : rows)
    for (Index c = 0; row.loose >= 0 && c < columns_; ++c)
      if (ofLoose(row.loose, c) != Vec3{}) any[c / 64] |= std::uint64_t(1) << c % 64;
  std::vector<std::uint16_t> moving;
  for (std::size_t w = 0; w < words_; ++w)
    for (std::uint64_t bits = any[w]; bits != 0; bits &= bits - 1)
      moving.push_back(static_cast<std::uint16_t>(64 * w + std::countr_zero(bits)));
  return moving;
}

void RowDifferences::settle(std::span<const std::uint16_t> moving) {
  const std::size_t width = 3 * moving.size();
  settled_.assign(width * needed_.size(), 0.0f);
  for (std::size_t k = 0; k < needed_.size(); ++k) {
    float* const out = settled_.data() + width * k;
    if (needed_[k] < rig_.surface.storedCount()) {
      for (std::size_t c = 0; c < moving.size(); ++c)
        write(stored(needed_[k], moving[c]), out + 3 * c);
      continue;
    }
    for (const Term& t : rig_.surface.derivation(needed_[k])) {
      const float* const from = settled_.data() + width * placeOf_[t.vector];
      const float factor = static_cast<float>(t.factor);
      for (std::size_t c = 0; c < width; ++c) out[c] += factor * from[c];
    }
  }
}

Differences RowDifferences::of(std::span<const Row> rows, std::vector<std::uint16_t>& moving) {
  collect(rows);
  moving = findMoving(rows);
  settle(moving);
  Differences out{static_cast<int>(rows.size()), static_cast<int>(moving.size()), {}};
  const std::size_t width = 3 * moving.size();
  out.values.assign(width * rows.size(), 0.0f);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    float* const to = out.row(static_cast<int>(r));
    for (std::size_t c = 0; rows[r].loose >= 0 && c < moving.size(); ++c)
      write(ofLoose(rows[r].loose, moving[c]), to + 3 * c);
    for (const Term& t : rows[r].terms) {
      const float* const from = settled_.data() + width * placeOf_[t.vector];
      const float factor = static_cast<float>(t.factor);
      for (std::size_t c = 0; c < width; ++c) to[c] += factor * from[c];
    }
  }
  return out;
}

}  // namespace sweepface
