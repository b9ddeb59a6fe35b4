#include "fit/slopes.hpp"

#include <algorithm>

namespace sweepface {

Slopes slopesOf(const Surface& surface, const Tessellation& level1, std::span<const char> known,
                const SlopeVectors& vectors, double shortest, float weight) {
  const auto floats = [](const Vec3& v) {
    return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  Slopes slopes;
  slopes.at.resize(level1.vertexCount());
  slopes.weight = weight;
  for (Index v = 0; v < level1.vertexCount(); ++v) {
    const Site site = level1.site(v);
    const std::array<Vec3, 2> tangent{surface.evaluate(vectors.form, site, 1, 0),
                                      surface.evaluate(vectors.form, site, 0, 1)};
    const Vec3 across = cross(tangent[0], tangent[1]);
    const double area = norm(across), product = norm(tangent[0]) * norm(tangent[1]);
    if (!known[v] || !(area > 0.02 * product)) continue;
    const Vec3 normal = across * (1 / area);
    for (int d = 0; d < 2; ++d) {
      const double perLength = 1 / std::max(norm(tangent[d]), shortest);
      const auto share = [&](std::span<const Vec3> off) {
        return perLength * surface.evaluate(off, site, d == 0, d == 1);
      };
      slopes.at[v][d] = {floats(share(vectors.whole)),
                         static_cast<float>(dot(normal, share(vectors.off))), floats(normal),
                         static_cast<float>(perLength)};
    }
  }
  return slopes;
}

}  // namespace sweepface
