#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "sweepface/codec.hpp"
#include "sweepface/io.hpp"
#include "sweepface/strip.hpp"

#include "command.hpp"
#include "near_things.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct InfoArguments {
  std::string face, near;
  bool list = false, quiet = false, json = false;
};

void addOptions(CLI::App& app, InfoArguments& a) {
  addFace(app, a.face);
  app.add_flag("--list", a.list,
               "List ribbons, patches, curves and nodes by the names that `sweepface edit` takes");
  app.add_option("--near", a.near,
                 "List the five patches, curves and nodes of the neutral that come nearest to a "
                 "point")
      ->excludes("--list")
      ->check(notEmpty())
      ->type_name("X,Y,Z");
  addQuiet(app, a.quiet);
  addJson(app, a.json);
  app.footer(
      "\nExamples:\n  sweepface info face.sweep\n  sweepface info face.sweep --list\n"
      "  sweepface info face.sweep --near 2.4,-5.4,7.5");
}

/// The targets of which the file records that they turn.
std::vector<std::string> turningTargets(const Rig& rig) {
  std::vector<std::string> names;
  for (const Turn& turn : rig.turns) names.push_back(rig.targets[turn.target].name);
  return names;
}

nlohmann::ordered_json describe(const InfoArguments& a, const Rig& rig, std::size_t bytes,
                                const std::vector<FilePart>& parts) {
  const Surface& surface = rig.surface;
  const Wireframe& w = surface.wireframe();
  const auto kinds = [&](NodeKind kind) {
    return std::ranges::count(surface.connectivity().kinds, kind);
  };
  nlohmann::ordered_json report{
      {"file", a.face},
      {"vertices", rig.source.gridVertex.size()},
      {"patches", surface.patchCount()},
      {"quads", w.quadCount()},
      {"nodes", w.nodes.size()},
      {"fullNodes", kinds(NodeKind::crossing)},
      {"irregularNodes", kinds(NodeKind::irregular)},
      {"hangingNodes", kinds(NodeKind::hanging)},
      {"creasedNodes", kinds(NodeKind::creased)},
      {"arcs", w.arcs.size()},
      {"vectors", surface.storedCount()},
      {"ribbons", w.ribbons.size()},
      {"shapedRibbons",
       std::ranges::count_if(w.ribbons, [](const Shape& s) { return s != Shape{}; })},
      {"tolerance", rig.tolerance},
      {"targets", rig.targetNames()},
      {"turns", turningTargets(rig)},
      {"bytes", bytes},
      {"bareBytes", std::min(bytes, bareBytes(rig))},
      {"parts", nlohmann::ordered_json::object()}};
  for (const FilePart& part : parts) report["parts"][part.name] = part.bytes;
  return report;
}

/// Names as they may be printed.
std::string listOf(const nlohmann::ordered_json& names, std::string_view separator) {
  return printable(fmt::format("{}", fmt::join(names.get<std::vector<std::string>>(), separator)));
}

void printText(const nlohmann::ordered_json& r) {
  const auto number = [&](const char* key) { return r[key].get<std::size_t>(); };
  const nlohmann::ordered_json &names = r["targets"], &turns = r["turns"];
  fmt::print("{}\n", r["file"].get<std::string>());
  fmt::print("  source     {} vertices\n", number("vertices"));
  fmt::print("  patches    {} over {} quads\n", number("patches"), number("quads"));
  fmt::print("  nodes      {}: {} full, {} irregular, {} hanging{}\n", number("nodes"),
             number("fullNodes"), number("irregularNodes"), number("hangingNodes"),
             number("creasedNodes") ? fmt::format(", {} creased", number("creasedNodes")) : "");
  fmt::print("  arcs       {}\n", number("arcs"));
  fmt::print("  vectors    {} stored\n", number("vectors"));
  fmt::print("  ribbons    {}, {} with shape parameters\n", number("ribbons"),
             number("shapedRibbons"));
  fmt::print("  tolerance  {:.6g}\n", r["tolerance"].get<double>());
  fmt::print("  targets    {}{}{}\n", names.size(), names.empty() ? "" : ": ", listOf(names, ", "));
  if (!turns.empty()) fmt::print("  turns      {}: {}\n", turns.size(), listOf(turns, ", "));
  fmt::print("  bytes      {}", number("bytes"));
  if (number("bareBytes") < number("bytes"))
    fmt::print(", {} without the source's order{} and texture coordinates", number("bareBytes"),
               r["parts"].contains("scene") ? ", scene" : "");
  fmt::print("\n");
  for (const auto& [part, bytes] : r["parts"].items())
    fmt::print("    {:<22} {:>10}\n", part, bytes.get<std::size_t>());
}

/// Everything that has a name, with what it is made of.
nlohmann::ordered_json list(const Rig& rig) {
  const Wireframe& w = rig.surface.wireframe();
  nlohmann::ordered_json list{{"ribbons", nlohmann::ordered_json::array()},
                              {"patches", nlohmann::ordered_json::array()},
                              {"curves", nlohmann::ordered_json::array()},
                              {"nodes", nlohmann::ordered_json::array()}};
  const auto reference = [&](HalfArc h) {
    return (h & 1 ? "-" : "") + rig.nameOf(Thing::curve, arcOf(h));
  };
  for (std::size_t r = 0; r < w.ribbons.size(); ++r)
    list["ribbons"].push_back({{"name", rig.nameOf(Thing::ribbon, static_cast<Index>(r))},
                               {"rho", w.ribbons[r].rho},
                               {"eta", w.ribbons[r].eta},
                               {"lambda", w.ribbons[r].lambda}});
  for (Index p = 0; p < rig.surface.patchCount(); ++p) {
    auto& patch = list["patches"].emplace_back();
    patch = {{"name", rig.nameOf(Thing::patch, p)}, {"sides", nlohmann::ordered_json::array()}};
    for (int s = 0; s < 4; ++s) {
      auto& side = patch["sides"].emplace_back(nlohmann::ordered_json::array());
      for (HalfArc h : w.side(p, s)) side.push_back(reference(h));
    }
  }
  for (std::size_t a = 0; a < w.arcs.size(); ++a)
    list["curves"].push_back({{"name", rig.nameOf(Thing::curve, static_cast<Index>(a))},
                              {"from", rig.nameOf(Thing::node, w.arcs[a].from)},
                              {"to", rig.nameOf(Thing::node, w.arcs[a].to)},
                              {"edges", w.arcs[a].edges},
                              {"ribbon", rig.nameOf(Thing::ribbon, w.arcs[a].ribbon)}});
  constexpr std::array kinds{"full", "irregular", "hanging", "creased"};
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    list["nodes"].push_back(
        {{"name", rig.nameOf(Thing::node, static_cast<Index>(n))},
         {"kind", kinds[static_cast<std::size_t>(rig.surface.connectivity().kinds[n])]}});
  return list;
}

/// The patches, curves and nodes nearest to a point, nearest first, and where they come nearest.
nlohmann::ordered_json nearest(const Rig& rig, const Vec3& point) {
  constexpr std::size_t kMost = 5;
  const nlohmann::ordered_json all = list(rig);
  const NearThings found = nearThings(rig, point);
  nlohmann::ordered_json near;
  for (const auto& [kind, places] :
       {std::pair("patches", &found.patches), std::pair("curves", &found.curves),
        std::pair("nodes", &found.nodes)}) {
    near[kind] = nlohmann::ordered_json::array();
    std::vector<std::size_t> order(places->size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {},
                      [&](std::size_t k) { return std::pair((*places)[k].distance, k); });
    order.resize(std::min(order.size(), kMost));
    for (const std::size_t k : order) {
      const auto& [at, distance] = (*places)[k];
      auto& entry = near[kind].emplace_back(all[kind][k]);
      entry["distance"] = distance;
      entry["at"] = {at.x, at.y, at.z};
    }
  }
  return near;
}

void printList(const nlohmann::ordered_json& list) {
  const auto text = [](const nlohmann::ordered_json& value) {
    return printable(value.get<std::string>());
  };
  const auto away = [](const nlohmann::ordered_json& thing) -> std::string {
    if (!thing.contains("distance")) return "";
    return fmt::format(", {:.4g} away at {:.4g}", thing["distance"].get<double>(),
                       fmt::join(thing["at"].get<std::vector<double>>(), ","));
  };
  for (const auto& r : list.value("ribbons", nlohmann::ordered_json::array()))
    fmt::print("  ribbon {}: rho {}, eta {}, lambda {}\n", text(r["name"]), r["rho"].get<double>(),
               r["eta"].get<double>(), r["lambda"].get<double>());
  for (const auto& p : list["patches"]) {
    fmt::print("  patch {}:", text(p["name"]));
    for (const auto& side : p["sides"]) fmt::print(" {}", listOf(side, " + "));
    fmt::print("{}\n", away(p));
  }
  for (const auto& c : list["curves"])
    fmt::print("  curve {}: from {} to {}, {} edges, ribbon {}{}\n", text(c["name"]),
               text(c["from"]), text(c["to"]), c["edges"].get<Index>(), text(c["ribbon"]), away(c));
  for (const auto& n : list["nodes"])
    fmt::print("  node {}: {}{}\n", text(n["name"]), text(n["kind"]), away(n));
}

Result<int> runInfo(const InfoArguments& a) {
  const auto point = a.near.empty() ? Vec3{} : pointGiven("--near", a.near);
  if (!point) return std::unexpected(point.error());
  const Result<std::string> bytes = readFile(utf8Path(a.face));
  if (!bytes) return std::unexpected(bytes.error());
  const Result<Rig> rig = opened(*bytes, a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<std::vector<FilePart>> parts = fileParts(*bytes, a.face);
  if (!parts) return std::unexpected(parts.error());
  nlohmann::ordered_json report = describe(a, *rig, bytes->size(), *parts);
  if (a.list) report["list"] = list(*rig);
  if (!a.near.empty()) report["near"] = nearest(*rig, *point);
  if (a.json)
    printJson(report);
  else if (!a.quiet)
    printText(report);
  for (const char* kind : {"list", "near"})
    if (report.contains(kind) && !a.json && !a.quiet) printList(report[kind]);
  return 0;
}

}  // namespace

Command addInfo(CLI::App& tool) {
  return makeCommand(tool, "info",
                     "Show what is in a .sweep file and how many bytes each part takes", runInfo);
}

}  // namespace sweepface::cli
