#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <pthread.h>
#include <set>
#include <thread>
#include <tuple>

#include "sweepface/arcs.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/origins.hpp"
#include "sweepface/sweepface.h"
#include "sweepface/sweepface_head.h"
#include "sweepface/sweepface_regions.h"

#include "allocations.hpp"
#include "capi/refuses.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace testing;

constexpr sweepface_vectors kUnwanted{nullptr, 0};

/// A face with loose vertices, seams and three targets: "open", "wink é" and "rest".
class Faces : public ::testing::Test {
 protected:
  Faces() : rig(dressed(makeRig(tee()))) { load(rig); }
  ~Faces() override {
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
    sweepface_rig_free(handle);
  }

  void load(const Rig& other) {
    sweepface_rig_free(handle);
    const std::string bytes = encode(other);
    ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  }

  void make(uint32_t lod) {
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
    ASSERT_EQ(sweepface_mesh_create(handle, lod, &mesh), SWEEPFACE_OK) << sweepface_message();
    ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  }

  std::vector<float> evaluate(bool normals = false) {
    std::vector<float> out(3 * sweepface_mesh_vertex_count(mesh));
    const sweepface_vectors to{out.data(), 0};
    EXPECT_EQ(sweepface_face_evaluate(face, out.size() / 3, normals ? kUnwanted : to,
                                      normals ? to : kUnwanted),
              SWEEPFACE_OK);
    return out;
  }

  /// Plays poses of three weights one after another into the same buffers.
  void expectUpdatesToBeWhole(const std::vector<std::array<double, 3>>& poses) {
    const std::size_t count = sweepface_mesh_vertex_count(mesh);
    std::vector<float> positions(3 * count), normals(3 * count);
    for (const auto& weights : poses) {
      ASSERT_EQ(sweepface_face_set_weights(face, weights.data(), 3), SWEEPFACE_OK);
      ASSERT_EQ(sweepface_face_update(face, count, {positions.data(), 0}, {normals.data(), 0}),
                SWEEPFACE_OK);
      sweepface_face* whole = nullptr;
      ASSERT_EQ(sweepface_face_create(mesh, &whole), SWEEPFACE_OK);
      std::swap(whole, face);
      ASSERT_EQ(sweepface_face_set_weights(face, weights.data(), 3), SWEEPFACE_OK);
      EXPECT_EQ(positions, evaluate());
      EXPECT_EQ(normals, evaluate(true));
      std::swap(whole, face);
      sweepface_face_free(whole);
    }
  }

  Rig rig;
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
};

void expectNear(const std::vector<Vec3>& expected, const std::vector<float>& found, double most) {
  ASSERT_LE(3 * expected.size(), found.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_LE(norm(expected[v] - Vec3{found[3 * v], found[3 * v + 1], found[3 * v + 2]}), most);
}

TEST_F(Faces, HaveTheRigsTargets) {
  ASSERT_EQ(sweepface_rig_target_count(handle), 3u);
  EXPECT_STREQ(sweepface_rig_target_name(handle, 1), "wink \xC3\xA9");
  EXPECT_EQ(sweepface_rig_target_name(handle, 3), nullptr);
  uint32_t target = 9;
  EXPECT_EQ(sweepface_rig_find_target(handle, "rest", &target), SWEEPFACE_OK);
  EXPECT_EQ(target, 2u);
  EXPECT_TRUE(refuses(sweepface_rig_find_target(handle, "frown", &target),
                      "There is no target named 'frown'; its targets are open, wink"));
  EXPECT_EQ(target, 2u);
  EXPECT_EQ(sweepface_rig_tolerance(handle), rig.tolerance);
}

TEST_F(Faces, AreTheLibrarysOwnInTheSourcesOrder) {
  make(0);
  const Tessellation grid(rig.surface, 1);
  const double weights[] = {0.5, -0.25, 1};
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
  const auto vectors = blend(rig, weights);
  EXPECT_EQ(sweepface_mesh_point_count(mesh), rig.source.gridVertex.size());
  expectNear(sourcePositions(rig, grid, vectors, weights), evaluate(), sweepface_face_error(face));
  EXPECT_LE(sweepface_face_error(face), 0.6 * rig.tolerance);
  expectNear(sourceNormals(rig, grid, vectors), evaluate(true), 0.08);
}

TEST(FacesThatFollow, LeaveTheNamesOfTargetsWhereTheyAre) {
  Rig rig = dressed(makeRig(tee()));
  for (Index k = 0; k < std::ssize(rig.targets); ++k)
    rig.turns.push_back({k, {3, 4, 5}, {0, 0, 1}});
  const std::string bytes = encode(rig);
  sweepface_rig* handle = nullptr;
  ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  const char* const name = sweepface_rig_target_name(handle, 0);
  ASSERT_EQ(sweepface_rig_follow(handle, SWEEPFACE_ARCS), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_target_name(handle, 0), name);
  sweepface_rig_free(handle);
}

TEST(FacesThatFollow, GoOnArcsAndCombine) {
  Rig rig = withTurns(dressed(makeRig(tee())));
  rig.targets[1].name = "rest_open";  // driven by the product of both
  rig.turns = {{0, {3, 4, 5}, {0, 0, 1}}};
  const std::string bytes = encode(rig);
  rig = decode(bytes, "tee").value();
  sweepface_rig* handle = nullptr;
  ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_turn_count(handle), 1u);
  const std::vector<std::string> names{"open", "rest_open", "rest"};
  const double weights[] = {0.5, 0.3, 0.25};
  std::map<uint32_t, double> errors;
  for (const uint32_t what : {0u, 1u, 2u, 3u, 0u}) {  // arcs, combine, both
    Rig all = rig;
    std::vector<Follower> followers;
    if (what & SWEEPFACE_COMBINE) followers = Followers::named(names);
    if (what & SWEEPFACE_ARCS)
      for (const Follower& arc : addArcs(all, all.turns)) followers.push_back(arc);
    Weights expected(weights, weights + 3);
    expected.resize(all.targets.size());
    Followers(followers).apply(expected);
    EXPECT_EQ(all.targets.size(), what & SWEEPFACE_ARCS ? 4u : 3u);

    ASSERT_EQ(sweepface_rig_follow(handle, what), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_rig_target_count(handle), 3u);
    EXPECT_EQ(sweepface_rig_target_name(handle, 3), nullptr);
    uint32_t target = 9;
    EXPECT_NE(sweepface_rig_find_target(handle, "open.arc", &target), SWEEPFACE_OK);
    sweepface_mesh* mesh = nullptr;
    sweepface_face* face = nullptr;
    ASSERT_EQ(sweepface_mesh_create(handle, 1, &mesh), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_rig_follow(handle, 0), SWEEPFACE_BAD_ARGUMENT);  // its meshes would change
    ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
    EXPECT_EQ(sweepface_face_weights(face)[1], 0.3);  // still the weight that was set
    std::vector<float> out(3 * sweepface_mesh_vertex_count(mesh));
    ASSERT_EQ(sweepface_face_evaluate(face, out.size() / 3, {out.data(), 0}, kUnwanted),
              SWEEPFACE_OK);
    expectNear(Tessellation(all.surface, 1).positions(blend(all, expected)), out,
               sweepface_face_error(face));
    const double first = errors.emplace(what, sweepface_face_error(face)).first->second;
    EXPECT_EQ(sweepface_face_error(face), first) << "nothing is left of what followed before";
    sweepface_face_free(face);
    sweepface_mesh_free(mesh);
  }
  EXPECT_EQ(sweepface_rig_follow(handle, 4), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_rig_follow(nullptr, 1), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_rig_turn_count(nullptr), 0u);
  sweepface_rig_free(handle);
}

/// A rig of one target under these names.
sweepface_rig* loadNamed(const std::vector<std::string>& names) {
  Rig rig = makeRig(tee());
  rig.targets.resize(1);
  for (const std::string& name : names) rig.targets.emplace_back(rig.targets[0]).name = name;
  rig.targets.erase(rig.targets.begin());
  const std::string bytes = encode(rig);
  sweepface_rig* handle = nullptr;
  EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK)
      << sweepface_message();
  return handle;
}

/// Each in-between extrapolates the one before a hundredfold.
TEST(FacesThatFollow, StayFiniteHoweverFarInBetweensAre) {
  std::vector<std::string> names{"A", "B", "A.99"};
  for (int k = 0; k < 160; ++k) names.push_back(names.back() + ".01");
  names.push_back(names.back() + "_B");
  sweepface_rig* const rig = loadNamed(names);
  ASSERT_EQ(sweepface_rig_follow(rig, SWEEPFACE_COMBINE), SWEEPFACE_OK);
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  ASSERT_EQ(sweepface_mesh_create(rig, 1, &mesh), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  for (const double weight : {2.0, -1.0}) {
    ASSERT_EQ(sweepface_face_set_weight(face, 0, weight), SWEEPFACE_OK);
    double low[3], high[3];
    ASSERT_EQ(sweepface_face_box(face, low, high), SWEEPFACE_OK);
    EXPECT_FALSE(std::isnan(low[0] + high[0]));
    EXPECT_FALSE(std::isnan(sweepface_face_error(face)));
    std::vector<float> out(3 * sweepface_mesh_vertex_count(mesh));
    ASSERT_EQ(sweepface_face_evaluate(face, out.size() / 3, {out.data(), 0}, kUnwanted),
              SWEEPFACE_OK);
    for (const float x : out) ASSERT_TRUE(std::isfinite(x));
  }
  sweepface_face_free(face);
  sweepface_mesh_free(mesh);
  sweepface_rig_free(rig);
}

TEST(FacesThatFollow, HaveNotTooManyTargets) {
  std::vector<std::string> names;
  for (int k = 0; k < 4097; ++k) names.push_back(std::to_string(k));
  sweepface_rig* const rig = loadNamed(names);
  EXPECT_EQ(sweepface_rig_follow(rig, 0), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_follow(rig, SWEEPFACE_COMBINE), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_STREQ(sweepface_message(), "Weights follow in faces of up to 4096 targets, not of 4097.");
  sweepface_rig_free(rig);
}

TEST_F(Faces, AreTheLibrarysOwnAtAnyLevel) {
  make(3);
  const Tessellation grid(rig.surface, 3);
  ASSERT_EQ(sweepface_face_set_weight(face, 1, 0.75), SWEEPFACE_OK);
  const auto vectors = blend(rig, Weights{0, 0.75, 0});
  EXPECT_EQ(sweepface_mesh_point_count(mesh), static_cast<uint32_t>(grid.vertexCount()));
  expectNear(grid.positions(vectors), evaluate(), sweepface_face_error(face));
  expectNear(grid.normals(vectors), evaluate(true), 0.08);
}

TEST_F(Faces, RepeatPointsAtSeams) {
  make(0);
  const uint32_t points = sweepface_mesh_point_count(mesh);
  const uint32_t vertices = sweepface_mesh_vertex_count(mesh);
  ASSERT_GT(vertices, points);
  const uint32_t* const copies = sweepface_mesh_copies(mesh);
  const auto positions = evaluate();
  for (uint32_t v = points; v < vertices; ++v) {
    const uint32_t original = copies[v - points];
    ASSERT_LT(original, points) << v;
    EXPECT_TRUE(std::equal(&positions[3 * v], &positions[3 * v] + 3, &positions[3 * original]))
        << v;
  }
}

TEST_F(Faces, HaveAPartForEachMaterial) {
  make(0);
  std::multiset<std::string> materials;
  uint32_t triangles = 0;
  for (uint32_t p = 0; p < sweepface_mesh_part_count(mesh); ++p) {
    sweepface_part part;
    ASSERT_EQ(sweepface_mesh_part(mesh, p, &part), SWEEPFACE_OK);
    EXPECT_EQ(part.first_triangle, triangles);
    triangles += part.triangle_count;
    materials.insert(part.material);
  }
  EXPECT_EQ(triangles, sweepface_mesh_triangle_count(mesh));
  EXPECT_EQ(materials, (std::multiset<std::string>{"", "", "skin"})) << "none, and one of no name";
}

TEST_F(Faces, FillBuffersOfAnyStride) {
  make(0);
  const auto positions = evaluate(), normals = evaluate(true);
  const std::size_t count = positions.size() / 3;
  struct Vertex {
    float position[3], normal[3], untouched;
  };
  std::vector<Vertex> mixed(count + 1, {{7, 7, 7}, {7, 7, 7}, 7});
  ASSERT_EQ(sweepface_face_evaluate(face, count, {mixed[0].position, sizeof(Vertex)},
                                    {mixed[0].normal, sizeof(Vertex)}),
            SWEEPFACE_OK);
  for (std::size_t v = 0; v < count; ++v) {
    EXPECT_TRUE(std::equal(mixed[v].position, mixed[v].position + 3, &positions[3 * v]));
    EXPECT_TRUE(std::equal(mixed[v].normal, mixed[v].normal + 3, &normals[3 * v]));
    EXPECT_EQ(mixed[v].untouched, 7);
  }
  EXPECT_EQ(mixed[count].position[0], 7);
}

TEST_F(Faces, FillNoMoreVerticesThanAskedFor) {
  make(0);
  const auto all = evaluate();
  std::vector<float> some(9, 7);
  ASSERT_EQ(sweepface_face_evaluate(face, 2, {some.data(), 0}, kUnwanted), SWEEPFACE_OK);
  EXPECT_TRUE(std::equal(some.begin(), some.begin() + 6, all.begin()));
  EXPECT_EQ(some[6], 7);
}

TEST_F(Faces, EvaluateWithoutAllocating) {
  make(2);
  std::vector<float> out(3 * sweepface_mesh_vertex_count(mesh)), normals(out.size());
  const double weights[] = {0.1, 0.2, 0.3};
  std::vector<float> tangents(out.size() / 3 * 4);
  EXPECT_EQ(sweepface_mesh_prepare(mesh, 1), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_mesh_prepare_tangents(mesh), SWEEPFACE_OK);
  double low[3], high[3];
  EXPECT_EQ(sweepface_face_set_weight(face, 0, 0.1), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_box(face, low, high), SWEEPFACE_OK);
  if (!watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const std::size_t before = allocations.count;
  EXPECT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_evaluate(face, out.size() / 3, {out.data(), 0}, {normals.data(), 0}),
            SWEEPFACE_OK);
  EXPECT_EQ(
      sweepface_face_tangents(face, out.size() / 3, {normals.data(), 0}, {tangents.data(), 0}),
      SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_box(face, low, high), SWEEPFACE_OK);
  EXPECT_EQ(allocations.count, before);
  sweepface_face* another = nullptr;
  EXPECT_EQ(sweepface_face_create(mesh, &another), SWEEPFACE_OK);
  EXPECT_GT(allocations.count, before);  // checks that the counter works
  sweepface_face_free(another);
}

/// Thread function that loads a file and plays its vertices.
void* playBytes(void* given) {
  const std::string& bytes = *static_cast<const std::string*>(given);
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), nullptr, &handle), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_mesh_create(handle, 2, &mesh), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_mesh_prepare(mesh, 1), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  std::vector<float> out(3 * count), normals(3 * count);
  EXPECT_EQ(sweepface_face_evaluate(face, count, {out.data(), 0}, {normals.data(), 0}),
            SWEEPFACE_OK);
  sweepface_face_free(face);
  sweepface_mesh_free(mesh);
  sweepface_rig_free(handle);
  return nullptr;
}

TEST(Stacks, OfJobSystemsAreLargeEnough) {
#ifdef SWEEPFACE_SANITIZED
  GTEST_SKIP() << "sanitizers take more";
#endif
  for (const Rig& rig : {dressed(makeRig(sheet(20))), packed(dressed(makeRig(sheet(20))))}) {
    std::string bytes = encode(rig);
    pthread_attr_t small;
    pthread_attr_init(&small);
    std::size_t size = 65536;
#ifdef PTHREAD_STACK_MIN
    size = std::max<std::size_t>(size, PTHREAD_STACK_MIN);  // larger on some systems
#endif
    ASSERT_EQ(pthread_attr_setstacksize(&small, size), 0);
    pthread_t thread;
    ASSERT_EQ(pthread_create(&thread, &small, playBytes, &bytes), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&small);
  }
}

TEST(FacesWithoutTargets, HaveNoModes) {
  Rig rig = makeRig(tee());
  rig.targets.clear();
  const std::string bytes = encode(rig);
  sweepface_rig* handle = nullptr;
  sweepface_mesh* mesh = nullptr;
  sweepface_face* face = nullptr;
  ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_mesh_create(handle, 1, &mesh), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_create(mesh, &face), SWEEPFACE_OK);
  float factor = 0;
  EXPECT_EQ(sweepface_face_modes(face, 0, nullptr, 0, &factor), SWEEPFACE_OK);
  sweepface_face_free(face);
  sweepface_mesh_free(mesh);
  sweepface_rig_free(handle);
}

/// The rows of all points, computed as the header tells a shader to.
std::vector<Vec3> shaderRows(sweepface_mesh* mesh, sweepface_face* face, bool tangents) {
  sweepface_shader_tables tables{};
  EXPECT_EQ(sweepface_mesh_shader_tables(mesh, tangents, &tables), SWEEPFACE_OK);
  std::vector<std::int16_t> modes(4 * std::size_t(tables.mode_count));
  float factor = 0;
  EXPECT_EQ(sweepface_face_modes(face, tangents, modes.data(), tables.mode_count, &factor),
            SWEEPFACE_OK);
  const std::uint32_t points = sweepface_mesh_point_count(mesh), rows = tangents ? 2 : 1;
  std::vector<Vec3> out;
  for (std::uint32_t k = 0; k < points * rows; ++k) {
    const std::uint32_t* const place = tables.places + 3 * (k / rows);
    const std::uint32_t at = place[1] / 64, texels = place[1] % 64;
    const std::int16_t* const basis = tables.basis + 4 * (place[0] + k % rows * texels);
    Vec3 sum;
    for (std::uint32_t m = 0; m < 4 * texels; ++m)
      sum += double(basis[m]) * Vec3{double(modes[4 * (at + m)]), double(modes[4 * (at + m) + 1]),
                                     double(modes[4 * (at + m) + 2])};
    const float* const neutral = tables.neutral + 3 * k;
    out.push_back(Vec3{neutral[0], neutral[1], neutral[2]} +
                  double(std::bit_cast<float>(place[2])) * factor * sum);
  }
  return out;
}

TEST_F(Faces, AreWhatAShaderMakesOfItsTables) {
  for (const uint32_t lod : {0, 2}) {
    make(lod);
    for (const std::vector<double>& weights :
         {std::vector{0.0, 0.0, 0.0}, std::vector{0.7, -3.0, 1.5}}) {
      ASSERT_EQ(sweepface_face_set_weights(face, weights.data(), 3), SWEEPFACE_OK);
      const auto tangents = shaderRows(mesh, face, true);
      std::vector<Vec3> normals;
      for (std::size_t p = 0; p < tangents.size(); p += 2)
        normals.push_back(normalized(cross(tangents[p], tangents[p + 1])));
      expectNear(shaderRows(mesh, face, false), evaluate(), 1e-5);
      expectNear(normals, evaluate(true), 1e-4);
    }
    sweepface_face_free(std::exchange(face, nullptr));
    sweepface_mesh_free(std::exchange(mesh, nullptr));
  }
}

// Also at the largest allowed weights, whose product would exceed the limit.
TEST_F(Faces, ThatCombineAreThoseWhoseProductIsSetByHand) {
  rig.targets[1].name = "rest_open";
  const auto played = [&](uint32_t follow, const std::array<double, 3>& weights) {
    load(rig);
    EXPECT_EQ(sweepface_rig_follow(handle, follow), SWEEPFACE_OK);
    make(1);
    EXPECT_EQ(sweepface_face_set_weights(face, weights.data(), 3), SWEEPFACE_OK);
    std::tuple all(evaluate(), shaderRows(mesh, face, false), shaderRows(mesh, face, true));
    sweepface_face_free(std::exchange(face, nullptr));
    sweepface_mesh_free(std::exchange(mesh, nullptr));
    return all;
  };
  constexpr double most = SWEEPFACE_MOST_WEIGHT;
  for (const auto& [weight, product] : {std::pair(0.5, 0.25), {-0.5, 0.25}, {most, most}})
    EXPECT_EQ(played(SWEEPFACE_COMBINE, {weight, 0, weight}), played(0, {weight, product, weight}));
}

TEST_F(Faces, AreUpdatedToWhatAWholeEvaluationWrites) {
  make(2);
  expectUpdatesToBeWhole(
      {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0, 0.25}, {0.5, 2, 0.25}, {0, 0, 0}, {0, 1, 0}});
}

TEST_F(Faces, AreUpdatedFromTheNeutralWhereAnotherTargetIsLarge) {
  Rig large = makeRig(sheet(12));
  for (Target& target : large.targets) std::ranges::fill(target.difference, Vec3{});
  large.targets[0].difference.front() = {0, 0, 1e4};
  large.targets[1].difference.back() = {0, 0, 1};
  load(large);
  make(1);
  expectUpdatesToBeWhole({{0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}});
}

TEST_F(Faces, AreUpdatedInOneBufferForPositionsAndNormalsInTurn) {
  make(2);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  std::vector<float> shared(3 * count);
  const sweepface_vectors here{shared.data(), 0};
  ASSERT_EQ(sweepface_face_set_weight(face, 1, 0.5), SWEEPFACE_OK);
  const std::vector<float> positions = evaluate(), normals = evaluate(true);
  for (int k = 0; k < 2; ++k) {
    ASSERT_EQ(sweepface_face_update(face, count, here, kUnwanted), SWEEPFACE_OK);
    EXPECT_EQ(shared, positions);
    ASSERT_EQ(sweepface_face_update(face, count, kUnwanted, here), SWEEPFACE_OK);
    EXPECT_EQ(shared, normals);
  }
}

TEST_F(Faces, AreWrittenInFullWhereTheyHaveNotBeenBefore) {
  make(0);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  const std::vector<float> all = evaluate();
  std::vector<float> first(3 * count), second(3 * count);
  for (auto* out : {&first, &second}) {
    ASSERT_EQ(sweepface_face_update(face, count, {out->data(), 0}, kUnwanted), SWEEPFACE_OK);
    EXPECT_EQ(*out, all);
  }
}

TEST_F(Faces, AreWrittenInFullAtAnotherStrideOrCount) {
  make(2);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const std::vector<float> all = evaluate();
  const std::size_t count = all.size() / 3;
  std::vector<float> out(4 * count);
  for (const auto& [vertices, floats] : {std::pair(std::size_t{4}, 3), {count, 3}, {count, 4}}) {
    ASSERT_EQ(
        sweepface_face_update(face, vertices, {out.data(), floats * sizeof(float)}, kUnwanted),
        SWEEPFACE_OK);
    for (std::size_t v = 0; v < vertices; ++v)
      EXPECT_TRUE(std::equal(&out[floats * v], &out[floats * v] + 3, &all[3 * v])) << v;
  }
}

TEST_F(Faces, AreUpdatedInThreeBuffersInTurn) {
  make(2);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  std::array<std::vector<float>, 4> buffers;
  buffers.fill(std::vector<float>(3 * count));
  const auto update = [&](std::vector<float>& to) {
    ASSERT_EQ(sweepface_face_update(face, count, {to.data(), 0}, kUnwanted), SWEEPFACE_OK);
  };
  for (int frame = 0; frame < 12; ++frame) {
    ASSERT_EQ(sweepface_face_set_weight(face, frame % 2, 0.1 * frame + 0.1), SWEEPFACE_OK);
    update(buffers[frame % 3]);
    EXPECT_EQ(buffers[frame % 3], evaluate()) << frame;
  }
  for (std::size_t k = 0; k < 3; ++k) update(buffers[k]);
  constexpr float mark = 1e9f;
  for (auto& buffer : buffers) buffer[0] = mark;
  for (std::size_t k = 0; k < 3; ++k) {
    update(buffers[k]);
    EXPECT_EQ(buffers[k][0], mark) << "nothing has moved";
  }
  update(buffers[3]);
  update(buffers[0]);
  for (const std::size_t k : {3, 0})
    EXPECT_EQ(buffers[k], evaluate()) << "of four one is forgotten";
}

TEST_F(Faces, AreUpdatedWhereTheirBuffersOverlap) {
  make(1);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const std::vector<float> all = evaluate();
  std::vector<float> shared(3 * count + 3);
  for (const std::size_t first : {0, 3, 0, 3}) {
    ASSERT_EQ(sweepface_face_update(face, count, {shared.data() + first, 0}, kUnwanted),
              SWEEPFACE_OK);
    EXPECT_TRUE(std::ranges::equal(all, std::span(shared).subspan(first, 3 * count)));
  }
}

TEST_F(Faces, AreWrittenInFullWhereAnotherOutputWasWrittenOverThem) {
  make(1);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  const std::vector<float> positions = evaluate(), normals = evaluate(true);
  std::vector<float> shared(6 * count + 4);
  const auto at = [&](std::size_t first, std::size_t floats) {
    return sweepface_vectors{shared.data() + first, floats * sizeof(float)};
  };
  const auto isThere = [&](const std::vector<float>& expected, std::size_t first) {
    return std::ranges::equal(expected, std::span(shared).subspan(first, 3 * count));
  };
  for (const auto& [first, floats] : {std::pair{0, 3}, {1, 3}, {4, 3}, {0, 4}, {2, 6}}) {
    for (int k = 0; k < 2; ++k) {
      ASSERT_EQ(sweepface_face_update(face, count, at(0, 3), kUnwanted), SWEEPFACE_OK);
      EXPECT_TRUE(isThere(positions, 0)) << first << " " << floats;
      ASSERT_EQ(sweepface_face_update(face, count, kUnwanted, at(first, floats)), SWEEPFACE_OK);
      EXPECT_TRUE(floats != 3 || isThere(normals, first)) << first;
    }
  }
}

TEST_F(Faces, AreUpdatedInPartsOfTheSameStructs) {
  make(1);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  std::vector<float> vertices(6 * count);
  constexpr std::size_t kStride = 6 * sizeof(float);
  const sweepface_vectors positions{vertices.data() + 3, kStride},
      normals{vertices.data(), kStride};
  ASSERT_EQ(sweepface_face_update(face, count, positions, normals), SWEEPFACE_OK);
  constexpr float kMark = 1e9f;
  vertices[0] = vertices[3] = kMark;
  ASSERT_EQ(sweepface_face_update(face, count, positions, normals), SWEEPFACE_OK);
  EXPECT_EQ(vertices[0], kMark) << "nothing has moved";
  EXPECT_EQ(vertices[3], kMark);
}

TEST_F(Faces, AreMatchedWithTrackersNames) {
  Rig sided = makeRig(tee());
  for (const int k : {0, 1, 2})
    sided.targets[k].name = std::array{"blink_L", "blink_R", "jawOpen"}[k];
  load(sided);
  uint32_t found[3] = {9, 9, 9};
  EXPECT_EQ(sweepface_rig_match_targets(handle, "BlinkRight", found, 3), 1U);
  EXPECT_EQ(found[0], 1U);
  EXPECT_EQ(sweepface_rig_match_targets(handle, "blink", found, 1), 2U);
  EXPECT_EQ(found[0], 0U);
  EXPECT_EQ(found[1], 9U) << "there is room for one";
  EXPECT_EQ(sweepface_rig_match_targets(handle, "blink", nullptr, 3), 2U);
  for (const char* none : {"tongueOut", ""})
    EXPECT_EQ(sweepface_rig_match_targets(handle, none, found, 3), 0U);
  EXPECT_EQ(sweepface_rig_match_targets(nullptr, "blink", found, 3), 0U);
}

TEST_F(Faces, AreInABox) {
  make(0);
  double low[3], high[3];
  sweepface_rig_box(handle, low, high);
  const std::vector<float> positions = evaluate();
  for (std::size_t c = 0; c < 3; ++c) {
    float least = positions[c], most = positions[c];
    for (std::size_t k = c; k < positions.size(); k += 3)
      least = std::min(least, positions[k]), most = std::max(most, positions[k]);
    EXPECT_NEAR(low[c], least, sweepface_face_error(face));
    EXPECT_NEAR(high[c], most, sweepface_face_error(face));
  }
  sweepface_rig_box(nullptr, low, high);
  EXPECT_EQ(low[0], 0);
  EXPECT_EQ(high[2], 0);
}

TEST_F(Faces, AreInABoxThatMovesWithThem) {
  make(2);
  double low[3], high[3];
  for (const std::array<double, 3>& weights :
       {std::array{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {-2.0, 0.5, 1.0}, {1e6, -1e6, 1e6}}) {
    ASSERT_EQ(sweepface_face_set_weights(face, weights.data(), 3), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_face_box(face, low, high), SWEEPFACE_OK);
    const auto positions = evaluate();
    for (std::size_t k = 0; k < positions.size(); ++k) {
      EXPECT_GE(positions[k], low[k % 3]);
      EXPECT_LE(positions[k], high[k % 3]);
    }
  }
  EXPECT_TRUE(refuses(sweepface_face_box(nullptr, low, high), "needs a face"));
  EXPECT_TRUE(refuses(sweepface_face_box(face, nullptr, high), "needs a face"));
}

TEST_F(Faces, AreAsFineAsABudgetAsks) {
  make(0);
  for (const uint32_t most : {40u, 400u}) {
    sweepface_mesh* within = nullptr;
    ASSERT_EQ(sweepface_mesh_create_within(handle, SWEEPFACE_BUDGET_VERTICES, most, &within),
              SWEEPFACE_OK)
        << sweepface_message();
    EXPECT_LE(sweepface_mesh_point_count(within), most);
    EXPECT_GT(sweepface_mesh_point_count(within), most / 3);
    sweepface_face* played = nullptr;
    ASSERT_EQ(sweepface_face_create(within, &played), SWEEPFACE_OK);
    ASSERT_EQ(sweepface_face_set_weight(played, 0, 0.5), SWEEPFACE_OK);
    const size_t count = sweepface_mesh_vertex_count(within);
    std::vector<float> positions(3 * count), normals(3 * count);
    ASSERT_EQ(sweepface_face_evaluate(played, count, {positions.data(), 0}, {normals.data(), 0}),
              SWEEPFACE_OK);
    const auto density = densityFor(rig.surface, blend(rig, {}),
                                    {Budget::Kind::vertices, static_cast<double>(most)});
    const Tessellation grid(rig.surface, density.value());
    const double weights[] = {0.5};
    expectNear(grid.positions(blend(rig, weights)), positions, sweepface_face_error(played));
    sweepface_face_free(played);
    sweepface_mesh_free(within);
  }
  sweepface_mesh* none = nullptr;
  EXPECT_TRUE(refuses(sweepface_mesh_create_within(handle, 3, 1, &none),
                      "There is no budget of kind 3; kinds are 0 to 2."));
  EXPECT_TRUE(
      refuses(sweepface_mesh_create_within(handle, SWEEPFACE_BUDGET_ERROR, -1, &none), "greater"));
  EXPECT_TRUE(refuses(sweepface_mesh_create_within(handle, SWEEPFACE_BUDGET_VERTICES, 1e12, &none),
                      "at most"));
}

TEST_F(Faces, KeepAliveWhatTheyAreMadeOf) {
  make(0);
  const auto before = evaluate();
  const uint32_t count = sweepface_mesh_vertex_count(mesh);
  sweepface_rig_free(std::exchange(handle, nullptr));
  EXPECT_EQ(evaluate(), before);
  sweepface_mesh_free(std::exchange(mesh, nullptr));
  std::vector<float> after(before.size());
  EXPECT_EQ(sweepface_face_evaluate(face, count, {after.data(), 0}, kUnwanted), SWEEPFACE_OK);
  EXPECT_EQ(after, before);
}

TEST_F(Faces, OfOneMeshHaveWeightsOfTheirOwn) {
  make(0);
  const auto neutral = evaluate();
  sweepface_face* other = nullptr;
  ASSERT_EQ(sweepface_face_create(mesh, &other), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_set_weight(other, 0, 1), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_face_weights(other)[0], 1);
  EXPECT_EQ(sweepface_face_weights(face)[0], 0);
  EXPECT_EQ(evaluate(), neutral);
  sweepface_face_free(other);
}

TEST_F(Faces, StayFiniteAtTheLargestWeights) {
  make(0);
  const double weights[] = {SWEEPFACE_MOST_WEIGHT, -SWEEPFACE_MOST_WEIGHT, SWEEPFACE_MOST_WEIGHT};
  ASSERT_EQ(sweepface_face_set_weights(face, weights, 3), SWEEPFACE_OK);
  for (const bool normals : {false, true})
    for (const float x : evaluate(normals)) EXPECT_TRUE(std::isfinite(x));
}

TEST_F(Faces, RefuseWhatIsNotAWeightAndChangeNothing) {
  make(0);
  const double good[] = {0.5, 0.5, 0.5};
  ASSERT_EQ(sweepface_face_set_weights(face, good, 3), SWEEPFACE_OK);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1.01 * SWEEPFACE_MOST_WEIGHT}) {
    EXPECT_TRUE(refuses(sweepface_face_set_weight(face, 1, bad), "The weight of 'wink"));
    const double weights[] = {0.1, 0.2, bad};
    EXPECT_TRUE(refuses(sweepface_face_set_weights(face, weights, 3),
                        "The weight of 'rest' must lie within 1000000"));
  }
  EXPECT_TRUE(refuses(sweepface_face_set_weight(face, 3, 0), "no target 3; there are 3"));
  EXPECT_TRUE(refuses(sweepface_face_set_weights(face, good, 4), "4 weights for 3 targets"));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(sweepface_face_weights(face)[k], 0.5);
}

TEST_F(Faces, RefuseBuffersThatCannotBeMeant) {
  make(0);
  std::vector<float> out(3 * sweepface_mesh_vertex_count(mesh));
  const std::size_t count = out.size() / 3;
  EXPECT_TRUE(refuses(sweepface_face_evaluate(face, count + 1, {out.data(), 0}, kUnwanted),
                      "There are only"));
  EXPECT_TRUE(refuses(sweepface_face_evaluate(face, count, {out.data(), 11}, kUnwanted), "stride"));
  EXPECT_TRUE(refuses(sweepface_face_evaluate(face, count, kUnwanted, {out.data(), 4}), "stride"));
  const auto backwards = static_cast<std::size_t>(-12);
  EXPECT_TRUE(
      refuses(sweepface_face_evaluate(face, count, {out.data(), backwards}, kUnwanted), "stride"));
}

TEST_F(Faces, TellWherePointsOfFinerMeshesLieAmongTheSources) {
  const auto originsAt = [&](uint32_t lod) {
    make(lod);
    const std::size_t points = sweepface_mesh_point_count(mesh);
    std::vector<uint32_t> vertices(4 * points);
    std::vector<float> shares(4 * points);
    EXPECT_EQ(sweepface_mesh_origins(mesh, points, vertices.data(), shares.data()), SWEEPFACE_OK);
    return std::pair(vertices, shares);
  };
  const auto [own, whole] = originsAt(0);
  for (uint32_t v = 0; v < own.size(); ++v) {
    EXPECT_EQ(own[v], v / 4);
    EXPECT_EQ(whole[v], v % 4 == 0 ? 1 : 0);
  }
  const auto [vertices, shares] = originsAt(3);
  const auto expected = originsOf(rig, Tessellation(rig.surface, 3)).value();
  ASSERT_EQ(vertices.size(), 4 * expected.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    EXPECT_EQ(vertices[k], static_cast<uint32_t>(expected[k / 4].vertices[k % 4]));
    EXPECT_EQ(shares[k], static_cast<float>(expected[k / 4].shares[k % 4]));
  }
  uint32_t vertex[4] = {7};
  float share[4] = {7};
  EXPECT_TRUE(refuses(sweepface_mesh_origins(nullptr, 0, nullptr, nullptr), "need a mesh"));
  EXPECT_TRUE(refuses(sweepface_mesh_origins(mesh, 1, vertex, nullptr), "places for vertices"));
  EXPECT_TRUE(
      refuses(sweepface_mesh_origins(mesh, expected.size() + 1, vertex, share), "There are only"));
  EXPECT_EQ(vertex[0], 7u);
}

TEST_F(Faces, RefuseOutputsThatLieOverEachOther) {
  make(0);
  const std::size_t count = sweepface_mesh_vertex_count(mesh);
  std::vector<float> out(6 * count, 7);
  const auto refusesOf = [&](std::size_t vertices, std::size_t normalsAt, std::size_t stride,
                             std::size_t stride2) {
    const sweepface_vectors positions{out.data(), stride}, normals{out.data() + normalsAt, stride2};
    const bool evaluates =
        sweepface_face_evaluate(face, vertices, positions, normals) == SWEEPFACE_OK;
    return !evaluates &&
           refuses(sweepface_face_update(face, vertices, positions, normals), "over each other");
  };
  const auto refusesAt = [&](std::size_t normalsAt, std::size_t stride) {
    return refusesOf(count, normalsAt, stride, stride);
  };
  EXPECT_TRUE(refusesAt(0, 0)) << "twice the same buffer";
  EXPECT_TRUE(refusesAt(3, 0)) << "one vertex on";
  EXPECT_TRUE(refusesAt(3 * count - 1, 0)) << "before the last float of positions";
  EXPECT_TRUE(refusesAt(2, 24)) << "in the same structs, but one float too early";
  EXPECT_TRUE(refusesOf(2, 3, 24, 12)) << "the second normal over the second position";
  EXPECT_TRUE(refusesOf(2, 3, 12, 24)) << "the first normal over the second position";
  EXPECT_EQ(out, std::vector<float>(6 * count, 7)) << "nothing is written";
  EXPECT_FALSE(refusesAt(3 * count, 0)) << "one behind the other";
  EXPECT_FALSE(refusesAt(3, 24)) << "in the same structs";
  EXPECT_FALSE(refusesOf(1, 3, 24, 12)) << "one vertex each";
  EXPECT_FALSE(refusesOf(2, 9, 24, 12)) << "right behind the last position";
  EXPECT_FALSE(refusesOf(0, 0, 0, 0)) << "nothing at all";
}

TEST_F(Faces, RefuseLevelsThatThereAreNot) {
  EXPECT_TRUE(refuses(sweepface_mesh_create(handle, 65, &mesh), "must be 0 to 64, not 65"));
  load(makeRig(onePatch(65, 65)));
  EXPECT_TRUE(refuses(sweepface_mesh_create(handle, 64, &mesh), "too many vertices"));
  EXPECT_EQ(mesh, nullptr);
}

TEST_F(Faces, WithoutASourceHaveOnlyTheSurfacesLevels) {
  rig.source = {};
  for (Target& target : rig.targets) target.looseDifference.clear();
  const std::string bytes = encode(rig);
  sweepface_rig* bare = nullptr;
  ASSERT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), nullptr, &bare), SWEEPFACE_OK);
  EXPECT_TRUE(refuses(sweepface_mesh_create(bare, 0, &mesh), "ask for level of detail 1"));
  EXPECT_EQ(sweepface_mesh_create(bare, 1, &mesh), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_mesh_texcoords(mesh), nullptr);
  EXPECT_GT(sweepface_mesh_triangle_count(mesh), 0u);
  uint32_t vertex[4];
  float share[4];
  EXPECT_TRUE(refuses(sweepface_mesh_origins(mesh, 1, vertex, share), "source's vertices"));
  sweepface_rig_free(bare);
}

TEST_F(Faces, RefuseBytesThatAreNoFace) {
  const std::string bytes = encode(rig);
  sweepface_rig* bad = nullptr;
  for (std::size_t size = 0; size < bytes.size(); size += 13)
    EXPECT_TRUE(refuses(sweepface_rig_load(bytes.data(), size, "short.sweep", &bad), "short.sweep",
                        SWEEPFACE_BAD_DATA));
  EXPECT_TRUE(
      refuses(sweepface_rig_load("hello", 5, nullptr, &bad), "The face", SWEEPFACE_BAD_DATA));
  EXPECT_TRUE(refuses(sweepface_rig_load("hello", 5, "", &bad), "The face", SWEEPFACE_BAD_DATA));
  EXPECT_EQ(bad, nullptr);
}

TEST_F(Faces, AreReadWithinTheMemoryThatTheyNeed) {
  const std::string bytes = encode(rig);
  sweepface_rig* read = nullptr;
  const auto within = [&](std::size_t memory) {
    return sweepface_rig_load_within(bytes.data(), bytes.size(), "tee", memory, &read);
  };
  EXPECT_TRUE(refuses(within(1000), "memory", SWEEPFACE_BAD_DATA));
  EXPECT_EQ(read, nullptr);
  ASSERT_EQ(within(100 * bytes.size()), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_target_count(read), sweepface_rig_target_count(handle));
  sweepface_rig_free(read);
  EXPECT_TRUE(refuses(sweepface_rig_load_within(nullptr, 5, nullptr, 1000, &read), "needs bytes"));
  EXPECT_TRUE(refuses(sweepface_rig_load_within("hello", 5, nullptr, 1000, nullptr), "a place"));
}

// A packed face whose targets are loaded later.
class FacesThatShowFirst : public Faces {
 protected:
  FacesThatShowFirst() {
    rig = packed(makeRig(tee()));
    sweepface_rig_free(handle);
    const std::string bytes = encode(rig);
    EXPECT_EQ(sweepface_rig_load_neutral(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  }
};

TEST_F(FacesThatShowFirst, AreEvaluatedWhileTheirTargetsCome) {
  make(1);
  const std::vector<float> neutral = evaluate();
  std::thread loads([&] { EXPECT_EQ(sweepface_rig_load_targets(handle), SWEEPFACE_OK); });
  for (int frame = 0; frame < 20; ++frame) EXPECT_EQ(evaluate(), neutral);
  loads.join();
}

TEST_F(FacesThatShowFirst, AreInABoxBeforeAndAfter) {
  make(1);
  double low[3], high[3], moved[3];
  ASSERT_EQ(sweepface_face_box(face, low, high), SWEEPFACE_OK);
  EXPECT_LT(low[0], high[0]);
  ASSERT_EQ(sweepface_rig_load_targets(handle), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 1), SWEEPFACE_OK);
  ASSERT_EQ(sweepface_face_box(face, low, moved), SWEEPFACE_OK);
  EXPECT_GT(moved[0], high[0]);
}

TEST_F(FacesThatShowFirst, MoveOnceTheirTargetsAreLoaded) {
  make(1);
  const std::vector<float> neutral = evaluate(), normals = evaluate(true);
  EXPECT_STREQ(sweepface_rig_target_name(handle, 0), rig.targets[0].name.c_str());
  ASSERT_EQ(sweepface_rig_load_targets(handle), SWEEPFACE_OK);
  EXPECT_EQ(evaluate(), neutral);
  EXPECT_EQ(evaluate(true), normals);
  ASSERT_EQ(sweepface_face_set_weight(face, 0, 0.5), SWEEPFACE_OK);
  EXPECT_NE(evaluate(), neutral);
  expectNear(Tessellation(rig.surface, 1).positions(blend(rig, Weights{0.5, 0, 0})), evaluate(),
             0.3 * rig.tolerance + 1e-5);
  EXPECT_EQ(sweepface_rig_load_targets(handle), SWEEPFACE_OK);
}

/// The memory for the targets is counted when the neutral is read, so that no face is shown that
/// cannot move.
TEST_F(FacesThatShowFirst, AreReadWithinAnyMemoryWhollyOrNotAtAll) {
  const std::string bytes = encode(rig);
  bool isRead = false;
  for (double memory = 1000; !isRead; memory *= 1.05) {
    const auto limit = static_cast<std::size_t>(memory);
    sweepface_rig* read = nullptr;
    isRead =
        sweepface_rig_load_within(bytes.data(), bytes.size(), "tee", limit, &read) == SWEEPFACE_OK;
    EXPECT_EQ(read != nullptr, isRead) << limit;
    EXPECT_EQ(decodeNeutral(bytes, "tee", {limit}).has_value(), isRead) << limit;
    sweepface_rig_free(read);
    ASSERT_LT(memory, 1e9);
  }
}

TEST_F(FacesThatShowFirst, RefuseToMoveBefore) {
  make(1);
  const double weight = 0.5;
  sweepface_shader_tables tables;
  uint32_t eyes;
  std::int16_t mode;
  float factor;
  constexpr auto kFirst = "call sweepface_rig_load_targets first";
  EXPECT_TRUE(refuses(sweepface_face_set_weight(face, 0, weight), kFirst));
  EXPECT_TRUE(refuses(sweepface_face_set_weights(face, &weight, 1), kFirst));
  EXPECT_TRUE(refuses(sweepface_face_set_region_weights(face, 0, &weight, 1), kFirst));
  EXPECT_TRUE(refuses(sweepface_mesh_prepare(mesh, 1), kFirst));
  EXPECT_TRUE(refuses(sweepface_mesh_shader_tables(mesh, 0, &tables), kFirst));
  EXPECT_TRUE(refuses(sweepface_face_modes(face, 0, &mode, 1, &factor), kFirst));
  sweepface_face_free(std::exchange(face, nullptr));
  sweepface_mesh_free(std::exchange(mesh, nullptr));
  EXPECT_TRUE(refuses(sweepface_rig_follow(handle, SWEEPFACE_ARCS), "load_targets"));
  EXPECT_TRUE(refuses(sweepface_rig_turn_eyes(handle, &eyes), "load_targets"));
  EXPECT_TRUE(refuses(sweepface_rig_load_targets(nullptr), "needs a rig"));
}

TEST_F(Faces, AnswerNullWithoutAnything) {
  uint32_t number = 0;
  float data[3];
  sweepface_part part;
  EXPECT_TRUE(refuses(sweepface_rig_load(nullptr, 5, nullptr, &handle), "needs bytes"));
  EXPECT_TRUE(refuses(sweepface_rig_find_target(nullptr, "a", &number), "needs a rig"));
  EXPECT_TRUE(refuses(sweepface_mesh_create(nullptr, 0, &mesh), "needs a rig"));
  EXPECT_TRUE(refuses(sweepface_mesh_part(nullptr, 0, &part), "needs a mesh"));
  EXPECT_TRUE(refuses(sweepface_face_create(nullptr, &face), "needs a mesh"));
  EXPECT_TRUE(refuses(sweepface_face_set_weight(nullptr, 0, 0), "needs a face"));
  EXPECT_TRUE(refuses(sweepface_face_evaluate(nullptr, 1, {data, 0}, kUnwanted), "needs a face"));
  EXPECT_EQ(sweepface_rig_target_count(nullptr), 0u);
  EXPECT_EQ(sweepface_mesh_vertex_count(nullptr), 0u);
  EXPECT_EQ(sweepface_face_error(nullptr), 0);
  EXPECT_EQ(sweepface_mesh_triangles(nullptr), nullptr);
  EXPECT_EQ(sweepface_face_weights(nullptr), nullptr);
  sweepface_rig_free(nullptr);
  sweepface_mesh_free(nullptr);
  sweepface_face_free(nullptr);
  sweepface_motion_free(nullptr);
}

TEST_F(Faces, KeepMessagesToTheThread) {
  make(0);
  EXPECT_NE(sweepface_face_set_weight(face, 17, 0), SWEEPFACE_OK);
  std::thread([] { EXPECT_STREQ(sweepface_message(), ""); }).join();
  EXPECT_NE(std::string(sweepface_message()).find("17"), std::string::npos);
}

TEST(Messages, EndWithAWholeCharacter) {
  std::string name;
  while (name.size() < 4000) name += "\xC3\xA9";
  sweepface_rig* rig = nullptr;
  EXPECT_EQ(sweepface_rig_load("no face", 7, name.c_str(), &rig), SWEEPFACE_BAD_DATA);
  EXPECT_EQ(std::string(sweepface_message()), name.substr(0, 2046));
}

TEST(Version, IsTheHeaders) { EXPECT_EQ(sweepface_version(), SWEEPFACE_VERSION_NUMBER); }

}  // namespace
}  // namespace sweepface
