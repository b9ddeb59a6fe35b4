#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/subject.hpp"

namespace sweepface {

/// The sections of a report that show a face on its way from the neutral to an expression.
class MotionSections {
 public:
  /// Everything must outlive the sections. Boxes are drawn round what is moved by targets whose
  /// names contain one of `regions`; `drawing` is called before every picture and may refuse it.
  MotionSections(const Rig& rig, const Subject& subject, const FaceScenes& scenes,
                 const Weights& expression, std::span<const std::string> regions,
                 std::function<Result<void>()> drawing);

  /// The number of pictures.
  static int pictures();

  /// The paper's experiment: linear interpolation next to Newton's law in key frames, with
  /// measuring boxes and plots.
  Result<std::string> experiment() const;
  /// Every law side by side: curves, and the face itself, moving.
  Result<std::string> everyLaw() const;

 private:
  Result<Image> picture(double way, PictureSize size) const;
  Result<std::string> strips() const;
  Result<std::vector<PictureBox>> measuringBoxes() const;
  std::string plots() const;
  Result<std::string> sprites() const;

  const Rig& rig_;
  const FaceScenes& scenes_;
  const Weights& expression_;
  Camera front_;
  std::span<const std::string> regions_;
  std::function<Result<void>()> drawing_;
  FaceScenes fine_;
  Weights rest_;
};

/// "jawOpen=0.5, smile=1".
std::string mixtureOf(const Rig& rig, const Weights& weights);
/// The weights of the target whose stored vectors' places move furthest in total; all 0 if none
/// moves.
Weights strongestOf(const Rig& rig);

}  // namespace sweepface
