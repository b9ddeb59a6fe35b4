#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

#include "sweepface/io.hpp"

#include "io/ply_body.hpp"
#include "io/ply_header.hpp"
#include "io/single.hpp"
#include "io/target_shape.hpp"

namespace sweepface {
namespace {

using namespace io;

/// Reads the elements that a mesh is made of, skips the others, and stops at the first value that
/// makes no sense.
template <typename Body>
class PlyReader {
 public:
  PlyReader(std::string_view bytes, std::string_view name, const PlyHeader& header)
      : name_(name), header_(header), body_(bytes, header) {}

  bool read() {
    if (!checkVertexElement()) return false;
    // Faces may come first, and their vertex numbers fit an Index only if the file can hold that
    // many vertices.
    for (const PlyElement& element : header_.elements)
      if (!checkRoom(element)) return false;
    for (const PlyElement& element : header_.elements) {
      if (!checkRoom(element)) return false;
      if (!readElement(element)) return false;
    }
    return checkEnd();
  }

  Error error() { return {std::move(error_)}; }
  PolygonMesh mesh;                   // with texture coordinates per vertex
  std::vector<Vec2> cornerTexcoords;  // what its corners refer to if faces list them

 private:
  bool failFile(std::string_view what) {
    error_ = fmt::format("{} {}.", name_, what);
    return false;
  }

  bool failRow(std::string_view what) {
    error_ = fmt::format("{}, {} {} ({}): {}; export the mesh again or copy the file again.", name_,
                         element_->name, row_, body_.place(), what);
    return false;
  }

  bool checkVertexElement() {
    const PlyElement* const vertex = header_.find("vertex");
    if (!vertex || vertex->count == 0)
      return failFile("has no vertices (element 'vertex'); export the mesh again");
    vertexCount_ = static_cast<double>(vertex->count);
    slots_ = {vertex->find({"x"}), vertex->find({"y"}), vertex->find({"z"}),
              vertex->find({"s", "u", "texture_u", "texture_s", "texcoord_u"}),
              vertex->find({"t", "v", "texture_v", "texture_t", "texcoord_v"})};
    for (int axis = 0; axis < 3; ++axis)
      if (slots_[axis] < 0 || vertex->properties[slots_[axis]].countType)
        return failFile(
            fmt::format("has no vertex property '{}' that is a number; export the mesh "
                        "with positions",
                        "xyz"[axis]));
    return true;
  }

  /// Compares what the header promises with what the file can hold, before anything is allocated.
  bool checkRoom(const PlyElement& element) {
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += Body::leastSize(property.countType.value_or(property.type));
    if (least == 0 || element.count <= body_.bytesLeft() / least) return true;
    return failFile(fmt::format(
        "is cut short: its header promises {} of element {}, but only {} bytes are left for them; "
        "export the mesh again or copy the file again",
        element.count, inQuotes(element.name), body_.bytesLeft()));
  }

  /// Refuses rows that the header does not count, as they would be lost silently.
  bool checkEnd() {
    if (body_.isAtEnd()) return true;
    const PlyElement& last = header_.elements.back();
    return failFile(
        fmt::format("goes on ({}) behind the {} of element {} that its header counts; export the "
                    "mesh again",
                    body_.place(), last.count, inQuotes(last.name)));
  }

  bool readElement(const PlyElement& element) {
    element_ = &element;
    if (element.name == "vertex") return readVertices(element);
    if (element.name == "face") return readFaces(element);
    if (element.properties.empty()) return true;
    return readRows(element, [this](std::size_t property) { return skip(property); });
  }

  /// Reads each row, property by property.
  bool readRows(const PlyElement& element, auto readProperty) {
    for (row_ = 0; row_ < element.count; ++row_) {
      if (!body_.beginRow()) return failRow(body_.problem());
      for (std::size_t property = 0; property < element.properties.size(); ++property)
        if (!readProperty(property)) return false;
      if (!body_.endRow()) return failRow(body_.problem());
    }
    return true;
  }

  bool readValue(PlyScalar type, double& value) {
    return body_.read(type, value) || failRow(body_.problem());
  }

  /// Reads the count of a list and checks that the file can still hold its values.
  bool readCount(const PlyProperty& list, double& count) {
    if (!readValue(*list.countType, count)) return false;
    const double least = static_cast<double>(Body::leastSize(list.type));
    const bool isShort = count * least > static_cast<double>(body_.bytesLeft());
    return (count >= 0 && !isShort) ||
           failRow(fmt::format("the list {} claims {} values{}", inQuotes(list.name), count,
                               isShort ? ", but the file ends before them" : ""));
  }

  bool skip(std::size_t index) {
    const PlyProperty& property = element_->properties[index];
    double count = 1, value = 0;
    if (property.countType && !readCount(property, count)) return false;
    for (double i = 0; i < count; ++i)
      if (!readValue(property.type, value)) return false;
    return true;
  }

  bool readVertices(const PlyElement& element) {
    const bool textured = isNumber(element, slots_[3]) && isNumber(element, slots_[4]);
    mesh.positions.reserve(static_cast<std::size_t>(element.count));
    std::vector<double> row(element.properties.size());
    return readRows(element, [&](std::size_t property) {
      if (element.properties[property].countType) {
        if (!skip(property)) return false;
      } else if (!readValue(element.properties[property].type, row[property])) {
        return false;
      }
      return property + 1 < row.size() || addVertex(row, textured);
    });
  }

  static bool isNumber(const PlyElement& element, Index property) {
    return property >= 0 && !element.properties[property].countType;
  }

  bool checkCoordinate(double value) {
    return isSingle(value) ||
           failRow(fmt::format("the coordinate {} is not finite or too large", value));
  }

  bool addVertex(const std::vector<double>& row, bool textured) {
    for (int i = 0; i < (textured ? 5 : 3); ++i)
      if (!checkCoordinate(row[slots_[i]])) return false;
    mesh.positions.push_back({row[slots_[0]], row[slots_[1]], row[slots_[2]]});
    if (textured) mesh.polygons.texcoords.push_back({row[slots_[3]], row[slots_[4]]});
    return true;
  }

  bool readFaces(const PlyElement& element) {
    const Index list = element.find({"vertex_indices", "vertex_index"});
    if (element.count == 0) return true;
    if (list < 0 || !element.properties[list].countType ||
        !isInteger(element.properties[list].type))
      return failFile(
          "has faces without a list 'vertex_indices' of integers; export the mesh again");
    const Index texcoords = texcoordList(element);
    return readRows(element, [&](std::size_t property) {
      const PlyProperty& values = element.properties[property];
      const auto index = static_cast<Index>(property);
      const bool isRead = index == list        ? readFace(values)
                          : index == texcoords ? readTexcoords(values)
                                               : skip(property);
      const bool isLast = property + 1 == element.properties.size();
      return isRead && (!isLast || texcoords < 0 || addTexcoords());
    });
  }

  /// The property in which faces list texture coordinates of their corners, as MeshLab and scanners
  /// write them, or -1.
  static Index texcoordList(const PlyElement& face) {
    const Index list = face.find({"texcoord"});
    return list >= 0 && face.properties[list].countType ? list : -1;
  }

  bool readTexcoords(const PlyProperty& list) {
    double count = 0, value = 0;
    if (!readCount(list, count)) return false;
    faceTexcoords_.clear();
    for (double i = 0; i < count; ++i) {
      if (!readValue(list.type, value) || !checkCoordinate(value)) return false;
      faceTexcoords_.push_back(value);
    }
    return true;
  }

  /// Adds a pair for each corner of the face, or none at all; equal pairs are shared.
  bool addTexcoords() {
    Polygons& polygons = mesh.polygons;
    const auto corners = static_cast<std::size_t>(polygons.faceStart.back()) -
                         static_cast<std::size_t>(*(polygons.faceStart.end() - 2));
    if (faceTexcoords_.empty())
      polygons.cornerTexcoords.insert(polygons.cornerTexcoords.end(), corners, -1);
    else if (faceTexcoords_.size() != 2 * corners)
      return failRow(fmt::format("the list 'texcoord' has {} numbers for {} corners",
                                 faceTexcoords_.size(), corners));
    for (std::size_t k = 0; k < faceTexcoords_.size(); k += 2) {
      const auto [known, isNew] = texcoords_.try_emplace(
          {faceTexcoords_[k], faceTexcoords_[k + 1]}, static_cast<Index>(cornerTexcoords.size()));
      if (isNew) cornerTexcoords.push_back({faceTexcoords_[k], faceTexcoords_[k + 1]});
      polygons.cornerTexcoords.push_back(known->second);
    }
    return true;
  }

  bool readFace(const PlyProperty& list) {
    Polygons& polygons = mesh.polygons;
    double count = 0, vertex = 0;
    if (!readCount(list, count)) return false;
    if (count < 3) return failRow(fmt::format("the face has {} of the 3 corners it needs", count));
    for (double i = 0; i < count; ++i) {
      if (!readValue(list.type, vertex)) return false;
      if (vertex < 0 || vertex >= vertexCount_)
        return failRow(fmt::format("the face refers to vertex {}, but they go from 0 to {}", vertex,
                                   vertexCount_ - 1));
      polygons.corners.push_back(static_cast<Index>(vertex));
    }
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
    polygons.faceGroup.push_back(-1);
    polygons.faceMaterial.push_back(-1);
    return true;
  }

  std::string_view name_;
  const PlyHeader& header_;
  Body body_;
  double vertexCount_ = 0;
  std::array<Index, 5> slots_{};       // of x, y, z and the texture coordinates in a vertex row
  std::vector<double> faceTexcoords_;  // of the current face
  std::map<std::pair<double, double>, Index> texcoords_;  // of all faces
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
  std::string error_;
};

template <typename Body>
Result<PolygonMesh> readBody(std::string_view bytes, std::string_view name,
                             const PlyHeader& header) {
  PlyReader<Body> reader(bytes, name, header);
  if (!reader.read()) return std::unexpected(reader.error());
  Polygons& polygons = reader.mesh.polygons;
  if (!reader.cornerTexcoords.empty())
    polygons.texcoords = std::move(reader.cornerTexcoords);
  else if (!polygons.texcoords.empty())
    polygons.cornerTexcoords = polygons.corners;  // they are per vertex
  else
    polygons.cornerTexcoords.clear();
  return std::move(reader.mesh);
}

/// Reads a mesh that may lack faces.
Result<PolygonMesh> readPly(std::string_view bytes, std::string_view name) {
  if (bytes.size() > maxFileBytes)
    return fail(fmt::format("{} is larger than 2 GiB; export only the face.", name));
  const Result<PlyHeader> header = parsePlyHeader(bytes, name);
  if (!header) return std::unexpected(header.error());
  return header->format == PlyFormat::ascii ? readBody<AsciiBody>(bytes, name, *header)
                                            : readBody<BinaryBody>(bytes, name, *header);
}

}  // namespace

Result<PolygonMesh> parsePly(std::string_view bytes, std::string_view name) {
  bytes = withoutMark(bytes);
  Result<PolygonMesh> mesh = readPly(bytes, name);
  if (!mesh || mesh->polygons.faceCount() > 0) return mesh;
  const auto header = parsePlyHeader(bytes, name);
  return fail(fmt::format("{} has no faces (element 'face'){}; export the mesh with its faces.",
                          name, header->find("tristrips") ? ", but strips of triangles" : ""));
}

Result<io::TargetShape> io::parsePlyTarget(std::string_view bytes, std::string_view name) {
  Result<PolygonMesh> mesh = readPly(withoutMark(bytes), name);
  if (!mesh) return std::unexpected(mesh.error());
  const Index faceCount = mesh->polygons.faceCount();
  return TargetShape{std::move(mesh->positions), faceCount};
}

}  // namespace sweepface
