#include "gltf/accessor_uses.hpp"

#include <fmt/format.h>
#include <set>

#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

/// Called with every reference to an accessor; `attribute` is its name within a primitive, and
/// `primitive` is null outside meshes.
using Visit =
    std::function<void(const Json& reference, std::string_view attribute, const Json* primitive)>;

void visitMember(const Json& object, std::string_view key, const Json* primitive,
                 const Visit& visit) {
  if (const Json* const reference = find(object, key)) visit(*reference, key, primitive);
}

void visitAttributes(const Json& attributes, const Json* primitive, const Visit& visit) {
  if (!attributes.is_object()) return;
  for (const auto& [name, reference] : attributes.items()) visit(reference, name, primitive);
}

void visitPrimitive(const Json& primitive, const Visit& visit) {
  visitMember(primitive, "indices", &primitive, visit);
  if (const Json* const attributes = find(primitive, "attributes"))
    visitAttributes(*attributes, &primitive, visit);
  for (const Json& target : listOf(primitive, "targets"))
    visitAttributes(target, &primitive, visit);
}

/// The attributes of a node's instances of a mesh, or null.
const Json* instancesOf(const Json& node) {
  const Json* const extensions = find(node, "extensions");
  const Json* const instances = extensions ? find(*extensions, "EXT_mesh_gpu_instancing") : nullptr;
  return instances ? find(*instances, "attributes") : nullptr;
}

void visitAll(const Document& document, const Visit& visit) {
  for (const Json& mesh : document.list("meshes"))
    for (const Json& primitive : listOf(mesh, "primitives")) visitPrimitive(primitive, visit);
  for (const Json& skin : document.list("skins"))
    visitMember(skin, "inverseBindMatrices", nullptr, visit);
  for (const Json& animation : document.list("animations"))
    for (const Json& sampler : listOf(animation, "samplers"))
      for (const char* key : {"input", "output"}) visitMember(sampler, key, nullptr, visit);
  for (const Json& node : document.list("nodes"))
    if (const Json* const attributes = instancesOf(node))
      visitAttributes(*attributes, nullptr, visit);
}

}  // namespace

std::vector<bool> usedAccessors(const Document& document, const Parts& parts,
                                const CountsInParts& counts) {
  std::set<const Json*> ofParts;
  for (const Part& part : parts.parts) ofParts.insert(&primitiveOf(document, parts, part));
  std::vector<bool> used(document.list("accessors").size());
  visitAll(document, [&](const Json& reference, std::string_view name, const Json* primitive) {
    if (ofParts.contains(primitive) && !counts(name, reference)) return;
    if (const auto index = asIndex(reference, used.size())) used[*index] = true;
  });
  return used;
}

std::vector<std::size_t> accessorUseCounts(const Document& document) {
  std::vector<std::size_t> counts(document.list("accessors").size());
  visitAll(document, [&](const Json& reference, std::string_view, const Json*) {
    if (const auto index = asIndex(reference, counts.size())) ++counts[*index];
  });
  return counts;
}

Result<void> checkAccessorUses(const Document& document) {
  const std::size_t count = document.list("accessors").size();
  Result<void> result;
  visitAll(document, [&](const Json& reference, std::string_view name, const Json*) {
    if (result && !asIndex(reference, count))
      result = fail(fmt::format(
          "{} names an accessor that does not exist (there are {}); export the glTF again.",
          io::inQuotes(name), count));
  });
  return result;
}

}  // namespace sweepface::gltf
