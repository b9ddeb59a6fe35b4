#pragma once

#include <array>

namespace sweepface {

/// The neighbour of a node on a line through it, with what is known there.
template <typename Value>
struct LineNeighbour {
  double distance = 0;  ///< 0: none
  Value value;

  bool has() const { return distance > 0; }
};

/// Those ahead and behind.
template <typename Value>
using LineNeighbours = std::array<LineNeighbour<Value>, 2>;

/// Derivative 1 or 2 along a line at a node, of the parabola through the values there and at its
/// neighbours; at the end of a line, which is taken as straight, there is only the first.
struct ParabolaFactors {
  ParabolaFactors(double ahead, double behind, int order);

  bool exists;
  std::array<double, 2> beside{};  ///< of the values at the neighbours
  double own = 0;                  ///< of the value at the node
};

/// Calls `add(value, factor)` with each neighbour's value, and `own(factor)`.
template <typename Value, typename Add, typename Own>
void derivativeFromValues(const LineNeighbours<Value>& at, int order, Add add, Own own) {
  const ParabolaFactors factors(at[0].distance, at[1].distance, order);
  if (!factors.exists) return;
  for (int e = 0; e < 2; ++e)
    if (at[e].has()) add(at[e].value, factors.beside[e]);
  own(factors.own);
}

/// The second derivative of the cubic through the neighbours that has the node's value and slope;
/// at the end of a line, of the parabola through its one neighbour.
template <typename Value, typename Add, typename Own, typename Slope>
void derivativeFromSlope(const LineNeighbours<Value>& at, Add add, Own own, Slope slope) {
  for (int e = 0; e < 2; ++e) {
    if (!at[e].has()) continue;
    const double h = at[e].distance, outward = e == 0 ? 1 : -1;
    const double weight = at[1 - e].has() ? at[1 - e].distance / (h + at[1 - e].distance) : 1;
    const double s = 2 * weight / (h * h);
    add(at[e].value, s);
    own(-s);
    slope(-outward * h * s);
  }
}

}  // namespace sweepface
