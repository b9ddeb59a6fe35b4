#include "gltf/skins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "gltf/accessor_uses.hpp"
#include "gltf/column.hpp"
#include "gltf/nodes.hpp"

namespace sweepface::gltf {
namespace {

constexpr std::size_t kMatrix = 16;

// ---- Where meshes are ----

/// [meshes] the skin with which all nodes in scenes show each mesh, if it is the same one. For
/// meshes that no node in a scene shows, all other nodes count.
std::vector<std::optional<std::size_t>> skinsOfMeshes(const Document& document) {
  const std::size_t meshes = document.list("meshes").size(), skins = document.list("skins").size();
  std::vector<std::optional<std::size_t>> found(meshes);
  std::vector<bool> isKnown(meshes);
  const std::vector<bool> inScene = nodesOfScenes(document);
  for (const bool ofScene : {true, false}) {
    std::vector<bool> isShown(meshes);
    for (std::size_t n = 0; n < inScene.size(); ++n) {
      const Json& node = document.list("nodes")[n];
      const auto mesh = findIndex(node, "mesh", meshes);
      if (inScene[n] != ofScene || !mesh || isKnown[*mesh]) continue;
      const auto skin = findIndex(node, "skin", skins);
      found[*mesh] = isShown[*mesh] && found[*mesh] != skin ? std::nullopt : skin;
      isShown[*mesh] = true;
    }
    isKnown = std::move(isShown);
  }
  return found;
}

/// The parts of a mesh; parts are in the order of meshes.
std::span<const Part> partsOf(const Parts& parts, std::size_t rigMesh) {
  return std::ranges::equal_range(parts.parts, rigMesh, {},
                                  [&](const Part& part) { return parts.runs[part.run].rigMesh; });
}

/// Whether all primitives of a mesh are parts of the rig: others would stay where they are bound.
bool isAllOfParts(const Document& document, const Parts& parts, std::size_t rigMesh) {
  const Json& mesh = document.list("meshes")[parts.meshes[rigMesh].mesh];
  return partsOf(parts, rigMesh).size() == listOf(mesh, "primitives").size();
}

/// [joints] the weight of each joint, summed over all vertices of a mesh. `left` is how many
/// elements may still be read.
std::vector<double> weightsOfJoints(const Document& document, const Parts& parts,
                                    std::size_t rigMesh, std::size_t joints, std::uint64_t& left) {
  std::vector<double> sums(joints, 0.0);
  const std::size_t accessors = document.list("accessors").size();
  for (const Part& part : partsOf(parts, rigMesh)) {
    const Json& attributes = primitiveOf(document, parts, part)["attributes"];
    for (const auto& [joint, weight] : jointSets(attributes, accessors)) {
      const auto of = [&](std::size_t index) -> std::vector<double> {
        const auto accessor = accessorAt(document, index);
        if (!accessor || accessor->count > left) return {};
        return decode(document, *accessor).value_or(std::vector<double>{});
      };
      const std::vector<double> numbers = of(joint), shares = of(weight);
      left -= std::min<std::uint64_t>(left, numbers.size() / 4);
      for (std::size_t k = 0; k < numbers.size() && k < shares.size(); ++k)
        if (numbers[k] >= 0 && numbers[k] < static_cast<double>(joints))
          sums[static_cast<std::size_t>(numbers[k])] += shares[k];
    }
  }
  return sums;
}

/// Whether two maps agree but for rounding, at places as far from the origin as `reach`.
bool isNear(const Affine& a, const Affine& b, double reach) {
  constexpr double kRounding = 1e-5;
  for (std::size_t k = 0; k < 3; ++k)
    if (norm(a.axes[k] - b.axes[k]) > kRounding * norm(b.axes[k])) return false;
  return norm(a.origin - b.origin) <= kRounding * reach;
}

/// Places what is bound to one skin.
class Placer {
 public:
  Placer(const Document& document, const std::vector<Affine>& world, std::size_t skin) {
    const auto matrices = inverseBindMatrices(document, skin);
    const Json& joints = listOf(document.list("skins")[skin], "joints");
    for (std::size_t j = 0; matrices && j < joints.size(); ++j) {
      const auto joint = asIndex(joints[j], world.size());
      shown_.push_back(joint ? std::optional(world[*joint] * (*matrices)[j]) : std::nullopt);
      if (!joint || !shown_[j]->isFinite()) continue;
      reach_ = std::max({reach_, norm(world[*joint].origin), norm(shown_[j]->origin)});
    }
  }

  std::size_t jointCount() const { return shown_.size(); }

  /// By the joint with the most weight, or by any usable one: a part hidden by a joint of no size
  /// is not far from the others.
  Affine place(const std::vector<double>& weights) {
    const Affine* heaviest = nullptr;
    double most = -1;
    for (std::size_t j = 0; j < shown_.size(); ++j)
      if (weights[j] > most && shown_[j] && shown_[j]->isFinite() && !shown_[j]->isSingular())
        most = weights[j], heaviest = &*shown_[j];
    if (!heaviest) return {};
    // Places that agree but for rounding are the same, so that meshes keep sharing the skin.
    for (const Affine& known : places_)
      if (isNear(*heaviest, known, reach_)) return known;
    // A few bytes could ask for a skin of many joints for each of many meshes.
    if (places_.size() >= kMostPlaces) return {};
    return places_.emplace_back(*heaviest);
  }

 private:
  static constexpr std::size_t kMostPlaces = 64;

  std::vector<std::optional<Affine>> shown_;  // [joints] how each would place it alone
  double reach_ = 0;                          // how far from the origin joints are
  std::vector<Affine> places_ = {Affine{}};
};

// ---- What is bound ----

class Binder {
 public:
  Binder(Document& document, const Parts& parts, std::vector<bool>& touched)
      : document_(document), touched_(touched) {
    const auto skins = skinsOfMeshes(document);
    for (const RigMesh& mesh : parts.meshes)
      if (skins[mesh.mesh] && !(mesh.world == Affine{})) placed_[mesh.mesh] = mesh.world;
  }

  void run() {
    if (placed_.empty()) return;
    uses_ = accessorUseCounts(document_);
    std::map<std::size_t, std::vector<Place>> places;  // of each skin
    const Json& nodes = document_.list("nodes");
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto skin = findIndex(nodes[n], "skin", document_.list("skins").size());
      const auto mesh = findIndex(nodes[n], "mesh", document_.list("meshes").size());
      if (!skin || !mesh) continue;
      const auto placed = placed_.find(*mesh);
      const Affine world = placed == placed_.end() ? Affine{} : placed->second;
      std::vector<Place>& known = places[*skin];
      const auto same = std::ranges::find(known, world, &Place::world);
      (same == known.end() ? known.emplace_back(world) : *same).nodes.push_back(n);
    }
    for (const auto& [skin, of] : places) {
      // Meshes that it did not place keep the skin as it is; if there are none, the first place
      // gets it, after copies for the others.
      const auto keeps = std::ranges::find(of, Affine{}, &Place::world);
      const auto owner = keeps == of.end() ? of.begin() : keeps;
      for (auto place = of.begin(); place != of.end(); ++place)
        if (place != owner) bind(copied(skin, place->nodes), place->world);
      if (keeps == of.end()) bind(skin, owner->world);
    }
  }

 private:
  /// Nodes whose meshes a skin places in the same way.
  struct Place {
    Affine world;
    std::vector<std::size_t> nodes{};
  };

  /// A copy of a skin, for these nodes.
  std::size_t copied(std::size_t skin, const std::vector<std::size_t>& nodes) {
    Json& skins = document_.json["skins"];
    skins.push_back(Json(skins[skin]));
    for (const std::size_t node : nodes) document_.json["nodes"][node]["skin"] = skins.size() - 1;
    if (const auto shared = findIndex(skins[skin], "inverseBindMatrices", uses_.size()))
      ++uses_[*shared];
    return skins.size() - 1;
  }

  void bind(std::size_t skin, const Affine& world) {
    auto matrices = inverseBindMatrices(document_, skin);
    if (!matrices) return;  // then they placed nothing
    for (Affine& matrix : *matrices) matrix = matrix * world.inverse();
    const std::size_t view = document_.addBuffer(packMatrices(*matrices).bytes);
    Json& json = document_.json["skins"][skin];
    Json& accessors = document_.json["accessors"];
    const auto known = findIndex(json, "inverseBindMatrices", uses_.size());
    const bool isOwn = known && uses_[*known] == 1;
    if (known) --uses_[*known];
    if (isOwn && find(accessors[*known], "bufferView"))
      touched_[*asIndex(accessors[*known]["bufferView"], touched_.size())] = true;
    if (!isOwn) accessors.push_back(Json::object());
    Json& accessor = isOwn ? accessors[*known] : accessors.back();
    for (const char* key : {"byteOffset", "sparse", "min", "max", "normalized"})
      accessor.erase(key);
    accessor["bufferView"] = view;
    accessor["componentType"] = static_cast<int>(Component::float32);
    accessor["count"] = matrices->size();
    accessor["type"] = "MAT4";
    json["inverseBindMatrices"] = isOwn ? *known : accessors.size() - 1;
  }

  Document& document_;
  std::vector<bool>& touched_;
  std::vector<std::size_t> uses_;         // of accessors
  std::map<std::size_t, Affine> placed_;  // by mesh
};

}  // namespace

Result<std::vector<Affine>> inverseBindMatrices(const Document& document, std::size_t skin) {
  const Json& json = document.list("skins")[skin];
  const std::size_t joints = listOf(json, "joints").size();
  if (!find(json, "inverseBindMatrices")) return std::vector<Affine>(joints);
  const auto index = findIndex(json, "inverseBindMatrices", document.list("accessors").size());
  if (!index) return fail("the matrices of a skin are not in the file");
  const auto accessor = accessorAt(document, *index);
  if (!accessor) return std::unexpected(accessor.error());
  if (accessor->rows != 4 || accessor->columns != 4)
    return fail("the inverseBindMatrices of a skin are no matrices of 4 x 4");
  if (accessor->count < joints) return fail("a skin has too few matrices");
  // Skins may share them, but a few bytes could claim many for each of many skins.
  if (accessor->count > 256 + 4 * joints) return fail("a skin has too many matrices");
  const auto values = decode(document, *accessor);
  if (!values) return std::unexpected(values.error());
  std::vector<Affine> matrices;
  for (std::size_t at = 0; at + kMatrix <= values->size(); at += kMatrix) {
    const auto m = std::span(*values).subspan(at).first<kMatrix>();
    const double lastRow = std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1);
    if (!(lastRow <= 1e-5)) return fail("a skin has a matrix whose last row is not 0 0 0 1");
    matrices.push_back(affineOf(m));
  }
  return matrices;
}

std::vector<std::pair<std::size_t, std::size_t>> jointSets(const Json& attributes,
                                                           std::size_t accessors) {
  std::vector<std::pair<std::size_t, std::size_t>> sets;
  for (;;) {
    const std::string number = std::to_string(sets.size());
    const auto joint = findIndex(attributes, "JOINTS_" + number, accessors),
               weight = findIndex(attributes, "WEIGHTS_" + number, accessors);
    if (!joint || !weight) return sets;
    sets.emplace_back(*joint, *weight);
  }
}

Column packMatrices(const std::vector<Affine>& matrices) {
  std::vector<double> numbers;
  for (const Affine& m : matrices) {
    for (const Vec3& axis : m.axes) numbers.insert(numbers.end(), {axis.x, axis.y, axis.z, 0});
    numbers.insert(numbers.end(), {m.origin.x, m.origin.y, m.origin.z, 1});
  }
  return pack(numbers, kMatrix);
}

void placeBySkins(const Document& document, Parts& parts) {
  const auto skins = skinsOfMeshes(document);
  if (std::ranges::none_of(skins, [](const auto& skin) { return skin.has_value(); })) return;
  const auto world = worldMatrices(document);
  if (!world) return;
  std::map<std::size_t, Placer> placers;
  std::uint64_t left = document.mostElements();
  for (std::size_t m = 0; m < parts.meshes.size(); ++m) {
    const auto skin = skins[parts.meshes[m].mesh];
    if (!skin || !isAllOfParts(document, parts, m)) continue;
    Placer& placer = placers.try_emplace(*skin, document, *world, *skin).first->second;
    parts.meshes[m].world =
        placer.place(weightsOfJoints(document, parts, m, placer.jointCount(), left));
  }
}

void bindWherePlaced(Document& document, const Parts& parts, std::vector<bool>& touched) {
  Binder(document, parts, touched).run();
}

}  // namespace sweepface::gltf
