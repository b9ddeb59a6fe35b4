#pragma once

#include <benchmark/benchmark.h>
#include <functional>
#include <string>
#include <utility>

namespace sweepface::bench {

inline void add(const std::string& name, std::function<void(benchmark::State&)> run) {
  benchmark::RegisterBenchmark(name.c_str(), std::move(run))->Unit(benchmark::kMicrosecond);
}

}  // namespace sweepface::bench
