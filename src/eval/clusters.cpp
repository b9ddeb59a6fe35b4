#include "eval/clusters.hpp"

#include <algorithm>
#include <cstring>
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
    axis_ = longestAxis(part);
    const Index groups = (count + size_ - 1) / size_, first = groups / 2 * size_;
    divide(part, first);
    // Points in the same place stay together, unless all are there.
    Index cut = first;
    for (Index k = 0; k < cut;)
      compare(part[k], part[first]) == 0 ? std::swap(part[k], part[--cut]) : void(++k);
    if (cut == 0) cut = first;
    halve(part.first(cut));
    halve(part.subspan(cut));
  }

  /// In an order in which points in the same place follow each other.
  bool isBefore(Index a, Index b) const {
    const double x = coordinate(points_[a], axis_), y = coordinate(points_[b], axis_);
    return x < y || (x == y && compare(a, b) < 0);
  }

  /// 0 if they are in the same place.
  int compare(Index a, Index b) const {
    return std::memcmp(&points_[a], &points_[b], sizeof(Vec3));
  }

  // Moves the `first` items that come before all others to the front (Hoare, Algorithm 65: find,
  // 1961). Not std::nth_element, which is four times as long. Points can be crafted that would take
  // quadratic time, so it stops after very many bad guesses and leaves them in any order. That only
  // makes clusters less compact.
  void divide(std::span<Index> items, Index first) const {
    constexpr int kGuesses = 100;
    Index low = 0, high = static_cast<Index>(items.size()) - 1;
    for (int guess = 0; low < high && guess < kGuesses; ++guess) {
      const Index middle = items[low + (high - low) / 2];
      Index i = low, j = high;
      while (i <= j) {
        while (isBefore(items[i], middle)) ++i;
        while (isBefore(middle, items[j])) --j;
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
  int axis_ = 0;  // along which points are divided
  std::vector<std::vector<Index>> clusters_;
};

}  // namespace

std::vector<std::vector<Index>> cluster(std::span<const Vec3> points, Index size) {
  return Halving(points, size).take();
}

}  // namespace sweepface
