#include "fit/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/distinct_poses.hpp"
#include "fit/facets.hpp"
#include "fit/sound_face.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

Index faceVertex(const GridPatch& grid, Index i, Index j, int k) {
  return grid.vertex(i + (k == 1 || k == 2), j + (k >= 2));
}

class PatchMeter {
 public:
  PatchMeter(const Layout& layout, const Draft& draft, const SourceData& data, Index patch,
             const PoseMatrix& settled)
      : mesh_(layout.mesh()),
        surface_(draft.surface),
        grid_(draft.patches[patch]),
        data_(data),
        patch_(patch),
        vectors_(patchVectors(draft, patch, settled)),
        poses_(vectors_) {
    vectors_ = poses_.of(vectors_);
  }

  struct Vertex {
    double distance = 0, angle = 0, squares = 0;
  };
  std::vector<Vertex> vertices() const {
    std::vector<Vertex> result;
    for (Index j = 0; j <= grid_.n; ++j) {
      std::vector<Asked> asked;
      for (Index i = 0; i <= grid_.m; ++i) {
        asked.push_back({double(i), double(j), 0, 0});
        addDerivatives(i, j, asked);
      }
      const PoseMatrix found = at(asked);
      for (Index i = 0; i <= grid_.m; ++i) {
        const Index point = mesh_.point[grid_.vertex(i, j)];
        Vertex worst;
        for (Index k = 0; k < data_.poses; ++k) {
          double distance = norm(vec(found, 3 * i, k) - data_.point(point, k));
          if (std::isnan(distance)) distance = std::numeric_limits<double>::infinity();
          worst.distance = std::max(worst.distance, distance);
          worst.squares += distance * distance;
          const Vec3 normal = cross(vec(found, 3 * i + 1, k), vec(found, 3 * i + 2, k));
          worst.angle = std::max(worst.angle, angleDegrees(normal, data_.normal(point, k)));
        }
        result.push_back(worst);
      }
    }
    return result;
  }

  // The faces, as (i, j), from which a triangle of the fine surface faces away in a pose where the
  // face is sound.
  std::vector<std::pair<Index, Index>> folds() const {
    std::vector<std::pair<Index, Index>> found;
    const Index across = kFineLevel * grid_.m + 1;
    for (Index j = 0; j < grid_.n; ++j) {
      std::vector<Asked> asked;
      for (Index b = 0; b <= kFineLevel; ++b)
        for (Index a = 0; a < across; ++a)
          asked.push_back({a / double{kFineLevel}, j + b / double{kFineLevel}, 0, 0});
      const PoseMatrix x = at(asked);
      for (Index i = 0; i < grid_.m; ++i)
        if (foldsOver(i, j, x, across)) found.emplace_back(i, j);
    }
    return found;
  }

 private:
  Vec3 vec(const PoseMatrix& rows, Index row, Index pose) const {
    const double* const x = &rows(row, poses_.column(pose));
    return {x[0], x[1], x[2]};
  }
  bool foldsOver(Index i, Index j, const PoseMatrix& x, Index across) const {
    for (Index k = 0; k < data_.poses; ++k) {
      if (!soundFace(i, j, k)) continue;
      const Vec3 n = faceNormal(i, j, k);
      for (Index b = 0; b < kFineLevel; ++b)
        for (Index a = 0; a < kFineLevel; ++a) {
          const Index first = b * across + kFineLevel * i + a;
          const Vec3 p = vec(x, first, k), q = vec(x, first + 1, k),
                     r = vec(x, first + across + 1, k), s = vec(x, first + across, k);
          if (dot(cross(q - p, r - p), n) < 0 || dot(cross(r - p, s - p), n) < 0) return true;
        }
    }
    return false;
  }

  // All at once: one matrix product takes far less time than one row after the other.
  struct Asked {
    double u, v;
    int du, dv;
  };
  PoseMatrix at(const std::vector<Asked>& asked) const {
    Eigen::Matrix<double, Eigen::Dynamic, 36, Eigen::RowMajor> factors(asked.size(), 36);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const auto [u, v, du, dv] = asked[k];
      const auto w = surface_.weights({patch_, u, v}, du, dv);
      std::ranges::copy(w.factors, factors.row(static_cast<Eigen::Index>(k)).data());
    }
    return factors * vectors_;
  }
  // At a collapsed side one derivative vanishes; its direction is taken from just inside.
  void addDerivatives(Index i, Index j, std::vector<Asked>& asked) const {
    const Site corner{patch_, double(i), double(j)},
        site = touchesCollapsed(i, j) ? surface_.inside(corner) : corner;
    asked.push_back({site.u, site.v, 1, 0});
    asked.push_back({site.u, site.v, 0, 1});
  }
  bool touchesCollapsed(Index i, Index j) const {
    const Index p = mesh_.point[grid_.vertex(i, j)];
    const auto same = [&](Index a, Index b) {
      return a >= 0 && b >= 0 && a <= grid_.m && b <= grid_.n &&
             mesh_.point[grid_.vertex(a, b)] == p;
    };
    return same(i - 1, j) || same(i + 1, j) || same(i, j - 1) || same(i, j + 1);
  }
  Index pointAt(Index i, Index j, int k) const { return mesh_.point[faceVertex(grid_, i, j, k)]; }
  Vec3 corner(Index i, Index j, int k, Index pose) const {
    return data_.point(pointAt(i, j, k), pose);
  }
  Vec3 faceNormal(Index i, Index j, Index pose) const {
    return cross(corner(i, j, 2, pose) - corner(i, j, 0, pose),
                 corner(i, j, 3, pose) - corner(i, j, 1, pose));
  }
  bool soundFace(Index i, Index j, Index pose) const {
    return isSoundFace(
        4, faceNormal(i, j, pose), data_.tolerance, [&](Index k) { return corner(i, j, k, pose); },
        [&](Index k) { return data_.normal(pointAt(i, j, k), pose); });
  }

  const GridMesh& mesh_;
  const Surface& surface_;
  const GridPatch& grid_;
  const SourceData& data_;
  Index patch_;
  PoseMatrix vectors_;  // [36 × 3·distinct poses]
  DistinctPoses poses_;
};

}  // namespace

DraftErrors measureDraft(const Layout& layout, const Draft& draft, const SourceData& data,
                         const Solution& solution) {
  const PoseMatrix settled = settleAll(draft.surface, solution);
  const Index patches = draft.surface.patchCount();
  std::vector<std::vector<PatchMeter::Vertex>> measured(patches);
  std::vector<std::vector<std::pair<Index, Index>>> foldedFaces(patches);
  DraftErrors errors;
  errors.folded.assign(patches, 0);
  parallelFor(Index{0}, patches, [&](Index p) {
    const PatchMeter meter(layout, draft, data, p, settled);
    measured[p] = meter.vertices();
    foldedFaces[p] = meter.folds();
    errors.folded[p] = !foldedFaces[p].empty();
  });

  const Index vertices = layout.mesh().vertexCount();
  errors.nearFold.assign(vertices, 0);
  for (Index p = 0; p < patches; ++p)
    for (const auto& [i, j] : foldedFaces[p])
      for (int k = 0; k < 4; ++k) errors.nearFold[faceVertex(draft.patches[p], i, j, k)] = 1;
  errors.distance.assign(vertices, 0);
  errors.angle.assign(vertices, 0);
  for (Index p = 0; p < patches; ++p)
    for (std::size_t k = 0; k < measured[p].size(); ++k) {
      const Index v = draft.patches[p].vertices[k];
      const auto& m = measured[p][k];
      errors.distance[v] = std::max(errors.distance[v], m.distance);
      errors.angle[v] = std::max(errors.angle[v], m.angle);
      errors.weightedSquares += data.weight[layout.mesh().point[v]] * m.squares;
    }
  errors.largestDistance = *std::max_element(errors.distance.begin(), errors.distance.end());
  return errors;
}

}  // namespace sweepface
