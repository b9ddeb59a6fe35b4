#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sweepface/plot.hpp"

#include "report/maker.hpp"

namespace sweepface {

// The neutral and the expression side by side, on one scale.
Result<std::string> ReportMaker::heatMaps(Style style, std::string_view unit) {
  HeatMap rest = scenes_.heatMap(rest_, source_.neutral.positions, style);
  std::optional<HeatMap> moved;
  if (moves_) {
    moved = scenes_.heatMap(expression_, moved_, style);
    const double top = std::max(rest.top, moved->top);
    if (rest.top < top) rest = scenes_.heatMap(rest_, source_.neutral.positions, style, top);
    if (moved->top < top) moved = scenes_.heatMap(expression_, moved_, style, top);
  }
  Figures maps;
  maps.add(picture(rest.scene, front_, "Neutral: " + rest.title));
  if (moved) maps.add(picture(moved->scene, front_, expressionName() + ": " + moved->title));
  if (maps.error) return std::unexpected(*maps.error);
  return row(maps.html) + html::scale(rest.top, unit);
}

Result<std::string> ReportMaker::errors() {
  const auto distances = heatMaps(Style::error, "distance");
  if (!distances) return distances;
  const auto angles = heatMaps(Style::angle, "angle in degrees");
  if (!angles) return angles;
  return section("Errors",
                 "Distances between the source's vertices and their points on the surface, in the "
                 "source's units, and angles between the surface's normals and the source's "
                 "vertex normals, between vertices those that smooth shading blends (shading), in "
                 "degrees; the neutral and every expression at weight 1, then "
                 "random mixtures against the same blend of the meshes.") +
         *distances + *angles + errorPlot() + errorTable();
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
  return fmt::format("<div class=\"wide\">{}</div>\n",
                     rowPlot("Distance of each shape", "distance (dashed: allowed)", names,
                             {rms, most, worst}, rig_.tolerance));
}

std::string ReportMaker::errorTable() const {
  html::Table table({"shape", "distance max", "99.9 %", "RMS", "angle RMS", "99 %", "99.9 %", "max",
                     "shading RMS", "beyond sag", "folds"});
  const auto add = [&](const PoseErrors& e, bool strong) {
    table.add(
        {e.name, number(e.distance.max), number(e.distance.p999), number(e.distance.rms),
         fmt::format("{:.2f}°", e.angle.rms), fmt::format("{:.1f}°", e.angle.p99),
         fmt::format("{:.1f}°", e.angle.p999), fmt::format("{:.1f}°", e.angle.max),
         fmt::format("{:.2f}°", e.shadingRms), number(e.facetExcess), std::to_string(e.folds)},
        strong);
  };
  for (const PoseErrors& e : measured_.shapes) add(e, false);
  add(measured_.worst, true);
  for (const PoseErrors& e : measured_.mixtures) add(e, false);
  return table.html();
}

/// How far off the vertices' displacements from the neutral are.
Result<std::string> ReportMaker::displacements() {
  const std::vector<double>& errors = measured_.displacements;
  if (errors.empty()) return "";
  Series beyond{"vertices further off", kBlue, {}}, allowed{"tolerance", kRed, {}, false, 1};
  // Twenty points for every power of ten, down to the last vertex.
  const auto last = static_cast<double>(errors.size() - 1);
  for (double share = 1; share * last >= 1; share *= std::pow(10, -0.05))
    beyond.points.push_back({errors[static_cast<std::size_t>((1 - share) * last)], 100 * share});
  beyond.points.push_back({errors.back(), 100 / (last + 1)});
  if (rig_.tolerance > 0)
    allowed.points = {{rig_.tolerance, 100}, {rig_.tolerance, beyond.points.back().y}};
  html::Table table({"", "RMS", "99.9 %", "max"});
  const auto add = [&](const std::string& what, const ErrorSummary& e) {
    table.add({what, number(e.rms), number(e.p999), number(e.max)});
  };
  add("displacements", measured_.worst.displacement);
  add("distances", measured_.worst.distance);
  return section("Displacements",
                 "How far the vertices' ways from the neutral to every expression at weight 1 are "
                 "off the source's: of all vertices of all expressions, the share whose error is "
                 "larger. The table has the distances beside them.") +
         row(linePlot("Errors of displacements", {"error of a displacement"},
                      {"share of the vertices, %", true}, {beyond, allowed}) +
                 table.html(),
             "plots");
}

}  // namespace sweepface
