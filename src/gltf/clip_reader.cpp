// The weights that an animation of a glTF gives to morph targets, as a clip.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <tuple>

#include "sweepface/gltf.hpp"
#include "sweepface/keys.hpp"
#include "sweepface/weights.hpp"

#include "gltf/accessor.hpp"
#include "gltf/moved_weights.hpp"
#include "gltf/parts.hpp"
#include "io/text.hpp"

namespace sweepface {
namespace gltf {
namespace {

/// Curves between keys become straight lines between at least this many places a second.
constexpr double kCurveRate = 120;

/// One channel: the weights of a mesh.
struct Track {
  std::vector<std::string> names;
  std::string interpolation;
  std::vector<double> times, values;  // per key a row of names, or three with tangents
  CubicKeys cubic;                    // if it is one

  void at(double time, std::span<double> out) const {
    if (interpolation == "CUBICSPLINE") return cubic.at(time, out);
    const auto after =
        static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    const std::size_t last = times.size() - 1, n = names.size();
    const std::size_t from = after == 0 ? 0 : after - 1, to = std::min(after, last);
    const bool holds = from == to || interpolation == "STEP";
    const double s = holds ? 0 : (time - times[from]) / (times[to] - times[from]);
    for (std::size_t k = 0; k < n; ++k)
      out[k] = std::lerp(values[from * n + k], values[to * n + k], s);
  }
};

class ClipReader {
 public:
  ClipReader(const Document& document, const Parts& parts) : document_(document), parts_(parts) {}

  Result<Clip> read(std::string_view wanted) {
    const Json& animations = document_.list("animations");
    for (std::size_t a = 0; a < animations.size(); ++a) {
      Members in(animations[a], fmt::format("animation {}", a));
      const std::string_view name = in.text("name");
      if (!in.ok()) return in.error();
      if (!wanted.empty() && name != wanted) continue;
      if (auto ok = readAnimation(in); !ok) return std::unexpected(ok.error());
      if (tracks_.empty()) continue;
      auto clip = clipOf(name);
      if (clip && !wanted.empty() && isAgainFrom(a + 1, name))
        clip->warnings.push_back(
            fmt::format("Several of its animations are named {}; this is the "
                        "first of them.",
                        io::inQuotes(name)));
      return clip;
    }
    if (wanted.empty()) return fail("it has no animation of morph targets; export it with one.");
    return fail(fmt::format("it has no animation of morph targets named {}{}.",
                            io::inQuotes(wanted), listed(animations)));
  }

 private:
  bool isAgainFrom(std::size_t first, std::string_view name) const {
    const Json& animations = document_.list("animations");
    return std::any_of(animations.begin() + static_cast<std::ptrdiff_t>(first), animations.end(),
                       [&](const Json& animation) {
                         const Json* const other = find(animation, "name");
                         return other && *other == name && hasWeights(animation);
                       });
  }

  std::string listed(const Json& animations) const {
    constexpr std::size_t kMost = 10;
    std::string names;
    std::size_t count = 0;
    for (const Json& animation : animations)
      if (const Json* const name = find(animation, "name");
          name && name->is_string() && hasWeights(animation)) {
        if (++count > kMost) return names + ", ...";
        names += (names.empty() ? "; those that it has are " : ", ") +
                 io::inQuotes(name->get_ref<const std::string&>());
      }
    return names;
  }

  bool hasWeights(const Json& animation) const {
    return std::ranges::any_of(listOf(animation, "channels"), [this](const Json& channel) {
      const Json* const target = find(channel, "target");
      return target && movedWeights(document_, *target);
    });
  }

  Result<void> readAnimation(Members& in) {
    const Json &channels = in.array("channels"), &samplers = in.array("samplers");
    if (!in.ok()) return in.error();
    struct Channel {
      const RigMesh* mesh;
      std::size_t node, number, sampler;
    };
    constexpr std::size_t behindNodes = -1;
    std::vector<Channel> found;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Members channel(channels[c], fmt::format("{}, channel {}", in.place(), c));
      Members target(channel.object("target"), channel.place());
      const std::size_t sampler = channel.index("sampler", samplers.size(), "samplers");
      target.optionalIndex("node", document_.list("nodes").size(), "nodes");
      target.text("path");
      const auto moved = movedWeights(document_, channel.object("target"));
      if (!channel.ok()) return channel.error();
      if (!target.ok()) return target.error();
      const RigMesh* const mesh = moved ? meshOf(*moved) : nullptr;
      if (mesh) found.push_back({mesh, moved->ofNode ? moved->number : behindNodes, c, sampler});
    }
    // The order of channels means nothing: for each mesh, the first node that shows it counts.
    std::ranges::sort(found, {},
                      [](const Channel& c) { return std::tuple(c.mesh->mesh, c.node, c.number); });
    const auto others = std::ranges::unique(found, {}, &Channel::mesh);
    found.erase(others.begin(), others.end());
    for (const auto& [mesh, node, number, sampler] : found)
      if (auto ok = readTrack(*mesh, samplers[sampler],
                              fmt::format("{}, sampler {}", in.place(), sampler));
          !ok)
        return ok;
    return {};
  }

  const RigMesh* meshOf(const MovedWeights& moved) const {
    const auto mesh = moved.ofNode ? findIndex(document_.list("nodes")[moved.number], "mesh",
                                               document_.list("meshes").size())
                                   : std::optional(moved.number);
    const auto found = std::ranges::find_if(
        parts_.meshes, [&](const RigMesh& m) { return mesh && m.mesh == *mesh; });
    return found == parts_.meshes.end() || found->targets.empty() ? nullptr : &*found;
  }

  Result<std::vector<double>> numbers(std::size_t index) const {
    const auto accessor = accessorAt(document_, index);
    if (!accessor) return std::unexpected(accessor.error());
    return decode(document_, *accessor);
  }

  Result<void> readTrack(const RigMesh& mesh, const Json& json, std::string place) {
    Members in(json, std::move(place));
    const std::size_t accessors = document_.list("accessors").size();
    const std::size_t input = in.index("input", accessors, "accessors"),
                      output = in.index("output", accessors, "accessors");
    Track track;
    for (const std::size_t t : mesh.targets) track.names.push_back(parts_.targets[t]);
    // If several meshes have a target, the first one's weight counts.
    const auto isKnown = [&](const std::string& name) { return known_.contains(name); };
    if (std::ranges::all_of(track.names, isKnown)) return {};
    track.interpolation = in.has("interpolation") ? in.text("interpolation") : "LINEAR";
    const bool cubic = track.interpolation == "CUBICSPLINE";
    if (!cubic && track.interpolation != "LINEAR" && track.interpolation != "STEP")
      in.refuse("its interpolation is unknown");
    if (!in.ok()) return in.error();
    auto times = numbers(input), values = numbers(output);
    if (!times) return std::unexpected(times.error());
    if (!values) return std::unexpected(values.error());
    // Many channels may play the same few bytes.
    held_ += values->size();
    if (held_ > kMostClipWeights)
      return fail(
          "the channels of its animation have more values than a clip can hold; export it in "
          "parts.");
    const std::uint64_t perKey = std::uint64_t{track.names.size()} * (cubic ? 3 : 1);
    if (times->empty() || values->size() != times->size() * perKey)
      in.refuse(fmt::format("it has {} values for {} keys of {} targets{}", values->size(),
                            times->size(), track.names.size(),
                            cubic ? ", and a cubic spline three for each" : ""));
    if (std::ranges::adjacent_find(*times, std::greater_equal()) != times->end())
      in.refuse("its times do not increase");
    if (!times->empty() && !(isPlausibleTime(times->front()) && isPlausibleTime(times->back())))
      in.refuse("its times are not within 300 years");
    if (!in.ok()) return in.error();
    track.times = std::move(*times), track.values = std::move(*values);
    if (cubic) track.cubic = keysOf(track), track.values = {};
    for (std::size_t k = 0; k < track.names.size(); ++k)
      if (known_.insert(track.names[k]).second) {
        names_.push_back(track.names[k]);
        sources_.emplace_back(tracks_.size(), k);
      }
    tracks_.push_back(std::move(track));
    return {};
  }

  static CubicKeys keysOf(const Track& track) {
    CubicKeys keys{track.names, track.times, {}, {}, {}};
    const std::size_t n = track.names.size();
    for (std::size_t k = 0; k < track.times.size(); ++k)
      for (std::size_t row = 0; row < 3; ++row) {
        auto& list = row == 0 ? keys.in : row == 1 ? keys.values : keys.out;
        const auto from = track.values.begin() + static_cast<std::ptrdiff_t>((3 * k + row) * n);
        list.insert(list.end(), from, from + static_cast<std::ptrdiff_t>(n));
      }
    return keys;
  }

  /// The end of a step that lasted for `span` before `time`: as late as floats can tell from
  /// `time`.
  static double justBefore(double time, double span) {
    constexpr float kPast = -std::numeric_limits<float>::infinity();
    const float last = std::nextafter(static_cast<float>(time), kPast);
    return std::min(time - std::min(1e-3 * span, 1e-4), double{std::nextafter(last, kPast)});
  }

  std::size_t mostFrames() const { return kMostClipWeights / names_.size(); }
  std::unexpected<Error> tooLong() const {
    return fail(
        fmt::format("its animation of {} targets needs more than the {} frames that a clip of them "
                    "can hold; export it in parts.",
                    names_.size(), mostFrames()));
  }

  static void sortOut(std::vector<double>& times) {
    std::ranges::sort(times);
    const auto same = [](double a, double b) { return b - a < 1e-9; };
    times.erase(std::unique(times.begin(), times.end(), same), times.end());
  }

  /// The times of all keys, with more on curves and just before steps change.
  Result<std::vector<double>> frames() const {
    std::vector<double> times;
    for (const Track& track : tracks_)
      for (std::size_t k = 0; k < track.times.size(); ++k) {
        times.push_back(track.times[k]);
        if (k + 1 == track.times.size()) break;
        const double next = track.times[k + 1], span = next - track.times[k];
        if (track.interpolation == "STEP")
          if (const double before = justBefore(next, span); before > track.times[k])
            times.push_back(before);
        if (track.interpolation != "CUBICSPLINE") continue;
        const double pieces = std::ceil(span * kCurveRate);
        const auto room = [&](std::size_t frames) {
          return static_cast<double>(times.size()) + pieces <= static_cast<double>(frames);
        };
        if (!room(2 * mostFrames())) {
          sortOut(times);  // tracks may have their frames in common
          if (times.size() > mostFrames() || !room(2 * mostFrames())) return tooLong();
        }
        for (double p = 1; p < pieces; ++p) times.push_back(track.times[k] + span * p / pieces);
      }
    sortOut(times);
    return times;
  }

  Result<Clip> clipOf(std::string_view name) const {
    auto times = frames();
    if (!times) return std::unexpected(times.error());
    // Players hold the first key from the beginning.
    if (times->front() > 0) times->insert(times->begin(), 0.0);
    if (times->size() > mostFrames()) return tooLong();
    Clip clip{
        .names = names_, .times = std::move(*times), .weights = {}, .title = std::string(name)};
    std::vector<std::vector<double>> now;
    for (const Track& track : tracks_) now.emplace_back(track.names.size());
    for (const double time : clip.times) {
      for (std::size_t t = 0; t < tracks_.size(); ++t) tracks_[t].at(time, now[t]);
      for (const auto& [track, k] : sources_) clip.weights.push_back(now[track][k]);
    }
    if (!std::ranges::all_of(clip.weights, isPlausibleWeight))
      return fail("its animation has a weight that is not within ±1,000,000.");
    return clip;
  }

  const Document& document_;
  const Parts& parts_;
  std::vector<Track> tracks_;
  std::size_t held_ = 0;  // values of all tracks
  std::vector<std::string> names_;
  std::set<std::string> known_;                               // the names
  std::vector<std::pair<std::size_t, std::size_t>> sources_;  // [names] track, and place in it
};

Result<Clip> readClip(std::string_view bytes, const std::filesystem::path& folder,
                      std::string_view animation) {
  const auto document = parseDocument(bytes, folder);
  if (!document) return std::unexpected(document.error());
  const auto parts = findPartsAnywhere(*document);
  if (!parts) return std::unexpected(parts.error());
  return ClipReader(*document, *parts).read(animation);
}

}  // namespace
}  // namespace gltf

Result<Clip> parseGltfClip(std::string_view bytes, std::string_view name,
                           const std::filesystem::path& folder, std::string_view animation) {
  auto clip = gltf::readClip(bytes, folder, animation);
  if (clip) return clip;
  return fail(std::string(name) + ": " + clip.error().message);
}

}  // namespace sweepface
