#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"

#include "fit/check_source.hpp"

namespace sweepface {

namespace {

constexpr int kMostTries = 12, kMostBracketHalvings = 4, kMostFailures = 4;
constexpr double kCloseEnough = 0.98;  // of the bytes allowed
constexpr double kPower = 0.8;         // bytes fall with this power of the tolerance
constexpr double kAway = 4;            // factor away from a first tolerance that cannot be met
constexpr double kCoarsest = 0.125;    // of the diagonal: what is tried before giving up

struct Try {
  double tolerance = 0;
  std::size_t bytes = 0;  // SIZE_MAX: it cannot be met
};

// Searches outwards from the first try until one is too large and one fits, then between them.
struct Bracket {
  Try coarse, fine;
  int halvings = 0;

  double next(const Try& last, std::size_t mostBytes) {
    if (coarse.bytes > 0 && fine.bytes > 0) {
      ++halvings;
      return std::sqrt(coarse.tolerance * fine.tolerance);
    }
    const double ratio = static_cast<double>(last.bytes) / static_cast<double>(mostBytes);
    const double factor = std::pow(ratio, 1 / kPower);
    return last.tolerance *
           (ratio > 1 ? std::clamp(factor, 2.0, 8.0) : std::clamp(factor, 0.125, 0.5));
  }
};

/// Whether two tries suggest that no tolerance will do, however coarse, because the bytes that do
/// not depend on it are too many by themselves. (Those of small meshes go up and down too much.)
/// What is left to save is estimated by kPower, with a factor of three to be safe.
bool isHopeless(const Try& finer, const Try& coarser, std::size_t mostBytes) {
  if (finer.bytes == SIZE_MAX || coarser.bytes == SIZE_MAX || coarser.bytes >= finer.bytes)
    return false;
  const double saved = static_cast<double>(finer.bytes - coarser.bytes);
  const double left = saved / (std::pow(coarser.tolerance / finer.tolerance, kPower) - 1);
  constexpr double kMargin = 1.1;  // the bytes of small meshes fluctuate
  return static_cast<double>(coarser.bytes) - 3 * left > kMargin * static_cast<double>(mostBytes);
}

Result<std::size_t> bytesOf(Rig rig, const FinishRig& finish) {
  if (auto ok = finish ? finish(rig) : Result<void>{}; !ok) return std::unexpected(ok.error());
  return encode(rig).size();
}

}  // namespace

// If the first tolerance cannot be met, some others are tried before anything else: smaller ones,
// which bring normals nearer, if normals were out of reach and the tolerance is the default one;
// otherwise larger ones, which are easier to meet.
Result<Conversion> convertToBytes(const MeshRig& source, ConvertOptions options,
                                  std::size_t mostBytes, const FinishRig& finish) {
  options.pack = true;
  if (auto ok = checkFromZero(options.tolerance, "the tolerance"); !ok)
    return std::unexpected(ok.error());
  if (auto ok = checkSource(source); !ok) return std::unexpected(ok.error());
  const bool isFinest = options.tolerance > 0;
  if (!isFinest) options.tolerance = 0.0005 * diagonal(source.neutral);
  std::optional<Conversion> best;
  std::optional<Error> first;  // why the first tolerance cannot be met
  Bracket bracket;
  Try smallest{0, SIZE_MAX};
  int failures = 0;
  bool isLast = false;  // whether only the coarsest tolerance can still fit
  // The number of tries is not known in advance: each gets a share of the progress that is left.
  int number = 0;
  double begun = 0, part = 0;
  const auto progress = std::move(options.progress);
  if (progress)
    options.progress = [&](std::string_view what, double done) {
      progress("try " + std::to_string(number) + ": " + std::string(what), begun + part * done);
    };
  for (int attempt = 0; attempt < kMostTries && bracket.halvings <= kMostBracketHalvings;
       ++attempt) {
    ++number, begun += part, part = 0.4 * (1 - begun);
    auto conversion = convert(source, options);
    if (!conversion && options.cancel && options.cancel->load()) return conversion;
    Try now{options.tolerance, SIZE_MAX};
    if (!conversion && attempt == failures) {
      if (!first) first = conversion.error();
      if (++failures > kMostFailures) return std::unexpected(*first);
      const bool goesFiner = !isFinest && first->message.starts_with(kNormalsOutOfReach);
      (goesFiner ? bracket.coarse : bracket.fine) = now;
      options.tolerance *= goesFiner ? 1 / kAway : kAway;
      continue;
    }
    if (conversion) {
      const auto bytes = bytesOf(conversion->rig, finish);
      if (!bytes) return std::unexpected(bytes.error());
      now.bytes = *bytes;
      if (now.bytes < smallest.bytes) smallest = now;
    }
    if (conversion && now.bytes <= mostBytes) {
      bracket.coarse = now;
      best = std::move(*conversion);
      if (static_cast<double>(now.bytes) > kCloseEnough * static_cast<double>(mostBytes)) break;
      if (isFinest && attempt == 0) break;
    } else if (!best && isLast) {
      break;
    } else if (conversion || best) {
      isLast = !best && isHopeless(bracket.fine, now, mostBytes);
      bracket.fine = now;  // a tolerance that cannot be met is too fine as well
      if (isLast) {
        options.tolerance = std::max(options.tolerance, kCoarsest * diagonal(source.neutral));
        continue;
      }
    } else {
      bracket.coarse = now;  // cannot be met although a finer one could be: too coarse
    }
    options.tolerance = bracket.next(now, mostBytes);
  }
  if (progress) progress("done", 1);
  if (best) return std::move(*best);
  return fail(
      fmt::format("the face does not fit into {} bytes; the smallest of {} tries takes {}, with a "
                  "tolerance of {:.2g}: allow more or strip parts",
                  mostBytes, number, smallest.bytes, smallest.tolerance));
}

}  // namespace sweepface
