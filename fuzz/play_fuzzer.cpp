#include <cmath>
#include <memory>
#include <vector>

#include "sweepface/sweepface.h"
#include "sweepface/sweepface_head.h"
#include "sweepface/sweepface_regions.h"

#include "repaired.hpp"
#include "require.hpp"

// What an engine does with a stranger's file, through the C interface. The last byte chooses what.
namespace {

using sweepface::fuzzing::require;

using Rig = std::unique_ptr<sweepface_rig, decltype(&sweepface_rig_free)>;
using Mesh = std::unique_ptr<sweepface_mesh, decltype(&sweepface_mesh_free)>;
using Face = std::unique_ptr<sweepface_face, decltype(&sweepface_face_free)>;

constexpr std::size_t kMemory = std::size_t{64} << 20;
constexpr std::uint32_t kFewNodes = 400;

Rig loaded(const std::string& bytes) {
  sweepface_rig* rig = nullptr;
  const auto status = sweepface_rig_load_within(bytes.data(), bytes.size(), "in", kMemory, &rig);
  require((status == SWEEPFACE_OK) == (rig != nullptr));
  require(rig || *sweepface_message());
  return {rig, sweepface_rig_free};
}

Rig loadedInTwoSteps(const std::string& bytes) {
  sweepface_rig* rig = nullptr;
  if (sweepface_rig_load_neutral(bytes.data(), bytes.size(), "in", &rig)) return {nullptr, nullptr};
  Rig made(rig, sweepface_rig_free);
  if (sweepface_rig_load_targets(rig)) made.reset();
  return made;
}

bool isOfPoints(unsigned how) { return how % 8 == 7; }

Mesh meshOf(const Rig& rig, unsigned how) {
  constexpr double kPoints[] = {0, 0, 0, 1, -2, 3, 1e99, 5, -1e-9};
  sweepface_mesh* mesh = nullptr;
  if (isOfPoints(how))
    sweepface_mesh_create_at(rig.get(), kPoints, 3, &mesh);
  else if (how % 4 == 3)
    sweepface_mesh_create_within(rig.get(), SWEEPFACE_BUDGET_VERTICES, 50 + how, &mesh);
  else
    sweepface_mesh_create(rig.get(), how % 4, &mesh);
  return {mesh, sweepface_mesh_free};
}

void requireWhole(const sweepface_mesh* mesh) {
  const std::uint32_t vertices = sweepface_mesh_vertex_count(mesh),
                      points = sweepface_mesh_point_count(mesh),
                      triangles = sweepface_mesh_triangle_count(mesh);
  for (std::uint32_t k = 0; k < 3 * triangles; ++k)
    require(sweepface_mesh_triangles(mesh)[k] < vertices);
  for (std::uint32_t k = 0; k < vertices - points; ++k)
    require(sweepface_mesh_copies(mesh)[k] < points);
  std::uint32_t inParts = 0;
  for (std::uint32_t k = 0; k < sweepface_mesh_part_count(mesh); ++k) {
    sweepface_part part;
    require(sweepface_mesh_part(mesh, k, &part) == SWEEPFACE_OK && part.material);
    require(part.first_triangle == inParts);
    inParts += part.triangle_count;
  }
  require(inParts == triangles);
}

void requireTangents(sweepface_face* face, const sweepface_mesh* mesh, bool isOfPoints) {
  const std::size_t vertices = sweepface_mesh_vertex_count(mesh);
  std::vector<float> normals(3 * vertices), tangents(4 * vertices);
  const auto status =
      sweepface_face_tangents(face, vertices, {normals.data(), 0}, {tangents.data(), 0});
  require((status == SWEEPFACE_OK) == (sweepface_mesh_texcoords(mesh) || isOfPoints));
  for (const float number : normals) require(std::abs(number) < 1.001F);
  for (const float number : tangents) require(std::abs(number) < 1.001F);
  for (std::size_t k = 3; status == SWEEPFACE_OK && k < tangents.size(); k += 4)
    require(std::abs(tangents[k]) == 1);
}

void requireBox(sweepface_face* face) {
  double low[3], high[3];
  require(sweepface_face_box(face, low, high) == SWEEPFACE_OK);
  for (int axis = 0; axis < 3; ++axis) require(low[axis] <= high[axis]);
}

/// Positions and normals; updating must write the same as evaluating.
std::vector<float> played(sweepface_face* face, std::size_t vertices) {
  std::vector<float> whole(6 * vertices), updated(6 * vertices);
  require(sweepface_face_evaluate(face, vertices, {whole.data(), 0},
                                  {whole.data() + 3 * vertices, 0}) == SWEEPFACE_OK);
  for (const float number : whole) require(std::isfinite(number));
  for (const double weight : {0.3, -0.4, 0.3}) {
    const bool isSet = sweepface_face_set_weight(face, 0, weight) == SWEEPFACE_OK;
    require(sweepface_face_update(face, vertices, {updated.data(), 0},
                                  {updated.data() + 3 * vertices, 0}) == SWEEPFACE_OK);
    if (!isSet) require(updated == whole);
  }
  std::vector<float> again(6 * vertices);
  require(sweepface_face_evaluate(face, vertices, {again.data(), 0},
                                  {again.data() + 3 * vertices, 0}) == SWEEPFACE_OK);
  require(updated == again);
  whole.insert(whole.end(), again.begin(), again.end());
  return whole;
}

std::vector<float> played(const Rig& rig, unsigned how) {
  const Mesh mesh = meshOf(rig, how);
  if (!mesh) return {};
  requireWhole(mesh.get());
  sweepface_face* made = nullptr;
  require(sweepface_face_create(mesh.get(), &made) == SWEEPFACE_OK);
  const Face face(made, sweepface_face_free);
  const std::vector<double> weights(sweepface_rig_target_count(rig.get()), 0.5);
  sweepface_face_set_weights(made, weights.data(), weights.size());
  sweepface_shader_tables tables;
  sweepface_mesh_shader_tables(mesh.get(), how % 2, &tables);
  requireTangents(made, mesh.get(), isOfPoints(how));
  requireBox(made);
  return played(made, sweepface_mesh_vertex_count(mesh.get()));
}

void divide(const Rig& rig) {
  const double here[] = {0, 0, 0};
  sweepface_brush brush{};
  brush.points = here, brush.point_count = 1;
  brush.whole = 1, brush.fade = 2;
  std::vector<double> shares(sweepface_rig_node_count(rig.get()));
  if (sweepface_rig_paint(rig.get(), &brush, 1, shares.data(), shares.size())) return;
  for (const double share : shares) require(share >= 0 && share <= 1);
  const char* const name = "part";
  sweepface_rig_divide(rig.get(), &name, shares.data(), 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned how = data[size - 1];
  const std::string bytes =
      sweepface::fuzzing::repaired({reinterpret_cast<const char*>(data), size});
  const Rig rig = loaded(bytes);
  if (!rig || sweepface_rig_node_count(rig.get()) > kFewNodes) return 0;
  const Rig later = loadedInTwoSteps(bytes);
  require(later != nullptr);
  require(played(rig, how) == played(later, how));
  // The meshes are gone, so followers may be changed.
  require(sweepface_rig_follow(later.get(), how / 4 % 4) == SWEEPFACE_OK);
  std::uint32_t eyes = 0;
  if (how & 16) require(sweepface_rig_turn_eyes(later.get(), &eyes) == SWEEPFACE_OK);
  if (how & 32) divide(later);
  played(later, how);
  return 0;
}
