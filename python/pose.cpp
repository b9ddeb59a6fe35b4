#include "pose.hpp"

#include <fmt/format.h>

#include "sweepface/eval.hpp"
#include "sweepface/evaluator.hpp"
#include "sweepface/nearest.hpp"

#include "bindings.hpp"
#include "regions.hpp"

namespace sweepface::python {
namespace {

// ---- At single sites ----

/// Arrays of the same shape: those of patches, u and v, each a number or an array.
struct Sites {
  py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> patch;
  Doubles u, v;

  Sites(const py::object& patches, const py::object& us, const py::object& vs) {
    const py::list same = py::module_::import("numpy").attr("broadcast_arrays")(patches, us, vs);
    const py::array numbers = same[0];
    if (numbers.size() > 0 && numbers.dtype().kind() != 'i' && numbers.dtype().kind() != 'u')
      throw Failure("Patches are told by whole numbers.");
    patch = numbers, u = py::object(same[1]), v = py::object(same[2]);
  }

  Site at(const Surface& surface, py::ssize_t k) const {
    const std::int64_t p = patch.data()[k];
    checkPatch(surface, p);
    const Site site{static_cast<Index>(p), u.data()[k], v.data()[k]};
    const Index edgesU = surface.edgesU(site.patch), edgesV = surface.edgesV(site.patch);
    if (!(site.u >= 0 && site.u <= edgesU && site.v >= 0 && site.v <= edgesV))
      throw Failure(fmt::format("({}, {}) is outside of patch {}, where u goes to {} and v to {}.",
                                site.u, site.v, site.patch, edgesU, edgesV));
    return site;
  }

  /// An array [..., 3] of what `find` finds at each.
  template <typename Find>
  py::array_t<double> each(const Surface& surface, const Find& find) const {
    std::vector<Vec3> found;
    for (py::ssize_t k = 0; k < u.size(); ++k) found.push_back(find(at(surface, k)));
    std::vector<py::ssize_t> shape(u.shape(), u.shape() + u.ndim());
    shape.push_back(3);
    return arrayOfPoints(found).reshape(shape);
  }
};

py::array_t<double> evaluateAt(const Pose& pose, const py::object& patch, const py::object& u,
                               const py::object& v, int du, int dv) {
  if (du < 0 || du > 3 || dv < 0 || dv > 3)
    throw Failure(fmt::format("Derivatives are of orders 0 to 3, not {} and {}.", du, dv));
  const Surface& surface = pose.rig->surface;
  return Sites(patch, u, v).each(surface, [&](const Site& site) {
    return surface.evaluate(pose.vectors, site, du, dv);
  });
}

py::array_t<double> normalAt(const Pose& pose, const py::object& patch, const py::object& u,
                             const py::object& v) {
  const Surface& surface = pose.rig->surface;
  return Sites(patch, u, v).each(surface, [&](const Site& site) {
    return surface.normal(pose.vectors, site);
  });
}

py::tuple nearestTo(const Pose& pose, const Doubles& points) {
  const std::vector<Vec3> places = pointsFrom(points, "The points");
  const auto sites =
      valueOf(released([&] { return nearestSites(pose.rig->surface, pose.vectors, places); }));
  std::vector<Index> patches;
  std::vector<double> us, vs;
  for (const Site& site : sites) {
    patches.push_back(site.patch);
    us.push_back(site.u), vs.push_back(site.v);
  }
  return py::make_tuple(arrayOf(patches), arrayOf(us), arrayOf(vs));
}

// ---- At all vertices ----

Tessellation gridAt(const Pose& pose, Index level) {
  checkLevel(level);
  return {pose.rig->surface, std::max(level, 1)};
}

py::array_t<double> positionsOf(const Pose& pose, Index level) {
  return arrayOfPoints(released([&] {
    const Tessellation grid = gridAt(pose, level);
    return level > 0 ? grid.positions(pose.vectors)
                     : sourcePositions(*pose.rig, grid, pose.vectors, pose.weights);
  }));
}

py::array_t<double> normalsOf(const Pose& pose, Index level) {
  return arrayOfPoints(released([&] {
    const Tessellation grid = gridAt(pose, level);
    return level > 0 ? grid.normals(pose.vectors) : sourceNormals(*pose.rig, grid, pose.vectors);
  }));
}

// ---- Curves and joins ----

/// Their points, and the arc that each is or lies beside.
py::tuple linesOf(const CurveNetwork& network, const std::vector<Curve>& curves) {
  py::list lines;
  std::vector<Index> arcs;
  for (const Curve& curve : curves) {
    std::vector<Vec3> points;
    for (const Index p : curve.points) points.push_back(network.points[p]);
    lines.append(arrayOfPoints(points));
    arcs.push_back(arcOf(curve.along));
  }
  return py::make_tuple(lines, arrayOf(arcs));
}

py::dict curvesOf(const Pose& pose, Index perEdge) {
  if (perEdge < 1 || perEdge > kMostLevel)
    throw Failure(fmt::format("An edge is cut into 1 to {}, not {}.", kMostLevel, perEdge));
  const CurveNetwork network = curveNetwork(pose.rig->surface, pose.vectors, perEdge);
  const py::tuple boundary = linesOf(network, network.boundary),
                  control = linesOf(network, network.control);
  py::dict all;
  all["boundary"] = boundary[0], all["boundary_arcs"] = boundary[1];
  all["control"] = control[0], all["control_arcs"] = control[1];
  return all;
}

const char* nameOfJoin(JoinClass joinClass) {
  switch (joinClass) {
    case JoinClass::boundary:
      return "boundary";
    case JoinClass::c2:
      return "c2";
    case JoinClass::spoke:
      return "spoke";
    case JoinClass::crease:
      return "crease";
  }
  return "";
}

py::dict joinsOf(const Pose& pose, int samples) {
  if (samples < 1 || samples > 1000)
    throw Failure(fmt::format("Joins are compared at 1 to 1000 points, not {}.", samples));
  const auto joins =
      released([&] { return examineJoins(pose.rig->surface, pose.vectors, samples); });
  py::list classes;
  for (const JoinReport& join : joins) classes.append(nameOfJoin(join.joinClass));
  const auto column = [&](double JoinReport::* what) {
    std::vector<double> values;
    for (const JoinReport& join : joins) values.push_back(join.*what);
    return arrayOf(values);
  };
  py::dict table;
  table["join_class"] = py::module_::import("numpy").attr("array")(classes, "U8");
  table["length"] = column(&JoinReport::length);
  table["position_gap"] = column(&JoinReport::positionGap);
  table["first_jump"] = column(&JoinReport::firstJump);
  table["second_jump"] = column(&JoinReport::secondJump);
  table["normal_jump"] = column(&JoinReport::normalJump);
  return table;
}

/// Where the nodes of the wireframe are.
py::array_t<double> nodesOf(const Pose& pose) {
  const Surface& surface = pose.rig->surface;
  const Wireframe& wireframe = surface.wireframe();
  std::vector<Vec3> places(wireframe.nodes.size());
  for (Index a = 0; a < static_cast<Index>(wireframe.arcs.size()); ++a) {
    const Arc& arc = wireframe.arcs[a];
    places[arc.from] = surface.pointOnArc(pose.vectors, a, 0);
    places[arc.to] = surface.pointOnArc(pose.vectors, a, arc.edges);
  }
  return arrayOfPoints(places);
}

}  // namespace

Pose::Pose(std::shared_ptr<const Rig> of, const py::object& given, const py::object& regions)
    : rig(std::move(of)) {
  if (regions.is_none()) {
    weights = weightsFrom(*rig, given);
    vectors = blend(*rig, weights);
    return;
  }
  const std::vector<Region> divided = dividedBy(*rig, regions);
  RegionalWeights told = RegionalWeights::from(*rig, given, divided.size());
  if (!told.isOne) throw Failure("A pose is that of one frame: weights [K] or [R, K].");
  vectors.resize(static_cast<std::size_t>(rig->surface.vectorCount()));
  blend(*rig, divided, told.weights, vectors);
  weights = std::move(told.weights);
  weights.resize(rig->targets.size());
}

void addPose(py::module_& m) {
  using namespace py::literals;
  py::class_<Pose>(m, "Pose",
                   "A rig under some weights, in double precision: the reference that a Face is "
                   "compared with. Places on the surface are (u, v) in edges of the source from "
                   "the first corner of a patch.")
      .def("positions", &positionsOf, "level"_a = 0,
           "Of the source's vertices in their order, [V, 3]; at level N, with every edge cut into "
           "N, of those of Face(rig, N) in its order.")
      .def("normals", &normalsOf, "level"_a = 0, "The surface's own, unit length: [V, 3].")
      .def("at", &evaluateAt, "patch"_a, "u"_a, "v"_a, "du"_a = 0, "dv"_a = 0,
           "The surface, or its derivative of orders du and dv up to 3, at places that are numbers "
           "or arrays: [..., 3].")
      .def("normal", &normalAt, "patch"_a, "u"_a, "v"_a,
           "The outward unit normal at such places: [..., 3].")
      .def("nearest", &nearestTo, "points"_a,
           "The places nearest to points [N, 3]: a tuple of patch, u and v, [N] each. Points that "
           "were found in one pose are at the same places in every other.")
      .def("curves", &curvesOf, "per_edge"_a = 8,
           "The boundary curves and the control curves beside them, by 'boundary' and 'control': "
           "lists of points [N, 3]; by 'boundary_arcs' and 'control_arcs', the arc that each is or "
           "lies beside.")
      .def("nodes", &nodesOf, "The places of the wireframe's nodes: [nodes, 3].")
      .def(
          "joins", &joinsOf, "samples"_a = 5,
          "How the two sides of every arc agree, by names of arrays [A]: join_class (boundary, c2, "
          "spoke, crease), length, position_gap in model units, first_jump and second_jump of the "
          "cross derivatives relative to the model's largest, normal_jump in degrees.")
      .def("__repr__", [](const Pose& pose) {
        return fmt::format("<sweepface.Pose of {} vertices>", pose.rig->source.gridVertex.size());
      });
}

}  // namespace sweepface::python
