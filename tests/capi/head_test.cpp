#include "sweepface/head.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/sweepface_head.h"
#include "sweepface/sweepface_regions.h"

#include "codec/rigs.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

constexpr double kStill = 1e-3;  // a fifth of the tolerance

/// Skin and two eyeballs; eyeLookDown_L moves only the skin.
class Eyes : public ::testing::Test {
 protected:
  Eyes() {
    PolygonMesh mesh = plane();
    first = mesh.positions.size();
    mesh = joined(mesh, cubeSphere(6, 1.5), {3, 4, -1});
    second = mesh.positions.size();
    mesh = joined(mesh, cubeSphere(6, 1.5), {-3, 4, -1});
    MeshRig source = withTargets(mesh, 1);
    std::vector<Vec3> looking = mesh.positions;
    for (std::size_t v = 0; v < first; ++v) looking[v].z += 0.2 * std::sin(looking[v].x);
    source.targets.push_back({"eyeLookDown_L", looking});
    ConvertOptions options;
    options.tolerance = 0.005;
    const std::string bytes = encode(convert(source, options).value().rig);
    EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "eyes", &rig), SWEEPFACE_OK);
    rest = played([](sweepface_face*) {});
  }
  ~Eyes() override { sweepface_rig_free(rig); }

  template <typename Set>
  std::vector<float> played(const Set& set) {
    sweepface_mesh* mesh = nullptr;
    sweepface_face* face = nullptr;
    EXPECT_EQ(sweepface_mesh_create(rig, 0, &mesh), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
    set(face);
    std::vector<float> out(3 * sweepface_mesh_point_count(mesh));
    EXPECT_EQ(sweepface_face_evaluate(face, out.size() / 3, {out.data(), 0}, {nullptr, 0}),
              SWEEPFACE_OK);
    sweepface_mesh_free(mesh);
    sweepface_face_free(face);
    return out;
  }
  static Vec3 vertex(const std::vector<float>& positions, std::size_t v) {
    return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
  }
  double moved(const std::vector<float>& now, std::size_t from, std::size_t to) const {
    double most = 0;
    for (std::size_t v = from; v < to; ++v)
      most = std::max(most, norm(vertex(now, v) - vertex(rest, v)));
    return most;
  }

  std::size_t first = 0, second = 0;  // the first vertex of each eye
  sweepface_rig* rig = nullptr;
  std::vector<float> rest;
};

TEST_F(Eyes, TurnRigidlyByAnglesAndByWeights) {
  uint32_t eyes = 0, down = 0;
  const uint32_t targets = sweepface_rig_target_count(rig);
  ASSERT_EQ(sweepface_rig_find_target(rig, "eyeLookDown_L", &down), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_OK) << sweepface_message();
  EXPECT_EQ(eyes, 2U);
  EXPECT_EQ(sweepface_rig_target_count(rig), targets);  // the targets that turn them stay hidden
  EXPECT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_BAD_ARGUMENT);

  const auto looked = played([](sweepface_face* face) {
    const sweepface_pose pose{{}, {0.4, 0.3, 0}, {}};
    EXPECT_EQ(sweepface_face_look(face, &pose), SWEEPFACE_OK);
  });
  const Quaternion by = quaternionOf({0.4, 0.3, 0});
  const Vec3 centre{3, 4, -1}, front = centre + Vec3{0, 0, 1.5};
  EXPECT_LT(moved(looked, 0, first), kStill);
  EXPECT_LT(moved(looked, second, rest.size() / 3), kStill);
  EXPECT_GT(moved(looked, first, second), 0.5);
  for (std::size_t v = first; v < second; ++v) {
    EXPECT_NEAR(norm(vertex(looked, v) - centre), norm(vertex(rest, v) - centre), 0.01);
    if (norm(vertex(rest, v) - front) < 0.01) {
      EXPECT_LT(norm(vertex(looked, v) - centre - turned(by, front - centre)), 0.02);
    }
  }

  const auto down1 = played([&](sweepface_face* face) {
    EXPECT_EQ(sweepface_face_set_weight(face, down, 1), SWEEPFACE_OK);
  });
  EXPECT_GT(moved(down1, first, second), 0.5);
  const auto again = played([&](sweepface_face* face) {
    const sweepface_pose ahead{};
    EXPECT_EQ(sweepface_face_look(face, &ahead), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_face_look(face, nullptr), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_face_set_weight(face, down, 1), SWEEPFACE_OK);
    for (const sweepface_pose& wild : {sweepface_pose{{}, {NAN, 0, 0}, {}}, {{}, {}, {0, NAN, 0}}})
      EXPECT_EQ(sweepface_face_look(face, &wild), SWEEPFACE_BAD_ARGUMENT);
  });
  EXPECT_EQ(again, down1);
}

TEST_F(Eyes, ThatLookAsideAreFurtherFromTheSurface) {
  uint32_t eyes = 0;
  ASSERT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_OK);
  played([](sweepface_face* face) {
    const double ahead = sweepface_face_error(face);
    const sweepface_pose aside{{}, {0.4, 0.3, 0}, {}};
    EXPECT_EQ(sweepface_face_look(face, &aside), SWEEPFACE_OK);
    EXPECT_GT(sweepface_face_error(face), ahead);
  });
}

// Whichever call comes first: dividing the rig or turning its eyes.
TEST_F(Eyes, StayWholeWhereARegionEndsInABall) {
  const double below[] = {3, 2.5, -1};
  sweepface_brush brush{};
  brush.points = below, brush.point_count = 1;
  brush.whole = 1, brush.fade = 1.5, brush.through_space = 1;
  std::vector<double> shares(sweepface_rig_node_count(rig));
  ASSERT_EQ(sweepface_rig_paint(rig, &brush, 0, shares.data(), shares.size()), SWEEPFACE_OK);
  const char* const names[] = {"below"};
  uint32_t eyes = 0, down = 0;
  ASSERT_EQ(sweepface_rig_find_target(rig, "eyeLookDown_L", &down), SWEEPFACE_OK);
  for (int round = 0; round < 2; ++round) {
    ASSERT_EQ(sweepface_rig_divide(rig, names, shares.data(), 1), SWEEPFACE_OK);
    if (round == 0) {
      ASSERT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_OK);
    }
    const auto looked = played([&](sweepface_face* face) {
      std::vector<double> weights(sweepface_rig_target_count(rig));
      weights[down] = 1;
      EXPECT_EQ(sweepface_face_set_region_weights(face, 0, weights.data(), weights.size()),
                SWEEPFACE_OK);
    });
    for (std::size_t v = first; v < second; ++v)
      EXPECT_NEAR(norm(vertex(looked, v) - vertex(looked, first)),
                  norm(vertex(rest, v) - vertex(rest, first)), 0.01);
  }
}

TEST_F(Eyes, LeaveTheNamesOfTargetsWhereTheyAre) {
  const char* const name = sweepface_rig_target_name(rig, 0);
  uint32_t eyes = 0;
  ASSERT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_target_name(rig, 0), name);
}

TEST_F(Eyes, AreSaidToTurnBeforeMeshesAndAfterWhatFollows) {
  uint32_t eyes = 0;
  sweepface_mesh* mesh = nullptr;
  ASSERT_EQ(sweepface_mesh_create(rig, 0, &mesh), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_NE(std::string_view(sweepface_message()).find("before a rig has meshes"),
            std::string_view::npos);
  sweepface_mesh_free(mesh);
  ASSERT_EQ(sweepface_rig_turn_eyes(rig, &eyes), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_follow(rig, SWEEPFACE_COMBINE), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_NE(std::string_view(sweepface_message()).find("before eyes turn"), std::string_view::npos);
}

TEST(NoEyes, TurnNoWay) {
  const std::string bytes = encode(dressed(makeRig(tee())));
  sweepface_rig* handle = nullptr;
  ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  uint32_t eyes = 7;
  ASSERT_EQ(sweepface_rig_turn_eyes(handle, &eyes), SWEEPFACE_OK);
  EXPECT_EQ(eyes, 0U);
  EXPECT_EQ(sweepface_rig_turn_eyes(nullptr, &eyes), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_face_look(nullptr, nullptr), SWEEPFACE_BAD_ARGUMENT);
  sweepface_rig_free(handle);
}

}  // namespace
}  // namespace sweepface
