#include <algorithm>

#include "sweepface/eval.hpp"

#include "eval/stitching.hpp"
#include "surface/vertex_numbers.hpp"

namespace sweepface {

namespace {

Density densityOf(const Surface& surface, Index level) {
  Density density;
  for (const Arc& arc : surface.wireframe().arcs) density.arcs.push_back(level * arc.edges);
  for (Index p = 0; p < surface.patchCount(); ++p)
    density.patches.push_back({level * surface.edgesU(p), level * surface.edgesV(p)});
  return density;
}

}  // namespace

Tessellation::Tessellation(const Surface& surface, Index level)
    : surface_(&surface),
      level_(level),
      vectors_(surface.vectorCount()),
      density_(densityOf(surface, level)) {
  placeAll();
}

Tessellation::Tessellation(const Surface& surface, Density density)
    : surface_(&surface), level_(0), vectors_(surface.vectorCount()), density_(std::move(density)) {
  refineToShape(surface, density_);
  constexpr int kMostRounds = 4;
  for (int round = 0; round < kMostRounds; ++round) {
    placeAll();
    if (!separateEdges()) return;
    forgetPlaces();
  }
  placeAll();
}

Tessellation::Tessellation(const Surface& surface, std::vector<Site> sites)
    : surface_(&surface),
      level_(0),
      isOfSites_(true),
      vectors_(surface.vectorCount()),
      nodeVertex_(surface.wireframe().nodes.size(), -1),
      arcVertex_(surface.wireframe().arcs.size(), -1),
      patchVertex_(surface.patchCount(), -1),
      sites_(std::move(sites)) {
  weighPatches();
}

bool Tessellation::fits(const Surface& surface) const {
  const Wireframe& w = surface.wireframe();
  return nodeVertex_.size() == w.nodes.size() && arcVertex_.size() == w.arcs.size() &&
         patchVertex_.size() == w.patches.size() && vectors_ == surface.vectorCount();
}

void Tessellation::forgetPlaces() {
  arcVertex_.clear(), patchVertex_.clear();
  sites_.clear(), arcWeights_.clear(), patchFactors_.clear();
}

void Tessellation::placeAll() {
  placeArcs();
  onArcs_ = vertexCount();
  placePatches();
}

void Tessellation::placeArcs() {
  const Wireframe& w = surface_->wireframe();
  const Connectivity& c = surface_->connectivity();
  nodeVertex_ = VertexNumbers(w).ofNode;
  const auto add = [&](Index arc, Index step) {
    const HalfArc h = c.patchOf[2 * arc] >= 0 ? 2 * arc : 2 * arc + 1;
    const double t = static_cast<double>(step) * w.arcs[arc].edges / density_.arcs[arc];
    sites_.push_back(surface_->siteOnArc(h, h & 1 ? w.arcs[arc].edges - t : t));
    arcWeights_.push_back(surface_->arcWeights(arc, t));
  };
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    if (nodeVertex_[n] < vertexCount()) continue;
    const auto& arms = c.stars[n].arms;
    const auto open =
        std::ranges::find_if(arms, [&](HalfArc h) { return !w.arcs[arcOf(h)].collapsed; });
    const HalfArc arm = open == arms.end() ? arms[0] : *open;
    add(arcOf(arm), arm & 1 ? density_.arcs[arcOf(arm)] : 0);
  }
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    arcVertex_.push_back(vertexCount());
    if (w.arcs[a].collapsed) continue;
    for (Index step = 1; step < density_.arcs[a]; ++step) add(a, step);
  }
}

void Tessellation::placePatches() {
  for (Index p = 0; p < surface_->patchCount(); ++p) {
    patchVertex_.push_back(vertexCount());
    const auto& [columns, rows] = density_.patches[p];
    for (Index j = 1; j < rows; ++j)
      for (Index i = 1; i < columns; ++i)
        sites_.push_back({p, static_cast<double>(i) * surface_->edgesU(p) / columns,
                          static_cast<double>(j) * surface_->edgesV(p) / rows});
  }
  weighPatches();
}

void Tessellation::weighPatches() {
  patchVectors_.resize(patchVertex_.size());
  patchFactors_.reserve(sites_.size() - onArcs_);
  for (Index v = onArcs_; v < vertexCount(); ++v) {
    const auto [vectors, factors] = surface_->weights(sites_[v]);
    patchVectors_[sites_[v].patch] = vectors;
    patchFactors_.push_back(factors);
  }
}

Index Tessellation::sideVertex(Index patch, int side, Index steps) const {
  const Wireframe& w = surface_->wireframe();
  for (HalfArc h : w.side(patch, side)) {
    const Arc& arc = w.arcs[arcOf(h)];
    const Index length = density_.arcs[arcOf(h)];
    if (steps == 0 || (arc.collapsed && steps <= length)) return nodeVertex_[w.start(h)];
    if (steps < length) return arcVertex_[arcOf(h)] + (h & 1 ? length - steps : steps) - 1;
    steps -= length;
  }
  return nodeVertex_[w.end(w.side(patch, side).back())];
}

Index Tessellation::vertex(Index patch, Index i, Index j) const {
  const auto [m, n] = density_.patches[patch];
  if (j == 0) return sideVertex(patch, 0, i);
  if (i == m) return sideVertex(patch, 1, j);
  if (j == n) return sideVertex(patch, 2, m - i);
  if (i == 0) return sideVertex(patch, 3, n - j);
  return patchVertex_[patch] + (j - 1) * (m - 1) + i - 1;
}

std::vector<std::array<Index, 4>> Tessellation::faces() const {
  std::vector<std::array<Index, 4>> result;
  for (Index p = 0; p < surface_->patchCount(); ++p) {
    const Index m = level_ * surface_->edgesU(p), n = level_ * surface_->edgesV(p);
    std::vector<Index> row(m + 1), above(m + 1);
    for (Index i = 0; i <= m; ++i) row[i] = vertex(p, i, 0);
    for (Index j = 0; j < n; ++j, std::swap(row, above)) {
      for (Index i = 0; i <= m; ++i) above[i] = vertex(p, i, j + 1);
      for (Index i = 0; i < m; ++i) result.push_back({row[i], row[i + 1], above[i + 1], above[i]});
    }
  }
  return result;
}

Tessellation::Terms Tessellation::terms(Index vertex) const {
  if (vertex < onArcs_) return {arcWeights_[vertex].vectors, arcWeights_[vertex].factors};
  return {patchVectors_[sites_[vertex].patch], patchFactors_[vertex - onArcs_]};
}

void Tessellation::positions(std::span<const Vec3> vectors, std::span<Vec3> out) const {
  for (Index v = 0; v < vertexCount(); ++v) {
    const Terms t = terms(v);
    Vec3 sum;
    for (std::size_t k = 0; k < t.vectors.size(); ++k) sum += t.factors[k] * vectors[t.vectors[k]];
    out[v] = sum;
  }
}

std::vector<Vec3> Tessellation::positions(std::span<const Vec3> vectors) const {
  std::vector<Vec3> out(vertexCount());
  positions(vectors, out);
  return out;
}

void Tessellation::normals(std::span<const Vec3> vectors, std::span<Vec3> out) const {
  for (Index v = 0; v < vertexCount(); ++v) out[v] = surface_->normal(vectors, sites_[v]);
}

std::vector<Vec3> Tessellation::normals(std::span<const Vec3> vectors) const {
  std::vector<Vec3> out(vertexCount());
  normals(vectors, out);
  return out;
}

namespace {

std::vector<Vec3> inSourceOrder(const SourceMesh& source, const std::vector<Vec3>& grid,
                                const std::vector<Vec3>& loose) {
  std::vector<Vec3> out(source.gridVertex.size());
  for (std::size_t v = 0; v < out.size(); ++v) {
    const Index g = source.gridVertex[v];
    out[v] = g >= 0 ? grid[g] : loose[-1 - g];
  }
  return out;
}

}  // namespace

std::vector<Vec3> sourcePositions(const Rig& rig, const Tessellation& level1,
                                  std::span<const Vec3> vectors, std::span<const double> weights) {
  return inSourceOrder(rig.source, level1.positions(vectors), blendLoose(rig, weights));
}

std::vector<Vec3> sourceNormals(const Rig& rig, const Tessellation& level1,
                                std::span<const Vec3> vectors) {
  return inSourceOrder(rig.source, level1.normals(vectors),
                       std::vector<Vec3>(rig.source.loose.size(), Vec3{0, 0, 1}));
}

}  // namespace sweepface
