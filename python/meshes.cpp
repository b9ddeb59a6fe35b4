#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"

#include "bindings.hpp"
#include "long_work.hpp"

namespace sweepface::python {
namespace {

Polygons polygonsFrom(const py::iterable& faces, std::size_t vertices) {
  Polygons polygons;
  for (const py::handle face : faces) {
    for (const auto v : py::cast<std::vector<std::int64_t>>(face)) {
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
  const auto places = py::cast<Doubles>(texcoords);
  if (places.ndim() != 2 || places.shape(1) != 2)
    throw Failure("Texture coordinates must be an array of two numbers a row, [T, 2].");
  for (py::ssize_t k = 0; k < places.shape(0); ++k)
    polygons.texcoords.push_back({places.at(k, 0), places.at(k, 1)});
  polygons.cornerTexcoords =
      corners.is_none() ? polygons.corners : py::cast<std::vector<Index>>(corners);
  const auto count = static_cast<Index>(polygons.texcoords.size());
  if (polygons.cornerTexcoords.size() != polygons.corners.size() ||
      std::ranges::any_of(polygons.cornerTexcoords, [&](Index t) { return t < -1 || t >= count; }))
    throw Failure(fmt::format(
        "Every corner of a face needs the number of one of the {} texture coordinates, or -1.",
        count));
}

RigSource meshesFrom(const Doubles& positions, const py::iterable& faces, const py::dict& targets,
                     const py::object& texcoords, const py::object& cornerTexcoords) {
  RigSource meshes;
  PolygonMesh& neutral = meshes.rig.neutral;
  neutral.positions = pointsFrom(positions, "Positions");
  if (neutral.positions.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw Failure("A mesh may have 2,147,483,647 vertices at most.");
  neutral.polygons = polygonsFrom(faces, neutral.positions.size());
  setTexcoords(neutral.polygons, texcoords, cornerTexcoords);
  for (const auto& [name, shape] : targets) {
    MeshTarget target{py::cast<std::string>(name),
                      pointsFrom(py::cast<Doubles>(shape), "A target's positions")};
    if (target.positions.size() != neutral.positions.size())
      throw Failure(fmt::format("Target '{}' has {} vertices, but the neutral has {}.", target.name,
                                target.positions.size(), neutral.positions.size()));
    meshes.rig.targets.push_back(std::move(target));
  }
  return meshes;
}

RigSource readMeshes(const std::filesystem::path& neutral,
                     const std::vector<std::filesystem::path>& targets) {
  LongWork work(py::none{});
  auto meshes = valueOf(work.run([&] { return readSource(neutral, targets); }));
  warn(meshes.faceWarnings);
  warn(meshes.warnings);
  return meshes;
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
      .def(
          "save_glb",
          [](const RigSource& s, const std::filesystem::path& path) {
            valueOf(writeFile(path, valueOf(formatGlb(s.rig))));
          },
          py::arg("path"), "Writes a GLB with the targets as morph targets.")
      .def("__repr__", [](const RigSource& s) {
        return fmt::format("<sweepface.Meshes: {} vertices, {} faces, {} targets>",
                           s.rig.neutral.positions.size(), s.rig.neutral.polygons.faceCount(),
                           s.rig.targets.size());
      });
  m.def("read_meshes", &readMeshes, py::arg("neutral"),
        py::arg("targets") = std::vector<std::filesystem::path>(),
        "Reads an .obj or .ply file and its targets: files, each named after itself, or folders of "
        "them; or a .glb or .gltf file, which holds its targets.");
}

}  // namespace sweepface::python
