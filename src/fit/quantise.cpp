#include "fit/quantise.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <optional>
#include <set>

#include "sweepface/eval.hpp"

#include "codec/bones.hpp"
#include "codec/lattice.hpp"
#include "fit/bones.hpp"
#include "fit/columns.hpp"
#include "fit/corner_places.hpp"
#include "fit/folds.hpp"
#include "fit/images.hpp"
#include "fit/pose_quantiser.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

using codec::CodedSite;
using codec::Coefficients;
using codec::Lattice;
using codec::Symmetry;

namespace {

// Steps, as shares of the tolerance, of vectors that few vertices follow; the hierarchy makes those
// of others finer.
constexpr double kNeutralStep = 0.25, kTargetStep = 1;
// The neutral spends this share of the tolerance, so that its poses have room.
constexpr double kNeutralShare = 0.5;
// What a tangent that leans by the angle aimed at counts, in bits.
constexpr double kNeutralBits = 1.5, kTargetBits = 0.1;
constexpr int kMostHalvings = 8;
// From this many halvings on a target starts where the fit has the pose, whatever that costs.
constexpr int kFaithful = 2;
// Steps are halved this often for the sake of folds alone.
constexpr int kMostForFolds = 2;
// What the search keeps to, of the tolerance: it counts in single precision.
constexpr double kBound = 0.995;

class Quantiser {
 public:
  Quantiser(Rig& rig, const MeshRig& source, double tolerance, double angle,
            const std::function<bool(double)>& proceed)
      : rig_(rig),
        source_(source),
        tolerance_(tolerance),
        angle_(angle),
        proceed_(proceed),
        grid_(rig.surface, 1) {
    rig.packing = {};
    rig.packing.neutralStep = kNeutralStep * tolerance;
    rig.packing.targetStep = kTargetStep * tolerance;
    const codec::MirrorSeeds seeds = codec::findMirror(rig.surface, rig.neutral);
    rig.packing.axis = seeds.axis;
    rig.packing.mirror = seeds.pairs;
    lattice_.emplace(rig.surface, rig.packing);
    chooseImages(rig, *lattice_, rig.packing);
    columns_ = columnsOf(rig.surface, grid_, lattice_->prediction(0));
    folds_.emplace(rig, grid_);
  }

  Result<void> run() {
    const auto poses = static_cast<Index>(rig_.packing.poses.size());
    poses_.resize(poses);
    fittedNeutral_ = rig_.neutral;
    gather();
    neutralErrors_.assign(grid_.vertexCount(), Vec3{});
    if (!settle(0, neutralBounds())) return failed("the neutral");
    lattice_->learn(rig_.surface, rig_.neutral, codec::stepOf(rig_.packing, 0));
    neutralFolds_ = foldsOf(0, rig_.neutral);
    findBones(rig_, *lattice_, rig_.neutral, tolerance_, rig_.packing);
    bones_ = codec::Bones(rig_.surface, rig_.packing, rig_.neutral);
    columns_ = columnsOf(rig_.surface, grid_, lattice_->prediction(1));
    neutralErrors_ = errorsOf(0, poses_[0]);
    neutralOff_ = rig_.neutral;
    for (std::size_t v = 0; v < neutralOff_.size(); ++v) neutralOff_[v] -= fittedNeutral_[v];
    neutralOff_ = settled(std::move(neutralOff_));
    // Images first: what is compared with them needs them.
    const auto bound = static_cast<float>(kBound * tolerance_);
    std::atomic<Index> count = 0;
    std::vector<char> met(poses_.size(), true);
    for (const bool images : {true, false}) {
      parallelFor(Index{1}, poses, [&](Index pose) {
        const Index image = rig_.packing.poses[pose].image;
        if (images != (image < 0 || image == pose)) return;
        if (!proceed_(static_cast<double>(++count) / poses)) return;
        met[pose] = settle(pose, std::vector<float>(grid_.vertexCount(), bound));
      });
      if (!proceed_(1)) return fail("the conversion was interrupted");
      if (const auto bad = std::ranges::find(met, false); bad != met.end())
        return failed("'" + rig_.targets[bad - met.begin() - 1].name + "'");
    }
    return {};
  }

 private:
  std::unexpected<Error> failed(const std::string& pose) const {
    // Files count steps from the origin, to 2²⁶ (src/codec/lattice.cpp); those of roots are halved.
    constexpr double kFarthest = (1 << 26) * kNeutralStep / 2;
    double away = 0;
    for (const Index v : source_.neutral.polygons.corners) {
      const Vec3& p = source_.neutral.positions[v];
      away = std::max({away, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    if (away > kFarthest * tolerance_)
      return fail(fmt::format(
          "the mesh stands {:.3g} from the origin, too far to be packed at a tolerance of {:.3g}; "
          "move it there, allow a larger one, or do not pack",
          away, tolerance_));
    return fail(fmt::format(
        "steps fine enough for a tolerance of {:.3g} cannot be packed in {}; allow a larger one, "
        "or do not pack",
        tolerance_, pose));
  }

  // Where the source's vertices are in each pose, at the vertices of level 1.
  void gather() {
    known_.assign(grid_.vertexCount(), 0);
    goals_.assign(poses_.size(), std::vector<Vec3>(grid_.vertexCount()));
    const auto aim = [&](std::size_t vertex, Index place) {
      known_[place] = 1;
      goals_[0][place] = source_.neutral.positions[vertex];
      for (std::size_t k = 0; k < source_.targets.size(); ++k)
        goals_[k + 1][place] =
            source_.targets[k].positions[vertex] - source_.neutral.positions[vertex];
    };
    const auto& where = rig_.source.gridVertex;
    for (std::size_t s = 0; s < where.size(); ++s)
      if (where[s] >= 0) aim(s, where[s]);
    for (const auto& [vertex, place] : otherPlaces(rig_.source, cornerPlaces(rig_.source, grid_)))
      aim(static_cast<std::size_t>(vertex), place);
  }

  std::vector<Vec3> errorsOf(Index pose, const Coefficients& q) const {
    std::vector<Vec3> errors = grid_.positions(settled(restored(pose, q)));
    for (std::size_t v = 0; v < errors.size(); ++v) {
      errors[v] -= goals_[pose][v];
      if (pose > 0) errors[v] += neutralErrors_[v];
      if (!known_[v]) errors[v] = {};
    }
    return errors;
  }
  // What the square of a lean counts, in bits. The neutral's errors are in every pose, those of a
  // target only where it moves.
  double slopeWeight(Index pose) const {
    const double limit = angle_ * std::numbers::pi / 180;
    return (pose == 0 ? kNeutralBits : kTargetBits) / (limit * limit);
  }

  std::vector<Vec3> settled(std::vector<Vec3> stored) const {
    const std::size_t count = stored.size();
    stored.resize(rig_.surface.vectorCount());
    rig_.surface.settle(std::span(stored).first(count), stored);
    return stored;
  }

  Slopes slopesAt(Index pose, const Coefficients& q, const std::vector<Vec3>& fitted) const {
    std::vector<Vec3> off = restored(pose, q), form = fitted;
    for (std::size_t v = 0; v < q.size(); ++v) off[v] -= fitted[v];
    if (pose > 0)
      for (std::size_t v = 0; v < q.size(); ++v) form[v] += fittedNeutral_[v];
    off = settled(std::move(off));
    form = settled(std::move(form));
    std::vector<Vec3> whole = off;
    if (pose > 0)
      for (std::size_t v = 0; v < whole.size(); ++v) whole[v] += neutralOff_[v];
    return slopesOf(rig_.surface, grid_, known_, {form, off, whole}, 0.5 * tolerance_,
                    static_cast<float>(slopeWeight(pose)));
  }

  // The neutral leaves room for its poses, but no less than the fit itself needs.
  std::vector<float> neutralBounds() const {
    constexpr double kMore = 0.15, kMost = 0.98;
    const std::vector<Vec3> places = grid_.positions(settled(fittedNeutral_));
    std::vector<float> bounds(places.size(), static_cast<float>(kBound * tolerance_));
    for (std::size_t v = 0; v < places.size(); ++v)
      if (known_[v]) {
        const double needed = norm(places[v] - goals_[0][v]) / tolerance_ + kMore;
        bounds[v] = static_cast<float>(std::clamp(needed, kNeutralShare, kMost) * tolerance_);
      }
    return bounds;
  }

  static std::vector<Index> verticesBeyond(double bound, const std::vector<Vec3>& errors) {
    std::vector<Index> vertices;
    for (Index u = 0; u < static_cast<Index>(errors.size()); ++u)
      if (!(norm(errors[u]) <= bound)) vertices.push_back(u);
    return vertices;
  }

  // Finds the coefficients of a pose and puts what they say into the rig. Finer steps where the
  // bound cannot be met: in the end they are as good as the fit.
  bool settle(Index pose, const std::vector<float>& bounds) {
    Packing::Pose& form = rig_.packing.poses[pose];
    const Symmetry symmetry = codec::symmetryOf(form, pose);
    const std::vector<Vec3> fitted = rig_.vectorsOf(pose);
    // From its image, then from itself, in ever finer steps: those of its partner to begin with.
    bool done = false;
    int found = -1;  // how fine the steps are of the coefficients that were found last
    const bool symmetric = symmetry != Symmetry::none;
    const int coarsest = symmetry == Symmetry::partner ? rig_.packing.poses[form.image].finer : 0;
    for (int attempt = 0; !done; ++attempt) {
      form.finer = coarsest + (symmetric ? attempt / 2 : attempt);
      if (form.finer > kMostHalvings) break;
      const bool fromImage = symmetric && attempt % 2 == 0;
      PoseTask task;
      task.step = codec::stepOf(rig_.packing, pose);
      task.symmetry = symmetry;
      task.bounds = bounds;
      if (symmetry == Symmetry::partner) {
        task.expected.resize(fitted.size());
        for (const codec::Moved& m : codec::partnerOf(rig_.packing, *lattice_, poses_, pose))
          task.expected[m.vector] = m.steps;
      }
      Coefficients q = rounded(pose, form.finer < kFaithful ? fitted : compensated(fitted));
      if (fromImage) startFromImage(pose, task, fitted, q);
      if (!improveWithRoom(pose, task, fitted, q)) continue;
      done = unfold(pose, task, fitted, q) || form.finer >= kMostForFolds;
      poses_[pose] = std::move(q);
      found = form.finer;
    }
    if (found < 0) return false;
    form.finer = found;
    rig_.vectorsOf(pose) = restored(pose, poses_[pose]);
    return true;
  }

  // What brings a target to where the fit has it, the neutral being off.
  std::vector<Vec3> compensated(std::vector<Vec3> fitted) const {
    if (!neutralOff_.empty())
      for (std::size_t v = 0; v < fitted.size(); ++v) fitted[v] -= neutralOff_[v];
    return fitted;
  }

  // The vertices that are beyond their bounds then.
  std::vector<Index> improve(Index pose, PoseTask task, const std::vector<Vec3>& fitted,
                             Coefficients& q) const {
    task.errors = errorsOf(pose, q);
    task.slopes = slopesAt(pose, q, fitted);
    quantisePose(*lattice_, columns_, std::move(task), q);
    return verticesBeyond(tolerance_, errorsOf(pose, q));
  }

  // Vertices that end up beyond their bounds begin again with narrower ones, if they are few.
  // Whether none is left.
  bool improveWithRoom(Index pose, PoseTask& task, const std::vector<Vec3>& fitted,
                       Coefficients& q) const {
    constexpr int kTrials = 4;
    constexpr std::size_t kFew = 32;
    constexpr float kNarrower = 0.85f;
    const Coefficients first = q;
    for (int trial = 0; trial < kTrials; ++trial) {
      q = first;
      const std::vector<Index> beyond = improve(pose, task, fitted, q);
      if (beyond.empty()) return true;
      if (beyond.size() > kFew) break;
      for (const Index u : beyond) task.bounds[u] *= kNarrower;
    }
    return false;
  }

  // Where the surface turned over it goes back to the fit, and stays there; if that does not do,
  // tangents count more there. Whether it turns over nowhere then but where the fit or the neutral
  // does.
  bool unfold(Index pose, PoseTask& task, const std::vector<Vec3>& fitted, Coefficients& q) {
    constexpr int kRounds = 4;
    constexpr float kMore = 1.5f;
    const std::vector<Vec3> faithful = compensated(fitted);
    const std::vector<Index> own = foldsOf(pose, faithful);
    const auto foldsBeyond = [&](const Coefficients& trial) {
      std::vector<Index> folds = foldsOf(pose, restored(pose, trial));
      std::erase_if(folds, [&](Index quad) {
        return std::ranges::binary_search(own, quad) ||
               std::ranges::binary_search(neutralFolds_, quad);
      });
      return folds;
    };
    const Coefficients first = q;
    const std::vector<Index> before = foldsBeyond(q);
    const std::size_t few = own.size() / 8;
    std::size_t least = before.size();
    task.stress.assign(grid_.vertexCount(), 1);
    for (const bool stays : {true, false}) {
      Coefficients trial = first;
      std::vector<Index> folds = before;
      task.frozen.assign(stays ? q.size() : 0, 0);
      for (int round = 0; round < kRounds && least > few; ++round) {
        std::vector<Index> corners;
        for (const Index quad : folds)
          std::ranges::copy(folds_->corners(quad), std::back_inserter(corners));
        std::vector<Vec3> vectors = restored(pose, trial);
        for (const Index v : behind(corners)) {
          vectors[v] = faithful[v];
          if (stays) task.frozen[v] = 1;
        }
        if (!stays)
          for (const Index u : corners) task.stress[u] *= kMore;
        trial = rounded(pose, vectors);
        const bool met = improve(pose, task, fitted, trial).empty();
        folds = foldsBeyond(trial);
        if (met && folds.size() < least) least = folds.size(), q = trial;
      }
    }
    return least <= few;
  }

  // The stored vectors that the surface around vertices is made of.
  std::set<Index> behind(const std::vector<Index>& vertices) const {
    std::set<Index> stored;
    const auto add = [&](auto&& self, Index vector) -> void {
      if (vector < rig_.surface.storedCount()) {
        stored.insert(vector);
        return;
      }
      for (const Term& t : rig_.surface.derivation(vector)) self(self, t.vector);
    };
    for (const Index v : vertices)
      for (const Index vector : rig_.surface.weights(grid_.site(v)).vectors) add(add, vector);
    return stored;
  }

  // Coefficients tell what a pose does beyond what its bones carry.
  std::vector<Vec3> beyondBones(Index pose, const std::vector<Vec3>& vectors) const {
    return bones_.beyond(rig_.packing.poses[pose].carries, vectors);
  }
  Coefficients rounded(Index pose, const std::vector<Vec3>& vectors) const {
    return lattice_->round(pose, beyondBones(pose, vectors), codec::stepOf(rig_.packing, pose));
  }
  std::vector<Vec3> restored(Index pose, const Coefficients& q) const {
    std::vector<Vec3> vectors(q.size());
    lattice_->restore(pose, q, codec::stepOf(rig_.packing, pose), vectors);
    bones_.add(rig_.packing.poses[pose].carries, 1, vectors);
    return vectors;
  }

  // The quads that fold where a pose has these stored vectors beyond the neutral's.
  std::vector<Index> foldsOf(Index pose, std::vector<Vec3> vectors) const {
    if (pose > 0)
      for (std::size_t v = 0; v < vectors.size(); ++v) vectors[v] += rig_.neutral[v];
    return folds_->quads(settled(std::move(vectors)), source_.positionsOf(pose));
  }

  // The image, but where it is far off: there what the fit has.
  void startFromImage(Index pose, const PoseTask& task, const std::vector<Vec3>& fitted,
                      Coefficients& q) const {
    constexpr int kRounds = 3;
    constexpr double kFar = 2;  // tolerances
    symmetrise(q, task.symmetry, task.expected);
    std::vector<char> isFree(q.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Index> off = verticesBeyond(kFar * tolerance_, errorsOf(pose, q));
      if (off.empty()) return;
      for (const Index v : behind(off)) isFree[v] = 1;
      q = lattice_->round(pose, beyondBones(pose, fitted), task.step, std::move(q), isFree);
    }
  }

  void symmetrise(Coefficients& q, Symmetry symmetry, const Coefficients& expected) const {
    const auto& sites = lattice_->hierarchy().sites();
    const auto& images = lattice_->hierarchy().images();
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const CodedSite& site = sites[s];
      if (site.mirror < 0 || (symmetry == Symmetry::self && site.mirror >= s)) continue;
      for (Index v = site.first; v < site.first + site.count; ++v) {
        if (images[v].vector < 0) continue;
        q[v] = symmetry == Symmetry::partner
                   ? expected[v]
                   : codec::reflected(q[images[v].vector], images[v].sign, lattice_->axis());
      }
    }
  }

  Rig& rig_;
  const MeshRig& source_;
  double tolerance_, angle_;
  const std::function<bool(double)>& proceed_;
  Tessellation grid_;
  std::optional<Lattice> lattice_;
  codec::Bones bones_;
  Columns columns_;
  std::optional<FoldFinder> folds_;
  std::vector<Index> neutralFolds_;  // quads, in order
  std::vector<Coefficients> poses_;
  std::vector<std::vector<Vec3>> goals_;  // [poses][vertices] the neutral, then differences
  std::vector<char> known_;               // [vertices] that a source vertex stands for
  std::vector<Vec3> neutralErrors_, fittedNeutral_;
  std::vector<Vec3> neutralOff_;  // settled: how far the neutral is off the fit
};

}  // namespace

Result<void> quantise(Rig& rig, const MeshRig& source, double tolerance, double angle,
                      const std::function<bool(double)>& proceed) {
  return Quantiser(rig, source, tolerance, angle, proceed).run();
}

}  // namespace sweepface
