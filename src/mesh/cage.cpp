#include "mesh/cage.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/face_repeats.hpp"
#include "mesh/shared_edges.hpp"
#include "mesh/weld.hpp"

namespace sweepface {
namespace {

class CageMaker {
 public:
  explicit CageMaker(const MeshRig& rig)
      : faces_(rig.neutral.polygons),
        count_(static_cast<Index>(rig.neutral.positions.size())),
        repeats_(faceRepeats(faces_)) {
    weldCorners(rig);
    numberVertices();
    Index without = 0;
    for (Index f = 0; f < faces_.faceCount(); ++f) {
      if (repeats_[f] == FaceRepeat::again) continue;
      if (const auto corners = differentCorners(f); corners.size() > 2)
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
  Index next(Index f, Index c) const {
    return c + 1 < faces_.faceStart[f + 1] ? c + 1 : faces_.faceStart[f];
  }

  /// Welds vertices, except at edges that more than two faces would then share. Those of backs are
  /// numbered from `count_` on.
  void weldCorners(const MeshRig& rig) {
    std::vector<Index> twins(faces_.corners.size());
    for (std::vector<Index> first = weld(rig);;) {
      std::vector<EdgeSide> sides;
      vertex_.assign(faces_.corners.size(), -1);
      for (Index f = 0; f < faces_.faceCount(); ++f)
        for (Index c = faces_.faceStart[f]; c < faces_.faceStart[f + 1]; ++c)
          vertex_[c] = first[faces_.corners[c]] + (repeats_[f] == FaceRepeat::back ? count_ : 0);
      for (Index f = 0; f < faces_.faceCount(); ++f) {
        if (repeats_[f] == FaceRepeat::again || differentCorners(f).size() < 3) continue;
        for (Index c = faces_.faceStart[f]; c < faces_.faceStart[f + 1]; ++c)
          if (const Index a = vertex_[c], b = vertex_[next(f, c)]; a != b)
            sides.emplace_back(a, b, c);
      }
      auto cut = pairSides(sides, twins);
      for (auto& [a, b] : cut) a %= count_, b %= count_;
      if (cut.empty() || !takeApart(first, cut)) return;
    }
  }

  /// Loose vertices stay; of those in faces, the welded ones.
  void numberVertices() {
    std::vector<char> isKept(2 * static_cast<std::size_t>(count_), 0);
    std::fill_n(isKept.begin(), count_, 1);
    for (const Index v : faces_.corners) isKept[v] = 0;
    for (const Index v : vertex_) isKept[v] = 1;
    number_.assign(isKept.size(), -1);
    for (Index v = 0; v < std::ssize(isKept); ++v)
      if (isKept[v]) {
        number_[v] = static_cast<Index>(cage.vertices.size());
        cage.vertices.push_back(v % count_);
      }
  }

  /// The corners of a face at another vertex than the one before.
  std::vector<Index> differentCorners(Index f) const {
    std::vector<Index> corners;
    for (Index c = faces_.faceStart[f], before = faces_.faceStart[f + 1] - 1;
         c < faces_.faceStart[f + 1]; before = c++)
      if (vertex_[c] != vertex_[before]) corners.push_back(c);
    return corners;
  }

  void addFace(Index f, const std::vector<Index>& corners) {
    cage.faces.push_back(f);
    cage.sizes.push_back(static_cast<Index>(corners.size()));
    for (const Index c : corners) cage.corners.push_back(number_[vertex_[c]]);
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
    const auto [known, isNew] = texcoords_.try_emplace(
        {vertex_[corner], isTextured, place.x, place.y}, static_cast<Index>(cage.texcoords.size()));
    if (isNew) cage.texcoords.push_back(place);
    return known->second;
  }

  const Polygons& faces_;
  const Index count_;
  const std::vector<FaceRepeat> repeats_;
  std::vector<Index> vertex_;  // [C] welded
  std::vector<Index> number_;  // [2 × vertices] in the cage, or -1
  std::map<std::tuple<Index, bool, double, double>, Index> texcoords_;
};

}  // namespace

Cage cageOf(const MeshRig& rig) { return std::move(CageMaker(rig).cage); }

}  // namespace sweepface
