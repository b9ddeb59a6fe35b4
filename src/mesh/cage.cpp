#include "mesh/cage.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/face_edges.hpp"
#include "mesh/face_repeats.hpp"

namespace sweepface {
namespace {

class CageMaker {
 public:
  explicit CageMaker(const MeshRig& rig)
      : faces_(rig.neutral.polygons),
        count_(static_cast<Index>(rig.neutral.positions.size())),
        repeats_(faceRepeats(faces_)),
        edges_(faceEdges(rig, repeats_)) {
    numberVertices();
    Index without = 0;
    for (Index f = 0; f < faces_.faceCount(); ++f) {
      if (repeats_[f] == FaceRepeat::again) continue;
      if (const auto corners = differentCorners(edges_, faces_, f); corners.size() > 2)
        addFace(f, corners);
      else
        ++without;
    }
    if (without > 0)
      cage.warnings.push_back(plural(without, "face has", "faces have") +
                              " fewer than three different corners and no surface to subdivide.");
    if (std::string sentence = warningOfCopies(repeats_); !sentence.empty())
      cage.warnings.push_back(std::move(sentence));
  }

  Cage cage;

 private:
  /// Loose vertices stay; of those in faces, the welded ones.
  void numberVertices() {
    std::vector<char> isKept(2 * static_cast<std::size_t>(count_), 0);
    std::fill_n(isKept.begin(), count_, 1);
    for (const Index v : faces_.corners) isKept[v] = 0;
    for (const Index v : edges_.vertex) isKept[v] = 1;
    number_.assign(isKept.size(), -1);
    for (Index v = 0; v < std::ssize(isKept); ++v)
      if (isKept[v]) {
        number_[v] = static_cast<Index>(cage.vertices.size());
        cage.vertices.push_back(v % count_);
      }
  }

  void addFace(Index f, const std::vector<Index>& corners) {
    cage.faces.push_back(f);
    cage.sizes.push_back(static_cast<Index>(corners.size()));
    for (const Index c : corners) cage.corners.push_back(number_[edges_.vertex[c]]);
    if (faces_.texcoords.empty() || faces_.cornerTexcoords.empty()) return;
    const bool isTextured =
        std::ranges::all_of(corners, [&](Index c) { return faces_.cornerTexcoords[c] >= 0; });
    cage.isTextured.push_back(isTextured);
    for (const Index c : corners) cage.cornerTexcoords.push_back(texcoordOf(c, isTextured));
  }

  /// Corners of faces without texture coordinates share some of their own, so that those of others
  /// end there.
  Index texcoordOf(Index corner, bool isTextured) {
    const Vec2 place = isTextured ? faces_.texcoords[faces_.cornerTexcoords[corner]] : Vec2{};
    const auto [known, isNew] =
        texcoords_.try_emplace({edges_.vertex[corner], isTextured, place.x, place.y},
                               static_cast<Index>(cage.texcoords.size()));
    if (isNew) cage.texcoords.push_back(place);
    return known->second;
  }

  const Polygons& faces_;
  const Index count_;
  const std::vector<FaceRepeat> repeats_;
  const FaceEdges edges_;
  std::vector<Index> number_;  // [2 × vertices] in the cage, or -1
  std::map<std::tuple<Index, bool, double, double>, Index> texcoords_;
};

}  // namespace

Cage cageOf(const MeshRig& rig) { return std::move(CageMaker(rig).cage); }

}  // namespace sweepface
