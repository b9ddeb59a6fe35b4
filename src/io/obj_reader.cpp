#include <cstdint>
#include <fmt/format.h>
#include <utility>

#include "sweepface/io.hpp"

#include "io/single.hpp"
#include "io/target_shape.hpp"
#include "io/text.hpp"

namespace sweepface {
namespace {

using namespace io;

constexpr std::string_view corrected = "correct it or export the mesh again";

/// The largest index that faces use; faces may come before what they refer to.
struct Reach {
  std::int64_t furthest = 0;
  std::size_t line = 0;
};

/// Reads statement by statement and stops at the first that makes no sense.
class ObjReader {
 public:
  enum class Wanted { everything, target };

  ObjReader(std::string_view text, std::string_view name, Wanted wanted)
      : name_(name), wanted_(wanted), text_(io::withoutMark(text)), lines_(text_) {}

  bool read() {
    if (text_.size() > maxFileBytes) return failFile("is larger than 2 GiB; export only the face");
    if (trimmed(text_).empty()) return failFile("is empty; export the mesh again");
    if (io::isUtf16(text_)) return failFile("is a text in UTF-16; save it in UTF-8");
    while (nextStatement())
      if (!readStatement()) return false;
    return checkWhole();
  }

  Error error() { return {std::move(error_)}; }
  PolygonMesh mesh;
  Index faceCount = 0;

 private:
  bool failFile(std::string_view what) {
    error_ = fmt::format("{} {}.", name_, what);
    return false;
  }

  bool failLine(std::size_t line, std::string_view what, std::string_view remedy = corrected) {
    error_ = fmt::format("{}, line {}: {}; {}.", name_, line, what, remedy);
    return false;
  }

  bool fail(std::string_view what) {
    return failLine(statementLine_, what,
                    lines_.cutShort() ? "the file ends here and may be cut short, export the mesh "
                                        "or copy the file again"
                                      : corrected);
  }

  /// Moves to the next statement, which continues on the next line after a '\' outside a comment.
  bool nextStatement() {
    if (!lines_.next()) return false;
    statementLine_ = lines_.number();
    statement_ = trimmed(lines_.line());
    if (!statement_.ends_with('\\')) return true;
    const bool isName = endsInName(statement_);
    const auto goesOn = [&](std::string_view line) {
      return line.ends_with('\\') && (isName || !hasComment(line));
    };
    joined_ = statement_;
    for (std::string_view line = statement_; goesOn(line) && lines_.next();) {
      line = trimmed(lines_.line());
      joined_.back() = ' ';
      joined_ += line;
    }
    statement_ = joined_;
    return true;
  }

  /// Whether a statement ends in a name. Names run to the end of the line and may contain a '#'.
  static bool endsInName(std::string_view statement) {
    const std::string_view keyword = Words(statement).next();
    return keyword == "g" || keyword == "o" || keyword == "usemtl" || keyword == "mtllib";
  }

  static bool hasComment(std::string_view line) {
    Words words(line);
    for (auto word = words.next(); !word.empty(); word = words.next())
      if (word.starts_with('#')) return true;
    return false;
  }

  bool readStatement() {
    Words words(statement_);
    const std::string_view keyword = words.next();
    if (keyword == "v") return readPosition(words);
    if (keyword == "f") return wanted_ == Wanted::target ? ++faceCount > 0 : readFace(words);
    if (wanted_ == Wanted::target) return true;
    if (keyword == "vt") return readTexcoord(words);
    if (keyword == "g") {
      hasGroups_ = true;
      group_ = groups_(words.rest());
    } else if (keyword == "o" && !hasGroups_) {
      group_ = groups_(words.rest());
    } else if (keyword == "usemtl") {
      material_ = materials_(words.rest());
    } else if (keyword == "mtllib") {
      for (auto file = words.next(); !file.empty(); file = words.next()) materialFiles_(file);
    }
    return true;
  }

  /// The next word of the statement; empty at its end or at a comment.
  static std::string_view nextValue(Words& words) {
    const std::string_view word = words.next();
    return word.starts_with('#') ? std::string_view{} : word;
  }

  bool readCoordinate(std::string_view word, double& coordinate) {
    const auto value = toNumber<double>(word);
    if (!value) return fail(fmt::format("{} is not a number or beyond range", inQuotes(word)));
    if (!isSingle(*value))
      return fail(fmt::format("the coordinate {} is not finite or too large", inQuotes(word)));
    coordinate = *value;
    return true;
  }

  bool readPosition(Words& words) {
    Vec3 position;
    int count = 0;
    for (double* coordinate : {&position.x, &position.y, &position.z}) {
      const std::string_view word = nextValue(words);
      if (word.empty())
        return fail(fmt::format("the vertex has {} of the 3 numbers it needs", count));
      if (!readCoordinate(word, *coordinate)) return false;
      ++count;
    }
    // A weight or a colour may follow; anything else is a sign of a damaged line.
    for (auto word = nextValue(words); !word.empty(); word = nextValue(words))
      if (!toNumber<double>(word)) return fail(fmt::format("{} is not a number", inQuotes(word)));
    mesh.positions.push_back(position);
    return true;
  }

  bool readTexcoord(Words& words) {
    Vec2 texcoord;
    const std::string_view u = nextValue(words), v = nextValue(words);
    if (u.empty()) return fail("the texture coordinate has no numbers");
    if (!readCoordinate(u, texcoord.x)) return false;
    if (!v.empty() && !readCoordinate(v, texcoord.y)) return false;
    mesh.polygons.texcoords.push_back(texcoord);
    return true;
  }

  bool readFace(Words& words) {
    Polygons& polygons = mesh.polygons;
    for (auto word = nextValue(words); !word.empty(); word = nextValue(words))
      if (!readCorner(word)) return false;
    const std::size_t size = polygons.corners.size() - polygons.faceStart.back();
    if (size < 3) return fail(fmt::format("the face has {} of the 3 corners it needs", size));
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
    polygons.faceGroup.push_back(group_);
    polygons.faceMaterial.push_back(material_);
    ++faceCount;
    return true;
  }

  /// v, v/vt, v//vn or v/vt/vn
  bool readCorner(std::string_view word) {
    const char* at = word.data();
    const char* const end = at + word.size();
    const auto skipSlash = [&] { return at != end && *at == '/' && ++at != end && *at != '/'; };
    Index vertex = -1, texcoord = -1;
    std::int64_t normal = 0;
    bool fine = readIndex(at, end, "vertex", mesh.positions.size(), vertexReach_, vertex);
    if (fine && skipSlash())
      fine = readIndex(at, end, "texture coordinate", mesh.polygons.texcoords.size(),
                       texcoordReach_, texcoord);
    if (fine && skipSlash()) at = std::from_chars(at, end, normal).ptr;
    if (!fine || at != end) {
      if (error_.empty())
        fail(fmt::format("the face corner {} is not v, v/vt, v//vn or v/vt/vn", inQuotes(word)));
      return false;
    }
    mesh.polygons.corners.push_back(vertex);
    mesh.polygons.cornerTexcoords.push_back(texcoord);
    return true;
  }

  /// An index that counts from 1, or from -1 backwards through what came before the face.
  bool readIndex(const char*& at, const char* end, std::string_view what, std::size_t count,
                 Reach& reach, Index& index) {
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error == std::errc::invalid_argument) return false;
    const std::string_view digits(at, stop);
    at = stop;
    if (number < 0) number += static_cast<std::int64_t>(count) + 1;
    if (error != std::errc{} || number <= 0 || number > std::numeric_limits<Index>::max())
      return fail(fmt::format("the face refers to {} {}, and there is none of that number", what,
                              inQuotes(digits)));
    if (number > reach.furthest) reach = {number, statementLine_};
    index = static_cast<Index>(number - 1);
    return true;
  }

  bool checkReach(const Reach& reach, std::string_view what, std::size_t count) {
    if (reach.furthest <= static_cast<std::int64_t>(count)) return true;
    return failLine(reach.line,
                    fmt::format("the face refers to {} {} of {}", what, reach.furthest, count));
  }

  bool checkWhole() {
    Polygons& polygons = mesh.polygons;
    if (mesh.positions.empty())
      return failFile("has no vertices ('v' statements); check that it is a Wavefront OBJ file");
    if (wanted_ == Wanted::target) return true;
    if (faceCount == 0)
      return failFile("has no faces ('f' statements); export the mesh with its faces");
    if (!checkReach(vertexReach_, "vertex", mesh.positions.size()) ||
        !checkReach(texcoordReach_, "texture coordinate", polygons.texcoords.size()))
      return false;
    if (texcoordReach_.furthest == 0) {
      polygons.texcoords.clear();
      polygons.cornerTexcoords.clear();
    }
    return true;
  }

  std::string_view name_;
  Wanted wanted_;
  std::string_view text_;
  LineCursor lines_;
  std::string_view statement_;
  std::size_t statementLine_ = 0;
  std::string joined_;
  std::string error_;
  NameIndex groups_{mesh.polygons.groups}, materials_{mesh.polygons.materials},
      materialFiles_{mesh.polygons.materialFiles};
  Index group_ = -1, material_ = -1;
  bool hasGroups_ = false;
  Reach vertexReach_, texcoordReach_;
};

}  // namespace

Result<PolygonMesh> parseObj(std::string_view text, std::string_view name) {
  ObjReader reader(text, name, ObjReader::Wanted::everything);
  if (!reader.read()) return std::unexpected(reader.error());
  return std::move(reader.mesh);
}

Result<io::TargetShape> io::parseObjTarget(std::string_view text, std::string_view name) {
  ObjReader reader(text, name, ObjReader::Wanted::target);
  if (!reader.read()) return std::unexpected(reader.error());
  return TargetShape{std::move(reader.mesh.positions), reader.faceCount};
}

}  // namespace sweepface
