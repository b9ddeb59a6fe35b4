#include "eval/clusters.hpp"

#include <algorithm>
#include <numeric>

#include "sweepface/box.hpp"

#include "surface/sorting.hpp"

namespace sweepface {
namespace {

class Halving {
 public:
  Halving(std::span<const Vec3> points, Index size) : points_(points), size_(size) {
    std::vector<Index> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    halve(all);
  }

  std::vector<std::vector<Index>> take() { return std::move(clusters_); }

 private:
  int longestAxis(std::span<const Index> part) const {
    Box box;
    for (const Index v : part) box.include(points_[v]);
    return box.longestAxis();
  }

  void halve(std::span<Index> part) {
    if (part.empty()) return;
    const auto count = static_cast<Index>(part.size());
    if (count <= size_) {
      sortSmall(part);  // ascending, so that results are written in order
      clusters_.emplace_back(part.begin(), part.end());
      return;
    }
    const int axis = longestAxis(part);
    const Index groups = (count + size_ - 1) / size_, first = groups / 2 * size_;
    const auto before = [&](Index a, Index b) {
      const double x = coordinate(points_[a], axis), y = coordinate(points_[b], axis);
      return x < y || (x == y && a < b);
    };
    divide(part, first, before);
    halve(part.first(first));
    halve(part.subspan(first));
  }

  // Moves the `first` items that come before all others to the front (Hoare, Algorithm 65: find,
  // 1961). Not std::nth_element, which is four times as long. Points can be crafted that would take
  // quadratic time, so it stops after very many bad guesses and leaves them in any order. That only
  // makes clusters less compact.
  template <typename Before>
  static void divide(std::span<Index> items, Index first, const Before& before) {
    constexpr int kGuesses = 100;
    Index low = 0, high = static_cast<Index>(items.size()) - 1;
    for (int guess = 0; low < high && guess < kGuesses; ++guess) {
      const Index middle = items[low + (high - low) / 2];
      Index i = low, j = high;
      while (i <= j) {
        while (before(items[i], middle)) ++i;
        while (before(middle, items[j])) --j;
        if (i <= j) std::swap(items[i++], items[j--]);
      }
      if (first <= j)
        high = j;
      else if (first >= i)
        low = i;
      else
        return;
    }
  }

  std::span<const Vec3> points_;
  Index size_;
  std::vector<std::vector<Index>> clusters_;
};

}  // namespace

std::vector<std::vector<Index>> cluster(std::span<const Vec3> points, Index size) {
  return Halving(points, size).take();
}

}  // namespace sweepface
