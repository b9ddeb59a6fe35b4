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
  std::vector<std::string> compare, laws, boxes;
  FollowingArguments following;
  int lod = 0, frames = 5;
  bool quiet = false;
};

void addOptions(CLI::App& app, RenderArguments& a);

/// What there is to draw.
struct Rendering {
  const RenderArguments& arguments;
  const Rig& rig;  ///< with what follows from others among its targets
  const Following& following;
  Style style;
  std::vector<View> views;
  std::vector<Vec3> straight;  ///< the plain blend, for such styles as have need of it
};

inline bool isHeat(Style style) { return style == Style::error || style == Style::angle; }

/// Where a face has the vertices of its source.
std::vector<Vec3> sourceVertices(const Rig& rig, const Weights& weights);

/// One expression, or it beside what it is compared with, from all sides. The weights are those
/// that are set.
Result<Image> drawExpression(const Rendering& what, Weights weights);

/// The way from one expression to another, a row for each law.
Result<Image> drawStrips(const Rendering& what, const Weights& from, const Weights& to);

}  // namespace sweepface::cli
