#pragma once

#include <map>
#include <string>
#include <string_view>

#include "sweepface/drawing.hpp"

#include "drawing/bend.hpp"

namespace sweepface::drawing {

/// A sentence about a place in a drawing.
std::unexpected<Error> failAt(const Drawing& drawing, const TextPlace& place,
                              const std::string& what);
/// A patch in a sentence, by its name or number: "patch 'p3'".
std::string quotedPatch(const Drawing& drawing, Index patch);
/// A sentence of the surface's own, which counts nodes, arcs, patches and ribbons, with their names
/// and the place of the first of them.
std::unexpected<Error> failNamed(const Drawing& drawing, const Wireframe& wireframe,
                                 const std::string& message);

/// A drawing whose names have become indices.
struct Woven {
  Wireframe wireframe;  ///< nodes store their position only
  Connectivity connectivity;
  std::map<std::string, Index, std::less<>> nodes, curves, patches, ribbons;

  /// A curve by its name, from its end where a '-' stands before it; -1 if there is none.
  HalfArc halfArc(std::string_view reference) const;
  /// Where a node is drawn: at its own place or with another; nothing for a T-node without one.
  std::optional<Vec3> placeOf(const Drawing& drawing, Index node) const;
  /// The length of a curve by its chords; 0 where it is not known.
  double lengthOf(const Drawing& drawing, Index curve) const;
};

/// The diagonal of the box round everything that is drawn.
double diagonalOf(const Drawing& drawing);

/// Looks up all names and checks that the curves meet and the patches have four sides.
Result<Woven> weave(const Drawing& drawing);

/// Gives every curve whose number of edges is not said the one that its patches require; else one
/// in proportion to its length, kUsualEdges for a curve of mean length where no curve says any.
Result<void> chooseEdges(const Drawing& drawing, Woven& woven);
inline constexpr double kUsualEdges = 8;
/// Quads that the patches may have together.
inline constexpr std::int64_t kMostQuads = 1'000'000;

/// Gives every curve its ribbon: the one it names, else that of the curves beside which it sweeps,
/// else one of their own.
Result<void> chooseRibbons(const Drawing& drawing, Woven& woven);

/// The sizes of all patches, by the chords of their sides.
std::vector<PatchSize> patchSizes(const Drawing& drawing, const Woven& woven);

}  // namespace sweepface::drawing
