#include <algorithm>

#include "sweepface/codec.hpp"

#include "codec/chunks.hpp"
#include "codec/decoding.hpp"
#include "codec/limits.hpp"
#include "codec/utf8.hpp"

namespace sweepface {

namespace codec {

bool Decoding::afford(Reader& in, std::size_t count, std::size_t bytesEach) {
  if (count > memory / bytesEach) {
    in.refuse(kTooMuchMemory);
    return false;
  }
  memory -= count * bytesEach;
  return true;
}

bool Decoding::affordVectors(Reader& in, std::size_t eachPose, std::size_t bytesEach) {
  const std::size_t poses = targets + 1, vectors = std::max<std::size_t>(1, eachPose);
  // Vectors that do not move cost no bytes, so memory is limited here.
  if (poses > kMostVectors / vectors ||
      poses * vectors > within(kMostVectors, kVectorsAByte, kVectorsAnyway, fileSize)) {
    in.refuse("there are more targets than the file can hold");
    return false;
  }
  return afford(in, poses * eachPose, bytesEach);
}

void Decoding::affordTargets(Reader& in) {
  if (afford(in, targets, sizeof(Target))) affordVectors(in, loose, sizeof(Vec3));
}

void Decoding::makeSurface(Reader& in) {
  quads = wireframe.quadCount();
  auto surface = Surface::make(std::move(wireframe), std::move(connectivity));
  if (!surface) return in.refuseWith({"the wireframe is unsound: ", surface.error().message});
  rig->surface = std::move(*surface);
  stored = static_cast<std::size_t>(rig->surface.storedCount());
}

void Decoding::addTarget(Reader& in, std::string_view name) {
  if (name.empty() || !isUtf8(name)) in.refuse("the target's name is empty or not UTF-8");
  rig->targets.push_back({std::string(name), {}, std::vector<Vec3>(loose)});
}

namespace {

class Decoder {
 public:
  Decoder(std::string_view bytes, std::string_view name, const DecodeLimits& limits) : name_(name) {
    decoding_.fileSize = bytes.size();
    decoding_.memory = limits.memory;
  }

  /// Reads into this rig from here on.
  Decoder& into(Rig& rig) {
    decoding_.rig = &rig;
    return *this;
  }

  /// Reads all chunks except `toCome`, if any.
  Result<void> run(const Chunks& chunks, const Chunk* toCome) {
    version_ = chunks.version;
    readers_ = version_ == 1 ? version1() : version2();
    if (readers_.empty())
      return fail(name_, " is of version ", version_, ", which this program does not read.");
    decoding_.targetsToCome = toCome != nullptr;
    for (const Chunk& chunk : chunks.list) {
      if (chunk.rank < 0) continue;
      if (auto ok = admit(chunk); !ok) return ok;
      if (&chunk == toCome) continue;
      if (auto ok = read(chunk); !ok) return ok;
    }
    return {};
  }

  Result<void> read(const Chunk& chunk) {
    Reader in(chunk.payload, chunk.offset);
    readers_[chunk.rank].read(decoding_, in);
    if (in.left() > 0) in.refuse("the chunk goes on after its last value");
    if (!in.ok()) return failAt(chunk, in.place(), in.problem(), in.advice());
    return {};
  }

 private:
  template <typename... Parts>
  [[gnu::always_inline]] std::unexpected<Error> failAt(const Chunk& chunk, std::size_t byte,
                                                       const Parts&... what) const {
    return fail(name_, ", chunk '", codeAt(chunk.rank, version_), "', byte ", byte, ": ", what...);
  }

  // Checks that chunks come in the order of the registry, and in version 1 as many targets as the
  // head announces.
  Result<void> admit(const Chunk& chunk) {
    if (chunk.rank < rank_ || (chunk.rank == rank_ && !readers_[chunk.rank].repeated))
      return failAt(chunk, chunk.offset, "it comes twice or out of its order", kConvertAgain);
    for (int rank = rank_ + 1; rank < chunk.rank; ++rank)
      if (readers_[rank].required)
        return failAt(chunk, chunk.offset, "chunk '", codeAt(rank, version_),
                      "' is missing before it", kConvertAgain);
    const bool isBehindTargets = std::ranges::any_of(
        readers_.first(static_cast<std::size_t>(chunk.rank)), &ChunkHandler::repeated);
    if (isBehindTargets && decoding_.rig->targets.size() < decoding_.targets)
      return failAt(chunk, chunk.offset, "targets are missing before it", kConvertAgain);
    if (const char* other = readers_[chunk.rank].instead; other && has(rankOf(other, version_)))
      return failAt(chunk, chunk.offset, "it must not stand beside chunk '", other, "'",
                    kConvertAgain);
    rank_ = chunk.rank;
    seen_ |= std::uint32_t{1} << rank_;
    return {};
  }

  bool has(int rank) const { return seen_ >> rank & 1; }

  std::string name_;
  int version_ = 0;
  std::span<const ChunkHandler> readers_;
  int rank_ = -1;           // of the last chunk
  std::uint32_t seen_ = 0;  // bits of the ranks so far
  Decoding decoding_;
};

// The chunk of the targets' vectors, if no other chunk builds on it.
const Chunk* movesOf(const Chunks& chunks) {
  const Chunk* moves = nullptr;
  for (const Chunk& chunk : chunks.list) {
    const std::string_view code = chunk.rank < 0 ? "" : codeAt(chunk.rank, chunks.version);
    if (code == "MOVE") moves = &chunk;
    if (code == "EXAC" || code == "drif") return nullptr;
  }
  return moves;
}

}  // namespace
}  // namespace codec

struct TargetsToCome::Rest {
  codec::Decoder decoder;
  std::string payload;
  codec::Chunk chunk;                   // views `payload`
  std::size_t stored = 0, targets = 0;  // of the rig
};

TargetsToCome::TargetsToCome() = default;
TargetsToCome::TargetsToCome(TargetsToCome&&) noexcept = default;
TargetsToCome& TargetsToCome::operator=(TargetsToCome&&) noexcept = default;
TargetsToCome::~TargetsToCome() = default;

Result<NeutralFirst> decodeNeutral(std::string_view bytes, std::string_view name,
                                   const DecodeLimits& limits) {
  const auto chunks = codec::readChunks(bytes, name);
  if (!chunks) return std::unexpected(chunks.error());
  std::unique_ptr<TargetsToCome::Rest> rest(new TargetsToCome::Rest{{bytes, name, limits}, {}, {}});
  const codec::Chunk* const moves = codec::movesOf(*chunks);
  NeutralFirst made;
  if (auto ok = rest->decoder.into(made.rig).run(*chunks, moves); !ok)
    return std::unexpected(ok.error());
  if (!moves) return made;
  rest->payload = moves->payload;
  rest->chunk = *moves;
  rest->chunk.payload = rest->payload;
  rest->stored = made.rig.neutral.size();
  rest->targets = made.rig.targets.size();
  made.targets.rest_ = std::move(rest);
  return made;
}

Result<void> TargetsToCome::decode(Rig& rig) {
  if (!rest_) return {};
  if (rig.neutral.size() != rest_->stored || rig.targets.size() != rest_->targets)
    return fail("The targets are those of another rig.");
  Result<void> done = rest_->decoder.into(rig).read(rest_->chunk);
  if (done)
    rest_ = nullptr;
  else
    for (Target& target : rig.targets) target.difference.clear();
  return done;
}

Result<Rig> decode(std::string_view bytes, std::string_view name, const DecodeLimits& limits) {
  auto made = decodeNeutral(bytes, name, limits);
  if (!made) return std::unexpected(made.error());
  if (auto ok = made->targets.decode(made->rig); !ok) return std::unexpected(ok.error());
  return std::move(made->rig);
}

}  // namespace sweepface
