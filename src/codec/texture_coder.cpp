#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>

#include "codec/edge_map.hpp"
#include "codec/faces.hpp"
#include "codec/limits.hpp"
#include "codec/source_coder.hpp"
#include "codec/walk.hpp"

namespace sweepface::codec {

namespace {

enum TextureTag : std::uint32_t {
  kHasTexture = 27,
  kFreshTexture = 28,
  kKnown = 29,
  kTexture = 30,
  kBits = 32,
  kResidual = 34
};

// Larger than any repeating texture needs, and far below integer overflow.
constexpr std::int32_t kMostTexture = 1 << 26;
// Larger errors of a guess count as this much.
constexpr std::int64_t kMostOff = 1 << 20;

template <typename Coder>
class TextureCoder {
 public:
  TextureCoder(Symbols<Coder>& symbols, Polygons& polygons, std::span<const Index> images,
               std::size_t most, int bits)
      : s_(symbols), p_(polygons), images_(images), most_(most), bits_(bits) {}

  int run() {
    bits_ = static_cast<int>(s_.number(kBits, 0, 0, static_cast<std::uint64_t>(bits_)));
    if (bits_ < 1 || bits_ > kMostTextureBits) s_.refuse("texture coordinates have too many bits");
    if (!s_.ok()) return bits_;
    const std::size_t count = codeCount(s_, 4, p_.texcoords.size(), most_);
    if constexpr (kWrites<Coder>) {
      for (const Vec2& t : p_.texcoords) whole_.push_back({wholeOf(t.x), wholeOf(t.y)});
    } else {
      whole_.resize(count);
    }
    known_.assign(count, 0);
    off_.assign(count, 0);
    const bool used = s_.bit(kHasTexture, 0, 0, !p_.cornerTexcoords.empty());
    if (used) codeIndices();
    if (used && s_.ok()) codeByFaces();
    for (std::size_t t = 0; t < count && s_.ok(); ++t)
      if (!known_[t]) codeValue(static_cast<Index>(t), {last_, 3, 0});
    if constexpr (!kWrites<Coder>) {
      const double step = std::ldexp(1.0, -bits_);
      for (const auto& [x, y] : whole_) p_.texcoords.push_back({x * step, y * step});
    }
    return bits_;
  }

 private:
  using Whole = std::array<std::int32_t, 2>;

  std::int32_t wholeOf(double x) const {
    return static_cast<std::int32_t>(std::llround(std::ldexp(x, bits_)));
  }

  void codeIndices() {
    p_.cornerTexcoords.resize(p_.corners.size(), -1);
    asBefore_.assign(p_.corners.size(), 0);
    for (std::size_t c = 0; c < p_.corners.size() && s_.ok(); ++c)
      p_.cornerTexcoords[c] = codeIndex(c, p_.cornerTexcoords[c]);
  }

  // The texture coordinate of a corner: the one its vertex had last, the next new one, or any.
  Index codeIndex(std::size_t corner, Index t) {
    const Index vertex = p_.corners[corner];
    const Index image = images_.empty() ? -1 : images_[corner];
    const std::uint32_t expected = image < 0 ? 0 : asBefore_[image];
    if (vertex >= static_cast<Index>(ofVertex_.size())) ofVertex_.resize(vertex + 1, -2);
    Index& had = ofVertex_[vertex];
    if (had >= -1) {
      const bool same = s_.bit(kKnown, expected, 0, t == had);
      asBefore_[corner] = 1 + same;
      if (same) return had;
    }
    if (s_.bit(kFreshTexture, had >= -1, 0, t == next_)) {
      t = next_;
    } else {
      const std::int64_t there = next_ + s_.signedNumber(kTexture, 0, 0, std::int64_t{t} - next_);
      t = static_cast<Index>(std::clamp<std::int64_t>(there, -2, std::int64_t{1} << 30));
    }
    if (t < -1 || t >= static_cast<Index>(known_.size())) {
      s_.refuse("a texture coordinate is out of range");
      return -1;
    }
    next_ = std::max(next_, t + 1);
    return had = t;
  }

  // Codes values from face to face across the edges that faces share in the texture.
  void codeByFaces() {
    std::vector<EdgeMap::Edge> edges;
    edges.reserve(p_.corners.size());
    sides_.reserve(p_.corners.size());
    for (Index f = 0; f < p_.faceCount(); ++f)
      for (Index k = 0; k < p_.faceSize(f); ++k) {
        edges.push_back({at(f, k), at(f, k + 1)});
        sides_.push_back({f, k});
      }
    map_.emplace(edges, static_cast<Index>(known_.size()));
    std::vector<char> reached(p_.faceCount(), 0);
    std::vector<Entry> queue;
    for (Index seed = 0; seed < p_.faceCount() && s_.ok(); ++seed) {
      if (reached[seed]) continue;
      reached[seed] = 1;
      queue.assign(1, {seed, 0, {}});
      for (std::size_t head = 0; head < queue.size() && s_.ok(); ++head) {
        const Entry entry = queue[head];
        codeFace(entry);
        for (Index k = 0; k < p_.faceSize(entry.face); ++k) {
          const Side* const other = across({entry.face, k});
          if (!other || reached[other->face]) continue;
          reached[other->face] = 1;
          queue.push_back({other->face, other->corner, {entry.face, k}});
        }
      }
    }
  }

  struct Side {
    Index face = -1, corner = 0;  // from this corner to the next
  };
  struct Entry {
    Index face, corner;  // entered across the side that begins here
    Side from;           // the same side in the previous face
  };

  Index cornerOf(Index face, Index k) const {
    const Index size = p_.faceSize(face);
    return p_.faceStart[face] + (k % size + size) % size;
  }
  Index at(Index face, Index k) const { return p_.cornerTexcoords[cornerOf(face, k)]; }
  bool knows(Index t) const { return t >= 0 && known_[t]; }

  // The same side in the face beyond it.
  const Side* across(const Side& side) const {
    const Index other = map_->find(at(side.face, side.corner + 1), at(side.face, side.corner));
    return other < 0 ? nullptr : &sides_[other];
  }
  // The opposite side of the quad beyond a side, beginning beside the side's own first corner.
  // Empty if there is no quad or that side is not fully known.
  std::optional<std::array<Index, 2>> beyond(const Side& side) const {
    const Side* const other = across(side);
    if (!other || p_.faceSize(other->face) != 4) return {};
    const Index first = at(other->face, other->corner + 2),
                second = at(other->face, other->corner + 3);
    if (!knows(first) || !knows(second)) return {};
    return {{first, second}};
  }

  void codeFace(const Entry& entry) {
    const Index f = entry.face, size = p_.faceSize(f);
    for (Index j = 0; j < size && s_.ok(); ++j) {
      const Index k = entry.corner + j, t = at(f, k);
      if (t < 0) continue;
      if (!known_[t]) {
        const Index before = at(f, k - 1);
        if (size == 4 && knows(before) && knows(at(f, k + 1)) && knows(at(f, k + 2)))
          codeCorner(f, k, fourth(f, k));
        else if (const Index back = cornerBefore(entry.from);
                 j == 2 && knows(before) && knows(back))
          codeCorner(f, k, next(entry.from, before, back));
        else
          codeCorner(f, k, {knows(before) ? whole_[before] : last_, 2, 0});
      }
      last_ = whole_[t];
    }
  }
  // The corner before the shared side in the face it was entered from. The line from it through the
  // start of that side leads to the next corner.
  Index cornerBefore(const Side& side) const {
    return side.face < 0 ? -1 : at(side.face, side.corner - 1);
  }

  struct Guess {
    Whole value{};
    std::uint32_t how = 0, active = 0;  // contexts
  };

  // Predicts from the mirror image, in the way that has worked best of late, if that was better
  // than without it.
  void codeCorner(Index f, Index k, const Guess& guess) {
    const Index t = at(f, k), image = imageAt(f, k);
    const std::optional<Pair> beside = knows(image) ? knownBeside(f, k) : std::nullopt;
    if (!beside) return codeValue(t, guess);
    std::array<Whole, kWays + 1> guesses;
    for (std::size_t way = 0; way < kWays; ++way) guesses[way] = mirrored(image, *beside, way);
    guesses[kWays] = guess.value;
    const auto best = static_cast<std::size_t>(std::ranges::min_element(misses_) - misses_.begin());
    if (best == kWays)
      codeValue(t, guess);
    else
      codeValue(t, {guesses[best], 4, static_cast<std::uint32_t>(std::bit_width(misses_[best]))});
    for (std::size_t way = 0; way <= kWays; ++way)  // older misses decay
      misses_[way] += offBy(t, guesses[way]) - (misses_[way] >> 4);
    if (best < kWays) off_[t] = off_[image];
  }
  std::uint32_t offBy(Index t, const Whole& guess) const {
    std::int64_t sum = 0;
    for (int a = 0; a < 2; ++a) sum += std::abs(std::int64_t{whole_[t][a]} - guess[a]);
    return static_cast<std::uint32_t>(std::min(sum, kMostOff));
  }

  // A known value beside a corner of a face, and the one at its mirror image.
  struct Pair {
    Index here, there;
  };
  std::optional<Pair> knownBeside(Index f, Index k) const {
    for (const Index beside : {k - 1, k + 1})
      if (const Pair pair{at(f, beside), imageAt(f, beside)}; knows(pair.here) && knows(pair.there))
        return pair;
    return {};
  }
  // The texture coordinates at the mirror image of a corner, or -1.
  Index imageAt(Index face, Index k) const {
    const Index image = images_.empty() ? -1 : images_[cornerOf(face, k)];
    return image < 0 ? -1 : p_.cornerTexcoords[image];
  }
  // The offset between the images, transformed and added to the known value beside, since islands
  // of a texture may lie anywhere. Way 0 mirrors across the width of the texture, as most faces do;
  // the others are the remaining symmetries of a square.
  Whole mirrored(Index image, const Pair& beside, std::size_t way) const {
    Whole step;
    for (int a = 0; a < 2; ++a) step[a] = whole_[image][a] - whole_[beside.there][a];
    if (way & 4) std::swap(step[0], step[1]);
    return {whole_[beside.here][0] + (way & 1 ? step[0] : -step[0]),
            whole_[beside.here][1] + (way & 2 ? -step[1] : step[1])};
  }

  // The fourth corner of a quad: that of a parallelogram, corrected by how far the quads beyond the
  // known sides deviate from one.
  Guess fourth(Index f, Index k) const {
    const Index after = at(f, k + 1), middle = at(f, k + 2), before = at(f, k + 3);
    Whole guess, bent{};
    std::int32_t quads = 0;
    const auto bend = [&](Index from, Index to, Index farFrom, Index farTo) {
      for (int a = 0; a < 2; ++a)
        bent[a] += whole_[to][a] - whole_[from][a] - (whole_[farTo][a] - whole_[farFrom][a]);
      ++quads;
    };
    if (const auto far = beyond({f, k + 1})) bend(middle, after, (*far)[1], (*far)[0]);
    if (const auto far = beyond({f, k + 2})) bend(middle, before, (*far)[0], (*far)[1]);
    for (int a = 0; a < 2; ++a)
      guess[a] = whole_[before][a] + whole_[after][a] - whole_[middle][a] +
                 (quads == 2 ? (bent[a] + 1) >> 1 : bent[a]);
    return {guess, 0, activity({before, middle, after})};
  }

  // The first corner beyond a side, extrapolated from two or three corners before it.
  Guess next(const Side& from, Index before, Index back) const {
    Whole guess;
    for (int a = 0; a < 2; ++a) guess[a] = 2 * whole_[before][a] - whole_[back][a];
    if (p_.faceSize(from.face) == 4)
      if (const auto far = beyond({from.face, from.corner + 2}))
        for (int a = 0; a < 2; ++a)
          guess[a] += whole_[before][a] - 2 * whole_[back][a] + whole_[(*far)[1]][a];
    return {guess, 1, activity({before, back})};
  }

  // How far off the guesses of some known values were, as a context.
  std::uint32_t activity(std::initializer_list<Index> known) const {
    std::uint32_t sum = 0;
    for (const Index t : known) sum += off_[t];
    return 1 + static_cast<std::uint32_t>(
                   std::bit_width(4 * sum / static_cast<std::uint32_t>(known.size())));
  }

  void codeValue(Index t, const Guess& guess) {
    for (int a = 0; a < 2; ++a) {
      const std::int64_t residual = s_.signedNumber(kResidual, guess.how * 2 + a, guess.active,
                                                    std::int64_t{whole_[t][a]} - guess.value[a]),
                         value = guess.value[a] + residual;
      if (std::abs(value) > kMostTexture) s_.refuse("a texture coordinate is out of range");
      whole_[t][a] = s_.ok() ? static_cast<std::int32_t>(value) : 0;
      off_[t] += static_cast<std::uint32_t>(std::min(std::abs(residual), kMostOff));
    }
    known_[t] = 1;
    last_ = whole_[t];
  }

  Symbols<Coder>& s_;
  Polygons& p_;
  std::span<const Index> images_;  // [corners] or empty
  std::size_t most_;
  int bits_;
  std::vector<Whole> whole_;
  std::vector<char> known_;
  std::vector<std::uint32_t> off_;  // how far off the guess of each was
  std::vector<Side> sides_;         // [corners]
  std::optional<EdgeMap> map_;
  std::vector<Index> ofVertex_;         // by vertex: the texture coordinate it had last, or -2
  std::vector<std::uint8_t> asBefore_;  // [corners] 1 + whether it has what its vertex had, else 0
  Index next_ = 0;
  Whole last_{};
  static constexpr std::size_t kWays = 8;
  std::array<std::uint32_t, kWays + 1> misses_{};  // by way to mirror, then without
};

}  // namespace

std::vector<Index> cornerImages(const GridMirror& mirror, const SourceMesh& source) {
  const auto corners = static_cast<Index>(source.polygons.corners.size());
  const std::vector<Index>& at = source.quadCorners;
  if (at.size() != 4 * mirror.quad.size()) return {};
  const auto exists = [&](Index corner) { return corner >= 0 && corner < corners; };
  std::vector<Index> images(corners, -1);
  for (std::size_t q = 0; q < mirror.quad.size(); ++q)
    for (int k = 0; mirror.quad[q] >= 0 && k < 4; ++k)
      if (const Index image = at[4 * mirror.quad[q] + ((mirror.turn[q] - k) & 3)];
          exists(at[4 * q + k]) && exists(image))
        images[at[4 * q + k]] = image;
  return images;
}

bool holdsTexture(const Polygons& polygons, int bits) {
  const double most = std::ldexp(kMostTexture, -bits);
  return std::ranges::all_of(polygons.texcoords, [&](const Vec2& t) {
    return std::abs(t.x) <= most && std::abs(t.y) <= most;
  });
}

void writeTexture(Symbols<RangeEncoder>& out, const Polygons& polygons,
                  std::span<const Index> images, int bits) {
  Polygons copy = polygons;
  TextureCoder<RangeEncoder>(out, copy, images, SIZE_MAX, bits).run();
}
void readTexture(Symbols<RangeDecoder>& in, std::size_t most, Polygons& polygons,
                 std::span<const Index> images, int& bits) {
  bits = TextureCoder<RangeDecoder>(in, polygons, images, most, 0).run();
}

}  // namespace sweepface::codec
