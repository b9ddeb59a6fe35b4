#include <algorithm>
#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "sweepface/evaluator.hpp"
#include "sweepface/render_mesh.hpp"

#include "bindings.hpp"
#include "following.hpp"
#include "head.hpp"
#include "long_work.hpp"
#include "output.hpp"
#include "parallel/parallel.hpp"
#include "regions.hpp"

namespace sweepface::python {
namespace {

// ---- Made once ----

/// A rig prepared for playing.
struct Face {
  std::shared_ptr<const Rig> rig;
  Following following;
  std::optional<std::vector<Region>> regions;
  RenderMesh mesh;
  Evaluator evaluator;

  std::optional<std::size_t> regionCount() const {
    return regions ? std::optional(regions->size()) : std::nullopt;
  }
  std::size_t vertices() const { return static_cast<std::size_t>(evaluator.vertexCount()); }
};

/// The mesh that cards draw, and the evaluator of its points.
std::pair<RenderMesh, Evaluator> withMesh(const Rig& rig, const std::optional<Budget>& budget,
                                          const EvaluatorOptions& options) {
  const Surface& surface = rig.surface;
  if (budget) {
    const Tessellation grid(surface, valueOf(densityFor(surface, blend(rig, {}), *budget)));
    return {renderDensity(rig, grid), valueOf(Evaluator::make(rig, grid, options))};
  }
  const Tessellation grid(surface, std::max(options.level, 1));
  return {options.level == 0 ? renderSource(rig, grid) : renderGrid(rig, grid),
          valueOf(Evaluator::make(rig, grid, options))};
}

Face faceOf(const std::shared_ptr<Rig>& rig, Index level, const py::object& vertices,
            const py::object& edgeLength, const py::object& error, bool normals,
            const py::object& tolerance, bool arcs, bool combine, bool eyes,
            const std::string& limits, const py::object& listed) {
  const auto budget = budgetFrom(vertices, edgeLength, error);
  if (budget && level != 0) throw Failure("Give either a level or a budget.");
  checkLevel(level);
  EvaluatorOptions options;
  options.level = budget ? 1 : level, options.normals = normals;
  if (!tolerance.is_none()) {
    options.tolerance = numberFrom(tolerance, "The tolerance");
    if (options.tolerance == 0) throw Failure("The tolerance must be greater than 0.");
  }
  if (eyes && (rig->find("eyeLeft.down") >= 0 || rig->find("eyeRight.down") >= 0))
    warn(std::array<std::string, 1>{
        "The face has targets as eyes that turn add them, like 'eyeLeft.down'; convert a file "
        "without them."});
  std::optional<std::vector<Region>> regions;
  if (!listed.is_none()) regions = dividedBy(*rig, listed);
  const Released others;
  Following following(rig, {arcs, combine, eyes, limits});
  if (regions) {
    following.keepWhole(*regions);
    options.influences = influencesOf(rig->surface, *regions);
  }
  auto [mesh, evaluator] = withMesh(following.rig(), budget, options);
  return {rig, std::move(following), std::move(regions), std::move(mesh), std::move(evaluator)};
}

// ---- Every frame ----

/// Weights of one frame, or of many, with all that follows from them: [F × R × K].
class Frames {
 public:
  Frames(const Face& face, const py::object& given, const py::object& look) {
    const std::size_t own = face.rig->targets.size(), all = face.following.rig().targets.size(),
                      regions = face.regionCount().value_or(1);
    const auto told = RegionalWeights::from(*face.rig, given, face.regionCount());
    count_ = told.frames, isOne_ = told.isOne, size_ = regions * all;
    const Looks looks = Looks::from(look, count_);
    if (looks.areTold() && !face.following.turnsEyes())
      throw Failure("The face was made without eyes that turn; make it with them.");
    weights_.resize(count_ * size_);
    for (std::size_t f = 0; f < count_; ++f)
      for (std::size_t r = 0; r < regions; ++r)
        face.following.extend(std::span(told.weights).subspan((f * regions + r) * own, own),
                              looks.of(f),
                              std::span(weights_).subspan((f * regions + r) * all, all));
  }

  bool isOne() const { return isOne_; }
  std::size_t count() const { return count_; }
  std::span<const double> of(std::size_t frame) const {
    return std::span(weights_).subspan(frame * size_, size_);
  }

 private:
  std::size_t count_ = 1, size_ = 0;
  bool isOne_ = true;
  Weights weights_;
};

void evaluateThese(const Face& face, const Frames& frames, const Output& positions,
                   const Output& normals, const std::atomic<bool>* cancel) {
  parallelRanges(frames.count(), [&](std::size_t first, std::size_t end) {
    std::vector<std::byte> scratch(face.evaluator.scratchBytes());
    for (std::size_t f = first; f < end && !(cancel && *cancel); ++f) {
      Evaluation frame;
      frame.evaluator = &face.evaluator;
      frame.weights = frames.of(f);
      frame.scratch = scratch;
      frame.positions = positions.of(f);
      frame.normals = normals.of(f);
      valueOf(frame.validate());
      frame.run();
    }
  });
}

void evaluateAll(const Face& face, const Frames& frames, const Output& positions,
                 const Output& normals) {
  constexpr double kLong = 1e7;  // vertices: some ten milliseconds
  if (static_cast<double>(frames.count()) * static_cast<double>(face.vertices()) < kLong)
    return released([&] { evaluateThese(face, frames, positions, normals, nullptr); });
  LongWork work;
  work.run([&] { evaluateThese(face, frames, positions, normals, work.cancel()); });
}

py::object evaluate(const Face& face, const py::object& weights, const py::object& look,
                    const py::object& positions, const py::object& normals) {
  const Frames frames(face, weights, look);
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(face.vertices()), 3};
  if (!frames.isOne()) shape.insert(shape.begin(), static_cast<py::ssize_t>(frames.count()));
  const Output places = Output::from(positions, shape, "Positions");
  const Output directions = Output::from(normals, shape, "Normals");
  if (directions.isWanted() && !face.evaluator.hasNormals())
    throw Failure("The face was made without normals; make it with them.");
  if (places.crosses(directions))
    throw Failure("Positions and normals must be written to different places.");
  evaluateAll(face, frames, places, directions);
  if (places.isWanted() && directions.isWanted())
    return py::make_tuple(places.array(), directions.array());
  return places.isWanted() ? places.array() : directions.array();
}

// ---- Its mesh ----

py::array_t<Index> pointsOf(const Face& face) {
  std::vector<Index> points;
  for (Index v = 0; v < face.mesh.vertexCount(); ++v) points.push_back(face.mesh.pointOf(v));
  return arrayOf(points);
}

py::object texcoordsOf(const Face& face) {
  if (face.mesh.texcoords.empty()) return py::none();
  return arrayOf(std::span<const float>(face.mesh.texcoords),
                 {static_cast<py::ssize_t>(face.mesh.texcoords.size() / 2), 2});
}

}  // namespace

void addFace(py::module_& m) {
  using namespace py::literals;
  py::class_<Face>(m, "Face",
                   "A rig prepared for playing: a linear map from weights to vertices in tables "
                   "small enough for the cache. It never changes; any number of threads may use "
                   "it.")
      .def(
          py::init(&faceOf), py::arg("rig").none(false), "level"_a = 0, py::kw_only(),
          "vertices"_a = py::none(), "edge_length"_a = py::none(), "error"_a = py::none(),
          "normals"_a = true, "tolerance"_a = py::none(), "arcs"_a = false, "combine"_a = false,
          "eyes"_a = false, "limits"_a = "", "regions"_a = py::none(),
          "level 0 has the source's vertices in their order; level N every edge of the source cut "
          "into N. Instead of a level, a budget: as close to the surface as a number of vertices "
          "allows, edges no longer than a length, or triangles no further from the surface than "
          "an error. Without normals it is made in half the time. Tables are rounded: a target of "
          "weight 1 adds up to the tolerance to a vertex's distance from the surface, three tenths "
          "of the rig's own if none is given, and rounding comes on top (see bound); a smaller "
          "one makes larger tables. With "
          "arcs, targets that turn something move it on arcs; with combine, A_B goes by the "
          "product of A and B, and A_50 stands in for A at 0.5; with eyes, eyeballs turn rigidly "
          "by the eyeLook targets or by angles; limits like '0:1,jawOpen=0:0.8' clamp weights. "
          "regions, as Rig.divide takes or returns them, have weights of their own.")
      .def(
          "evaluate", &evaluate, "weights"_a = py::none(), py::kw_only(), "look"_a = py::none(),
          "positions"_a = true, "normals"_a = false,
          "Vertices under weights: None, a dict of names and weights, or an array [K]; an array "
          "[F, K] evaluates F frames on all cores. A face in regions takes [R, K] or [F, R, K]. "
          "look, by 'left_eye' and 'right_eye', is yaw, pitch and roll in radians, one [3] or [F, "
          "3], by which eyes turn instead of the eyeLook weights, as Clip.angles returns them; an "
          "eye that is not named looks ahead. positions and normals are whether they are wanted, "
          "or float32 arrays to write them to, [V, 3] or [F, V, 3]. Returns those that are wanted.")
      .def_property_readonly(
          "regions", [](const Face& face) { return face.regions.value_or(std::vector<Region>{}); },
          "Those that have weights of their own, in their order; none if it is not divided.")
      .def_property_readonly("vertex_count", &Face::vertices, "Rows of positions.")
      .def_property_readonly(
          "triangles",
          [](const Face& face) {
            return arrayOf(std::span<const std::uint32_t>(face.mesh.triangles),
                           {static_cast<py::ssize_t>(face.mesh.triangles.size() / 3), 3});
          },
          "The mesh for the GPU: [T, 3] of its vertices, counter-clockwise, which are at "
          "positions[points] and have one texture coordinate each.")
      .def_property_readonly("points", &pointsOf,
                             "The vertex in positions of each vertex for the GPU: [C].")
      .def("__repr__",
           [](const Face& face) {
             return fmt::format("<sweepface.Face: {} vertices, {} triangles, {} targets>",
                                face.vertices(), face.mesh.triangles.size() / 3,
                                face.rig->targets.size());
           })
      .def_property_readonly(
          "texcoords", &texcoordsOf,
          "Of the vertices for the GPU, u to the right and v upwards, [C, 2], or None.")
      .def_property_readonly(
          "table_bytes",
          [](const Face& face) {
            return face.evaluator.positionBytes() + face.evaluator.normalBytes();
          },
          "Bytes that are read to evaluate a frame.")
      .def(
          "bound",
          [](const Face& face, const py::object& weights) {
            const Frames frames(face, weights, py::none());
            if (!frames.isOne())
              throw Failure("A bound is that of one frame: weights [K], or [R, K] of regions.");
            return face.evaluator.positionBound(frames.of(0));
          },
          "weights"_a = py::none(),
          "How far any vertex may be from the surface under weights, in model units.");
}

}  // namespace sweepface::python
