#include <array>
#include <charconv>

#include "sweepface/io.hpp"

#include "io/text.hpp"

namespace sweepface {
namespace {

void append(std::string& text, auto number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

void appendNumbers(std::string& text, std::string_view keyword,
                   std::initializer_list<double> numbers) {
  text += keyword;
  for (const double number : numbers) append(text += ' ', number);
  text += '\n';
}

/// A name as the rest of a line; what would end or continue the line becomes '_'.
std::string lineName(std::string_view name) {
  std::string text(io::trimmed(name));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  if (text.ends_with('\\')) text.back() = '_';
  return text;
}

/// Writes which name holds from here on, if it is not the current one.
void appendSwitch(std::string& text, std::string_view keyword,
                  const std::vector<std::string>& names, Index name, Index& current) {
  if (name == current) return;
  current = name;
  text += keyword;
  if (name >= 0) text += " " + lineName(names[name]);
  text += '\n';
}

void appendCorner(std::string& text, Index vertex, Index texcoord, bool hasNormals) {
  append(text += ' ', vertex + 1);
  if (texcoord >= 0) append(text += '/', texcoord + 1);
  if (!hasNormals) return;
  append(text += texcoord >= 0 ? "/" : "//", vertex + 1);
}

void appendFaces(std::string& text, const Polygons& polygons, bool hasNormals) {
  Index group = -1, material = -1;
  for (Index face = 0; face < polygons.faceCount(); ++face) {
    if (!polygons.faceGroup.empty())
      appendSwitch(text, "g", polygons.groups, polygons.faceGroup[face], group);
    if (!polygons.faceMaterial.empty())
      appendSwitch(text, "usemtl", polygons.materials, polygons.faceMaterial[face], material);
    text += 'f';
    for (Index c = polygons.faceStart[face]; c < polygons.faceStart[face + 1]; ++c)
      appendCorner(text, polygons.corners[c],
                   polygons.cornerTexcoords.empty() ? -1 : polygons.cornerTexcoords[c], hasNormals);
    text += '\n';
  }
}

}  // namespace

std::string formatObj(const ObjOutput& output) {
  const Polygons& polygons = output.polygons;
  std::string text;
  text.reserve(60 * (output.positions.size() + output.normals.size()) +
               30 * polygons.texcoords.size() + 18 * polygons.corners.size());
  if (!polygons.materialFiles.empty()) {
    text += "mtllib";
    for (const std::string& file : polygons.materialFiles) text += " " + lineName(file);
    text += '\n';
  }
  for (const Vec3& p : output.positions) appendNumbers(text, "v", {p.x, p.y, p.z});
  for (const Vec2& t : polygons.texcoords) appendNumbers(text, "vt", {t.x, t.y});
  for (const Vec3& n : output.normals) appendNumbers(text, "vn", {n.x, n.y, n.z});
  appendFaces(text, polygons, !output.normals.empty());
  return text;
}

}  // namespace sweepface
