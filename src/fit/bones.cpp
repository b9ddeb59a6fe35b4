#include "fit/bones.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "codec/bones.hpp"
#include "surface/union_find.hpp"

namespace sweepface {

namespace {

using codec::CodedSite;

// An affine map of places in homogeneous coordinates.
using Map = Eigen::Matrix<double, 3, 4>;

Eigen::Vector3d vectorOf(const Vec3& v) { return {v.x, v.y, v.z}; }
Eigen::Vector4d homogeneous(const Vec3& v) { return vectorOf(v).homogeneous(); }

// The least-squares map from places to moves; the smallest such map if the places lie in a plane.
class LeastSquares {
 public:
  void add(const Vec3& place, const Vec3& move, double weight = 1) {
    const Eigen::Vector4d at = homogeneous(place);
    normal_ += weight * at * at.transpose();
    right_ += weight * vectorOf(move) * at.transpose();
  }
  Map solve() const {
    return normal_.completeOrthogonalDecomposition().solve(right_.transpose()).transpose();
  }

 private:
  Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
  Map right_ = Map::Zero();
};

class BoneFinder {
 public:
  BoneFinder(const Rig& rig, const codec::Hierarchy& hierarchy, std::span<const Vec3> neutral,
             double tolerance)
      : rig_(rig), sites_(hierarchy.sites()), neutral_(neutral), near_(0.5 * tolerance) {
    for (const CodedSite& site : sites_) places_.push_back(neutral[site.first]);
    // Relative to the middle, where sums of squares keep their digits.
    Vec3 middle;
    double size = 0;
    for (const Vec3& p : places_) middle += (1.0 / static_cast<double>(places_.size())) * p;
    for (Vec3& p : places_) size = std::max(size, norm(p -= middle));
    if (size > 0)
      for (Vec3& p : places_) p = (1 / size) * p;
  }

  void find(Packing& packing) {
    gatherParts();
    std::vector<Bone> bones;
    for (const std::vector<Index>& part : parts_) {
      const auto joins = [&](const Bone& bone) { return isCarried(bone, part); };
      if (const auto bone = std::ranges::find_if(bones, joins); bone != bones.end())
        bone->sites.insert(bone->sites.end(), part.begin(), part.end());
      else if (bones.size() < codec::kMostBones)
        if (Bone own = boneOf(part); !own.maps.empty()) bones.push_back(std::move(own));
    }
    write(bones, packing);
  }

 private:
  struct Carried {
    Index target;
    Map map;
  };
  struct Bone {
    std::vector<Index> sites;
    std::vector<Carried> maps;
  };

  const Vec3& move(Index target, Index site) const {
    return rig_.targets[target].difference[sites_[site].first];
  }
  double off(const Map& map, Index target, Index site) const {
    return (map * homogeneous(places_[site]) - vectorOf(move(target, site))).norm();
  }

  // Groups the sites that arcs join into parts, the largest first.
  void gatherParts() {
    const Wireframe& w = rig_.surface.wireframe();
    UnionFind joined(static_cast<Index>(w.nodes.size()));
    for (const Arc& a : w.arcs) joined.join(a.from, a.to);
    std::vector<Index> partOf(w.nodes.size(), -1);
    for (Index s = 0; s < static_cast<Index>(sites_.size()); ++s) {
      Index& part = partOf[joined.find(sites_[s].node)];
      if (part < 0) part = static_cast<Index>(parts_.size()), parts_.emplace_back();
      parts_[part].push_back(s);
    }
    std::ranges::sort(parts_, [](const auto& a, const auto& b) {
      return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
    });
  }

  // The map that most of the sites follow (iteratively reweighted least squares).
  Map mapOf(Index target, std::span<const Index> sites) const {
    constexpr int kRounds = 12;
    std::vector<double> weights(sites.size(), 1);
    Map map = Map::Zero();
    for (int round = 0; round < kRounds; ++round) {
      LeastSquares sums;
      for (std::size_t k = 0; k < sites.size(); ++k)
        sums.add(places_[sites[k]], move(target, sites[k]), weights[k]);
      map = sums.solve();
      for (std::size_t k = 0; k < sites.size(); ++k)
        weights[k] = 1 / std::max(off(map, target, sites[k]), 0.01 * near_);
    }
    return map;
  }

  // The sites of a part that move as a whole in the target that moves it most, if they are a good
  // deal of it, with the maps of all targets that move them as a whole.
  Bone boneOf(const std::vector<Index>& part) const {
    constexpr std::size_t kFewest = 8;
    Bone bone;
    if (part.size() < kFewest) return bone;
    Index most = -1;
    Map main;
    double largest = 0;
    for (Index t = 0; t < static_cast<Index>(rig_.targets.size()); ++t) {
      const std::vector<Index> moved = movedOf(t, part);
      if (4 * moved.size() < part.size() || moved.size() < kFewest) continue;
      const Map map = mapOf(t, moved);
      if (!follow(map, t, moved)) continue;
      double sum = 0;
      for (const Index s : moved) sum += norm(move(t, s));
      if (sum > largest) largest = sum, main = map, most = t;
    }
    if (most < 0) return bone;
    std::ranges::copy_if(part, std::back_inserter(bone.sites),
                         [&](Index s) { return off(main, most, s) <= 2 * near_; });
    for (Index t = 0; t < static_cast<Index>(rig_.targets.size()); ++t) {
      if (2 * movedOf(t, bone.sites).size() < bone.sites.size()) continue;
      const Map map = mapOf(t, bone.sites);
      if (follow(map, t, bone.sites)) bone.maps.push_back({t, map});
    }
    return bone;
  }

  std::vector<Index> movedOf(Index target, const std::vector<Index>& part) const {
    std::vector<Index> moved;
    for (const Index s : part)
      if (norm(move(target, s)) > near_) moved.push_back(s);
    return moved;
  }
  bool follow(const Map& map, Index target, const std::vector<Index>& sites) const {
    const auto near =
        std::ranges::count_if(sites, [&](Index s) { return off(map, target, s) <= near_; });
    return 10 * static_cast<std::size_t>(near) >= 9 * sites.size();
  }
  bool isCarried(const Bone& bone, const std::vector<Index>& part) const {
    return std::ranges::all_of(bone.maps,
                               [&](const Carried& c) { return follow(c.map, c.target, part); });
  }

  void write(const std::vector<Bone>& bones, Packing& packing) const {
    if (bones.empty()) return;
    packing.bones.assign(neutral_.size(), -1);
    for (std::size_t b = 0; b < bones.size(); ++b)
      for (const Index s : bones[b].sites)
        std::fill_n(packing.bones.begin() + sites_[s].first, sites_[s].count,
                    static_cast<Index>(b));
    const codec::Bones places(rig_.surface, packing, neutral_);
    for (std::size_t b = 0; b < bones.size(); ++b)
      for (const Carried& carried : bones[b].maps)
        if (const auto carry = carryOf(static_cast<Index>(b), carried.target, places))
          packing.poses[carried.target + 1].carries.push_back(*carry);
  }

  // Fitted to the places that the file knows; nothing if it cannot hold numbers that large.
  std::optional<Packing::Carry> carryOf(Index bone, Index target, const codec::Bones& bones) const {
    LeastSquares sums;
    for (const auto& [vector, its, isPosition, at] : bones.places())
      if (its == bone && isPosition) sums.add(at, rig_.targets[target].difference[vector]);
    const Map by = sums.solve() / bones.unit();
    if (!(by.cwiseAbs().maxCoeff() < codec::kMostCarried)) return std::nullopt;
    Packing::Carry carry{bone, {}};
    for (int k = 0; k < 4; ++k)
      for (int a = 0; a < 3; ++a)
        carry.by[k][a] = static_cast<std::int32_t>(std::lround(by(a, (k + 3) % 4)));
    return carry;
  }

  const Rig& rig_;
  const std::vector<CodedSite>& sites_;
  std::span<const Vec3> neutral_;
  double near_;
  std::vector<Vec3> places_;  // [sites]
  std::vector<std::vector<Index>> parts_;
};

double bitsOf(std::span<const codec::Steps3> vectors) {
  double sum = 0;
  for (const codec::Steps3& v : vectors) sum += codec::bitsOf(v);
  return sum;
}

// Removes the bones that carry nothing.
void dropUnused(Packing& packing) {
  std::vector<Index> number(codec::kMostBones, -1);
  for (const Packing::Pose& pose : packing.poses)
    for (const Packing::Carry& carry : pose.carries) number[carry.bone] = 0;
  Index count = 0;
  for (Index& n : number)
    if (n == 0) n = count++;
  for (Index& bone : packing.bones)
    if (bone >= 0) bone = number[bone];
  for (Packing::Pose& pose : packing.poses)
    for (Packing::Carry& carry : pose.carries) carry.bone = number[carry.bone];
  if (count == 0) packing.bones.clear();
}

// Removes carries that cost more bits than they save.
void dropIdle(const Rig& rig, const codec::Lattice& lattice, std::span<const Vec3> neutral,
              Packing& packing) {
  const codec::Bones bones(rig.surface, packing, neutral);
  for (Index pose = 1; pose < static_cast<Index>(packing.poses.size()); ++pose) {
    auto& carries = packing.poses[pose].carries;
    const auto told = [&] {
      return bitsOf(lattice.round(pose, bones.beyond(carries, rig.targets[pose - 1].difference),
                                  codec::stepOf(packing, pose)));
    };
    double with = carries.empty() ? 0 : told();
    for (std::size_t k = carries.size(); k-- > 0;) {
      const Packing::Carry carry = carries[k];
      carries.erase(carries.begin() + static_cast<std::ptrdiff_t>(k));
      const double without = told();
      if (without > with + bitsOf(carry.by))
        carries.insert(carries.begin() + static_cast<std::ptrdiff_t>(k), carry);
      else
        with = without;
    }
  }
  dropUnused(packing);
}

}  // namespace

void findBones(const Rig& rig, const codec::Lattice& lattice, std::span<const Vec3> neutral,
               double tolerance, Packing& packing) {
  packing.bones.clear();
  for (Packing::Pose& pose : packing.poses) pose.carries.clear();
  BoneFinder(rig, lattice.hierarchy(), neutral, tolerance).find(packing);
  if (!packing.bones.empty()) dropIdle(rig, lattice, neutral, packing);
}

}  // namespace sweepface
