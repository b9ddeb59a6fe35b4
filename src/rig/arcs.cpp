#include "sweepface/arcs.hpp"

#include <algorithm>

#include "rig/taylor.hpp"
#include "surface/stored_jets.hpp"

namespace sweepface {
namespace {

using Taylor3 = std::array<Taylor, 3>;

Taylor dot(const Taylor3& a, const Taylor3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The vector from the pivot, without its component along the axis.
Taylor3 armOf(const Turn& turn, Taylor3 p) {
  const std::array pivot{turn.pivot.x, turn.pivot.y, turn.pivot.z};
  const std::array axis{turn.axis.x, turn.axis.y, turn.axis.z};
  for (int k = 0; k < 3; ++k) p[k] = p[k] + -pivot[k];
  const Taylor along = p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2];
  for (int k = 0; k < 3; ++k) p[k] = p[k] - along * axis[k];
  return p;
}

/// 0 up to `low`, 1 from `high` on, with a twice continuously differentiable transition.
Taylor faded(const Taylor& x, double low, double high) {
  if (!(x.value() > low)) return {};
  Taylor t = (x + -low) * (1 / (high - low));
  if (t.value() >= 1) return Taylor{} + 1;
  return t * t * t * (t * (t * 6 + -15.0) + 10);
}

/// The bulge and its derivatives: what must be added to the middle of both arms to stretch it to
/// their mean length. It is zero at the axis, where directions mean nothing, and fades out towards
/// half a turn, which has no middle.
Taylor3 bulgeOf(const Turn& turn, const Taylor3& from, const Taylor3& to) {
  const Taylor3 a = armOf(turn, from), b = armOf(turn, to);
  Taylor3 middle;
  for (int k = 0; k < 3; ++k) middle[k] = (a[k] + b[k]) * 0.5;
  const Taylor aa = dot(a, a), bb = dot(b, b), mm = dot(middle, middle);
  constexpr double nothing = 1e-12;
  if (!(std::min(aa.value(), bb.value()) > nothing * std::max(aa.value(), bb.value()))) return {};
  if (!(mm.value() > nothing * aa.value())) return {};
  const Taylor mean = (sqrt(aa) + sqrt(bb)) * 0.5, length = sqrt(mm);
  // The cosine of half the angle is 1/2 for a third of a full turn.
  const Taylor weight = faded(length * inverse(mean), 0.5, 0.9);
  const Taylor stretch = (mean * inverse(length) + -1.0) * weight;
  for (Taylor& m : middle) m = m * stretch;
  return middle;
}

/// The stored vectors of the bulge of one target, from the jets of both poses at every node.
class BulgeMaker {
 public:
  BulgeMaker(const Rig& rig, std::span<const Vec3> from)
      : surface_(rig.surface), jets_(surface_), from_(from), small_(1e-3 * rig.tolerance) {}

  std::vector<Vec3> make(const Turn& turn, std::span<const Vec3> to) {
    to_ = to;
    bulge_.assign(surface_.storedCount(), {});
    done_.assign(surface_.storedCount(), false);
    for (Index patch = 0; patch < surface_.patchCount(); ++patch)
      for (int corner = 0; corner < 4; ++corner) atCorner(turn, patch, corner);
    atCharts(turn);
    atFans(turn);
    return std::move(bulge_);
  }

 private:
  static Vec3 derivative(const Taylor3& t, int i, int j) {
    return {t[0].derivative(i, j), t[1].derivative(i, j), t[2].derivative(i, j)};
  }

  void set(Index stored, const Vec3& value) {
    done_[stored] = true;
    if (norm(value) > small_) bulge_[stored] = value;
  }

  /// The bulge of the jet at a corner.
  Taylor3 bulgeAt(const Turn& turn, const std::array<JetRef, 9>& refs) const {
    Taylor3 from, to;
    for (int k = 0; k < 9; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        const auto [vector, sign] = refs[k];
        from[axis].setDerivative(k / 3, k % 3, sign * coordinate(from_[vector], axis));
        to[axis].setDerivative(k / 3, k % 3, sign * coordinate(to_[vector], axis));
      }
    return bulgeOf(turn, from, to);
  }
  std::array<JetRef, 9> jetAt(Index patch, int corner) const {
    std::array<JetRef, 9> refs;
    for (int k = 0; k < 9; ++k) refs[k] = surface_.cornerJet(patch, corner, k / 3, k % 3);
    return refs;
  }

  /// Nodes whose jet is seen at a corner, turned by right angles.
  void atCorner(const Turn& turn, Index patch, int corner) {
    const auto refs = jetAt(patch, corner);
    const bool isNew = std::ranges::any_of(refs, [&](const JetRef& ref) {
      return ref.vector < surface_.storedCount() && !done_[ref.vector];
    });
    const auto kind = surface_.connectivity().kinds[nodeAt(patch, corner)];
    if (!isNew || kind == NodeKind::irregular) return;
    const Taylor3 bulge = bulgeAt(turn, refs);
    for (int k = 0; k < 9; ++k)
      if (refs[k].vector < surface_.storedCount())
        set(refs[k].vector, refs[k].sign * derivative(bulge, k / 3, k % 3));
  }

  /// Fans of right angles at creased nodes: the corner of a fan's first sector has the fan's axes.
  void atFans(const Turn& turn) {
    const Connectivity& c = surface_.connectivity();
    for (Index n = 0; n < static_cast<Index>(c.kinds.size()); ++n)
      for (std::size_t f = 0; c.kinds[n] == NodeKind::creased && f < c.fans[n].size(); ++f) {
        if (!c.fans[n][f].regular) continue;
        const auto& sectors = c.stars[n].sectors;
        const Index corner = sectors[static_cast<std::size_t>(c.fans[n][f].first) % sectors.size()];
        const Taylor3 bulge = bulgeAt(turn, jetAt(corner / 4, corner % 4));
        for (int k = 0; k < 9; ++k)
          if (const Index v = jets_.at(n, k, static_cast<int>(f)); v >= 0)
            set(v, derivative(bulge, k / 3, k % 3));
      }
  }

  /// Nodes with a second-order jet in a chart: all of it is stored.
  void atCharts(const Turn& turn) {
    for (Index v = 0; v < surface_.storedCount();) {
      const Index first = v, node = surface_.stored(v).node;
      while (v < surface_.storedCount() && surface_.stored(v).node == node) ++v;
      if (surface_.connectivity().kinds[node] != NodeKind::irregular) continue;
      Taylor3 from, to;
      eachOf(first, v, [&](Index k, int i, int j) {
        for (int axis = 0; axis < 3; ++axis) {
          from[axis].setDerivative(i, j, coordinate(from_[k], axis));
          to[axis].setDerivative(i, j, coordinate(to_[k], axis));
        }
      });
      const Taylor3 bulge = bulgeOf(turn, from, to);
      eachOf(first, v, [&](Index k, int i, int j) { set(k, derivative(bulge, i, j)); });
    }
  }
  void eachOf(Index first, Index last, auto visit) const {
    for (Index k = first; k < last; ++k) visit(k, surface_.stored(k).i, surface_.stored(k).j);
  }

  Index nodeAt(Index patch, int corner) const {
    return surface_.connectivity().cornerNode[4 * patch + corner];
  }

  const Surface& surface_;
  StoredJets jets_;
  std::span<const Vec3> from_, to_;
  double small_;
  std::vector<Vec3> bulge_;
  std::vector<char> done_;
};

Taylor3 constant(const Vec3& p) {
  Taylor3 t;
  t[0].c[0] = p.x, t[1].c[0] = p.y, t[2].c[0] = p.z;
  return t;
}

}  // namespace

Vec3 bulge(const Turn& turn, const Vec3& from, const Vec3& to) {
  const Taylor3 b = bulgeOf(turn, constant(from), constant(to));
  return {b[0].value(), b[1].value(), b[2].value()};
}

namespace {

constexpr std::string_view kArc = ".arc";

/// Whether a target is the arc of another.
bool isArc(const Rig& rig, std::string_view name) {
  return name.ends_with(kArc) && rig.find(name.substr(0, name.size() - kArc.size())) >= 0;
}

}  // namespace

std::string arcName(std::string_view target) { return std::string(target).append(kArc); }

std::vector<Follower> addArcs(Rig& rig, std::span<const Turn> turns) {
  const std::size_t count = rig.targets.size();
  const std::vector<Vec3> neutral = blend(rig, {});
  BulgeMaker maker(rig, neutral);
  std::vector<Follower> followers;
  for (const Turn& turn : turns) {
    std::vector<double> weights(count);
    weights[turn.target] = 1;
    const Target& target = rig.targets[turn.target];
    if (isArc(rig, target.name)) continue;
    if (const Index known = rig.find(arcName(target.name)); known >= 0) {
      followers.push_back({Follower::Kind::arc, known, {turn.target}, 0});
      continue;
    }
    Target arc{arcName(target.name), maker.make(turn, blend(rig, weights)), {}};
    for (std::size_t v = 0; v < rig.source.loose.size(); ++v)
      arc.looseDifference.push_back(
          bulge(turn, rig.source.loose[v], rig.source.loose[v] + target.looseDifference[v]));
    followers.push_back(
        {Follower::Kind::arc, static_cast<Index>(rig.targets.size()), {turn.target}, 0});
    rig.targets.push_back(std::move(arc));
  }
  return followers;
}

}  // namespace sweepface
