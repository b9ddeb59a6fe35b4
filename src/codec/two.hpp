#pragma once

namespace sweepface::codec {

/// Two numbers that processors of all kinds reckon with at once, each as it would be alone.
using Two [[gnu::vector_size(16)]] = double;

}  // namespace sweepface::codec
