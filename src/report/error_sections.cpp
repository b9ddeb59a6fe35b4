#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tbb/parallel_for.h>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/plot.hpp"

#include "report/maker.hpp"

namespace sweepface {

Result<std::string> ReportMaker::errors() {
  const HeatMap rest = scenes_.heatMap(rest_, source_.neutral.positions, Style::error);
  const HeatMap angles = scenes_.heatMap(rest_, source_.neutral.positions, Style::angle);
  Figures maps, normals;
  maps.add(picture(rest.scene, front_, "Neutral: " + rest.title));
  if (moves_) {
    const HeatMap moved = scenes_.heatMap(expression_, moved_, Style::error, rest.top);
    maps.add(picture(moved.scene, front_, expressionName() + ": " + moved.title));
  }
  normals.add(picture(angles.scene, front_, "Neutral: " + angles.title));
  if (moves_) {
    const HeatMap moved = scenes_.heatMap(expression_, moved_, Style::angle, angles.top);
    normals.add(picture(moved.scene, front_, expressionName() + ": " + moved.title));
  }
  if (maps.error) return std::unexpected(*maps.error);
  if (normals.error) return std::unexpected(*normals.error);
  return section("Errors",
                 "Distances between the source's vertices and their points on the surface, in the "
                 "source's units, and angles between the surface's normals and the source's "
                 "vertex normals, in degrees; the neutral and every expression at weight 1, then "
                 "random mixtures against the same blend of the meshes.") +
         row(maps.html) + html::scale(rest.top, "distance") + row(normals.html) +
         html::scale(angles.top, "angle in degrees") + errorPlot() + errorTable();
}

std::string ReportMaker::errorPlot() const {
  std::vector<std::string> names;
  Series worst{"max", kRed, {}, true}, most{"99.9 %", kBlue, {}, true}, rms{"RMS", kGrey, {}, true};
  for (const PoseErrors& e : measured_.shapes) {
    names.push_back(e.name);
    worst.points.push_back({e.distance.max, 0});
    most.points.push_back({e.distance.p999, 0});
    rms.points.push_back({e.distance.rms, 0});
  }
  return rowPlot("Distance of each shape", "distance (dashed: allowed)", names, {rms, most, worst},
                 rig_.tolerance);
}

std::string ReportMaker::errorTable() const {
  html::Table table({"shape", "distance max", "99.9 %", "RMS", "angle RMS", "99 %", "99.9 %", "max",
                     "beyond the facets' sag", "folds"});
  const auto add = [&](const PoseErrors& e, bool strong) {
    table.add({e.name, number(e.distance.max), number(e.distance.p999), number(e.distance.rms),
               fmt::format("{:.2f}°", e.angle.rms), fmt::format("{:.1f}°", e.angle.p99),
               fmt::format("{:.1f}°", e.angle.p999), fmt::format("{:.1f}°", e.angle.max),
               number(e.facetExcess), std::to_string(e.folds)},
              strong);
  };
  for (const PoseErrors& e : measured_.shapes) add(e, false);
  add(measured_.worst, true);
  for (const PoseErrors& e : measured_.mixtures) add(e, false);
  return table.html();
}

/// How wrong the ways of the vertices from the neutral are.
Result<std::string> ReportMaker::displacements() {
  const std::vector<double>& errors = measured_.displacements;
  if (errors.empty()) return "";
  Series within{"vertices within it", kBlue, {}}, allowed{"tolerance", kRed, {}, false, true};
  for (int percent = 0; percent <= 100; ++percent)
    within.points.push_back({errors[percent * (errors.size() - 1) / 100], 1.0 * percent});
  if (rig_.tolerance > 0) allowed.points = {{rig_.tolerance, 0}, {rig_.tolerance, 100}};
  html::Table table({"", "RMS", "99.9 %", "max"});
  const auto add = [&](const std::string& what, const ErrorSummary& e) {
    table.add({what, number(e.rms), number(e.p999), number(e.max)});
  };
  add("displacements", measured_.worst.displacement);
  add("distances", measured_.worst.distance);
  return section("Displacements",
                 "How far the vertices' ways from the neutral to every expression at weight 1 are "
                 "off the source's: of all vertices of all expressions, the share whose error is "
                 "no larger. The table has the distances beside them.") +
         row(linePlot("Errors of displacements", {"error of a displacement"},
                      {"share of the vertices, %"}, {within, allowed}) +
                 table.html(),
             "plots");
}

// ---- Error against points ----

Result<ReportMaker::Trial> ReportMaker::tryTolerance(double tolerance) {
  show("converting");
  ConvertOptions options;
  options.tolerance = tolerance;
  const Result<Conversion> conversion = convert(source_, options);
  if (!conversion) return std::unexpected(conversion.error());
  done_ += static_cast<double>(source_.targets.size() + 3);
  const Rig& rig = conversion->rig;
  return Trial{tolerance, rig.surface.storedCount(), rig.surface.patchCount(), rmsOf(rig),
               encode(rig).size()};
}

/// Of the distances of all vertices in all shapes.
double ReportMaker::rmsOf(const Rig& rig) const {
  const Tessellation grid(rig.surface, 1);
  std::vector<double> sums(source_.targets.size() + 1);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t k) {
    Weights weights(rig.targets.size(), 0.0);
    if (k > 0) weights[rig.find(source_.targets[k - 1].name)] = 1;
    const auto& expected = k > 0 ? source_.targets[k - 1].positions : source_.neutral.positions;
    const auto found = sourcePositions(rig, grid, blend(rig, weights), weights);
    for (std::size_t v = 0; v < found.size(); ++v) {
      const Vec3 d = found[v] - expected[v];
      sums[k] += dot(d, d);
    }
  });
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(sums.size() * vertices()));
}

Result<std::string> ReportMaker::tolerances() {
  if (options_.tolerances.empty()) return "";
  std::vector<Trial> trials{{rig_.tolerance, points(), rig_.surface.patchCount(),
                             measured_.worst.distance.rms, options_.bytes}};
  for (const double tolerance : options_.tolerances) {
    const Result<Trial> trial = tryTolerance(tolerance);
    if (!trial) return std::unexpected(trial.error());
    trials.push_back(*trial);
  }
  std::ranges::sort(trials, std::greater{}, &Trial::tolerance);
  Series allowed{"tolerance", kRed, {}, true}, rms{"RMS distance", kBlue, {}, true};
  html::Table table({"tolerance", "points", "of the vertices", "patches", "RMS distance", "bytes"});
  for (const Trial& t : trials) {
    allowed.points.push_back({1.0 * t.points, t.tolerance});
    rms.points.push_back({1.0 * t.points, t.rms});
    table.add(
        {number(t.tolerance), count(t.points), percent(t.points / static_cast<double>(vertices())),
         count(t.patches), number(t.rms), count(t.bytes)},
        t.tolerance == rig_.tolerance);
  }
  return section("Error against points",
                 "The same meshes converted with other tolerances; this file's is in bold.") +
         linePlot("Distance over points", {"points", true}, {"distance", true}, {allowed, rms}) +
         table.html();
}

}  // namespace sweepface
