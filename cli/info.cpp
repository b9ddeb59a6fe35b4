#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sweepface/codec.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct InfoArguments {
  std::string face;
  bool quiet = false, json = false;
};

void addOptions(CLI::App& app, InfoArguments& a) {
  addFace(app, a.face);
  addQuiet(app, a.quiet);
  addJson(app, a.json);
  app.footer("\nExample:\n  sweepface info face.sweep");
}

nlohmann::ordered_json describe(const InfoArguments& a, const Rig& rig, std::size_t bytes,
                                const std::vector<FilePart>& parts) {
  const Surface& surface = rig.surface;
  const Wireframe& w = surface.wireframe();
  const auto kinds = [&](NodeKind kind) {
    return std::ranges::count(surface.connectivity().kinds, kind);
  };
  Index quads = 0;
  for (Index p = 0; p < surface.patchCount(); ++p) quads += surface.edgesU(p) * surface.edgesV(p);
  std::vector<std::string> names;
  for (const Target& target : rig.targets) names.push_back(target.name);
  nlohmann::ordered_json report{
      {"file", a.face},
      {"vertices", rig.source.gridVertex.size()},
      {"patches", surface.patchCount()},
      {"quads", quads},
      {"nodes", w.nodes.size()},
      {"fullNodes", kinds(NodeKind::crossing)},
      {"irregularNodes", kinds(NodeKind::irregular)},
      {"hangingNodes", kinds(NodeKind::hanging)},
      {"arcs", w.arcs.size()},
      {"vectors", surface.storedCount()},
      {"ribbons", w.ribbons.size()},
      {"shapedRibbons",
       std::ranges::count_if(w.ribbons, [](const Shape& s) { return s != Shape{}; })},
      {"tolerance", rig.tolerance},
      {"targets", names},
      {"bytes", bytes},
      {"parts", nlohmann::ordered_json::object()}};
  for (const FilePart& part : parts) {
    auto& cost = report["parts"][part.name];
    cost = cost.is_null() ? part.bytes : cost.get<std::size_t>() + part.bytes;
  }
  return report;
}

void printText(const nlohmann::ordered_json& r) {
  const auto number = [&](const char* key) { return r[key].get<std::size_t>(); };
  const auto names = r["targets"].get<std::vector<std::string>>();
  fmt::print("{}\n", r["file"].get<std::string>());
  fmt::print("  source     {} vertices\n", number("vertices"));
  fmt::print("  patches    {} over {} quads\n", number("patches"), number("quads"));
  fmt::print("  nodes      {}: {} full, {} irregular, {} hanging\n", number("nodes"),
             number("fullNodes"), number("irregularNodes"), number("hangingNodes"));
  fmt::print("  arcs       {}\n", number("arcs"));
  fmt::print("  vectors    {} stored\n", number("vectors"));
  fmt::print("  ribbons    {}, {} with shape parameters\n", number("ribbons"),
             number("shapedRibbons"));
  fmt::print("  tolerance  {:.6g}\n", r["tolerance"].get<double>());
  fmt::print("  targets    {}{}{}\n", names.size(), names.empty() ? "" : ": ",
             fmt::join(names, ", "));
  fmt::print("  bytes      {}\n", number("bytes"));
  for (const auto& [part, bytes] : r["parts"].items())
    fmt::print("    {:<22} {:>10}\n", part, bytes.get<std::size_t>());
}

Result<int> runInfo(const InfoArguments& a) {
  const Result<std::string> bytes = readFile(a.face);
  if (!bytes) return std::unexpected(bytes.error());
  const Result<Rig> rig = decode(*bytes, a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<std::vector<FilePart>> parts = fileParts(*bytes, a.face);
  if (!parts) return std::unexpected(parts.error());
  const nlohmann::ordered_json report = describe(a, *rig, bytes->size(), *parts);
  if (a.json)
    printJson(report);
  else if (!a.quiet)
    printText(report);
  return 0;
}

}  // namespace

Command addInfo(CLI::App& tool) {
  return makeCommand(tool, "info", "Tell what is in a .sweep file and what it costs", runInfo);
}

}  // namespace sweepface::cli
