// Stubs for what the usual module leaves out: files that are not packed, messages about what is
// wrong with a file, and regions. sweepface.js uses the full module for them.
#include "sweepface/late_goals.hpp"
#include "sweepface/trajectory.hpp"

#include "capi/message.hpp"
#include "codec/crc.hpp"
#include "codec/decoding.hpp"

namespace sweepface {

std::unexpected<Error> failWith(std::initializer_list<TextPart>) {
  return std::unexpected(Error({}));
}

sweepface_status capi::refuseWith(std::initializer_list<TextPart>) {
  return SWEEPFACE_BAD_ARGUMENT;
}

// A face that is not divided has no late goals.
LateGoals::LateGoals(std::size_t, double) {}
void LateGoals::add(const Goal&) noexcept {}
const LateGoals::Goal* LateGoals::due(double) const noexcept { return nullptr; }
void LateGoals::removeFirst() noexcept {}
void LateGoals::forget(std::size_t) noexcept {}

// Nothing in this module makes a Driven.
Kinematics path::Driven::periodic(double) const noexcept { return {}; }
Kinematics path::Driven::at(double) const noexcept { return {}; }

namespace codec {

std::string_view Refusal::advice() const { return {}; }
void Refusal::refuse(std::string_view) { ok_ = false; }
void Refusal::refuseWith(std::initializer_list<TextPart>) { ok_ = false; }
void Refusal::refuseNumber(const char*, long long) { ok_ = false; }
void Refusal::refuseCount(const char*, long long) { ok_ = false; }

// Byte by byte, as packed faces have few.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  std::uint32_t c = ~before;
  for (const char b : bytes) {
    c ^= static_cast<unsigned char>(b);
    for (int bit = 0; bit < 8; ++bit) c = (c & 1 ? 0xEDB88320u : 0) ^ (c >> 1);
  }
  return ~c;
}

std::span<const ChunkHandler> version1() { return {}; }

void readExact(Decoding&, Reader& in) { in.refuse({}); }
void readDrift(Decoding&, Reader& in) { in.refuse({}); }
void readLoose(Decoding&, Reader& in) { in.refuse({}); }
void readSourceOrder(Decoding&, Reader& in) { in.refuse({}); }
void readPolygons(Decoding&, Reader& in) { in.refuse({}); }
void readTexcoords(Decoding&, Reader& in) { in.refuse({}); }
void readQuadCorners(Decoding&, Reader& in) { in.refuse({}); }

// Skipped, as playing the face does not need them.
void readScene(Decoding&, Reader& in) { in.raw(in.left()); }
void readThingNames(Decoding&, Reader& in) { in.raw(in.left()); }

}  // namespace codec
}  // namespace sweepface
