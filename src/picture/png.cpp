#include <memory>

#include "sweepface/picture.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace sweepface {

Result<std::string> encodePng(const Image& image) {
  if (auto ok = checkSize({image.width, image.height}); !ok) return std::unexpected(ok.error());
  if (image.rgb.size() != 3 * static_cast<std::size_t>(image.width) * image.height)
    return fail(std::to_string(image.width) + " × " + std::to_string(image.height) +
                " pixels need three bytes each; the picture has " +
                std::to_string(image.rgb.size()) + ".");
  // Searches further for repetitions than by default. Set once, as several threads may write.
  [[maybe_unused]] static const int level = stbi_write_png_compression_level = 24;
  int size = 0;
  const std::unique_ptr<unsigned char, decltype(&std::free)> bytes(
      stbi_write_png_to_mem(image.rgb.data(), 3 * image.width, image.width, image.height, 3, &size),
      std::free);
  if (!bytes) return fail("There is not enough memory for the picture.");
  return std::string(reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size));
}

}  // namespace sweepface
