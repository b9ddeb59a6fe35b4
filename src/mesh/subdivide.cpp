// Catmull–Clark subdivision (Catmull and Clark, Recursively generated B-spline surfaces on
// arbitrary topological meshes, 1978) and the limits of its vertices (Halstead, Kass and DeRose,
// Efficient, fair interpolation using Catmull–Clark surfaces, 1993), as OpenSubdiv computes them.
#include <algorithm>
#include <memory>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <type_traits>

#include "sweepface/subdivision.hpp"

#include "mesh/cage.hpp"
#include "mesh/check_indices.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

constexpr double kMostFaces = 1 << 22;
// Faces around a vertex, which may have twice as many edges, or corners of a face, which becomes
// such a vertex. OpenSubdiv counts to 65,535.
constexpr Index kMostAround = 32'767;

/// Refuses what would be too large, or what OpenSubdiv cannot hold.
Result<void> checkSize(const Cage& cage, int levels) {
  double faces = static_cast<double>(cage.corners.size());
  for (int level = 1; level < levels; ++level) faces *= 4;
  if (faces > kMostFaces)
    return fail("at level ", levels, " of subdivision the mesh would have ",
                static_cast<std::int64_t>(faces), " faces, of which ",
                static_cast<std::int64_t>(kMostFaces), " are allowed; subdivide it ",
                levels > 1 ? "less" : "not at all");
  std::vector<Index> facesAt(cage.vertices.size());
  for (const Index v : cage.corners) ++facesAt[v];
  if (std::ranges::any_of(facesAt, [](Index n) { return n > kMostAround; }) ||
      std::ranges::any_of(cage.sizes, [](Index n) { return n > kMostAround; }))
    return fail("too many faces around a vertex, or corners around a face, to be subdivided");
  return {};
}

using Refiner = std::unique_ptr<Far::TopologyRefiner>;

Refiner refine(const Cage& cage, int levels) {
  Far::TopologyDescriptor mesh;
  mesh.numVertices = static_cast<Index>(cage.vertices.size());
  mesh.numFaces = static_cast<Index>(cage.sizes.size());
  mesh.numVertsPerFace = cage.sizes.data();
  mesh.vertIndicesPerFace = cage.corners.data();
  Far::TopologyDescriptor::FVarChannel texture;
  texture.numValues = static_cast<Index>(cage.texcoords.size());
  texture.valueIndices = cage.cornerTexcoords.data();
  mesh.numFVarChannels = cage.texcoords.empty() ? 0 : 1;
  mesh.fvarChannels = &texture;

  Sdc::Options scheme;
  scheme.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  scheme.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Refiner refiner(Factory::Create(mesh, Factory::Options(Sdc::SCHEME_CATMARK, scheme)));
  if (!refiner) return nullptr;
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;  // which limits need
  refiner->RefineUniform(uniform);
  return refiner;
}

void add(Vec3& sum, double weight, const Vec3& value) { sum += weight * value; }
void add(Vec2& sum, double weight, const Vec2& value) {
  sum.x += weight * value.x, sum.y += weight * value.y;
}

/// A weighted sum, as OpenSubdiv forms it.
template <typename Value>
struct Sum {
  Value value;
  void Clear() { value = {}; }
  void AddWithWeight(const Sum& other, double weight) { add(value, weight, other.value); }
};

/// The limits of positions, or of texture coordinates.
template <typename Value>
std::vector<Value> limitsOf(const Far::TopologyRefiner& refiner, std::vector<Sum<Value>> sums) {
  constexpr bool isTexture = std::is_same_v<Value, Vec2>;
  const Far::PrimvarRefinerReal<double> primvars(refiner);
  for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
    const Far::TopologyLevel& next = refiner.GetLevel(level);
    std::vector<Sum<Value>> finer(isTexture ? next.GetNumFVarValues() : next.GetNumVertices());
    if constexpr (isTexture)
      primvars.InterpolateFaceVarying(level, sums, finer);
    else
      primvars.Interpolate(level, sums, finer);
    sums = std::move(finer);
  }
  std::vector<Sum<Value>> limits(sums.size());
  if constexpr (isTexture)
    primvars.LimitFaceVarying(sums, limits);
  else
    primvars.Limit(sums, limits);
  std::vector<Value> values;
  for (const Sum<Value>& limit : limits) values.push_back(limit.value);
  return values;
}

std::vector<Vec3> limitOf(const Far::TopologyRefiner& refiner, const Cage& cage,
                          const std::vector<Vec3>& positions) {
  std::vector<Sum<Vec3>> sums;
  for (const Index v : cage.vertices) sums.push_back({positions[v]});
  return limitsOf(refiner, std::move(sums));
}

std::vector<Vec2> limitOfTexture(const Far::TopologyRefiner& refiner, const Cage& cage) {
  std::vector<Sum<Vec2>> sums;
  for (const Vec2& place : cage.texcoords) sums.push_back({place});
  return limitsOf(refiner, std::move(sums));
}

/// [faces of the last level] the face of the cage that each is part of.
std::vector<Index> facesOfCage(const Far::TopologyRefiner& refiner) {
  const int last = refiner.GetMaxLevel();
  std::vector<Index> parents(refiner.GetLevel(last).GetNumFaces());
  for (Index f = 0; f < std::ssize(parents); ++f) {
    Index parent = f;
    for (int level = last; level > 0; --level)
      parent = refiner.GetLevel(level).GetFaceParentFace(parent);
    parents[f] = parent;
  }
  return parents;
}

Polygons polygonsOf(const Far::TopologyRefiner& refiner, const Cage& cage, const Polygons& source) {
  const Far::TopologyLevel& last = refiner.GetLevel(refiner.GetMaxLevel());
  const bool isTextured = !cage.texcoords.empty();
  Polygons polygons;
  polygons.materials = source.materials;
  polygons.groups = source.groups;
  polygons.materialFiles = source.materialFiles;
  if (isTextured) polygons.texcoords = limitOfTexture(refiner, cage);
  const std::vector<Index> parents = facesOfCage(refiner);
  for (Index f = 0; f < std::ssize(parents); ++f) {
    for (const Index v : last.GetFaceVertices(f)) polygons.corners.push_back(v);
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
    const Index parent = cage.faces[parents[f]];
    if (!source.faceMaterial.empty()) polygons.faceMaterial.push_back(source.faceMaterial[parent]);
    if (!source.faceGroup.empty()) polygons.faceGroup.push_back(source.faceGroup[parent]);
    if (isTextured)
      for (const Index t : last.GetFaceFVarValues(f))
        polygons.cornerTexcoords.push_back(cage.isTextured[parents[f]] ? t : -1);
  }
  return polygons;
}

}  // namespace

Result<Subdivision> subdivide(const MeshRig& cage, int levels) {
  if (levels < 1 || levels > kMostSubdivisions)
    return fail("there are 1 to ", kMostSubdivisions, " levels of subdivision, not ", levels);
  if (auto ok = checkIndices(cage); !ok) return std::unexpected(ok.error());
  Cage topology = cageOf(cage);
  if (topology.faces.empty()) return fail("the mesh has no face with an area to be subdivided");
  if (auto ok = checkSize(topology, levels); !ok) return std::unexpected(ok.error());
  const Refiner refiner = refine(topology, levels);
  if (!refiner) return fail("OpenSubdiv does not take the mesh");

  MeshRig limit;
  limit.neutral.polygons = polygonsOf(*refiner, topology, cage.neutral.polygons);
  limit.targets.resize(cage.targets.size());
  parallelFor(Index{0}, static_cast<Index>(cage.targets.size()) + 1, [&](Index pose) {
    std::vector<Vec3> places = limitOf(*refiner, topology, cage.positionsOf(pose));
    if (pose == 0)
      limit.neutral.positions = std::move(places);
    else
      limit.targets[pose - 1] = {cage.targets[pose - 1].name, std::move(places)};
  });
  return Subdivision{std::move(limit), std::move(topology.warnings)};
}

}  // namespace sweepface
