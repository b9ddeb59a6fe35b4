#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"

namespace sweepface {

namespace {

constexpr int kMostTries = 12, kMostHalvings = 4, kMostFailures = 4;
constexpr double kCloseEnough = 0.98;  // of the bytes
constexpr double kCoarser = 4;         // where a tolerance cannot be met

struct Try {
  double tolerance = 0;
  std::size_t bytes = 0;
};

}  // namespace

// Where the first tolerance cannot be met, some larger ones are tried before anything else.
// Bytes fall as the tolerance grows, about as its power -0.8: from the first try outwards until one
// is too large and one fits, then between them.
Result<Conversion> convertToBytes(const MeshRig& source, ConvertOptions options,
                                  std::size_t mostBytes, const FinishRig& finish) {
  options.pack = true;
  std::optional<Conversion> best;
  Try coarse, fine;
  const bool isFinest = options.tolerance > 0;
  if (!isFinest) options.tolerance = 0.0005 * diagonal(source.neutral);
  std::optional<Error> first;  // why the first tolerance cannot be met
  int failures = 0, halvings = 0;
  for (int attempt = 0; attempt < kMostTries && halvings <= kMostHalvings; ++attempt) {
    auto conversion = convert(source, options);
    const bool cancelled = options.cancel && options.cancel->load();
    if (!conversion && cancelled) return conversion;
    if (!conversion && attempt == failures) {
      if (!first) first = conversion.error();
      if (++failures > kMostFailures) return std::unexpected(*first);
      fine = {options.tolerance, SIZE_MAX};
      options.tolerance *= kCoarser;
      continue;
    }
    Try now{options.tolerance, SIZE_MAX};
    if (conversion) {
      Rig rig = conversion->rig;
      if (auto ok = finish ? finish(rig) : Result<void>{}; !ok) return std::unexpected(ok.error());
      now.bytes = encode(rig).size();
    }
    if (conversion && now.bytes <= mostBytes) {
      coarse = now;
      best = std::move(*conversion);
      if (static_cast<double>(now.bytes) > kCloseEnough * static_cast<double>(mostBytes)) break;
      if (isFinest && attempt == 0) break;
    } else if (conversion || best) {
      fine = now;  // what cannot be met is too fine as well
    } else {
      coarse = now;  // what cannot be met though a finer one could be is too coarse
    }
    if (coarse.bytes > 0 && fine.bytes > 0) {
      ++halvings;
      options.tolerance = std::sqrt(coarse.tolerance * fine.tolerance);
    } else {
      const double ratio = static_cast<double>(now.bytes) / static_cast<double>(mostBytes);
      const double factor = std::pow(ratio, 1.25);
      options.tolerance *=
          ratio > 1 ? std::clamp(factor, 2.0, 8.0) : std::clamp(factor, 0.125, 0.5);
    }
  }
  if (best) return std::move(*best);
  return fail("the face does not fit into " + std::to_string(mostBytes) +
              " bytes at any tolerance tried; allow more or strip parts");
}

}  // namespace sweepface
