#include "picture.hpp"

#include "sweepface/io.hpp"
#include "sweepface/picture.hpp"

#include "bindings.hpp"
#include "long_work.hpp"

namespace sweepface::python {
namespace {

Image shot(const Rig& rig, const Weights& weights, PictureSize size, const View& view, Style style,
           const std::atomic<bool>* cancel) {
  const FaceScenes scenes(rig, lodFor(rig.surface, style, size));
  if (*cancel) return {};
  const Camera camera = frameCamera(scenes.drawn(weights), view, size);
  if (*cancel) return {};
  return valueOf(render(scenes.scene(weights, style), camera, size, cancel));
}

void savePng(const std::filesystem::path& path,
             const py::array_t<std::uint8_t, py::array::c_style>& picture) {
  checkKind(path, ".png");
  if (picture.ndim() != 3 || picture.shape(2) != 3)
    throw Failure("A picture must be an array of 8-bit numbers [height, width, 3].");
  Image image{static_cast<Index>(picture.shape(1)), static_cast<Index>(picture.shape(0)), {}};
  valueOf(checkSize({image.width, image.height}));
  image.rgb.assign(picture.data(), picture.data() + picture.size());
  valueOf(writeFile(path, valueOf(encodePng(image))));
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
    throw Failure("The style '" + style + "' needs meshes to compare with: use the tool.");
  const Weights blended = weightsFrom(rig, weights);
  LongWork work;
  const Image image = work.run([&] { return shot(rig, blended, size, from, how, work.cancel()); });
  return arrayOf(std::span<const std::uint8_t>(image.rgb), {height, width, 3});
}

void addPicture(py::module_& m) {
  m.def("save_png", &savePng, py::arg("path"), py::arg("picture"),
        "Writes a picture [height, width, 3] of 8 bits, as Rig.render returns it.");
}

}  // namespace sweepface::python
