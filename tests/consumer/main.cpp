// The smallest program that uses an installed Sweepface.
#include <cmath>

#include "sweepface/vec.hpp"

int main() {
  const sweepface::Vec3 direction = sweepface::normalized({3, 0, 4});
  return std::abs(sweepface::norm(direction) - 1) < 1e-15 ? 0 : 1;
}
