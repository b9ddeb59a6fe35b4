#pragma once

#include <span>
#include <vector>

#include "sweepface/ode.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

// Edits of a model. Each returns the patches that may have changed, ascending; all other patches
// evaluate to the same bits as before, in every pose. If an edit fails, the rig is unchanged. A rig
// whose targets are not decoded yet is refused.
using Patches = std::vector<Index>;

/// Gives a ribbon other shape parameters. Fails near a resonance (docs/mathematics.md).
Result<Patches> setShape(Rig& rig, Index ribbon, const Shape& shape);

struct NodeMove {
  Index node = -1;
  Vec3 by;
};
/// Moves nodes of the neutral, or what a target adds to them; nodes at one point move it once.
/// Stored derivatives stay, predicted ones follow. A T-node goes with the curve it stands on and
/// cannot be moved itself.
Result<Patches> moveNodes(Rig& rig, std::span<const NodeMove> moves, Index target = -1);

/// The nodes with which a curve moves: its ends, or those of the straight run that it is a piece
/// of.
Result<std::vector<Index>> endsOf(const Rig& rig, Index curve);

/// Where the control curves that an edit moves stand, as shares of the patch's length across.
inline constexpr ControlSpacing kControlSpacing{0.1, 0.25};

/// The two control curves of a boundary curve in one of its patches, and how far each moves.
struct ControlMove {
  Index curve = -1, patch = -1;
  Vec3 second, third;
};
/// Moves control curves; the derivatives across the boundary follow, in every patch that shares
/// them. The nodes at the ends store their whole jets from then on. At the tip of a triangle a
/// control curve has no room and stays; towards an irregular node, where patches share few vectors,
/// the curves move as closely to what is asked as they can, in the least-squares sense.
Result<Patches> moveControls(Rig& rig, const ControlMove& move, Index target = -1);

}  // namespace sweepface
