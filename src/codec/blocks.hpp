#pragma once

#include <vector>

#include "sweepface/vec.hpp"

#include "codec/reader.hpp"
#include "codec/writer.hpp"

// What several kinds of chunks are made of, written and read side by side.
namespace sweepface::codec {

/// `exact` holds decimals or doubles where floats would not do.
enum class Precision { single, exact };

/// Vec2 or Vec3. Where it is shorter, a mask says which are not zero and only those follow. Nothing
/// costs less than a bit, so that memory stays in proportion to the file.
template <typename V>
void writeVectors(Writer& out, const std::vector<V>& vectors, Precision precision);
template <typename V>
std::vector<V> readVectors(Reader& in, std::size_t count, Precision precision);

/// Bit k of byte k / 8.
void writeMask(Writer& out, const std::vector<char>& mask);
std::vector<char> readMask(Reader& in, std::size_t count);

/// Values that rarely change: each with how often it comes in a row.
void writeRuns(Writer& out, const std::vector<Index>& values);
/// Values within [low, high), at most `most` of them.
std::vector<Index> readRuns(Reader& in, Index low, Index high, std::size_t most, const char* what);

void writeTexts(Writer& out, const std::vector<std::string>& texts);
std::vector<std::string> readTexts(Reader& in, const char* what);

}  // namespace sweepface::codec
