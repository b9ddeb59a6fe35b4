#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>

#include "sweepface/motion.hpp"

#include "face_page.hpp"

namespace sweepface::cli {
namespace {

/// A law that strips can show: captions say how much of the way is covered.
Result<TimeLaw> stripLaw(const std::string& name) {
  const Result<TimeLaw> law = timeLawFromName(name);
  if (law) return law;
  return fail(
      fmt::format("There is no strip of a law '{}'; there are linear, newton, brake, "
                  "accelerate-brake and linear-force.",
                  name));
}

class StripPage {
 public:
  explicit StripPage(const Rendering& what) : what_(what), page_(what) {}

  Result<Image> draw(const Weights& from, const Weights& to) {
    const Result<std::vector<Motion>> motions = makeMotions(from, to);
    if (!motions) return std::unexpected(motions.error());
    const auto rows = static_cast<Index>(motions->size());
    if (auto ok = page_.layOut({what_.arguments.frames, rows, true, false}, {384, 480}); !ok)
      return std::unexpected(ok.error());
    const std::array ends{followed(from), followed(to)};
    const Result<Camera> camera = cameraFor(ends);
    if (!camera) return std::unexpected(camera.error());
    const auto boxes = makeBoxes(*camera, ends);
    if (!boxes) return std::unexpected(boxes.error());
    for (Index row = 0; row < rows; ++row)
      for (Index k = 0; k < what_.arguments.frames; ++k)
        if (auto ok = frame((*motions)[row], *camera, *boxes, k, row); !ok)
          return std::unexpected(ok.error());
    return page_.image();
  }

 private:
  Weights followed(Weights weights) const {
    what_.following.apply(weights);
    return weights;
  }

  Result<std::vector<Motion>> makeMotions(const Weights& from, const Weights& to) const {
    std::vector<std::string> laws = what_.arguments.laws;
    if (laws.empty()) laws = {"newton"};
    std::vector<Motion> motions;
    for (const std::string& name : laws) {
      const Result<TimeLaw> law = stripLaw(name);
      if (!law) return std::unexpected(law.error());
      Result<Motion> motion = Motion::make(from, to, *law, 1);
      if (!motion) return std::unexpected(motion.error());
      motions.push_back(std::move(*motion));
    }
    return motions;
  }

  Result<Camera> cameraFor(std::span<const Weights> ends) const {
    std::vector<Vec3> points;
    for (const Weights& weights : ends) {
      const auto shown = page_.shown(weights);
      if (!shown) return std::unexpected(shown.error());
      std::ranges::copy(*shown, std::back_inserter(points));
    }
    return frameCamera(points, what_.views.front(), page_.panel());
  }

  Result<void> frame(const Motion& motion, const Camera& camera, std::span<const PictureBox> boxes,
                     Index column, Index row) {
    const double time = static_cast<double>(column) / (what_.arguments.frames - 1);
    Weights weights(motion.size());
    motion.at(time, weights);
    const Result<Studio> studio =
        Studio::make(page_.scenes().scene(followed(std::move(weights)), what_.style));
    if (!studio) return std::unexpected(studio.error());
    return page_.shoot(
        *studio, camera, column, row,
        fmt::format("{}: {:.0f} % of the time, {:.0f} % of the way", nameOf(motion.law()),
                    100 * time, 100 * progress(motion.law(), time).position),
        boxes);
  }

  Result<std::vector<PictureBox>> makeBoxes(const Camera& camera,
                                            std::span<const Weights> ends) const {
    std::vector<PictureBox> boxes;
    for (const std::string& text : what_.arguments.boxes) {
      const Result<PictureBox> box = makeBox(text, camera, ends);
      if (!box) return std::unexpected(box.error());
      boxes.push_back(*box);
    }
    return boxes;
  }

  /// A box given in numbers, or round what some targets move at either end.
  Result<PictureBox> makeBox(const std::string& text, const Camera& camera,
                             std::span<const Weights> ends) const {
    if (text.find(',') != text.npos) return parseBox(text);
    const Result<std::vector<Index>> region = page_.region(text);
    if (!region) return std::unexpected(region.error());
    std::vector<Vec3> places;
    for (const Weights& weights : ends) {
      const std::vector<Vec3> all = page_.scenes().points(weights);
      for (const Index v : *region) places.push_back(all[v]);
    }
    return boxAround(places, camera, page_.panel());
  }

  const Rendering& what_;
  FacePage page_;
};

}  // namespace

Result<Image> drawStrips(const Rendering& what, const Weights& from, const Weights& to) {
  return StripPage(what).draw(from, to);
}

}  // namespace sweepface::cli
