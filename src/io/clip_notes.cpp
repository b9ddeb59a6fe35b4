#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <ranges>

#include "sweepface/clip.hpp"
#include "sweepface/head.hpp"

namespace sweepface {

namespace {

/// Whether a name is another's for a side, or for both, and always has its weight.
bool isTheSame(const Clip& clip, std::size_t name, std::size_t other) {
  const std::size_t count = clip.names.size();
  for (std::size_t at = 0; at < clip.weights.size(); at += count)
    if (clip.weights[at + name] != clip.weights[at + other]) return false;
  const auto matches = [&](std::size_t from, std::size_t to) {
    return !matchClip({{clip.names[from]}, {}, {}}, std::array{clip.names[to]}).targets[0].empty();
  };
  return matches(name, other) || matches(other, name);
}

}  // namespace

std::vector<std::string> idleNames(const Clip& clip, const ClipMatch& match) {
  std::vector<std::string> idle;
  for (std::size_t k = 0; k < clip.names.size(); ++k)
    if (match.targets[k].empty() && clip.moves(k) && !ClipAngles::tells(clip.names[k])) {
      const auto shows = [&](std::size_t other) {
        return !match.targets[other].empty() && isTheSame(clip, k, other);
      };
      if (std::ranges::none_of(std::views::iota(std::size_t{0}, clip.names.size()), shows))
        idle.push_back(clip.names[k]);
    }
  return idle;
}

std::vector<std::string> notesOnClip(const Clip& clip, const ClipMatch& match, double missed,
                                     std::span<const std::string> targets, std::string_view name) {
  constexpr double kMissedByMost = 1e-4;  // as timelines promise
  std::vector<std::string> notes;
  std::map<Index, std::vector<std::string>> drivers;
  for (std::size_t k = 0; k < clip.names.size(); ++k)
    for (const Index target : match.targets[k]) drivers[target].push_back(clip.names[k]);
  for (const auto& [target, names] : drivers)
    if (names.size() > 1)
      notes.push_back(fmt::format("{}: {} drive the target {}, whichever is largest.", name,
                                  fmt::join(names, " and "), targets[target]));
  if (missed > kMissedByMost)
    notes.push_back(
        fmt::format("{}: it moves more quickly, or for longer, than frames can tell: between them "
                    "weights are off by {:.2g}.",
                    name, missed));
  return notes;
}

}  // namespace sweepface
