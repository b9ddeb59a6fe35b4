#include "gltf/references.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

#include "gltf/accessor.hpp"
#include "gltf/accessor_uses.hpp"

namespace sweepface::gltf {
namespace {

Result<void> checkViews(const Document& document) {
  for (const char* list : {"images", "accessors"}) {
    const Json& holders = document.list(list);
    for (std::size_t k = 0; k < holders.size(); ++k)
      if (const Json* const view = find(holders[k], "bufferView"))
        if (!asIndex(*view, document.views.size()))
          return fail(fmt::format(
              "{} {}: its bufferView does not exist (there are {}); export the glTF again.", list,
              k, document.views.size()));
  }
  return {};
}

// ---- Lists ----

/// The members of the objects of a list that are indices of another one.
struct Reference {
  const char *holder, *holders, *key, *things;
};
constexpr Reference kReferences[] = {
    {"node", "nodes", "mesh", "meshes"},         {"node", "nodes", "skin", "skins"},
    {"node", "nodes", "camera", "cameras"},      {"skin", "skins", "skeleton", "nodes"},
    {"texture", "textures", "source", "images"}, {"texture", "textures", "sampler", "samplers"}};

/// The same where they are lists of indices.
constexpr Reference kLists[] = {{"scene", "scenes", "nodes", "nodes"},
                                {"skin", "skins", "joints", "nodes"}};

Result<void> checkLists(const Document& document) {
  Members top(document.json, "its root");
  top.optionalIndex("scene", document.list("scenes").size(), "scenes");
  if (!top.ok()) return top.error();
  for (const auto& [holder, holders, key, things] : kReferences)
    for (std::size_t k = 0; k < document.list(holders).size(); ++k) {
      Members in(document.list(holders)[k], fmt::format("{} {}", holder, k));
      in.optionalIndex(key, document.list(things).size(), things);
      if (!in.ok()) return in.error();
    }
  for (const auto& [holder, holders, key, things] : kLists)
    for (std::size_t k = 0; k < document.list(holders).size(); ++k) {
      Members in(document.list(holders)[k], fmt::format("{} {}", holder, k));
      const std::size_t count = document.list(things).size();
      for (const Json& entry : in.array(key))
        if (!asIndex(entry, count))
          in.refuse(fmt::format("one of its {} is none of the {} {}", key, count, things));
      if (!in.ok()) return in.error();
    }
  return {};
}

// ---- Animations ----

class AnimationChecker {
 public:
  AnimationChecker(const Document& document, std::size_t number)
      : document_(document), in_(document.list("animations")[number], placeOf(number)) {}

  Result<void> run() {
    const Json &samplers = in_.array("samplers"), &channels = in_.array("channels");
    if (!in_.ok()) return in_.error();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Members channel(channels[c], fmt::format("{}, channel {}", in_.place(), c));
      Members target(channel.object("target"), channel.place());
      const std::size_t sampler = channel.index("sampler", samplers.size(), "samplers");
      target.optionalIndex("node", document_.list("nodes").size(), "nodes");
      const std::string_view path = target.text("path");
      if (!channel.ok()) return channel.error();
      if (!target.ok()) return target.error();
      if (auto ok = checkValues(samplers[sampler], sampler, path); !ok) return ok;
    }
    return {};
  }

 private:
  static std::string placeOf(std::size_t number) { return fmt::format("animation {}", number); }

  /// One value for each key, or three with tangents; of weights, and what extensions move, several.
  Result<void> checkValues(const Json& json, std::size_t number, std::string_view path) {
    Members in(json, fmt::format("{}, sampler {}", in_.place(), number));
    const std::size_t keys = countOf(in, "input"), values = countOf(in, "output");
    const std::size_t row = (in.text("interpolation") == "CUBICSPLINE" ? 3 : 1) * keys;
    const bool isOne = path == "translation" || path == "rotation" || path == "scale";
    if (in.ok() && row > 0 && (isOne ? values != row : values % row != 0))
      in.refuse(fmt::format("it has {} values for {} keys", values, keys));
    return in.ok() ? Result<void>{} : in.error();
  }

  std::size_t countOf(Members& in, std::string_view key) const {
    const Json& accessors = document_.list("accessors");
    const auto index = in.index(key, accessors.size(), "accessors");
    if (!in.ok()) return 0;
    Members accessor(accessors[index], fmt::format("accessor {}", index));
    return accessor.size("count");
  }

  const Document& document_;
  Members in_;
};

// ---- Skins ----

/// Reads each accessor once, and no more in all than a file of this size can mean.
class SkinChecker {
 public:
  explicit SkinChecker(const Document& document)
      : document_(document), left_(document.mostElements()) {}

  Result<void> run() {
    const std::size_t accessors = document_.list("accessors").size();
    std::set<std::size_t> matrices;
    for (const Json& skin : document_.list("skins"))
      if (const auto index = findIndex(skin, "inverseBindMatrices", accessors))
        if (matrices.insert(*index).second)
          if (const auto read = numbers(*index); !read) return std::unexpected(read.error());
    std::map<std::size_t, double> lastJoints;  // of meshes
    for (const Json& node : document_.list("nodes")) {
      const auto mesh = findIndex(node, "mesh", document_.list("meshes").size()),
                 skin = findIndex(node, "skin", document_.list("skins").size());
      if (!mesh || !skin) continue;
      const auto [last, isNew] = lastJoints.try_emplace(*mesh, -1.0);
      if (isNew)
        if (auto ok = findLastJoint(*mesh, last->second); !ok) return ok;
      const std::size_t joints = listOf(document_.list("skins")[*skin], "joints").size();
      if (last->second >= static_cast<double>(joints))
        return fail(fmt::format(
            "mesh {}: a vertex hangs on joint {} of skin {}, which has {}; export the file again.",
            *mesh, last->second, *skin, joints));
    }
    return {};
  }

 private:
  Result<void> findLastJoint(std::size_t mesh, double& last) {
    for (const Json& primitive : listOf(document_.list("meshes")[mesh], "primitives"))
      for (int set = 0;; ++set) {
        const auto found = lastJoint(primitive, set);
        if (!found) return std::unexpected(found.error());
        if (*found < 0) break;
        last = std::max(last, *found);
      }
    return {};
  }

  /// The last joint that counts in a set of four; -1 where there is no such set.
  Result<double> lastJoint(const Json& primitive, int set) {
    const Json* const attributes = find(primitive, "attributes");
    if (!attributes) return -1;
    const std::size_t accessors = document_.list("accessors").size();
    const auto joint = findIndex(*attributes, fmt::format("JOINTS_{}", set), accessors),
               weight = findIndex(*attributes, fmt::format("WEIGHTS_{}", set), accessors);
    if (!joint || !weight) return -1;
    const auto [known, isNew] = lastJoints_.try_emplace(std::pair(*joint, *weight), 0.0);
    if (!isNew) return known->second;
    const auto joints = numbers(*joint), weights = numbers(*weight);
    if (!joints) return std::unexpected(joints.error());
    if (!weights) return std::unexpected(weights.error());
    for (std::size_t k = 0; k < std::min(joints->size(), weights->size()); ++k)
      if ((*weights)[k] > 0) known->second = std::max(known->second, (*joints)[k]);
    return known->second;
  }

  Result<std::vector<double>> numbers(std::size_t index) {
    const auto accessor = accessorAt(document_, index);
    if (!accessor) return std::unexpected(accessor.error());
    if (accessor->count > left_) return std::vector<double>{};
    left_ -= accessor->count;
    return decode(document_, *accessor);
  }

  const Document& document_;
  std::size_t left_;                                                  // elements that may be read
  std::map<std::pair<std::size_t, std::size_t>, double> lastJoints_;  // by joints and weights
};

}  // namespace

Result<void> checkReferences(const Document& document) {
  if (auto ok = checkViews(document); !ok) return ok;
  if (auto ok = checkAccessorUses(document); !ok) return ok;
  if (auto ok = checkLists(document); !ok) return ok;
  for (std::size_t a = 0; a < document.list("animations").size(); ++a)
    if (auto ok = AnimationChecker(document, a).run(); !ok) return ok;
  return SkinChecker(document).run();
}

}  // namespace sweepface::gltf
