#include "codec/mirror.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sweepface/box.hpp"

#include "codec/limits.hpp"
#include "codec/mirror_spreader.hpp"

namespace sweepface::codec {

namespace {

Loops loopsOf(const Connectivity& c) { return {c.next, c.prev, c.cornerAt}; }

std::vector<Vec3> nodePositions(const Surface& surface, std::span<const Vec3> neutral) {
  const Wireframe& w = surface.wireframe();
  std::vector<Vec3> vectors(surface.vectorCount()), positions(w.nodes.size());
  surface.settle(neutral, vectors);
  for (HalfArc h = 0; h < static_cast<HalfArc>(2 * w.arcs.size()); ++h)
    positions[w.start(h)] =
        surface.pointOnArc(vectors, arcOf(h), h & 1 ? w.arcs[arcOf(h)].edges : 0);
  return positions;
}

// The diagonal of the box around the middle nine tenths along each axis.
double usualSize(const std::vector<Vec3>& positions) {
  Vec3 size;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (const Vec3& p : positions) places.push_back(coordinate(p, axis));
    const auto few = std::ssize(places) / 20;
    std::ranges::nth_element(places, places.begin() + few);
    const double low = places[few];
    std::ranges::nth_element(places, places.end() - 1 - few);
    coordinate(size, axis) = *(places.end() - 1 - few) - low;
  }
  return norm(size);
}

// For each node, the node nearest to its image across the middle of an axis, within `reach`; the
// first of several equally near, -1 if there is none.
std::vector<Index> imagesAcross(const std::vector<Vec3>& positions, const Box& box, int axis,
                                double reach) {
  const double twice = coordinate(box.low, axis) + coordinate(box.high, axis);
  const int along = box.longestAxis();
  std::vector<Index> sorted(positions.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  const auto key = [&](Index n) { return coordinate(positions[n], along); };
  std::ranges::sort(sorted, {}, key);
  std::vector<Index> images;
  for (const Vec3& p : positions) {
    Vec3 image = p;
    coordinate(image, axis) = twice - coordinate(p, axis);
    const double place = coordinate(image, along);
    Index nearest = -1;
    double least = reach;
    for (auto at = std::ranges::lower_bound(sorted, place - reach, {}, key);
         at != sorted.end() && key(*at) <= place + reach; ++at)
      if (const double d = norm(positions[*at] - image); d < least || (d == least && *at < nearest))
        least = d, nearest = *at;
    images.push_back(nearest);
  }
  return images;
}

}  // namespace

Mirror spreadMirror(const Wireframe& w, const Connectivity& c,
                    std::span<const std::array<HalfArc, 2>> seeds) {
  MirrorSpreader spreader(w, loopsOf(c));
  const auto halves = static_cast<HalfArc>(2 * w.arcs.size());
  for (const auto& [h, g] : seeds)
    if (h >= 0 && g >= 0 && h < halves && g < halves) spreader.spread(h, g);
  Mirror mirror;
  mirror.halfArc.assign(2 * w.arcs.size(), -1);
  mirror.node.assign(w.nodes.size(), -1);
  for (HalfArc h = 0; h < halves; ++h) {
    const HalfArc g = spreader.bound(h);
    if (g < 0) continue;
    mirror.halfArc[h] = twin(g);
    mirror.halfArc[twin(h)] = g;
    spreader.noteEnds(h, mirror.node);
  }
  return mirror;
}

MirrorSeeds findMirror(const Surface& surface, std::span<const Vec3> neutral) {
  const Wireframe& w = surface.wireframe();
  const std::vector<Vec3> positions = nodePositions(surface, neutral);
  MirrorSeeds seeds;
  if (positions.empty()) return seeds;
  const Box box(positions);
  // Of the diagonal, but something small far away must not put the whole face within reach.
  constexpr double kNear = 2e-3, kFar = 10;
  const double reach = kNear * std::min(norm(box.size()), kFar * usualSize(positions));
  if (!(reach > 0) || !std::isfinite(reach)) return seeds;
  std::vector<Index> best;
  auto found = static_cast<std::ptrdiff_t>(positions.size() / 2);
  for (int axis = 0; axis < 3; ++axis) {
    auto images = imagesAcross(positions, box, axis, reach);
    const auto count = std::ranges::count_if(images, [](Index n) { return n >= 0; });
    if (count <= found) continue;
    found = count;
    seeds.axis = axis;
    best = std::move(images);
  }
  if (best.empty()) return seeds;

  const Connectivity& c = surface.connectivity();
  std::map<std::array<Index, 2>, HalfArc> between;
  for (HalfArc h = 0; h < static_cast<HalfArc>(c.patchOf.size()); ++h)
    if (c.patchOf[h] >= 0) between[{w.start(h), w.end(h)}] = h;
  constexpr std::size_t kWorthwhile = 16;  // half-arcs that pay for the bytes of a pair
  MirrorSpreader spreader(w, loopsOf(c));
  for (HalfArc h = 0; h < static_cast<HalfArc>(c.patchOf.size()); ++h) {
    if (c.patchOf[h] < 0 || spreader.bound(h) >= 0) continue;
    const auto image = between.find({best[w.end(h)], best[w.start(h)]});
    if (image == between.end()) continue;
    const auto spread = spreader.spread(h, image->second);
    if (spread.size() < kWorthwhile) {
      spreader.undo();
      continue;
    }
    // Choose the pair of which a reader of the wireframe knows both sides first. Arcs are numbered
    // as they come.
    const auto bothKnown = [&](HalfArc a) { return std::max(a, spreader.bound(a)); };
    const HalfArc first = *std::ranges::min_element(spread, {}, bothKnown);
    seeds.pairs.push_back({first, spreader.bound(first)});
    if (seeds.pairs.size() == kMostMirrorPairs) break;
  }
  return seeds;
}

}  // namespace sweepface::codec
