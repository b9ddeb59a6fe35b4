#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

struct ReportOptions {
  std::string name;       ///< of the face's file, as the report calls it
  std::size_t bytes = 0;  ///< of that file
  /// The expression shown beside the neutral, to which the motion leads; empty: the target that
  /// moves furthest.
  Weights expression;
  /// The face is converted again with each, packed, for the plots of error against points and
  /// bytes.
  std::vector<double> tolerances;
  /// The program that packs GLBs for the plot against bytes; looked for on the PATH unless it has a
  /// slash. If it is missing, the page says so.
  std::string gltfpack = "gltfpack";
  /// Boxes are drawn around what is moved by targets whose names contain one of these; if empty,
  /// around mouth and eye, if there are any.
  std::vector<std::string> regions;
  /// Called now and then with what is going on and how far all of it is, 0 to 1.
  std::function<void(std::string_view what, double done)> progress;
  /// Set by another thread or a signal to give up; there is no page then.
  const std::atomic<bool>* cancel = nullptr;
};

/// A page of HTML about a rig and the meshes it was made from: pictures, tables and plots, with
/// nothing to load from elsewhere. Fails with a sentence if the two do not belong together.
Result<std::string> makeReport(const Rig& rig, const MeshRig& source, const ReportOptions& options);

/// The part of that page that needs no meshes: linear interpolation beside Newton's law in 31 key
/// frames, with measuring boxes and plots, and every law as an animated picture.
Result<std::string> makeMotionReport(const Rig& rig, const ReportOptions& options);

}  // namespace sweepface
