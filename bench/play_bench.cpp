// The Evaluator against kernels that blend morph targets: the same face, the same weights, and new
// weights every frame.
#include "play_bench.hpp"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <optional>
#include <random>

#include "sweepface/evaluator.hpp"

#include "add.hpp"
#include "bench_face.hpp"
#include "give_up.hpp"
#include "peers.hpp"

namespace sweepface::bench {
namespace {

constexpr int kFrames = 16, kRigs = 64;
constexpr double kNormalDrop = 0.005;

using Frames = std::vector<Weights>;

Frames someFrames(Active active) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.05, 1);
  const std::size_t targets = face().targets.size();
  Frames frames(kFrames, Weights(targets, 0.0));
  for (Weights& weights : frames) {
    std::vector<std::size_t> order(targets);
    for (std::size_t k = 0; k < targets; ++k) order[k] = k;
    std::ranges::shuffle(order, random);
    const std::size_t count = active == Active::all ? targets : std::min<std::size_t>(10, targets);
    for (std::size_t k = 0; k < count; ++k) weights[order[k]] = uniform(random);
  }
  return frames;
}

const Frames& frames(Active active) {
  static const Frames all = someFrames(Active::all), ten = someFrames(Active::ten);
  return active == Active::all ? all : ten;
}

Evaluator makeEvaluator(bool normals, Index level = 0) {
  EvaluatorOptions options;
  options.normals = normals;
  options.level = level;
  return orEnd(Evaluator::make(face(), options));
}

/// As close to the surface as half the source's vertices allow; nothing if the face has more
/// corners than that.
std::optional<Evaluator> makeHalf() {
  const double vertices = static_cast<double>(face().source.gridVertex.size()) / 2;
  const auto density =
      densityFor(face().surface, blend(face(), {}), {Budget::Kind::vertices, vertices});
  if (!density) return {};
  const Tessellation grid(face().surface, *density);
  return std::move(*Evaluator::make(face(), grid, {.level = 1}));
}

/// Something that turns weights into vertices.
struct Player {
  std::string name;
  std::size_t bytes = 0;
  std::function<void(const Weights&, float*)> play;
};

Player evaluatorPlayer(const Evaluator& evaluator, bool normals, bool cold = false) {
  auto scratch = std::make_shared<std::vector<std::byte>>(evaluator.scratchBytes());
  const Index count = evaluator.vertexCount();
  return {"evaluator", evaluator.positionBytes() + (normals ? evaluator.normalBytes() : 0),
          [evaluator, scratch, count, normals, cold](const Weights& weights, float* out) {
            Evaluation job;
            job.evaluator = &evaluator;
            job.weights = weights;
            job.scratch = *scratch;
            job.positions = {out, count};
            job.cold = cold;
            if (normals) job.normals = {out + 3 * std::size_t(count), count};
            job.run();
          }};
}

std::vector<Floats> joined(std::vector<Floats> a, const std::vector<Floats>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k].insert(a[k].end(), b[k].begin(), b[k].end());
  return a;
}

Player peerPlayer(PeerKind kind, bool normals, double drop, double normalDrop) {
  const Morphs& m = morphs();
  std::vector<float> drops(m.floats(), static_cast<float>(drop));
  if (normals) drops.resize(2 * m.floats(), static_cast<float>(normalDrop));
  const Peer peer = normals ? makePeer(kind, joined({m.neutral}, {m.neutralNormals})[0],
                                       joined(m.differences, m.normalDifferences), drops)
                            : makePeer(kind, m.neutral, m.differences, drops);
  const std::size_t floats = m.floats();
  return {peer.name, peer.data.bytes(),
          [peer, normals, floats](const Weights& weights, float* out) {
            peer.run(peer.data, weights.data(), out);
            if (normals) normalise(out + floats, floats / 3);
          }};
}

// Aligned to cache lines, which kernels that add to their output need most.
Aligned<float> roomForOutput() { return Aligned<float>(2 * morphs().floats() + 2 * kChunk); }

/// How far positions are at most from the morph targets' exact blend, over all targets, each alone
/// at weight 1.
double worstTarget(const Player& player) {
  const Aligned<float> out = roomForOutput();
  Weights weights(face().targets.size(), 0.0);
  double most = 0;
  for (double& weight : weights) {
    weight = 1;
    player.play(weights, out.data());
    const float* const found = out.data();
    const auto exact = exactBlend(morphs().neutral, morphs().differences, weights);
    for (std::size_t v = 0; v < exact.size(); v += 3)
      most = std::max(most, std::hypot(found[v] - exact[v], found[v + 1] - exact[v + 1],
                                       found[v + 2] - exact[v + 2]));
    weight = 0;
  }
  return most;
}

void playWarm(benchmark::State& state, const Player& player, Active active) {
  const Aligned<float> out = roomForOutput();
  const Frames& wanted = frames(active);
  std::size_t frame = 0;
  for (auto _ : state) {
    player.play(wanted[frame++ % kFrames], out.data());
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = static_cast<double>(player.bytes);
}

/// Many faces one after the other, so that none is in the cache when its turn comes.
void playCold(benchmark::State& state, const std::function<Player()>& make) {
  std::vector<Player> players;
  for (int k = 0; k < kRigs; ++k) players.push_back(make());
  const Aligned<float> out = roomForOutput();
  const Frames& wanted = frames(Active::all);
  std::size_t frame = 0;
  for (auto _ : state) {
    players[frame % kRigs].play(wanted[frame % kFrames], out.data());
    ++frame;
    benchmark::ClobberMemory();
  }
}

void addWarm(const std::string& group, const Player& player, Active active) {
  add(group + "/" + player.name, [=](benchmark::State& state) { playWarm(state, player, active); });
}

/// Adds the kernels to compare with: keeping every difference above a hundredth of a millimetre (if
/// the tolerance is 0.153), or dropping what the evaluator drops as well.
void addPeers(bool equalError) {
  const double drop = (equalError ? 0.3 : 0.065) * face().tolerance;
  const double normalDrop = equalError ? 2 * kNormalDrop : kNormalDrop;
  const std::string suffix = equalError ? "-equal" : "";
  for (const PeerKind kind : kPeerKinds) {
    const Player plain = peerPlayer(kind, false, drop, 0);
    fmt::print("{}{}: {:.5f} off at worst, {} bytes\n", plain.name, suffix, worstTarget(plain),
               plain.bytes);
    addWarm("all" + suffix, plain, Active::all);
    addWarm("ten" + suffix, plain, Active::ten);
    addWarm("normals" + suffix, peerPlayer(kind, true, drop, normalDrop), Active::all);
    if (kind != PeerKind::dense32 && kind != PeerKind::sparse32)
      add("cold" + suffix + "/" + plain.name, [=](benchmark::State& state) {
        playCold(state, [&] { return peerPlayer(kind, false, drop, 0); });
      });
  }
}

}  // namespace

void registerPlayers() {
  if (face().targets.size() > kMostTargets)
    giveUp(fmt::format("The face has {} targets; the kernels take {} at most.",
                       face().targets.size(), kMostTargets));
  if (morphs().floats() > kMostFloats)
    giveUp(fmt::format("The face has {} vertices; the kernels take {} at most.",
                       morphs().floats() / 3, kMostFloats / 3));
  static const Evaluator evaluator = makeEvaluator(true);
  const Player plain = evaluatorPlayer(evaluator, false);
  const double off = worstTarget(plain);
  fmt::print("evaluator: {:.5f} off at worst, {} bytes\n", off, plain.bytes);
  // Beyond its tolerance it is not worth comparing; what the evaluator drops comes on top.
  if (!(off <= 1.31 * face().tolerance))
    giveUp(
        fmt::format("The evaluator is {} off, more than the tolerance {}.", off, face().tolerance));
  addWarm("all", plain, Active::all);
  addWarm("ten", plain, Active::ten);
  addWarm("normals", evaluatorPlayer(evaluator, true), Active::all);
  if (!face().source.gridVertex.empty()) {
    static const std::optional<Evaluator> half = makeHalf();
    if (half) {
      fmt::print("half: {} vertices, {} bytes, {} more with normals\n", half->vertexCount(),
                 half->positionBytes(), half->normalBytes());
      addWarm("half", evaluatorPlayer(*half, false), Active::all);
      addWarm("halfNormals", evaluatorPlayer(*half, true), Active::all);
    }
  }
  add("cold/evaluator", [](benchmark::State& state) {
    playCold(state, [] { return evaluatorPlayer(makeEvaluator(false), false, true); });
  });
  addPeers(false);
  addPeers(true);
}

void Ratios::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
    const std::string name = run.run_name.function_name;
    const auto slash = name.find('/');
    if (slash == std::string::npos) continue;
    Figures& figures = groups_[name.substr(0, slash)][name.substr(slash + 1)];
    figures.seconds.push_back(run.GetAdjustedCPUTime());
    if (const auto bytes = run.counters.find("bytes"); bytes != run.counters.end())
      figures.bytes = bytes->second.value;
  }
}

double Ratios::Figures::median() const {
  std::vector<double> sorted = seconds;
  std::ranges::sort(sorted);
  return sorted[sorted.size() / 2];
}

const std::pair<const std::string, Ratios::Figures>* Ratios::fastestPeer(
    const std::string& group) const {
  const auto found = groups_.find(group);
  if (found == groups_.end()) return nullptr;
  const std::pair<const std::string, Figures>* best = nullptr;
  for (const auto& entry : found->second)
    if (entry.first != "evaluator" && (!best || entry.second.median() < best->second.median()))
      best = &entry;
  return best;
}

std::string Ratios::line(const std::string& suffix) const {
  std::string line;
  for (const std::string group : {"all", "ten", "normals", "cold"}) {
    const auto ours = groups_.find(group);
    const auto* peer = fastestPeer(group + suffix);
    if (ours == groups_.end() || !ours->second.contains("evaluator") || !peer) continue;
    line += fmt::format("{}={:.2f} ", group,
                        ours->second.at("evaluator").median() / peer->second.median());
  }
  const auto all = groups_.find("all");
  if (const auto* peer = fastestPeer("all" + suffix);
      peer && all != groups_.end() && all->second.contains("evaluator"))
    line += fmt::format("memory={:.2f}", all->second.at("evaluator").bytes / peer->second.bytes);
  return line;
}

}  // namespace sweepface::bench
