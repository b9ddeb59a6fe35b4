#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "sweepface/clip.hpp"
#include "sweepface/weights.hpp"

#include "io/json_fields.hpp"
#include "io/json_text.hpp"

namespace sweepface {
namespace {

using Json = nlohmann::json;
using Drives = std::vector<NameMap::Drive>;

constexpr double kMostFactor = 1000;

Result<Drives> readDrives(const io::JsonFields& in) {
  const Json& json = in.json();
  constexpr const char* kForms =
      "is neither a target's name, a list of some, an object of numbers by name, nor null";
  Drives drives;
  const auto add = [&](const Json& target) {
    if (target.is_string()) drives.push_back({target.get<std::string>(), 1});
    return target.is_string();
  };
  if (json.is_null() || add(json)) return drives;
  if (json.is_array()) {
    if (std::ranges::all_of(json, add)) return drives;
    return in.fail(kForms);
  }
  if (!json.is_object()) return in.fail(kForms);
  for (const auto& [target, number] : json.items()) {
    const double factor = number.is_number() ? number.get<double>() : HUGE_VAL;
    if (!(std::abs(factor) <= kMostFactor))
      return in.fail(fmt::format("drives '{}' by what is no number within ±1000", target));
    drives.push_back({target, factor});
  }
  return drives;
}

Result<void> checkTargets(const NameMap& map, std::span<const std::string> targets) {
  for (const auto& [name, drives] : map.drives)
    for (const auto& [target, factor] : drives) {
      if (std::ranges::find(targets, target) == targets.end())
        return fail(fmt::format("{}: '{}' drives '{}', which is no target of the face.", map.called,
                                name, target));
      if (!(std::abs(factor) <= kMostFactor))
        return fail(fmt::format("{}: '{}' drives '{}' by what is no number within ±1000.",
                                map.called, name, target));
    }
  return {};
}

/// A column of the clip that is made, and the columns of the clip read that drive it.
struct MappedColumn {
  std::string name;
  /// Groups of columns and their factors: the sum over groups of the largest times its factor.
  std::vector<std::pair<std::vector<Index>, double>> sources;
};

/// Whether two names differ only in their spelling.
bool areAlike(const std::string& a, const std::string& b) {
  const auto matches = [](const std::string& name, const std::string& with) {
    return !matchClip({{name}, {}, {}}, std::span(&with, 1)).targets[0].empty();
  };
  return matches(a, b) && matches(b, a);  // both ways, as a name without a side means both sides
}

Result<std::vector<MappedColumn>> mappedColumns(Clip& clip, const NameMap& map) {
  Clip keys;
  for (const auto& [name, drives] : map.drives) keys.names.push_back(name);
  const ClipMatch match = matchClip(keys, clip.names);
  std::vector<Index> mapped(clip.names.size(), -1);  // by which name of the map
  std::map<std::string, MappedColumn> byTarget;
  for (std::size_t k = 0; k < map.drives.size(); ++k) {
    for (const Index column : match.targets[k]) {
      if (mapped[column] >= 0)
        return fail(fmt::format("{}: '{}' and '{}' are one name of the clip; keep one.", map.called,
                                keys.names[mapped[column]], keys.names[k]));
      mapped[column] = static_cast<Index>(k);
    }
    if (match.targets[k].empty()) continue;
    for (const auto& [target, factor] : map.drives[k].second)
      byTarget[target].sources.push_back({match.targets[k], factor});
  }
  if (!match.unmatched.empty())
    clip.warnings.push_back(
        fmt::format("{}: the clip has no {}.", map.called, io::fewOf(match.unmatched, 6)));
  std::vector<MappedColumn> columns;
  for (std::size_t c = 0; c < clip.names.size(); ++c) {
    if (mapped[c] >= 0) continue;
    const MappedColumn own{clip.names[c], {{{static_cast<Index>(c)}, 1}}};
    const auto target = std::ranges::find_if(
        byTarget, [&](const auto& each) { return areAlike(each.first, own.name); });
    if (target == byTarget.end())
      columns.push_back(own);
    else
      target->second.sources.push_back(own.sources[0]);
  }
  for (auto& [target, column] : byTarget) columns.push_back({target, std::move(column.sources)});
  return columns;
}

}  // namespace

Result<NameMap> parseNameMap(std::string_view text, std::string_view name) {
  const auto json = io::parseJson(text, name);
  if (!json) return std::unexpected(json.error());
  if (!json->is_object() || json->empty())
    return fail(fmt::format("{} is no object that has targets by names of a clip.", name));
  NameMap map{std::string(name), {}};
  for (const auto& [key, value] : json->items()) {
    auto drives = readDrives({name, value, fmt::format("'{}'", key)});
    if (!drives) return std::unexpected(drives.error());
    map.drives.emplace_back(key, std::move(*drives));
  }
  return map;
}

Result<Clip> renamed(Clip clip, const NameMap& map, std::span<const std::string> targets) {
  if (auto ok = checkTargets(map, targets); !ok) return std::unexpected(ok.error());
  const auto mapped = mappedColumns(clip, map);
  if (!mapped) return std::unexpected(mapped.error());
  const std::vector<MappedColumn>& columns = *mapped;
  const std::size_t n = clip.names.size(), frames = clip.times.size();
  if (columns.size() > kMostClipWeights / std::max<std::size_t>(frames, 1))
    return fail(fmt::format("{}: the clip would have too many weights; cut it.", map.called));
  std::vector<double> weights;
  weights.reserve(frames * columns.size());
  for (std::size_t f = 0; f < frames; ++f)
    for (const MappedColumn& column : columns) {
      double sum = 0;
      for (const auto& [sources, factor] : column.sources) {
        double largest = -HUGE_VAL;
        for (const Index c : sources) largest = std::max(largest, clip.weights[f * n + c]);
        sum += factor * largest;
      }
      if (!isPlausibleWeight(sum))
        return fail(
            fmt::format("{}: '{}' would get a weight beyond ±1,000,000.", map.called, column.name));
      weights.push_back(sum);
    }
  clip.names.clear();
  for (const MappedColumn& column : columns) clip.names.push_back(column.name);
  clip.weights = std::move(weights);
  return clip;
}

}  // namespace sweepface
