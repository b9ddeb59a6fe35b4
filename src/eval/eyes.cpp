#include <algorithm>
#include <functional>

#include "sweepface/head.hpp"

#include "eval/balls.hpp"

namespace sweepface {
namespace {

constexpr double kSameCentre = 0.3;  // between centres of one eye's balls, relative to the radius
constexpr double kInside = 0.99;     // from a ball's centre to what is in it, likewise
constexpr double kPair = 0.7;        // the smaller eye's radius, relative to the larger one's

struct Eyeball {
  Ball ball;
  std::vector<std::size_t> parts;
};

class EyeFinder {
 public:
  explicit EyeFinder(const Rig& rig) : rig_(rig), grid_(rig.surface, 1), parts_(partsOf(grid_)) {
    const std::vector<Vec3> positions = grid_.positions(blend(rig, {}));
    for (const Part& part : parts_) {
      std::vector<Vec3>& points = points_.emplace_back();
      for (const Index v : part) points.push_back(positions[v]);
    }
  }

  std::vector<Eye> find() {
    collect();
    if (eyeballs_.size() > 2) eyeballs_.resize(2);
    if (eyeballs_.size() == 2 && eyeballs_[1].ball.radius < kPair * eyeballs_[0].ball.radius)
      eyeballs_.pop_back();
    addContents();
    std::vector<Eye> eyes;
    for (const Eyeball& eyeball : eyeballs_) eyes.push_back(eyeOf(eyeball));
    if (eyes.size() == 2 && (eyes[0].centre.x < 0) == (eyes[1].centre.x < 0)) eyes.clear();
    return eyes;
  }

 private:
  /// Collects balls, large ones first; the larger ball of an eye takes in its others (sclera and
  /// cornea).
  void collect() {
    std::vector<Eyeball> found;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (const auto ball = ballOf(points_[p])) found.push_back({*ball, {p}});
    std::ranges::sort(found, std::greater(), [](const Eyeball& e) { return e.ball.radius; });
    for (Eyeball& next : found) {
      const auto same = std::ranges::find_if(eyeballs_, [&](const Eyeball& known) {
        return norm(known.ball.centre - next.ball.centre) < kSameCentre * known.ball.radius;
      });
      if (same == eyeballs_.end())
        eyeballs_.push_back(std::move(next));
      else
        same->parts.push_back(next.parts[0]);
    }
  }

  void addContents() {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (Eyeball& eye : eyeballs_)
        if (std::ranges::find(eye.parts, p) == eye.parts.end() &&
            std::ranges::all_of(points_[p], [&](const Vec3& point) {
              return norm(point - eye.ball.centre) < kInside * eye.ball.radius;
            }))
          eye.parts.push_back(p);
  }

  Eye eyeOf(const Eyeball& eyeball) const {
    const Vec3& c = eyeball.ball.centre;
    Eye eye{c.x >= 0 ? "eyeLeft" : "eyeRight", c, eyeball.ball.radius, {}};
    std::vector<bool> isOurs(grid_.vertexCount(), false);
    for (const std::size_t p : eyeball.parts)
      for (const Index v : parts_[p]) isOurs[v] = true;
    const auto& corners = rig_.surface.connectivity().cornerNode;
    std::vector<bool> turns(rig_.surface.wireframe().nodes.size(), false);
    for (Index p = 0; p < rig_.surface.patchCount(); ++p)
      if (isOurs[grid_.vertex(p, 0, 0)])
        for (int corner = 0; corner < 4; ++corner) turns[corners[4 * p + corner]] = true;
    for (Index v = 0; v < rig_.surface.storedCount(); ++v)
      if (turns[rig_.surface.stored(v).node]) eye.stored.push_back(v);
    return eye;
  }

  const Rig& rig_;
  Tessellation grid_;
  std::vector<Part> parts_;
  std::vector<std::vector<Vec3>> points_;  // [parts]
  std::vector<Eyeball> eyeballs_;
};

}  // namespace

std::vector<Eye> findEyes(const Rig& rig) { return EyeFinder(rig).find(); }

}  // namespace sweepface
