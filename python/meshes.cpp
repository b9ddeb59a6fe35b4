#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/subdivision.hpp"

#include "bindings.hpp"

namespace sweepface::python {
namespace {

std::vector<Vec3> placesFrom(const py::object& array, const std::string& what) {
  auto points = pointsFrom(as<Doubles>(array, what.c_str(), "an array of numbers"), what.c_str());
  constexpr double kMost = 1e30;  // files hold single precision, in which squares must be finite
  for (const Vec3& p : points)
    for (const double x : {p.x, p.y, p.z})
      if (!(std::abs(x) <= kMost)) throw Failure(what + " must be numbers within 1e30 of 0.");
  return points;
}

Polygons polygonsFrom(const py::iterable& faces, std::size_t vertices) {
  Polygons polygons;
  for (const py::handle face : faces) {
    for (const auto v :
         as<std::vector<std::int64_t>>(face, "Every face", "a sequence of vertices")) {
      if (v < 0 || v >= static_cast<std::int64_t>(vertices))
        throw Failure(fmt::format("Face {} has vertex {}, but there are {} vertices, from 0 on.",
                                  polygons.faceCount(), v, vertices));
      polygons.corners.push_back(static_cast<Index>(v));
    }
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
  }
  return polygons;
}

void setTexcoords(Polygons& polygons, const py::object& texcoords, const py::object& corners) {
  if (texcoords.is_none() && corners.is_none()) return;
  const auto places = as<Doubles>(texcoords, "Texture coordinates", "an array of numbers");
  if (places.ndim() != 2 || places.shape(1) != 2)
    throw Failure("Texture coordinates must be an array of two numbers a row, [T, 2].");
  for (py::ssize_t k = 0; k < places.shape(0); ++k)
    polygons.texcoords.push_back({places.at(k, 0), places.at(k, 1)});
  polygons.cornerTexcoords =
      corners.is_none() ? polygons.corners
                        : as<std::vector<Index>>(corners, "corner_texcoords", "whole numbers");
  const auto count = static_cast<Index>(polygons.texcoords.size());
  if (polygons.cornerTexcoords.size() != polygons.corners.size() ||
      std::ranges::any_of(polygons.cornerTexcoords, [&](Index t) { return t < -1 || t >= count; }))
    throw Failure(fmt::format(
        "Every corner of a face needs the number of one of the {} texture coordinates, or -1.",
        count));
}

void setTargets(MeshRig& rig, const py::object& targets) {
  rig.targets.clear();
  for (const auto& [name, shape] : mappingFrom(targets, "Targets")) {
    MeshTarget target{textFrom(name, "The name of a target"), {}};
    target.positions = placesFrom(py::reinterpret_borrow<py::object>(shape),
                                  fmt::format("The positions of '{}'", target.name));
    if (target.positions.size() != rig.neutral.positions.size())
      throw Failure(fmt::format("Target '{}' has {} vertices, but the neutral has {}.", target.name,
                                target.positions.size(), rig.neutral.positions.size()));
    rig.targets.push_back(std::move(target));
  }
}

RigSource meshesFrom(const py::object& positions, const py::iterable& faces,
                     const py::object& targets, const py::object& texcoords,
                     const py::object& cornerTexcoords) {
  RigSource meshes;
  PolygonMesh& neutral = meshes.rig.neutral;
  neutral.positions = placesFrom(positions, "Positions");
  neutral.polygons = polygonsFrom(faces, neutral.positions.size());
  setTexcoords(neutral.polygons, texcoords, cornerTexcoords);
  setTargets(meshes.rig, targets);
  return meshes;
}

RigSource withShapes(RigSource meshes, const py::object& targets, const py::object& positions) {
  if (!positions.is_none()) {
    auto moved = placesFrom(positions, "Positions");
    if (moved.size() != meshes.rig.neutral.positions.size())
      throw Failure(fmt::format("There are {} positions for {} vertices.", moved.size(),
                                meshes.rig.neutral.positions.size()));
    meshes.rig.neutral.positions = std::move(moved);
  }
  setTargets(meshes.rig, targets);
  return meshes;
}

RigSource subdivided(const RigSource& meshes, int levels) {
  Subdivision limit = valueOf(released([&] { return subdivide(meshes.rig, levels); }));
  warn(limit.warnings);
  return {std::move(limit.rig), {}, {}};
}

RigSource readMeshes(const std::filesystem::path& neutral, const py::object& targets,
                     const py::object& meshes) {
  using Paths = std::vector<std::filesystem::path>;
  constexpr const char* kWhat = "The targets";
  const bool isOne = py::isinstance<py::str>(targets) || py::hasattr(targets, "__fspath__");
  const Paths paths = isOne ? Paths{as<std::filesystem::path>(targets, kWhat, "paths")}
                            : as<Paths>(targets, kWhat, "paths");
  SourceOptions options;
  options.meshes = py::isinstance<py::str>(meshes)
                       ? std::vector{as<std::string>(meshes, "meshes", "names")}
                       : as<std::vector<std::string>>(meshes, "meshes", "names");
  auto source = valueOf(released([&] { return readSource(neutral, paths, {}, options); }));
  warn(source.faceWarnings);
  warn(source.warnings);
  return source;
}

py::list facesOf(const Polygons& polygons) {
  py::list faces;
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const auto first = polygons.corners.begin() + polygons.faceStart[f];
    faces.append(py::tuple(py::cast(std::vector<Index>(first, first + polygons.faceSize(f)))));
  }
  return faces;
}

py::dict shapesOf(const MeshRig& rig) {
  py::dict shapes;
  for (const MeshTarget& target : rig.targets)
    shapes[py::str(target.name)] = arrayOfPoints(target.positions);
  return shapes;
}

py::object texcoordsOf(const Polygons& polygons) {
  if (polygons.texcoords.empty()) return py::none();
  py::array_t<double> array({polygons.texcoords.size(), std::size_t{2}});
  double* x = array.mutable_data();
  for (const Vec2& t : polygons.texcoords) x[0] = t.x, x[1] = t.y, x += 2;
  return array;
}

}  // namespace

void addMeshes(py::module_& m) {
  py::class_<RigSource>(m, "Meshes", "A neutral mesh and its targets, over the same faces.")
      .def(py::init(&meshesFrom), py::arg("positions"), py::arg("faces"),
           py::arg("targets") = py::dict(), py::kw_only(), py::arg("texcoords") = py::none(),
           py::arg("corner_texcoords") = py::none(),
           "positions [V, 3]; faces, vertices of each counter-clockwise; targets, positions [V, 3] "
           "at weight 1 by name; texcoords [T, 2] and which of them each corner has, face by face "
           "(that of its vertex if not given).")
      .def_property_readonly(
          "positions", [](const RigSource& s) { return arrayOfPoints(s.rig.neutral.positions); },
          "Of the neutral: [V, 3].")
      .def_property_readonly(
          "faces", [](const RigSource& s) { return facesOf(s.rig.neutral.polygons); },
          "The vertices of each face, counter-clockwise.")
      .def_property_readonly(
          "targets", [](const RigSource& s) { return shapesOf(s.rig); },
          "Positions at weight 1 by name: [V, 3] each.")
      .def_property_readonly(
          "texcoords", [](const RigSource& s) { return texcoordsOf(s.rig.neutral.polygons); },
          "u to the right and v upwards, [T, 2], or None.")
      .def_property_readonly(
          "corner_texcoords",
          [](const RigSource& s) { return arrayOf(s.rig.neutral.polygons.cornerTexcoords); },
          "Which of them the corners of the faces have, face by face; -1: none. Empty if there are "
          "none.")
      .def("with_shapes", &withShapes, py::arg("targets"), py::arg("positions") = py::none(),
           "The same faces, texture coordinates, materials and scene with other targets, and with "
           "another neutral if positions are given.")
      .def("subdivided", &subdivided, py::arg("levels") = 1,
           "The limit surface of meshes that are cages, by Catmull-Clark subdivision, with every "
           "edge cut into 2**levels, 1 to 5 (docs/subdivision.md). The scene of a GLB stays "
           "behind.")
      .def(
          "save_glb",
          [](const RigSource& s, const std::filesystem::path& path) {
            checkKind(path, ".glb");
            valueOf(released([&] { return writeFile(path, valueOf(formatGlb(s.rig))); }));
          },
          py::arg("path"), "Writes a GLB with the targets as morph targets.")
      .def("__repr__", [](const RigSource& s) {
        return fmt::format("<sweepface.Meshes: {} vertices, {} faces, {} targets>",
                           s.rig.neutral.positions.size(), s.rig.neutral.polygons.faceCount(),
                           s.rig.targets.size());
      });
  m.def("read_meshes", &readMeshes, py::arg("neutral"), py::arg("targets") = py::tuple(),
        py::kw_only(), py::arg("meshes") = py::tuple(),
        "Reads an .obj or .ply file and its targets, a path or several: files, each named after "
        "itself, or folders of them; or a .glb, .gltf or .vrm file, which holds its targets. Of "
        "such a file, the face is the meshes, or what the objects show, whose names are in meshes "
        "(one or several), if there are any.");
}

}  // namespace sweepface::python
