// A drawing in the making: one half is drawn, the other is its mirror image.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/drawing.hpp"

namespace sample {

using sweepface::Drawing;
using sweepface::Index;
using sweepface::normalized;
using sweepface::Vec2;
using sweepface::Vec3;

inline Vec3 mirrored(const Vec3& p) { return {-p.x, p.y, p.z}; }
/// Rounded to a ten-thousandth, which keeps the text short.
inline Vec3 rounded(const Vec3& p) {
  const auto round = [](double x) { return std::round(x * 1e4) / 1e4 + 0.0; };
  return {round(p.x), round(p.y), round(p.z)};
}
inline Vec3 between(const Vec3& a, const Vec3& b, double t) { return a + t * (b - a); }

enum class Part { head, lid, ball, lips, bag, upperTeeth, lowerTeeth, nostril, ear, neck };

/// Where a node belongs: which ring of its part, which place on it. Expressions depend on this.
struct Mark {
  Part part;
  int ring, place;
  bool after = false;  ///< half-way to the next place
};

/// A node of the left half, or of the middle.
struct Spot {
  Vec3 at;
  Mark mark;
};

/// A row or ring of spots, by their indices.
using Line = std::vector<Index>;

class Sketch {
 public:
  Index add(const Vec3& at, Mark mark, std::string name) {
    spots_.push_back({rounded(at), mark});
    names_.push_back(std::move(name));
    return static_cast<Index>(spots_.size()) - 1;
  }

  /// Makes the curve between two spots pass through a point.
  void pass(Index from, Index to, const Vec3& point, Mark mark) {
    passes_[std::minmax(from, to)] = {rounded(point), mark};
  }
  const std::map<std::pair<Index, Index>, Spot>& passes() const { return passes_; }

  const Spot& spot(Index i) const { return spots_[i]; }
  const std::vector<Spot>& spots() const { return spots_; }
  bool inMiddle(Index i) const { return spots_[i].at.x == 0; }

  /// The name of a spot's node on the left (side 1) or on the right (side -1).
  std::string nodeName(Index i, int side) const {
    return inMiddle(i) ? names_[i] : (side > 0 ? "left " : "right ") + names_[i];
  }

  /// The name of the curve between two spots, of which `from` was drawn first.
  std::string curveName(Index from, Index to, int side) const {
    return nodeName(from, side) + " - " + nodeName(to, side);
  }

  /// Adds a patch and its mirror image; corners are counter-clockwise as seen from outside.
  void patch(Index a, Index b, Index c, Index d, std::string_view material) {
    patches_.push_back({{a, b, c, d}, std::string(material)});
  }
  /// Adds patches between two lines; seen from outside, `upper` is to the left of the direction of
  /// `lower`.
  void strip(const Line& lower, const Line& upper, std::string_view material) {
    for (std::size_t k = 0; k + 1 < lower.size(); ++k)
      patch(lower[k], lower[k + 1], upper[k + 1], upper[k], material);
  }
  /// Adds patches between rings that run clockwise, seen from outside.
  void ring(const Line& outer, const Line& inner, std::string_view material, bool closed = true) {
    const std::size_t count = outer.size();
    for (std::size_t k = 0; k + (closed ? 0 : 1) < count; ++k) {
      const std::size_t next = (k + 1) % count;
      patch(outer[next], outer[k], inner[k], inner[next], material);
    }
  }

  /// Both halves as a drawing. Edges are `edge` long.
  Drawing drawing(double edge) const {
    Drawing d;
    d.source = "the sample face";
    d.units = "cm";
    for (Index i = 0; i < static_cast<Index>(spots_.size()); ++i)
      for (const int side : {1, -1})
        if (side > 0 || !inMiddle(i)) {
          Drawing::Node node;
          node.name = nodeName(i, side);
          node.at = side > 0 ? spots_[i].at : mirrored(spots_[i].at);
          d.nodes.push_back(std::move(node));
        }
    for (const int side : {1, -1})
      for (const Corners& p : patches_) addPatch(d, p, side);
    setEdges(d, edge);
    return d;
  }

 private:
  struct Corners {
    std::array<Index, 4> spots;
    std::string material;
  };

  void addPatch(Drawing& d, const Corners& p, int side) const {
    Drawing::Patch patch;
    for (int k = 0; k < 4; ++k) {
      // The mirror image goes round the other way.
      const Index a = p.spots[side > 0 ? k : (4 - k) % 4];
      const Index b = p.spots[side > 0 ? (k + 1) % 4 : 3 - k];
      patch.sides.push_back({curve(d, a, b, side)});
    }
    patch.material = p.material;
    d.patches.push_back(std::move(patch));
  }

  // Refers to the curve between two nodes, perhaps backwards; adds it when it is first needed.
  std::string curve(Drawing& d, Index a, Index b, int side) const {
    const auto [from, to] = std::pair{std::min(a, b), std::max(a, b)};
    const std::string name = curveName(from, to, side);
    if (std::ranges::find(d.curves, name, &Drawing::Curve::name) == d.curves.end()) {
      Drawing::Curve curve;
      curve.name = name, curve.from = nodeName(from, side), curve.to = nodeName(to, side);
      if (const auto pass = passes_.find({from, to}); pass != passes_.end())
        curve.points.push_back(side > 0 ? pass->second.at : mirrored(pass->second.at));
      d.curves.push_back(std::move(curve));
    }
    return a < b ? name : "-" + name;
  }

  // Only the longest curve says how many edges it has; the others follow from it.
  static void setEdges(Drawing& d, double edge) {
    std::map<std::string_view, Vec3> places;
    for (const Drawing::Node& node : d.nodes) places[node.name] = *node.at;
    const auto length = [&](const Drawing::Curve& c) {
      return norm(places[c.to] - places[c.from]);
    };
    const auto longest = std::ranges::max_element(d.curves, {}, length);
    longest->edges = static_cast<Index>(std::lround(length(*longest) / edge));
  }

  std::vector<Spot> spots_;
  std::vector<std::string> names_;
  std::vector<Corners> patches_;
  std::map<std::pair<Index, Index>, Spot> passes_;
};

}  // namespace sample
