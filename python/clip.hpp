#pragma once

#include "sweepface/clip.hpp"

#include "values.hpp"

namespace sweepface::python {

/// How a clip drives a rig. Warns of names that move and drive nothing, and of what else may
/// surprise; `missed` is as in RegionalClips.
ClipMatch matchWith(const Clip& clip, const Rig& rig, double missed = 0);

/// What `write(seconds, row)` makes of every time, counted from the first frame: of those of the
/// frames if `times` is None.
template <typename Write>
py::array_t<double> rowsOver(const Clip& clip, const py::object& times, std::size_t columns,
                             const Write& write) {
  const double first = clip.times.empty() ? 0 : clip.times.front();
  const Doubles at = times.is_none() ? Doubles(arrayOf(clip.times))
                                     : as<Doubles>(times, "Times", "an array of numbers");
  return rowsAt(at, columns, [&](double time, std::span<double> row) { write(time - first, row); });
}

/// The clip with the rig's targets as names, in their order; warns of what may surprise.
Clip clipOfTargets(const Rig& rig, const Clip& clip);

}  // namespace sweepface::python
