#include <algorithm>
#include <fmt/format.h>

#include "sweepface/fit.hpp"

#include "report/maker.hpp"

namespace sweepface {

void ReportMaker::Figures::add(Result<std::string> figure) {
  if (figure)
    html += *figure;
  else if (!error)
    error = figure.error();
}

Result<std::string> ReportMaker::picture(Scene scene, const Camera& camera,
                                         std::string_view caption, PictureSize size) {
  if (auto ok = proceed("rendering"); !ok) return std::unexpected(ok.error());
  const Result<Image> image = render(std::move(scene), camera, size);
  if (!image) return std::unexpected(image.error());
  done_ += 1;
  return html::figure(*image, caption);
}

void ReportMaker::frame() {
  const std::array views{View{0, 0}, View{35, 6}};
  const std::vector<Camera> cameras = subject_.cameras(scenes_, expression_, views);
  front_ = cameras[0];
  threeQuarter_ = cameras[1];
}

Result<std::string> ReportMaker::comparison() {
  Figures neutral, expression;
  neutral.add(picture(scenes_.original(source_.neutral.positions), front_, "Neutral, original"));
  neutral.add(picture(scenes_.scene(rest_, Style::shaded), front_, "Neutral, recreated"));
  if (moves_) {
    const std::string name = expressionName();
    expression.add(picture(scenes_.original(moved_), threeQuarter_, name + ", original"));
    expression.add(
        picture(scenes_.scene(expression_, Style::shaded), threeQuarter_, name + ", recreated"));
  }
  if (neutral.error) return std::unexpected(*neutral.error);
  if (expression.error) return std::unexpected(*expression.error);
  std::string text = "The source's polygons beside the surface of the patches.";
  if (moves_) text += fmt::format(" The expression is {}.", mixture());
  return section("Original and recreated",
                 text + " Colours are chosen by the names of the materials.") +
         row(neutral.html) + row(expression.html);
}

Result<std::string> ReportMaker::network() {
  Figures figures;
  figures.add(picture(scenes_.scene(rest_, Style::patches), threeQuarter_,
                      "Patches, no two neighbours alike"));
  figures.add(picture(scenes_.scene(rest_, Style::wireframe), threeQuarter_,
                      "Boundary curves (blue) and control curves (orange)"));
  if (figures.error) return std::unexpected(*figures.error);
  const Wireframe& w = rig_.surface.wireframe();
  const auto shaped =
      std::ranges::count_if(w.ribbons, [](const Shape& s) { return s.eta != 0 || s.lambda != 0; });
  return section("Wireframe",
                 fmt::format("{} patches between {} curves, which meet in {} nodes. {} of {} "
                             "ribbons have shape parameters of their own.",
                             count(rig_.surface.patchCount()), count(w.arcs.size()),
                             count(w.nodes.size()), count(static_cast<std::size_t>(shaped)),
                             count(w.ribbons.size()))) +
         row(figures.html);
}

// ---- Continuity ----

void ReportMaker::sumUpJoins() {
  for (const Weights* weights : {&rest_, &expression_}) {
    const std::vector<Vec3> vectors = blend(rig_, *weights);
    auto& sums = weights == &rest_ ? restJoins_ : movedJoins_;
    for (const JoinReport& join : examineJoins(rig_.surface, vectors))
      if (!join.collapsed) sums[static_cast<std::size_t>(join.joinClass)].add(join);
  }
}

double ReportMaker::shareOf(JoinClass c) const {
  double all = 0;
  for (const JoinSummary& sum : restJoins_) all += sum.length;
  return all > 0 ? restJoins_[static_cast<std::size_t>(c)].length / all : 0;
}

Result<std::string> ReportMaker::continuity() {
  Figures figures;
  figures.add(picture(scenes_.scene(rest_, Style::joins), threeQuarter_, "Joins by their class"));
  const FaceScenes fine(rig_, lodFor(rig_.surface, Style::zebra, subject_.cutFor(kPanel)));
  figures.add(picture(fine.scene(rest_, Style::zebra), threeQuarter_,
                      "Reflected stripes: a kink of the surface would be a jump of the stripes"));
  if (figures.error) return std::unexpected(*figures.error);
  return section("Continuity",
                 "Two patches share position, first and second cross derivative along the whole of "
                 "a C² join. A spoke leads to a node where other than four patches meet: C² at its "
                 "ends, watertight between. Gaps are relative to the diagonal, jumps of "
                 "derivatives to the largest one; the larger of the neutral's and the "
                 "expression's.") +
         row(figures.html) + html::legend(scenes_.legend(Style::joins)) + joinTable();
}

std::string ReportMaker::joinTable() const {
  html::Table table({"join", "curves", "length", "share", "gap", "1st derivative", "2nd derivative",
                     "angle max", "RMS"});
  constexpr std::array<std::string_view, kJoinClasses> names{"boundary", "C²", "spoke", "crease"};
  for (const JoinClass c :
       {JoinClass::c2, JoinClass::spoke, JoinClass::crease, JoinClass::boundary}) {
    const auto k = static_cast<std::size_t>(c);
    if (restJoins_[k].count == 0) continue;
    const JoinSummary &r = restJoins_[k], &m = movedJoins_[k];
    std::vector<std::string> cells{std::string(names[k]), count(r.count),
                                   fmt::format("{:.4g}", r.length), percent(shareOf(c))};
    for (const double x :
         {std::max(r.positionGap, m.positionGap) / diagonal(source_.neutral),
          std::max(r.firstJump, m.firstJump), std::max(r.secondJump, m.secondJump)})
      cells.push_back(fmt::format("{:.1e}", x));
    for (const double x :
         {std::max(r.normalJump, m.normalJump), std::max(r.normalRms(), m.normalRms())})
      cells.push_back(fmt::format("{:.{}g}°", x, x < 99.5 ? 2 : 3));
    // There is nothing on the other side of a boundary to compare with.
    if (c == JoinClass::boundary) std::fill(cells.begin() + 4, cells.end(), "");
    table.add(cells);
  }
  return table.html();
}

}  // namespace sweepface
