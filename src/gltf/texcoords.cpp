#include "gltf/texcoords.hpp"

#include <cmath>
#include <fmt/format.h>

#include "gltf/accessor.hpp"

namespace sweepface::gltf {
namespace {

/// offset + rotation · scale · t
struct Transform {
  Vec2 offset, scale{1, 1};
  double rotation = 0;  // radians, counter-clockwise where v goes down

  bool changesNothing() const { return offset == Vec2{} && scale == Vec2{1, 1} && rotation == 0; }

  Vec2 operator()(Vec2 t) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    t = {scale.x * t.x, scale.y * t.y};
    return {offset.x + c * t.x + s * t.y, offset.y - s * t.x + c * t.y};
  }
};

/// What the base colour of a primitive's material does to TEXCOORD_0.
Result<Transform> transformOf(const Document& document, const Json& primitive) {
  const Json& materials = document.list("materials");
  const Json* const number = find(primitive, "material");
  const auto material = number ? asIndex(*number, materials.size()) : std::nullopt;
  if (!material) return Transform{};
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
  Transform transform;
  if (set != 0) return transform;
  if (offset) transform.offset = {(*offset)[0], (*offset)[1]};
  if (scale) transform.scale = {(*scale)[0], (*scale)[1]};
  transform.rotation = rotation;
  return transform;
}

}  // namespace

Result<std::vector<Vec2>> readTexcoords(const Document& document, const Json& primitive) {
  const Json& number = primitive["attributes"]["TEXCOORD_0"];
  const std::size_t index = *asIndex(number, document.list("accessors").size());
  const auto accessor = accessorAt(document, index);
  if (!accessor) return std::unexpected(accessor.error());
  if (accessor->rows != 2 || accessor->columns != 1)
    return fail(fmt::format("accessor {}: a TEXCOORD_0 is not of type VEC2; export the file again.",
                            index));
  const auto transform = transformOf(document, primitive);
  if (!transform) return std::unexpected(transform.error());
  const auto values = decode(document, *accessor);
  if (!values) return std::unexpected(values.error());
  std::vector<Vec2> texcoords;
  for (std::size_t k = 0; k < values->size(); k += 2) {
    const Vec2 t = (*transform)({(*values)[k], (*values)[k + 1]});
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
  const auto transform = transformOf(document, primitive);
  return accessor && accessor->type == Component::float32 && accessor->components() == 2 &&
         accessor->columns == 1 && transform && transform->changesNothing();
}

}  // namespace sweepface::gltf
