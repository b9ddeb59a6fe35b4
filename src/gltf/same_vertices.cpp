#include <map>
#include <set>

#include "gltf/fine_mesh.hpp"

namespace sweepface::gltf {
namespace {

/// The accessors in which vertices of each run may differ.
std::vector<std::set<std::size_t>> tellingAccessors(const BoundScene& scene) {
  std::vector<std::set<std::size_t>> accessors(scene.parts.runs.size());
  for (const Part& part : scene.parts.parts) {
    const auto add = [&](const Json& attributes) {
      for (const auto& [name, number] : attributes.items())
        if (!isGeometry(name)) accessors[part.run].insert(number.get<std::size_t>());
    };
    const Json& primitive = primitiveOf(scene.document, scene.parts, part);
    add(*find(primitive, "attributes"));
    for (const Json& target : listOf(primitive, "targets")) add(target);
  }
  return accessors;
}

}  // namespace

Result<std::vector<Index>> sameVertices(const Rig& rig, const BoundScene& scene) {
  const auto accessors = tellingAccessors(scene);
  std::vector<Index> same;
  for (std::size_t r = 0; r < scene.parts.runs.size(); ++r) {
    const Run& run = scene.parts.runs[r];
    std::vector<std::vector<double>> keys(run.count);
    for (std::size_t v = 0; v < run.count; ++v)
      keys[v].push_back(rig.source.gridVertex[scene.vertices[run.first + v]]);
    for (const std::size_t number : accessors[r]) {
      const auto accessor = accessorAt(scene.document, number);
      if (!accessor) return std::unexpected(accessor.error());
      const auto values = decode(scene.document, *accessor);
      if (!values) return std::unexpected(values.error());
      const auto width = static_cast<std::ptrdiff_t>(accessor->components());
      for (std::size_t v = 0; v < run.count; ++v) {
        const auto begin = values->begin() + static_cast<std::ptrdiff_t>(v) * width;
        keys[v].insert(keys[v].end(), begin, begin + width);
      }
    }
    std::map<std::vector<double>, Index> known;
    for (std::size_t v = 0; v < run.count; ++v)
      same.push_back(
          known.try_emplace(std::move(keys[v]), static_cast<Index>(run.first + v)).first->second);
  }
  return same;
}

}  // namespace sweepface::gltf
