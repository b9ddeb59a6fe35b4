#include <algorithm>
#include <fmt/format.h>

#include "sweepface/drawing.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"

namespace sweepface::cli {
namespace {

struct WireframeArguments {
  std::string face, output, weights;
  int lod = 8;
  bool quiet = false;
};

void addOptions(CLI::App& app, WireframeArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "The file to write: lines (.obj), or the wireframe as a text that `sweepface build` "
            "reads (.json)");
  addWeights(app, a.weights);
  addLod(app, a.lod, "Points on a curve for every edge of the source, 1 to 64")
      ->capture_default_str();
  addQuiet(app, a.quiet);
  app.footer(
      "\nThe file has the groups nodes, boundary_curves and control_curves: beside every "
      "boundary curve,\nin each patch, two curves at 1/10 and 1/4 of the way across.\n\n"
      "Examples:\n  sweepface wireframe face.sweep -o wire.obj --weights jawOpen=1\n"
      "  sweepface wireframe face.sweep -o face.wire.json");
}

/// How far the control curves lie from the boundary, as shares of the patch's length across.
constexpr double kSecond = 0.1, kThird = 0.25;

/// An arc as seen from the patch on the left of a half-arc.
struct Across {
  bool alongV;    ///< leaving the arc is moving along v, else along u
  double length;  ///< of the patch, in source edges; negative where the way in is against u or v
};

Across acrossArc(const Surface& surface, HalfArc h) {
  const Index patch = surface.connectivity().patchOf[h];
  int side = 0;
  while (std::ranges::count(surface.wireframe().side(patch, side), h) == 0) ++side;
  const bool alongV = side == 0 || side == 2;
  const double length = alongV ? surface.edgesV(patch) : surface.edgesU(patch);
  return {alongV, side == 0 || side == 3 ? length : -length};
}

/// Writes the curves of a pose as points and lines of an OBJ text.
class WireWriter {
 public:
  WireWriter(const Surface& surface, std::span<const Vec3> vectors, int perEdge)
      : surface_(surface), wires_(surface.wireframe()), vectors_(vectors), perEdge_(perEdge) {}

  std::string write() {
    writeNodes();
    elements_ += "g boundary_curves\n";
    eachArc([&](Index arc) { writeBoundary(arc); });
    elements_ += "g control_curves\n";
    eachArc([&](Index arc) {
      for (HalfArc h : {2 * arc, 2 * arc + 1})
        if (surface_.connectivity().patchOf[h] >= 0) writeControls(h);
    });
    return points_ + elements_;
  }

  std::size_t curveCount() const { return curves_; }

 private:
  using Curve = std::vector<Index>;

  void eachArc(auto visit) {
    for (Index arc = 0; arc < static_cast<Index>(wires_.arcs.size()); ++arc)
      if (!wires_.arcs[arc].collapsed) visit(arc);
  }

  Index addPoint(const Vec3& p) {
    points_ += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    return ++pointCount_;
  }

  void addCurve(const Curve& curve) {
    elements_ += fmt::format("l {}\n", fmt::join(curve, " "));
    ++curves_;
  }

  /// Nodes that share a point are one; curves end at the same vertices.
  void writeNodes() {
    elements_ += "g nodes\n";
    std::vector<Index> ofPoint(wires_.points, 0);
    for (std::size_t n = 0; n < wires_.nodes.size(); ++n) {
      const Index point = wires_.nodes[n].point;
      Index vertex = point >= 0 ? ofPoint[point] : 0;
      if (vertex == 0) {
        vertex = addPoint(placeOf(surface_.connectivity().stars[n].arms[0]));
        elements_ += fmt::format("p {}\n", vertex);
        if (point >= 0) ofPoint[point] = vertex;
      }
      vertexOfNode_.push_back(vertex);
    }
  }

  Vec3 placeOf(HalfArc arm) const {
    const Index arc = arcOf(arm);
    return surface_.pointOnArc(vectors_, arc, arm & 1 ? wires_.arcs[arc].edges : 0);
  }

  void writeBoundary(Index arc) {
    Curve curve{vertexOfNode_[wires_.arcs[arc].from]};
    for (Index step = 1; step < steps(arc); ++step)
      curve.push_back(addPoint(surface_.pointOnArc(vectors_, arc, at(step))));
    curve.push_back(vertexOfNode_[wires_.arcs[arc].to]);
    addCurve(curve);
  }

  void writeControls(HalfArc h) {
    Curve second, third;
    for (Index step = 0; step <= steps(arcOf(h)); ++step) {
      const auto [c2, c3] = controlsAt(h, at(step));
      second.push_back(addPoint(c2));
      third.push_back(addPoint(c3));
    }
    addCurve(second);
    addCurve(third);
  }

  std::pair<Vec3, Vec3> controlsAt(HalfArc h, double t) const {
    const Across across = acrossArc(surface_, h);
    const Site site = surface_.siteOnArc(h, t);
    const auto derivative = [&](int order) {
      return surface_.evaluate(vectors_, site, across.alongV ? 0 : order,
                               across.alongV ? order : 0);
    };
    return controlsFromDerivatives(derivative(0), {derivative(1), derivative(2)},
                                   {kSecond * across.length, kThird * across.length});
  }

  Index steps(Index arc) const { return perEdge_ * wires_.arcs[arc].edges; }
  double at(Index step) const { return static_cast<double>(step) / perEdge_; }

  const Surface& surface_;
  const Wireframe& wires_;
  std::span<const Vec3> vectors_;
  Index perEdge_;
  std::string points_, elements_;
  Index pointCount_ = 0;
  std::size_t curves_ = 0;
  std::vector<Index> vertexOfNode_;
};

/// All of a face as a text: the neutral, its expressions, names and shape parameters.
Result<int> writeDrawing(const WireframeArguments& a, const Rig& rig) {
  if (!a.weights.empty())
    return fail("A .json file holds the neutral and all expressions; --weights is for .obj.");
  const Drawing drawing = draw(rig);
  if (auto written = writeFile(a.output, formatDrawing(drawing)); !written)
    return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} nodes, {} curves, {} patches, {} expressions\n", a.output,
               drawing.nodes.size(), drawing.curves.size(), drawing.patches.size(),
               drawing.expressions.size());
  return 0;
}

Result<int> runWireframe(const WireframeArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Weights> weights = parseWeights(*rig, a.weights);
  if (!weights) return std::unexpected(weights.error());
  if (auto ok = checkOutput(a.output, {a.face}, {".ply", ".sweep"}); !ok)
    return std::unexpected(ok.error());
  if (extension(a.output) == ".json") return writeDrawing(a, *rig);
  const std::vector<Vec3> vectors = blend(*rig, *weights);
  WireWriter writer(rig->surface, vectors, a.lod);
  if (auto written = writeFile(a.output, writer.write()); !written)
    return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} nodes, {} curves\n", a.output, rig->surface.wireframe().nodes.size(),
               writer.curveCount());
  return 0;
}

}  // namespace

Command addWireframe(CLI::App& tool) {
  return makeCommand(tool, "wireframe",
                     "Write the network of curves as lines (.obj) or as a text to edit (.json)",
                     runWireframe);
}

}  // namespace sweepface::cli
