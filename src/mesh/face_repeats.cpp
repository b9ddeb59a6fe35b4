#include "mesh/face_repeats.hpp"

#include <algorithm>
#include <set>

namespace sweepface {

std::vector<FaceRepeat> faceRepeats(const Polygons& faces) {
  const auto fromSmallest = [](std::vector<Index> around) {
    std::ranges::rotate(around, std::ranges::min_element(around));
    return around;
  };
  std::set<std::vector<Index>> known;
  std::vector<FaceRepeat> repeats;
  for (Index f = 0; f < faces.faceCount(); ++f) {
    std::vector<Index> around(faces.corners.begin() + faces.faceStart[f],
                              faces.corners.begin() + faces.faceStart[f + 1]);
    // Looked up first, as a face that runs to a point and back would be its own back.
    const bool isBack = known.contains(fromSmallest({around.rbegin(), around.rend()}));
    const bool isNew = known.insert(fromSmallest(std::move(around))).second;
    repeats.push_back(!isNew ? FaceRepeat::again : isBack ? FaceRepeat::back : FaceRepeat::alone);
  }
  return repeats;
}

std::string warningOfCopies(const std::vector<FaceRepeat>& repeats) {
  const auto copies = static_cast<Index>(std::ranges::count(repeats, FaceRepeat::again));
  if (copies == 0) return {};
  return plural(
      copies, "face has the corners of another one and no surface of its own; leave it out.",
      "faces have the corners of another one and no surface of their own; leave them out.");
}

std::string plural(Index count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace sweepface
