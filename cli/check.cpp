#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <random>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/gltf.hpp"

#include "command.hpp"
#include "output.hpp"
#include "parallel.hpp"

namespace sweepface::cli {
namespace {

struct CheckArguments {
  std::string face;
  bool quiet = false, json = false;
};

void addOptions(CLI::App& app, CheckArguments& a) {
  addFace(app, a.face);
  addQuiet(app, a.quiet);
  addJson(app, a.json);
  app.footer(
      "\nLooks at the neutral, at every target and at a random mixture of all. Ends with 1 and "
      "names what is\nbroken if there is a gap between patches, a kink where there must be "
      "none, a number that is\nnot finite, or a scene that does not fit the face.\n\nExample:\n  "
      "sweepface check face.sweep");
}

// What rounding may cause in a sound file: gaps in units of the model's size, jumps of derivatives
// relative to the largest one.
constexpr double kLargestGap = 1e-12, kLargestJump = 1e-9;
constexpr int kSamples = 5;
constexpr std::array kClassNames{"boundary", "C2", "spoke", "crease"};

/// Problems are reported within a sentence.
std::string withoutPeriod(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// An expression to examine.
struct Pose {
  std::string name;
  Weights weights;
};

std::vector<Pose> posesOf(const Rig& rig) {
  std::vector<Pose> poses{{"the neutral", rig.weightsOf(0)}};
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    poses.push_back({rig.targets[k].name, rig.weightsOf(static_cast<Index>(k) + 1)});
  if (rig.targets.empty()) return poses;
  Weights mixture;
  std::mt19937 random(1);
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    mixture.push_back(static_cast<double>(random()) / static_cast<double>(std::mt19937::max()));
  poses.push_back({"a mixture of all targets", mixture});
  return poses;
}

/// Gaps are in units of the pose's own size.
struct PoseJoins {
  bool finite = true;
  std::vector<JoinReport> joins;
};

/// The diagonal, or the largest distance from the origin if that is more: far from the origin,
/// numbers are coarser than the model's size suggests.
double sizeOf(const Tessellation& grid, const std::vector<Vec3>& vectors) {
  const std::vector<Vec3> places = grid.positions(vectors);
  double size = norm(Box(places).size());
  for (const Vec3& p : places) size = std::max(size, norm(p));
  return size > 0 ? size : 1;
}

PoseJoins lookAt(const Rig& rig, const Tessellation& grid, const Pose& pose) {
  const std::vector<Vec3> vectors = blend(rig, pose.weights);
  PoseJoins result;
  result.finite = std::ranges::all_of(vectors, isFinite);
  if (!result.finite) return result;
  result.joins = examineJoins(rig.surface, vectors, kSamples);
  const double size = sizeOf(grid, vectors);
  for (JoinReport& join : result.joins) {
    join.positionGap /= size;
    // Finite numbers may still be too large to compute with.
    result.finite &= std::isfinite(join.positionGap) && std::isfinite(join.firstJump) &&
                     std::isfinite(join.secondJump);
  }
  result.finite &= std::isfinite(size);
  if (!result.finite) result.joins.clear();
  return result;
}

class Checker {
 public:
  explicit Checker(const Rig& rig) : rig_(rig), poses_(posesOf(rig)) {}

  void run(bool quiet) {
    ProgressBar bar(quiet);
    const Tessellation grid(rig_.surface, 1);
    std::vector<PoseJoins> looks(poses_.size());
    std::atomic<std::size_t> done = 0;
    parallelFor(std::size_t{0}, poses_.size(), [&](std::size_t k) {
      looks[k] = lookAt(rig_, grid, poses_[k]);
      bar.show("checking", static_cast<double>(++done) / static_cast<double>(poses_.size()));
    });
    for (std::size_t k = 0; k < looks.size(); ++k) judge(poses_[k].name, looks[k]);
    if (auto ok = checkScene(rig_); !ok) problems_.push_back(withoutPeriod(ok.error().message));
    for (const JoinReport& join : looks[0].joins)
      if (!join.collapsed) neutral_[static_cast<std::size_t>(join.joinClass)].add(join);
  }

  const std::vector<std::string>& problems() const { return problems_; }
  nlohmann::ordered_json report(const std::string& file) const;
  void print(const std::string& file) const;

 private:
  void judge(const std::string& pose, const PoseJoins& look) {
    if (!look.finite)
      problems_.push_back(fmt::format("{} has numbers that are not finite, or too large", pose));
    Joint gap, first, second;
    for (std::size_t a = 0; a < look.joins.size(); ++a) {
      const JoinReport& join = look.joins[a];
      if (join.collapsed) continue;
      all_[static_cast<std::size_t>(join.joinClass)].add(join);
      gap.see(a, join.positionGap);
      if (join.joinClass != JoinClass::c2) continue;
      first.see(a, join.firstJump);
      second.see(a, join.secondJump);
    }
    report(pose, gap, kLargestGap,
           "the patches beside arc {} come apart by {:.2g} of the model's size");
    report(pose, first, kLargestJump,
           "the first derivative jumps across arc {} by {:.2g} of the largest");
    report(pose, second, kLargestJump,
           "the second derivative jumps across arc {} by {:.2g} of the largest");
  }

  /// The arc where something is largest.
  struct Joint {
    std::size_t arc = 0;
    double value = 0;
    void see(std::size_t a, double x) {
      if (!std::isnan(value) && !(x <= value)) arc = a, value = x;
    }
  };

  void report(const std::string& pose, const Joint& worst, double limit, fmt::string_view what) {
    if (worst.value <= limit) return;
    problems_.push_back(pose + ": " + fmt::format(fmt::runtime(what), worst.arc, worst.value));
  }

  std::ptrdiff_t nodes(NodeKind kind) const {
    return std::ranges::count(rig_.surface.connectivity().kinds, kind);
  }
  double totalLength() const {
    double sum = 0;
    for (const JoinSummary& c : neutral_) sum += c.length;
    return sum > 0 ? sum : 1;
  }

  const Rig& rig_;
  std::vector<Pose> poses_;
  std::array<JoinSummary, kClassNames.size()> neutral_, all_;  // in the neutral and in all poses
  std::vector<std::string> problems_;
};

nlohmann::ordered_json Checker::report(const std::string& file) const {
  nlohmann::ordered_json joins;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const JoinSummary &rest = neutral_[k], &c = all_[k];
    auto& join = joins[kClassNames[k]];
    join = {{"count", rest.count},
            {"length", rest.length},
            {"lengthShare", rest.length / totalLength()}};
    if (static_cast<JoinClass>(k) == JoinClass::boundary) continue;
    join.update({{"positionGap", c.positionGap},
                 {"firstJump", c.firstJump},
                 {"secondJump", c.secondJump},
                 {"normalJumpMax", c.normalJump},
                 {"normalJumpRms", c.normalRms()}});
  }
  return {{"file", file},
          {"sound", problems_.empty()},
          {"problems", problems_},
          {"poses", poses_.size()},
          {"fullNodes", nodes(NodeKind::crossing)},
          {"irregularNodes", nodes(NodeKind::irregular)},
          {"hangingNodes", nodes(NodeKind::hanging)},
          {"creasedNodes", nodes(NodeKind::creased)},
          {"ribbons", rig_.surface.wireframe().ribbons.size()},
          {"joins", joins}};
}

void Checker::print(const std::string& file) const {
  fmt::print("{}: {}\n", file, problems_.empty() ? "sound" : "broken");
  fmt::print("  {} poses: the neutral, {} targets{}\n", poses_.size(), rig_.targets.size(),
             rig_.targets.empty() ? "" : " and a mixture of all");
  fmt::print("  nodes: {} full, {} irregular, {} hanging (T-nodes){}\n", nodes(NodeKind::crossing),
             nodes(NodeKind::irregular), nodes(NodeKind::hanging),
             nodes(NodeKind::creased) ? fmt::format(", {} creased", nodes(NodeKind::creased)) : "");
  fmt::print("  ribbons: {}, all with shape parameters that the equation allows\n",
             rig_.surface.wireframe().ribbons.size());
  fmt::print("\n  {:<9} {:>7} {:>11} {:>7}   {:>9} {:>9} {:>9} {:>9} {:>9}\n", "joins", "count",
             "length", "share", "gap", "1st jump", "2nd jump", "max angle", "RMS angle");
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const JoinSummary &rest = neutral_[k], &c = all_[k];
    fmt::print("  {:<9} {:>7} {:>11.4f} {:>5.1f} %", kClassNames[k], rest.count, rest.length,
               100 * rest.length / totalLength());
    const auto digits = [](double angle) { return angle < 99.5 ? 2 : 3; };
    if (static_cast<JoinClass>(k) != JoinClass::boundary)
      fmt::print("   {:>9.1e} {:>9.1e} {:>9.1e} {:>7.{}g} ° {:>7.{}g} °", c.positionGap,
                 c.firstJump, c.secondJump, c.normalJump, digits(c.normalJump), c.normalRms(),
                 digits(c.normalRms()));
    fmt::print("\n");
  }
}

Result<int> runCheck(const CheckArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  Checker checker(*rig);
  checker.run(a.quiet);
  if (a.json)
    printJson(checker.report(a.face));
  else if (!a.quiet)
    checker.print(a.face);
  std::fflush(stdout);
  const auto& problems = checker.problems();
  if (problems.empty()) return 0;
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(most, problems.size()); ++k)
    printError(fmt::format("{} is broken: {}.", a.face, problems[k]));
  if (problems.size() > most) printError(fmt::format("And {} more.", problems.size() - most));
  return 1;
}

}  // namespace

Command addCheck(CLI::App& tool) {
  return makeCommand(tool, "check", "Test that a face is watertight, smooth and finite", runCheck);
}

}  // namespace sweepface::cli
