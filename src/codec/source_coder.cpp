#include "codec/source_coder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "codec/faces.hpp"

namespace sweepface::codec {

namespace {

enum Tag : std::uint32_t {
  kCount = 0,
  kStays = 2,
  kNear = 3,
  kSteps = 4,
  kFar = 6,
  kLoose = 8,
  kLooseIndex = 9,
  kPlain = 11,
  kRotation = 12,
  kWhich = 13,
  kSize = 15,
  kCorner = 17,
  kQuadCorner = 19,
  kSameName = 21,
  kName = 22,
  kTextLength = 24,
  kText = 26,
  kHasTexture = 27,
  kFresh = 28,
  kKnown = 29,
  kTexture = 30,
  kBits = 32,
  kResidual = 34,
  kUsesCorner = 36,
  kOwnOrder = 37,
  kNext = 38
};

/// Items that are visited one after the other, most of them beside one that was visited not long
/// ago: told by their place among the neighbours of those, the latest first and there straight on
/// first.
template <typename Coder>
class Walk {
 public:
  Walk(Symbols<Coder>& symbols, std::vector<std::vector<Index>> neighbours)
      : s_(symbols), neighbours_(std::move(neighbours)), visited_(neighbours_.size(), 0) {}

  Index next(Index item) {
    Index found = -1;
    const bool follows = far_ < static_cast<Index>(neighbours_.size()) && !visited_[far_];
    if (follows && s_.bit(kNext, last_ == kFollows, 0, kWrites<Coder> && item == far_)) {
      last_ = kFollows;
      return visit(far_);
    }
    const bool near = !trail_.empty() && s_.bit(kNear, last_, 0, kWrites<Coder> && isNear(item));
    if (near) {
      const std::uint32_t place =
          s_.number(kSteps, std::min(last_, 15u), 0, kWrites<Coder> ? placeOf(item) : 0);
      found = at(place);
      last_ = place < 14 ? place : 14;
      if (found < 0) s_.refuse("a step leads nowhere");
    } else {
      const std::int64_t step = s_.signedNumber(kFar, 0, 0, std::int64_t{item} - far_);
      const std::int64_t there = far_ + step;
      if (there < 0 || there >= static_cast<std::int64_t>(neighbours_.size()))
        s_.refuse("a vertex or a face is out of range");
      else
        found = static_cast<Index>(there);
      last_ = 15;
    }
    if (s_.ok() && visited_[found]) s_.refuse("a vertex or a face comes twice");
    return s_.ok() ? visit(found) : 0;
  }
  bool visited(Index item) const {
    return item < static_cast<Index>(visited_.size()) && visited_[item];
  }

 private:
  static constexpr std::size_t kTrail = 64;
  static constexpr std::uint32_t kFollows = 16;  // as a last step: to the next in number

  Index visit(Index item) {
    far_ = item + 1;
    visited_[item] = 1;
    trail_.push_back(item);
    return item;
  }

  // Calls `use` with every unvisited neighbour of what was visited last, until it answers true.
  template <typename Use>
  void candidates(Use use) const {
    const std::size_t end = trail_.size() > kTrail ? trail_.size() - kTrail : 0;
    for (std::size_t k = trail_.size(); k-- > end;) {
      const auto& around = neighbours_[trail_[k]];
      const std::size_t size = around.size();
      std::size_t ahead = 0;
      if (k > 0) {
        const auto back = std::ranges::find(around, trail_[k - 1]);
        if (back != around.end())
          ahead = static_cast<std::size_t>(back - around.begin()) + size / 2;
      }
      for (std::size_t j = 0; j < size; ++j) {
        const Index item = around[(ahead + j) % size];
        if (item >= 0 && !visited_[item] && use(item)) return;
      }
    }
  }
  bool isNear(Index item) const {
    bool found = false;
    candidates([&](Index candidate) { return found = candidate == item; });
    return found;
  }
  std::uint32_t placeOf(Index item) const {
    std::uint32_t place = 0;
    candidates([&](Index candidate) {
      if (candidate == item) return true;
      ++place;
      return false;
    });
    return place;
  }
  Index at(std::uint32_t place) const {
    Index found = -1;
    candidates([&](Index candidate) {
      if (place-- > 0) return false;
      found = candidate;
      return true;
    });
    return found;
  }

  Symbols<Coder>& s_;
  std::vector<std::vector<Index>> neighbours_;
  std::vector<char> visited_;
  std::vector<Index> trail_;
  std::uint32_t last_ = 15;
  Index far_ = 0;
};

template <typename Coder>
std::size_t codeCount(Symbols<Coder>& s, std::uint32_t what, std::size_t count, std::size_t most) {
  const std::size_t n = s.number(kCount, what, 0, count);
  if (n > most) s.refuse("there are more entries than the chunk can hold");
  return s.ok() ? n : 0;
}

// ---- Order ----

template <typename Coder>
void codeOrder(Symbols<Coder>& s, const LevelOne& grid, std::vector<Index>& order, Index loose,
               std::size_t most) {
  order.resize(codeCount(s, 0, order.size(), most));
  Walk<Coder> walk(s, grid.vertexNeighbours());
  Index nextLoose = 0, before = 0;
  for (Index& v : order) {
    if (s.bit(kLoose, 0, 0, v < 0)) {
      const std::int64_t k = nextLoose + std::int64_t{s.signedNumber(
                                             kLooseIndex, 0, 0, -1 - std::int64_t{v} - nextLoose)};
      if (k < 0 || k >= loose) return s.refuse("a loose vertex is out of range");
      nextLoose = static_cast<Index>(k) + 1;
      v = -nextLoose;
    } else if (s.bit(kStays, 0, 0, kWrites<Coder> && v >= 0 && walk.visited(v))) {
      // Somewhere it has been before: seams have several vertices at one place.
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

// ---- Faces ----

// The source's vertices at each vertex of the grid.
class Places {
 public:
  Places(const LevelOne& grid, const std::vector<Index>& order)
      : start_(grid.vertexCount() + 1, 0) {
    vertices_ = static_cast<Index>(order.size());
    for (const Index g : order)
      if (g >= 0) ++start_[g + 1];
    for (std::size_t g = 1; g < start_.size(); ++g) start_[g] += start_[g - 1];
    list_.resize(start_.back());
    std::vector<Index> at = start_;
    for (Index v = 0; v < vertices_; ++v)
      if (order[v] >= 0) list_[at[order[v]]++] = v;
  }
  std::span<const Index> at(Index gridVertex) const {
    return {list_.data() + start_[gridVertex], list_.data() + start_[gridVertex + 1]};
  }
  Index vertices() const { return vertices_; }

 private:
  std::vector<Index> start_, list_;
  Index vertices_ = 0;
};

template <typename Coder>
class FaceCoder {
 public:
  FaceCoder(Symbols<Coder>& symbols, const LevelOne& grid, SourceMesh& source, std::size_t most)
      : s_(symbols),
        grid_(grid),
        source_(source),
        faces_(source.polygons),
        places_(grid, source.gridVertex),
        most_(most),
        walk_(symbols, grid.quadNeighbours()) {}

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

  // A plain face goes around one quad of the grid, and the quad around it.
  void findPlain() {
    plainQuad_.assign(faces_.faceCount(), kNone);
    if (source_.quadCorners.empty()) return;
    std::vector<Index> faceOf;
    for (Index f = 0; f < faces_.faceCount(); ++f)
      faceOf.insert(faceOf.end(), faces_.faceSize(f), f);
    const auto corners = static_cast<Index>(faceOf.size());
    for (std::size_t q = 0; q < grid_.quads().size(); ++q) {
      const Index* told = &source_.quadCorners[4 * q];
      if (told[0] < 0 || told[0] >= corners) continue;
      const std::array<Index, 4> around = aroundQuad(faces_, told[0]);
      if (around[3] < 0 || !std::equal(around.begin(), around.end(), told)) continue;
      bool there = true;
      for (int k = 0; k < 4; ++k)
        there &= whichAt(grid_.quads()[q][k], faces_.corners[told[k]]) >= 0;
      if (there && plainQuad_[faceOf[told[0]]] == kNone)
        plainQuad_[faceOf[told[0]]] = static_cast<Index>(q);
    }
  }
  Index whichAt(Index gridVertex, Index vertex) const {
    const auto here = places_.at(gridVertex);
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
    // The face's first corner is the quad's corner `turn`.
    std::uint32_t turn = 0;
    if constexpr (kWrites<Coder>)
      while (source_.quadCorners[4 * q + turn] != first) ++turn;
    const std::uint32_t half = s_.bit(kRotation, turn_, 0, turn >> 1);
    turn = 2 * half + s_.bit(kRotation, 4 + turn_, half, turn & 1);
    turn_ = turn;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t at = (turn + k) % 4;
      const Index place = grid_.quads()[q][at];
      const auto here = places_.at(place);
      if (here.empty()) return s_.refuse("a face has a corner where the source has no vertex");
      std::size_t which = 0;
      if (here.size() > 1)
        which =
            s_.number(kWhich, 0, 0, kWrites<Coder> ? whichAt(place, faces_.corners[first + k]) : 0);
      if (which >= here.size()) return s_.refuse("a vertex is out of range");
      if constexpr (!kWrites<Coder>) {
        source_.quadCorners[4 * q + at] = static_cast<Index>(faces_.corners.size());
        faces_.corners.push_back(here[which]);
      }
      last_ = here[which];
    }
    if constexpr (!kWrites<Coder>)
      faces_.faceStart.push_back(static_cast<Index>(faces_.corners.size()));
  }

  void codeOddFace(Index f, Index first) {
    const std::uint32_t size =
        3 + s_.number(kSize, 0, 0, kWrites<Coder> ? faces_.faceSize(f) - 3 : 0);
    total_ += size;
    if (total_ > most_) return s_.refuse("the faces have too many corners");
    for (std::uint32_t k = 0; k < size && s_.ok(); ++k) {
      const std::int64_t vertex =
          std::int64_t{last_} +
          s_.signedNumber(kCorner, std::min(k, 4u), 0,
                          kWrites<Coder> ? std::int64_t{faces_.corners[first + k]} - last_ : 0);
      if (vertex < 0 || vertex >= places_.vertices()) return s_.refuse("a vertex is out of range");
      last_ = static_cast<Index>(vertex);
      if constexpr (!kWrites<Coder>) faces_.corners.push_back(last_);
    }
    if constexpr (!kWrites<Coder>)
      faces_.faceStart.push_back(static_cast<Index>(faces_.corners.size()));
  }

  // Quads that no plain face goes around.
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
            last + std::int64_t{s_.signedNumber(kName, what, 0, std::int64_t{name} - last)};
        if (there < -1 || there >= static_cast<std::int64_t>(names.size()))
          return s_.refuse("the name of a face is out of range");
        last = static_cast<Index>(there);
      }
      name = last;
    }
  }

  void codeTexts(std::vector<std::string>& texts) {
    texts.resize(codeCount(s_, 2, texts.size(), most_));
    for (std::string& text : texts) {
      const std::size_t size = codeCount(s_, 3, text.size(), most_);
      if (!s_.ok()) return;
      text.resize(size);
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
  Places places_;
  std::size_t most_, total_ = 0;
  Walk<Coder> walk_;
  std::vector<Index> plainQuad_;  // [faces] of a writer
  bool wasPlain_ = true;
  std::uint32_t turn_ = 0;
  Index last_ = 0;
};

// ---- Texture coordinates ----

// Beyond any texture that repeats, and far from where whole numbers end.
constexpr std::int32_t kMostTexture = 1 << 26;

template <typename Coder>
class TextureCoder {
 public:
  TextureCoder(Symbols<Coder>& symbols, Polygons& polygons, std::size_t most, int bits)
      : s_(symbols), p_(polygons), most_(most), bits_(bits) {}

  int run() {
    bits_ = static_cast<int>(s_.number(kBits, 0, 0, static_cast<std::uint64_t>(bits_)));
    if (bits_ < 1 || bits_ > 24) s_.refuse("texture coordinates have too many bits");
    if (!s_.ok()) return bits_;
    const std::size_t count = codeCount(s_, 4, p_.texcoords.size(), most_);
    if constexpr (kWrites<Coder>) {
      for (const Vec2& t : p_.texcoords) whole_.push_back({wholeOf(t.x), wholeOf(t.y)});
    } else {
      whole_.resize(count);
    }
    known_.assign(count, 0);
    const bool used = s_.bit(kHasTexture, 0, 0, !p_.cornerTexcoords.empty());
    if (used) codeIndices();
    if (used && s_.ok()) codeByFaces();
    for (std::size_t t = 0; t < count && s_.ok(); ++t)
      if (!known_[t]) codeValue(static_cast<Index>(t), last_, 3);
    if constexpr (!kWrites<Coder>) {
      const double step = std::ldexp(1.0, -bits_);
      for (const auto& [x, y] : whole_) p_.texcoords.push_back({x * step, y * step});
    }
    return bits_;
  }

 private:
  using Whole = std::array<std::int32_t, 2>;

  std::int32_t wholeOf(double x) const {
    return static_cast<std::int32_t>(
        std::llround(std::clamp<double>(std::ldexp(x, bits_), -kMostTexture, kMostTexture)));
  }

  void codeIndices() {
    p_.cornerTexcoords.resize(p_.corners.size(), -1);
    for (std::size_t c = 0; c < p_.corners.size() && s_.ok(); ++c)
      p_.cornerTexcoords[c] = codeIndex(p_.corners[c], p_.cornerTexcoords[c]);
  }

  // The next new one, the one this vertex had last, or any.
  Index codeIndex(Index vertex, Index t) {
    if (vertex >= static_cast<Index>(ofVertex_.size())) ofVertex_.resize(vertex + 1, -2);
    Index& had = ofVertex_[vertex];
    if (had >= -1 && s_.bit(kKnown, 0, 0, t == had)) return had;
    if (s_.bit(kFresh, had >= -1, 0, t == next_)) {
      t = next_;
    } else {
      const std::int64_t there =
          next_ + std::int64_t{s_.signedNumber(kTexture, 0, 0, std::int64_t{t} - next_)};
      t = static_cast<Index>(std::clamp<std::int64_t>(there, -2, std::int64_t{1} << 30));
    }
    if (t < -1 || t >= static_cast<Index>(known_.size())) {
      s_.refuse("a texture coordinate is out of range");
      return -1;
    }
    next_ = std::max(next_, t + 1);
    return had = t;
  }

  // From face to face across the edges that they share in the texture.
  void codeByFaces() {
    std::unordered_map<std::uint64_t, Side> sides;
    for (Index f = 0; f < p_.faceCount(); ++f)
      for (Index k = 0; k < p_.faceSize(f); ++k)
        sides.emplace(keyOf(at(f, k), at(f, k + 1)), Side{f, k});
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
          const auto other = sides.find(keyOf(at(entry.face, k + 1), at(entry.face, k)));
          if (other == sides.end() || reached[other->second.face]) continue;
          reached[other->second.face] = 1;
          queue.push_back({other->second.face, other->second.corner, {entry.face, k}});
        }
      }
    }
  }

  struct Side {
    Index face = -1, corner = 0;  // from this corner to the next
  };
  struct Entry {
    Index face, corner;  // entered across the side from this corner
    Side from;           // the same side as the face before has it
  };

  Index at(Index face, Index k) const {
    const Index size = p_.faceSize(face);
    return p_.cornerTexcoords[p_.faceStart[face] + (k % size + size) % size];
  }
  static std::uint64_t keyOf(Index from, Index to) {
    return std::uint64_t{static_cast<std::uint32_t>(from)} << 32 | static_cast<std::uint32_t>(to);
  }
  bool knows(Index t) const { return t >= 0 && known_[t]; }
  Whole beyond(Index a, Index b, Index c) const {  // the fourth corner of a parallelogram
    return {whole_[a][0] + whole_[c][0] - whole_[b][0], whole_[a][1] + whole_[c][1] - whole_[b][1]};
  }

  void codeFace(const Entry& entry) {
    const Index f = entry.face, size = p_.faceSize(f);
    for (Index j = 0; j < size && s_.ok(); ++j) {
      const Index k = entry.corner + j, t = at(f, k);
      if (t < 0) continue;
      if (!known_[t]) {
        const Index before = at(f, k - 1), across = at(f, k + 2), after = at(f, k + 1);
        if (size == 4 && knows(before) && knows(across) && knows(after))
          codeValue(t, beyond(before, across, after), 0);
        else if (const Index back = cornerBefore(entry.from);
                 j == 2 && knows(before) && knows(back))
          codeValue(t, beyond(before, back, before), 1);  // as far on as the face before is long
        else
          codeValue(t, knows(before) ? whole_[before] : last_, 2);
      }
      last_ = whole_[t];
    }
  }
  // What comes before the shared side in the face it was entered from: the side's other end there
  // is where the next corner continues.
  Index cornerBefore(const Side& side) const {
    return side.face < 0 ? -1 : at(side.face, side.corner - 1);
  }

  void codeValue(Index t, const Whole& guess, std::uint32_t how) {
    for (int a = 0; a < 2; ++a) {
      const std::int64_t value =
          std::int64_t{guess[a]} +
          s_.signedNumber(kResidual, how * 2 + a, 0, std::int64_t{whole_[t][a]} - guess[a]);
      if (std::abs(value) > kMostTexture) s_.refuse("a texture coordinate is out of range");
      whole_[t][a] = s_.ok() ? static_cast<std::int32_t>(value) : 0;
    }
    known_[t] = 1;
    last_ = whole_[t];
  }

  Symbols<Coder>& s_;
  Polygons& p_;
  std::size_t most_;
  int bits_;
  std::vector<Whole> whole_;
  std::vector<char> known_;
  std::vector<Index> ofVertex_;
  Index next_ = 0;
  Whole last_{};
};

}  // namespace

void writeOrder(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source) {
  std::vector<Index> order = source.gridVertex;
  codeOrder(out, grid, order, static_cast<Index>(source.loose.size()), SIZE_MAX);
}
void readOrder(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source) {
  codeOrder(in, grid, source.gridVertex, static_cast<Index>(source.loose.size()), most);
}

void writeFaces(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source) {
  SourceMesh copy = source;
  FaceCoder<RangeEncoder>(out, grid, copy, SIZE_MAX).run();
}
void readFaces(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source) {
  FaceCoder<RangeDecoder>(in, grid, source, most).run();
}

void writeTexture(Symbols<RangeEncoder>& out, const Polygons& polygons, int bits) {
  Polygons copy = polygons;
  TextureCoder<RangeEncoder>(out, copy, SIZE_MAX, bits).run();
}
void readTexture(Symbols<RangeDecoder>& in, std::size_t most, Polygons& polygons, int& bits) {
  bits = TextureCoder<RangeDecoder>(in, polygons, most, 0).run();
}

}  // namespace sweepface::codec
