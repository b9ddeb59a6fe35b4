#include "codec/grid_size.hpp"

namespace sweepface::codec {

namespace {

std::int64_t length(const Wireframe& w, Index patch, int side) {
  std::int64_t sum = 0;
  for (const HalfArc h : w.side(patch, side)) sum += w.arcs[arcOf(h)].edges;
  return sum;
}

}  // namespace

bool isSmallEnough(const Wireframe& w, std::int64_t most) {
  std::int64_t vertices = 0;
  for (const Arc& arc : w.arcs) vertices += arc.edges;
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    const std::int64_t m = length(w, p, 0), n = length(w, p, 1);
    if (vertices > most || m > most || n > most) return false;
    vertices += m * n;
  }
  return vertices <= most;
}

}  // namespace sweepface::codec
