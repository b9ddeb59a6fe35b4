#include "fit/patch_equations.hpp"

#include <algorithm>
#include <cmath>

#include "fit/inner_product.hpp"

namespace sweepface {

namespace {

using Dense = PatchEquations::Matrix;

// Weights of samples relative to a vertex.
constexpr double kOneSidedTangent = 0.1;
constexpr double kBetweenWeight = 0.05;
constexpr double kSmoothWeight = 1e-4;

// Collects samples in the patch's own 36 vectors.
class PatchAssembler {
 public:
  PatchAssembler(const Layout& layout, const Draft& draft, const SourceData& data, Index patch,
                 const std::vector<Index>& owner)
      : layout_(layout),
        mesh_(layout.mesh()),
        surface_(draft.surface),
        grid_(draft.patches[patch]),
        data_(data),
        patch_(patch),
        owner_(owner) {
    const Index samples = 8 * (grid_.m + 1) * (grid_.n + 1);
    rows_.reserve(samples);
  }

  PatchEquations assemble(std::span<const std::vector<Term>> expanded) {
    for (Index j = 0; j <= grid_.n; ++j)
      for (Index i = 0; i <= grid_.m; ++i)
        if (owner_[grid_.vertex(i, j)] == patch_) addVertex(i, j);
    addHubTangents();
    addBetween();
    addSmoothness();
    return reduce(expanded);
  }

 private:
  struct Sample {
    Surface::Weights weights;
    double weight;
    PoseRow value;  // empty: zero
  };

  double weightAt(Index i, Index j) const { return data_.weight[mesh_.point[grid_.vertex(i, j)]]; }
  double slopeWeight(Index vertex) const {
    return data_.slopeWeight * data_.slopeEmphasis[mesh_.point[vertex]];
  }
  auto valueOf(Index vertex) const { return data_.points.row(mesh_.point[vertex]); }

  void add(double u, double v, int du, int dv, double weight, PoseRow value) {
    rows_.push_back({surface_.weights({patch_, u, v}, du, dv), weight, std::move(value)});
  }

  void addVertex(Index i, Index j) {
    const Index vertex = grid_.vertex(i, j);
    const double weight = weightAt(i, j);
    add(i, j, 0, 0, weight * data_.placeEmphasis[mesh_.point[vertex]], valueOf(vertex));
    if (!layout_.isRegular(vertex)) return;
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = [&](Index d) -> Index {
        const Index a = i + (axis == 0 ? d : 0), b = j + (axis == 1 ? d : 0);
        return a < 0 || b < 0 || a > grid_.m || b > grid_.n ? -1 : grid_.vertex(a, b);
      };
      Index ahead = at(1), behind = at(-1);
      if (ahead < 0) ahead = layout_.beyond(vertex, behind);
      if (behind < 0) behind = layout_.beyond(vertex, ahead);
      const bool central = ahead >= 0 && behind >= 0;
      PoseRow slope = valueOf(ahead >= 0 ? ahead : vertex) - valueOf(behind >= 0 ? behind : vertex);
      if (central) slope *= 0.5;
      turnIntoTangentPlane(slope, vertex, false);
      if (central && data_.uneven[vertex]) limitLength(slope, vertex, ahead, behind);
      add(i, j, axis == 0, axis == 1,
          weight * slopeWeight(vertex) * (central ? 1 : kOneSidedTangent), std::move(slope));
    }
  }

  // Around an irregular node every patch contributes its own two spokes.
  void addHubTangents() {
    for (int corner = 0; corner < 4; ++corner) {
      const Index i = corner == 1 || corner == 2 ? grid_.m : 0, j = corner >= 2 ? grid_.n : 0;
      const Index vertex = grid_.vertex(i, j);
      if (layout_.isRegular(vertex)) continue;
      for (int axis = 0; axis < 2; ++axis) {
        const Index other =
            axis == 0 ? grid_.vertex(i ? i - 1 : 1, j) : grid_.vertex(i, j ? j - 1 : 1);
        if (mesh_.point[other] == mesh_.point[vertex]) continue;  // a collapsed side
        PoseRow slope = valueOf(other) - valueOf(vertex);
        if ((axis == 0 ? i : j) > 0) slope *= -1;
        turnIntoTangentPlane(slope, vertex, true);
        add(i, j, axis == 0, axis == 1, weightAt(i, j) * slopeWeight(vertex), std::move(slope));
      }
    }
  }

  // Removes the part along the source's normal; keeps the length on request.
  void turnIntoTangentPlane(PoseRow& slope, Index vertex, bool keepLength) const {
    const Index p = mesh_.point[vertex];
    for (Index k = 0; k < data_.poses; ++k) {
      auto s = slope.segment<3>(3 * k);
      const auto n = data_.normals.row(p).segment<3>(3 * k);
      const double before = s.norm();
      s -= s.dot(n) * n;
      if (const double after = s.norm(); keepLength && after > 1e-9 * before) s *= before / after;
    }
  }

  // Where a short edge follows a long one, the mean slope is several times the short edge, and a
  // curve with that slope turns back on itself. So slopes are capped at twice the shorter edge.
  void limitLength(PoseRow& slope, Index vertex, Index ahead, Index behind) const {
    for (Index k = 0; k < data_.poses; ++k) {
      const auto at = [&](Index v) { return valueOf(v).template segment<3>(3 * k); };
      const double most =
          2 * std::min((at(ahead) - at(vertex)).norm(), (at(vertex) - at(behind)).norm());
      auto s = slope.segment<3>(3 * k);
      if (const double length = s.norm(); most > 0 && length > most) s *= most / length;
    }
  }

  // Half-way along an edge, by the cubic through four vertices of its line where there are four.
  struct Middle {
    PoseRow value;
    double trust;
  };
  Middle middle(Index b, Index c) const {
    const Index a = layout_.beyond(b, c), d = layout_.beyond(c, b);
    if (a >= 0 && d >= 0)
      return {(9 * (valueOf(b) + valueOf(c)) - valueOf(a) - valueOf(d)) / 16, 1};
    if (a >= 0) return {-0.125 * valueOf(a) + 0.75 * valueOf(b) + 0.375 * valueOf(c), 0.5};
    if (d >= 0) return {-0.125 * valueOf(d) + 0.75 * valueOf(c) + 0.375 * valueOf(b), 0.5};
    return {0.5 * (valueOf(b) + valueOf(c)), 0.1};
  }

  void addBetween() {
    const Index m = grid_.m, n = grid_.n;
    std::vector<Middle> alongU, alongV;
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i < m; ++i)
        alongU.push_back(middle(grid_.vertex(i, j), grid_.vertex(i + 1, j)));
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i <= m; ++i)
        alongV.push_back(middle(grid_.vertex(i, j), grid_.vertex(i, j + 1)));
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < m; ++i) {
        const Middle &south = alongU[j * m + i], &north = alongU[(j + 1) * m + i];
        const Middle &west = alongV[j * (m + 1) + i], &east = alongV[j * (m + 1) + i + 1];
        const double w = kBetweenWeight * weightAt(i, j);
        add(i + 0.5, j, 0, 0, w * south.trust * (j == 0 ? 0.5 : 1), south.value);
        add(i, j + 0.5, 0, 0, w * west.trust * (i == 0 ? 0.5 : 1), west.value);
        if (j == n - 1) add(i + 0.5, n, 0, 0, w * north.trust * 0.5, north.value);
        if (i == m - 1) add(m, j + 0.5, 0, 0, w * east.trust * 0.5, east.value);
        const PoseRow corners = valueOf(grid_.vertex(i, j)) + valueOf(grid_.vertex(i + 1, j)) +
                                valueOf(grid_.vertex(i, j + 1)) +
                                valueOf(grid_.vertex(i + 1, j + 1));
        add(i + 0.5, j + 0.5, 0, 0,
            w * std::min({south.trust, north.trust, west.trust, east.trust}),
            0.5 * (south.value + north.value + west.value + east.value) - 0.25 * corners);
      }
  }

  void addSmoothness() {
    for (Index j = 0; j < grid_.n; ++j)
      for (Index i = 0; i < grid_.m; ++i)
        for (int d = 0; d <= 3; ++d)
          add(i + 0.5, j + 0.5, d, 3 - d,
              kSmoothWeight * weightAt(i, j) * (d == 1 || d == 2 ? 3 : 1), {});
  }

  PatchEquations reduce(std::span<const std::vector<Term>> expanded) const {
    PatchEquations e;
    e.unknowns = unknowns(expanded);
    const Dense spread = spreadOver(e.unknowns, expanded);
    const auto count = static_cast<Index>(rows_.size());
    // The samples for smoothness come last; their values are zero.
    const auto valued = static_cast<Index>(
        std::ranges::find_if(rows_, [](const Sample& s) { return s.value.size() == 0; }) -
        rows_.begin());
    Dense basis(count, 36);
    PoseMatrix values(valued, 3 * data_.poses);
    for (Index r = 0; r < count; ++r) {
      const double s = std::sqrt(rows_[r].weight);
      for (int k = 0; k < 36; ++k) basis(r, k) = s * rows_[r].weights.factors[k];
      if (r < valued) values.row(r) = s * rows_[r].value;
    }
    e.poses = DistinctPoses(values);
    const Dense local = innerProduct(basis, basis);
    const PoseMatrix localRhs = innerProduct(basis.topRows(valued), e.poses.of(values));
    e.matrix.noalias() = spread.transpose() * (local * spread);
    e.rhs.noalias() = spread.transpose() * localRhs;
    return e;
  }

  // The stored vectors that the 36 depend on, in order.
  std::vector<Index> unknowns(std::span<const std::vector<Term>> expanded) const {
    std::vector<Index> stored;
    for (const Index v : rows_.front().weights.vectors)
      for (const Term& t : expanded[v]) stored.push_back(t.vector);
    std::ranges::sort(stored);
    const auto same = std::ranges::unique(stored);
    stored.erase(same.begin(), same.end());
    return stored;
  }
  // The 36 vectors as combinations of these.
  Dense spreadOver(const std::vector<Index>& stored,
                   std::span<const std::vector<Term>> expanded) const {
    const auto& vectors = rows_.front().weights.vectors;
    Dense spread = Dense::Zero(36, static_cast<Index>(stored.size()));
    for (int k = 0; k < 36; ++k)
      for (const Term& t : expanded[vectors[k]])
        spread(k, std::ranges::lower_bound(stored, t.vector) - stored.begin()) += t.factor;
    return spread;
  }

  const Layout& layout_;
  const GridMesh& mesh_;
  const Surface& surface_;
  const GridPatch& grid_;
  const SourceData& data_;
  Index patch_;
  const std::vector<Index>& owner_;
  std::vector<Sample> rows_;
};

}  // namespace

PatchEquations patchEquations(const Layout& layout, const Draft& draft, const SourceData& data,
                              Index patch, const std::vector<Index>& owner,
                              std::span<const std::vector<Term>> expanded) {
  return PatchAssembler(layout, draft, data, patch, owner).assemble(expanded);
}

}  // namespace sweepface
