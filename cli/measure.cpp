#include "sweepface/measure.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct MeasureArguments {
  std::string face;
  MeshArguments meshes;
  MeasureOptions options;
  bool quiet = false, json = false;
};

void addOptions(CLI::App& app, MeasureArguments& a) {
  addFace(app, a.face);
  addMeshes(app, a.meshes);
  app.add_option("--mixtures", a.options.mixtures,
                 "Also compare N random mixtures with the same blend of the meshes")
      ->transform(wholeNumber(0, 100'000))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--seed", a.options.seed, "Which random mixtures")
      ->transform(wholeNumber(0, std::numeric_limits<int>::max()))
      ->capture_default_str()
      ->type_name("S");
  addQuiet(app, a.quiet);
  addJson(app, a.json);
  app.footer(
      "\nDistances are in the mesh's units, angles in degrees:\n"
      "  distance      from each vertex to the surface\n"
      "  displacement  error of a vertex's movement from the neutral\n"
      "  angle         between normals at the vertices; shading: RMS between vertices, from the\n"
      "                normals that smooth shading blends there\n"
      "  facets        from the flat faces to the surface; excess: the part that the coarseness\n"
      "                of the faces does not explain\n"
      "  folds         where the surface faces the other way than the mesh\n\n"
      "Example:\n  sweepface measure face.sweep neutral.obj expressions/");
}

void printHead(std::size_t width) {
  fmt::print("{:<{}}  {:^29}  {:^39}  {:^19}\n", "", width, "distance", "angle", "facets");
  fmt::print("{:<{}}  {:>9} {:>9} {:>9}  {:>7} {:>7} {:>7} {:>7} {:>7}  {:>9} {:>9} {:>6}\n",
             "shape", width, "max", "99.9 %", "RMS", "RMS", "99 %", "99.9 %", "max", "shading",
             "distance", "excess", "folds");
}

void printRow(std::string_view name, const PoseErrors& e, std::size_t width) {
  fmt::print(
      "{:<{}}  {:>9.3g} {:>9.3g} {:>9.3g}  {:>7.3f} {:>7.3f} {:>7.3f} {:>7.3f} {:>7.3f}  {:>9.3g} "
      "{:>9.3g} {:>6}\n",
      printable(name), width, e.distance.max, e.distance.p999, e.distance.rms, e.angle.rms,
      e.angle.p99, e.angle.p999, e.angle.max, e.shadingRms, e.facetDistance, e.facetExcess,
      e.folds);
}

void printText(const Measurement& m) {
  std::size_t width = 8;
  for (const auto* rows : {&m.shapes, &m.mixtures})
    for (const PoseErrors& e : *rows) width = std::max(width, e.name.size());
  printHead(width);
  for (const PoseErrors& e : m.shapes) printRow(e.name, e, width);
  printRow("worst", m.worst, width);
  for (const PoseErrors& e : m.mixtures) printRow(e.name, e, width);
  const ErrorSummary& ways = m.worst.displacement;
  if (m.shapes.size() > 1)
    fmt::print("displacements of all targets: RMS {:.3g}, 99.9 % {:.3g}, max {:.3g}\n", ways.rms,
               ways.p999, ways.max);
}

nlohmann::ordered_json toJson(const PoseErrors& e) {
  return {{"name", e.name},
          {"distanceMax", e.distance.max},
          {"distance999", e.distance.p999},
          {"distanceRms", e.distance.rms},
          {"displacementMax", e.displacement.max},
          {"displacement999", e.displacement.p999},
          {"displacementRms", e.displacement.rms},
          {"angleRms", e.angle.rms},
          {"angle99", e.angle.p99},
          {"angle999", e.angle.p999},
          {"angleMax", e.angle.max},
          {"shadingRms", e.shadingRms},
          {"facetDistance", e.facetDistance},
          {"facetExcess", e.facetExcess},
          {"folds", e.folds}};
}

nlohmann::ordered_json toJson(const MeasureArguments& a, const Rig& rig, const Measurement& m) {
  nlohmann::ordered_json report{{"file", a.face},
                                {"tolerance", rig.tolerance},
                                {"shapes", nlohmann::ordered_json::array()},
                                {"worst", toJson(m.worst)},
                                {"mixtures", nlohmann::ordered_json::array()}};
  for (const PoseErrors& e : m.shapes) report["shapes"].push_back(toJson(e));
  for (const PoseErrors& e : m.mixtures) report["mixtures"].push_back(toJson(e));
  return report;
}

/// Warns of targets that were not compared, as meshes may have been given for some only.
void warnOfTargetsLeftOut(const Rig& rig, const MeshRig& source) {
  const auto isLeftOut = [&](const Target& target) {
    return std::ranges::find(source.targets, target.name, &MeshTarget::name) ==
           source.targets.end();
  };
  const auto count = std::ranges::count_if(rig.targets, isLeftOut);
  if (count == 0) return;
  const bool isOne = count == 1;
  printWarning(fmt::format(
      "{} of the {} targets of the face {} not compared, as no mesh is named like {}: '{}'{}.",
      count, rig.targets.size(), isOne ? "was" : "were", isOne ? "it" : "them",
      std::ranges::find_if(rig.targets, isLeftOut)->name, isOne ? "" : " and others"));
}

Result<int> runMeasure(const MeasureArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<RigSource> source = [&] {
    ProgressBar bar(a.quiet);
    return readMeshes(a.meshes, bar);
  }();
  if (!source) return std::unexpected(source.error());
  const Result<Measurement> measurement = measure(*rig, source->rig, a.options);
  if (!measurement) return fail(a.face + ": " + measurement.error().message + ".");
  if (a.json)
    printJson(toJson(a, *rig, *measurement));
  else if (!a.quiet)
    printText(*measurement);
  warnOfOtherMeshes(*rig, *measurement);
  warnOfTargetsLeftOut(*rig, source->rig);
  return 0;
}

}  // namespace

Command addMeasure(CLI::App& tool) {
  return makeCommand(tool, "measure", "Compare a face with the meshes it was made from",
                     runMeasure);
}

}  // namespace sweepface::cli
