#include "sweepface/tangents.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <span>
#include <thread>

#include "sweepface/codec.hpp"
#include "sweepface/evaluator.hpp"
#include "sweepface/sweepface.h"

#include "capi/refuses.hpp"
#include "codec/packed.hpp"
#include "eval/textured.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// Adds texture coordinates with a seam and with mirrored triangles on either side of it.
Rig seamed(Rig rig) {
  texture(rig, [](const Vec3& p, const Vec3& middle) {
    return middle.x > 0 ? Vec2{p.x, std::abs(p.y)} : Vec2{5 - p.x, p.y + 0.5 * p.z};
  });
  return rig;
}

class FacesWithTangents : public ::testing::Test {
 protected:
  FacesWithTangents() : rig(seamed(makeRig(tee()))) { load(encode(rig)); }
  ~FacesWithTangents() override { free(); }

  void free() {
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
    sweepface_rig_free(handle);
    face = nullptr, mesh = nullptr, handle = nullptr;
  }
  void load(const std::string& bytes, uint32_t lod = 0) {
    free();
    ASSERT_EQ(sweepface_rig_load_neutral(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_mesh_create(handle, lod, &mesh), SWEEPFACE_OK) << sweepface_message();
    ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
    count = sweepface_mesh_vertex_count(mesh);
  }

  struct Written {
    std::vector<float> normals, tangents;
    friend bool operator==(const Written&, const Written&) = default;
  };
  Written tangents() {
    Written out{std::vector<float>(3 * count), std::vector<float>(4 * count)};
    EXPECT_EQ(
        sweepface_face_tangents(face, count, {out.normals.data(), 0}, {out.tangents.data(), 0}),
        SWEEPFACE_OK)
        << sweepface_message();
    return out;
  }
  std::vector<float> normals() {
    std::vector<float> out(3 * count);
    EXPECT_EQ(sweepface_face_evaluate(face, count, {}, {out.data(), 0}), SWEEPFACE_OK);
    return out;
  }

  Rig rig;
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  std::size_t count = 0;
  const double weights[3] = {0.5, -0.25, 1};
};

TEST_F(FacesWithTangents, AreTheLibrarysOwn) {
  for (const uint32_t lod : {0u, 2u}) {
    load(encode(rig), lod);
    ASSERT_GT(count, sweepface_mesh_point_count(mesh)) << "there is a seam";
    const Tessellation grid(rig.surface, lod == 0 ? 1 : 2);
    RenderMesh render = lod == 0 ? renderSource(rig, grid) : renderGrid(rig, grid);
    splitMirrored(render);
    const Tangents expected = neutralTangents(rig, grid, render, static_cast<Index>(lod));
    const Written still = tangents();
    for (std::size_t v = 0; v < count; ++v) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(still.tangents[4 * v + c], coordinate(expected.directions[v], c), 1e-3);
      EXPECT_EQ(still.tangents[4 * v + 3], expected.signs[v]);
    }
    ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
    const Written moved = tangents();
    EXPECT_NE(moved.tangents, still.tangents);
    const auto evaluator =
        Evaluator::make(rig, grid, render, expected, {.level = static_cast<Index>(lod)}).value();
    std::vector<float> directions(3 * count);
    std::vector<std::byte> scratch(evaluator.scratchBytes());
    Evaluation job;
    job.evaluator = &evaluator, job.weights = weights, job.scratch = scratch;
    job.tangents = {directions.data(), static_cast<Index>(count)};
    job.run();
    for (Index v = 0; v < render.vertexCount(); ++v)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(moved.tangents[4 * v + c], directions[3 * v + c], v < render.points ? 0 : 0.05);
  }
}

// Vertices on y = 0 belong to both mirrored and unmirrored triangles.
TEST_F(FacesWithTangents, TellMirroredTrianglesFromOthers) {
  const auto& found = tangents().tangents;
  const float* const at = sweepface_mesh_texcoords(mesh);
  const uint32_t* const corners = sweepface_mesh_triangles(mesh);
  for (uint32_t t = 0; t < sweepface_mesh_triangle_count(mesh); ++t) {
    const uint32_t* const v = corners + std::size_t{3} * t;
    const auto side = [&](int corner, int axis) {
      return at[2 * v[corner] + axis] - at[2 * v[0] + axis];
    };
    const float area = side(1, 0) * side(2, 1) - side(2, 0) * side(1, 1);
    for (int c = 0; c < 3 && area != 0; ++c) EXPECT_EQ(found[4 * v[c] + 3], area < 0 ? -1 : 1) << t;
  }
}

TEST_F(FacesWithTangents, HaveTheNormalsOfEvaluation) {
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
  const auto expected = normals(), found = tangents().normals;
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 0.06) << k;
}

TEST_F(FacesWithTangents, HaveNoSeamInTheirNormals) {
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
  const auto [normals, directions] = tangents();
  const uint32_t points = sweepface_mesh_point_count(mesh);
  ASSERT_GT(count, points);
  for (std::size_t v = points; v < count; ++v) {
    const float* const n = &normals[3 * v];
    const float* const t = &directions[4 * v];
    EXPECT_TRUE(std::equal(n, n + 3, &normals[3 * sweepface_mesh_copies(mesh)[v - points]]));
    EXPECT_NEAR(n[0] * t[0] + n[1] * t[1] + n[2] * t[2], 0, 1e-5);
    EXPECT_NEAR(std::hypot(t[0], t[1], t[2]), 1, 1e-5);
  }
}

TEST_F(FacesWithTangents, FillBuffersOfAnyStrideAndNoMoreThanAskedFor) {
  const Written all = tangents();
  struct Vertex {
    float normal[3], tangent[4], untouched;
  };
  std::vector<Vertex> mixed(count, {{7, 7, 7}, {7, 7, 7, 7}, 7});
  ASSERT_EQ(sweepface_face_tangents(face, count - 1, {mixed[0].normal, sizeof(Vertex)},
                                    {mixed[0].tangent, sizeof(Vertex)}),
            SWEEPFACE_OK);
  for (std::size_t v = 0; v < count - 1; ++v) {
    EXPECT_TRUE(std::equal(mixed[v].normal, mixed[v].normal + 3, &all.normals[3 * v]));
    EXPECT_TRUE(std::equal(mixed[v].tangent, mixed[v].tangent + 4, &all.tangents[4 * v]));
    EXPECT_EQ(mixed[v].untouched, 7);
  }
  EXPECT_EQ(mixed[count - 1].normal[0], 7);
  EXPECT_EQ(mixed[count - 1].tangent[3], 7);
  std::vector<float> alone(3 * count);
  ASSERT_EQ(sweepface_face_tangents(face, count, {alone.data(), 0}, {}), SWEEPFACE_OK);
  EXPECT_EQ(alone, all.normals);
}

// An update must not mistake values written by the tangents call for its own.
TEST_F(FacesWithTangents, AreKeptApartFromWhatIsUpdated) {
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const auto expected = normals();
  std::vector<float> buffer(4 * count + 8);
  for (const std::size_t first : {0, 4, 7}) {
    for (int twice = 0; twice < 2; ++twice) {
      ASSERT_EQ(sweepface_face_update(face, count, {}, {buffer.data() + 4, 0}), SWEEPFACE_OK);
      EXPECT_TRUE(std::ranges::equal(expected, std::span(buffer).subspan(4, 3 * count))) << first;
      ASSERT_EQ(sweepface_face_tangents(face, count, {}, {buffer.data() + first, 0}), SWEEPFACE_OK);
    }
  }
}

TEST_F(FacesWithTangents, AreThereBeforeTheirTargets) {
  load(encode(packed(rig)));
  const Written neutral = tangents();
  EXPECT_TRUE(refuses(sweepface_mesh_prepare_tangents(mesh), "sweepface_rig_load_targets first"));
  std::thread loads([&] { EXPECT_EQ(sweepface_rig_load_targets(handle), SWEEPFACE_OK); });
  for (int frame = 0; frame < 20; ++frame) EXPECT_EQ(tangents(), neutral);
  loads.join();
  EXPECT_EQ(sweepface_mesh_prepare_tangents(mesh), SWEEPFACE_OK);
  EXPECT_EQ(tangents(), neutral);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  EXPECT_NE(tangents(), neutral);
}

TEST_F(FacesWithTangents, RefuseWhatCannotBeMeant) {
  float out[4] = {7, 7, 7, 7};
  EXPECT_TRUE(refuses(sweepface_face_tangents(nullptr, 0, {}, {}), "need a face"));
  EXPECT_TRUE(refuses(sweepface_mesh_prepare_tangents(nullptr), "needs a mesh"));
  EXPECT_TRUE(
      refuses(sweepface_face_tangents(face, count + 1, {out, 0}, {out, 0}), "There are only"));
  EXPECT_TRUE(refuses(sweepface_face_tangents(face, 1, {out, 8}, {out, 0}), "stride of normals"));
  EXPECT_TRUE(refuses(sweepface_face_tangents(face, 1, {out, 0}, {out, 12}), "16 bytes"));
  EXPECT_TRUE(
      refuses(sweepface_face_tangents(face, 1, {out, 0}, {out, (1u << 30) + 1}), "gigabyte"));
  EXPECT_TRUE(refuses(sweepface_face_tangents(face, 1, {out + 1, 0}, {out, 0}), "over each other"));
  EXPECT_EQ(out[0], 7);
  load(encode(makeRig(tee())));
  constexpr auto kNone = "no texture coordinates";
  EXPECT_TRUE(refuses(sweepface_mesh_prepare_tangents(mesh), kNone));
  EXPECT_TRUE(refuses(sweepface_face_tangents(face, 1, {out, 0}, {out, 0}), kNone));
}

}  // namespace
}  // namespace sweepface
