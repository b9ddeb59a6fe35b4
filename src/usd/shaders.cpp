#include "usd/shaders.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "usd/values.hpp"

namespace sweepface::usd {
namespace {

using Factors = std::array<double, 4>;

/// A map as a shader reads it.
struct Reader {
  std::string name;
  Map map;
  Factors scale{1, 1, 1, 1}, bias{};
  bool isColour = false;  ///< in sRGB
};

class Shaders {
 public:
  Shaders(Text& text, const std::string& path, const Look& look, const std::vector<Image>& images)
      : text_(text), path_(path), look_(look), images_(images) {}

  void add() {
    addSurface();
    if (readers_.empty()) return;
    text_.open("Shader", "texcoords");
    text_.set("uniform token info:id", R"("UsdPrimvarReader_float2")");
    text_.set("string inputs:varname", R"("st")");
    text_.declare("float2 outputs:result");
    text_.close();
    for (const Reader& reader : readers_) addReader(reader);
  }

 private:
  /// UsdPreviewSurface, with inputs that are numbers or come from maps.
  void addSurface() {
    const Vec3 &c = look_.colour, &e = look_.emission;
    const double opacity = look_.isTransparent ? look_.opacity : 1;
    text_.open("Shader", "shader");
    text_.set("uniform token info:id", R"("UsdPreviewSurface")");
    const Reader colour{"colour", look_.colourMap, {c.x, c.y, c.z, opacity}, {}, true};
    if (look_.coat > 0) addCoat();
    input("color3f inputs:diffuseColor", tuple(c), colour, "rgb");
    input("color3f inputs:emissiveColor", tuple(e),
          {"emission", look_.emissionMap, {e.x, e.y, e.z, 1}, {}, true}, "rgb");
    if (look_.refraction != Look{}.refraction)
      text_.set("float inputs:ior", number(look_.refraction));
    const Reader rough{"rough", look_.roughnessMap, {1, look_.roughness, look_.metallic, 1}};
    input("float inputs:metallic", number(look_.metallic), rough, "b");
    if (has(look_.normalMap)) {
      const double s = look_.normalMap.strength;
      input("normal3f inputs:normal", "",
            {"normal", look_.normalMap, {2 * s, 2 * s, 2, 1}, {-s, -s, -1, 0}}, "rgb");
    }
    if (has(look_.occlusionMap)) {
      const double s = look_.occlusionMap.strength;
      input("float inputs:occlusion", "",
            {"occlusion", look_.occlusionMap, {s, s, s, 1}, {1 - s, 1 - s, 1 - s, 0}}, "r");
    }
    if (look_.isTransparent) {
      input("float inputs:opacity", number(opacity), colour, "a");
      if (look_.opacityThreshold > 0)
        text_.set("float inputs:opacityThreshold", number(look_.opacityThreshold));
    }
    input("float inputs:roughness", number(look_.roughness), rough, "g");
    text_.declare("token outputs:surface");
    text_.close();
  }

  void addCoat() {
    const double coat = look_.coat, rough = look_.coatRoughness;
    input("float inputs:clearcoat", number(coat), {"coat", look_.coatMap, {coat, 1, 1, 1}}, "r");
    input("float inputs:clearcoatRoughness", number(rough),
          {"coatRough", look_.coatRoughnessMap, {1, rough, 1, 1}}, "g");
  }

  static bool has(const Map& map) { return map.image >= 0; }

  void input(const std::string& name, const std::string& value, const Reader& reader,
             std::string_view channel) {
    if (!has(reader.map)) return text_.set(name, value);
    text_.set(name + ".connect", fmt::format("<{}/{}.outputs:{}>", path_, reader.name, channel));
    if (std::ranges::find(readers_, reader.name, &Reader::name) == readers_.end())
      readers_.push_back(reader);
  }

  void addReader(const Reader& reader) {
    text_.open("Shader", reader.name);
    text_.set("uniform token info:id", R"("UsdUVTexture")");
    if (reader.bias != Factors{}) text_.set("float4 inputs:bias", tuple(reader.bias));
    text_.set("asset inputs:file", fmt::format("@{}@", images_[reader.map.image].file));
    if (reader.scale != Factors{1, 1, 1, 1}) text_.set("float4 inputs:scale", tuple(reader.scale));
    text_.set("token inputs:sourceColorSpace", reader.isColour ? R"("sRGB")" : R"("raw")");
    text_.set("float2 inputs:st.connect", fmt::format("<{}/texcoords.outputs:result>", path_));
    text_.set("token inputs:wrapS", inQuotes(reader.map.wrap[0]));
    text_.set("token inputs:wrapT", inQuotes(reader.map.wrap[1]));
    for (const char* const output : {"float outputs:a", "float outputs:b", "float outputs:g",
                                     "float outputs:r", "float3 outputs:rgb"})
      text_.declare(output);
    text_.close();
  }

  Text& text_;
  const std::string& path_;
  const Look& look_;
  const std::vector<Image>& images_;
  std::vector<Reader> readers_;  // in the order of the surface's inputs
};

}  // namespace

void addShaders(Text& text, const std::string& path, const Look& look,
                const std::vector<Image>& images) {
  Shaders(text, path, look, images).add();
}

}  // namespace sweepface::usd
