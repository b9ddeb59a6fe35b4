#include "gltf/image_type.hpp"

#include <gtest/gtest.h>

namespace sweepface::gltf {
namespace {

using namespace std::string_view_literals;

TEST(ImageTypes, AreToldByTheFirstBytes) {
  for (const auto& [bytes, type] : {std::pair{"\x89PNG\r\n\x1A\n"sv, "image/png"},
                                    {"\xFF\xD8\xFF\xE0\0\x10JFIF"sv, "image/jpeg"},
                                    {"\xABKTX 20\xBB\r\n\x1A\n"sv, "image/ktx2"},
                                    {"DDS |\0\0\0"sv, "image/vnd-ms.dds"},
                                    {"RIFF\x24\0\0\0WEBPVP8 "sv, "image/webp"},
                                    {"RIFF\x24\0\0\0WAVEfmt "sv, ""},
                                    {"\xABKTX 11\xBB\r\n\x1A\n"sv, ""},
                                    {"GIF89a"sv, ""},
                                    {"RIFF"sv, ""},
                                    {""sv, ""}})
    EXPECT_EQ(imageTypeOf(bytes), type) << bytes;
}

}  // namespace
}  // namespace sweepface::gltf
