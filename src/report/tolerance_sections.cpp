#include <algorithm>
#include <functional>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/plot.hpp"
#include "sweepface/strip.hpp"

#include "report/maker.hpp"
#include "report/peers.hpp"

// What other tolerances and other formats make of the same meshes.
namespace sweepface {
namespace {

double kilobytes(std::size_t bytes) { return static_cast<double>(bytes) / 1000; }

/// A vertical line as high as the points of all series.
void addUpright(std::vector<Series>& series, const std::string& name, double x) {
  Series line{name, kGrey, {}, false, 1};
  for (const Series& s : series)
    for (const Vec2& p : s.points) line.points.push_back({x, p.y});
  if (line.points.empty()) return;
  auto [low, high] = std::ranges::minmax(line.points, {}, &Vec2::y);
  if (low.y == high.y) low.y /= 2, high.y *= 2;  // for a logarithmic axis
  line.points = {low, high};
  series.push_back(std::move(line));
}

}  // namespace

Result<ReportMaker::Trial> ReportMaker::tryTolerance(double tolerance) {
  if (auto ok = proceed("converting"); !ok) return std::unexpected(ok.error());
  ConvertOptions options;
  options.tolerance = tolerance;
  options.pack = true;
  options.cancel = options_.cancel;
  const Result<Conversion> conversion = convert(source_, options);
  if (!conversion) return refused(conversion.error());
  done_ += static_cast<double>(source_.targets.size() + 3);
  const std::string bytes = encode(conversion->rig);
  const Result<Rig> rig = decode(bytes, "the face");
  if (!rig) return std::unexpected(rig.error());
  const Result<Measurement> measured =
      measure(*rig, source_, {.mixtures = 0, .facets = false, .cancel = options_.cancel});
  if (!measured) return refused(measured.error());
  return Trial{tolerance,
               rig->surface.storedCount(),
               rig->surface.patchCount(),
               measured->worst,
               bytes.size(),
               bareBytes(*rig),
               true};
}

Result<std::string> ReportMaker::tolerances() {
  if (options_.tolerances.empty()) return "";
  std::vector<Trial> trials{{rig_.tolerance, points(), rig_.surface.patchCount(), measured_.worst,
                             bytes_, bareBytes(rig_), rig_.packing.neutralStep > 0, true}};
  for (const double tolerance : options_.tolerances) {
    const Result<Trial> trial = tryTolerance(tolerance);
    if (!trial) return std::unexpected(trial.error());
    trials.push_back(*trial);
  }
  std::ranges::sort(trials, std::greater{}, &Trial::tolerance);
  return errorOverPoints(trials) + errorOverBytes(trials);
}

std::string ReportMaker::errorOverPoints(const std::vector<Trial>& trials) const {
  Series allowed{"tolerance", kRed, {}, true}, rms{"RMS distance", kBlue, {}, true};
  html::Table table({"tolerance", "points", "of the vertices", "patches", "RMS distance", "bytes",
                     "without order and texture coordinates"});
  for (const Trial& t : trials) {
    allowed.points.push_back({1.0 * t.points, t.tolerance});
    rms.points.push_back({1.0 * t.points, t.errors.distance.rms});
    table.add(
        {number(t.tolerance) + (t.packed ? "" : ", not packed"), count(t.points),
         percent(t.points / static_cast<double>(vertices())), count(t.patches),
         number(t.errors.distance.rms), count(t.bytes), t.bareBytes > 0 ? count(t.bareBytes) : ""},
        t.own);
  }
  return section("Error against points",
                 "The same meshes converted with other tolerances and packed; this file's is in "
                 "bold.") +
         linePlot("Distance over points", {"points", true}, {"distance", true}, {allowed, rms}) +
         table.html();
}

std::string ReportMaker::errorOverBytes(const std::vector<Trial>& trials) {
  const Peers peers = makePeers(source_, options_.gltfpack, [this] {
    const Result<void> ok = proceed("comparing formats");
    done_ += 1;
    return ok;
  });
  html::Table table(
      {"file", "bytes", "distance RMS", "99.9 %", "max", "displacement RMS", "99.9 %", "max"});
  const auto add = [&](const std::string& name, std::size_t bytes, const auto& errors,
                       bool strong = false) {
    if (bytes == 0) return;
    const ErrorSummary &distance = errors.distance, &displacement = errors.displacement;
    table.add(
        {name, count(bytes), number(distance.rms), number(distance.p999), number(distance.max),
         number(displacement.rms), number(displacement.p999), number(displacement.max)},
        strong);
  };
  for (const Trial& t : trials)
    add(fmt::format(".sweep{}, {}", t.packed ? "" : ", not packed", number(t.tolerance)), t.bytes,
        t.errors, t.own);
  const std::string meshopt = "GLB + meshopt", brotli = " + brotli";
  add("GLB, single precision", peers.glb.bytes, peers.glb);
  for (const PeerFile& p : peers.packed) {
    add(meshopt + ", " + p.setting, p.bytes, p);
    add(meshopt + brotli + ", " + p.setting, p.brotliBytes, p);
  }

  const auto plot = [&](const std::string& title, const std::string& axis, auto error) {
    std::vector<Series> series{{".sweep, packed", kBlue, {}, true},
                               {meshopt, kRed, {}, true},
                               {meshopt + brotli, kGreen, {}, true}};
    for (const Trial& t : trials)
      if (t.packed) series[0].points.push_back({kilobytes(t.bytes), error(t.errors)});
    for (const PeerFile& p : peers.packed) {
      series[1].points.push_back({kilobytes(p.bytes), error(p)});
      if (p.brotliBytes > 0) series[2].points.push_back({kilobytes(p.brotliBytes), error(p)});
    }
    std::erase_if(series, [](const Series& s) { return s.points.empty(); });
    if (peers.glb.bytes > 0)
      addUpright(series, "GLB, single precision", kilobytes(peers.glb.bytes));
    return linePlot(title, {"kilobytes", true}, {axis, true}, series);
  };
  std::string plots =
      plot("Largest distance over bytes", "distance", [](auto& e) { return e.distance.max; });
  if (!source_.targets.empty())
    plots += plot("RMS error of displacements over bytes", "error of a displacement",
                  [](auto& e) { return e.displacement.rms; });
  return section("Error against bytes",
                 "Whole files with the same vertices, faces, texture coordinates and expressions, "
                 "without normals and scenes, and what they decode to against the source. GLBs "
                 "hold the source's positions and differences; gltfpack -cc makes them smaller and "
                 "changes the order of vertices and faces, which a .sweep keeps. The dashed "
                 "upright line is the GLB in single precision, whose errors are rounding.") +
         paragraph(peers.left) + row(plots, "plots") + table.html();
}

}  // namespace sweepface
