#include "gltf/same_vertices.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace sweepface::gltf {
namespace {

/// The accessors in which vertices of each run may differ.
std::vector<std::set<std::size_t>> tellingAccessors(const Document& document, const Parts& parts) {
  std::vector<std::set<std::size_t>> accessors(parts.runs.size());
  for (const Part& part : parts.parts) {
    const auto add = [&](const Json& attributes) {
      for (const auto& [name, number] : attributes.items())
        if (!isGeometry(name)) accessors[part.run].insert(number.get<std::size_t>());
    };
    const Json& primitive = primitiveOf(document, parts, part);
    add(*find(primitive, "attributes"));
    for (const Json& target : listOf(primitive, "targets")) add(target);
  }
  return accessors;
}

/// Divides vertices that have been alike so far by further values; `alike` [vertices] are numbers
/// of groups.
void divide(std::vector<Index>& alike, const std::vector<double>& values) {
  const std::size_t width = values.size() / alike.size();
  std::map<std::vector<double>, Index> groups;
  std::vector<double> key(width + 1);
  for (std::size_t v = 0; v < alike.size(); ++v) {
    key[0] = alike[v];
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(v * width), width, key.begin() + 1);
    alike[v] = groups.try_emplace(key, static_cast<Index>(groups.size())).first->second;
  }
}

/// Joins no vertices: for files that use the same data as attributes again and again, comparing
/// takes too long.
std::vector<Index> nothingJoined(std::size_t vertices) {
  std::vector<Index> same(vertices);
  std::iota(same.begin(), same.end(), 0);
  return same;
}

}  // namespace

Result<std::vector<Index>> sameVertices(const Document& document, const Parts& parts,
                                        std::span<const Index> places) {
  const auto accessors = tellingAccessors(document, parts);
  std::vector<Index> same;
  std::size_t elements = 0;
  for (std::size_t r = 0; r < parts.runs.size(); ++r) {
    const Run& run = parts.runs[r];
    const auto here = places.subspan(run.first, run.count);
    std::vector<Index> alike(here.begin(), here.end());
    for (const std::size_t number : accessors[r]) {
      const auto accessor = accessorAt(document, number);
      if (!accessor) return std::unexpected(accessor.error());
      if (!accessor->hasData()) continue;
      elements += accessor->count;
      if (elements > document.mostElements()) return nothingJoined(parts.vertexCount);
      const auto values = decode(document, *accessor);
      if (!values) return std::unexpected(values.error());
      divide(alike, *values);
    }
    std::map<Index, Index> first;
    for (std::size_t v = 0; v < run.count; ++v)
      same.push_back(first.try_emplace(alike[v], static_cast<Index>(run.first + v)).first->second);
  }
  return same;
}

}  // namespace sweepface::gltf
