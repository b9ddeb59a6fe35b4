#include <filesystem>
#include <fmt/format.h>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/limits.hpp"
#include "sweepface/strip.hpp"
#include "sweepface/usd.hpp"

#include "bindings.hpp"
#include "clip.hpp"
#include "head.hpp"
#include "long_work.hpp"
#include "picture.hpp"
#include "pose.hpp"

namespace sweepface::python {
namespace {

using SharedRig = std::shared_ptr<Rig>;  // never changes once Python has it

// ---- Files ----

SharedRig decoded(const std::string_view bytes, const std::string& name, std::size_t memory) {
  return released([&] { return std::make_shared<Rig>(valueOf(decode(bytes, name, {memory}))); });
}

SharedRig loaded(const std::filesystem::path& path, std::size_t memory) {
  return decoded(valueOf(readFile(path)), path.string(), memory);
}

/// The same clip with its first frame at 0: the times of captures are those of the day.
Clip fromItsBeginning(Clip clip) {
  const double first = clip.times.empty() ? 0 : clip.times.front();
  for (double& time : clip.times) time -= first;
  return clip;
}

/// What Python gives for any file of a rig with its targets.
struct RigFile {
  Index level = 0;
  py::object vertices, edgeLength, error;  // a budget
  bool morphNormals = false;
  py::object weights;
  const Clip* clip = nullptr;
  bool head = false;
  py::object pivot;
};

/// What the options of such a file point to.
class RigFileOptions {
 public:
  RigFileOptions(const Rig& rig, RigFile given) : rig_(rig), given_(std::move(given)) {
    const auto budget = budgetFrom(given_.vertices, given_.edgeLength, given_.error);
    if (budget && given_.level != 0) throw Failure("Give either a level or a budget.");
    if (budget)
      grid_.emplace(rig.surface, valueOf(densityFor(rig.surface, blend(rig, {}), *budget)));
    if (!given_.head && !given_.pivot.is_none())
      throw Failure("The model turns about the pivot with head only; leave the pivot out.");
    if (given_.clip) clip_ = fromItsBeginning(clipOfTargets(rig, *given_.clip));
    if (given_.head) head_ = headTrackOf(rig, given_.clip, given_.pivot);
  }

  /// Sets what GlbOptions and UsdOptions have alike. This must outlive them.
  template <typename Options>
  Options make() const {
    Options options;
    options.lod = given_.level, options.morphNormals = given_.morphNormals;
    if (grid_) options.grid = &*grid_;
    if (!given_.weights.is_none()) options.weights = weightsFrom(rig_, given_.weights);
    if (given_.clip) options.clip = &clip_;
    if (given_.head) options.head = &head_;
    return options;
  }

 private:
  const Rig& rig_;
  RigFile given_;
  std::optional<Tessellation> grid_;
  Clip clip_;
  HeadTrack head_;
};

void saveGlb(const Rig& rig, const std::filesystem::path& path, const RigFile& given, bool quantize,
             double keyTolerance, double metersPerUnit, bool zUp) {
  checkKind(path, ".glb");
  if (keyTolerance > 0 && !given.clip)
    throw Failure("key_tolerance is for the keys of a clip; give one.");
  const RigFileOptions file(rig, given);
  auto options = file.make<GlbOptions>();
  options.quantize = quantize, options.keyTolerance = keyTolerance;
  options.metersPerUnit = metersPerUnit, options.zUp = zUp;
  released([&] { return valueOf(writeFile(path, valueOf(formatGlb(rig, options)))); });
}

void saveUsd(const Rig& rig, const std::filesystem::path& path, const RigFile& given,
             const py::object& timeCodesPerSecond, double metersPerUnit, bool zUp) {
  if (!timeCodesPerSecond.is_none() && !given.clip)
    throw Failure("time_codes_per_second is for the frames of a clip; give one.");
  const bool isArchive = extensionOf(path) == ".usdz";
  if (!isArchive && extensionOf(path) != ".usd" && extensionOf(path) != ".usda")
    throw Failure(path.string() + " must end in .usda, .usd or .usdz; choose another name.");
  const RigFileOptions file(rig, given);
  auto options = file.make<UsdOptions>();
  if (!timeCodesPerSecond.is_none())
    options.timeCodesPerSecond = numberFrom(timeCodesPerSecond, "time_codes_per_second");
  options.metersPerUnit = metersPerUnit, options.zUp = zUp;
  if (const std::string leftOut = leftOutOfUsd(rig); !leftOut.empty()) warn({&leftOut, 1});
  released([&] {
    return valueOf(writeFile(path, valueOf((isArchive ? formatUsdz : formatUsd)(rig, options))));
  });
}

void saveObj(const Rig& rig, const std::filesystem::path& path, const py::object& weights) {
  checkKind(path, ".obj");
  const Weights blended = weightsFrom(rig, weights);
  const std::vector<Vec3> vectors = blend(rig, blended);
  const Tessellation level1(rig.surface, 1);
  const auto positions = sourcePositions(rig, level1, vectors, blended);
  const auto normals = sourceNormals(rig, level1, vectors);
  valueOf(writeFile(path, formatObj({positions, normals, rig.source.polygons})));
}

// ---- Other rigs made of one ----

SharedRig packed(const Rig& rig, double tolerance, int textureBits, const py::object& progress) {
  auto copy = std::make_shared<Rig>(rig);
  LongWork work(progress);
  const PackOptions options{tolerance, textureBits, work.report(), work.cancel()};
  valueOf(work.run([&] { return pack(*copy, options); }));
  return copy;
}

SharedRig stripped(const Rig& rig, const std::string& parts) {
  auto copy = std::make_shared<Rig>(rig);
  valueOf(strip(*copy, valueOf(parseStrip(parts))));
  return copy;
}

// ---- What it holds ----

py::array_t<double> storedVectors(const Rig& rig, const py::object& target) {
  if (target.is_none()) return arrayOfPoints(rig.neutral);
  const Index found = valueOf(findTarget(rig, textFrom(target, "A target's name")));
  return arrayOfPoints(rig.targets[found].difference);
}

/// An array [rows × columns] of whole numbers.
template <std::size_t columns, typename Row>
py::array_t<Index> table(std::size_t rows, const Row& row) {
  std::vector<Index> numbers;
  for (std::size_t k = 0; k < rows; ++k)
    for (const Index number : row(static_cast<Index>(k))) numbers.push_back(number);
  return arrayOf(std::span<const Index>(numbers),
                 {static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
}

py::array_t<Index> arcsOf(const Rig& rig) {
  const std::vector<Arc>& arcs = rig.surface.wireframe().arcs;
  return table<2>(arcs.size(), [&](Index a) { return std::array{arcs[a].from, arcs[a].to}; });
}

py::array_t<Index> patchEdgesOf(const Rig& rig) {
  return table<2>(rig.surface.wireframe().patches.size(), [&](Index p) {
    return std::array{rig.surface.edgesU(p), rig.surface.edgesV(p)};
  });
}

py::array_t<Index> arcRibbonsOf(const Rig& rig) {
  std::vector<Index> ribbons;
  for (const Arc& arc : rig.surface.wireframe().arcs) ribbons.push_back(arc.ribbon);
  return arrayOf(ribbons);
}

py::array_t<double> ribbonsOf(const Rig& rig) {
  std::vector<Vec3> shapes;
  for (const Shape& shape : rig.surface.wireframe().ribbons)
    shapes.push_back({shape.rho, shape.eta, shape.lambda});
  return arrayOfPoints(shapes);
}

py::tuple basesOf(const Rig& rig, Index patch) {
  checkPatch(rig.surface, patch);
  const auto [u, v0, v1] = rig.surface.patchBasis(patch);
  return py::make_tuple(*u, *v0, *v1);
}

py::list patchSides(const Rig& rig, Index patch) {
  checkPatch(rig.surface, patch);
  py::list sides;
  for (int s = 0; s < 4; ++s) {
    py::list side;
    for (const HalfArc h : rig.surface.wireframe().side(patch, s))
      side.append(py::make_tuple(arcOf(h), h % 2 == 0));
    sides.append(side);
  }
  return sides;
}

void addFiles(py::class_<Rig, SharedRig>& rig) {
  using namespace py::literals;
  rig.def(
         "encode", [](const Rig& r) { return py::bytes(encode(r)); },
         "The bytes of a .sweep file. The same rig gives the same bytes everywhere.")
      .def(
          "save",
          [](const Rig& r, const std::filesystem::path& path) {
            checkKind(path, ".sweep");
            valueOf(writeFile(path, encode(r)));
          },
          "path"_a, "Writes a .sweep file beside the path, then renames it.")
      .def(
          "save_glb",
          [](const Rig& r, const std::filesystem::path& path, Index level,
             const py::object& vertices, const py::object& edgeLength, const py::object& error,
             bool morphNormals, bool quantize, const py::object& weights, const Clip* clip,
             double keyTolerance, bool head, const py::object& pivot, double metersPerUnit,
             bool zUp) {
            saveGlb(r, path,
                    {level, vertices, edgeLength, error, morphNormals, weights, clip, head, pivot},
                    quantize, keyTolerance, metersPerUnit, zUp);
          },
          "path"_a, py::kw_only(), "level"_a = 0, "vertices"_a = py::none(),
          "edge_length"_a = py::none(), "error"_a = py::none(), "morph_normals"_a = false,
          "quantize"_a = false, "weights"_a = py::none(), "clip"_a = nullptr, "key_tolerance"_a = 0,
          "head"_a = false, "pivot"_a = py::none(), "meters_per_unit"_a = 0, "z_up"_a = false,
          "Writes a GLB with the targets as morph targets, in the scene that came with the rig, if "
          "one did. level 0: the source's vertices; N: every edge cut into N. Or a budget instead: "
          "at most so many vertices, no longer edges along curves, or no edge further than error "
          "from the surface. morph_normals writes normals of the targets, too; quantize stores "
          "whole numbers (KHR_mesh_quantization); weights are those at which the face is shown. A "
          "clip becomes an animation, in as few keys as keep its weights within key_tolerance, if "
          "that is given. With head, the whole model turns by the clip's angles of the head, about "
          "the pivot [3] or else its middle. Of a rig without a scene, meters_per_unit (0: 1) is "
          "how long a unit is, and z_up says that z points up.")
      .def(
          "save_usd",
          [](const Rig& r, const std::filesystem::path& path, Index level,
             const py::object& vertices, const py::object& edgeLength, const py::object& error,
             bool morphNormals, const py::object& weights, const Clip* clip,
             const py::object& timeCodesPerSecond, bool head, const py::object& pivot,
             double metersPerUnit, bool zUp) {
            saveUsd(r, path,
                    {level, vertices, edgeLength, error, morphNormals, weights, clip, head, pivot},
                    timeCodesPerSecond, metersPerUnit, zUp);
          },
          "path"_a, py::kw_only(), "level"_a = 0, "vertices"_a = py::none(),
          "edge_length"_a = py::none(), "error"_a = py::none(), "morph_normals"_a = false,
          "weights"_a = py::none(), "clip"_a = nullptr, "time_codes_per_second"_a = py::none(),
          "head"_a = false, "pivot"_a = py::none(), "meters_per_unit"_a = 0, "z_up"_a = false,
          "Writes a .usda, or a .usdz with the images of its materials, with the targets as blend "
          "shapes of UsdSkel. A clip becomes a time sample for each of its frames, at 24 time "
          "codes a second if time_codes_per_second is not given. meters_per_unit 0: 1 for a rig "
          "with the scene of a GLB, otherwise what its units are, or 0.01. The rest is as in "
          "save_glb.")
      .def("save_obj", &saveObj, "path"_a, "weights"_a = py::none(),
           "Writes an expression as an OBJ, in the source's order, with the surface's normals.")
      .def("packed", &packed, "tolerance"_a = 0, py::kw_only(), "texture_bits"_a = 0,
           "progress"_a = py::none(),
           "This rig packed: vectors become small whole numbers, most of them zero, and the file "
           "several times smaller. No vertex moves by more than the tolerance in any target (0: "
           "the rig's own). texture_bits are those of texture coordinates (0: as packed before, or "
           "14). convert(pack=True) makes smaller files still.")
      .def("stripped", &stripped, "parts"_a,
           "This rig without parts of its file: order, uv, groups, scene, with commas between.");
}

void addContents(py::class_<Rig, SharedRig>& rig) {
  using namespace py::literals;
  rig.def_property_readonly("target_names", &Rig::targetNames, "[K]")
      .def(
          "target",
          [](const Rig& r, const std::string& name) { return valueOf(findTarget(r, name)); },
          "name"_a, "The number of a target.")
      .def(
          "weights",
          [](const Rig& r, const py::object& given) { return arrayOf(weightsFrom(r, given)); },
          "weights"_a = py::none(),
          "Weights as an array [K]: of a dict of names and weights, or all 0.")
      .def_readonly("tolerance", &Rig::tolerance, "The error it was made for, in model units.")
      .def_property_readonly("units", [](const Rig& r) { return r.names.units; })
      .def_property_readonly(
          "vertex_count", [](const Rig& r) { return r.source.gridVertex.size(); },
          "Vertices of the source.")
      .def_property_readonly("patch_count", [](const Rig& r) { return r.surface.patchCount(); })
      .def("vectors", &storedVectors, "target"_a = py::none(),
           "The stored vectors [S, 3], which are the tool's points: of the neutral, or what a "
           "target adds to them.")
      .def_property_readonly("arcs", &arcsOf, "The nodes at both ends of every curve: [A, 2].")
      .def_property_readonly("patch_edges", &patchEdgesOf,
                             "How many edges of the source a patch is long in u and in v: [P, 2].")
      .def("patch_sides", &patchSides, "patch"_a,
           "The curves along v = 0, u = 1, v = 1 and u = 0, counter-clockwise: lists of (arc, "
           "whether it is travelled from its first node).")
      .def_property_readonly("ribbons", &ribbonsOf,
                             "Shape parameters rho, eta, lambda per edge of the source: [R, 3].")
      .def_property_readonly("arc_ribbons", &arcRibbonsOf,
                             "The ribbon whose parameters govern each curve: [A].")
      .def("bases", &basesOf, "patch"_a,
           "The functions of a patch, each over [0, 1]: of its sweep along u, and of its curves at "
           "u = 0 and at u = 1, which go along v.")
      .def("__repr__", [](const Rig& r) {
        return fmt::format("<sweepface.Rig: {} vertices, {} patches, {} targets>",
                           r.source.gridVertex.size(), r.surface.patchCount(), r.targets.size());
      });
}

}  // namespace

void addRig(py::module_& m) {
  using namespace py::literals;
  constexpr std::size_t memory = DecodeLimits{}.memory;
  py::class_<Rig, SharedRig> rig(m, "Rig",
                                 "A neutral face and its targets, as ODE sweeping surfaces. It "
                                 "never changes; any number of threads may use it.");
  addFiles(rig);
  addContents(rig);
  rig.def(
         "pose",
         [](const SharedRig& r, const py::object& weights, const py::object& regions) {
           return Pose(r, weights, regions);
         },
         "weights"_a = py::none(), "regions"_a = py::none(),
         "The face under weights: None, a dict of names and weights, or an array [K]. In regions, "
         "an array [R, K] has weights for each.")
      .def(
          "limits",
          [](const Rig& r, const std::string& limits) {
            const Limits ranges = valueOf(Limits::parse(r, limits));
            std::vector<double> bounds;
            for (const auto& [low, high] : ranges.ranges())
              bounds.insert(bounds.end(), {low, high});
            return arrayOf(std::span<const double>(bounds),
                           {static_cast<py::ssize_t>(bounds.size() / 2), 2});
          },
          "limits"_a,
          "The least and the greatest weights [K, 2] of limits as the tool takes them: "
          "'0:1,jawOpen=0:0.8'; infinite where there are none.")
      .def(
          "meshes", [](const Rig& r) { return RigSource{meshesOf(r), r.scene, {}}; },
          "The neutral and its targets as meshes, in the source's order.")
      .def(py::pickle([](const Rig& r) { return py::bytes(encode(r)); },
                      [](const py::bytes& bytes) {
                        return decoded(std::string_view(bytes), "The pickled face", memory);
                      }))
      .def("render", &renderRig, "weights"_a = py::none(), py::kw_only(), "width"_a = 640,
           "height"_a = 800, "view"_a = "front", "style"_a = "shaded",
           "A picture [height, width, 3] of 8 bits. Views are front, side, three-quarter, back or "
           "'AZIMUTH,ELEVATION' in degrees; styles shaded, patches, wireframe, joins, normals and "
           "zebra.");
  m.def("load", &loaded, "path"_a, py::kw_only(), "memory"_a = memory,
        "Reads a .sweep file, for which it takes about `memory` bytes at most.");
  m.def(
      "decode",
      [](const py::buffer& bytes, const std::string& name, std::size_t most) {
        const auto copy = py::reinterpret_steal<py::bytes>(PyBytes_FromObject(bytes.ptr()));
        if (!copy) throw py::error_already_set();
        return decoded(std::string_view(copy), name, most);
      },
      "bytes"_a, "name"_a = "The face", py::kw_only(), "memory"_a = memory,
      "The same from the bytes of a file, which messages call by the name.");
}

}  // namespace sweepface::python
