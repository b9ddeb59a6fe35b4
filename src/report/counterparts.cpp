#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

#include "sweepface/box.hpp"

#include "report/peers.hpp"

namespace sweepface {
namespace {

using Shapes = std::vector<const std::vector<Vec3>*>;

/// The neutral and the targets of `rig`, in the order of `source`.
Result<Shapes> shapesLike(const MeshRig& source, const MeshRig& rig) {
  Shapes shapes{&rig.neutral.positions};
  for (const MeshTarget& target : source.targets) {
    const auto same = std::ranges::find(rig.targets, target.name, &MeshTarget::name);
    if (same == rig.targets.end())
      return fail(fmt::format("the target '{}' is missing.", target.name));
    shapes.push_back(&same->positions);
  }
  return shapes;
}

/// The largest distance between two vertices over all shapes, or the first that is not below
/// `enough`.
double worstDistance(const Shapes& a, Index v, const Shapes& b, Index w, double enough) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size() && worst < enough; ++k)
    worst = std::max(worst, norm((*a[k])[v] - (*b[k])[w]));
  return worst;
}

}  // namespace

Result<std::vector<Index>> counterparts(const MeshRig& source, const MeshRig& found,
                                        double radius) {
  const auto from = shapesLike(source, source), to = shapesLike(source, found);
  if (!to) return std::unexpected(to.error());
  const std::vector<Vec3>& places = found.neutral.positions;
  const Vec3 size = Box(places).size();
  const auto along = [&](const Vec3& p) {
    return size.x >= size.y && size.x >= size.z ? p.x : size.y >= size.z ? p.y : p.z;
  };
  const auto place = [&](Index w) { return along(places[w]); };
  std::vector<Index> sorted(places.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::sort(sorted, {}, place);

  std::vector<Index> result(source.neutral.positions.size(), -1);
  for (const Index v : source.neutral.polygons.corners) {
    if (result[v] >= 0) continue;
    const Vec3& p = source.neutral.positions[v];
    double best = std::numeric_limits<double>::infinity();
    for (auto w = std::ranges::lower_bound(sorted, along(p) - radius, {}, place);
         w != sorted.end() && place(*w) <= along(p) + radius; ++w) {
      if (norm(places[*w] - p) > radius) continue;
      const double worst = worstDistance(*from, v, *to, *w, best);
      if (worst < best) best = worst, result[v] = *w;
    }
    if (result[v] < 0) return fail(fmt::format("vertex {} is missing.", v));
  }
  return result;
}

}  // namespace sweepface
