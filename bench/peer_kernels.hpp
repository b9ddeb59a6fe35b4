#pragma once

#include "peers.hpp"

namespace sweepface::bench {

void runDense32(const PeerData& data, const double* weights, float* out);
void runDense16(const PeerData& data, const double* weights, float* out);
void runSparse32(const PeerData& data, const double* weights, float* out);
void runBlock16(const PeerData& data, const double* weights, float* out);
void runChunk16(const PeerData& data, const double* weights, float* out);
void runPaired16(const PeerData& data, const double* weights, float* out);

}  // namespace sweepface::bench
