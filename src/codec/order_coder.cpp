#include "codec/source_coder.hpp"
#include "codec/walk.hpp"

namespace sweepface::codec {

namespace {

enum OrderTag : std::uint32_t { kStays = 2, kLoose = 8, kLooseIndex = 9 };

template <typename Coder>
void codeOrder(Symbols<Coder>& s, const LevelOne& grid, std::vector<Index>& order, Index loose,
               std::size_t most) {
  order.resize(codeCount(s, 0, order.size(), most));
  Walk<Coder> walk(s, grid.vertexNeighbours(), grid.mirror().vertex);
  Index nextLoose = 0, before = 0;
  for (Index& v : order) {
    if (s.bit(kLoose, 0, 0, v < 0)) {
      const std::int64_t k = nextLoose + std::int64_t{s.signedNumber(
                                             kLooseIndex, 0, 0, -1 - std::int64_t{v} - nextLoose)};
      if (k < 0 || k >= loose) return s.refuse("a loose vertex is out of range");
      nextLoose = static_cast<Index>(k) + 1;
      v = -nextLoose;
    } else if (s.bit(kStays, 0, 0, kWrites<Coder> && v >= 0 && walk.visited(v))) {
      // A grid vertex that was visited before: at seams, several source vertices share one.
      const std::int64_t there =
          before + std::int64_t{s.signedNumber(kFar, 1, 0, std::int64_t{v} - before)};
      if (there < 0 || there >= grid.vertexCount()) return s.refuse("a vertex is out of range");
      v = before = static_cast<Index>(there);
    } else {
      v = walk.next(v);
      before = v;
    }
    if (!s.ok()) return;
  }
}

}  // namespace

void writeOrder(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source) {
  std::vector<Index> order = source.gridVertex;
  codeOrder(out, grid, order, static_cast<Index>(source.loose.size()), SIZE_MAX);
}
void readOrder(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source) {
  codeOrder(in, grid, source.gridVertex, static_cast<Index>(source.loose.size()), most);
}

}  // namespace sweepface::codec
