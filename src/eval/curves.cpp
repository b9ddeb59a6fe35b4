#include "sweepface/eval.hpp"
#include "sweepface/ode.hpp"

#include "surface/inward.hpp"
#include "surface/vertex_numbers.hpp"

namespace sweepface {
namespace {

/// How far the control curves lie from the boundary, as shares of the patch's length across.
constexpr double kSecond = 0.1, kThird = 0.25;

class CurveMaker {
 public:
  CurveMaker(const Surface& surface, std::span<const Vec3> vectors, Index perEdge)
      : surface_(surface), wires_(surface.wireframe()), vectors_(vectors), perEdge_(perEdge) {}

  CurveNetwork make() {
    addNodes();
    eachArc([&](Index arc) { addBoundary(arc); });
    eachArc([&](Index arc) {
      for (HalfArc h : {2 * arc, 2 * arc + 1})
        if (surface_.connectivity().patchOf[h] >= 0) addControls(h);
    });
    return std::move(net_);
  }

 private:
  void eachArc(auto visit) {
    for (Index arc = 0; arc < static_cast<Index>(wires_.arcs.size()); ++arc)
      if (!wires_.arcs[arc].collapsed) visit(arc);
  }

  Index addPoint(const Vec3& p) {
    net_.points.push_back(p);
    return static_cast<Index>(net_.points.size()) - 1;
  }

  /// Nodes that share a point become one, so that their curves end at the same point.
  void addNodes() {
    placeOfNode_ = VertexNumbers(wires_).ofNode;
    for (std::size_t n = 0; n < wires_.nodes.size(); ++n)
      if (placeOfNode_[n] == std::ssize(net_.points))
        net_.nodes.push_back(addPoint(placeOf(surface_.connectivity().stars[n].arms[0])));
  }

  Vec3 placeOf(HalfArc arm) const {
    const Index arc = arcOf(arm);
    return surface_.pointOnArc(vectors_, arc, arm & 1 ? wires_.arcs[arc].edges : 0);
  }

  void addBoundary(Index arc) {
    Curve curve{2 * arc, {placeOfNode_[wires_.arcs[arc].from]}};
    for (Index step = 1; step < steps(arc); ++step)
      curve.points.push_back(addPoint(surface_.pointOnArc(vectors_, arc, at(step))));
    curve.points.push_back(placeOfNode_[wires_.arcs[arc].to]);
    net_.boundary.push_back(std::move(curve));
  }

  void addControls(HalfArc h) {
    Curve second{h, {}}, third{h, {}};
    for (Index step = 0; step <= steps(arcOf(h)); ++step) {
      const auto [c2, c3] = controlsAt(h, at(step));
      second.points.push_back(addPoint(c2));
      third.points.push_back(addPoint(c3));
    }
    net_.control.push_back(std::move(second));
    net_.control.push_back(std::move(third));
  }

  std::pair<Vec3, Vec3> controlsAt(HalfArc h, double t) const {
    const Inward way(surface_, h);
    const double length = way.direction * way.edges;
    const Site site = surface_.siteOnArc(h, t);
    const auto derivative = [&](int order) {
      return surface_.evaluate(vectors_, site, way.alongV ? 0 : order, way.alongV ? order : 0);
    };
    return controlsFromDerivatives(derivative(0), {derivative(1), derivative(2)},
                                   {kSecond * length, kThird * length});
  }

  Index steps(Index arc) const { return perEdge_ * wires_.arcs[arc].edges; }
  double at(Index step) const { return static_cast<double>(step) / perEdge_; }

  const Surface& surface_;
  const Wireframe& wires_;
  std::span<const Vec3> vectors_;
  Index perEdge_;
  CurveNetwork net_;
  std::vector<Index> placeOfNode_;
};

}  // namespace

CurveNetwork curveNetwork(const Surface& surface, std::span<const Vec3> vectors, Index perEdge) {
  return CurveMaker(surface, vectors, perEdge).make();
}

}  // namespace sweepface
