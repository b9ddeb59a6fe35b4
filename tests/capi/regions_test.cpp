#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "sweepface/regional_motion.hpp"
#include "sweepface/sweepface_regions.h"

#include "capi/refuses.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A face of three patches and eight nodes, and a brush around its first node.
class DividedFaces : public ::testing::Test {
 protected:
  DividedFaces() : rig(dressed(makeRig(tee()))) {
    const std::string bytes = encode(rig);
    EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
    brush.nodes = nodes, brush.node_shares = shares, brush.node_count = 2;
  }
  ~DividedFaces() override {
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
    sweepface_rig_free(handle);
  }

  std::vector<double> paint(uint32_t bands = 1) {
    std::vector<double> painted(bands * sweepface_rig_node_count(handle), -1);
    EXPECT_EQ(sweepface_rig_paint(handle, &brush, bands, painted.data(), painted.size()),
              SWEEPFACE_OK)
        << sweepface_message();
    return painted;
  }
  void divide() {
    const char* const name = "part";
    ASSERT_EQ(sweepface_rig_divide(handle, &name, paint().data(), 1), SWEEPFACE_OK)
        << sweepface_message();
    ASSERT_EQ(sweepface_mesh_create(handle, 1, &mesh), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  }
  std::vector<float> evaluate(sweepface_face* of) {
    std::vector<float> out(3 * sweepface_mesh_point_count(mesh));
    EXPECT_EQ(sweepface_face_evaluate(of, out.size() / 3, {out.data(), 0}, {nullptr, 0}),
              SWEEPFACE_OK);
    return out;
  }

  Rig rig;
  const char* const nodes[2] = {"0", "2"};
  const double shares[2] = {1, 0.25};
  sweepface_brush brush{};
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
};

TEST_F(DividedFaces, ArePaintedByTheLibrary) {
  ASSERT_EQ(sweepface_rig_node_count(handle), rig.surface.wireframe().nodes.size());
  Brush same;
  same.nodes = {{"0", 1}, {"2", 0.25}};
  EXPECT_EQ(paint(), *sweepface::paint(rig, same));
  const double points[] = {0.1, 0.2, 0.3, 1, 1, 1};
  brush = {};
  brush.points = points, brush.point_count = 1;
  brush.line = points, brush.line_count = 2;
  const char* const curve = "3";
  brush.curves = &curve, brush.curve_count = 1;
  brush.whole = 0.2, brush.fade = 3, brush.through_space = 1;
  same = {};
  same.points = {{0.1, 0.2, 0.3}};
  same.line = {{0.1, 0.2, 0.3}, {1, 1, 1}};
  same.curves = {curve};
  same.whole = 0.2, same.fade = 3, same.alongSurface = false;
  EXPECT_EQ(paint(), *sweepface::paint(rig, same));
  const std::vector<double> bands = paint(3);
  const auto expected = *paintBands(rig, same, 3);
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_TRUE(std::ranges::equal(
        std::span(bands).subspan(b * expected[b].size(), expected[b].size()), expected[b]));
  const char* const skin = "skin";
  brush = {};
  brush.parts = &skin, brush.part_count = 1;
  const std::vector<double> part = paint();
  EXPECT_GT(std::accumulate(part.begin(), part.end(), 0.0), 0);
}

TEST_F(DividedFaces, HaveWeightsOfEachRegion) {
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  EXPECT_EQ(sweepface_rig_region_name(handle, 0), nullptr);
  divide();
  ASSERT_EQ(sweepface_rig_region_count(handle), 2U);
  EXPECT_STREQ(sweepface_rig_region_name(handle, 0), "rest");
  EXPECT_STREQ(sweepface_rig_region_name(handle, 1), "part");
  EXPECT_EQ(sweepface_rig_region_name(handle, 2), nullptr);
  EXPECT_EQ(sweepface_mesh_region_count(mesh), 2U);

  const double everywhere[] = {0.5, -0.3, 0}, here[] = {1, 0.7};
  const auto weights = [&] {
    const double* const all = sweepface_face_weights(face);
    return std::vector(all, all + 6);
  };
  ASSERT_EQ(sweepface_face_set_weights(face, everywhere, 3), SWEEPFACE_OK);
  EXPECT_EQ(weights(), (std::vector{0.5, -0.3, 0.0, 0.5, -0.3, 0.0}));
  ASSERT_EQ(sweepface_face_set_region_weights(face, 1, here, 2), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_set_weight(face, 2, 0.1), SWEEPFACE_OK);
  const std::vector<double> expected{0.5, -0.3, 0.1, 1, 0.7, 0.1};
  EXPECT_EQ(weights(), expected);

  Brush same;
  same.nodes = {{"0", 1}, {"2", 0.25}};
  const auto regions = *dividedFace(rig, {{"part", {}, *sweepface::paint(rig, same)}});
  std::vector<Vec3> vectors(rig.surface.vectorCount());
  blend(rig, regions, expected, vectors);
  const std::vector<Vec3> exact = Tessellation(rig.surface, 1).positions(vectors);
  const std::vector<float> found = evaluate(face);
  ASSERT_EQ(found.size(), 3 * exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v)
    EXPECT_LE(norm(exact[v] - Vec3{found[3 * v], found[3 * v + 1], found[3 * v + 2]}),
              sweepface_face_error(face));
}

TEST_F(DividedFaces, HaveNoRestWhereARegionCoversAll) {
  const char* const name = "all";
  const std::vector<double> ones(sweepface_rig_node_count(handle), 1);
  ASSERT_EQ(sweepface_rig_divide(handle, &name, ones.data(), 1), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  EXPECT_STREQ(sweepface_rig_region_name(handle, 0), "all");
}

TEST_F(DividedFaces, AreOfOnePieceAgainWhereMeshesAreMadeLater) {
  divide();
  ASSERT_EQ(sweepface_rig_divide(handle, nullptr, nullptr, 0), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_mesh_region_count(mesh), 2U) << "as it was made";
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  EXPECT_EQ(sweepface_rig_region_name(handle, 0), nullptr);
  const double one[] = {1};
  EXPECT_EQ(sweepface_face_set_region_weights(face, 1, one, 1), SWEEPFACE_OK);  // still divided
  sweepface_mesh_free(mesh);
  sweepface_face_free(face);
  ASSERT_EQ(sweepface_mesh_create(handle, 1, &mesh), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  EXPECT_TRUE(refuses(sweepface_face_set_region_weights(face, 1, one, 1), "no region 1"));
}

TEST_F(DividedFaces, MoveByTheMatterOfEachRegion) {
  const double rest[] = {0, 0.5};
  const sweepface_matter matters[] = {{1, 1, 0}, {4, 2, 0.1}};
  sweepface_motion* motion = nullptr;
  ASSERT_EQ(sweepface_motion_create_regions(rest, 2, matters, 2, &motion), SWEEPFACE_OK);
  auto expected = *RegionalMotion::make(rest, std::vector<Matter>{{1, 1, 0}, {4, 2, 0.1}});
  ASSERT_EQ(sweepface_motion_move_to(motion, 0, 1, nullptr), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_motion_move_in(motion, 1, 1, -1, nullptr), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_motion_put_in(motion, 0, 1, 0.25), SWEEPFACE_OK);
  ASSERT_TRUE(expected.moveTo(0, 1) && expected.moveTo(1, 1, -1, {}) && expected.put(0, 1, 0.25));
  for (int frame = 0; frame < 20; ++frame) {
    double positions[4], velocities[4];
    ASSERT_EQ(sweepface_motion_positions(motion, positions, 4), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_motion_velocities(motion, velocities, 4), SWEEPFACE_OK);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(positions[k], expected.sample(k / 2, k % 2).position);
      EXPECT_EQ(velocities[k], expected.sample(k / 2, k % 2).velocity);
    }
    EXPECT_EQ(positions[1], 0.25);
    sweepface_motion_advance(motion, 0.05);
    expected.advance(0.05);
  }
  sweepface_motion_free(motion);
}

TEST_F(DividedFaces, RefuseAndChangeNothing) {
  std::vector<double> painted(sweepface_rig_node_count(handle));
  const auto paintWith = [&](const sweepface_brush& b, uint32_t bands, std::size_t count) {
    return sweepface_rig_paint(handle, &b, bands, painted.data(), count);
  };
  EXPECT_TRUE(refuses(paintWith(brush, 1, painted.size() - 1), "There is room for 7 shares"));
  EXPECT_TRUE(refuses(paintWith(brush, 2, painted.size()), "there are 16"));
  EXPECT_TRUE(refuses(paintWith(brush, 33, painted.size()), "at most 32 regions"));
  brush.fade = -1;
  EXPECT_TRUE(refuses(paintWith(brush, 1, painted.size()), "at least 0"));
  EXPECT_TRUE(refuses(sweepface_rig_paint(nullptr, &brush, 1, painted.data(), 8), "needs a rig"));
  const char* const names[] = {"a", "a"};
  const std::vector<double> halves(16, 0.5);
  EXPECT_TRUE(refuses(sweepface_rig_divide(handle, names, halves.data(), 2), "named 'a'"));
  EXPECT_TRUE(refuses(sweepface_rig_divide(handle, names, nullptr, 2), "needs a rig, and names"));
  const char* const nameless[] = {nullptr};
  EXPECT_TRUE(refuses(sweepface_rig_divide(handle, nameless, halves.data(), 1), "has no name"));
  brush = {};
  brush.curves = nameless, brush.curve_count = 1;
  EXPECT_TRUE(refuses(paintWith(brush, 1, painted.size()), "."));
  brush = {};
  brush.nodes = names, brush.node_count = 1;
  EXPECT_TRUE(refuses(paintWith(brush, 1, painted.size()), "A list of the brush is missing"));
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  const double rest[] = {0};
  const sweepface_matter heavy{1e9, 1, 0};
  sweepface_motion* motion = nullptr;
  EXPECT_TRUE(refuses(sweepface_motion_create_regions(rest, 1, &heavy, 1, &motion), "10000"));
  EXPECT_TRUE(refuses(sweepface_motion_create_regions(rest, 1, &heavy, 0, &motion), "1 to 32"));
  EXPECT_TRUE(refuses(sweepface_motion_create_regions(rest, 1, &heavy, SIZE_MAX, &motion),
                      "A motion has 1 to 32 regions."));
  EXPECT_EQ(motion, nullptr);
  ASSERT_EQ(sweepface_motion_create(rest, 1, &motion), SWEEPFACE_OK);
  EXPECT_TRUE(refuses(sweepface_motion_move_in(motion, 1, 0, 1, nullptr), "no region 1"));
  EXPECT_TRUE(refuses(sweepface_motion_put_in(motion, 0, 3, 1), "no weight 3"));
  sweepface_motion_free(motion);
}

}  // namespace
}  // namespace sweepface
