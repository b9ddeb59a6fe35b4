#include "gltf/animation.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

#include "sweepface/keys.hpp"

#include "gltf/head_track.hpp"
#include "gltf/moved_targets.hpp"
#include "io/single.hpp"

namespace sweepface::gltf {
namespace {

/// Times and the weights at each of them; with tangents if they form a cubic spline.
struct Keys {
  bool cubic = false;
  std::vector<double> times;            ///< [keys]
  std::vector<double> in, values, out;  ///< [keys × targets]
};

/// A law exactly, as keys without tangents if it is linear, or else as a cubic Hermite spline: with
/// the right speeds that is a parabola between two keys.
Keys exactKeys(const Motion& motion, const std::vector<std::size_t>& targets) {
  const bool turns = motion.law() == TimeLaw::accelerateBrake;
  const std::vector<double> shares = turns ? std::vector{0.0, 0.5, 1.0} : std::vector{0.0, 1.0};
  Keys keys;
  keys.cubic = motion.law() != TimeLaw::linear;
  for (const double share : shares) {
    // Players multiply speeds by the times that they read.
    const double seconds = single(motion.seconds());
    keys.times.push_back(share * seconds);
    const Progress done = progress(motion.law(), share);
    for (const std::size_t target : targets) {
      const double way = motion.to()[target] - motion.from()[target];
      keys.values.push_back(motion.sample(target, share * motion.seconds()).position);
      keys.in.push_back(way * done.velocity / seconds);
    }
  }
  keys.out = keys.in;
  return keys;
}

Keys framesOf(const Clip& clip, const std::vector<std::size_t>& targets) {
  Keys keys;
  keys.times = clip.times;
  for (std::size_t frame = 0; frame < clip.times.size(); ++frame)
    for (const std::size_t target : targets)
      keys.values.push_back(clip.weights[frame * clip.names.size() + target]);
  return keys;
}

/// The columns of some targets.
Keys columnsOf(const CubicKeys& all, const std::vector<std::size_t>& targets) {
  Keys keys;
  keys.cubic = true;
  for (const double time : all.times) keys.times.push_back(single(time));
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    // Players multiply slopes by the times that they read.
    const auto stretch = [&](std::size_t a, std::size_t b) {
      return (all.times[b] - all.times[a]) / (keys.times[b] - keys.times[a]);
    };
    const double before = k > 0 ? stretch(k - 1, k) : 1,
                 after = k + 1 < all.times.size() ? stretch(k, k + 1) : 1;
    for (const std::size_t target : targets) {
      const std::size_t place = k * all.names.size() + target;
      keys.in.push_back(before * all.in[place]);
      keys.values.push_back(all.values[place]);
      keys.out.push_back(after * all.out[place]);
    }
  }
  return keys;
}

/// Whether any targets move with the rig's.
bool movesAny(const std::vector<Index>& moved) {
  return std::ranges::any_of(moved, [](Index target) { return target >= 0; });
}

/// Adds a column for every target that does not move (-1): it stays as it rests.
void widen(Keys& keys, const std::vector<Index>& moved, const std::vector<double>& rest) {
  for (auto* const list : {&keys.in, &keys.values, &keys.out}) {
    if (list->empty()) continue;
    std::vector<double> wide;
    for (auto next = list->begin(); next != list->end();)
      for (std::size_t t = 0; t < moved.size(); ++t)
        wide.push_back(moved[t] >= 0 ? *next++ : list == &keys.values ? rest[t] : 0);
    *list = std::move(wide);
  }
}

/// The values as glTF stores them. Tangents before the first and after the last key have no effect,
/// but must be numbers.
std::vector<double> interleaved(const Keys& keys) {
  if (!keys.cubic) return keys.values;
  std::vector<double> all;
  const std::size_t width = keys.values.size() / keys.times.size();
  for (std::size_t k = 0; k < keys.times.size(); ++k)
    for (const auto* list : {&keys.in, &keys.values, &keys.out})
      for (std::size_t t = 0; t < width; ++t) all.push_back((*list)[k * width + t]);
  return all;
}

/// The first key that is no later than the one before it in single precision, or the number of
/// keys.
std::size_t sameAsBefore(const std::vector<double>& times) {
  std::size_t k = 1;
  while (k < times.size() && static_cast<float>(times[k]) > static_cast<float>(times[k - 1])) ++k;
  return std::min(k, times.size());
}
bool increase(const std::vector<double>& times) { return sameAsBefore(times) == times.size(); }

class Animator {
 public:
  Animator(BoundScene& scene, const GlbOptions& options, Builder& builder)
      : scene_(scene), moved_(movedTargets(scene)), options_(options), builder_(builder) {}

  Result<void> run() {
    std::string name = options_.animationName;
    if (name.empty()) name = options_.motion ? nameOf(options_.motion->law()) : "clip";
    if (options_.clip && options_.keyTolerance > 0) {
      // Fitting keys to times that cannot be written may take very long.
      if (!io::areSingle(options_.clip->times)) return beyondFloats(options_.clip->times);
      few_ = fewestKeys(*options_.clip, options_.keyTolerance);
    }
    // A key with tangents is as large as three without.
    if (few_ && 3 * few_->times.size() > options_.clip->times.size()) few_.reset();
    animation_ = {
        {"name", freeName(name)}, {"channels", Json::array()}, {"samplers", Json::array()}};
    if (options_.motion || options_.clip)
      for (std::size_t n = 0; n < scene_.document.list("nodes").size(); ++n)
        if (auto ok = addNode(n); !ok) return ok;
    if (animation_["channels"].empty() && !options_.head) return nothingToMove();
    if (options_.head)
      if (auto ok = addHead(); !ok) return ok;
    Json& animations = scene_.document.json["animations"];
    if (!animations.is_array()) animations = Json::array();
    animations.push_back(std::move(animation_));
    return {};
  }

 private:
  /// The name, with a number appended if the scene has an animation of that name.
  std::string freeName(const std::string& name) const {
    std::set<std::string> taken;
    for (const Json& animation : scene_.document.list("animations"))
      if (const Json* const known = find(animation, "name"); known && known->is_string())
        taken.insert(known->get<std::string>());
    std::string free = name;
    for (int k = 2; taken.contains(free); ++k) free = fmt::format("{} {}", name, k);
    return free;
  }

  /// Moves the mesh that a node shows, if it has targets to move.
  Result<void> addNode(std::size_t node) {
    const Json& json = scene_.document.list("nodes")[node];
    const auto mesh = findIndex(json, "mesh", moved_.size());
    if (!mesh || !movesAny(moved_[*mesh])) return {};
    const auto sampler = samplerOf(*mesh, restOf(json, *mesh));
    if (!sampler) return std::unexpected(sampler.error());
    animation_["channels"].push_back(
        {{"sampler", *sampler}, {"target", {{"node", node}, {"path", "weights"}}}});
    return {};
  }

  std::unexpected<Error> nothingToMove() const {
    if (std::ranges::any_of(scene_.targets, [](Index target) { return target >= 0; }))
      return fail(
          "No node of the face's scene shows it, so that an animation could move nothing; show it "
          "by a node in the source, or convert that with --bare.");
    return fail(
        "The face has no target in its scene that an animation could move; convert it with the "
        "meshes of its expressions.");
  }

  Result<void> addHead() {
    std::vector<double> rotations;
    for (const Quaternion& q : options_.head->rotations)
      rotations.insert(rotations.end(), q.begin(), q.end());
    const Vec3& pivot = options_.head->pivot;
    if (!io::areSingle(options_.head->times) || !increase(options_.head->times) ||
        !io::areSingle(rotations) || !io::areSingle(std::array{pivot.x, pivot.y, pivot.z}) ||
        rotations.size() != 4 * options_.head->times.size() || rotations.empty())
      return fail("The head's rotation needs one for each of its increasing times.");
    return addHeadTrack(scene_.document, *options_.head,
                        options_.keyTolerance > 0 ? kHeadTolerance : 0, animation_, builder_);
  }

  std::unexpected<Error> beyondFloats(const std::vector<double>& times) const {
    if (options_.motion)
      return fail(
          "The motion is too fast, too slow or too wide for the single precision of glTF; give it "
          "other seconds or weights.");
    const std::size_t same = sameAsBefore(times);
    if (io::areSingle(times) && same < times.size())
      return fail(
          fmt::format("Keys about {:.10g} s are closer to each other than the single precision of "
                      "glTF can tell; ask for fewer frames a second, or play it in parts.",
                      times[same]));
    return fail(
        "A time or a weight is too large for the single precision of glTF, or a weight changes too "
        "fast; play it in less time, or with smaller weights.");
  }

  /// The weights that targets keep where the animation does not move them.
  std::vector<double> restOf(const Json& node, std::size_t mesh) const {
    const std::vector<Index>& moved = moved_[mesh];
    std::vector<double> rest(moved.size());
    for (const Json* const posed : {&scene_.document.list("meshes")[mesh], &node})
      if (auto own = weightsOf(*posed, moved.size())) rest = std::move(*own);
    for (std::size_t t = 0; t < moved.size(); ++t)
      if (moved[t] >= 0) rest[t] = 0;
    return rest;
  }

  Result<std::size_t> samplerOf(std::size_t mesh, const std::vector<double>& rest) {
    const auto known = samplers_.find({mesh, rest});
    if (known != samplers_.end()) return known->second;
    std::vector<std::size_t> targets;
    for (const Index target : moved_[mesh])
      if (target >= 0) targets.push_back(static_cast<std::size_t>(target));
    Keys keys = options_.motion ? exactKeys(*options_.motion, targets)
                : few_          ? columnsOf(*few_, targets)
                                : framesOf(*options_.clip, targets);
    widen(keys, moved_[mesh], rest);
    const std::vector<double> values = interleaved(keys);
    if (!io::areSingle(keys.times) || !increase(keys.times) || !io::areSingle(values))
      return beyondFloats(keys.times);
    if (!input_) {
      Column times = pack(keys.times, 1);
      times.bounded = true;
      input_ = builder_.add(times, Use::other);
    }
    animation_["samplers"].push_back({{"input", *input_},
                                      {"interpolation", keys.cubic ? "CUBICSPLINE" : "LINEAR"},
                                      {"output", builder_.add(pack(values, 1), Use::other)}});
    return samplers_[{mesh, rest}] = animation_["samplers"].size() - 1;
  }

  BoundScene& scene_;
  std::vector<std::vector<Index>> moved_;  // [meshes][targets]
  const GlbOptions& options_;
  Builder& builder_;
  Json animation_;
  std::optional<CubicKeys> few_;      // of a clip, if wanted
  std::optional<std::size_t> input_;  // the times, the same for all meshes
  std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> samplers_;  // by mesh and rest
};

}  // namespace

Result<void> addAnimation(BoundScene& scene, const GlbOptions& options, Builder& builder) {
  return Animator(scene, options, builder).run();
}

void setWeights(BoundScene& scene, const std::vector<double>& weights) {
  const std::vector<std::vector<Index>> moved = movedTargets(scene);
  const auto set = [&](Json& holder, const std::vector<Index>& targets) {
    if (!movesAny(targets)) return;
    std::vector<double> list =
        weightsOf(holder, targets.size()).value_or(std::vector<double>(targets.size()));
    for (std::size_t t = 0; t < targets.size(); ++t)
      if (targets[t] >= 0) list[t] = weights[targets[t]];
    holder["weights"] = list;
  };
  Json& json = scene.document.json;
  for (std::size_t m = 0; m < moved.size(); ++m) set(json["meshes"][m], moved[m]);
  for (std::size_t n = 0; n < scene.document.list("nodes").size(); ++n)
    if (Json& node = json["nodes"][n]; const auto mesh = findIndex(node, "mesh", moved.size()))
      if (weightsOf(node, moved[*mesh].size()))  // which override those of its mesh
        set(node, moved[*mesh]);
}

}  // namespace sweepface::gltf
