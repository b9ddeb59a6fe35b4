#include "gltf/head_track.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface::gltf {
namespace {

double dot(const Quaternion& a, const Quaternion& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// Whichever of q and -q, which are the same rotation, is nearer to another one.
Quaternion nearer(const Quaternion& q, const Quaternion& to) {
  return dot(q, to) < 0 ? Quaternion{-q[0], -q[1], -q[2], -q[3]} : q;
}

/// Interpolates along the great circle, the shorter way, as players do (glTF 2.0, appendix C.4).
Quaternion between(const Quaternion& a, const Quaternion& to, double s) {
  const Quaternion b = nearer(to, a);
  const double cosine = std::clamp(dot(a, b), -1.0, 1.0), angle = std::acos(cosine);
  const double sine = std::sin(angle);
  const double p = sine > 1e-9 ? std::sin((1 - s) * angle) / sine : 1 - s;
  const double q = sine > 1e-9 ? std::sin(s * angle) / sine : s;
  Quaternion result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = p * a[k] + q * b[k];
  return result;
}

/// Radians from one rotation to another.
double angleBetween(const Quaternion& a, const Quaternion& to) {
  const Quaternion b = nearer(to, a);
  double square = 0;
  for (std::size_t k = 0; k < 4; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return 4 * std::asin(std::min(1.0, std::sqrt(square) / 2));
}

/// Chooses signs so that programs may interpolate neighbours number by number.
std::vector<Quaternion> untwisted(std::vector<Quaternion> rotations) {
  for (std::size_t k = 1; k < rotations.size(); ++k)
    rotations[k] = nearer(rotations[k], rotations[k - 1]);
  return rotations;
}

/// Frames that suffice as keys: each piece goes on while all frames on it stay within the
/// tolerance.
std::vector<std::size_t> keysOf(const HeadTrack& track, const std::vector<Quaternion>& rotations,
                                double tolerance) {
  std::vector<std::size_t> keys{0};
  const auto isNear = [&](std::size_t from, std::size_t to) {
    for (std::size_t f = from + 1; f < to; ++f) {
      const double s = (track.times[f] - track.times[from]) / (track.times[to] - track.times[from]);
      if (angleBetween(rotations[f], between(rotations[from], rotations[to], s)) > tolerance)
        return false;
    }
    return true;
  };
  for (std::size_t from = 0; from + 1 < rotations.size();) {
    // In strides that grow and then shrink: frame by frame, long rests would take long.
    std::size_t to = from + 1, stride = 1;
    const auto goesOn = [&] { return to + stride < rotations.size() && isNear(from, to + stride); };
    for (; goesOn(); stride *= 2) to += stride;
    for (; stride > 0; stride /= 2)
      if (goesOn()) to += stride;
    keys.push_back(from = to);
  }
  return keys;
}

/// What the scene shows, as lists of nodes: what goes below the head, and skinned meshes, which
/// their joints move and a node above would not.
struct Roots {
  Json below = Json::array(), beside = Json::array();
  bool areElsewhere = false;  ///< some are also children, or listed twice

  explicit Roots(const Document& document) {
    const Json& nodes = document.list("nodes");
    const std::vector<bool> joints = jointsOf(document);
    std::vector<bool> seen(nodes.size(), false);
    for (const Json& parent : nodes)
      for (const Json& child : listOf(parent, "children"))
        if (const auto node = asIndex(child, nodes.size())) seen[*node] = true;
    for (const Json& root : listOf(document.list("scenes")[0], "nodes")) {
      const auto node = asIndex(root, nodes.size());
      if (node && seen[*node]) areElsewhere = true;
      if (node) seen[*node] = true;
      const bool isCarried = node && find(nodes[*node], "skin") && !joints[*node] &&
                             listOf(nodes[*node], "children").empty();
      (isCarried ? beside : below).push_back(root);
    }
  }
};

/// A name that no node has: a joint may have this one, by which animations and programs find it.
std::string freeName(const Json& nodes, std::string name) {
  const auto isTaken = [&](const Json& node) {
    const Json* const own = find(node, "name");
    return own && (*own == name || *own == name + ".contents");
  };
  while (std::ranges::any_of(nodes, isTaken)) name = "sweepface." + name;
  return name;
}

}  // namespace

Result<void> addHeadTrack(Document& document, const HeadTrack& track, double tolerance,
                          Json& animation, Builder& builder) {
  Json& json = document.json;
  if (document.list("scenes").size() != 1)
    return fail(
        "The face's file has not just one scene, so it is not clear what its head holds; leave the "
        "head's turns out (--head), or convert the face from a file with one scene.");
  Roots roots(document);
  if (roots.below.empty())
    return fail(
        "The scene of the face's file shows nothing that its head could hold; leave the head's "
        "turns out (--head), or convert the face from a file that shows it.");
  if (roots.areElsewhere)
    return fail(
        "The scene of the face's file lists a node twice, or one that is another's child, so that "
        "its head would hold it twice; leave the head's turns out (--head), or convert the face "
        "from a file that lists each root once.");
  Json& nodes = json["nodes"];
  const std::size_t head = nodes.size();
  const std::string name = freeName(nodes, "head");
  const auto place = [](const Vec3& p) { return Json::array({p.x, p.y, p.z}); };
  nodes.push_back(
      {{"name", name}, {"translation", place(track.pivot)}, {"children", Json::array({head + 1})}});
  nodes.push_back({{"name", name + ".contents"},
                   {"translation", place(-track.pivot)},
                   {"children", roots.below}});
  roots.beside.insert(roots.beside.begin(), head);
  json["scenes"][0]["nodes"] = roots.beside;
  const std::vector<Quaternion> rotations = untwisted(track.rotations);
  std::vector<double> times, values;
  for (const std::size_t key : keysOf(track, rotations, tolerance)) {
    times.push_back(track.times[key]);
    values.insert(values.end(), rotations[key].begin(), rotations[key].end());
  }
  Column input = pack(times, 1);
  input.bounded = true;
  animation["channels"].push_back({{"sampler", animation["samplers"].size()},
                                   {"target", {{"node", head}, {"path", "rotation"}}}});
  animation["samplers"].push_back({{"input", builder.add(input, Use::other)},
                                   {"interpolation", "LINEAR"},
                                   {"output", builder.add(pack(values, 4), Use::other)}});
  return {};
}

}  // namespace sweepface::gltf
