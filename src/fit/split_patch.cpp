#include "fit/split_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/inner_product.hpp"

namespace sweepface {

namespace {

class PatchSplitter {
 public:
  PatchSplitter(const Layout& layout, const GridPatch& grid, const SourceData& data)
      : layout_(layout), grid_(grid), data_(data) {}

  // The best grid line of constant u (alongV) or v, -1 if there is none. Lines that continue others
  // are best: they turn T-nodes into crossings. Lines beside existing nodes only crowd them.
  Index best(bool alongV) const {
    const Index n = alongV ? grid_.m : grid_.n;
    Index best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 1; i < n; ++i) {
      double cost = std::abs(i - n / 2.0) / n;
      for (int end = 0; end < 2; ++end) cost += crowding(alongV, i, n, end);
      if (i == 1 || i == n - 1) cost += 0.5;
      if (cost < least) least = cost, best = i;
    }
    return best;
  }

  // The largest distance, relative to the edges there, of the vertices of any grid line along u (v)
  // from the parabola that fits them best.
  double roughness(bool alongU) const {
    const Index n = alongU ? grid_.m : grid_.n, lines = alongU ? grid_.n : grid_.m;
    if (n < 3) return 0;
    Eigen::MatrixXd basis(n + 1, 3);
    for (Index i = 0; i <= n; ++i) {
      const double t = 2.0 * i / n - 1;
      basis.row(i) << 1, t, t * t;
    }
    const auto normal = innerProduct(basis, basis).ldlt();
    double worst = 0;
    PoseMatrix values(n + 1, data_.points.cols());
    for (Index line = 0; line <= lines; ++line) {
      for (Index i = 0; i <= n; ++i) values.row(i) = data_.points.row(pointAt(alongU, i, line));
      const PoseMatrix rest = values - basis * normal.solve(innerProduct(basis, values));
      for (Index i = 0; i <= n; ++i) {
        const double scale = std::sqrt(data_.weight[pointAt(alongU, i, line)]);
        for (Index k = 0; k < data_.poses; ++k)
          worst = std::max(worst, scale * rest.row(i).segment<3>(3 * k).norm());
      }
    }
    return worst;
  }

 private:
  Index vertexOnSide(bool alongV, Index i, int end) const {
    return alongV ? grid_.vertex(i, end ? grid_.n : 0) : grid_.vertex(end ? grid_.m : 0, i);
  }
  double crowding(bool alongV, Index i, Index n, int end) const {
    const auto node = [&](Index k) {
      return k >= 0 && k <= n && layout_.isNode(vertexOnSide(alongV, k, end));
    };
    if (node(i)) return 0;
    if (node(i - 1) || node(i + 1)) return 1;
    if (node(i - 2) || node(i + 2)) return 0.3;
    return 0.05;
  }
  Index pointAt(bool alongU, Index i, Index line) const {
    return layout_.mesh().point[alongU ? grid_.vertex(i, line) : grid_.vertex(line, i)];
  }

  const Layout& layout_;
  const GridPatch& grid_;
  const SourceData& data_;
};

}  // namespace

bool splitPatch(Layout& layout, const GridPatch& grid, const SourceData& data) {
  const PatchSplitter splitter(layout, grid, data);
  Index column = splitter.best(true), row = splitter.best(false);
  if (column < 0 && row < 0) return false;
  if (column >= 0 && row >= 0) {
    constexpr double kAlike = 0.9;
    const double alongU = splitter.roughness(true), alongV = splitter.roughness(false);
    if (alongU < kAlike * alongV)
      column = -1;
    else if (alongV < kAlike * alongU)
      row = -1;
  }
  if (column >= 0) layout.split(grid, true, column);
  if (row >= 0) layout.split(grid, false, row);
  return true;
}

}  // namespace sweepface
