#include "usd/skeleton.hpp"

#include <cmath>
#include <fmt/format.h>

#include "usd/values.hpp"

namespace sweepface::usd {
namespace {

std::string matrixAt(const Vec3& origin) {
  return fmt::format("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), ({}, {}, {}, 1))",
                     number(origin.x), number(origin.y), number(origin.z));
}

/// USD has the real part first. A head turns about what is up.
std::string rotation(const Quaternion& q, bool zUp) {
  return zUp ? tuple(std::array{q[3], q[0], -q[2], q[1]})
             : tuple(std::array{q[3], q[0], q[1], q[2]});
}

void addWeights(Text& text, const Rig& rig, const UsdOptions& options) {
  const std::vector<std::string> names = rig.targetNames();
  text.set("uniform token[] blendShapes", list(names));
  const Weights still(names.size());
  text.set("float[] blendShapeWeights",
           list(std::span<const double>(options.weights.empty() ? still : options.weights)));
  if (!options.clip) return;
  text.openSamples("float[] blendShapeWeights");
  const Clip& clip = *options.clip;
  const std::vector<double> codes = timeCodes(clip.times, options);
  for (std::size_t frame = 0; frame < codes.size(); ++frame)
    text.addSample(fmt::format("{}", codes[frame]),
                   list(std::span(clip.weights).subspan(frame * names.size(), names.size())));
  text.close();
}

void addRotations(Text& text, const HeadTrack& head, const UsdOptions& options) {
  text.openSamples("quatf[] rotations");
  const std::vector<double> codes = timeCodes(head.times, options);
  for (std::size_t k = 0; k < codes.size(); ++k)
    text.addSample(fmt::format("{}", codes[k]),
                   fmt::format("[{}]", rotation(head.rotations[k], options.zUp)));
  text.close();
}

}  // namespace

bool moves(const Rig& rig, const UsdOptions& options) {
  return !rig.targets.empty() || options.head;
}

/// They are whole numbers where they are meant to be, in spite of rounding.
std::vector<double> timeCodes(std::span<const double> times, const UsdOptions& options) {
  std::vector<double> codes;
  codes.reserve(times.size());
  for (const double time : times) {
    const double code = time * options.timeCodesPerSecond, whole = std::round(code);
    codes.push_back(std::abs(code - whole) < 1e-6 ? whole : code);
  }
  return codes;
}

void addSkeleton(Text& text, const std::string& path, const std::string& name, const Rig& rig,
                 const UsdOptions& options) {
  const Vec3 pivot = options.head ? options.head->pivot : Vec3{};
  const std::string joints = R"(["head"])", transforms = "[" + matrixAt(pivot) + "]";
  text.open("Skeleton", name, {R"(prepend apiSchemas = ["SkelBindingAPI"])"});
  text.set("uniform matrix4d[] bindTransforms", transforms);
  text.set("uniform token[] joints", joints);
  text.set("uniform matrix4d[] restTransforms", transforms);
  text.set("rel skel:animationSource", fmt::format("<{}/{}/animation>", path, name));
  text.open("SkelAnimation", "animation");
  if (!rig.targets.empty()) addWeights(text, rig, options);
  text.set("uniform token[] joints", joints);
  text.set("quatf[] rotations", "[(1, 0, 0, 0)]");
  if (options.head) addRotations(text, *options.head, options);
  text.set("half3[] scales", "[(1, 1, 1)]");
  text.set("float3[] translations", "[" + tuple(pivot) + "]");
  text.close();
  text.close();
}

void bindToJoint(Text& text, const std::string& skeleton, std::size_t points) {
  const std::vector<Index> joints(points, 0);
  const std::vector<double> weights(points, 1);
  constexpr std::string_view size = "elementSize = 1", kind = R"(interpolation = "vertex")";
  text.set("int[] primvars:skel:jointIndices", list(std::span<const Index>(joints)), {size, kind});
  text.set("float[] primvars:skel:jointWeights", list(std::span<const double>(weights)),
           {size, kind});
  text.set("rel skel:skeleton", fmt::format("<{}>", skeleton));
}

}  // namespace sweepface::usd
