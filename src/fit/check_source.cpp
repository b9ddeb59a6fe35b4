#include "fit/check_source.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "sweepface/box.hpp"
#include "sweepface/fit.hpp"

#include "codec/limits.hpp"
#include "codec/utf8.hpp"
#include "io/single.hpp"
#include "io/text.hpp"
#include "mesh/check_indices.hpp"

namespace sweepface {

double diagonal(const PolygonMesh& mesh) {
  Box box;
  for (const Index v : mesh.polygons.corners) box.include(mesh.positions[v]);
  return box.isEmpty() ? diagonal(std::span(mesh.positions)) : norm(box.size());
}

Result<void> checkTolerance(double tolerance, double diagonal) {
  // Share of the diagonal: the rounding error of single precision at its far end.
  constexpr double kLeast = 0x1p-25;
  if (tolerance > diagonal)
    return fail(fmt::format(
        "a tolerance of {:.3g} is larger than the mesh, which is {:.3g} across; ask for a finer "
        "one",
        tolerance, diagonal));
  if (tolerance >= kLeast * diagonal) return {};
  return fail(fmt::format(
      "a tolerance of {:.3g} is finer than a file's numbers, {:.3g} for a mesh of this size; "
      "allow a larger one",
      tolerance, kLeast * diagonal));
}

void Reach::include(const Vec3& v) {
  for (const double x : {v.x, v.y, v.z}) {
    away = std::max(away, std::abs(x));
    off = std::max(off, std::abs(x - static_cast<double>(static_cast<float>(x))));
  }
}

Reach reachOf(const PolygonMesh& mesh) {
  Reach reach;
  for (const Index v : mesh.polygons.corners) reach.include(mesh.positions[v]);
  return reach;
}

Result<void> checkPrecision(const MeshRig& source, double tolerance) {
  const auto& [neutral, polygons] = source.neutral;
  const Reach whole = reachOf(source.neutral);
  if (whole.off > tolerance)
    return fail(fmt::format(
        "the mesh stands {:.3g} from the origin, where a file's numbers are off by {:.2g}; move it "
        "there, or allow a larger tolerance than {:.3g}",
        whole.away, whole.off, tolerance));
  for (const MeshTarget& target : source.targets) {
    Reach way;
    for (const Index v : polygons.corners) way.include(target.positions[v] - neutral[v]);
    if (way.off > tolerance)
      return fail(
          fmt::format("the target {} moves a vertex by {:.3g}, which a file cannot tell within "
                      "{:.3g}; it may be in other units, or of another mesh",
                      io::inQuotes(target.name), way.away, tolerance));
  }
  return {};
}

Result<void> checkFromZero(double value, std::string_view what) {
  if (value >= 0 && std::isfinite(value)) return {};
  return fail(fmt::format("{} is a number from 0, not {}", what, value));
}

Result<void> checkTextureBits(int bits) {
  if (bits >= 8 && bits <= 16) return {};
  return fail("packed texture coordinates have 8 to 16 bits, not ", bits);
}

namespace {

/// Files tell targets apart by their names, which are UTF-8.
Result<void> checkNames(const std::vector<MeshTarget>& targets) {
  std::set<std::string_view> names;
  for (const MeshTarget& target : targets) {
    if (target.name.empty()) return fail("a target has no name; name it");
    if (!codec::isUtf8(target.name))
      return fail("the name of the target " + io::inQuotes(target.name) +
                  " has control characters or is not UTF-8; rename it");
    if (target.name.size() > codec::kLongestName)
      return fail("the name of a target, ", io::inQuotes(target.name), ", is longer than ",
                  codec::kLongestName, " bytes; shorten it");
    if (!names.insert(target.name).second)
      return fail("two targets are named " + io::inQuotes(target.name) + "; rename one of them");
  }
  return {};
}

/// Texture coordinates are played in single precision.
Result<void> checkTexcoords(const std::vector<Vec2>& texcoords) {
  const auto bad =
      std::ranges::find_if_not(texcoords, [](const Vec2& t) { return io::isSingle(t); });
  if (bad == texcoords.end()) return {};
  return fail("texture coordinate ", bad - texcoords.begin(),
              " of the mesh is not finite in single precision; give it a place in the texture");
}

/// Files hold what targets add to the neutral in single precision.
Result<void> checkDifferences(const MeshRig& source) {
  for (const MeshTarget& target : source.targets)
    for (std::size_t v = 0; v < target.positions.size(); ++v) {
      if (!io::isSingle(target.positions[v] - source.neutral.positions[v]))
        return fail("vertex ", v, " of the target ", io::inQuotes(target.name),
                    " is further from the neutral's than a file can tell; scale the meshes down");
    }
  return {};
}

}  // namespace

Result<void> checkSource(const MeshRig& source) {
  if (source.neutral.positions.empty())
    return fail("the neutral has no vertices; there is no surface to fit");
  if (auto ok = checkIndices(source); !ok) return ok;
  if (!io::areSingle(source.neutral.positions))
    return fail("a vertex of the neutral is no place that a file could hold; scale the mesh down");
  if (auto ok = checkTexcoords(source.neutral.polygons.texcoords); !ok) return ok;
  if (auto ok = checkNames(source.targets); !ok) return ok;
  if (auto ok = checkDifferences(source); !ok) return ok;
  if (!(diagonal(source.neutral) > 0))
    return fail(
        "all vertices of the neutral stand at one place, as far as numbers tell; there is no "
        "surface to fit");
  return {};
}

}  // namespace sweepface
