#include "eval/row_differences.hpp"

#include <algorithm>
#include <bit>

namespace sweepface {
namespace {

constexpr double kMostDifference = 1e30;
constexpr float kMostScaled = 1e15f;  // squares of it stay finite

float clamped(double x) {
  return static_cast<float>(std::clamp(x, -kMostDifference, kMostDifference));
}

}  // namespace

RowDifferences::RowDifferences(const Rig& rig, std::span<const std::vector<float>> influences)
    : rig_(rig),
      targets_(static_cast<Index>(rig.targets.size())),
      columns_(targets_ * static_cast<Index>(std::max<std::size_t>(1, influences.size()))),
      isNeeded_((static_cast<std::size_t>(rig.surface.vectorCount()) + 63) / 64),
      placeOf_(rig.surface.vectorCount()),
      columnAt_(columns_, -1) {
  listMoves(influences);
}

// Counts first, so that all moves lie in one piece.
void RowDifferences::listMoves(std::span<const std::vector<float>> influences) {
  const auto stored = static_cast<std::size_t>(rig_.surface.storedCount());
  const auto each = [&](const auto& use) {
    for (Index c = 0; c < columns_; ++c) {
      const Vec3* const difference = rig_.targets[c % targets_].difference.data();
      const float* const influence = influences.empty() ? nullptr : influences[c / targets_].data();
      for (std::size_t v = 0; v < stored; ++v) {
        const Vec3& d = difference[v];
        if (d.x == 0 && d.y == 0 && d.z == 0) continue;  // most are
        const float share = influence ? influence[v] : 1;
        if (share != 0) use(c, v, share * d);
      }
    }
  };
  firstMove_.assign(stored + 1, 0);
  each([&](Index, std::size_t v, const Vec3&) { ++firstMove_[v + 1]; });
  for (std::size_t v = 0; v < stored; ++v) firstMove_[v + 1] += firstMove_[v];
  moves_.resize(firstMove_.back());
  std::vector<std::size_t> next(firstMove_.begin(), firstMove_.end() - 1);
  each([&](Index c, std::size_t v, const Vec3& d) {
    moves_[next[v]++] = {static_cast<std::uint32_t>(c), clamped(d.x), clamped(d.y), clamped(d.z)};
  });
}

Vec3 RowDifferences::ofLoose(Index loose, Index column) const {
  return column < targets_ ? rig_.targets[column].looseDifference[loose] : Vec3{};
}

void RowDifferences::need(Index vector) {
  std::uint64_t& word = isNeeded_[static_cast<std::size_t>(vector) / 64];
  const std::uint64_t bit = std::uint64_t(1) << vector % 64;
  if (word & bit) return;
  word |= bit;
  stack_.push_back(vector);
}

// Vectors are derived from earlier ones, so they are settled in ascending order.
void RowDifferences::collect(std::span<const Row> rows) {
  const Index storedCount = rig_.surface.storedCount();
  for (const Row& row : rows)
    for (std::size_t t = 0; t < row.vectors.size(); ++t)
      if (row.factors[t] != 0) need(row.vectors[t]);
  while (!stack_.empty()) {
    const Index vector = stack_.back();
    stack_.pop_back();
    if (vector >= storedCount)
      for (const Term& term : rig_.surface.derivation(vector)) need(term.vector);
  }
  needed_.clear();
  for (std::size_t w = 0; w < isNeeded_.size(); ++w)
    for (std::uint64_t bits = std::exchange(isNeeded_[w], 0); bits != 0; bits &= bits - 1) {
      const auto vector = static_cast<Index>(64 * w + std::countr_zero(bits));
      placeOf_[vector] = static_cast<Index>(needed_.size());
      needed_.push_back(vector);
    }
}

void RowDifferences::findMoving(std::span<const Row> rows, std::vector<std::uint16_t>& moving) {
  std::ranges::fill(columnAt_, -1);
  for (const Index v : needed_) {
    if (v >= rig_.surface.storedCount()) break;
    for (std::size_t k = firstMove_[v]; k < firstMove_[v + 1]; ++k) columnAt_[moves_[k].column] = 0;
  }
  for (const Row& row : rows)
    for (Index c = 0; row.loose >= 0 && c < columns_; ++c)
      if (ofLoose(row.loose, c) != Vec3{}) columnAt_[c] = 0;
  moving.clear();
  for (Index c = 0; c < columns_; ++c) {
    if (columnAt_[c] < 0) continue;
    columnAt_[c] = static_cast<int>(moving.size());
    moving.push_back(static_cast<std::uint16_t>(c));
  }
}

void RowDifferences::settle() {
  const int lane = settled_.lane;
  for (std::size_t k = 0; k < needed_.size(); ++k) {
    const Index vector = needed_[k];
    float* const out = settled_.row(static_cast<int>(k));
    if (vector < rig_.surface.storedCount()) {
      for (std::size_t m = firstMove_[vector]; m < firstMove_[vector + 1]; ++m) {
        const Move& move = moves_[m];
        float* const to = out + columnAt_[move.column];
        to[0] = move.x, to[lane] = move.y, to[2 * lane] = move.z;
      }
      continue;
    }
    terms_.clear();
    for (const Term& term : rig_.surface.derivation(vector))
      terms_.push_back({static_cast<float>(term.factor), settled_.row(placeOf_[term.vector])});
    sumRows(terms_, settled_.width(), out);
  }
}

void RowDifferences::of(std::span<const Row> rows, double scale, std::vector<std::uint16_t>& moving,
                        Planes& out) {
  collect(rows);
  findMoving(rows, moving);
  settled_.reshape(static_cast<int>(needed_.size()), static_cast<int>(moving.size()));
  settle();
  out.reshape(static_cast<int>(rows.size()), static_cast<int>(moving.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    float* const to = out.row(static_cast<int>(r));
    terms_.clear();
    for (std::size_t t = 0; t < row.vectors.size(); ++t)
      if (row.factors[t] != 0)
        terms_.push_back({static_cast<float>(row.factors[t] * row.scale * scale),
                          settled_.row(placeOf_[row.vectors[t]])});
    sumRows(terms_, out.width(), to);
    for (std::size_t c = 0; row.loose >= 0 && c < moving.size(); ++c) {
      const Vec3 d = scale * ofLoose(row.loose, moving[c]);
      to[c] = clamped(d.x), to[out.lane + c] = clamped(d.y), to[2 * out.lane + c] = clamped(d.z);
    }
  }
  clampAll(out.values, kMostScaled);
}

}  // namespace sweepface
