#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sweepface/regions.hpp"

#include "values.hpp"

namespace sweepface::python {

/// Regions that Python lists, as Rig.divide returns them. Refuses those that leave part of the face
/// to none: their numbers are not those of the face's regions.
std::vector<Region> dividedRegionsIn(const py::object& listed);
/// The face divided into regions that Python lists, the rest first.
std::vector<Region> dividedBy(const Rig& rig, const py::object& listed);

/// Weights of all regions in one frame or many.
struct RegionalWeights {
  std::size_t frames = 1;
  bool isOne = true;  ///< given without an axis for frames
  Weights weights;    ///< [frames × regions × targets]

  /// From None, a dict or an array [K], which count in all regions; or [F, K] of a face that is not
  /// divided (no number of regions), [R, K] or [F, R, K] of one that is. R may be 1 for all.
  static RegionalWeights from(const Rig& rig, const py::object& given,
                              std::optional<std::size_t> regions);
};

}  // namespace sweepface::python
