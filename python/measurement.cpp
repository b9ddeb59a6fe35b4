#include <fmt/format.h>
#include <optional>

#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"

#include "bindings.hpp"
#include "long_work.hpp"

namespace sweepface::python {
namespace {

/// The errors of a pose, and whether they were measured between vertices, too.
struct Measured {
  PoseErrors errors;
  bool facets;
};

struct Measurements {
  std::vector<Measured> shapes, mixtures;
  Measured worst;
};

Measurements measured(const Rig& rig, const RigSource& meshes, int mixtures, unsigned seed,
                      bool facets) {
  if (mixtures < 0 || mixtures > 10000)
    throw Failure(fmt::format("There may be 0 to 10,000 mixtures, not {}.", mixtures));
  LongWork work;
  const MeasureOptions options{mixtures, seed, facets, work.cancel()};
  auto all = valueOf(work.run([&] { return measure(rig, meshes.rig, options); }));
  Measurements measurements{{}, {}, {all.worst, facets}};
  for (PoseErrors& errors : all.shapes) measurements.shapes.push_back({std::move(errors), facets});
  for (PoseErrors& errors : all.mixtures)
    measurements.mixtures.push_back({std::move(errors), facets});
  return measurements;
}

template <auto what>
auto atVertices(const Measured& m) {
  return m.errors.*what;
}
template <auto what>
auto betweenVertices(const Measured& m) {
  return m.facets ? std::optional(m.errors.*what) : std::nullopt;
}

}  // namespace

void addMeasurement(py::module_& m) {
  using namespace py::literals;
  py::class_<ErrorSummary>(m, "ErrorSummary", "Many errors summed up.")
      .def_readonly("rms", &ErrorSummary::rms)
      .def_readonly("p99", &ErrorSummary::p99, "The 99th percentile.")
      .def_readonly("p999", &ErrorSummary::p999, "The 99.9th percentile.")
      .def_readonly("max", &ErrorSummary::max)
      .def("__repr__", [](const ErrorSummary& e) {
        return fmt::format(
            "<sweepface.ErrorSummary: rms {:.4g}, p99 {:.4g}, p999 {:.4g}, max "
            "{:.4g}>",
            e.rms, e.p99, e.p999, e.max);
      });
  py::class_<Measured>(m, "PoseErrors",
                       "How far one pose is from its source: lengths in model units, angles in "
                       "degrees. What is between vertices is None if facets were not measured.")
      .def_property_readonly("name", &atVertices<&PoseErrors::name>)
      .def_property_readonly("distance", &atVertices<&PoseErrors::distance>,
                             "Of vertices from the surface.")
      .def_property_readonly("displacement", &atVertices<&PoseErrors::displacement>,
                             "Of their displacements from the neutral.")
      .def_property_readonly("angle", &atVertices<&PoseErrors::angle>, "Of normals at vertices.")
      .def_property_readonly("shading_rms", &betweenVertices<&PoseErrors::shadingRms>,
                             "Of normals everywhere, to the source's blended across its faces.")
      .def_property_readonly("facet_distance", &betweenVertices<&PoseErrors::facetDistance>,
                             "The largest distance between surface and facets.")
      .def_property_readonly("facet_excess", &betweenVertices<&PoseErrors::facetExcess>,
                             "The same beyond the facets' own sag.")
      .def_property_readonly("folds", &betweenVertices<&PoseErrors::folds>,
                             "Triangles that face the other way than their facet.")
      .def("__repr__", [](const Measured& e) {
        return fmt::format("<sweepface.PoseErrors of {}: at most {:.4g}>", e.errors.name,
                           e.errors.distance.max);
      });
  py::class_<Measurements>(m, "Measurement", "How far a rig is from its meshes.")
      .def_readonly("shapes", &Measurements::shapes, "The neutral, then every target at weight 1.")
      .def_readonly("mixtures", &Measurements::mixtures, "Random weights.")
      .def_readonly("worst", &Measurements::worst, "Over all shapes.");
  const MeasureOptions usual;
  m.def(
      "measure", &measured, "rig"_a, "meshes"_a, py::kw_only(), "mixtures"_a = usual.mixtures,
      "seed"_a = usual.seed, "facets"_a = usual.facets,
      "Compares a rig with the meshes it was made from: at vertices and, with facets, between "
      "them, which takes most of the time; also in as many mixtures of targets by random weights, "
      "which the seed decides.");
}

}  // namespace sweepface::python
