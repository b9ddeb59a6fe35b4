#pragma once

#include "sweepface/rig.hpp"

#include "codec/mirror.hpp"
#include "codec/symbols.hpp"
#include "codec/writer.hpp"

namespace sweepface::codec {

/// The bytes that `write` produces through a range coder.
template <typename Write>
std::string ranged(Write write) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  write(out);
  return coder.finish();
}

/// Writes the chunks of the source: its order, faces, texture coordinates and quad corners.
void writeSource(Writer& out, const Rig& rig, const Mirror& mirror, int textureBits);

}  // namespace sweepface::codec
