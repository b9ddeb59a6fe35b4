#include <memory>

#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"

#include "bindings.hpp"
#include "long_work.hpp"

namespace sweepface::python {
namespace {

std::shared_ptr<Rig> converted(const RigSource& meshes, double tolerance, bool pack,
                               const py::object& maxBytes, double normalLimit,
                               double normalTolerance, int textureBits, bool chooseShapes,
                               const py::object& progress) {
  LongWork work(progress);
  ConvertOptions options;
  options.tolerance = tolerance;
  options.normalLimit = normalLimit;
  options.pack = pack || !maxBytes.is_none();
  options.normalTolerance = normalTolerance;
  options.textureBits = textureBits;
  options.chooseShapes = chooseShapes;
  options.progress = work.report();
  options.cancel = work.cancel();
  if (!options.pack && normalTolerance > 0)
    throw Failure("normal_tolerance is for packed rigs; give pack or max_bytes as well.");
  if (!options.pack && textureBits != ConvertOptions{}.textureBits)
    throw Failure("texture_bits is for packed rigs; give pack or max_bytes as well.");
  const std::size_t most =
      maxBytes.is_none() ? 0 : as<std::size_t>(maxBytes, "max_bytes", "a number of bytes");
  if (most == 0 && !maxBytes.is_none()) throw Failure("max_bytes must be at least 1.");
  const std::string scene = options.pack ? packedScene(meshes.scene) : meshes.scene;
  const auto finish = [&](Rig& rig) -> Result<void> {
    rig.scene = scene;
    return {};
  };
  auto made = valueOf(work.run([&] {
    return most > 0 ? convertToBytes(meshes.rig, options, most, finish)
                    : convert(meshes.rig, options);
  }));
  valueOf(finish(made.rig));
  if (auto lost = lostMovement(meshes.rig, keptMovement(made.rig, meshes.rig)); !lost.empty())
    made.warnings.push_back(std::move(lost));
  warn(made.warnings);
  return std::make_shared<Rig>(std::move(made.rig));
}

}  // namespace

void addConversion(py::module_& m) {
  using namespace py::literals;
  const ConvertOptions usual;
  m.def(
      "convert", &converted, "meshes"_a, "tolerance"_a = usual.tolerance, py::kw_only(),
      "pack"_a = usual.pack, "max_bytes"_a = py::none(), "normal_limit"_a = usual.normalLimit,
      "normal_tolerance"_a = usual.normalTolerance, "texture_bits"_a = usual.textureBits,
      "choose_shapes"_a = usual.chooseShapes, "progress"_a = py::none(),
      "Turns meshes into a rig whose vertices are all within the tolerance, in the neutral and "
      "in every target; in model units, 0: 0.02 % of the diagonal. Raises Error rather than "
      "miss it. pack makes the smallest file; max_bytes looks for the smallest tolerance whose "
      "file takes at most so many. normal_limit refines where normals are further off than this, "
      "in degrees (0: in proportion to the tolerance, 180: nowhere); with pack, normal_tolerance "
      "is the RMS that all normals must keep to and texture_bits the bits of texture coordinates. "
      "choose_shapes=False is faster and makes slightly larger files. Uses all cores; Ctrl-C "
      "ends it, and progress(what, done) is "
      "called now and then with what is going on and how far it is, 0 to 1. Warnings are "
      "Python's.");
}

}  // namespace sweepface::python
