#include "gltf/skins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "gltf/accessor_uses.hpp"
#include "gltf/column.hpp"
#include "gltf/nodes.hpp"

namespace sweepface::gltf {
namespace {

constexpr std::size_t kMatrix = 16;

// ---- Where meshes are ----

/// [meshes] the skin with which every node shows it, if it is the same.
std::vector<std::optional<std::size_t>> skinsOfMeshes(const Document& document) {
  const std::size_t meshes = document.list("meshes").size(), skins = document.list("skins").size();
  std::vector<std::optional<std::size_t>> found(meshes);
  std::vector<bool> isShown(meshes);
  for (const Json& node : document.list("nodes")) {
    const auto mesh = findIndex(node, "mesh", meshes);
    if (!mesh) continue;
    const auto skin = findIndex(node, "skin", skins);
    found[*mesh] = isShown[*mesh] && found[*mesh] != skin ? std::nullopt : skin;
    isShown[*mesh] = true;
  }
  return found;
}

bool isNear(const Affine& a, const Affine& b, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k)
    if (norm(a.axes[k] - b.axes[k]) > tolerance * norm(b.axes[k])) return false;
  return true;
}

double sizeOf(const Affine& a) {
  return std::cbrt(std::abs(dot(cross(a.axes[0], a.axes[1]), a.axes[2])));
}

/// How a skin places what is bound to it; nothing where that is as it stands.
std::optional<Affine> placeAtRest(const Document& document, const std::vector<Affine>& world,
                                  std::size_t skin) {
  const auto matrices = inverseBindMatrices(document, skin);
  const Json& joints = listOf(document.list("skins")[skin], "joints");
  if (!matrices || joints.empty()) return std::nullopt;
  std::vector<Affine> shown;
  double reach = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto joint = asIndex(joints[j], world.size());
    if (!joint) return std::nullopt;
    shown.push_back(world[*joint] * (*matrices)[j]);
    reach = std::max(reach, norm(world[*joint].origin));
    if (!shown[j].isFinite() || shown[j].isSingular() || shown[j].mirrors()) return std::nullopt;
  }
  const Affine& first = shown.front();
  const auto agrees = [&](const Affine& other) { return isNear(other, first, 1e-3); };
  if (std::abs(sizeOf(first) - 1) < 1e-3 && !std::ranges::all_of(shown, agrees))
    return std::nullopt;
  if (isNear(first, {}, 1e-4) && norm(first.origin) <= 1e-4 * reach) return std::nullopt;
  return first;
}

// ---- What is bound ----

class Binder {
 public:
  Binder(Document& document, const Parts& parts, std::vector<bool>& touched)
      : document_(document), touched_(touched), uses_(accessorUseCounts(document)) {
    const auto skins = skinsOfMeshes(document);
    for (const RigMesh& mesh : parts.meshes)
      if (skins[mesh.mesh] && !(mesh.world == Affine{})) placed_[mesh.mesh] = mesh.world;
  }

  void run() {
    if (placed_.empty()) return;
    std::map<std::size_t, Users> users;
    const Json& nodes = document_.list("nodes");
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto skin = findIndex(nodes[n], "skin", document_.list("skins").size());
      const auto mesh = findIndex(nodes[n], "mesh", document_.list("meshes").size());
      if (!skin || !mesh) continue;
      const auto placed = placed_.find(*mesh);
      if (placed == placed_.end())
        users[*skin].others = true;
      else
        users[*skin].nodes.push_back(n), users[*skin].world = placed->second;
    }
    for (const auto& [skin, of] : users)
      if (!of.nodes.empty()) bind(skin, of);
  }

 private:
  /// Nodes that show what is placed by a skin, all by the same matrix, and whether there are other
  /// ones.
  struct Users {
    std::vector<std::size_t> nodes;
    Affine world;
    bool others = false;
  };

  void bind(std::size_t skin, const Users& users) {
    auto matrices = inverseBindMatrices(document_, skin);
    if (!matrices) return;  // nothing would have been placed by them
    for (Affine& matrix : *matrices) matrix = matrix * users.world.inverse();
    Json& skins = document_.json["skins"];
    if (users.others) {
      skins.push_back(Json(skins[skin]));
      skin = skins.size() - 1;
      for (const std::size_t node : users.nodes) document_.json["nodes"][node]["skin"] = skin;
    }
    Json& accessors = document_.json["accessors"];
    const auto known = findIndex(skins[skin], "inverseBindMatrices", accessors.size());
    const bool isOwn = known && !users.others && uses_[*known] == 1;
    if (isOwn && find(accessors[*known], "bufferView"))
      touched_[*asIndex(accessors[*known]["bufferView"], touched_.size())] = true;
    if (!isOwn) accessors.push_back(Json::object());
    Json& accessor = isOwn ? accessors[*known] : accessors.back();
    for (const char* key : {"byteOffset", "sparse", "min", "max", "normalized"})
      accessor.erase(key);
    accessor["bufferView"] = document_.addBuffer(packMatrices(*matrices).bytes);
    accessor["componentType"] = 5126;
    accessor["count"] = matrices->size();
    accessor["type"] = "MAT4";
    skins[skin]["inverseBindMatrices"] = isOwn ? *known : accessors.size() - 1;
  }

  Document& document_;
  std::vector<bool>& touched_;
  std::vector<std::size_t> uses_;
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
  if (accessor->rows != 4 || accessor->columns != 4 || accessor->count < joints)
    return fail("a skin has too few matrices");
  // Skins may share them, but a few bytes could claim many for each of many skins.
  if (accessor->count > 256 + 4 * joints) return fail("a skin has too many matrices");
  const auto values = decode(document, *accessor);
  if (!values) return std::unexpected(values.error());
  std::vector<Affine> matrices;
  for (std::size_t at = 0; at + kMatrix <= values->size(); at += kMatrix) {
    const double* m = values->data() + at;
    const double lastRow = std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1);
    if (!(lastRow <= 1e-5)) return fail("a skin has a matrix whose last row is not 0 0 0 1");
    matrices.push_back(
        {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}});
  }
  return matrices;
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
  const auto world = worldMatrices(document);
  if (!world) return;
  const auto skins = skinsOfMeshes(document);
  std::map<std::size_t, std::optional<Affine>> places;
  for (RigMesh& mesh : parts.meshes) {
    const auto skin = skins[mesh.mesh];
    if (!skin) continue;
    const auto [known, isNew] = places.try_emplace(*skin);
    if (isNew) known->second = placeAtRest(document, *world, *skin);
    if (known->second) mesh.world = *known->second;
  }
}

void bindWherePlaced(Document& document, const Parts& parts, std::vector<bool>& touched) {
  Binder(document, parts, touched).run();
}

}  // namespace sweepface::gltf
