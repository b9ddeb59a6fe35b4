#pragma once

#include "values.hpp"

namespace sweepface::python {

/// A picture [height × width × 3] of a face under weights.
py::array_t<std::uint8_t> renderRig(const Rig& rig, const py::object& weights, Index width,
                                    Index height, const std::string& view,
                                    const std::string& style);

}  // namespace sweepface::python
