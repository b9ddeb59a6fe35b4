#include "gltf/texcoords.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "gltf/accessor.hpp"

namespace sweepface::gltf {
namespace {

/// offset + rotation · scale · t
Vec2 transformed(const TextureTransform& by, double u, double v) {
  const double c = std::cos(by[4]), s = std::sin(by[4]);
  u *= by[2], v *= by[3];
  return {by[0] + c * u + s * v, by[1] - s * u + c * v};
}

}  // namespace

Result<TextureTransform> textureTransformOf(const Document& document, const Json& primitive) {
  const Json& materials = document.list("materials");
  const Json* const number = find(primitive, "material");
  const auto material = number ? asIndex(*number, materials.size()) : std::nullopt;
  if (!material) return kNoTransform;
  Members in(materials[*material], fmt::format("material {}", *material));
  Members colour(in.object("pbrMetallicRoughness"), in.place());
  Members texture(colour.object("baseColorTexture"), in.place());
  Members extensions(texture.object("extensions"), in.place());
  Members told(extensions.object("KHR_texture_transform"), in.place());
  const std::size_t set = told.size("texCoord", texture.size("texCoord", 0));
  const auto offset = told.numbers<2>("offset");
  const auto scale = told.numbers<2>("scale");
  const double rotation = told.number("rotation", 0);
  for (const Members* m : {&in, &colour, &texture, &extensions, &told})
    if (!m->ok()) return m->error();
  TextureTransform transform = kNoTransform;
  if (set != 0) return transform;
  if (offset) std::ranges::copy(*offset, transform.begin());
  if (scale) std::ranges::copy(*scale, transform.begin() + 2);
  transform[4] = rotation;
  return transform;
}

Result<std::vector<Vec2>> readTexcoords(const Document& document, const Json& primitive,
                                        const TextureTransform& transform) {
  const Json& number = primitive["attributes"]["TEXCOORD_0"];
  const std::size_t index = *asIndex(number, document.list("accessors").size());
  const auto accessor = accessorAt(document, index);
  if (!accessor) return std::unexpected(accessor.error());
  if (accessor->rows != 2 || accessor->columns != 1)
    return fail(fmt::format("accessor {}: a TEXCOORD_0 is not of type VEC2; export the file again.",
                            index));
  const auto values = decode(document, *accessor);
  if (!values) return std::unexpected(values.error());
  std::vector<Vec2> texcoords;
  for (std::size_t k = 0; k < values->size(); k += 2) {
    const Vec2 t = transformed(transform, (*values)[k], (*values)[k + 1]);
    texcoords.push_back({t.x, 1 - t.y});
    if (std::isfinite(t.x) && std::isfinite(t.y)) continue;
    return fail(
        fmt::format("accessor {}: a TEXCOORD_0 is not finite where its texture is; export "
                    "the file again.",
                    index));
  }
  return texcoords;
}

bool hasPlainTexcoords(const Document& document, const Json& primitive) {
  const Json* const number = find(primitive["attributes"], "TEXCOORD_0");
  const auto index = number ? asIndex(*number, document.list("accessors").size()) : std::nullopt;
  if (!index) return false;
  const auto accessor = accessorAt(document, *index);
  const auto transform = textureTransformOf(document, primitive);
  return accessor && accessor->type == Component::float32 && accessor->components() == 2 &&
         accessor->columns == 1 && transform && *transform == kNoTransform;
}

}  // namespace sweepface::gltf
