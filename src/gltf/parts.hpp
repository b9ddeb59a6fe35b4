#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/accessor.hpp"
#include "gltf/affine.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// The modes of primitives made of triangles.
inline constexpr std::size_t listMode = 4, stripMode = 5, fanMode = 6;

/// A mesh that has primitives of the rig.
struct RigMesh {
  std::size_t mesh = 0;              ///< in the list of meshes
  std::vector<std::size_t> targets;  ///< [its targets] the rig's target of the same name
  Affine world;                      ///< how its first node, or its skin, places it in the scene
  bool mirrors = false;  ///< whether that node mirrors: faces then show the side from which their
                         ///< corners go clockwise, even if a skin places them
};

/// Vertices shared by primitives of one mesh: those with the same accessors for POSITION and for
/// every target's POSITION.
struct Run {
  std::size_t rigMesh = 0;                          ///< in Parts::meshes
  std::size_t first = 0, count = 0;                 ///< its vertices among the rig's
  std::size_t position = 0;                         ///< accessor
  std::vector<std::optional<std::size_t>> targets;  ///< [the mesh's targets] accessor, if any
};

/// A primitive of the rig: triangles, as a list, a strip or a fan.
struct Part {
  std::size_t run = 0;        ///< in Parts::runs
  std::size_t primitive = 0;  ///< in the list of its mesh
};

/// The parts of a glTF that make the rig (docs/glb.md): every triangle primitive with morph
/// targets, or all triangle primitives if none has any. Of meshes that were chosen, those with
/// targets, or all if a mesh has none. They are found the same way in a source and in the scene
/// made of it.
struct Parts {
  std::vector<RigMesh> meshes;
  std::vector<Run> runs;
  std::vector<Part> parts;           ///< in the order of meshes and primitives
  std::vector<std::string> targets;  ///< names, in order of first appearance
  std::size_t vertexCount = 0;
  std::vector<std::string> warnings{};  ///< sentences about targets without names
};

/// Finds the parts and checks that all attributes of a part and of its targets are accessors with
/// as many elements as the part has vertices, that POSITIONs are VEC3, and that every world matrix
/// can be inverted. Accessors may lack data.
Result<Parts> findParts(const Document& document);
/// The same, wherever nodes place the parts.
Result<Parts> findPartsAnywhere(const Document& document);

/// The JSON of a part's primitive.
const Json& primitiveOf(const Document& document, const Parts& parts, const Part& part);
Json& primitiveOf(Document& document, const Parts& parts, const Part& part);
/// Whether an extension of a primitive may depend on the order of its vertices or triangles.
bool countsOnOrder(std::string_view extension);
/// "mesh 0 'head'" and "mesh 0 'head', primitive 1", for messages.
std::string placeOf(const Document& document, std::size_t mesh);
std::string placeOf(const Document& document, std::size_t mesh, std::size_t primitive);

}  // namespace sweepface::gltf
