#pragma once

#include <string>
#include <vector>

#include "sweepface/polygons.hpp"

namespace sweepface {

/// Whether a face goes around the vertices of an earlier one, in the other direction or the same.
enum class FaceRepeat { alone, back, again };

/// [F] That of each face.
std::vector<FaceRepeat> faceRepeats(const Polygons& faces);

/// A warning if faces are there again, which have no surface of their own; else nothing.
std::string warningOfCopies(const std::vector<FaceRepeat>& repeats);

/// "1 face" or "2 faces".
std::string plural(Index count, const char* one, const char* many);

}  // namespace sweepface
