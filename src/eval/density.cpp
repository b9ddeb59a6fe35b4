// Chooses a density for a pose, by the lengths of its arcs or by how far their chords are from
// them. Inside a patch, the two lines through its middle are measured likewise; for an error, its
// triangles are measured after that.
#include <algorithm>
#include <cmath>

#include "eval/sag.hpp"
#include "eval/stitching.hpp"
#include "ode/elementary.hpp"
#include "surface/distances.hpp"

namespace sweepface {
namespace {

constexpr int kSamples = 8;           // samples per segment; 2 where segments are short
constexpr double kLeastError = 1e-9;  // relative to the longest line

/// The lines that a surface is measured by: its arcs, then two through the middle of every patch.
class Lines {
 public:
  Lines(const Surface& surface, std::span<const Vec3> vectors, Budget::Kind kind)
      : surface_(surface),
        vectors_(vectors),
        kind_(kind),
        arcs_(static_cast<Index>(surface.wireframe().arcs.size())),
        coarsest_{std::vector<Index>(arcs_, 1),
                  std::vector(surface.patchCount(), std::array{1, 1})},
        measured_(arcs_ + 2 * surface.patchCount()),
        inside_(surface, vectors) {
    refineToShape(surface, coarsest_);
  }

  const Density& coarsest() const { return coarsest_; }

  /// Refines a density that is too coarse. Triangles are no longer refined once there are more than
  /// `most` vertices. Lines are allowed half of an error: if they took all of it, the triangles
  /// beside them would have to be far smaller.
  Density cut(Density density, double value, std::int64_t most) {
    const bool byLength = kind_ == Budget::Kind::edgeLength;
    const double ofLines = byLength ? value : value / 2;
    for (Index a = 0; a < arcs_; ++a) refine(density.arcs[a], a, ofLines);
    for (Index p = 0; p < surface_.patchCount(); ++p)
      for (int d = 0; d < 2; ++d) refine(density.patches[p][d], arcs_ + 2 * p + d, ofLines);
    refineToShape(surface_, density);
    if (!byLength) inside_.refine(density, value, most);
    return density;
  }

  /// About the length of the longest line.
  double longest() const {
    double longest = 0;
    for (Index l = 0; l < std::ssize(measured_); ++l)
      longest = std::max(longest, kSamples * measure(Budget::Kind::edgeLength, l, kSamples));
    return longest;
  }

  /// A lower bound of count(cut(edgeLength)), without cutting: a line has at least as many segments
  /// as fit into its length, approximated by eight chords.
  double countWith(double edgeLength) const {
    const auto insideOf = [&](Index line) {
      const double edges = edgesOf(line);
      double length = 0;
      for (int k = 0; k < kSamples; ++k)
        length += norm(at(line, (k + 1) * edges / kSamples) - at(line, k * edges / kSamples));
      return std::max(0.0, std::min(length / edgeLength, double(mostSegments(edgesOf(line)))) - 1);
    };
    double count = 0;
    for (Index a = 0; a < arcs_; ++a) count += insideOf(a);
    for (Index p = 0; p < surface_.patchCount(); ++p)
      count += insideOf(arcs_ + 2 * p) * insideOf(arcs_ + 2 * p + 1);
    return count;
  }

  /// Vertices of a tessellation with this density.
  std::int64_t count(const Density& density) const {
    return vertexCountOf(surface_.wireframe(), density);
  }

 private:
  /// 0 if an arc is a single point.
  Index edgesOf(Index line) const {
    if (line >= arcs_) {
      const Index patch = (line - arcs_) / 2;
      return (line - arcs_) % 2 == 0 ? surface_.edgesU(patch) : surface_.edgesV(patch);
    }
    const Arc& arc = surface_.wireframe().arcs[line];
    return arc.collapsed ? 0 : arc.edges;
  }

  Vec3 at(Index line, double x) const {
    if (line < arcs_) return surface_.pointOnArc(vectors_, line, x);
    const Index patch = (line - arcs_) / 2;
    const double m = surface_.edgesU(patch), n = surface_.edgesV(patch);
    return surface_.evaluate(
        vectors_, (line - arcs_) % 2 == 0 ? Site{patch, x, n / 2} : Site{patch, m / 2, x});
  }

  /// The length of the longest of this many segments, or the largest distance of the line from
  /// them.
  double measure(Budget::Kind kind, Index line, Index segments) const {
    const double edges = edgesOf(line);
    const int samples = segments > 4 * edges ? 2 : kSamples;
    const auto point = [&](Index segment, int sample) {
      return at(line, (segment + double(sample) / samples) * edges / segments);
    };
    double most = 0;
    Vec3 from = point(0, 0);
    for (Index s = 0; s < segments; ++s) {
      const Vec3 to = point(s, samples);
      if (kind == Budget::Kind::edgeLength) most = std::max(most, norm(to - from));
      for (int k = 1; k < samples && kind != Budget::Kind::edgeLength; ++k)
        most = std::max(most, distanceToSegment(point(s, k), from, to));
      from = to;
    }
    return most;
  }

  bool fits(Index line, Index segments, double value) {
    std::vector<Measured>& known = measured_[line];
    auto found = std::ranges::lower_bound(known, segments, {}, &Measured::segments);
    if (found == known.end() || found->segments != segments)
      found = known.insert(found, {segments, measure(kind_, line, segments)});
    return found->most <= value;
  }

  /// Doubles, then bisects the last doubling: more segments are hardly ever worse.
  void refine(Index& segments, Index line, double value) {
    const Index most = mostSegments(edgesOf(line));
    Index few = segments - 1;
    while (segments < most && !fits(line, segments, value))
      few = std::exchange(segments, std::min(2 * segments, most));
    if (!fits(line, segments, value)) return;
    while (segments - few > 1) {
      const Index middle = (few + segments) / 2;
      (fits(line, middle, value) ? segments : few) = middle;
    }
  }

  /// The result of measure() for a number of segments.
  struct Measured {
    Index segments;
    double most;
  };

  const Surface& surface_;
  std::span<const Vec3> vectors_;
  Budget::Kind kind_;
  Index arcs_;
  Density coarsest_;
  std::vector<std::vector<Measured>> measured_;  // [lines]
  SagMeter inside_;
};

/// The density for the smallest error, to a hundredth of it, that this many vertices allow; the
/// coarsest one if they are too few even for that. Approaches the error from above, as finer
/// densities take longer to measure.
Density finest(Lines& lines, double vertices) {
  double error = lines.longest();  // no sag is longer than its line
  const double least = kLeastError * error;
  Density best = lines.coarsest();
  for (double step = 4; step > 1.01 && error > least;) {
    Density density = lines.cut(best, error / step, static_cast<std::int64_t>(vertices));
    if (static_cast<double>(lines.count(density)) <= vertices)
      best = std::move(density), error /= step;
    else
      step = std::sqrt(step);
  }
  return best;
}

/// A tessellation may need a few more vertices than Lines::count() gives, to keep edges apart.
Result<Density> within(const Surface& surface, Lines& lines, double vertices) {
  const auto areTooMany = [&](std::int64_t fewest) {
    return static_cast<double>(fewest) > vertices;
  };
  const Density coarsest = lines.coarsest();
  std::int64_t fewest = lines.count(coarsest);
  if (!areTooMany(fewest)) fewest = Tessellation(surface, coarsest).vertexCount();
  if (areTooMany(fewest))
    return fail("The face has ", fewest, " vertices at least; allow so many.");
  for (double allowed = vertices;;) {
    Density found = finest(lines, allowed);
    const double excess = Tessellation(surface, found).vertexCount() - vertices;
    if (!(excess > 0)) return found;
    allowed -= excess;
  }
}

}  // namespace

double errorOnScreen(double pixels, double distance, double fieldOfView, double height) {
  const auto [sine, cosine] = ode::sineCosine(fieldOfView / 2);
  return pixels * 2 * distance * sine / cosine / height;
}

Result<Density> densityFor(const Surface& surface, std::span<const Vec3> vectors,
                           const Budget& budget) {
  if (!(budget.value > 0) || !std::isfinite(budget.value))
    return fail("The budget of a level of detail must be a number greater than 0.");
  Lines lines(surface, vectors, budget.kind);
  if (budget.kind == Budget::Kind::vertices) {
    if (budget.value > kMostVertices)
      return fail("A mesh has at most ", kMostVertices, " vertices; ask for no more.");
    return within(surface, lines, budget.value);
  }
  const auto tooFine = [](double count) {
    return fail("So fine a mesh has more than ",
                static_cast<std::int64_t>(std::min(count - 1, 1e18)),
                " vertices; ask for a coarser one.");
  };
  const bool byError = budget.kind == Budget::Kind::error;
  if (!byError)
    if (const double count = lines.countWith(budget.value); count > kMostVertices)
      return tooFine(count);
  const double least = byError ? kLeastError * lines.longest() : 0;
  Density density = lines.cut(lines.coarsest(), std::max(budget.value, least), kMostVertices);
  const auto count = static_cast<double>(lines.count(density));
  if (count > kMostVertices) return tooFine(count);
  return density;
}

}  // namespace sweepface
