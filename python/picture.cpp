#include "sweepface/picture.hpp"

#include "picture.hpp"

namespace sweepface::python {
namespace {

Image shot(const Rig& rig, const Weights& weights, PictureSize size, const View& view,
           Style style) {
  const FaceScenes scenes(rig, lodFor(rig.surface, style, size));
  const Camera camera = frameCamera(scenes.drawn(weights), view, size);
  return valueOf(render(scenes.scene(weights, style), camera, size));
}

}  // namespace

py::array_t<std::uint8_t> renderRig(const Rig& rig, const py::object& weights, Index width,
                                    Index height, const std::string& view,
                                    const std::string& style) {
  const PictureSize size{width, height};
  valueOf(checkSize(size));
  const View from = valueOf(parseView(view));
  const Style how = valueOf(styleFromName(style));
  if (how == Style::error || how == Style::angle)
    throw Failure("The style '" + style +
                  "' needs meshes to compare with; use measure(), or the tool's `render`.");
  const Weights blended = weightsFrom(rig, weights);
  Image image;
  {
    const py::gil_scoped_release others;
    image = shot(rig, blended, size, from, how);
  }
  return arrayOf(std::span<const std::uint8_t>(image.rgb), {height, width, 3});
}

}  // namespace sweepface::python
