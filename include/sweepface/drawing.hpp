#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/ode.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Where something stands in a text, counted from 1; line 0 for what was made without a text.
struct TextPlace {
  std::size_t line = 0, column = 0;
};

/// A wireframe as a person draws it: curves between named nodes, patches within them. The text form
/// is docs/wire-format.md; everything here has the names and the meaning it has there.
struct Drawing {
  /// ∂x^i ∂y^j at index 3i + j; missing ones are predicted. Index 0 is the node's own place.
  struct Jet {
    std::string along;  ///< x leaves along this curve; "-name" where the curve arrives
    std::array<std::optional<Vec3>, 9> vectors;
  };
  struct Node {
    std::string name;
    std::optional<Vec3> at;  ///< missing where the node stands on the side of a patch
    std::string with;        ///< the node at whose point it stands, if not at its own
    std::vector<Jet> jets;   ///< one, or one a fan between creases; none: found from the curves
    TextPlace place;
  };
  struct Curve {
    std::string name, from, to;
    std::vector<Vec3> points;  ///< between the ends
    Index edges = 0;           ///< 0: as the patches beside it require
    std::string ribbon;        ///< empty: that of the patches beside it, else one of its own
    bool collapsed = false;    ///< all of it is one point
    TextPlace place;
  };
  /// The two control curves of a boundary curve in one of its patches: as many points each as the
  /// boundary has, its ends included.
  struct Control {
    std::string beside, in;
    std::vector<Vec3> second, third;
    std::optional<ControlSpacing> spacing;  ///< missing: from the mean chords
    TextPlace place;
  };
  struct Patch {
    std::string name;
    std::vector<std::vector<std::string>> sides;  ///< four chains of curves; "-name" backwards
    std::string material;                         ///< of the source's faces; empty: none
    TextPlace place;
  };
  struct Ribbon {
    std::string name;
    Shape shape;
    TextPlace place;
  };
  struct Crease {
    std::string curve;
    TextPlace place;
  };
  /// What an expression adds to a node or to a curve with its ends.
  struct Move {
    std::string name;
    Vec3 by;
    /// Of a node with jets, in their order: derivatives by index as in Jet.
    std::vector<std::vector<std::pair<int, Vec3>>> jets;
    std::vector<Vec3> points;  ///< of a curve: one for each of its points, on top
    TextPlace place;
  };
  struct Expression {
    std::string name;
    std::vector<Move> moves;
    TextPlace place;
  };

  std::string source;  ///< what messages call the text
  std::string units;
  double tolerance = 0;  ///< how far curves may pass from their points; 0: not given
  std::vector<Node> nodes;
  std::vector<Curve> curves;
  std::vector<Control> controls;
  std::vector<Patch> patches;
  std::vector<Ribbon> ribbons;
  std::vector<Crease> creases;
  std::vector<Expression> expressions;
};

/// Reads a text in the format of docs/wire-format.md; `name` is what messages call it. Whatever the
/// text, the result is a drawing or one sentence with the line and column of what is wrong.
Result<Drawing> parseDrawing(std::string_view text, std::string_view name);
/// The text of a drawing. Its numbers read back as exactly the same doubles.
std::string formatDrawing(const Drawing& drawing);

/// A model made from a drawing.
struct Built {
  Rig rig;
  double largestMiss = 0;  ///< how far a curve passes from the points it is drawn by, in any pose
  std::string missed;      ///< the curve that does, e.g. "curve 'rim'", or empty
  double diagonal = 0;     ///< of the box around the drawing's nodes and the points of its curves
  std::string missedIn;    ///< the expression that misses most of it, or empty for the neutral
};

/// Makes the model. Its source mesh is the surface's own grid: every curve cut into its edges.
Result<Built> build(const Drawing& drawing);
/// Gives a model the source mesh of another over the same wireframe, so that its vertices come in
/// the order of the mesh which that one was converted from. Faces take the material that build()
/// gave their patch. Fails if the wireframes differ, or if there are such materials and it is
/// unknown which faces lie on which patch.
Result<void> adoptSource(Rig& rig, const Rig& like);

/// The drawing of a model: every stored vector in the jet of a node, every target that is decoded
/// as an expression. build() makes the same model from it.
Drawing draw(const Rig& rig);

}  // namespace sweepface
