#pragma once

namespace sweepface::codec {

/// Two doubles for SIMD on any processor; each lane computes exactly what a scalar would.
using Two [[gnu::vector_size(16)]] = double;

}  // namespace sweepface::codec
