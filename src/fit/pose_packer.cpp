#include "fit/pose_packer.hpp"

#include <algorithm>
#include <optional>

#include "fit/pose_quantiser.hpp"

namespace sweepface {

using codec::CodedSite;
using codec::Coefficients;
using codec::Symmetry;

namespace {

constexpr int kMostHalvings = 8;
// From this many halvings on, a target starts from the fit's absolute pose, whatever that costs.
constexpr int kFaithful = 2;
// Steps are halved at most this often for the sake of folds alone.
constexpr int kMostForFolds = 2;

class PosePacker {
 public:
  PosePacker(PackedPoses& poses, Index pose, const std::vector<float>& bounds,
             const std::function<bool()>& goesOn)
      : goesOn_(goesOn),
        poses_(poses),
        pose_(pose),
        form_(poses.form(pose)),
        symmetry_(codec::symmetryOf(form_, pose)),
        bounds_(bounds) {}

  // Searches from the pose's image, then from the pose itself, in ever finer steps, which begin
  // with those of its partner. The finest are as good as the fit.
  bool run() {
    bool done = false;
    form_.finer = symmetry_ == Symmetry::partner ? poses_.form(form_.image).finer : 0;
    for (; !done && form_.finer <= kMostHalvings; ++form_.finer) {
      if (symmetry_ != Symmetry::none) done = search(Start::image);
      if (!done) done = search(Start::fit);
    }
    if (!found_ || !goesOn_()) return false;
    form_.finer = foundFiner_;
    poses_.keep(pose_, std::move(*found_));
    return true;
  }

 private:
  enum class Start { image, fit };

  // Returns whether the result needs no finer steps.
  bool search(Start start) {
    task_ = {};
    task_.step = poses_.step(pose_);
    task_.symmetry = symmetry_;
    if (symmetry_ == Symmetry::partner) task_.expected = poses_.expected(pose_);
    task_.bounds = bounds_;
    q_ = poses_.rounded(pose_,
                        form_.finer < kFaithful ? poses_.fitted(pose_) : poses_.compensated(pose_));
    if (start == Start::image) startFromImage();
    if (!improveWithRoom()) return false;
    const bool isGood = unfold();
    found_ = q_;
    foundFiner_ = form_.finer;
    return isGood || form_.finer >= kMostForFolds;
  }

  // Starts from the image, except where it is far off: there from the fit.
  void startFromImage() {
    constexpr int kRounds = 3;
    constexpr double kFar = 2;  // tolerances
    symmetrise();
    std::vector<char> isFree(q_.size(), 0);
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Index> off = verticesBeyond(kFar * poses_.tolerance(), q_);
      if (off.empty()) return;
      for (const Index v : poses_.behind(off)) isFree[v] = 1;
      q_ = poses_.rounded(pose_, poses_.fitted(pose_), std::move(q_), isFree);
    }
  }

  void symmetrise() {
    const auto& sites = poses_.lattice().hierarchy().sites();
    const auto& images = poses_.lattice().hierarchy().images();
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const CodedSite& site = sites[s];
      if (site.mirror < 0 || (symmetry_ == Symmetry::self && site.mirror >= s)) continue;
      for (Index v = site.first; v < site.first + site.count; ++v) {
        if (images[v].vector < 0) continue;
        q_[v] =
            symmetry_ == Symmetry::partner
                ? task_.expected[v]
                : codec::reflected(q_[images[v].vector], images[v].sign, poses_.lattice().axis());
      }
    }
  }

  // If a few vertices end up beyond the tolerance, begins again with narrower bounds there. Returns
  // whether none is left.
  bool improveWithRoom() {
    constexpr int kTrials = 4;
    constexpr std::size_t kFew = 32;
    constexpr float kNarrower = 0.85f;
    const Coefficients first = q_;
    for (int trial = 0; trial < kTrials && goesOn_(); ++trial) {
      q_ = first;
      const std::vector<Index> beyond = improve(q_);
      if (beyond.empty()) return true;
      if (beyond.size() > kFew) break;
      for (const Index u : beyond) task_.bounds[u] *= kNarrower;
    }
    return false;
  }

  // Quantises and returns the vertices that are then beyond the tolerance.
  std::vector<Index> improve(Coefficients& q) const {
    const std::vector<Vec3> vectors = poses_.restored(pose_, q);
    PoseTask task = task_;
    task.errors = poses_.errors(pose_, vectors);
    task.slopes = poses_.slopes(pose_, vectors);
    quantisePose(poses_.lattice(), poses_.columns(), std::move(task), q, goesOn_);
    return verticesBeyond(poses_.tolerance(), q);
  }

  std::vector<Index> verticesBeyond(double bound, const Coefficients& q) const {
    const std::vector<Vec3> errors = poses_.errors(pose_, poses_.restored(pose_, q));
    std::vector<Index> vertices;
    for (Index u = 0; u < static_cast<Index>(errors.size()); ++u)
      if (!(norm(errors[u]) <= bound)) vertices.push_back(u);
    return vertices;
  }

  // Where the surface turned over, it goes back to the fit and stays there; if that is not enough,
  // tangents count more there. Returns whether hardly any folds are left besides those of the fit
  // and of the neutral.
  bool unfold() {
    constexpr int kRounds = 4;
    const std::vector<Vec3> fit = poses_.compensated(pose_);
    const std::vector<Index> own = poses_.folds(pose_, fit);
    const Coefficients first = q_;
    const std::vector<Index> before = foldsBeyond(own, first);
    const std::size_t few = own.size() / 8;
    std::size_t least = before.size();
    task_.stress.assign(poses_.vertexCount(), 1);
    for (const bool stays : {true, false}) {
      Coefficients trial = first;
      std::vector<Index> folds = before;
      task_.frozen.assign(stays ? q_.size() : 0, 0);
      for (int round = 0; round < kRounds && least > few && goesOn_(); ++round) {
        trial = backToFit(fit, poses_.corners(folds), trial);
        const bool met = improve(trial).empty();
        folds = foldsBeyond(own, trial);
        if (met && folds.size() < least) least = folds.size(), q_ = trial;
      }
    }
    return least <= few;
  }

  std::vector<Index> foldsBeyond(const std::vector<Index>& own, const Coefficients& q) const {
    std::vector<Index> folds = poses_.folds(pose_, poses_.restored(pose_, q));
    std::erase_if(folds, [&](Index quad) {
      return std::ranges::binary_search(own, quad) ||
             std::ranges::binary_search(poses_.neutralFolds(), quad);
    });
    return folds;
  }

  // Puts the vectors around these vertices back to the fit. Freezes them, or, if nothing is to be
  // frozen, lets tangents count more there.
  Coefficients backToFit(const std::vector<Vec3>& fit, const std::vector<Index>& vertices,
                         const Coefficients& q) {
    constexpr float kMore = 1.5f;
    std::vector<Vec3> vectors = poses_.restored(pose_, q);
    for (const Index v : poses_.behind(vertices)) {
      vectors[v] = fit[v];
      if (!task_.frozen.empty()) task_.frozen[v] = 1;
    }
    if (task_.frozen.empty())
      for (const Index u : vertices) task_.stress[u] *= kMore;
    return poses_.rounded(pose_, vectors);
  }

  const std::function<bool()>& goesOn_;
  PackedPoses& poses_;
  Index pose_;
  Packing::Pose& form_;
  Symmetry symmetry_;
  const std::vector<float>& bounds_;
  PoseTask task_;
  Coefficients q_;
  std::optional<Coefficients> found_;
  int foundFiner_ = 0;
};

}  // namespace

bool packPose(PackedPoses& poses, Index pose, const std::vector<float>& bounds,
              const std::function<bool()>& goesOn) {
  return PosePacker(poses, pose, bounds, goesOn).run();
}

}  // namespace sweepface
