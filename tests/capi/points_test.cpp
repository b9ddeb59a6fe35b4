#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/nearest.hpp"
#include "sweepface/sweepface.h"
#include "sweepface/sweepface_head.h"
#include "sweepface/sweepface_regions.h"

#include "capi/refuses.hpp"
#include "codec/rigs.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A mesh of points beside the surface of a face without texture coordinates.
class MeshesOfPoints : public ::testing::Test {
 protected:
  MeshesOfPoints() : rig(convert(withTargets(cubeSphere(4)), {}).value().rig) {
    const std::string bytes = encode(rig);
    EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "ball", &handle), SWEEPFACE_OK);
    for (Index k = 0; k < kCount; ++k) {
      const Site site{k % rig.surface.patchCount(), 0.3 + 0.01 * k, 0.6 - 0.01 * k};
      const auto vectors = blend(rig, {});
      const Vec3 point =
          rig.surface.evaluate(vectors, site) + 0.001 * rig.surface.normal(vectors, site);
      points.insert(points.end(), {point.x, point.y, point.z});
    }
  }
  ~MeshesOfPoints() override {
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
    sweepface_rig_free(handle);
  }

  void make() {
    ASSERT_EQ(sweepface_mesh_create_at(handle, points.data(), kCount, &mesh), SWEEPFACE_OK)
        << sweepface_message();
    ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  }
  std::vector<float> positions() {
    std::vector<float> out(3 * kCount);
    EXPECT_EQ(sweepface_face_evaluate(face, kCount, {out.data(), 0}, {}), SWEEPFACE_OK);
    return out;
  }

  static constexpr Index kCount = 40;  // more than a tile
  Rig rig;
  std::vector<double> points;
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  const double weights[2] = {0.5, -0.25};
};

TEST_F(MeshesOfPoints, HaveTheNearestPointsOfTheSurfaceInTheirOrder) {
  make();
  EXPECT_EQ(sweepface_mesh_point_count(mesh), kCount);
  EXPECT_EQ(sweepface_mesh_vertex_count(mesh), kCount);
  EXPECT_EQ(sweepface_mesh_triangle_count(mesh), 0u);
  EXPECT_EQ(sweepface_mesh_part_count(mesh), 0u);
  EXPECT_EQ(sweepface_mesh_texcoords(mesh), nullptr);
  const auto found = positions();
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], points[k], 0.0011);
}

TEST_F(MeshesOfPoints, AreFramesThatMoveWithTheSurface) {
  make();
  ASSERT_EQ(sweepface_mesh_prepare_tangents(mesh), SWEEPFACE_OK) << sweepface_message();
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 2), SWEEPFACE_OK);
  std::vector<float> normals(3 * kCount), tangents(4 * kCount);
  ASSERT_EQ(sweepface_face_tangents(face, kCount, {normals.data(), 0}, {tangents.data(), 0}),
            SWEEPFACE_OK)
      << sweepface_message();
  std::vector<Vec3> wanted;
  for (std::size_t k = 0; k < points.size(); k += 3)
    wanted.push_back({points[k], points[k + 1], points[k + 2]});
  const auto sites = nearestSites(rig.surface, blend(rig, {}), wanted).value();
  const auto vectors = blend(rig, weights);
  const auto found = positions();
  for (std::size_t k = 0; k < kCount; ++k) {
    const Vec3 place = rig.surface.evaluate(vectors, sites[k]);
    EXPECT_LE(norm(Vec3{found[3 * k], found[3 * k + 1], found[3 * k + 2]} - place),
              sweepface_face_error(face));
    const Vec3 normal{normals[3 * k], normals[3 * k + 1], normals[3 * k + 2]},
        tangent{tangents[4 * k], tangents[4 * k + 1], tangents[4 * k + 2]};
    EXPECT_GE(dot(normal, rig.surface.normal(vectors, sites[k])), 0.99);
    EXPECT_GE(dot(tangent, normalized(rig.surface.evaluate(vectors, sites[k], 1, 0))), 0.99);
    EXPECT_NEAR(norm(tangent), 1, 1e-5);
    EXPECT_NEAR(dot(normal, tangent), 0, 1e-5);
    EXPECT_EQ(tangents[4 * k + 3], 1);
  }
}

TEST_F(MeshesOfPoints, KnowTheSourceVerticesAroundThem) {
  make();
  std::vector<uint32_t> vertices(4 * kCount);
  std::vector<float> shares(4 * kCount);
  ASSERT_EQ(sweepface_mesh_origins(mesh, kCount, vertices.data(), shares.data()), SWEEPFACE_OK);
  for (std::size_t k = 0; k < kCount; ++k) {
    const float* const of = &shares[4 * k];
    EXPECT_NEAR(of[0] + of[1] + of[2] + of[3], 1, 1e-6);
    EXPECT_LT(*std::max_element(of, of + 4), 1) << "they lie inside quads";
  }
}

TEST_F(MeshesOfPoints, MoveByRegions) {
  const std::size_t nodes = sweepface_rig_node_count(handle);
  std::vector<double> shares(2 * nodes);
  std::fill_n(shares.begin(), nodes, 1);
  const char* const names[] = {"all", "none"};
  ASSERT_EQ(sweepface_rig_divide(handle, names, shares.data(), 2), SWEEPFACE_OK);
  make();
  const auto still = positions();
  ASSERT_EQ(sweepface_face_set_region_weights(face, 1, weights, 2), SWEEPFACE_OK);
  EXPECT_EQ(positions(), still);
  ASSERT_EQ(sweepface_face_set_region_weights(face, 0, weights, 2), SWEEPFACE_OK);
  const auto moved = positions();
  EXPECT_NE(moved, still);
  ASSERT_EQ(sweepface_face_set_region_weights(face, 1, std::array{0.0, 0.0}.data(), 2),
            SWEEPFACE_OK);
  EXPECT_EQ(positions(), moved);
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 2), SWEEPFACE_OK);
  EXPECT_EQ(positions(), moved);
}

/// A face away from the origin that has more quads than a mesh may have vertices.
sweepface_rig* loadTooLarge() {
  Rig plain;
  plain.surface = Surface::make(onePatch(4097, 4097)).value();
  plain.neutral.assign(plain.surface.storedCount(), {1, 2, 3});
  const std::string bytes = encode(plain);
  sweepface_rig* large = nullptr;
  EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "large", &large), SWEEPFACE_OK)
      << sweepface_message();
  return large;
}

TEST_F(MeshesOfPoints, AreRefusedOnFacesOfTooManyQuads) {
  sweepface_rig* const large = loadTooLarge();
  EXPECT_TRUE(refuses(sweepface_mesh_create_at(large, points.data(), kCount, &mesh),
                      "more than 16777216 quads"));
  sweepface_rig_free(large);
}

TEST(FacesOfTooManyQuads, HaveNoBoxAndNoEyes) {
  sweepface_rig* const large = loadTooLarge();
  double low[] = {7, 7, 7}, high[] = {7, 7, 7};
  sweepface_rig_box(large, low, high);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(low[k] == 0 && high[k] == 0) << k;
  uint32_t eyes = 0;
  EXPECT_TRUE(refuses(sweepface_rig_turn_eyes(large, &eyes),
                      "The face has too many vertices to look for eyes."));
  sweepface_rig_free(large);
}

TEST_F(MeshesOfPoints, AreRefusedWhereThereAreNone) {
  EXPECT_EQ(sweepface_mesh_create_at(handle, points.data(), 0, &mesh), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_STREQ(sweepface_message(),
               "Making a mesh of points needs a rig, points and a place for it.");
  EXPECT_EQ(sweepface_mesh_create_at(nullptr, points.data(), 1, &mesh), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_mesh_create_at(handle, nullptr, 1, &mesh), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_mesh_create_at(handle, points.data(), 1, nullptr), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_mesh_create_at(handle, points.data(), SIZE_MAX, &mesh),
            SWEEPFACE_BAD_ARGUMENT);
  points[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sweepface_mesh_create_at(handle, points.data(), kCount, &mesh), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_STREQ(sweepface_message(), "Point 2 must have coordinates within 1e100 of 0.");
  EXPECT_EQ(mesh, nullptr);
}

}  // namespace
}  // namespace sweepface
