#include "gltf/accessor_uses.hpp"

#include <set>

namespace sweepface::gltf {
namespace {

class Marker {
 public:
  explicit Marker(std::size_t accessors) : used_(accessors) {}

  void addMember(const Json& object, std::string_view key) {
    if (const Json* const reference = find(object, key)) add(*reference);
  }
  void addAttributes(const Json& attributes, const CountsInParts& counts) {
    if (!attributes.is_object()) return;
    for (const auto& [name, reference] : attributes.items())
      if (counts(name)) add(reference);
  }
  void addPrimitive(const Json& primitive, const CountsInParts& counts) {
    if (counts("indices")) addMember(primitive, "indices");
    if (const Json* const attributes = find(primitive, "attributes"))
      addAttributes(*attributes, counts);
    for (const Json& target : listOf(primitive, "targets")) addAttributes(target, counts);
  }

  std::vector<bool> take() { return std::move(used_); }

 private:
  void add(const Json& reference) {
    if (const auto index = asIndex(reference, used_.size())) used_[*index] = true;
  }

  std::vector<bool> used_;
};

bool always(std::string_view) { return true; }

/// The attributes of many copies of a mesh.
const Json* instancesOf(const Json& node) {
  const Json* const extensions = find(node, "extensions");
  const Json* const instances = extensions ? find(*extensions, "EXT_mesh_gpu_instancing") : nullptr;
  return instances ? find(*instances, "attributes") : nullptr;
}

}  // namespace

std::vector<bool> usedAccessors(const Document& document, const Parts& parts,
                                const CountsInParts& counts) {
  std::set<const Json*> ofParts;
  for (const Part& part : parts.parts) ofParts.insert(&primitiveOf(document, parts, part));
  Marker marker(document.list("accessors").size());
  for (const Json& mesh : document.list("meshes"))
    for (const Json& primitive : listOf(mesh, "primitives"))
      marker.addPrimitive(primitive, ofParts.contains(&primitive) ? counts : always);
  for (const Json& skin : document.list("skins")) marker.addMember(skin, "inverseBindMatrices");
  for (const Json& animation : document.list("animations"))
    for (const Json& sampler : listOf(animation, "samplers")) {
      marker.addMember(sampler, "input");
      marker.addMember(sampler, "output");
    }
  for (const Json& node : document.list("nodes"))
    if (const Json* const attributes = instancesOf(node)) marker.addAttributes(*attributes, always);
  return marker.take();
}

}  // namespace sweepface::gltf
