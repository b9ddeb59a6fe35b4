// Moves the control curves beside a boundary curve. If both move by constants, the derivatives
// across change by constants all along the curve: at its ends by just these, while mixed
// derivatives do not change, since the basis reproduces constants. Irregular nodes approximate that
// as closely as they can.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "sweepface/edit.hpp"

#include "edit/affected.hpp"
#include "edit/checks.hpp"
#include "edit/rest.hpp"
#include "surface/inward.hpp"
#include "surface/stored_jets.hpp"

namespace sweepface {

namespace {

/// The change at one end of the curve: the derivatives across are those by α at the corner where
/// the curve arrives, by β where it leaves.
struct CornerChange {
  Index corner = -1;
  bool byAlpha = false;
};

class ControlMover {
 public:
  ControlMover(const Rig& rig, const ControlMove& move) : rig_(rig), move_(move) {}

  /// The changed rig, and the patches that the change affects.
  Result<std::pair<Rig, Patches>> run(Index target) {
    if (auto ok = findEnds(); !ok) return std::unexpected(ok.error());
    if (move_.second == Vec3{} && move_.third == Vec3{})
      return std::pair(std::move(rig_), Patches{});
    if (auto ok = findDerivatives(); !ok) return std::unexpected(ok.error());
    if (target < 0) edit::keepRest(rig_);
    if (auto ok = storeWholeJets(); !ok) return std::unexpected(ok.error());
    edit::Affected affected(rig_.surface);
    auto& pose = target < 0 ? rig_.neutral : rig_.targets[target].difference;
    const std::span<const CornerChange> ends(ends_);
    if (ends.size() == 2 && nodeAt(ends[0]) == nodeAt(ends[1]))
      change(ends, pose, affected);  // closed: what both ends share changes once
    else
      for (std::size_t k = 0; k < ends.size(); ++k) change(ends.subspan(k, 1), pose, affected);
    const StoredJets jets(rig_.surface);
    for (Index node : rewritten_)
      for (int k = 1; k < 9; ++k) affected.addVector(jets.at(node, k));
    Patches patches = affected.patches();
    if (patches.empty())
      return fail("Nothing stored moves the control curves of curve " + curveName() +
                  "; move its nodes.");
    return std::pair(std::move(rig_), std::move(patches));
  }

 private:
  const Connectivity& connectivity() const { return rig_.surface.connectivity(); }
  std::string curveName() const { return "'" + rig_.nameOf(Thing::curve, move_.curve) + "'"; }
  std::string patchName() const { return "'" + rig_.nameOf(Thing::patch, move_.patch) + "'"; }

  Index nodeAt(const CornerChange& end) const { return connectivity().cornerNode[end.corner]; }

  Result<void> findEnds() {
    const Connectivity& c = connectivity();
    const HalfArc forward = 2 * move_.curve;
    half_ = c.patchOf[forward] == move_.patch ? forward : twin(forward);
    if (c.patchOf[half_] != move_.patch)
      return fail("Curve " + curveName() + " does not bound patch " + patchName() +
                  "; name a patch on either side of it.");
    if (rig_.surface.wireframe().arcs[move_.curve].collapsed)
      return fail("Curve " + curveName() + " is one point; nothing runs beside it.");
    if (auto ends = endsOf(rig_, move_.curve); !ends) return std::unexpected(ends.error());
    const HalfArc first = twin(c.rails[twin(half_)].last), last = c.rails[half_].last;
    for (const CornerChange& end :
         {CornerChange{c.cornerAt[first], false}, CornerChange{c.cornerAt[c.next[last]], true}})
      if (!isTip(end.corner)) ends_.push_back(end);
    return {};
  }

  bool isTip(Index corner) const {
    const Star& star = connectivity().stars[connectivity().cornerNode[corner]];
    const std::size_t sector = connectivity().cornerSector[corner];
    const auto collapsed = [&](std::size_t arm) {
      return rig_.surface.wireframe().arcs[arcOf(star.arms[arm % star.arms.size()])].collapsed;
    };
    return collapsed(sector) || collapsed(sector + 1);
  }

  // Computes by how much the derivatives across change, per source edge.
  Result<void> findDerivatives() {
    const Inward way(rig_.surface, half_);
    edgesAcross_ = way.edges;
    edgesAlong_ = way.alongV ? rig_.surface.edgesU(move_.patch) : rig_.surface.edgesV(move_.patch);
    const auto across = derivativesFromControls({}, move_.second, move_.third, kControlSpacing);
    if (!across) return std::unexpected(across.error());
    first_ = across->first * (1 / edgesAcross_);
    second_ = across->second * (1 / (edgesAcross_ * edgesAcross_));
    return {};
  }

  // Makes the nodes at the ends store what they predict, so that it can be changed.
  Result<void> storeWholeJets() {
    Wireframe wireframe = rig_.surface.wireframe();
    for (const CornerChange& end : ends_) {
      const Index node = connectivity().cornerNode[end.corner];
      if (connectivity().kinds[node] != NodeKind::crossing) continue;
      if (wireframe.nodes[node].stored != kWholeJet) rewritten_.push_back(node);
      wireframe.nodes[node].stored = kWholeJet;
    }
    if (rewritten_.empty()) return {};
    auto surface = Surface::make(std::move(wireframe));
    if (!surface) return std::unexpected(surface.error());
    rig_.neutral = restored(*surface, rig_.neutral);
    if (auto& rest = rig_.packing.rest; !rest.empty()) rest = restored(*surface, rest);
    for (Target& target : rig_.targets) target.difference = restored(*surface, target.difference);
    rig_.surface = std::move(*surface);
    return {};
  }

  // The stored vectors of a pose for the same surface with more of its vectors stored.
  std::vector<Vec3> restored(const Surface& surface, const std::vector<Vec3>& stored) const {
    std::vector<Vec3> vectors(rig_.surface.vectorCount()), result;
    rig_.surface.settle(stored, vectors);
    const StoredJets jets(rig_.surface);
    for (Index v = 0; v < surface.storedCount(); ++v) {
      const auto [node, i, j, fan] = surface.stored(v);
      Index source = jets.at(node, 3 * i + j, fan);
      if (source < 0) source = predicted(node, i, j);
      result.push_back(vectors[source]);
    }
    return result;
  }
  // A crossing's own axes are those of the corner in its first sector.
  Index predicted(Index node, int i, int j) const {
    const Index corner = connectivity().stars[node].sectors[0];
    return rig_.surface.cornerJet(corner / 4, corner % 4, i, j).vector;
  }

  // Changes a pose at the ends that meet at one node.
  void change(std::span<const CornerChange> ends, std::vector<Vec3>& pose,
              edit::Affected& affected) const {
    if (connectivity().kinds[nodeAt(ends[0])] != NodeKind::crossing)
      return solve(ends, pose, affected);
    std::set<Index> changed;
    for (const CornerChange& end : ends)
      for (int order = 1; order <= 2; ++order) {
        const JetRef ref = rig_.surface.cornerJet(end.corner / 4, end.corner % 4,
                                                  end.byAlpha ? order : 0, end.byAlpha ? 0 : order);
        if (!changed.insert(ref.vector).second) continue;
        pose[ref.vector] += ref.sign * (order == 1 ? first_ : second_);
        affected.addVector(ref.vector);
      }
  }

  // For corners whose derivatives are sums of stored vectors. Finds the smallest change that gives
  // the derivatives across their wanted values and leaves the others, up to the second order,
  // alone. At irregular nodes, whose corners share a few vectors, that would produce mixed
  // derivatives that throw the curves far off. There it finds the change that keeps the curve in
  // place and moves the controls beside it as nearly as possible as wanted, all along the curve.
  void solve(std::span<const CornerChange> ends, std::vector<Vec3>& pose,
             edit::Affected& affected) const {
    Rows rows;
    for (const CornerChange& end : ends)
      if (connectivity().kinds[nodeAt(end)] == NodeKind::irregular)
        addPlaces(end, rows);
      else
        addDerivatives(end, rows);
    std::set<Index> stored;
    for (const Row& row : rows)
      for (const auto& [v, factor] : row.sum) stored.insert(v);
    const std::vector<Index> unknowns(stored.begin(), stored.end());
    const auto height = static_cast<Index>(rows.size()),
               width = static_cast<Index>(unknowns.size());
    if (width == 0) return;
    Eigen::MatrixXd composed = Eigen::MatrixXd::Zero(height, width);
    Eigen::MatrixXd wanted(height, 3);
    for (Index r = 0; r < height; ++r) {
      const Row& row = rows[r];
      wanted.row(r) << row.wanted.x, row.wanted.y, row.wanted.z;
      for (Index k = 0; k < width; ++k)
        if (const auto term = row.sum.find(unknowns[k]); term != row.sum.end())
          composed(r, k) = term->second;
    }
    // Scale vectors by how far they move points, whatever their order and the edges that they are
    // per.
    Eigen::VectorXd reach = composed.colwise().norm();
    for (double& r : reach) r = r > 0 ? 1 / r : 0;
    composed *= reach.asDiagonal();
    const Eigen::MatrixXd moved =
        reach.asDiagonal() * composed.completeOrthogonalDecomposition().solve(wanted);
    const double rounding = 1e-13 * moved.cwiseAbs().maxCoeff();
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const auto row = moved.row(static_cast<Index>(k));
      if (row.cwiseAbs().maxCoeff() <= rounding) continue;
      pose[unknowns[k]] += {row[0], row[1], row[2]};
      affected.addVector(unknowns[k]);
    }
  }

  struct Row {
    std::map<Index, double> sum;
    Vec3 wanted;
  };
  using Rows = std::vector<Row>;

  // A derivative at an end as a sum of stored vectors.
  std::map<Index, double> sumOf(const CornerChange& end, int along, int across) const {
    const JetRef ref = rig_.surface.cornerJet(
        end.corner / 4, end.corner % 4, end.byAlpha ? across : along, end.byAlpha ? along : across);
    std::map<Index, double> sum;
    expand(ref.vector, ref.sign, sum);
    return sum;
  }

  void addDerivatives(const CornerChange& end, Rows& rows) const {
    for (const auto& [along, across] : kOrders)
      rows.push_back({sumOf(end, along, across), along > 0     ? Vec3{}
                                                 : across == 1 ? first_
                                                               : second_});
  }

  // Adds rows for how an end moves points along the curve and along the controls beside it, in
  // terms of the vectors that determine the derivatives up to the second order.
  void addPlaces(const CornerChange& end, Rows& rows) const {
    constexpr double held = 1e6;  // keeping the curve in place outweighs its controls
    constexpr int points = 8;
    const SweepBasis hermite;
    std::set<Index> own;
    for (const auto& [along, across] : kOrders)
      for (const auto& [v, factor] : sumOf(end, along, across)) own.insert(v);
    std::array<std::array<std::map<Index, double>, 3>, 3> jet;  // [along][across]
    for (int along = 0; along < 3; ++along)
      for (int across = 0; across < 3; ++across)
        for (const auto& [v, factor] : sumOf(end, along, across))
          if (own.contains(v))
            jet[along][across][v] =
                factor * std::pow(edgesAlong_, along) * std::pow(edgesAcross_, across);
    const struct {
      double u, weight;
      Vec3 wanted;
    } curves[]{
        {0, held, {}}, {kControlSpacing.u2, 1, move_.second}, {kControlSpacing.u3, 1, move_.third}};
    for (const auto& curve : curves)
      for (int k = 0; k < points; ++k) {
        const auto g = hermite.at(1.0 * k / points);
        const std::array<double, 3> parabola{1, curve.u, curve.u * curve.u / 2};
        Row& row = rows.emplace_back(Row{{}, curve.weight * g[0] * curve.wanted});
        for (int along = 0; along < 3; ++along)
          for (int across = 0; across < 3; ++across)
            for (const auto& [v, factor] : jet[along][across])
              row.sum[v] += curve.weight * g[along] * parabola[across] * factor;
      }
  }

  void expand(Index vector, double factor, std::map<Index, double>& sum) const {
    if (vector < rig_.surface.storedCount()) {
      sum[vector] += factor;
      return;
    }
    for (const Term& t : rig_.surface.derivation(vector)) expand(t.vector, factor * t.factor, sum);
  }

  // Orders of the derivatives along and across the curve.
  static constexpr std::array<std::array<int, 2>, 5> kOrders{
      {{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};

  Rig rig_;
  ControlMove move_;
  HalfArc half_ = -1;
  std::vector<CornerChange> ends_;
  double edgesAlong_ = 1, edgesAcross_ = 1;
  Vec3 first_, second_;
  std::vector<Index> rewritten_;
};

}  // namespace

Result<Patches> moveControls(Rig& rig, const ControlMove& move, Index target) {
  const auto patches = static_cast<std::size_t>(rig.surface.patchCount());
  if (auto ok = edit::checkIndex(move.curve, rig.surface.wireframe().arcs.size(), "curve"); !ok)
    return std::unexpected(ok.error());
  if (auto ok = edit::checkIndex(move.patch, patches, "patch"); !ok)
    return std::unexpected(ok.error());
  if (target >= 0)
    if (auto ok = edit::checkIndex(target, rig.targets.size(), "target"); !ok)
      return std::unexpected(ok.error());
  if (auto ok = edit::checkWhole(rig); !ok) return std::unexpected(ok.error());
  if (!isFinite(move.second) || !isFinite(move.third))
    return fail("A control curve cannot move by what is not finite.");
  auto moved = ControlMover(rig, move).run(target);
  if (!moved) return std::unexpected(moved.error());
  rig = std::move(moved->first);
  return std::move(moved->second);
}

}  // namespace sweepface
