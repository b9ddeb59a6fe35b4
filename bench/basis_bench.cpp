// The basis of a sweep: solved once per ribbon and length, then evaluated at every vertex.
#include <benchmark/benchmark.h>

#include "sweepface/ode.hpp"

namespace sweepface::bench {
namespace {

constexpr Shape kPolynomial{1, 0, 0};
constexpr Shape kModerate{1, -90, 729};
constexpr Shape kStiff{1, -1e6, 2e10};

void makeBasis(benchmark::State& state, Shape shape) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(shape);
    benchmark::DoNotOptimize(SweepBasis::make(shape, 3));
  }
}
BENCHMARK_CAPTURE(makeBasis, polynomial, kPolynomial);
BENCHMARK_CAPTURE(makeBasis, moderate, kModerate);
BENCHMARK_CAPTURE(makeBasis, stiff, kStiff);

void evaluateBasis(benchmark::State& state, Shape shape) {
  const SweepBasis basis = SweepBasis::make(shape, 3).value();
  double u = 0;
  for (auto _ : state) {
    u = u < 0.9 ? u + 0.0625 : 0.03125;
    benchmark::DoNotOptimize(basis.at(u));
  }
}
BENCHMARK_CAPTURE(evaluateBasis, polynomial, kPolynomial);
BENCHMARK_CAPTURE(evaluateBasis, moderate, kModerate);
BENCHMARK_CAPTURE(evaluateBasis, stiff, kStiff);

}  // namespace
}  // namespace sweepface::bench
