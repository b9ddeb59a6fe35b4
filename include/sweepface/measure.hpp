#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// A summary of many errors; zeros if there are none.
struct ErrorSummary {
  double rms = 0, p99 = 0, p999 = 0, max = 0;  ///< 99th and 99.9th percentile
};
ErrorSummary summaryOf(std::vector<double> errors);

/// How far one pose of a rig is from the source (docs/error-metric.md). Lengths in model units,
/// angles in degrees.
struct PoseErrors {
  std::string name;
  ErrorSummary distance;      ///< of source vertices from their points on the surface
  ErrorSummary displacement;  ///< of their displacements from the neutral; zeros for the neutral
  ErrorSummary angle;         ///< surface normal to source vertex normal
  double shadingRms = 0;      ///< surface normal to the source's normals blended across its faces
  double facetDistance = 0;   ///< largest distance of the level-4 surface to the source's facets
  double facetExcess = 0;     ///< the same beyond the facets' own sag
  Index folds = 0;            ///< level-4 triangles that face the other way than their source facet
};

struct Measurement {
  std::vector<PoseErrors> shapes;    ///< the neutral, then every target at weight 1
  std::vector<PoseErrors> mixtures;  ///< random weights, the same for the source's linear blend
  /// Over all shapes: the largest of their maxima, and everything else over all of them together;
  /// displacements over all targets.
  PoseErrors worst;
  std::vector<double> displacements;  ///< [targets × V] errors of displacements, ascending
};

struct MeasureOptions {
  int mixtures = 10;
  unsigned seed = 1;
  bool facets = true;  ///< also between vertices: shading, facets, folds; takes most of the time
  const std::atomic<bool>* cancel = nullptr;  ///< checked before each shape; true: fails soon
};

/// Compares a rig with the mesh rig it was made from: same vertices, and a shape for every target
/// of `source`, found by name. Fails with a sentence if the two do not belong together.
Result<Measurement> measure(const Rig& rig, const MeshRig& source,
                            const MeasureOptions& options = {});

/// The vertex that is furthest from where the source has it.
struct FurthestVertex {
  double distance = 0;     ///< NaN if a position is NaN
  std::size_t vertex = 0;  ///< of the source
  Index target = -1;       ///< -1: in the neutral
};

/// Over the neutral and every target; a vertex at which sheets touch is measured on each of them.
/// `source` must be what the rig was made from, with its targets in the same order, and the rig
/// must know the source's order.
FurthestVertex furthestVertex(const Rig& rig, const MeshRig& source);

/// The same between two rigs of one surface, over the vertices of level 1 and those of no face.
/// `vertex` is a source vertex that stands there, or if there is none, that of level 1.
FurthestVertex furthestVertex(const Rig& rig, const Rig& before);

/// The angle between the surface's normal and the source's vertex normal, in degrees.
struct NormalErrors {
  double rms = 0, max = 0;
};

/// Over all vertices of the neutral and of every target. `source` must be what the rig was made
/// from, with its targets in the same order, and the rig must know the source's order.
NormalErrors normalErrors(const Rig& rig, const MeshRig& source);

/// The share of every target's movement that a rig keeps [K]: Σ d·d' / Σ d·d over the corners of
/// faces, where d is a vertex's displacement from the neutral in the source and d' that in the rig;
/// 1 if the source moves none. `source` must be what the rig was made from, with its targets in the
/// same order, and the rig must know the source's order.
std::vector<double> keptMovement(const Rig& rig, const MeshRig& source);
/// A sentence that names the targets of which less than half is left; empty if there is none.
std::string lostMovement(const MeshRig& source, const std::vector<double>& kept);

/// How many level-4 triangles of a rig's surface face the other way than their source facet, in the
/// neutral and then in every target: [1 + K]. `source` must be what the rig was made from, with its
/// targets in the same order, and the rig must know the source's order. All 0 if the rig does not
/// know which quad belongs to which face.
std::vector<Index> countFolds(const Rig& rig, const MeshRig& source);

}  // namespace sweepface
