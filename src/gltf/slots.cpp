#include "gltf/slots.hpp"

#include <set>

namespace sweepface::gltf {
namespace {

/// Marks the accessors that an object of a glTF names.
class Marker {
 public:
  explicit Marker(std::vector<bool>& marks) : marks_(marks) {}

  void one(const Json& object, std::string_view key) {
    if (const Json* const value = find(object, key)) mark(*value);
  }
  void all(const Json& attributes) {
    if (attributes.is_object())
      for (const auto& [name, value] : attributes.items()) mark(value);
  }
  void primitive(const Json& primitive) {
    one(primitive, "indices");
    if (const Json* const attributes = find(primitive, "attributes")) all(*attributes);
    for (const Json& target : listOf(primitive, "targets")) all(target);
  }

 private:
  void mark(const Json& value) {
    if (const auto index = asIndex(value, marks_.size())) marks_[*index] = true;
  }
  std::vector<bool>& marks_;
};

}  // namespace

Slots::Slots(const Document& document, const Parts& parts, Builder& builder)
    : taken_(document.list("accessors").size()), builder_(builder) {
  Marker marker(taken_);
  std::set<std::pair<std::size_t, std::size_t>> own;
  for (const Part& part : parts.parts)
    own.emplace(parts.meshes[parts.runs[part.run].rigMesh].mesh, part.primitive);
  const Json& meshes = document.list("meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Json& primitives = listOf(meshes[m], "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (!own.contains({m, p})) marker.primitive(primitives[p]);
  }
  for (const Json& skin : document.list("skins")) marker.one(skin, "inverseBindMatrices");
  for (const Json& animation : document.list("animations"))
    for (const Json& sampler : listOf(animation, "samplers")) {
      marker.one(sampler, "input");
      marker.one(sampler, "output");
    }
  for (const Json& node : document.list("nodes"))
    if (const Json* const extensions = find(node, "extensions"))
      if (const Json* const instances = find(*extensions, "EXT_mesh_gpu_instancing"))
        if (const Json* const attributes = find(*instances, "attributes")) marker.all(*attributes);
}

std::size_t Slots::put(std::optional<std::size_t> accessor, const Column& column, Use use) {
  if (!accessor || *accessor >= taken_.size() || taken_[*accessor])
    return builder_.add(column, use);
  taken_[*accessor] = true;
  builder_.set(*accessor, column, use);
  return *accessor;
}

}  // namespace sweepface::gltf
