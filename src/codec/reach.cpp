#include "codec/reach.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface::codec {

namespace {

// How strongly derivatives of order 0, 1 and 2 move a curve of `length`: the largest values of the
// quintic Hermite polynomials.
double reachOnCurve(int order, double length) {
  return order == 0 ? 1 : order == 1 ? 0.16 * length : 0.0173 * length * length;
}

}  // namespace

std::vector<double> reachOf(const Surface& surface) {
  std::vector<double> reach(surface.vectorCount(), 0);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int corner = 0; corner < 4; ++corner) {
      const double alpha = corner % 2 ? surface.edgesV(p) : surface.edgesU(p),
                   beta = corner % 2 ? surface.edgesU(p) : surface.edgesV(p);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double& r = reach[surface.cornerJet(p, corner, i, j).vector];
          r = std::max(r, reachOnCurve(i, alpha) * reachOnCurve(j, beta));
        }
    }
  for (Index v = surface.vectorCount(); v-- > surface.storedCount();)
    for (const Term& t : surface.derivation(v))
      reach[t.vector] = std::max(reach[t.vector], std::abs(t.factor) * reach[v]);
  return reach;
}

double roundedReach(double reach) {
  if (!(reach > 1e-6)) return 1e-6;
  int exponent = 0;
  const double mantissa = std::frexp(std::min(reach, 1e12), &exponent);
  const double step = mantissa < 0.5843 ? 0.5 : mantissa < 0.8217 ? 0.703125 : 1;
  return std::ldexp(step, exponent);
}

}  // namespace sweepface::codec
