#include "gltf/references.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <span>

#include "gltf/accessor.hpp"
#include "gltf/accessor_uses.hpp"
#include "gltf/skins.hpp"

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

/// A member of the objects of one list that is an index into another.
struct Reference {
  const char *holder, *holders, *key, *things;
};
constexpr Reference kReferences[] = {
    {"node", "nodes", "mesh", "meshes"},         {"node", "nodes", "skin", "skins"},
    {"node", "nodes", "camera", "cameras"},      {"skin", "skins", "skeleton", "nodes"},
    {"texture", "textures", "source", "images"}, {"texture", "textures", "sampler", "samplers"}};

/// The same for members that are lists of indices.
constexpr Reference kLists[] = {{"scene", "scenes", "nodes", "nodes"},
                                {"skin", "skins", "joints", "nodes"}};

/// Calls `check(members, count of the other list, reference)` for every object that may have one.
template <typename Check>
Result<void> checkHolders(const Document& document, std::span<const Reference> references,
                          Check check) {
  for (const Reference& reference : references) {
    const Json& list = document.list(reference.holders);
    const std::size_t count = document.list(reference.things).size();
    for (std::size_t k = 0; k < list.size(); ++k) {
      Members in(list[k], fmt::format("{} {}", reference.holder, k));
      check(in, count, reference);
      if (!in.ok()) return in.error();
    }
  }
  return {};
}

Result<void> checkObjects(const Document& document) {
  Members top(document.json, "its root");
  top.optionalIndex("scene", document.list("scenes").size(), "scenes");
  if (!top.ok()) return top.error();
  const auto one = [](Members& in, std::size_t count, const Reference& to) {
    in.optionalIndex(to.key, count, to.things);
  };
  if (auto ok = checkHolders(document, kReferences, one); !ok) return ok;
  return checkHolders(document, kLists, [](Members& in, std::size_t count, const Reference& to) {
    for (const Json& entry : in.array(to.key))
      if (!asIndex(entry, count))
        in.refuse(fmt::format("one of its {} is none of the {} {}", to.key, count, to.things));
  });
}

Result<void> checkMaterials(const Document& document) {
  const Json& meshes = document.list("meshes");
  const std::size_t count = document.list("materials").size();
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const Json& primitive : listOf(meshes[m], "primitives")) {
      Members in(primitive, fmt::format("mesh {}", m));
      in.optionalIndex("material", count, "materials");
      if (!in.ok()) return in.error();
    }
  return {};
}

// ---- Animations ----

class AnimationChecker {
 public:
  explicit AnimationChecker(const Document& document)
      : accessors_(document.list("accessors")), nodes_(document.list("nodes").size()) {}

  Result<void> check(const Json& animation, const std::string& place) const {
    Members in(animation, place);
    const Json &samplers = in.array("samplers"), &channels = in.array("channels");
    if (!in.ok()) return in.error();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Members channel(channels[c], fmt::format("{}, channel {}", place, c));
      Members target(channel.object("target"), channel.place());
      const std::size_t sampler = channel.index("sampler", samplers.size(), "samplers");
      target.optionalIndex("node", nodes_, "nodes");
      const std::string_view path = target.text("path");
      if (!channel.ok()) return channel.error();
      if (!target.ok()) return target.error();
      Members values(samplers[sampler], fmt::format("{}, sampler {}", place, sampler));
      if (auto ok = checkValues(values, path); !ok) return ok;
    }
    return {};
  }

 private:
  /// One value for each key, or three with tangents; several for weights and for what extensions
  /// animate.
  Result<void> checkValues(Members& in, std::string_view path) const {
    const std::size_t keys = countOf(in, "input"), values = countOf(in, "output");
    const std::size_t row = (in.text("interpolation") == "CUBICSPLINE" ? 3 : 1) * keys;
    const bool isOne = path == "translation" || path == "rotation" || path == "scale";
    if (in.ok() && row > 0 && (isOne ? values != row : values % row != 0))
      in.refuse(fmt::format("it has {} values for {} keys", values, keys));
    return in.ok() ? Result<void>{} : in.error();
  }

  std::size_t countOf(Members& in, std::string_view key) const {
    const std::size_t index = in.index(key, accessors_.size(), "accessors");
    if (!in.ok()) return 0;
    Members accessor(accessors_[index], fmt::format("accessor {}", index));
    return accessor.size("count");
  }

  const Json& accessors_;
  std::size_t nodes_;
};

Result<void> checkAnimations(const Document& document) {
  const AnimationChecker checker(document);
  const Json& animations = document.list("animations");
  for (std::size_t a = 0; a < animations.size(); ++a)
    if (auto ok = checker.check(animations[a], fmt::format("animation {}", a)); !ok) return ok;
  return {};
}

// ---- Skins ----

/// Reads matrices, and pairs of joints and weights, once each, and no more in all than a file of
/// this size can mean.
class SkinChecker {
 public:
  explicit SkinChecker(const Document& document)
      : document_(document),
        meshes_(document.list("meshes")),
        skins_(document.list("skins")),
        accessors_(document.list("accessors").size()),
        left_(document.mostElements()) {}

  Result<void> run() {
    if (auto ok = checkMatrices(); !ok) return ok;
    std::map<std::size_t, double> lastOfMeshes;  // joints
    for (const Json& node : document_.list("nodes")) {
      const auto mesh = findIndex(node, "mesh", meshes_.size()),
                 skin = findIndex(node, "skin", skins_.size());
      if (!mesh || !skin) continue;
      const auto [last, isNew] = lastOfMeshes.try_emplace(*mesh, -1.0);
      if (isNew)
        if (auto ok = findLastJoint(*mesh, last->second); !ok) return ok;
      const std::size_t joints = listOf(skins_[*skin], "joints").size();
      if (last->second >= static_cast<double>(joints))
        return fail(fmt::format(
            "mesh {}: a vertex hangs on joint {} of skin {}, which has {}; export the file again.",
            *mesh, last->second, *skin, joints));
    }
    return {};
  }

 private:
  Result<void> checkMatrices() {
    std::set<std::size_t> known;
    for (const Json& skin : skins_)
      if (const auto index = findIndex(skin, "inverseBindMatrices", accessors_))
        if (known.insert(*index).second)
          if (const auto read = numbers(*index); !read) return std::unexpected(read.error());
    return {};
  }

  Result<void> findLastJoint(std::size_t mesh, double& last) {
    for (const Json& primitive : listOf(meshes_[mesh], "primitives"))
      if (const Json* const attributes = find(primitive, "attributes"))
        for (const auto& [joints, weights] : jointSets(*attributes, accessors_)) {
          const auto found = lastJoint(joints, weights);
          if (!found) return std::unexpected(found.error());
          last = std::max(last, *found);
        }
    return {};
  }

  /// The last joint that has any weight.
  Result<double> lastJoint(std::size_t joint, std::size_t weight) {
    const auto [known, isNew] = lastOfSets_.try_emplace(std::pair(joint, weight), 0.0);
    if (!isNew) return known->second;
    const auto joints = numbers(joint), weights = numbers(weight);
    if (!joints) return std::unexpected(joints.error());
    if (!weights) return std::unexpected(weights.error());
    for (std::size_t k = 0; k < std::min(joints->size(), weights->size()); ++k)
      if ((*weights)[k] > 0) known->second = std::max(known->second, (*joints)[k]);
    return known->second;
  }

  Result<std::vector<double>> numbers(std::size_t index) {
    const auto accessor = accessorAt(document_, index);
    if (!accessor) return std::unexpected(accessor.error());
    if (accessor->count > left_ / accessor->components()) return std::vector<double>{};
    left_ -= accessor->count * accessor->components();
    return decode(document_, *accessor);
  }

  const Document& document_;
  const Json &meshes_, &skins_;
  std::size_t accessors_;
  std::uint64_t left_;                                                // numbers that may be read
  std::map<std::pair<std::size_t, std::size_t>, double> lastOfSets_;  // joints, by accessors
};

}  // namespace

Result<void> checkReferences(const Document& document) {
  for (const auto check :
       {checkViews, checkAccessorUses, checkObjects, checkMaterials, checkAnimations})
    if (auto ok = check(document); !ok) return ok;
  return SkinChecker(document).run();
}

}  // namespace sweepface::gltf
