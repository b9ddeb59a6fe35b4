#include <array>
#include <fmt/format.h>

#include "sweepface/plot.hpp"

#include "report/maker.hpp"
#include "report/shape_study.hpp"

namespace sweepface {
namespace {

constexpr PictureSize kPatch{360, 270};

/// -10000 as "−10,000".
std::string parameter(double x) {
  return (x < 0 ? "−" : "") + count(static_cast<std::size_t>(std::abs(x)));
}

}  // namespace

Result<std::string> ReportMaker::shapes() {
  const ShapeStudy study = studyShapes(rig_.surface, blend(rig_, rest_));
  if (study.shapes.empty()) return "";
  const Camera camera = frameCamera(study.shapes.front().scene.positions, study.view, kPatch, 0.08);
  Figures figures;
  std::vector<Series> profiles;
  constexpr std::array colours{kGrey, kBlue, kGreen, kRed};
  for (std::size_t k = 0; k < study.shapes.size(); ++k) {
    const ShapedPatch& s = study.shapes[k];
    const bool plain = k == 0;
    std::string name = fmt::format("η = {}, λ = {}", parameter(s.eta), parameter(s.lambda));
    if (!plain) name += fmt::format(": moves by up to {}", number(s.moved));
    figures.add(picture(s.scene, camera, name, kPatch));
    profiles.push_back({fmt::format("{} / {}", parameter(s.eta), parameter(s.lambda)),
                        colours[k % colours.size()], s.profile, false, plain});
  }
  if (figures.error) return std::unexpected(*figures.error);
  return section(
             "Shape parameters",
             fmt::format("Patch {} under ρS⁽⁶⁾ + ηS⁽⁴⁾ + λS″ = 0 with ρ = 1 and several η and λ, "
                         "measured over the whole sweep. Its two boundary curves stay with their "
                         "first and second derivatives. In between, −η draws it towards a cubic "
                         "and λ towards a straight line, like a strip under tension. The plot "
                         "shows the height of the sweep's middle line above its chord, by η / λ.",
                         study.patch)) +
         row(figures.html, "four") +
         linePlot("Profile of the sweep", {"way along the sweep"}, {"height"}, profiles);
}

}  // namespace sweepface
