// Shares of nodes by their distance from what a brush names. Distances along the surface are those
// of shortest paths over the curves of the neutral (E. W. Dijkstra, "A note on two problems in
// connexion with graphs", 1959).
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "sweepface/regions.hpp"

#include "rig/shortest_ways.hpp"
#include "rig/source_quads.hpp"
#include "surface/distances.hpp"

namespace sweepface {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Falls from 1 at t = 0 to 0 at t = 1, twice continuously differentiable.
double fading(double t) {
  if (!(t > 0)) return 1;
  return t >= 1 ? 0 : 1 - t * t * t * (t * (6 * t - 15) + 10);
}

std::unexpected<Error> reachesNothing() {
  return fail("The brush reaches no node of the face; give it a larger 'whole' or 'fade'.");
}

class Painter {
 public:
  Painter(const Rig& rig, const Brush& brush)
      : rig_(rig),
        brush_(brush),
        wireframe_(rig.surface.wireframe()),
        vectors_(blend(rig, {})),
        own_(wireframe_.nodes.size(), 0.0),
        distances_(wireframe_.nodes.size(), kFar) {}

  /// [nodes] from what the brush names; infinity for nodes that cannot be reached.
  Result<std::vector<double>> distances() {
    if (!(brush_.whole >= 0 && brush_.fade >= 0) || !std::isfinite(brush_.whole + brush_.fade))
      return fail("The distances of a brush are finite and at least 0.");
    if (brush_.parts.empty() && brush_.points.empty() && brush_.line.empty() &&
        brush_.curves.empty() && brush_.nodes.empty())
      return fail(
          "The brush says nowhere where it is; give it parts, points, a line, curves or nodes.");
    placeNodes();
    if (auto ok = fromParts(); !ok) return std::unexpected(ok.error());
    if (auto ok = fromLines(); !ok) return std::unexpected(ok.error());
    if (brush_.alongSurface) spread();
    return distances_;
  }

  Result<std::vector<double>> paint() {
    if (auto ok = distances(); !ok) return ok;
    for (std::size_t n = 0; n < own_.size(); ++n) {
      const double beyond = distances_[n] - brush_.whole;
      const double share = brush_.fade > 0 ? fading(beyond / brush_.fade) : beyond <= 0 ? 1 : 0;
      own_[n] = std::max(own_[n], share);
    }
    std::set<Index> told;
    for (const auto& [name, share] : brush_.nodes) {
      const Result<Index> node = rig_.find(Thing::node, name);
      if (!node) return std::unexpected(node.error());
      if (!(share >= 0 && share <= 1))
        return fail("The share of node '" + name + "' is not from 0 to 1.");
      if (wireframe_.nodes[*node].point < 0)
        return fail(
            "Node '" + name +
            "' stands on the side of a patch and goes with it; name the nodes at its ends.");
      if (!told.insert(keeperOf(*node)).second)
        return fail("Node '" + name + "', or one at the same point, is told twice; tell it once.");
      for (Index n = 0; n < static_cast<Index>(own_.size()); ++n)
        if (keeperOf(n) == keeperOf(*node)) own_[n] = share;
    }
    if (std::ranges::all_of(own_, [](double share) { return share == 0; })) return reachesNothing();
    return own_;
  }

 private:
  void placeNodes() {
    places_.resize(wireframe_.nodes.size());
    for (Index a = 0; a < static_cast<Index>(wireframe_.arcs.size()); ++a) {
      const Arc& arc = wireframe_.arcs[a];
      places_[arc.from] = rig_.surface.pointOnArc(vectors_, a, 0);
      places_[arc.to] = rig_.surface.pointOnArc(vectors_, a, arc.edges);
    }
  }

  // ---- Parts of the source ----

  Result<void> fromParts() {
    if (brush_.parts.empty()) return {};
    if (!brush_.alongSurface && brush_.whole + brush_.fade > 0)
      return fail(
          "Parts do not reach through space; let them reach along the surface, or paint by "
          "points.");
    const Polygons& polygons = rig_.source.polygons;
    if (!knowsQuads(rig_) || polygons.faceCount() == 0)
      return fail("The face does not tell of its source's materials and groups; paint by points.");
    std::vector<bool> within(polygons.faceCount(), false);
    for (const std::string& part : brush_.parts) {
      const bool isMaterial = mark(part, polygons.materials, polygons.faceMaterial, within);
      const bool isGroup = mark(part, polygons.groups, polygons.faceGroup, within);
      if (!isMaterial && !isGroup)
        return fail("The source has no material or group named '" + part + "'; it has " +
                    listOf(polygons) + ".");
    }
    shareCorners(within);
    return {};
  }

  static bool mark(const std::string& part, const std::vector<std::string>& names,
                   const std::vector<Index>& ofFace, std::vector<bool>& within) {
    const auto found = std::ranges::find(names, part);
    if (found == names.end()) return false;
    const auto number = static_cast<Index>(found - names.begin());
    for (std::size_t f = 0; f < std::min(ofFace.size(), within.size()); ++f)
      if (ofFace[f] == number) within[f] = true;
    return true;
  }

  static std::string listOf(const Polygons& polygons) {
    std::string list;
    for (const auto* names : {&polygons.materials, &polygons.groups})
      for (const std::string& name : *names) list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
  }

  /// A node on the seam belongs to the part in proportion to the quads around it that do.
  void shareCorners(const std::vector<bool>& within) {
    const Surface& surface = rig_.surface;
    const std::vector<Index> faces = faceOfQuads(rig_);
    std::vector<double> inside(own_.size(), 0.0), all(own_.size(), 0.0);
    Index first = 0;
    for (Index p = 0; p < surface.patchCount(); ++p) {
      const Index m = surface.edgesU(p), n = surface.edgesV(p);
      const std::array<Index, 4> quads{0, m - 1, m * n - 1, m * (n - 1)};
      for (int corner = 0; corner < 4; ++corner) {
        const Index quad = first + quads[corner];
        const Index node = keeperOf(surface.connectivity().cornerNode[4 * p + corner]);
        all[node] += 1;
        inside[node] += within[faces[quad]] ? 1 : 0;
      }
      first += m * n;
    }
    for (Index n = 0; n < static_cast<Index>(own_.size()); ++n) {
      const Index keeper = keeperOf(n);
      own_[n] = all[keeper] > 0 ? inside[keeper] / all[keeper] : 0;
      if (own_[n] > 0) distances_[n] = 0;
    }
    // A node only partly inside counts as inside if the brush reaches farther; otherwise it keeps
    // its share.
    for (std::size_t n = 0; n < own_.size(); ++n)
      if (own_[n] < 1 && brush_.fade == 0 && brush_.whole == 0) distances_[n] = kFar;
  }

  /// The first node at the same point; the jet of nodes at one point is stored once.
  Index keeperOf(Index node) {
    if (keepers_.empty()) {
      keepers_.resize(wireframe_.nodes.size());
      std::vector<Index> ofPoint(wireframe_.points, -1);
      for (Index n = 0; n < static_cast<Index>(keepers_.size()); ++n) {
        const Index point = wireframe_.nodes[n].point;
        keepers_[n] = point < 0 ? n : ofPoint[point] < 0 ? ofPoint[point] = n : ofPoint[point];
      }
    }
    return keepers_[node];
  }

  // ---- Points and lines ----

  Result<void> fromLines() {
    for (const auto* list : {&brush_.points, &brush_.line})
      if (!std::ranges::all_of(*list, [](const Vec3& p) { return isFinite(p); }))
        return fail("A point of a brush is not finite.");
    for (const Vec3& p : brush_.points) segments_.push_back({p, p});
    for (std::size_t k = 1; k < brush_.line.size(); ++k)
      segments_.push_back({brush_.line[k - 1], brush_.line[k]});
    if (brush_.line.size() == 1) segments_.push_back({brush_.line[0], brush_.line[0]});
    std::vector<char> isTold(wireframe_.arcs.size(), 0);
    for (const std::string& name : brush_.curves) {
      const Result<Index> arc = rig_.find(Thing::curve, name);
      if (!arc) return std::unexpected(arc.error());
      if (std::exchange(isTold[*arc], 1)) continue;  // once is enough
      const Arc& curve = wireframe_.arcs[*arc];
      if (brush_.alongSurface) distances_[curve.from] = distances_[curve.to] = 0;
      const Index pieces = brush_.alongSurface ? 0 : 4 * curve.edges;
      for (Index k = 0; k < pieces; ++k)
        segments_.push_back({onArc(*arc, k / 4.0), onArc(*arc, (k + 1) / 4.0)});
    }
    brush_.alongSurface ? seed() : measure();
    return {};
  }

  Vec3 onArc(Index arc, double t) const { return rig_.surface.pointOnArc(vectors_, arc, t); }

  void measure() {
    for (std::size_t n = 0; n < places_.size(); ++n)
      for (const auto& [a, b] : segments_)
        distances_[n] = std::min(distances_[n], distanceToSegment(places_[n], a, b));
  }

  /// Finds the nodes nearest to the line, from which paths begin. The line is sampled densely
  /// enough to miss no node on it, but at some thousand points at most.
  void seed() {
    constexpr double kMost = 4096;
    double shortest = kFar;
    for (const Arc& arc : wireframe_.arcs)
      if (const double chord = norm(places_[arc.to] - places_[arc.from]); chord > 0)
        shortest = std::min(shortest, chord);
    const double most = std::max(1.0, kMost / static_cast<double>(segments_.size() + 1));
    for (const auto& [a, b] : segments_) {
      const double pieces = std::min(most, std::ceil(2 * norm(b - a) / shortest));
      for (double k = 0; k <= pieces; ++k) {
        const Vec3 p = pieces == 0 ? a : a + (k / pieces) * (b - a);
        std::size_t nearest = 0;
        for (std::size_t n = 1; n < places_.size(); ++n)
          if (norm(places_[n] - p) < norm(places_[nearest] - p)) nearest = n;
        if (!places_.empty())
          distances_[nearest] =
              std::min(distances_[nearest], distanceToSegment(places_[nearest], a, b));
      }
    }
  }

  // ---- Paths along the surface ----

  double lengthOf(Index arc) const {
    double length = 0;
    for (Index k = 0; k < wireframe_.arcs[arc].edges; ++k)
      length += norm(onArc(arc, k + 1) - onArc(arc, k));
    return length;
  }

  void spread() {
    std::vector<Ways> ways(places_.size());
    const auto link = [&](Index a, Index b, double length) {
      ways[a].emplace_back(b, length);
      ways[b].emplace_back(a, length);
    };
    for (Index a = 0; a < static_cast<Index>(wireframe_.arcs.size()); ++a)
      link(wireframe_.arcs[a].from, wireframe_.arcs[a].to, lengthOf(a));
    for (Index n = 0; n < static_cast<Index>(places_.size()); ++n)
      if (keeperOf(n) != n) link(n, keeperOf(n), 0);
    shortestWays(ways, distances_);
  }

  const Rig& rig_;
  const Brush& brush_;
  const Wireframe& wireframe_;
  std::vector<Vec3> vectors_;            // of the neutral, settled
  std::vector<Vec3> places_;             // [nodes]
  std::vector<double> own_, distances_;  // [nodes]
  std::vector<Index> keepers_;           // [nodes]
  std::vector<std::pair<Vec3, Vec3>> segments_;
};

}  // namespace

Result<std::vector<double>> paint(const Rig& rig, const Brush& brush) {
  return Painter(rig, brush).paint();
}

Result<std::vector<std::vector<double>>> paintBands(const Rig& rig, const Brush& brush, int count) {
  if (count < 2 || static_cast<std::size_t>(count) > kMostRegions)
    return fail("A face has from 2 to " + std::to_string(kMostRegions) + " bands.");
  if (!(brush.fade > 0)) return fail("Bands need a 'fade', the way over which they follow.");
  if (!brush.nodes.empty()) return fail("Bands take no shares of 'nodes'; leave them out.");
  const auto distances = Painter(rig, brush).distances();
  if (!distances) return std::unexpected(distances.error());
  if (distances->empty() || !(std::ranges::min(*distances) < brush.whole + brush.fade))
    return reachesNothing();
  std::vector<std::vector<double>> bands(count, std::vector<double>(distances->size(), 0.0));
  for (std::size_t n = 0; n < distances->size(); ++n) {
    const double share = std::clamp(((*distances)[n] - brush.whole) / brush.fade, 0.0, 1.0);
    const double place = share * (count - 1);
    const int band = std::min(static_cast<int>(place), count - 2);
    bands[band][n] = fading(place - band);
    bands[band + 1][n] = 1 - bands[band][n];
  }
  return bands;
}

}  // namespace sweepface
