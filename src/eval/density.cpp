// How finely to cut, from the pose itself: by the lengths of its arcs or by how far their chords
// are from them. Inside a patch the lines through its middle say the same.
#include <algorithm>
#include <cmath>

#include "eval/stitching.hpp"
#include "surface/segment.hpp"

namespace sweepface {
namespace {

constexpr Index kFinest = 64;  // segments an edge of the source
constexpr int kSamples = 8;    // an edge, to measure by
constexpr double kMostVertices = 1 << 25;

/// A line at even steps of its parameter.
using Samples = std::vector<Vec3>;

double lengthOf(const Samples& line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += norm(line[k] - line[k - 1]);
  return length;
}

/// The point at a share of the line, between its samples.
Vec3 at(const Samples& line, double share) {
  const double x = share * static_cast<double>(line.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(x), line.size() - 2);
  return line[k] + (x - static_cast<double>(k)) * (line[k + 1] - line[k]);
}

/// How far the line is from so many chords.
double sagOf(const Samples& line, Index segments) {
  double most = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(line.size() - 1);
    const auto segment = std::min<Index>(static_cast<Index>(share * segments), segments - 1);
    most = std::max(most, distanceToSegment(line[k], at(line, double(segment) / segments),
                                            at(line, double(segment + 1) / segments)));
  }
  return most;
}

/// The lines that a surface is judged by.
class Lines {
 public:
  Lines(const Surface& surface, std::span<const Vec3> vectors) : surface_(surface) {
    const Wireframe& w = surface.wireframe();
    for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
      const Index count = kSamples * w.arcs[a].edges;
      arcs_.emplace_back();
      for (Index k = 0; k <= count && !w.arcs[a].collapsed; ++k)
        arcs_.back().push_back(surface.pointOnArc(vectors, a, double(k) / kSamples));
    }
    for (Index p = 0; p < surface.patchCount(); ++p)
      for (int d = 0; d < 2; ++d) {
        const double m = surface.edgesU(p), n = surface.edgesV(p);
        const Index count = kSamples * (d == 0 ? surface.edgesU(p) : surface.edgesV(p));
        middles_.emplace_back();
        for (Index k = 0; k <= count; ++k) {
          const double x = double(k) / kSamples;
          middles_.back().push_back(
              surface.evaluate(vectors, d == 0 ? Site{p, x, n / 2} : Site{p, m / 2, x}));
        }
      }
  }

  Density cut(Budget::Kind kind, double value) const {
    Density density;
    const auto segments = [&](const Samples& line) -> Index {
      if (line.empty()) return 1;
      const auto most = static_cast<Index>((line.size() - 1) / kSamples) * kFinest;
      if (kind == Budget::Kind::edgeLength)
        return static_cast<Index>(
            std::clamp(std::ceil(lengthOf(line) / value), 1.0, static_cast<double>(most)));
      Index count = 1;
      while (count < most && sagOf(line, count) > value) ++count;
      return count;
    };
    for (const Samples& line : arcs_) density.arcs.push_back(segments(line));
    for (Index p = 0; p < surface_.patchCount(); ++p)
      density.patches.push_back({segments(middles_[2 * p]), segments(middles_[2 * p + 1])});
    refineToShape(surface_, density);
    return density;
  }

  double longest() const {
    double longest = 0;
    for (const Samples& line : arcs_) longest = std::max(longest, lengthOf(line));
    for (const Samples& line : middles_) longest = std::max(longest, lengthOf(line));
    return longest;
  }

  /// Vertices of a tessellation with this density.
  std::int64_t count(const Density& density) const {
    const Wireframe& w = surface_.wireframe();
    std::vector<char> seen(w.points, 0);
    std::int64_t count = 0;
    for (const Node& node : w.nodes) count += node.point < 0 || !std::exchange(seen[node.point], 1);
    for (std::size_t a = 0; a < w.arcs.size(); ++a)
      if (!w.arcs[a].collapsed) count += density.arcs[a] - 1;
    for (const auto& [columns, rows] : density.patches)
      count += std::int64_t(columns - 1) * (rows - 1);
    return count;
  }

 private:
  const Surface& surface_;
  std::vector<Samples> arcs_, middles_;
};

/// The smallest error, to a hundredth of it, that so many vertices allow.
Result<Density> atMost(const Lines& lines, double vertices) {
  double high = lines.longest(), low = high * 1e-9;  // no sag is longer than its line
  Density best = lines.cut(Budget::Kind::error, high);
  const auto fewest = lines.count(best);
  if (static_cast<double>(fewest) > vertices)
    return fail("The face has ", fewest, " vertices at least; allow so many.");
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    Density density = lines.cut(Budget::Kind::error, middle);
    if (static_cast<double>(lines.count(density)) <= vertices)
      best = std::move(density), high = middle;
    else
      low = middle;
  }
  return best;
}

}  // namespace

namespace {

/// A tessellation may need some vertices more to keep edges apart.
Result<Density> within(const Surface& surface, const Lines& lines, double vertices) {
  double allowed = vertices;
  for (;;) {
    Result<Density> found = atMost(lines, allowed);
    if (!found) return found;
    const double excess = Tessellation(surface, *found).vertexCount() - vertices;
    if (!(excess > 0)) return found;
    allowed -= excess;
  }
}

}  // namespace

double errorOnScreen(double pixels, double distance, double fieldOfView, double height) {
  const auto [sine, cosine] = std::pair(std::sin(fieldOfView / 2), std::cos(fieldOfView / 2));
  return pixels * 2 * distance * sine / cosine / height;
}

Result<Density> densityFor(const Surface& surface, std::span<const Vec3> vectors,
                           const Budget& budget) {
  if (!(budget.value > 0) || !std::isfinite(budget.value))
    return fail("The budget of a level of detail must be a number greater than 0.");
  const Lines lines(surface, vectors);
  if (budget.kind == Budget::Kind::vertices)
    return within(surface, lines, std::min(budget.value, kMostVertices));
  Density density = lines.cut(budget.kind, budget.value);
  const std::int64_t count = lines.count(density);
  if (static_cast<double>(count) > kMostVertices)
    return fail("So fine a mesh has about ", count, " vertices; ask for a coarser one.");
  return density;
}

}  // namespace sweepface
