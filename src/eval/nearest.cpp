#include "sweepface/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sweepface/box.hpp"

namespace sweepface {
namespace {

constexpr Index kPerEdge = 2;  // samples
constexpr double kMostCoordinate = 1e100;

double squared(const Vec3& a) { return dot(a, a); }

struct Found {
  Site site;
  double distance = std::numeric_limits<double>::infinity();  // squared
};

/// Descends from a site to where a patch is nearest to a point, without leaving the patch: by
/// Newton's method on the squared distance, or along its slope where that does not lead down.
class Descent {
 public:
  Descent(const Surface& surface, std::span<const Vec3> vectors, const Vec3& point,
          const Site& start)
      : surface_(surface),
        vectors_(vectors),
        point_(point),
        lengths_{static_cast<double>(surface.edgesU(start.patch)),
                 static_cast<double>(surface.edgesV(start.patch))},
        reach_(hasPole(surface.wireframe(), start.patch) ? 0.9 : 1),
        here_{start, squared(at(start, 0, 0) - point)} {}

  Found run() {
    constexpr int kMostSteps = 50;
    for (int k = 0; k < kMostSteps && step(); ++k) {
    }
    return here_;
  }

 private:
  struct Step {
    double u = 0, v = 0;
  };

  Vec3 at(const Site& site, int du, int dv) const {
    return surface_.evaluate(vectors_, site, du, dv);
  }

  /// Returns whether it got nearer.
  bool step() {
    const Site& site = here_.site;
    const Vec3 off = at(site, 0, 0) - point_, u = at(site, 1, 0), v = at(site, 0, 1);
    const Step slope{dot(off, u), dot(off, v)};
    const bool freeU = !staysAt(site.u, slope.u, lengths_[0]),
               freeV = !staysAt(site.v, slope.v, lengths_[1]);
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v),
                 bentU = uu + dot(off, at(site, 2, 0)), bentV = vv + dot(off, at(site, 0, 2)),
                 bentUV = uv + dot(off, at(site, 1, 1));
    const auto alone = [](bool isFree, double down, double bent, double flat) {
      return isFree ? -down / (bent > 0 ? bent : flat) : 0;
    };
    const Step apart{alone(freeU, slope.u, bentU, uu), alone(freeV, slope.v, bentV, vv)};
    if (!freeU || !freeV) return go(apart);
    // Newton's step where the distance curves upwards in all directions, else as if the surface
    // were flat.
    if (bentU > 0 && bentU * bentV > bentUV * bentUV)
      return go(solved(bentU, bentUV, bentV, slope)) || go(apart);
    return go(solved(uu, uv, vv, slope)) || go(apart);
  }

  static Step solved(double uu, double uv, double vv, const Step& slope) {
    const double determinant = uu * vv - uv * uv;
    return {(uv * slope.v - vv * slope.u) / determinant,
            (uv * slope.u - uu * slope.v) / determinant};
  }

  /// Whether there is no way down, or it leads out of the patch.
  static bool staysAt(double place, double slope, double length) {
    return slope == 0 || (place <= 0 && slope > 0) || (place >= length && slope < 0);
  }

  static bool hasPole(const Wireframe& w, Index patch) {
    for (int side = 0; side < 4; ++side)
      for (const HalfArc h : w.side(patch, side))
        if (w.arcs[arcOf(h)].collapsed) return true;
    return false;
  }

  /// Steps end before a collapsed side, as they could not turn on it.
  double towards(double place, double from, double length) const {
    return std::clamp(place, from - reach_ * from, from + reach_ * (length - from));
  }

  /// Halves a step until it leads down.
  bool go(const Step& whole) {
    constexpr double kLeastStep = 1e-9;  // edges
    if (!(std::max(std::abs(whole.u), std::abs(whole.v)) > kLeastStep)) return false;
    for (double share = 1; share > 1e-3; share /= 2) {
      Site site = here_.site;
      site.u = towards(site.u + share * whole.u, site.u, lengths_[0]);
      site.v = towards(site.v + share * whole.v, site.v, lengths_[1]);
      const double distance = squared(at(site, 0, 0) - point_);
      if (!(distance < here_.distance)) continue;
      here_ = {site, distance};
      return true;
    }
    return false;
  }

  const Surface& surface_;
  std::span<const Vec3> vectors_;
  const Vec3 point_;
  const double lengths_[2];
  const double reach_;  // the largest share of the way to a side that a step may go
  Found here_;
};

class Search {
 public:
  Search(const Surface& surface, std::span<const Vec3> vectors)
      : surface_(surface), vectors_(vectors) {
    for (Index p = 0; p < surface.patchCount(); ++p) samplePatch(p);
    firstSample_.push_back(samples_.size());
  }

  Site nearest(const Vec3& point) {
    ways_.clear();
    for (Index p = 0; p < surface_.patchCount(); ++p)
      ways_.push_back({distanceTo(boxes_[p], point), p});
    const auto isFurther = [](const Way& a, const Way& b) { return a.distance > b.distance; };
    std::ranges::make_heap(ways_, isFurther);
    Found best{{0, 0, 0}};
    while (!ways_.empty() && ways_.front().distance < best.distance) {
      std::ranges::pop_heap(ways_, isFurther);
      const Index patch = ways_.back().patch;
      ways_.pop_back();
      for (const Site& start : starts(patch, point)) {
        const Found found = Descent(surface_, vectors_, point, start).run();
        if (found.distance < best.distance) best = found;
      }
    }
    return best.site;
  }

 private:
  struct Way {
    double distance;  // squared, to the patch's box
    Index patch;
  };

  /// Samples a patch, and finds a box that it does not leave: between samples it hardly bulges
  /// further than they are apart.
  void samplePatch(Index p) {
    firstSample_.push_back(samples_.size());
    const Index columns = kPerEdge * surface_.edgesU(p), rows = kPerEdge * surface_.edgesV(p);
    for (Index j = 0; j <= rows; ++j)
      for (Index i = 0; i <= columns; ++i)
        samples_.push_back(surface_.evaluate(vectors_, siteOf(p, i, j)));
    const std::span mine(samples_.begin() + static_cast<std::ptrdiff_t>(firstSample_.back()),
                         samples_.end());
    double apart = 0;
    for (Index j = 0; j <= rows; ++j)
      for (Index i = 0; i <= columns; ++i) {
        const Vec3* const here = &mine[static_cast<std::size_t>(j) * (columns + 1) + i];
        if (i > 0) apart = std::max(apart, norm(here[0] - here[-1]));
        if (j > 0) apart = std::max(apart, norm(here[0] - here[-(columns + 1)]));
      }
    Box box(mine);
    const Vec3 margin{apart, apart, apart};
    box.low -= margin, box.high += margin;
    boxes_.push_back(box);
  }

  static Site siteOf(Index patch, Index i, Index j) {
    return {patch, static_cast<double>(i) / kPerEdge, static_cast<double>(j) / kPerEdge};
  }

  static double distanceTo(const Box& box, const Vec3& point) {
    const auto beyond = [](double low, double x, double high) {
      return std::max({low - x, x - high, 0.0});
    };
    return squared({beyond(box.low.x, point.x, box.high.x), beyond(box.low.y, point.y, box.high.y),
                    beyond(box.low.z, point.z, box.high.z)});
  }

  /// The nearest sample, and the nearest inside. At a pole many samples coincide, most of them
  /// facing another way; and where a patch meets itself, only one of two is on the right side.
  std::array<Site, 2> starts(Index patch, const Vec3& point) const {
    const Index columns = kPerEdge * surface_.edgesU(patch),
                rows = kPerEdge * surface_.edgesV(patch);
    const Vec3* sample = &samples_[firstSample_[patch]];
    std::array<Found, 2> nearest{Found{siteOf(patch, 0, 0)}, Found{siteOf(patch, 1, 1)}};
    for (Index j = 0; j <= rows; ++j)
      for (Index i = 0; i <= columns; ++i, ++sample) {
        const bool isInside = i > 0 && i < columns && j > 0 && j < rows;
        const double distance = squared(*sample - point);
        for (Found& best : std::span(nearest).first(isInside ? 2 : 1))
          if (distance < best.distance) best = {siteOf(patch, i, j), distance};
      }
    return {nearest[0].site, nearest[1].site};
  }

  const Surface& surface_;
  std::span<const Vec3> vectors_;
  std::vector<Vec3> samples_;
  std::vector<std::size_t> firstSample_;  // [patches + 1]
  std::vector<Box> boxes_;                // [patches]
  std::vector<Way> ways_;
};

}  // namespace

Result<std::vector<Site>> nearestSites(const Surface& surface, std::span<const Vec3> vectors,
                                       std::span<const Vec3> points) {
  if (surface.patchCount() == 0) return fail("The face has no surface to be near to.");
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(coordinate(points[k], axis)) <= kMostCoordinate))
        return fail("Point ", k, " must have coordinates within 1e100 of 0.");
  Search search(surface, vectors);
  std::vector<Site> sites;
  for (const Vec3& point : points) sites.push_back(search.nearest(point));
  return sites;
}

}  // namespace sweepface
