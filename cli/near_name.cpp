#include "near_name.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "sweepface/clip.hpp"

namespace sweepface::cli {
namespace {

/// How many letters must be inserted, deleted or changed (Wagner and Fischer, 1974).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearName(std::string_view name, std::span<const std::string> names) {
  constexpr std::size_t kMostLetters = 2, kLongest = 64;  // of names worth comparing
  const ClipMatch match = matchClip({{std::string(name)}, {}, {}}, names);
  if (!match.targets[0].empty()) return names[match.targets[0][0]];
  std::size_t least = std::min(kMostLetters, name.size() / 3) + 1;
  std::string nearest;
  for (const std::string& each : names) {
    if (name.size() > kLongest || each.size() > kLongest) continue;
    if (const std::size_t apart = editDistance(name, each); apart < least)
      least = apart, nearest = each;
  }
  return nearest;
}

}  // namespace sweepface::cli
