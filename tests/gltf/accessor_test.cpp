#include "gltf/accessor.hpp"

#include <fmt/format.h>
#include <limits>

#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Result<std::vector<double>> decodeOnly(const Glb& glb, std::size_t index = 0) {
  const auto document = gltf::parseDocument(glb.bytes(), {});
  if (!document) return std::unexpected(document.error());
  const auto accessor = gltf::accessorAt(*document, index);
  if (!accessor) return std::unexpected(accessor.error());
  return gltf::decode(*document, *accessor);
}

template <typename T>
Glb scalars(const std::vector<T>& values, int component) {
  Glb glb;
  glb.addAccessor(glb.addView(bytesOf(values)), component, "SCALAR", values.size());
  return glb;
}

template <typename T>
void expectValues(const std::vector<T>& stored, int component, std::vector<double> plain,
                  std::vector<double> normalized) {
  Glb glb = scalars(stored, component);
  EXPECT_EQ(decodeOnly(glb).value(), plain) << component;
  glb.accessor(0)["normalized"] = true;
  EXPECT_EQ(decodeOnly(glb).value(), normalized) << component;
}

TEST(Accessor, ReadsEveryComponentType) {
  expectValues<std::int8_t>({0, 127, -127, -128}, 5120, {0, 127, -127, -128}, {0, 1, -1, -1});
  expectValues<std::uint8_t>({0, 255, 51}, 5121, {0, 255, 51}, {0, 1, 0.2});
  expectValues<std::int16_t>({32767, -32767, -32768}, 5122, {32767, -32767, -32768}, {1, -1, -1});
  expectValues<std::uint16_t>({65535, 13107}, 5123, {65535, 13107}, {1, 0.2});
  expectValues<std::uint32_t>({4294967295u, 0}, 5125, {4294967295.0, 0}, {1, 0});
  expectValues<float>({0.25f, -1e30f}, 5126, {0.25, -1e30f}, {0.25, -1e30f});
}

TEST(Accessor, ReadsEveryType) {
  const std::vector<std::pair<const char*, std::size_t>> types{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [type, components] : types) {
    std::vector<float> values;
    std::vector<double> expected;
    for (std::size_t k = 0; k < 2 * components; ++k)
      values.push_back(static_cast<float>(k)), expected.push_back(static_cast<double>(k));
    Glb glb;
    glb.addAccessor(glb.addView(bytesOf(values)), 5126, type, 2);
    EXPECT_EQ(decodeOnly(glb).value(), expected) << type;
  }
}

TEST(Accessor, ColumnsOfSmallMatricesBeginAtMultiplesOfFour) {
  Glb glb;
  const std::vector<std::uint8_t> bytes{1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8, 0, 0};
  glb.addAccessor(glb.addView(bytesOf(bytes)), 5121, "MAT2", 2);
  EXPECT_EQ(decodeOnly(glb).value(), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Accessor, StepsByTheStrideFromItsOffset) {
  Glb glb;
  const std::vector<std::uint16_t> values{9, 9, 1, 2, 9, 9, 3, 4, 9, 9, 5, 6};
  const std::size_t view = glb.addView(bytesOf(values), 8);
  glb.addAccessor(view, 5123, "VEC2", 3);
  glb.accessor(0)["byteOffset"] = 4;
  EXPECT_EQ(decodeOnly(glb).value(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  glb.accessor(0)["count"] = 4;
  EXPECT_TRUE(failsWith(decodeOnly(glb), {"accessor 0: its 4 elements reach beyond the 24 bytes"}));
}

TEST(Accessor, WithoutAViewIsZero) {
  Glb glb;
  glb.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2}});
  EXPECT_EQ(decodeOnly(glb).value(), std::vector<double>(6));
}

TEST(Accessor, MayNotClaimMoreThanItsFileCanMean) {
  Glb glb;
  glb.addSparse(70'000, {1}, {{1, 2, 3}});
  EXPECT_EQ(decodeOnly(glb).value().size(), 210'000u);
  for (const std::size_t count : {std::size_t{1} << 24, std::size_t{1} << 40}) {
    glb.accessor(0)["count"] = count;
    EXPECT_TRUE(failsWith(decodeOnly(glb),
                          {fmt::format("accessor 0: it claims {} elements without data", count)}));
  }
  glb.accessor(0).erase("sparse");
  EXPECT_TRUE(failsWith(decodeOnly(glb), {"elements without data"}));
}

Glb sparse(std::vector<std::uint16_t> where = {1, 3}) {
  Glb glb;
  glb.addSparse(5, where, std::vector<Vec3>(where.size(), Vec3{1, 2, 3}));
  return glb;
}

TEST(Accessor, SparseValuesReplaceZeros) {
  EXPECT_EQ(decodeOnly(sparse()).value(),
            (std::vector<double>{0, 0, 0, 1, 2, 3, 0, 0, 0, 1, 2, 3, 0, 0, 0}));
}

TEST(Accessor, SparseValuesReplaceThoseOfTheView) {
  Glb glb = sparse({1});
  glb.accessor(0)["bufferView"] = glb.addView(floatsOf(std::vector<Vec3>(5, Vec3{7, 8, 9})));
  const auto values = decodeOnly(glb).value();
  EXPECT_EQ(std::vector<double>(values.begin(), values.begin() + 9),
            (std::vector<double>{7, 8, 9, 1, 2, 3, 7, 8, 9}));
}

TEST(Accessor, SparseValuesAreNormalisedToo) {
  Glb glb = scalars<std::uint8_t>({0, 51, 255}, 5121);
  const std::size_t where = glb.addView(std::string("\1\2", 2));
  const std::size_t what = glb.addView(std::string("\xFF\0", 2));
  glb.accessor(0)["normalized"] = true;
  glb.accessor(0)["sparse"] = {{"count", 2},
                               {"indices", {{"bufferView", where}, {"componentType", 5121}}},
                               {"values", {{"bufferView", what}}}};
  EXPECT_EQ(decodeOnly(glb).value(), (std::vector<double>{0, 1, 0}));
}

TEST(Accessor, SparseIndicesMustIncreaseAndStayInRange) {
  EXPECT_TRUE(failsWith(decodeOnly(sparse({1, 1})), {"accessor 0, sparse indices: number 1 is 1"}));
  EXPECT_TRUE(failsWith(decodeOnly(sparse({3, 1})), {"they must increase and stay below 5"}));
  EXPECT_TRUE(failsWith(decodeOnly(sparse({1, 5})), {"number 1 is 5"}));
}

TEST(Accessor, SparsePartsMustLieWithinTheirViews) {
  const auto expectRefused = [](auto change, std::string_view why) {
    Glb glb = sparse();
    change(glb.accessor(0)["sparse"]);
    EXPECT_TRUE(failsWith(decodeOnly(glb), {"accessor 0, sparse", why}));
  };
  expectRefused([](Json& s) { s["count"] = 6; }, "its count 6 is not from 1 to 5");
  expectRefused([](Json& s) { s["count"] = 0; }, "its count 0 is not from 1 to 5");
  expectRefused([](Json& s) { s["count"] = 4; }, "its 4 values reach beyond the 4 bytes");
  expectRefused([](Json& s) { s["indices"]["bufferView"] = 2; }, "'bufferView' is 2");
  expectRefused([](Json& s) { s["indices"].erase("bufferView"); }, "'bufferView' is missing");
  expectRefused([](Json& s) { s["indices"]["componentType"] = 5126; }, "unsigned integers");
  expectRefused([](Json& s) { s["indices"]["byteOffset"] = 2; }, "reach beyond");
  expectRefused([](Json& s) { s["values"]["byteOffset"] = 9007199254740991; }, "reach beyond");
  expectRefused([](Json& s) { s["values"] = 1; }, "'values' is not an object");
  expectRefused([](Json& s) { s.erase("indices"); }, "'componentType' is missing");
}

TEST(Accessor, WhatItSaysMustMakeSense) {
  const auto expectRefused = [](const char* key, const Json& value, std::string_view why) {
    Glb glb = scalars<float>({1, 2, 3}, 5126);
    glb.accessor(0)[key] = value;
    EXPECT_TRUE(failsWith(decodeOnly(glb), {"accessor 0: ", why})) << key << value;
  };
  expectRefused("count", 0, "its count is 0");
  expectRefused("count", -3, "'count' is not a whole number");
  expectRefused("count", "3", "'count' is not a whole number");
  expectRefused("count", 4, "reach beyond the 12 bytes of buffer view 0");
  expectRefused("count", 9007199254740991, "reach beyond");
  expectRefused("count", 1e300, "'count' is not a whole number");
  expectRefused("byteOffset", 9007199254740991, "reach beyond");
  expectRefused("byteOffset", Json(), "'byteOffset' is not a whole number");
  expectRefused("bufferView", 1, "'bufferView' is 1, but the file has 1 buffer views");
  expectRefused("componentType", 5124, "the componentType 5124 is unknown");
  expectRefused("componentType", Json::array(), "'componentType' is not a whole number");
  expectRefused("type", "VEC5", "its 'type' is missing or unknown");
  expectRefused("type", 3, "'type' is not a text");
  expectRefused("type", "MAT4", "reach beyond");
  expectRefused("normalized", 1, "'normalized' is neither true nor false");
  expectRefused("sparse", false, "'sparse' is not an object");
}

TEST(Accessor, ElementsMustNotOverlap) {
  Glb glb;
  const std::size_t view = glb.addView(std::string(64, '\0'), 8);
  glb.addAccessor(view, 5126, "VEC3", 2);
  EXPECT_TRUE(failsWith(decodeOnly(glb), {"its elements of 12 bytes overlap in buffer view 0"}));
}

TEST(Accessor, WhatIsNotFiniteIsRefused) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_TRUE(failsWith(decodeOnly(scalars<float>({1, bad}, 5126)),
                          {"accessor 0: element 1 is not finite"}));
  }
}

}  // namespace
}  // namespace sweepface
