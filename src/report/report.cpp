#include "sweepface/report.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"

#include "report/maker.hpp"
#include "report/motion_sections.hpp"
#include "report/peers.hpp"

namespace sweepface {
namespace {

// The size of the file without its scene, as other formats are compared with the face alone.
std::size_t bytesWithoutScene(const Rig& rig, std::size_t bytes) {
  if (rig.scene.empty()) return bytes;
  Rig face = rig;
  face.scene.clear();
  return encode(face).size();
}

Result<void> checkMeshes(const Rig& rig, const MeshRig& source) {
  for (const Target& target : rig.targets)
    if (std::ranges::find(source.targets, target.name, &MeshTarget::name) == source.targets.end())
      return fail(fmt::format("There is no mesh of '{}'; give all that the face was made from.",
                              target.name));
  return {};
}

Result<void> checkRig(const Rig& rig, const ReportOptions& options) {
  if (!rig.knowsTargets())
    return fail("The targets of the face are not decoded yet; decode them before a report.");
  if (options.expression.empty() || options.expression.size() == rig.targets.size()) return {};
  return fail(fmt::format("The expression has {} weights, but the face has {} targets.",
                          options.expression.size(), rig.targets.size()));
}

Result<void> proceed(const ReportOptions& options, std::string_view what, double done) {
  if (options.cancel && *options.cancel) return fail("The report was interrupted.");
  if (options.progress) options.progress(what, std::min(done, 1.0));
  return {};
}

}  // namespace

ReportMaker::ReportMaker(const Rig& rig, const MeshRig& source, const ReportOptions& options)
    : rig_(rig),
      source_(source),
      options_(options),
      bytes_(bytesWithoutScene(rig, options.bytes)),
      rest_(rig.targets.size(), 0.0),
      expression_(options.expression.empty() ? strongestOf(rig) : options.expression),
      moves_(expression_ != rest_),
      subject_(rig),
      scenes_(rig, lodFor(rig.surface, Style::shaded, subject_.cutFor(kPanel))) {
  // A picture counts as one, as does a shape that is converted; one that is measured counts as two.
  const auto targets = static_cast<double>(source.targets.size());
  work_ = 18 + MotionSections::pictures() + 2 * targets +
          static_cast<double>(options.tolerances.size()) * (targets + 3) +
          (options.tolerances.empty() ? 0 : kPeerSteps);
}

Result<std::string> ReportMaker::make() {
  if (auto ready = prepare(); !ready) return std::unexpected(ready.error());
  std::string body = head();
  for (auto part : {&ReportMaker::comparison, &ReportMaker::sizes, &ReportMaker::network,
                    &ReportMaker::errors, &ReportMaker::displacements, &ReportMaker::continuity,
                    &ReportMaker::tolerances, &ReportMaker::shapes, &ReportMaker::motion}) {
    const Result<std::string> text = (this->*part)();
    if (!text) return std::unexpected(text.error());
    body += *text;
  }
  return html::page("Sweepface report: " + options_.name, body);
}

/// Prepares what several sections need.
Result<void> ReportMaker::prepare() {
  for (const double tolerance : options_.tolerances)
    if (auto ok = checkTolerance(tolerance, diagonal(source_.neutral)); !ok)
      return refused(ok.error());
  Result<std::vector<Vec3>> moved = originalPositions(rig_, source_, expression_);
  if (!moved) return std::unexpected(moved.error());
  if (auto ok = checkMeshes(rig_, source_); !ok) return ok;
  moved_ = std::move(*moved);
  for (const std::string& name : options_.regions)
    if (const auto region = scenes_.region(name); !region) return std::unexpected(region.error());
  if (auto ok = proceed("measuring"); !ok) return ok;
  Result<Measurement> measured =
      measure(rig_, source_, {.mixtures = 5, .seed = 1, .cancel = options_.cancel});
  if (!measured) return refused(measured.error());
  measured_ = std::move(*measured);
  done_ += 2 * static_cast<double>(source_.targets.size());
  sumUpJoins();
  frame();
  return {};
}

Result<void> ReportMaker::proceed(std::string_view what) const {
  return sweepface::proceed(options_, what, done_ / work_);
}

std::unexpected<Error> ReportMaker::refused(const Error& error) const {
  return fail(fmt::format("{}: {}.", options_.name, error.message));
}

std::string ReportMaker::mixture() const { return mixtureOf(rig_, expression_); }

Result<std::string> ReportMaker::motion() {
  if (!moves_) return "";
  const MotionSections sections(rig_, subject_, scenes_, expression_, options_.regions, [this] {
    const Result<void> ok = proceed("rendering");
    done_ += 1;
    return ok;
  });
  const auto experiment = sections.experiment();
  if (!experiment) return experiment;
  const auto laws = sections.everyLaw();
  if (!laws) return laws;
  return *experiment + *laws;
}

std::string ReportMaker::expressionName() const {
  const auto active = std::ranges::count_if(expression_, [](double w) { return w != 0; });
  return active == 1 ? mixture() : "expression";
}

std::string ReportMaker::head() const {
  const auto fact = [](const std::string& value, const std::string& what) {
    return fmt::format("<div><b>{}</b><span>{}</span></div>\n", html::escaped(value),
                       html::escaped(what));
  };
  std::string html = fmt::format("<h1>{}</h1>\n", html::escaped(options_.name));
  html += fmt::format(
      "<p class=\"lead\">A face of {} vertices and {} expressions as {} ODE sweeping patches, "
      "compared with the meshes it was made from.</p>\n<div class=\"facts\">\n",
      count(vertices()), source_.targets.size(), count(rig_.surface.patchCount()));
  html += fact(percent(points() / static_cast<double>(vertices())),
               "of the vertices, as points on curves");
  html += fact(number(measured_.worst.distance.max),
               fmt::format("largest distance of a vertex, of {} allowed; the diagonal is {}",
                           number(rig_.tolerance), number(diagonal(source_.neutral))));
  html += fact(fmt::format("{:.2g}°", measured_.worst.angle.rms), "RMS angle between the normals");
  html += fact(percent(shareOf(JoinClass::c2)), "of the curves' length are C² joins");
  html += fact(percent(static_cast<double>(bytes_) / static_cast<double>(sourceBytes())),
               fmt::format("of the meshes' bytes: {} of {}", count(bytes_), count(sourceBytes())));
  return html + "</div>\n";
}

Result<std::string> ReportMaker::sizes() {
  html::Table table({"", "original", "recreated", "reduction"});
  const auto reduction = [](double from, double to) { return percent(1 - to / from); };
  const auto line = [&](const std::string& what, std::size_t from, std::size_t to) {
    table.add({what, count(from), count(to),
               reduction(static_cast<double>(from), static_cast<double>(to))});
  };
  const auto stored = static_cast<std::size_t>(points());
  const auto faces = static_cast<std::size_t>(source_.neutral.polygons.faceCount());
  const auto patches = static_cast<std::size_t>(rig_.surface.patchCount());
  const std::string name = expressionName();
  line("Vertices → points, neutral", vertices(), stored);
  if (moves_) line("Vertices → points, " + name, vertices(), stored);
  line("Polygons → patches, neutral", faces, patches);
  if (moves_) line("Polygons → patches, " + name, faces, patches);
  line("Bytes, neutral and all expressions", sourceBytes(), bytes_);
  return section("Size",
                 "As in Table I of the paper. Points are the vectors that a shape stores on its "
                 "boundary and control curves; an expression stores as many as the neutral. The "
                 "original's bytes are its positions in single precision, without polygons; the "
                 "recreated face's are those of the whole file" +
                     (rig_.scene.empty() ? std::string(".")
                                         : fmt::format(" without its scene, which takes {} more.",
                                                       count(options_.bytes - bytes_)))) +
         table.html();
}

Result<std::string> makeReport(const Rig& rig, const MeshRig& source,
                               const ReportOptions& options) {
  if (auto ok = checkRig(rig, options); !ok) return std::unexpected(ok.error());
  return ReportMaker(rig, source, options).make();
}

Result<std::string> makeMotionReport(const Rig& rig, const ReportOptions& options) {
  if (auto ok = checkRig(rig, options); !ok) return std::unexpected(ok.error());
  const Weights rest(rig.targets.size(), 0.0);
  const Weights expression = options.expression.empty() ? strongestOf(rig) : options.expression;
  if (rig.targets.empty())
    return fail(
        "The face has no expressions that could move; give the meshes it was made from as well.");
  if (expression == rest)
    return fail("The face does not move; name an expression to which it should.");
  const Subject subject(rig);
  const FaceScenes scenes(rig, lodFor(rig.surface, Style::shaded, subject.cutFor(kPanel)));
  int done = 0;
  const MotionSections sections(rig, subject, scenes, expression, options.regions, [&] {
    return proceed(options, "rendering", static_cast<double>(done++) / MotionSections::pictures());
  });
  const auto experiment = sections.experiment();
  if (!experiment) return experiment;
  const auto laws = sections.everyLaw();
  if (!laws) return laws;
  return html::page(
      "Sweepface motion: " + options.name,
      fmt::format("<h1>{}</h1>\n", html::escaped(options.name)) + *experiment + *laws);
}

}  // namespace sweepface
