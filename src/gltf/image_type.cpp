#include "gltf/image_type.hpp"

#include <array>

namespace sweepface::gltf {

std::string imageTypeOf(std::string_view bytes) {
  struct Kind {
    std::string_view start, type;
  };
  constexpr std::array<Kind, 4> kinds{{{"\x89PNG\r\n", "image/png"},
                                       {"\xFF\xD8\xFF", "image/jpeg"},
                                       {"\xABKTX 20\xBB", "image/ktx2"},
                                       {"DDS ", "image/vnd-ms.dds"}}};
  for (const Kind& kind : kinds)
    if (bytes.starts_with(kind.start)) return std::string(kind.type);
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  return {};
}

}  // namespace sweepface::gltf
