#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sweepface/picture.hpp"

#include "following.hpp"

namespace sweepface::cli {

struct RenderArguments {
  std::string face, output, weights, views = "front", style = "shaded", size, from, close;
  std::optional<std::string> to;
  std::vector<std::string> compare, laws, boxes, chosen;
  FollowingArguments following;
  int lod = 0, frames = 5, subdivisions = 0;
  bool quiet = false;
};

void addOptions(CLI::App& app, RenderArguments& a);

/// What to draw.
struct Rendering {
  const RenderArguments& arguments;
  const Rig& rig;  ///< its targets include those that follow others
  const Following& following;
  Style style;
  std::vector<View> views;
  std::vector<Vec3> straight;  ///< the plain blend, for styles that need it
};

inline bool isHeat(Style style) { return style == Style::error || style == Style::angle; }

/// The positions of the source's vertices on the face.
std::vector<Vec3> sourceVertices(const Rig& rig, const Weights& weights);

/// Draws one expression, alone or beside what it is compared with, from all views. The weights are
/// those that are set.
Result<Image> drawExpression(const Rendering& what, Weights weights);

/// Draws the way from one expression to another, one row per law.
Result<Image> drawStrips(const Rendering& what, const Weights& from, const Weights& to);

}  // namespace sweepface::cli
