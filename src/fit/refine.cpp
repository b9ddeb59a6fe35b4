#include "fit/refine.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {

Result<Draft> makeDraft(Layout& layout, ExtraJets& extra) {
  while (true) {
    auto patches = layout.patches();
    if (!patches) return std::unexpected(patches.error());
    Wireframe wireframe = layout.wireframe(*patches);
    const std::vector<Index> vertexOf = layout.nodeVertices();
    for (std::size_t n = 0; n < wireframe.nodes.size(); ++n)
      if (wireframe.nodes[n].point >= 0) wireframe.nodes[n].stored |= extra[vertexOf[n]];
    while (true) {
      std::vector<Index> circle;
      auto surface = Surface::make(wireframe, &circle);
      if (surface) return Draft{std::move(*patches), std::move(*surface)};
      if (circle.empty()) return std::unexpected(surface.error());
      bool extended = false;
      for (Index n : circle) {
        if (wireframe.nodes[n].point < 0) {
          layout.extend(vertexOf[n]);
          extended = true;
        } else {
          wireframe.nodes[n].stored = kWholeJet;
          extra[vertexOf[n]] = kWholeJet;
          if (const Index image = layout.image(vertexOf[n]); image >= 0) extra[image] = kWholeJet;
        }
      }
      if (extended) break;
    }
  }
}

namespace {

// A line to cut along, and how little there is to say for it.
struct Cut {
  Index at = -1;
  double cost = 1e9;
};

class PatchSplitter {
 public:
  PatchSplitter(const Layout& layout, const GridPatch& grid, const SourceData& data)
      : layout_(layout), grid_(grid), data_(data) {}

  // Across which direction the poses are further from parabolas: (residual along u, along v).
  std::pair<double, double> roughness() const { return {residual(true), residual(false)}; }

  // The best grid line of constant u (alongV) or v. Lines that continue others are best: they turn
  // T-nodes into crossings; lines beside existing nodes only crowd them.
  Cut best(bool alongV) const {
    const Index n = alongV ? grid_.m : grid_.n;
    Cut cut;
    for (Index i = 1; i < n; ++i) {
      double cost = std::abs(i - n / 2.0) / n;
      for (int end = 0; end < 2; ++end) cost += crowding(alongV, i, n, end);
      if (i == 1 || i == n - 1) cost += 0.5;
      if (cost < cut.cost) cut = {i, cost};
    }
    return cut;
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

  // The largest distance, relative to the edges there, of the vertices of any grid line along u (v)
  // from the parabola that fits them best.
  double residual(bool alongU) const {
    const Index n = alongU ? grid_.m : grid_.n, lines = alongU ? grid_.n : grid_.m;
    if (n < 3) return 0;
    Eigen::MatrixXd basis(n + 1, 3);
    for (Index i = 0; i <= n; ++i) {
      const double t = 2.0 * i / n - 1;
      basis.row(i) << 1, t, t * t;
    }
    const Eigen::MatrixXd projector =
        Eigen::MatrixXd::Identity(n + 1, n + 1) -
        basis * (basis.transpose() * basis).ldlt().solve(basis.transpose());
    double worst = 0;
    PoseMatrix values(n + 1, data_.points.cols());
    for (Index line = 0; line <= lines; ++line) {
      for (Index i = 0; i <= n; ++i) values.row(i) = data_.points.row(pointAt(alongU, i, line));
      const PoseMatrix rest = projector * values;
      for (Index i = 0; i <= n; ++i) {
        const double scale = std::sqrt(data_.weight[pointAt(alongU, i, line)]);
        for (Index k = 0; k < data_.poses; ++k)
          worst = std::max(worst, scale * rest.row(i).segment<3>(3 * k).norm());
      }
    }
    return worst;
  }
  Index pointAt(bool alongU, Index i, Index line) const {
    return layout_.mesh().point[alongU ? grid_.vertex(i, line) : grid_.vertex(line, i)];
  }

  const Layout& layout_;
  const GridPatch& grid_;
  const SourceData& data_;
};

// Splits a patch along one line, or two where both directions are as rough. False if it is too
// small.
bool splitPatch(Layout& layout, const GridPatch& grid, const SourceData& data) {
  const PatchSplitter splitter(layout, grid, data);
  Cut columns = splitter.best(true), rows = splitter.best(false);
  if (columns.at < 0 && rows.at < 0) return false;
  if (columns.at >= 0 && rows.at >= 0) {
    constexpr double kAlike = 0.9;
    const auto [alongU, alongV] = splitter.roughness();
    if (alongU < kAlike * alongV)
      columns.at = -1;
    else if (alongV < kAlike * alongU)
      rows.at = -1;
  }
  if (columns.at >= 0) layout.split(grid, true, columns.at);
  if (rows.at >= 0) layout.split(grid, false, rows.at);
  return true;
}

}  // namespace

Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
             const RefineLimits& limits, ExtraJets& extra) {
  const GridMesh& mesh = layout.mesh();
  const auto excess = [&](Index v) {
    return std::max(errors.distance[v] / limits.distance, errors.angle[v] / limits.angle);
  };
  // A patch that is nearly within the limits may get there without more points if what is wrong at
  // its worst vertices counts more (Lawson's way from least squares to least maximum). That costs
  // smoothness: where normals matter it is tried less.
  const double nearly = limits.smooth ? 1.5 : 3, most = limits.smooth ? 4 : 64;
  const auto emphasize = [&](const GridPatch& grid) {
    bool any = false;
    const auto raise = [&](double& emphasis) {
      if (emphasis >= most) return;
      emphasis *= 2;
      any = true;
    };
    for (Index v : grid.vertices) {
      if (errors.distance[v] > limits.distance) raise(data.placeEmphasis[mesh.point[v]]);
      if (errors.angle[v] > limits.angle) raise(data.slopeEmphasis[mesh.point[v]]);
    }
    return any;
  };
  std::vector<std::pair<double, Index>> bad;
  for (Index p = 0; p < draft.surface.patchCount(); ++p) {
    double worst = errors.folded[p] ? 1.5 : 0;
    for (Index v : draft.patches[p].vertices) worst = std::max(worst, excess(v));
    if (worst > 1) bad.emplace_back(-worst, p);
  }
  std::sort(bad.begin(), bad.end());
  Index changed = 0;
  bool unfolding = false;
  for (auto [worst, p] : bad) {
    const GridPatch& grid = draft.patches[p];
    if (!errors.folded[p] && -worst < nearly && emphasize(grid)) {
      ++changed;
      continue;
    }
    if (splitPatch(layout, grid, data)) {
      ++changed;
      unfolding |= errors.folded[p] != 0;
      continue;
    }
    // Too small to split: turn its T-nodes into crossings.
    for (Index v : grid.vertices)
      if (layout.isNode(v) && !layout.isFull(v)) {
        layout.extend(v);
        ++changed;
        unfolding |= errors.folded[p] != 0;
      } else if (limits.smooth && errors.nearFold[v] && (extra[v] & kSlopes) != kSlopes) {
        extra[v] |= kSlopes;
        ++changed;
        unfolding = true;
      } else if (limits.smooth && errors.nearFold[v] && !data.uneven[v]) {
        data.uneven[v] = 1;
        ++changed;
        unfolding = true;
      }
  }
  const Index stalled = draft.surface.patchCount() / 500;
  if (changed > stalled || unfolding) return changed;
  // Little is left to cut: let positions that are too far off count more than what surrounds them.
  for (Index v = 0; v < mesh.vertexCount(); ++v)
    if (errors.distance[v] > limits.distance) {
      data.placeEmphasis[mesh.point[v]] *= 8;
      ++changed;
    }
  return changed;
}

}  // namespace sweepface
