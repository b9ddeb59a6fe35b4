#include <algorithm>
#include <array>

#include "codec/faces.hpp"
#include "codec/limits.hpp"
#include "codec/source_coder.hpp"
#include "codec/walk.hpp"
#include "rig/source_quads.hpp"
#include "surface/groups.hpp"

namespace sweepface::codec {

namespace {

enum FaceTag : std::uint32_t {
  kPlain = 11,
  kRotation = 12,
  kWhich = 13,
  kSize = 15,
  kOddCorner = 17,
  kQuadCorner = 19,
  kSameName = 21,
  kName = 22,
  kText = 26,
  kUsesCorner = 36,
  kOwnOrder = 37
};

template <typename Coder>
class FaceCoder {
 public:
  FaceCoder(Symbols<Coder>& symbols, const LevelOne& grid, SourceMesh& source, std::size_t most)
      : s_(symbols),
        grid_(grid),
        source_(source),
        faces_(source.polygons),
        places_(source.gridVertex, static_cast<std::size_t>(grid.vertexCount())),
        most_(most),
        walk_(symbols, grid.quadNeighbours(), grid.mirror().quad),
        firstCorner_(grid.quads().size(), -1) {}

  void run() {
    if constexpr (kWrites<Coder>) {
      if (source_.quadCorners.size() != 4 * grid_.quads().size()) source_.quadCorners.clear();
      findPlain();
    }
    const std::size_t count = codeCount(s_, 1, static_cast<std::size_t>(faces_.faceCount()), most_);
    if constexpr (!kWrites<Coder>) source_.quadCorners.assign(4 * grid_.quads().size(), -1);
    source_.ownOrder = s_.bit(kOwnOrder, 0, 0, source_.ownOrder);
    const bool hasQuads = s_.bit(kUsesCorner, 0, 0, !source_.quadCorners.empty());
    if (!hasQuads) source_.quadCorners.clear();
    for (std::size_t f = 0; f < count && s_.ok(); ++f) codeFace(static_cast<Index>(f));
    if (hasQuads && s_.ok()) codeOtherQuads();
    codeNames(faces_.materials, faces_.faceMaterial, count, 0);
    codeNames(faces_.groups, faces_.faceGroup, count, 1);
    codeTexts(faces_.materialFiles);
  }

 private:
  static constexpr Index kNone = -1;

  // The corners of a grid quad without those that coincide with the previous one: a quad with a
  // collapsed side is a triangle.
  struct Ring {
    std::array<std::uint32_t, 4> at{};
    std::uint32_t size = 0;
  };
  Ring ringOf(Index quad) const {
    const std::array<Index, 4>& corners = grid_.quads()[quad];
    Ring ring;
    for (std::uint32_t k = 0; k < 4; ++k)
      if (corners[k] != corners[(k + 3) % 4]) ring.at[ring.size++] = k;
    return ring;
  }

  // Finds the plain faces: those that go around one grid quad that in turn goes around them.
  void findPlain() {
    plainQuad_.assign(faces_.faceCount(), kNone);
    if (source_.quadCorners.empty()) return;
    const std::vector<Index> faceOf = facesOfCorners(faces_);
    const auto corners = static_cast<Index>(faceOf.size());
    for (std::size_t q = 0; q < grid_.quads().size(); ++q) {
      const Index* told = &source_.quadCorners[4 * q];
      if (told[0] < 0 || told[0] >= corners) continue;
      const Index f = faceOf[told[0]];
      if (plainQuad_[f] == kNone && isAround(f, static_cast<Index>(q), told))
        plainQuad_[f] = static_cast<Index>(q);
    }
  }
  bool isAround(Index f, Index quad, const Index* told) const {
    const Ring ring = ringOf(quad);
    const Index start = faces_.faceStart[f], size = faces_.faceSize(f);
    if (size < 3 || size != static_cast<Index>(ring.size)) return false;
    const Index turn = told[ring.at[0]] - start;
    if (turn < 0 || turn >= size) return false;
    for (std::uint32_t i = 0; i < ring.size; ++i) {
      const std::uint32_t at = ring.at[i], next = ring.at[(i + 1) % ring.size];
      if (told[at] != start + (turn + static_cast<Index>(i)) % size ||
          whichAt(grid_.quads()[quad][at], faces_.corners[told[at]]) < 0)
        return false;
      if (next != (at + 1) % 4 && told[(at + 1) % 4] != told[at]) return false;
    }
    return true;
  }
  Index whichAt(Index gridVertex, Index vertex) const {
    const auto here = places_.of(gridVertex);
    const auto found = std::ranges::find(here, vertex);
    return found == here.end() ? -1 : static_cast<Index>(found - here.begin());
  }

  void codeFace(Index f) {
    const Index first = faces_.faceStart[f];
    if (!s_.bit(kPlain, wasPlain_, 0, kWrites<Coder> && plainQuad_[f] != kNone)) {
      wasPlain_ = false;
      codeOddFace(f, first);
      return;
    }
    wasPlain_ = true;
    const Index q = walk_.next(kWrites<Coder> ? plainQuad_[f] : 0);
    if (source_.quadCorners.empty()) s_.refuse("a face goes around a quad of none");
    if (!s_.ok()) return;
    const Ring ring = ringOf(q);
    if (ring.size < 3) return s_.refuse("a face goes around a line");
    // The face's first corner is the ring's corner `turn`.
    std::uint32_t turn = 0, &last = turn_[ring.size - 3];
    if constexpr (kWrites<Coder>)
      while (source_.quadCorners[4 * q + ring.at[turn]] != first) ++turn;
    const std::uint32_t context = last + 8 * (4 - ring.size) + 16 * mirroredCorner(q);
    const std::uint32_t half = s_.bit(kRotation, context, 0, turn >> 1);
    turn = 2 * half + s_.bit(kRotation, 4 + context, half, turn & 1);
    if (turn >= ring.size) return s_.refuse("a triangle has no fourth corner");
    last = turn;
    firstCorner_[q] = static_cast<Index>(ring.at[turn]);
    for (std::uint32_t k = 0; k < ring.size; ++k) {
      const std::uint32_t at = ring.at[(turn + k) % ring.size];
      const Index place = grid_.quads()[q][at];
      const auto here = places_.of(place);
      if (here.empty()) return s_.refuse("a face has a corner where the source has no vertex");
      std::size_t which = 0;
      if (here.size() > 1)
        which =
            s_.number(kWhich, 0, 0, kWrites<Coder> ? whichAt(place, faces_.corners[first + k]) : 0);
      if (which >= here.size()) return s_.refuse("a vertex is out of range");
      if constexpr (!kWrites<Coder>) {
        const auto corner = static_cast<Index>(faces_.corners.size());
        source_.quadCorners[4 * q + at] = corner;
        if (ring.size == 3 && ring.at[(turn + k + 1) % 3] != (at + 1) % 4)
          source_.quadCorners[4 * q + (at + 1) % 4] = corner;
        faces_.corners.push_back(here[which]);
      }
      last_ = here[which];
    }
    if constexpr (!kWrites<Coder>)
      faces_.faceStart.push_back(static_cast<Index>(faces_.corners.size()));
  }

  // The corner that mirrors the first corner of the face around the image of a quad, from 1 on; 0
  // if it is not known.
  std::uint32_t mirroredCorner(Index quad) const {
    const GridMirror& mirror = grid_.mirror();
    const Index image = mirror.quad[quad];
    if (image < 0 || firstCorner_[image] < 0) return 0;
    return 1 + static_cast<std::uint32_t>((mirror.turn[quad] - firstCorner_[image]) & 3);
  }

  void codeOddFace(Index f, Index first) {
    const std::uint32_t beyond =
        s_.number(kSize, 0, 0, kWrites<Coder> ? faces_.faceSize(f) - 3 : 0);
    if (total_ + 3 > most_ || beyond > most_ - total_ - 3)
      return s_.refuse("the faces have too many corners");
    const std::uint32_t size = 3 + beyond;
    total_ += size;
    for (std::uint32_t k = 0; k < size && s_.ok(); ++k) {
      const std::int64_t vertex =
          std::int64_t{last_} +
          s_.signedNumber(kOddCorner, std::min(k, 4u), 0,
                          kWrites<Coder> ? std::int64_t{faces_.corners[first + k]} - last_ : 0);
      if (vertex < 0 || vertex >= static_cast<Index>(source_.gridVertex.size()))
        return s_.refuse("a vertex is out of range");
      last_ = static_cast<Index>(vertex);
      if constexpr (!kWrites<Coder>) faces_.corners.push_back(last_);
    }
    if constexpr (!kWrites<Coder>)
      faces_.faceStart.push_back(static_cast<Index>(faces_.corners.size()));
  }

  // Codes the quads that no plain face goes around.
  void codeOtherQuads() {
    std::int64_t last = 0;
    const auto corners = static_cast<std::int64_t>(faces_.corners.size());
    for (std::size_t q = 0; q < grid_.quads().size(); ++q) {
      if (walk_.visited(static_cast<Index>(q))) continue;
      for (int k = 0; k < 4; ++k) {
        const std::int64_t told = kWrites<Coder> ? source_.quadCorners[4 * q + k] : 0;
        last += s_.signedNumber(kQuadCorner, k, 0, told - last);
        if (last < 0 || last >= corners) return s_.refuse("a corner is out of range");
        if constexpr (!kWrites<Coder>) source_.quadCorners[4 * q + k] = static_cast<Index>(last);
      }
    }
  }

  void codeNames(std::vector<std::string>& names, std::vector<Index>& chosen, std::size_t faces,
                 std::uint32_t what) {
    codeTexts(names);
    if (!s_.bit(kSameName, 8 + what, 0, !chosen.empty())) return;
    chosen.resize(faces);
    Index last = -1;
    for (Index& name : chosen) {
      if (!s_.ok()) return;
      if (!s_.bit(kSameName, what, 0, name == last)) {
        const std::int64_t there =
            last + s_.signedNumber(kName, what, 0, std::int64_t{name} - last);
        if (there < -1 || there >= static_cast<std::int64_t>(names.size()))
          return s_.refuse("the name of a face is out of range");
        last = static_cast<Index>(there);
      }
      name = last;
    }
  }

  void codeTexts(std::vector<std::string>& texts) {
    texts.resize(codeCount(s_, 2, texts.size(), most_ / kLettersAName));
    for (std::string& text : texts) {
      const std::size_t size = codeCount(s_, 3, text.size(), most_);
      if (!s_.ok()) return;
      if constexpr (!kWrites<Coder>) text = std::string(size, '\0');
      std::uint32_t before = 0;
      for (char& c : text) {
        std::uint32_t known = 1;
        for (int b = 8; b-- > 0;)
          known = known << 1 | s_.bit(kText, known * 256 + (before & 255), before >> 8 & 0xffff,
                                      static_cast<unsigned char>(c) >> b & 1);
        c = static_cast<char>(known & 255);
        before = before << 8 | (known & 255);
      }
      most_ -= std::min(most_, size);
    }
  }

  Symbols<Coder>& s_;
  const LevelOne& grid_;
  SourceMesh& source_;
  Polygons& faces_;
  Groups places_;  // the source's vertices at each vertex of the grid
  std::size_t most_, total_ = 0;
  Walk<Coder> walk_;
  std::vector<Index> plainQuad_;    // [faces] writer only
  std::vector<Index> firstCorner_;  // [quads] of the face around it, once coded
  bool wasPlain_ = true;
  std::array<std::uint32_t, 2> turn_{};  // of the last triangle and quad
  Index last_ = 0;
};

}  // namespace

void writeFaces(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source) {
  SourceMesh copy = source;
  FaceCoder<RangeEncoder>(out, grid, copy, SIZE_MAX).run();
}
void readFaces(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source) {
  FaceCoder<RangeDecoder>(in, grid, source, most).run();
}

}  // namespace sweepface::codec
