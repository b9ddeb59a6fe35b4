#include "gltf/parts.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

#include "codec/utf8.hpp"
#include "gltf/chosen_meshes.hpp"
#include "gltf/nodes.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {

std::string placeOf(const Document& document, std::size_t mesh) {
  const Json* const name = find(document.list("meshes")[mesh], "name");
  if (!name || !name->is_string()) return fmt::format("mesh {}", mesh);
  return fmt::format("mesh {} {}", mesh, io::inQuotes(name->get_ref<const std::string&>()));
}

namespace {

struct Placement {
  Affine world;
  bool mirrors = false;
};

/// [meshes] how the first node that shows each mesh places it, preferably one in a scene. A skin
/// ignores its node's transform, though not whether that mirrors (glTF 2.0, 3.7.4).
Result<std::vector<Placement>> placements(const Document& document) {
  const Json& nodes = document.list("nodes");
  const std::size_t count = document.list("meshes").size();
  const auto world = worldMatrices(document);
  if (!world) return std::unexpected(world.error());
  std::vector<Placement> placed(count);
  std::vector<bool> seen(count);
  const std::vector<bool> isShown = nodesOfScenes(document);
  for (const bool shown : {true, false})
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      Members in(nodes[n], fmt::format("node {}", n));
      const auto mesh = in.optionalIndex("mesh", count, "meshes");
      if (!in.ok()) return in.error();
      if (isShown[n] != shown || !mesh || seen[*mesh]) continue;
      seen[*mesh] = true;
      placed[*mesh] = {in.has("skin") ? Affine{} : (*world)[n], (*world)[n].mirrors()};
    }
  return placed;
}

/// What a primitive refers to, checked.
struct Primitive {
  std::size_t index = 0, count = 0, position = 0;
  std::vector<std::optional<std::size_t>> targets;
};

class PartFinder {
 public:
  PartFinder(const Document& document, bool anywhere)
      : document_(document), meshes_(document.list("meshes")), anywhere_(anywhere) {}

  Result<Parts> find() {
    const auto placed = placements(document_);
    if (!placed) return std::unexpected(placed.error());
    const auto ofFace = facePrimitives();
    if (!ofFace) return std::unexpected(ofFace.error());
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      if (auto ok = addMesh(m, (*placed)[m], (*ofFace)[m]); !ok) return std::unexpected(ok.error());
    if (parts_.parts.empty())
      return fail("it has no triangles; export the meshes of the face with the file.");
    return std::move(parts_);
  }

 private:
  std::string place(std::size_t mesh, std::size_t primitive) const {
    return gltf::placeOf(document_, mesh, primitive);
  }

  /// Primitives of a mesh that are triangles.
  struct Triangles {
    std::vector<std::size_t> all, morphing;  // those with targets
  };

  Result<Triangles> triangles(std::size_t mesh) const {
    Triangles found;
    Members in(meshes_[mesh], placeOf(document_, mesh));
    const Json& primitives = in.array("primitives");
    if (!in.ok()) return in.error();
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      Members primitive(primitives[p], place(mesh, p));
      const std::size_t mode = primitive.size("mode", listMode);
      const bool morphs = !primitive.array("targets").empty();
      if (!primitive.ok()) return primitive.error();
      if (mode < listMode || mode > fanMode) continue;
      found.all.push_back(p);
      if (morphs) found.morphing.push_back(p);
    }
    return found;
  }

  /// [meshes] the primitives that are the face.
  Result<std::vector<std::vector<std::size_t>>> facePrimitives() const {
    const auto isChosen = chosenMeshes(document_);
    if (!isChosen) return std::unexpected(isChosen.error());
    const bool isChoice = !isChosen->empty();
    std::vector<Triangles> found(meshes_.size());
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      if (isChoice && !(*isChosen)[m]) continue;
      auto own = triangles(m);
      if (!own) return std::unexpected(own.error());
      found[m] = std::move(*own);
      if (isChoice && found[m].all.empty())
        return fail(placeOf(document_, m) + ": it has no triangles; choose other meshes.");
    }
    const auto morphs = [](const Triangles& own) { return !own.morphing.empty(); };
    const bool anyMorphs = std::ranges::any_of(found, morphs);
    std::vector<std::vector<std::size_t>> primitives;
    for (Triangles& own : found)
      primitives.push_back((isChoice ? morphs(own) : anyMorphs) ? std::move(own.morphing)
                                                                : std::move(own.all));
    return primitives;
  }

  Result<void> addMesh(std::size_t mesh, const Placement& placed,
                       const std::vector<std::size_t>& found) {
    if (found.empty()) return {};
    if (!anywhere_ && (!placed.world.isFinite() || placed.world.isSingular()))
      return fail(
          fmt::format("{}: its node flattens it or has no finite matrix; apply its "
                      "transform and export the file again.",
                      placeOf(document_, mesh)));
    std::vector<Primitive> primitives;
    for (const std::size_t p : found) {
      auto primitive = readPrimitive(mesh, p);
      if (!primitive) return std::unexpected(primitive.error());
      if (!primitives.empty() && primitive->targets.size() != primitives[0].targets.size())
        return fail(
            fmt::format("{}: it has {} morph targets, but the mesh's first one {}; export "
                        "the file again.",
                        place(mesh, p), primitive->targets.size(), primitives[0].targets.size()));
      primitives.push_back(std::move(*primitive));
    }
    auto names = nameTargets(mesh, primitives[0]);
    if (!names) return std::unexpected(names.error());
    parts_.meshes.push_back({mesh, std::move(*names), placed.world, placed.mirrors});
    addRuns(primitives);
    if (parts_.vertexCount > io::maxFileBytes) return tooMany();
    return {};
  }

  static std::unexpected<Error> tooMany() {
    return fail("it has more vertices than an index can count; export only the face.");
  }

  Result<Primitive> readPrimitive(std::size_t mesh, std::size_t index) const {
    const Json& json = meshes_[mesh]["primitives"][index];
    const std::string here = place(mesh, index);
    Members in(json, here);
    Primitive primitive;
    primitive.index = index;
    Members attributes(in.object("attributes"), here);
    if (gltf::find(in.object("extensions"), "KHR_draco_mesh_compression"))
      return fail(std::string(dracoRefusal));
    if (in.ok() && !attributes.has("POSITION")) in.refuse("it has triangles without POSITION");
    if (!in.ok()) return in.error();
    primitive.position =
        attributes.index("POSITION", document_.list("accessors").size(), "accessors");
    if (!attributes.ok()) return attributes.error();
    const auto position = accessorAt(document_, primitive.position);
    if (!position) return std::unexpected(position.error());
    primitive.count = position->count;
    if (primitive.count > io::maxFileBytes) return tooMany();
    if (auto ok = checkAttributes(in.object("attributes"), primitive, here); !ok)
      return std::unexpected(ok.error());

    const Json& targets = in.array("targets");
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const std::string where = fmt::format("{}, target {}", here, t);
      if (auto ok = checkAttributes(targets[t], primitive, where); !ok)
        return std::unexpected(ok.error());
      const Json* const moved = gltf::find(targets[t], "POSITION");
      primitive.targets.push_back(moved ? asIndex(*moved, document_.list("accessors").size())
                                        : std::nullopt);
    }
    return primitive;
  }

  /// Checks that every attribute has one element per vertex.
  Result<void> checkAttributes(const Json& attributes, const Primitive& primitive,
                               const std::string& where) const {
    Members in(attributes, where);
    if (!in.ok()) return in.error();
    for (const auto& [name, number] : attributes.items()) {
      const auto index = asIndex(number, document_.list("accessors").size());
      if (!index) in.refuse(fmt::format("its {} is none of the accessors", io::inQuotes(name)));
      if (!in.ok()) return in.error();
      const auto accessor = accessorAt(document_, *index);
      if (!accessor) return std::unexpected(accessor.error());
      if (accessor->count != primitive.count)
        in.refuse(fmt::format("its {} has {} elements, but POSITION {}", io::inQuotes(name),
                              accessor->count, primitive.count));
      const bool vector = accessor->rows == 3 && accessor->columns == 1;
      if ((name == "POSITION" || name == "NORMAL") && !vector)
        in.refuse(fmt::format("its {} is not of type VEC3", name));
      if (!in.ok()) return in.error();
    }
    return {};
  }

  /// Names of a mesh's targets: in its extras, as is customary, or in those of its primitives.
  std::vector<std::string> namesOf(std::size_t mesh, const Primitive& primitive) {
    const Json* given = nullptr;
    for (const Json* holder : {&meshes_[mesh], &meshes_[mesh]["primitives"][primitive.index]})
      if (const Json* extras = gltf::find(*holder, "extras"); extras && !given)
        if (const Json* list = gltf::find(*extras, "targetNames"); list && list->is_array())
          given = list;
    std::vector<std::string> names(primitive.targets.size());
    for (std::size_t t = 0; given && t < std::min(names.size(), given->size()); ++t)
      if (const Json& name = (*given)[t]; name.is_string()) names[t] = name.get<std::string>();
    const auto lacking =
        std::ranges::count_if(names, [](const auto& name) { return io::trimmed(name).empty(); });
    if (given && lacking > 0)
      parts_.warnings.push_back(
          fmt::format("{}: {} of its {} morph targets have no name in targetNames, and are called "
                      "by their numbers.",
                      placeOf(document_, mesh), lacking, names.size()));
    std::set<std::string> taken(names.begin(), names.end());
    std::size_t free = 0;  // the numbers from t up to it are taken
    for (std::size_t t = 0; t < names.size(); ++t) {
      free = std::max(free, t);
      while (io::trimmed(names[t]).empty())
        if (std::string name = fmt::format("target_{}", free++); taken.insert(name).second)
          names[t] = std::move(name);
    }
    return names;
  }

  Result<std::vector<std::size_t>> nameTargets(std::size_t mesh, const Primitive& primitive) {
    std::set<std::string> own;
    std::vector<std::size_t> targets;
    for (const std::string& name : namesOf(mesh, primitive)) {
      if (!own.insert(name).second)
        return fail(fmt::format("{}: two of its morph targets are named {}; rename one of them.",
                                placeOf(document_, mesh), io::inQuotes(name)));
      if (!codec::isUtf8(name))
        return fail(
            fmt::format("{}: the name {} of a morph target has control characters; rename "
                        "it.",
                        placeOf(document_, mesh), io::inQuotes(name)));
      const auto [known, isNew] = numbers_.emplace(name, parts_.targets.size());
      if (isNew) parts_.targets.push_back(name);
      targets.push_back(known->second);
    }
    return targets;
  }

  void addRuns(const std::vector<Primitive>& primitives) {
    std::map<std::pair<std::size_t, std::vector<std::optional<std::size_t>>>, std::size_t> known;
    for (const Primitive& p : primitives) {
      const auto [run, isNew] = known.emplace(std::pair(p.position, p.targets), parts_.runs.size());
      if (isNew) {
        parts_.runs.push_back(
            {parts_.meshes.size() - 1, parts_.vertexCount, p.count, p.position, p.targets});
        parts_.vertexCount += p.count;
      }
      parts_.parts.push_back({run->second, p.index});
    }
  }

  const Document& document_;
  const Json& meshes_;
  bool anywhere_;
  Parts parts_;
  std::map<std::string, std::size_t> numbers_;  // of target names
};

}  // namespace

std::string placeOf(const Document& document, std::size_t mesh, std::size_t primitive) {
  return fmt::format("{}, primitive {}", placeOf(document, mesh), primitive);
}

const Json& primitiveOf(const Document& document, const Parts& parts, const Part& part) {
  const std::size_t mesh = parts.meshes[parts.runs[part.run].rigMesh].mesh;
  return document.list("meshes")[mesh]["primitives"][part.primitive];
}

Json& primitiveOf(Document& document, const Parts& parts, const Part& part) {
  return const_cast<Json&>(primitiveOf(std::as_const(document), parts, part));
}

bool countsOnOrder(std::string_view extension) {
  constexpr std::array names{"KHR_materials_variants", "EXT_mesh_features",
                             "EXT_structural_metadata"};
  return std::ranges::find(names, extension) == names.end();
}

Result<Parts> findParts(const Document& document) { return PartFinder(document, false).find(); }
Result<Parts> findPartsAnywhere(const Document& document) {
  return PartFinder(document, true).find();
}

}  // namespace sweepface::gltf
