#pragma once

#include "sweepface/rig.hpp"

#include "codec/reader.hpp"
#include "codec/writer.hpp"

namespace sweepface::codec {

/// The turns that a file can hold, as it holds them: those of existing targets, in order.
std::vector<Turn> storedTurns(const Rig& rig);
void writeTurns(Writer& out, const std::vector<Turn>& turns);
std::vector<Turn> readTurns(Reader& in, std::size_t targets);

}  // namespace sweepface::codec
