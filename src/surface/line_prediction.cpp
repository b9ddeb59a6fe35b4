#include "surface/line_prediction.hpp"

namespace sweepface {

ParabolaFactors::ParabolaFactors(double a, double b, int order) : exists(a > 0 && b > 0) {
  if (exists) {
    const double s = (order == 1 ? 1 : 2) / (a * b * (a + b));
    beside = {order == 1 ? b * b * s : b * s, order == 1 ? -a * a * s : a * s};
    own = order == 1 ? (a * a - b * b) * s : -(a + b) * s;
    return;
  }
  exists = order == 1 && a + b > 0;
  if (!exists) return;
  const double s = (a > 0 ? 1 : -1) / (a + b);
  beside = {s, s};
  own = -s;
}

}  // namespace sweepface
