#include "fit/shapes.hpp"

#include <algorithm>
#include <memory>

#include "fit/inner_product.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

// The squared errors of a patch at its vertices as a quadratic form in the 36 basis values, summed
// over all poses: |b·Q − y|² = b QQᵀ b − 2 b Qyᵀ + yyᵀ. Once it is made, the cost of trying another
// basis does not depend on the number of poses.
class PatchForm {
 public:
  PatchForm(const Layout& layout, const Draft& draft, const SourceData& data, Index patch,
            const PoseMatrix& settled)
      : surface_(&draft.surface), grid_(&draft.patches[patch]), patch_(patch) {
    const GridMesh& mesh = layout.mesh();
    const PoseMatrix q = patchVectors(draft, patch, settled);
    gram_ = innerProduct(q.transpose(), q.transpose());
    for (Index v : grid_->vertices) {
      const auto y = data.points.row(mesh.point[v]);
      weight_.push_back(data.weight[mesh.point[v]]);
      cross_.push_back(q * y.transpose());
      square_.push_back(y.squaredNorm());
    }
  }

  double error(const Surface::PatchBasis& basis) const {
    double sum = 0;
    std::size_t k = 0;
    for (Index j = 0; j <= grid_->n; ++j)
      for (Index i = 0; i <= grid_->m; ++i, ++k) {
        const bool corner = (i == 0 || i == grid_->m) && (j == 0 || j == grid_->n);
        if (corner) continue;  // no basis moves a corner
        const auto w = surface_->weights({patch_, double(i), double(j)}, basis);
        const Eigen::Map<const Eigen::Matrix<double, 36, 1>> b(w.factors.data());
        sum += weight_[k] * (b.dot(gram_ * b) - 2 * b.dot(cross_[k]) + square_[k]);
      }
    return sum;
  }

 private:
  const Surface* surface_;
  const GridPatch* grid_;
  Index patch_;
  Eigen::Matrix<double, 36, 36> gram_;
  std::vector<double> weight_, square_;
  std::vector<Eigen::Matrix<double, 36, 1>> cross_;
};

// Stiffness of the candidates over the ribbon's longest sweep: −η/ρ and λ/ρ of the unit interval.
// Less than this has no visible effect.
constexpr std::pair<double, double> kCandidates[] = {
    {40, 0}, {200, 0}, {1000, 0}, {0, 1e3}, {0, 2e4}};

class ShapeChooser {
 public:
  ShapeChooser(const Layout& layout, const Draft& draft, const SourceData& data,
               const Solution& solution, std::vector<Shape>& ribbons)
      : surface_(draft.surface), w_(draft.surface.wireframe()), ribbons_(ribbons) {
    const PoseMatrix settled = settleAll(draft.surface, solution);
    const Index patches = surface_.patchCount();
    std::vector<std::unique_ptr<PatchForm>> forms(patches);
    parallelFor(Index{0}, patches, [&](Index p) {
      forms[p] = std::make_unique<PatchForm>(layout, draft, data, p, settled);
    });
    forms_ = std::move(forms);
    findTouched();
  }

  Index run() {
    Index changed = 0;
    for (Index r = 0; r < static_cast<Index>(ribbons_.size()); ++r) changed += improve(r);
    return changed;
  }

 private:
  Index sideRibbon(Index patch, int s) const { return w_.arcs[arcOf(w_.side(patch, s)[0])].ribbon; }

  void findTouched() {
    touched_.resize(ribbons_.size());
    longest_.assign(ribbons_.size(), 1);
    fixed_.assign(ribbons_.size(), 0);
    for (Index p = 0; p < surface_.patchCount(); ++p)
      for (int s = 0; s < 4; ++s) {
        const Index r = sideRibbon(p, s);
        if (touched_[r].empty() || touched_[r].back() != p) touched_[r].push_back(p);
        longest_[r] = std::max(longest_[r], w_.sideEdges(p, s));
      }
    const Connectivity& c = surface_.connectivity();
    for (std::size_t n = 0; n < w_.nodes.size(); ++n)
      if (c.kinds[n] == NodeKind::hanging)
        for (int k = 0; k < 3; ++k)
          if (c.opposite(static_cast<Index>(n), k) >= 0)
            fixed_[w_.arcs[arcOf(c.stars[n].arms[k])].ribbon] = 1;
  }

  // The error of all patches that a ribbon touches if it had another shape.
  double error(Index ribbon, const Shape& shape) const {
    double sum = 0;
    for (Index p : touched_[ribbon]) {
      const int sides[3] = {0, 3, 1};
      SweepBasis made[3];
      Surface::PatchBasis basis = surface_.patchBasis(p);
      const SweepBasis** slots[3] = {&basis.u, &basis.v0, &basis.v1};
      for (int k = 0; k < 3; ++k) {
        const Index r = sideRibbon(p, sides[k]);
        auto fresh = SweepBasis::make(r == ribbon ? shape : ribbons_[r], w_.sideEdges(p, sides[k]));
        if (!fresh) return 1e300;
        made[k] = *fresh;
        *slots[k] = &made[k];
      }
      sum += forms_[p]->error(basis);
    }
    return sum;
  }

  bool improve(Index r) {
    if (fixed_[r] || longest_[r] < 2) return false;
    constexpr double kWorthwhile = 0.98;
    double best = kWorthwhile * error(r, ribbons_[r]);
    Shape chosen = ribbons_[r];
    const double h2 = static_cast<double>(longest_[r]) * longest_[r];
    for (const auto& [eta, lambda] : kCandidates) {
      const Shape shape{1, -eta / h2, lambda / (h2 * h2)};
      if (const double e = error(r, shape); e < best) best = e, chosen = shape;
    }
    const bool changed = !(chosen == ribbons_[r]);
    ribbons_[r] = chosen;
    return changed;
  }

  const Surface& surface_;
  const Wireframe& w_;
  std::vector<Shape>& ribbons_;
  std::vector<std::unique_ptr<PatchForm>> forms_;
  std::vector<std::vector<Index>> touched_;
  std::vector<Index> longest_;
  std::vector<char> fixed_;
};

}  // namespace

Index chooseShapes(const Layout& layout, const Draft& draft, const SourceData& data,
                   const Solution& solution, std::vector<Shape>& ribbons) {
  return ShapeChooser(layout, draft, data, solution, ribbons).run();
}

}  // namespace sweepface
