#include <algorithm>

#include "codec/derivative_rules.hpp"

namespace sweepface::codec {

namespace {

class ImageFinder {
 public:
  ImageFinder(const Surface& surface, const Mirror& mirror)
      : surface_(surface), c_(surface.connectivity()), mirror_(mirror) {}

  // In the frames of mirrored nodes, the x axes are images of each other, or x is the image of y.
  Hierarchy::Image imageOf(const CodedSite& site, const CodedSite& other, int i, int j) const {
    if (i == 0 && j == 0) return {other.first, 1};
    const auto& arms = c_.stars[site.node].arms;
    const HalfArc x = mirror_.halfArc[arms[0]];
    const Index node = mirror_.node[site.node];
    if (x < 0) return {};
    const auto& there = c_.stars[node].arms;
    const auto arm = std::ranges::find(there, x) - there.begin();
    if (arm == static_cast<std::ptrdiff_t>(there.size())) return {};
    if (c_.kinds[site.node] == NodeKind::irregular) {
      // The chart is aligned with the first spoke, so there is an image only if the first spokes
      // mirror each other.
      if (arm != 0 || !c_.stars[site.node].closed) return {};
      const Index k = vectorAt(other, i, j);
      return {k, j % 2 ? -1 : 1};
    }
    // x maps to the direction of arm `arm` there, y to the one a quarter turn clockwise from it.
    const auto axis = [&](std::ptrdiff_t a) {
      a = (a % 4 + 4) % 4;
      return std::pair<int, int>(static_cast<int>(a % 2), a < 2 ? 1 : -1);
    };
    const auto [xAxis, xSign] = axis(arm);
    const int ySign = axis(arm + 3).second;
    const int sign = (i % 2 ? xSign : 1) * (j % 2 ? ySign : 1);
    const Index v = vectorAt(other, xAxis == 0 ? i : j, xAxis == 0 ? j : i);
    return {v, sign};
  }

 private:
  Index vectorAt(const CodedSite& site, int i, int j) const {
    for (Index v = site.first; v < site.first + site.count; ++v)
      if (surface_.stored(v).i == i && surface_.stored(v).j == j) return v;
    return -1;
  }

  const Surface& surface_;
  const Connectivity& c_;
  const Mirror& mirror_;
};

}  // namespace

std::vector<Hierarchy::Image> imagesOf(const Surface& surface, const Mirror& mirror,
                                       const std::vector<CodedSite>& sites) {
  const ImageFinder finder(surface, mirror);
  std::vector<Hierarchy::Image> images(surface.storedCount());
  for (const CodedSite& site : sites) {
    if (site.mirror < 0) continue;
    for (Index v = site.first; v < site.first + site.count; ++v) {
      const StoredVector& s = surface.stored(v);
      images[v] = finder.imageOf(site, sites[site.mirror], s.i, s.j);
    }
  }
  return images;
}

}  // namespace sweepface::codec
