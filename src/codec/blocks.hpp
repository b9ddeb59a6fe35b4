#pragma once

#include <vector>

#include "sweepface/vec.hpp"

#include "codec/reader.hpp"
#include "codec/writer.hpp"

// Building blocks shared by several kinds of chunks, each writer beside its reader.
namespace sweepface::codec {

/// `exact` stores decimals or doubles where floats would lose bits.
enum class Precision { single, exact };

/// Vec2 or Vec3. Where it saves bytes, a mask marks the non-zero vectors and only those follow.
/// Every vector takes at least a bit, so memory stays in proportion to the file.
template <typename V>
void writeVectors(Writer& out, const std::vector<V>& vectors, Precision precision);
template <typename V>
std::vector<V> readVectors(Reader& in, std::size_t count, Precision precision);

/// Bit k of byte k / 8.
void writeMask(Writer& out, const std::vector<char>& mask);
std::vector<char> readMask(Reader& in, std::size_t count);

/// Run-length coding of values that rarely change.
void writeRuns(Writer& out, const std::vector<Index>& values);
/// Values within [low, high), at most `most` of them.
std::vector<Index> readRuns(Reader& in, Index low, Index high, std::size_t most, const char* what);

void writeTexts(Writer& out, const std::vector<std::string>& texts);
std::vector<std::string> readTexts(Reader& in, const char* what);

}  // namespace sweepface::codec
