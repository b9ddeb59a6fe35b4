#include "sweepface/clip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sweepface {
namespace {

constexpr bool isGap(char c) { return c == '_' || c == '-' || c == '.' || c == ' '; }

/// A name normalised for comparison: lower case, no separators, a side as a final _l or _r.
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : name)
    if (!isGap(c)) text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const auto shorten = [&](std::string_view side) {
    if (text.size() <= side.size() || !text.ends_with(side)) return false;
    text.resize(text.size() - side.size());
    return text += {'_', side[0]}, true;
  };
  if (shorten("left") || shorten("right")) return text;
  // A single letter is a side only where the name sets it apart: jawL, jaw_L, but not "curl".
  if (name.size() < 2 || text.size() < 2) return text;
  const char last = name.back(), before = name[name.size() - 2];
  const bool apart =
      isGap(before) || ((last == 'L' || last == 'R') && before >= 'a' && before <= 'z');
  if (apart && (last == 'L' || last == 'R' || last == 'l' || last == 'r')) {
    text.pop_back();
    text += {'_', last == 'L' || last == 'l' ? 'l' : 'r'};
  }
  return text;
}

/// How long the beginning is that all targets have in common, such as "Head_blendShape." and what
/// else modelling programs put in front: up to a separator, and never a whole name.
std::size_t commonPrefix(std::span<const std::string> targets) {
  if (targets.size() < 2) return 0;
  const std::string_view first = targets.front();
  std::size_t length = first.size();
  for (const std::string_view name : targets) {
    const auto [end, unused] = std::ranges::mismatch(first.substr(0, length), name);
    length = std::min<std::size_t>(end - first.begin(), name.empty() ? 0 : name.size() - 1);
  }
  const auto isEnd = [](char c) { return isGap(c) || c == ':' || c == '|'; };
  while (length > 0 && !isEnd(first[length - 1])) --length;
  return length;
}

}  // namespace

Clip::Moment Clip::momentAt(double seconds) const noexcept {
  if (times.empty()) return {};
  const double time = times.front() + (seconds > 0 ? seconds : 0);
  const auto next = std::ranges::upper_bound(times, time);
  const auto later = static_cast<std::size_t>(
      std::min(next - times.begin(), static_cast<std::ptrdiff_t>(times.size()) - 1));
  const std::size_t earlier = later == 0 ? 0 : later - 1;
  const double length = times[later] - times[earlier];
  return {earlier, later, length > 0 ? std::clamp((time - times[earlier]) / length, 0.0, 1.0) : 1};
}

double Clip::weight(const Moment& moment, std::size_t name) const noexcept {
  if (times.empty()) return 0;
  const std::size_t n = names.size();
  return std::lerp(weights[moment.earlier * n + name], weights[moment.later * n + name],
                   moment.share);
}

bool Clip::moves(std::size_t name) const noexcept {
  for (std::size_t at = name; at < weights.size(); at += names.size())
    if (weights[at] != 0) return true;
  return false;
}

void Clip::at(double seconds, std::span<double> out) const noexcept {
  const Moment moment = momentAt(seconds);
  for (std::size_t k = 0; k < std::min(names.size(), out.size()); ++k) out[k] = weight(moment, k);
}

ClipMatch matchClip(const Clip& clip, std::span<const std::string> targets) {
  std::map<std::string, Index> byName, byPlain;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    byName.emplace(targets[t], static_cast<Index>(t));
    byPlain.emplace(plain(targets[t]), static_cast<Index>(t));
  }
  if (const std::size_t prefix = commonPrefix(targets); prefix > 0)
    for (std::size_t t = 0; t < targets.size(); ++t)
      byPlain.emplace(plain(std::string_view(targets[t]).substr(prefix)), static_cast<Index>(t));
  const auto ownOf = [&](const std::string& name) -> Index {
    if (const auto exact = byName.find(name); exact != byName.end()) return exact->second;
    const auto same = byPlain.find(plain(name));
    return same != byPlain.end() ? same->second : -1;
  };
  ClipMatch match;
  std::vector<bool> driven(targets.size(), false);
  for (const std::string& name : clip.names) {
    std::vector<Index>& found = match.targets.emplace_back();
    if (const Index own = ownOf(name); own >= 0) found = {own}, driven[own] = true;
  }
  // A name drives both sides at once unless they have names of their own. A jaw that goes left does
  // not go right.
  const std::vector<bool> hasOwn = driven;
  for (std::size_t k = 0; k < clip.names.size(); ++k) {
    if (!match.targets[k].empty()) continue;
    const std::string key = plain(clip.names[k]);
    const bool goesAside = key == "jaw" || key == "mouth";
    for (const char* side : {"_l", "_r"})
      if (const auto half = byPlain.find(key + side);
          half != byPlain.end() && !goesAside && !hasOwn[half->second])
        match.targets[k].push_back(half->second), driven[half->second] = true;
    if (match.targets[k].empty()) match.unmatched.push_back(clip.names[k]);
  }
  for (std::size_t t = 0; t < targets.size(); ++t)
    if (!driven[t]) match.undriven.push_back(targets[t]);
  return match;
}

void ClipMatch::spread(const Clip& clip, double seconds, std::span<double> to) const noexcept {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::ranges::fill(to, kNone);
  const Clip::Moment moment = clip.momentAt(seconds);
  for (std::size_t k = 0; k < std::min(clip.names.size(), targets.size()); ++k)
    for (const Index t : targets[k])
      if (static_cast<std::size_t>(t) < to.size()) to[t] = std::max(to[t], clip.weight(moment, k));
  std::ranges::replace(to, kNone, 0.0);
}

}  // namespace sweepface
