#pragma once

#include <map>
#include <string>
#include <string_view>

#include "sweepface/drawing.hpp"

#include "drawing/bend.hpp"

namespace sweepface::drawing {

/// An error message about a place in a drawing.
std::unexpected<Error> failAt(const Drawing& drawing, const TextPlace& place,
                              const std::string& what);
/// A patch as messages call it, by its name or number: "patch 'p3'".
std::string quotedPatch(const Drawing& drawing, Index patch);
/// An error message of the surface, which numbers nodes, arcs, patches and ribbons, with the
/// numbers replaced by names and the place of the first of them.
std::unexpected<Error> failNamed(const Drawing& drawing, const Wireframe& wireframe,
                                 const std::string& message);

/// A drawing with its names resolved to indices.
struct Woven {
  Wireframe wireframe;  ///< nodes store their position only
  Connectivity connectivity;
  std::map<std::string, Index, std::less<>> nodes, curves, patches, ribbons;

  /// A curve by its name, backwards if a '-' precedes it; -1 if there is none.
  HalfArc halfArc(std::string_view reference) const;
  /// The drawn position of a node, its own or that of the node it is with; none for a T-node
  /// without one.
  std::optional<Vec3> placeOf(const Drawing& drawing, Index node) const;
  /// The length of a curve by its chords; 0 if it is not known.
  double lengthOf(const Drawing& drawing, Index curve) const;
};

/// The diagonal of the box round everything that is drawn.
double diagonalOf(const Drawing& drawing);

/// Looks up all names and checks that the curves meet and the patches have four sides.
Result<Woven> weave(const Drawing& drawing);

/// Gives every curve without a number of edges the number that its patches require, or else one in
/// proportion to its length: kUsualEdges for a curve of mean length if no curve gives a number.
Result<void> chooseEdges(const Drawing& drawing, Woven& woven);
inline constexpr double kUsualEdges = 8;
/// Most quads of all patches together.
inline constexpr std::int64_t kMostQuads = 1'000'000;

/// Gives every curve its ribbon: the one it names, else that of the curves with which it must share
/// shape parameters, else a new one for all of those.
Result<void> chooseRibbons(const Drawing& drawing, Woven& woven);

/// The sizes of all patches, by the chords of their sides.
std::vector<PatchSize> patchSizes(const Drawing& drawing, const Woven& woven);

}  // namespace sweepface::drawing
