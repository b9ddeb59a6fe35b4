#include "sweepface/edit.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

#include "sweepface/codec.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"

namespace sweepface::cli {
namespace {

struct EditArguments {
  std::string face, output, ribbon;
  std::optional<std::string> target;
  std::optional<double> rho, eta, lambda;
  std::vector<std::pair<std::string, std::string>> moves;
  std::vector<std::tuple<std::string, std::string, std::string, std::string>> controls;
  bool quiet = false;
};

void addOptions(CLI::App& app, EditArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output, "The .sweep file to write");
  CLI::Option* ribbon = app.add_option("--ribbon", a.ribbon,
                                       "The ribbon that gets other shape parameters, by name or "
                                       "number as `sweepface info --list` shows them")
                            ->check(notEmpty())
                            ->type_name("RIBBON");
  app.add_option("--rho", a.rho, "Its rho; as it was if not given")
      ->check(finiteNumber())
      ->needs(ribbon)
      ->type_name("X");
  app.add_option("--eta", a.eta, "Its eta, per edge squared")
      ->check(finiteNumber())
      ->needs(ribbon)
      ->type_name("X");
  app.add_option("--lambda", a.lambda, "Its lambda, per edge to the fourth")
      ->check(finiteNumber())
      ->needs(ribbon)
      ->type_name("X");
  oneEachTime(app.add_option("--move", a.moves,
                             "Move a curve with its ends, or a node; may be given several times"))
      ->type_name("NAME DX,DY,DZ");
  oneEachTime(
      app.add_option("--control", a.controls,
                     "Move the second or third control curve beside a curve in a patch: those at "
                     "1/10 and 1/4 of the way across, as `sweepface wireframe` draws them; may be "
                     "given several times"))
      ->type_name("CURVE PATCH second|third DX,DY,DZ");
  app.add_option("--target", a.target,
                 "Move what an expression adds, instead of the neutral with all its expressions")
      ->check(notEmpty())
      ->type_name("NAME");
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n  sweepface edit vase.sweep --ribbon body --eta -1 -o tight.sweep\n"
      "  sweepface edit face.sweep --move c12 0,0.1,0 --control c12 p3 second 0,0,0.05 -o "
      "other.sweep\n\nOnly the patches that own what is edited change. The file's tolerance "
      "speaks of the meshes it was\nconverted from, not of the edits.");
}

Result<Vec3> parseOffset(const std::string& text) {
  const auto isSound = [](double x) { return std::abs(x) < 1e30; };
  if (const auto p = parsePoint(text); p && isSound(p->x) && isSound(p->y) && isSound(p->z))
    return *p;
  return fail(
      fmt::format("An offset must be three numbers below 1e30 like 0,0.1,-2, not '{}'.", text));
}

/// Edits a rig and remembers what changed.
class Editor {
 public:
  explicit Editor(Rig rig) : rig_(std::move(rig)) {}

  Result<void> edit(const EditArguments& a) {
    if (a.target && !a.ribbon.empty())
      return fail("Shape parameters are those of all expressions; leave --target out.");
    if (a.target) {
      const Result<Index> target = findTarget(rig_, *a.target);
      if (!target) return std::unexpected(target.error());
      target_ = *target;
    }
    if (!a.ribbon.empty())
      if (auto ok = reshape(a); !ok) return ok;
    if (auto ok = move(a); !ok) return ok;
    for (const auto& [curve, patch, which, offset] : a.controls)
      if (auto ok = moveControl(curve, patch, which, offset); !ok) return ok;
    return {};
  }

  const Rig& rig() const { return rig_; }
  const std::set<Index>& changed() const { return changed_; }

 private:
  Result<void> remember(const Result<Patches>& patches) {
    if (!patches) return std::unexpected(patches.error());
    changed_.insert(patches->begin(), patches->end());
    return {};
  }

  Result<void> reshape(const EditArguments& a) {
    const Result<Index> ribbon = rig_.find(Thing::ribbon, a.ribbon);
    if (!ribbon) return std::unexpected(ribbon.error());
    Shape shape = rig_.surface.wireframe().ribbons[*ribbon];
    shape = {a.rho.value_or(shape.rho), a.eta.value_or(shape.eta), a.lambda.value_or(shape.lambda)};
    return remember(setShape(rig_, *ribbon, shape));
  }

  struct Moves {
    std::map<Index, Vec3> own, taken;  // nodes that are named, and ends of curves that are
    std::set<Index> curves;
    std::set<Index> disputed;  // nodes that two curves take to different places
  };

  // A node shared by two curves moves once; a move of the node itself takes precedence.
  Result<void> move(const EditArguments& a) {
    Moves all;
    for (const auto& [name, text] : a.moves) {
      const Result<Vec3> by = parseOffset(text);
      if (!by) return std::unexpected(by.error());
      if (auto ok = gather(name, *by, all); !ok) return ok;
    }
    for (const Index node : all.disputed)
      if (!all.own.contains(node))
        return fail(
            fmt::format("Two curves take node '{}' to different places; move the node "
                        "itself as well.",
                        rig_.nameOf(Thing::node, node)));
    all.own.merge(all.taken);  // keeps what is in `own`
    std::vector<NodeMove> moves;
    for (const auto& [node, by] : all.own) moves.push_back({node, by});
    return remember(moveNodes(rig_, moves, target_));
  }

  Result<void> gather(const std::string& name, const Vec3& by, Moves& all) const {
    const bool isNode =
        !isNamed(Thing::curve, name) && (isNamed(Thing::node, name) || name.starts_with('n'));
    const Result<Index> thing = rig_.find(isNode ? Thing::node : Thing::curve, name);
    const bool isNumbered = name.size() > 1 && (isNode || name.starts_with('c')) &&
                            name.find_first_not_of("0123456789", 1) == name.npos;
    if (!thing && !isNumbered)
      return fail(
          fmt::format("There is no curve and no node named '{}'; `sweepface info --list` "
                      "shows those there are.",
                      name));
    if (!thing) return std::unexpected(thing.error());
    if (isNode) {
      if (all.own.try_emplace(*thing, by).second) return {};
      return fail(fmt::format("Node '{}' is moved twice; give the sum of both.", name));
    }
    if (!all.curves.insert(*thing).second)
      return fail(fmt::format("Curve '{}' is moved twice; give the sum of both.", name));
    const auto ends = endsOf(rig_, *thing);
    if (!ends) return std::unexpected(ends.error());
    for (Index node : *ends)
      if (const auto [place, isNew] = all.taken.try_emplace(node, by);
          !isNew && place->second != by)
        all.disputed.insert(node);
    return {};
  }

  bool isNamed(Thing thing, const std::string& name) const {
    const auto& names = thing == Thing::node ? rig_.names.nodes : rig_.names.curves;
    return std::ranges::find(names, name) != names.end();
  }

  Result<void> moveControl(const std::string& curve, const std::string& patch,
                           const std::string& which, const std::string& offset) {
    const Result<Index> c = rig_.find(Thing::curve, curve), p = rig_.find(Thing::patch, patch);
    if (!c) return std::unexpected(c.error());
    if (!p) return std::unexpected(p.error());
    const Result<Vec3> by = parseOffset(offset);
    if (!by) return std::unexpected(by.error());
    if (which != "second" && which != "third")
      return fail(fmt::format("A control curve is the 'second' or the 'third', not '{}'.", which));
    const ControlMove move{*c, *p, which == "second" ? *by : Vec3{},
                           which == "third" ? *by : Vec3{}};
    return remember(moveControls(rig_, move, target_));
  }

  Rig rig_;
  Index target_ = -1;
  std::set<Index> changed_;
};

void printSummary(const EditArguments& a, const Editor& editor) {
  constexpr std::size_t most = 12;
  std::vector<std::string> names;
  for (Index patch : editor.changed()) {
    if (names.size() == most) break;
    names.push_back(editor.rig().nameOf(Thing::patch, patch));
  }
  fmt::print("{}: {} of {} patches changed{}{}{}\n", a.output, editor.changed().size(),
             editor.rig().surface.patchCount(), names.empty() ? "" : ": ", fmt::join(names, ", "),
             editor.changed().size() > most ? ", ..." : "");
}

/// Warns if the file has grown: a packed one may become a hundred times as large.
void warnOfSize(const EditArguments& a, std::uintmax_t before, std::size_t now) {
  constexpr std::size_t muchLarger = 4;
  if (before > 0 && now / before >= muchLarger)
    printWarning(fmt::format(
        "{} is {} times as large as {}, since what was packed no longer fits its steps; make it "
        "small again with sweepface pack.",
        a.output, now / before, a.face));
}

Result<int> runEdit(const EditArguments& a) {
  if (auto ok = checkOutput(a.output, {a.face}, {".sweep"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  if (a.ribbon.empty() && a.moves.empty() && a.controls.empty())
    return fail("There is nothing to edit; give --ribbon, --move or --control.");
  if (!a.ribbon.empty() && !a.rho && !a.eta && !a.lambda)
    return fail("The ribbon needs --rho, --eta or --lambda.");
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  Editor editor(std::move(*rig));
  if (auto ok = editor.edit(a); !ok) return std::unexpected(ok.error());
  const Result<std::string> bytes = encodeReadable(editor.rig(), a.output);
  if (!bytes) return std::unexpected(bytes.error());
  std::error_code unknown;
  const auto size = std::filesystem::file_size(utf8Path(a.face), unknown);
  if (auto written = writeFile(utf8Path(a.output), *bytes); !written)
    return std::unexpected(written.error());
  if (!a.quiet) printSummary(a, editor);
  if (!unknown) warnOfSize(a, size, bytes->size());
  return 0;
}

}  // namespace

Command addEdit(CLI::App& tool) {
  return makeCommand(tool, "edit",
                     "Change shape parameters, move curves and control curves of a face", runEdit);
}

}  // namespace sweepface::cli
