#include "sweepface/strip.hpp"

#include <algorithm>
#include <numeric>
#include <ranges>
#include <utility>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"

#include "rig/number.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {

namespace {

// Where a face goes and which of its corners comes first, both given by the first of its quads.
struct Place {
  std::size_t quad = SIZE_MAX;
  Index face = 0, first = 0;
};

std::vector<Place> placesOf(const SourceMesh& source) {
  const Polygons& faces = source.polygons;
  std::vector<Place> places(faces.faceCount());
  for (Index f = 0; f < faces.faceCount(); ++f) places[f].face = f;
  const std::vector<Index> faceOf = facesOfCorners(faces);
  for (std::size_t q = 0; 4 * q + 3 < source.quadCorners.size(); ++q) {
    const Index corner = source.quadCorners[4 * q];
    Place& place = places[faceOf[corner]];
    if (place.quad == SIZE_MAX) place = {q, place.face, corner - faces.faceStart[faceOf[corner]]};
  }
  std::ranges::sort(places, {}, [](const Place& p) { return std::pair(p.quad, p.face); });
  // A face without a quad has no surface, unless the rig does not know the quads of any face.
  if (!source.quadCorners.empty())
    std::erase_if(places, [](const Place& p) { return p.quad == SIZE_MAX; });
  return places;
}

void reorderFaces(SourceMesh& source, const std::vector<Place>& places) {
  const Polygons old = source.polygons;
  Polygons& faces = source.polygons;
  std::vector<Index> newCorner(old.corners.size());
  // The tips of spikes, where a face turns back upon itself, are on no patch.
  std::vector<char> isOnPatch(old.corners.size(), source.quadCorners.empty());
  for (const Index corner : source.quadCorners) isOnPatch[corner] = 1;
  faces.faceStart = {0};
  faces.corners.clear();
  faces.cornerTexcoords.clear();
  std::size_t place = 0;
  for (const Place& p : places) {
    const Index size = old.faceSize(p.face);
    for (Index k = 0; k < size; ++k) {
      const Index corner = old.faceStart[p.face] + (p.first + k) % size;
      if (!isOnPatch[corner]) continue;
      newCorner[corner] = static_cast<Index>(faces.corners.size());
      faces.corners.push_back(source.gridVertex[old.corners[corner]]);
      if (!old.cornerTexcoords.empty())
        faces.cornerTexcoords.push_back(old.cornerTexcoords[corner]);
    }
    faces.faceStart.push_back(static_cast<Index>(faces.corners.size()));
    if (!old.faceMaterial.empty()) faces.faceMaterial[place] = old.faceMaterial[p.face];
    if (!old.faceGroup.empty()) faces.faceGroup[place] = old.faceGroup[p.face];
    ++place;
  }
  if (!old.faceMaterial.empty()) faces.faceMaterial.resize(place);
  if (!old.faceGroup.empty()) faces.faceGroup.resize(place);
  for (Index& corner : source.quadCorners) corner = newCorner[corner];
}

// Puts texture coordinates in the order in which corners use them and drops unused ones.
void reorderTexcoords(Polygons& faces) {
  std::vector<Index> number(faces.texcoords.size(), -1);
  std::vector<Vec2> texcoords;
  for (Index& t : faces.cornerTexcoords) {
    if (t < 0) continue;
    if (number[t] < 0) {
      number[t] = static_cast<Index>(texcoords.size());
      texcoords.push_back(faces.texcoords[t]);
    }
    t = number[t];
  }
  faces.texcoords = std::move(texcoords);
}

Result<void> stripOrder(Rig& rig) {
  SourceMesh& source = rig.source;
  const auto isLoose = [&](Index vertex) { return source.gridVertex[vertex] < 0; };
  if (source.quadCorners.empty() && std::ranges::any_of(source.polygons.corners, isLoose))
    return fail("a face has a corner that is on no patch; keep the order");
  reorderFaces(source, placesOf(source));
  reorderTexcoords(source.polygons);
  if (!source.gridVertex.empty()) {
    source.gridVertex.resize(Tessellation(rig.surface, 1).vertexCount());
    std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
  }
  source.ownOrder = false;
  source.loose.clear();
  for (Target& target : rig.targets) target.looseDifference.clear();
  rig.scene.clear();  // its indices, textures and joints depend on the order
  return {};
}

}  // namespace

Result<Strip> parseStrip(std::string_view text) {
  Strip parts;
  for (const auto word : text | std::views::split(',')) {
    const std::string_view name = trimmed({word.begin(), word.end()});
    if (name == "order")
      parts.order = true;
    else if (name == "uv")
      parts.uv = true;
    else if (name == "groups")
      parts.groups = true;
    else if (name == "scene")
      parts.scene = true;
    else
      return fail("There is no part '" + std::string(name) +
                  "' to leave out; name some of order, uv, groups and scene, with commas between.");
  }
  return parts;
}

Result<void> strip(Rig& rig, const Strip& parts) {
  Polygons& faces = rig.source.polygons;
  if (parts.uv) {
    faces.texcoords.clear();
    faces.cornerTexcoords.clear();
  }
  if (parts.groups) {
    faces.materials.clear();
    faces.faceMaterial.clear();
    faces.groups.clear();
    faces.faceGroup.clear();
    faces.materialFiles.clear();
  }
  if (parts.scene) rig.scene.clear();
  return parts.order ? stripOrder(rig) : Result<void>{};
}

std::size_t bareBytes(Rig rig) {
  return strip(rig, {.order = true, .uv = true}) ? encode(rig).size() : 0;
}

}  // namespace sweepface
