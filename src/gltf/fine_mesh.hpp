#pragma once

#include <unordered_map>
#include <vector>

#include "sweepface/eval.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/mix.hpp"
#include "gltf/slots.hpp"

namespace sweepface::gltf {

/// A tessellation as the parts of a scene see it.
struct FineMesh {
  struct Run {
    std::vector<Index> gridVertex;  ///< [vertices] of the tessellation
    std::vector<Mix> places;        ///< [vertices] as seen from quads of the source
  };
  std::vector<Run> runs;                      ///< [parts.runs]
  std::vector<std::vector<Index>> triangles;  ///< [parts.parts] vertices of their run
};

class FineMeshBuilder {
 public:
  /// The scene must outlive the builder.
  explicit FineMeshBuilder(const BoundScene& scene);

  /// A vertex of a part's run; for the same vertex of the tessellation, seen in the same place,
  /// always the same.
  Index shared(Index part, Index gridVertex, const Mix& place);
  /// A vertex that nothing else asks for.
  Index single(Index part, Index gridVertex, const Mix& place);
  /// Adds a triangle of a part's vertices, counter-clockwise as the surface shows it.
  void addTriangle(Index part, std::array<Index, 3> vertices);
  FineMesh take();

 private:
  struct Key {
    Index gridVertex;
    Mix place;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  std::size_t runOf(Index part) const { return scene_.parts.parts[part].run; }

  const BoundScene& scene_;
  FineMesh mesh_;
  std::vector<std::unordered_map<Key, Index, Hash>> known_;  // [parts.runs]
};

/// Cuts every quad of the source as a tessellation with a level does. Vertices are shared within a
/// run unless the source's attributes differ there. `positions` are those of the tessellation; the
/// rig must know its quads.
Result<FineMesh> cutFinely(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
                           const std::vector<Vec3>& positions);
/// The triangles of a tessellation with a density, likewise. Each belongs to the part of the quad
/// in its middle.
Result<FineMesh> cutByDensity(const Rig& rig, const BoundScene& scene, const Tessellation& grid);

/// Gives the parts of a scene the triangles of a fine mesh, and interpolates their vertices'
/// attributes other than positions and normals. Tangents, matrices and extensions that may refer to
/// the source's vertices are left out.
Result<void> refine(BoundScene& scene, const FineMesh& mesh, Slots& slots);

}  // namespace sweepface::gltf
