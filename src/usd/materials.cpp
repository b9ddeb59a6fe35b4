#include "usd/materials.hpp"

#include <fmt/format.h>
#include <map>

#include "usd/shaders.hpp"
#include "usd/values.hpp"

namespace sweepface::usd {

Materials::Materials(const Polygons& polygons, const std::vector<Index>& faces) {
  if (polygons.faceMaterial.empty()) return;
  std::map<Index, std::vector<Index>> facesOf;
  for (std::size_t f = 0; f < faces.size(); ++f)
    facesOf[polygons.faceMaterial[faces[f]]].push_back(static_cast<Index>(f));
  PrimNames names;
  for (auto& [material, list] : facesOf) {
    coverAll_ = coverAll_ && material >= 0;
    if (material < 0) continue;
    const std::string& name = polygons.materials[material];
    used_.push_back({name, names.take(name), std::move(list)});
  }
}

void Materials::addSubsets(Text& text, const std::string& path, PrimNames& names) const {
  if (empty()) return;
  text.set("uniform token subsetFamily:materialBind:familyType",
           coverAll_ ? R"("partition")" : R"("nonOverlapping")");
  for (const Used& material : used_) {
    text.open("GeomSubset", names.take(material.prim),
              {R"(prepend apiSchemas = ["MaterialBindingAPI"])"});
    text.set("uniform token elementType", R"("face")");
    text.set("uniform token familyName", R"("materialBind")");
    text.set("int[] indices", list(std::span<const Index>(material.faces)));
    text.set("rel material:binding", fmt::format("<{}/materials/{}>", path, material.prim));
    text.close();
  }
}

void Materials::addScope(Text& text, const std::string& path, const Looks& looks) const {
  if (empty()) return;
  text.open("Scope", "materials");
  for (const Used& material : used_) {
    const std::string prim = fmt::format("{}/materials/{}", path, material.prim);
    const std::string called = "displayName = " + inQuotes(material.name);
    if (material.name == material.prim)
      text.open("Material", material.prim);
    else
      text.open("Material", material.prim, {called});
    text.set("token outputs:surface.connect", fmt::format("<{}/shader.outputs:surface>", prim));
    const auto look = looks.byName.find(material.name);
    addShaders(text, prim, look == looks.byName.end() ? Look{} : look->second, looks.images);
    text.close();
  }
  text.close();
}

}  // namespace sweepface::usd
