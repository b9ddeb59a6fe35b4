#include "picture/styles.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "picture/colour.hpp"

namespace sweepface {
namespace {

constexpr std::array<std::pair<std::string_view, Style>, styles.size()> kStyleNames{{
    {"shaded", Style::shaded},
    {"patches", Style::patches},
    {"wireframe", Style::wireframe},
    {"joins", Style::joins},
    {"error", Style::error},
    {"angle", Style::angle},
    {"normals", Style::normals},
    {"zebra", Style::zebra},
}};

constexpr Colour kBoundaryCurve{0.07f, 0.20f, 0.42f}, kControlCurve{0.90f, 0.45f, 0.20f};

/// By JoinClass.
constexpr std::array<Colour, kJoinClasses> kJoinColours{
    {{0.20f, 0.20f, 0.22f}, {0.10f, 0.42f, 0.66f}, {0.84f, 0.25f, 0.16f}, {0.91f, 0.60f, 0.10f}}};
constexpr std::array<std::string_view, kJoinClasses> kJoinNames{"boundary", "C² join", "spoke",
                                                                "crease"};
// Thin ones first: what is drawn later lies on top.
constexpr std::array kJoinOrder{JoinClass::c2, JoinClass::boundary, JoinClass::spoke,
                                JoinClass::crease};

constexpr Index kPointsPerEdge = 4;

/// Dense networks need finer lines.
double fineness(std::size_t curves) {
  return std::clamp(std::sqrt(900.0 / (static_cast<double>(curves) + 1)), 0.45, 1.0);
}

Stroke strokeOf(const CurveNetwork& net, const Curve& curve, const Colour& colour, double width) {
  Stroke stroke{{}, colour, width};
  for (const Index p : curve.points) stroke.points.push_back(net.points[p]);
  return stroke;
}

/// A colour beyond the palette: hues a golden angle apart.
Colour furtherTint(std::size_t k) {
  const auto wave = [&](double shift) {
    return static_cast<float>(0.75 + 0.15 * std::cos(2.399963 * static_cast<double>(k) + shift));
  };
  return {wave(0), wave(2.1), wave(4.2)};
}

}  // namespace

Result<Style> styleFromName(std::string_view name) {
  std::string all;
  for (const auto& [known, style] : kStyleNames) {
    if (name == known) return style;
    all += (all.empty() ? "" : ", ") + std::string(known);
  }
  return fail(fmt::format("There is no style '{}'; there are {}.", name, all));
}

std::string_view nameOf(Style style) {
  return std::ranges::find(kStyleNames, style, &std::pair<std::string_view, Style>::second)->first;
}

Colour heatColour(double share) {
  // From paper through yellow and red to a dark purple; each step darker than the one before.
  constexpr std::array<Colour, 8> steps{{{0.93f, 0.92f, 0.88f},
                                         {0.99f, 0.89f, 0.60f},
                                         {0.99f, 0.75f, 0.37f},
                                         {0.96f, 0.56f, 0.25f},
                                         {0.88f, 0.36f, 0.23f},
                                         {0.72f, 0.18f, 0.29f},
                                         {0.49f, 0.09f, 0.33f},
                                         {0.24f, 0.05f, 0.26f}}};
  const double at = share > 0 ? std::min(share, 1.0) * (steps.size() - 1) : 0;
  const auto k = std::min(static_cast<std::size_t>(at), steps.size() - 2);
  return mix(steps[k], steps[k + 1], static_cast<float>(at - static_cast<double>(k)));
}

std::vector<Colour> patchTints(const Surface& surface) {
  constexpr std::array<Colour, 8> palette{{{0.56f, 0.74f, 0.86f},
                                           {0.95f, 0.78f, 0.56f},
                                           {0.66f, 0.82f, 0.62f},
                                           {0.93f, 0.65f, 0.62f},
                                           {0.76f, 0.70f, 0.87f},
                                           {0.97f, 0.90f, 0.63f},
                                           {0.60f, 0.82f, 0.80f},
                                           {0.90f, 0.76f, 0.83f}}};
  const auto& patchOf = surface.connectivity().patchOf;
  const Wireframe& w = surface.wireframe();
  std::vector<int> tint(surface.patchCount(), -1), used(palette.size(), 0);
  std::vector<Colour> result;
  for (Index p = 0; p < surface.patchCount(); ++p) {
    std::vector<char> taken(used.size(), 0);
    for (Index k = w.patches[p].sides[0]; k < w.patches[p].sides[4]; ++k)
      if (const Index beside = patchOf[twin(w.loops[k])]; beside >= 0 && tint[beside] >= 0)
        taken[tint[beside]] = 1;
    // The least used tint that no neighbour has.
    int best = -1;
    for (int t = 0; t < static_cast<int>(used.size()); ++t)
      if (!taken[t] && (best < 0 || used[t] < used[best])) best = t;
    if (best < 0) {
      best = static_cast<int>(used.size());
      used.push_back(0);
    }
    tint[p] = best;
    ++used[best];
    const auto k = static_cast<std::size_t>(best);
    result.push_back(k < palette.size() ? palette[k] : furtherTint(k));
  }
  return result;
}

std::vector<Stroke> wireStrokes(const Surface& surface, std::span<const Vec3> vectors) {
  const CurveNetwork net = curveNetwork(surface, vectors, kPointsPerEdge);
  const double fine = fineness(net.boundary.size());
  std::vector<Stroke> strokes;
  for (const Curve& c : net.control) strokes.push_back(strokeOf(net, c, kControlCurve, 1.2 * fine));
  for (const Curve& c : net.boundary) strokes.push_back(strokeOf(net, c, kBoundaryCurve, 2 * fine));
  return strokes;
}

std::vector<Stroke> joinStrokes(const Surface& surface, std::span<const Vec3> vectors) {
  const CurveNetwork net = curveNetwork(surface, vectors, kPointsPerEdge);
  const double fine = fineness(net.boundary.size());
  std::vector<Stroke> strokes;
  for (const JoinClass drawn : kJoinOrder)
    for (const Curve& c : net.boundary)
      if (joinClass(surface, arcOf(c.along)) == drawn)
        strokes.push_back(
            strokeOf(net, c, kJoinColours[static_cast<std::size_t>(drawn)],
                     (drawn == JoinClass::spoke || drawn == JoinClass::crease ? 3 : 2) * fine));
  return strokes;
}

std::vector<Key> wireLegend() {
  return {{kBoundaryCurve, "boundary curves"}, {kControlCurve, "control curves"}};
}

std::vector<Key> joinLegend(const Surface& surface) {
  std::array<int, kJoinClasses> count{};
  const std::vector<Arc>& arcs = surface.wireframe().arcs;
  for (Index arc = 0; arc < static_cast<Index>(arcs.size()); ++arc)
    if (!arcs[arc].collapsed) ++count[static_cast<std::size_t>(joinClass(surface, arc))];
  std::vector<Key> keys;
  for (const JoinClass c : kJoinOrder) {
    const auto k = static_cast<std::size_t>(c);
    if (count[k] > 0)
      keys.push_back({kJoinColours[k], fmt::format("{} ({})", kJoinNames[k], count[k])});
  }
  return keys;
}

}  // namespace sweepface
