#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sweepface/measure.hpp"
#include "sweepface/picture.hpp"
#include "sweepface/report.hpp"

#include "report/subject.hpp"
#include "report/words.hpp"

namespace sweepface {

/// Writes a report section by section. The sections are in files of their own.
class ReportMaker {
 public:
  ReportMaker(const Rig& rig, const MeshRig& source, const ReportOptions& options);

  Result<std::string> make();

 private:
  /// Figures in a row, up to the first that fails.
  struct Figures {
    std::string html;
    std::optional<Error> error;
    void add(Result<std::string> figure);
  };
  /// The result of a conversion with a tolerance.
  struct Trial {
    double tolerance = 0;
    Index points = 0, patches = 0;
    PoseErrors errors;                     ///< over all shapes
    std::size_t bytes = 0, bareBytes = 0;  ///< whole, and without order and uv
    bool packed = false, own = false;      ///< own: this file
  };

  // report.cpp
  Result<void> prepare();
  std::string head() const;
  Result<std::string> sizes();
  /// Reports progress; fails if the report was cancelled.
  Result<void> proceed(std::string_view what) const;
  /// An error of converting or measuring, as a sentence.
  std::unexpected<Error> refused(const Error& error) const;
  std::size_t vertices() const { return source_.neutral.positions.size(); }
  Index points() const { return rig_.surface.storedCount(); }
  /// Bytes of the neutral's and all targets' positions in single precision.
  std::size_t sourceBytes() const { return 12 * vertices() * (1 + source_.targets.size()); }
  /// "jawOpen=0.5, smile=1".
  std::string mixture() const;
  /// The target's name, or a word for a mixture.
  std::string expressionName() const;

  // picture_sections.cpp
  void frame();
  Result<std::string> picture(Scene scene, const Camera& camera, std::string_view caption,
                              PictureSize size = kPanel);
  Result<std::string> comparison();
  Result<std::string> network();
  Result<std::string> continuity();
  std::string joinTable() const;
  void sumUpJoins();
  double shareOf(JoinClass c) const;

  // error_sections.cpp
  Result<std::string> heatMaps(Style style, std::string_view unit);
  Result<std::string> errors();
  std::string errorPlot() const;
  std::string errorTable() const;
  Result<std::string> displacements();

  // tolerance_sections.cpp
  Result<std::string> tolerances();
  Result<Trial> tryTolerance(double tolerance);
  std::string errorOverPoints(const std::vector<Trial>& trials) const;
  std::string errorOverBytes(const std::vector<Trial>& trials);

  // shape_section.cpp
  Result<std::string> shapes();
  Result<std::string> motion();

  const Rig& rig_;
  const MeshRig& source_;
  const ReportOptions& options_;
  const std::size_t bytes_;  // of the file, without a scene
  Weights rest_, expression_;
  bool moves_;
  Subject subject_;
  FaceScenes scenes_;
  std::vector<Vec3> moved_;  // the source under the expression
  Measurement measured_;
  std::array<JoinSummary, kJoinClasses> restJoins_, movedJoins_;  // by class
  Camera front_, threeQuarter_;
  double work_ = 1, done_ = 0;
};

}  // namespace sweepface
