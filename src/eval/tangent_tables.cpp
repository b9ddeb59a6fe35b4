#include "sweepface/evaluator.hpp"

#include "eval/table_compiler.hpp"

namespace sweepface {
namespace {

/// Vertices are those of a render mesh. Their derivatives are turned to go along the tangent and,
/// at a right angle in the neutral, across it.
struct AlongTangents {
  const RenderMesh& mesh;
  std::span<const Vec3> tangents;

  Index count(Index) const { return mesh.vertexCount(); }
  Index point(Index vertex) const { return mesh.pointOf(vertex); }

  void turn(Index vertex, Derivatives& both) const {
    const Derivatives old = both;
    const double ofU = 1 / norm(old[0].neutral), ofV = 1 / norm(old[1].neutral);
    const Vec3 u = ofU * old[0].neutral, v = ofV * old[1].neutral, normal = cross(u, v);
    // Nearly parallel derivatives would have to cancel each other, and no length may be 0 or
    // infinite.
    constexpr double kLeastSine = 1e-3;
    const double sine = norm(normal);
    if (norm(tangents[vertex]) == 0 || !(sine > kLeastSine && std::isfinite(sine))) return;
    const auto mix = [&](const Vec3& direction, Derivative& out) {
      const double a = dot(cross(direction, v), normal) / dot(normal, normal),
                   b = dot(cross(u, direction), normal) / dot(normal, normal);
      out.neutral = a * u + b * v;
      for (std::size_t k = 0; k < out.weights.factors.size(); ++k)
        out.weights.factors[k] =
            a * ofU * old[0].weights.factors[k] + b * ofV * old[1].weights.factors[k];
    };
    mix(tangents[vertex], both[0]);
    mix(cross(normalized(normal), tangents[vertex]), both[1]);
  }
};

}  // namespace

Result<Evaluator> Evaluator::make(const Rig& rig, const Tessellation& grid, const RenderMesh& mesh,
                                  const Tangents& tangents, const EvaluatorOptions& options) {
  if (auto ok = check(rig, grid, options); !ok) return std::unexpected(ok.error());
  const auto points = options.level == 0 && grid.level() > 0
                          ? static_cast<Index>(rig.source.gridVertex.size())
                          : grid.vertexCount();
  if (mesh.points != points ||
      tangents.directions.size() != static_cast<std::size_t>(mesh.vertexCount()))
    return fail("The render mesh and the tangents of an evaluator must be of its tessellation.");
  Evaluator made;
  made.tables_ = std::make_shared<const EvaluatorTables>(
      TableCompiler(rig, grid, options, AlongTangents{mesh, tangents.directions}).compile());
  return made;
}

}  // namespace sweepface
