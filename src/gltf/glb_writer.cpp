#include <fmt/format.h>
#include <numbers>
#include <optional>

#include "sweepface/gltf.hpp"

#include "gltf/animation.hpp"
#include "gltf/binary.hpp"
#include "gltf/chosen_meshes.hpp"
#include "gltf/fine_mesh.hpp"
#include "gltf/quantize.hpp"
#include "io/rig_output.hpp"
#include "io/single.hpp"
#include "mesh/check_indices.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {
namespace gltf {
namespace {

Result<void> check(const Rig& rig, const GlbOptions& options) {
  const io::RigOutput output{options.lod, options.grid, options.weights, options.clip,
                             options.metersPerUnit};
  if (auto ok = io::checkOutput(rig, output); !ok) return ok;
  if (options.motion && options.motion->size() != rig.targets.size())
    return fail(fmt::format("The motion has {} weights, but the face {} targets.",
                            options.motion->size(), rig.targets.size()));
  if (options.clip && !(options.clip->times.front() >= 0))
    return fail("The clip starts before 0, where glTF knows no time.");
  if (!(options.keyTolerance >= 0 && options.keyTolerance < 1e9))
    return fail("The tolerance of keys is a number from 0.");
  if (!rig.scene.empty() && (options.metersPerUnit > 0 || options.zUp))
    return fail(
        "The scene that the face came with is in metres, with y up; leave metres a unit and z up "
        "out.");
  if (!io::areSingle(options.weights))
    return fail("A weight is not a number that a glTF can hold.");
  return {};
}

/// Refuses levels at which positions and normals alone would outgrow a GLB.
Result<void> checkLod(const Surface& surface, Index lod) {
  const auto quads = static_cast<double>(surface.wireframe().quadCount());
  if (24 * quads * lod * lod < 4e9) return {};
  return tooLargeForGlb();
}

/// Whether the file has the vertices of the rig's source, or others where the grid's are.
enum class Vertices { ofSource, ofGrid };

class GlbWriter {
 public:
  GlbWriter(const Rig& rig, const GlbOptions& options, const Tessellation& grid, Vertices vertices)
      : rig_(rig), options_(options), grid_(grid), vertices_(vertices), shapes_(rig, grid) {}

  Result<std::string> write() {
    auto scene = rig_.scene.empty() ? makeScene() : sceneOf(rig_);
    if (!scene) return std::unexpected(scene.error());
    scene_ = std::move(*scene);
    if (rig_.scene.empty()) stand();
    Builder builder(scene_.document);
    if (auto ok = writeMeshes(builder); !ok) return std::unexpected(ok.error());
    if (options_.motion || options_.clip || options_.head)
      if (auto ok = animate(builder); !ok) return std::unexpected(ok.error());
    builder.finish();
    if (!builder.sound())
      return fail("The face has numbers that are too large for the single precision of glTF.");
    return finish(builder.leftViews());
  }

 private:
  /// Makes a scene for a face that came without one.
  Result<BoundScene> makeScene() const {
    if (vertices_ == Vertices::ofSource) {
      std::vector<Vec3> positions;
      for (Index v = 0; v < static_cast<Index>(rig_.source.gridVertex.size()); ++v)
        positions.push_back(shapes_.neutral().positions[shapes_.placeOf(v)]);
      return sceneOfPolygons(rig_, positions);
    }
    const std::vector<Vec3> vectors = blend(rig_, {});
    return sceneOfPolygons(rig_, sourcePositions(rig_, Tessellation(rig_.surface, 1), vectors, {}));
  }

  double metre() const { return options_.metersPerUnit > 0 ? options_.metersPerUnit : 1; }

  /// Stands a face that came without a scene in metres, with y up.
  void stand() {
    Json& node = scene_.document.json["nodes"][0];
    if (const double m = metre(); m != 1) node["scale"] = {m, m, m};
    if (options_.zUp) node["rotation"] = {-std::numbers::sqrt2 / 2, 0, 0, std::numbers::sqrt2 / 2};
  }

  /// Where a point of the face is then.
  Vec3 standing(const Vec3& p) const { return metre() * (options_.zUp ? Vec3{p.x, p.z, -p.y} : p); }

  Result<void> animate(Builder& builder) {
    if (!options_.head) return addAnimation(scene_, options_, builder);
    HeadTrack head = *options_.head;
    head.pivot = standing(head.pivot);
    GlbOptions options = options_;
    options.head = &head;
    return addAnimation(scene_, options, builder);
  }

  Result<void> writeMeshes(Builder& builder) {
    Slots slots(scene_.document, scene_.parts, builder);
    const auto places = placeVertices(slots);
    if (!places) return std::unexpected(places.error());
    std::vector<Encoding> encodings(scene_.parts.meshes.size());
    if (options_.quantize) {
      encodings = chooseEncodings(scene_, shapes_, *places);
      if (auto ok = undoEncodings(scene_, encodings, builder); !ok) return ok;
    }
    if (!options_.weights.empty()) setWeights(scene_, options_.weights);
    return fill(scene_, shapes_, *places, encodings, options_.morphNormals, builder, slots);
  }

  Result<Places> placeVertices(Slots& slots) {
    Places places;
    if (vertices_ == Vertices::ofSource) {
      for (const Run& run : scene_.parts.runs) {
        std::vector<Index>& list = places.emplace_back();
        for (std::size_t v = run.first; v < run.first + run.count; ++v)
          list.push_back(shapes_.placeOf(scene_.vertices[v]));
      }
      return places;
    }
    auto mesh = grid_.level() == 0 ? cutByDensity(rig_, scene_, grid_)
                                   : cutFinely(rig_, scene_, grid_, shapes_.neutral().positions);
    if (!mesh) return std::unexpected(mesh.error());
    if (auto ok = refine(scene_, *mesh, slots); !ok) return std::unexpected(ok.error());
    for (FineMesh::Run& run : mesh->runs) places.push_back(std::move(run.gridVertex));
    return places;
  }

  /// `touched` are views that hold what the source's vertices had.
  Result<std::string> finish(const std::vector<bool>& touched) {
    Document& document = scene_.document;
    forgetChoice(document.json);
    document.json["asset"]["generator"] = "sweepface " SWEEPFACE_VERSION;
    Json& buffers = document.json["buffers"];
    if (!buffers.is_array() || buffers.empty()) buffers = Json::array({Json::object()});
    buffers[0].erase("uri");
    buffers[0]["byteLength"] = document.buffers[0].size();
    if (vertices_ == Vertices::ofGrid)  // the data of the source's vertices are no longer needed
      document.buffers[0] = gatherBinary(document, touched);
    constexpr std::uint64_t beyond = std::uint64_t{1} << 32;
    std::string bytes = formatContainer(document.json, document.buffers[0]);
    if (const std::uint64_t size = bytes.size(); size >= beyond) return tooLargeForGlb();
    return bytes;
  }

  const Rig& rig_;
  const GlbOptions& options_;
  const Tessellation& grid_;
  Vertices vertices_;
  MorphShapes shapes_;
  BoundScene scene_;
};

/// Meshes as a rig without a surface: all vertices are loose.
Rig looseRig(const MeshRig& meshes) {
  const std::vector<Vec3>& rest = meshes.neutral.positions;
  Rig rig;
  rig.source.polygons = meshes.neutral.polygons;
  rig.source.loose = rest;
  for (Index v = 0; v < static_cast<Index>(rest.size()); ++v)
    rig.source.gridVertex.push_back(-1 - v);
  for (const MeshTarget& target : meshes.targets) {
    std::vector<Vec3>& ways = rig.targets.emplace_back(target.name).looseDifference;
    for (std::size_t v = 0; v < rest.size(); ++v) ways.push_back(target.positions[v] - rest[v]);
  }
  return rig;
}

}  // namespace
}  // namespace gltf

Result<std::string> formatGlb(const MeshRig& meshes) {
  if (auto ok = checkIndices(meshes); !ok)
    return fail("The meshes are at odds: " + ok.error().message + ".");
  const Rig rig = gltf::looseRig(meshes);
  return gltf::GlbWriter(rig, {}, Tessellation(rig.surface, 1), gltf::Vertices::ofSource).write();
}

Result<std::string> formatGlb(const Rig& rig, const GlbOptions& options) {
  if (auto ok = gltf::check(rig, options); !ok) return std::unexpected(ok.error());
  if (auto ok = gltf::checkLod(rig.surface, options.lod); !ok) return std::unexpected(ok.error());
  const io::OutputGrid grid(rig, options.lod, options.grid);
  // A scene's vertices are those of the source in their order, and only by its quads can it be cut.
  const bool keepsScene = !rig.scene.empty() && rig.source.ownOrder && knowsQuads(rig);
  const Tessellation* const ownMesh = keepsScene ? nullptr : options.grid;
  const bool cuts = options.lod > 0 || options.grid != ownMesh;
  std::optional<Rig> other = io::withOtherMesh(rig, options.lod, ownMesh);
  if (!other && !rig.scene.empty() && !rig.source.ownOrder) other = rig;
  if (other) other->scene.clear();
  return gltf::GlbWriter(other ? *other : rig, options, grid.get(),
                         cuts ? gltf::Vertices::ofGrid : gltf::Vertices::ofSource)
      .write();
}

}  // namespace sweepface
