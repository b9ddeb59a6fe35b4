#pragma once

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <memory>
#include <string_view>

#include "sweepface/picture.hpp"

namespace sweepface::testing {

/// Decodes the bytes of a PNG file; returns an empty image if they are not one.
inline Image readPng(std::string_view png) {
  Image image;
  int channels = 0;
  const std::unique_ptr<unsigned char, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const unsigned char*>(png.data()),
                            static_cast<int>(png.size()), &image.width, &image.height, &channels,
                            3),
      stbi_image_free);
  if (pixels)
    image.rgb.assign(pixels.get(), pixels.get() + std::size_t{3} * image.width * image.height);
  return image;
}

}  // namespace sweepface::testing
