#include "picture/raster.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {

Raster::Raster(const Scene& scene, const Camera& camera, PictureSize size)
    : triangles_(scene.triangles),
      size_(size),
      columns_((size.width + kTile - 1) / kTile),
      rows_((size.height + kTile - 1) / kTile) {
  screen_.reserve(scene.positions.size());
  for (const Vec3& p : scene.positions) {
    const Vec3 seen = camera.project(p, size);
    screen_.push_back({seen.x, seen.y, seen.z > 0 ? 1 / seen.z : -1});
  }
  // Visits all triangles twice: to count those of each tile, and to list them.
  const auto eachTile = [&](Index triangle, auto visit) {
    const Bounds b = boundsOf(triangle);
    for (Index y = b.top / kTile; y <= b.bottom / kTile && b.top <= b.bottom; ++y)
      for (Index x = b.left / kTile; x <= b.right / kTile && b.left <= b.right; ++x)
        visit(y * columns_ + x);
  };
  const auto count = static_cast<Index>(triangles_.size());
  tileStart_.assign(tileCount() + 1, 0);
  for (Index t = 0; t < count; ++t) eachTile(t, [&](Index tile) { ++tileStart_[tile + 1]; });
  for (Index tile = 0; tile < tileCount(); ++tile) tileStart_[tile + 1] += tileStart_[tile];
  tileTriangles_.resize(tileStart_.back());
  std::vector<Index> next(tileStart_.begin(), tileStart_.end() - 1);
  for (Index t = 0; t < count; ++t)
    eachTile(t, [&](Index tile) { tileTriangles_[next[tile]++] = t; });
}

Raster::Bounds Raster::boundsOf(Index triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  const Vec3 &p = screen_[a], &q = screen_[b], &r = screen_[c];
  if (p.z <= 0 || q.z <= 0 || r.z <= 0) return {0, -1, 0, -1};  // behind the eye
  const auto inside = [](double x, Index size) {
    return static_cast<Index>(std::clamp(std::floor(x), -1.0, static_cast<double>(size)));
  };
  const Index w = size_.width, h = size_.height;
  return {std::max(inside(std::min({p.x, q.x, r.x}), w), 0),
          std::min(inside(std::max({p.x, q.x, r.x}), w), w - 1),
          std::max(inside(std::min({p.y, q.y, r.y}), h), 0),
          std::min(inside(std::max({p.y, q.y, r.y}), h), h - 1)};
}

void Raster::look(Index tile, std::vector<Hit>& hits) const {
  hits.assign(kTile * kTile * kSamples, {});
  const Index left = tileX(tile), top = tileY(tile);
  for (Index k = tileStart_[tile]; k < tileStart_[tile + 1]; ++k) {
    const Index t = tileTriangles_[k];
    const auto& [a, b, c] = triangles_[t];
    const double area = side(a, b, screen_[c].x, screen_[c].y);
    if (area == 0) continue;
    const double za = screen_[a].z / area, zb = screen_[b].z / area, zc = screen_[c].z / area;
    const Bounds box = boundsOf(t);
    for (Index y = std::max(box.top, top); y <= std::min(box.bottom, top + kTile - 1); ++y)
      for (Index x = std::max(box.left, left); x <= std::min(box.right, left + kTile - 1); ++x) {
        Hit* const hit = &hits[((y - top) * kTile + x - left) * kSamples];
        for (int s = 0; s < kSamples; ++s) {
          const auto e = sides(t, x + kSamplePlaces[s][0], y + kSamplePlaces[s][1]);
          const bool inside =
              area > 0 ? e[0] >= 0 && e[1] >= 0 && e[2] >= 0 : e[0] <= 0 && e[1] <= 0 && e[2] <= 0;
          if (!inside) continue;
          const auto depth = static_cast<float>(e[0] * za + e[1] * zb + e[2] * zc);
          if (depth > hit[s].depth) hit[s] = {t, depth};
        }
      }
  }
}

Raster::Place Raster::placeIn(Index triangle, double x, double y) const {
  const auto& corners = triangles_[triangle];
  std::array<double, 3> w = sides(triangle, x, y);
  // Weights on the screen are those in space divided by the distance.
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += w[k] *= screen_[corners[k]].z;
  for (double& weight : w) weight /= sum;
  // Rows run down the picture, so what is counter-clockwise in space is clockwise here.
  return {w, sum < 0};
}

}  // namespace sweepface
