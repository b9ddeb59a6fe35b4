#include <fmt/format.h>

#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"

#include "bindings.hpp"
#include "long_work.hpp"

namespace sweepface::python {
namespace {

Measurement measured(const Rig& rig, const RigSource& meshes, int mixtures, unsigned seed,
                     bool facets) {
  if (mixtures < 0 || mixtures > 10000)
    throw Failure(fmt::format("There may be 0 to 10,000 mixtures, not {}.", mixtures));
  LongWork work(py::none{});
  const MeasureOptions options{mixtures, seed, facets, work.cancel()};
  return valueOf(work.run([&] { return measure(rig, meshes.rig, options); }));
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
  py::class_<PoseErrors>(m, "PoseErrors",
                         "How far one pose is from its source: lengths in model units, angles in "
                         "degrees.")
      .def_readonly("name", &PoseErrors::name)
      .def_readonly("distance", &PoseErrors::distance, "Of vertices from the surface.")
      .def_readonly("displacement", &PoseErrors::displacement,
                    "Of their displacements from the neutral.")
      .def_readonly("angle", &PoseErrors::angle, "Of normals at vertices.")
      .def_readonly("shading_rms", &PoseErrors::shadingRms,
                    "Of normals everywhere, to the source's blended across its faces.")
      .def_readonly("facet_distance", &PoseErrors::facetDistance,
                    "The largest distance between surface and facets.")
      .def_readonly("facet_excess", &PoseErrors::facetExcess,
                    "The same beyond the facets' own sag.")
      .def_readonly("folds", &PoseErrors::folds,
                    "Triangles that face the other way than their facet.")
      .def("__repr__", [](const PoseErrors& e) {
        return fmt::format("<sweepface.PoseErrors of {}: at most {:.4g}, {} folds>", e.name,
                           e.distance.max, e.folds);
      });
  py::class_<Measurement>(m, "Measurement", "How far a rig is from its meshes.")
      .def_readonly("shapes", &Measurement::shapes, "The neutral, then every target at weight 1.")
      .def_readonly("mixtures", &Measurement::mixtures, "Random weights.")
      .def_readonly("worst", &Measurement::worst, "Over all shapes.");
  const MeasureOptions usual;
  m.def("measure", &measured, "rig"_a, "meshes"_a, py::kw_only(), "mixtures"_a = usual.mixtures,
        "seed"_a = usual.seed, "facets"_a = usual.facets,
        "Compares a rig with the meshes it was made from: at vertices and, with facets, between "
        "them, which takes most of the time.");
}

}  // namespace sweepface::python
