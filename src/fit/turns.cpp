#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sweepface/arcs.hpp"

#include "eval/balls.hpp"

namespace sweepface {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

Vector toEigen(const Vec3& p) { return {p.x, p.y, p.z}; }
Vec3 fromEigen(const Vector& p) { return {p.x(), p.y(), p.z()}; }

// When a target is taken for a turn. Lids of the ICT face have a radial change of 0.05, an angle of
// 40° and a spread of 12°, its jaw 0.08, 25° and 5°; a smile has 0.15, a pucker 0.4.
constexpr double kMoves = 0.02;      // least movement of a point that counts / largest movement
constexpr double kRadial = 0.15;     // RMS change of distance from the axis / RMS movement
constexpr double kSmallestTurn = 3;  // degrees
constexpr double kSpread = 0.45;     // standard deviation of the angles / their mean
constexpr double kRigid = 0.01;      // RMS of what a rigid motion leaves / RMS movement
constexpr double kOffCentre = 0.5;   // distance of an axis from a ball's centre / its radius

/// A point of the neutral and where it goes.
struct Way {
  Vector from, to;
};

double squares(std::span<const Way> ways) {
  double sum = 0;
  for (const Way& w : ways) sum += (w.to - w.from).squaredNorm();
  return sum;
}

// ---- Axes ----

/// The line from which all points keep their distances as nearly as possible. |to − c| = |from − c|
/// is linear in c: d · c = ½(|to|² − |from|²) with d = to − from. Along the axis no c is better
/// than another, so it is the direction in which points move least. Long movements count most.
struct Axis {
  Vector pivot, direction;
};

std::optional<Axis> fitAxis(std::span<const Way> ways) {
  Matrix m = Matrix::Zero();
  Vector right = Vector::Zero(), centre = Vector::Zero();
  double weights = 0;
  for (const Way& w : ways) {
    const Vector d = w.to - w.from;
    const double weight = d.squaredNorm();
    m += weight * d * d.transpose();
    right += weight * d * (0.5 * (w.to.squaredNorm() - w.from.squaredNorm()));
    centre += weight * w.from;
    weights += weight;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m);
  if (!(eigen.eigenvalues()[1] > 1e-6 * eigen.eigenvalues()[2])) return {};  // all are parallel
  Axis axis{Vector::Zero(), eigen.eigenvectors().col(0)};
  for (int k : {1, 2}) {
    const Vector v = eigen.eigenvectors().col(k);
    axis.pivot += v * (v.dot(right) / eigen.eigenvalues()[k]);
  }
  axis.pivot += axis.direction * axis.direction.dot(centre / weights);
  return axis;
}

/// Whether points turn about an axis, all by about the same angle.
bool isTurn(std::span<const Way> ways, const Axis& axis) {
  double weights = 0, angles = 0, angleSquares = 0, radial = 0, all = 0;
  for (const Way& w : ways) {
    const auto arm = [&](const Vector& p) -> Vector {
      const Vector q = p - axis.pivot;
      return q - axis.direction * axis.direction.dot(q);
    };
    const Vector a = arm(w.from), b = arm(w.to);
    const double weight = (w.to - w.from).squaredNorm();
    const double angle =
        std::atan2(a.cross(b).dot(axis.direction), a.dot(b)) * 180 / std::numbers::pi;
    weights += weight;
    angles += weight * angle;
    angleSquares += weight * angle * angle;
    radial += weight * std::pow(b.norm() - a.norm(), 2);
    all += weight * weight;
  }
  const double mean = angles / weights;
  const double spread = std::sqrt(std::max(0.0, angleSquares / weights - mean * mean));
  return std::abs(mean) >= kSmallestTurn && spread <= kSpread * std::abs(mean) &&
         radial <= kRadial * kRadial * all;
}

/// Whether the best rigid motion (Kabsch 1976) leaves next to nothing of the movement.
bool isRigid(std::span<const Way> ways) {
  Vector from = Vector::Zero(), to = Vector::Zero();
  for (const Way& w : ways) from += w.from, to += w.to;
  from /= static_cast<double>(ways.size()), to /= static_cast<double>(ways.size());
  Matrix covariance = Matrix::Zero();
  for (const Way& w : ways) covariance += (w.to - to) * (w.from - from).transpose();
  const Eigen::JacobiSVD<Matrix> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix sign = Matrix::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Matrix rotation = svd.matrixU() * sign * svd.matrixV().transpose();
  double left = 0;
  for (const Way& w : ways) left += (w.to - to - rotation * (w.from - from)).squaredNorm();
  return left <= kRigid * kRigid * squares(ways);
}

// ---- Targets ----

class TurnFinder {
 public:
  explicit TurnFinder(const Rig& rig) : rig_(rig), grid_(rig.surface, 1), parts_(partsOf(grid_)) {
    neutral_ = pointsOf({});
    for (const Part& part : parts_) {
      std::vector<Vec3> points;
      for (const Index v : part) points.push_back(fromEigen(neutral_[v]));
      if (const auto ball = ballOf(points)) balls_.push_back(*ball);
    }
  }

  std::optional<Turn> find(Index target) const {
    const std::vector<Way> ways = waysThatTell(target);
    const auto axis = ways.size() < 3 ? std::nullopt : fitAxis(ways);
    if (!axis || !isTurn(ways, *axis)) return {};
    if (const Ball* const ball = ballOn(*axis, ways)) return Turn{target, ball->centre, {}};
    return Turn{target, fromEigen(axis->pivot), fromEigen(axis->direction)};
  }

 private:
  std::vector<Vector> pointsOf(std::span<const double> weights) const {
    std::vector<Vector> points;
    for (const Vec3& p : grid_.positions(blend(rig_, weights))) points.push_back(toEigen(p));
    return points;
  }

  /// The movements of parts that turn rigidly, such as teeth, if any; else of all points that move.
  std::vector<Way> waysThatTell(Index target) const {
    const std::vector<Vector> moved = pointsOf(rig_.weightsOf(target + 1));
    double longest = 0;
    for (std::size_t v = 0; v < moved.size(); ++v)
      longest = std::max(longest, (moved[v] - neutral_[v]).norm());
    std::vector<Way> all, rigid;
    if (!(longest > rig_.tolerance)) return all;
    for (const Part& part : parts_) {
      std::vector<Way> ways;
      for (const Index v : part)
        if ((moved[v] - neutral_[v]).norm() > kMoves * longest)
          ways.push_back({neutral_[v], moved[v]});
      all.insert(all.end(), ways.begin(), ways.end());
      if (2 * ways.size() > part.size() && ways.size() >= 4 && turnsRigidly(ways))
        rigid.insert(rigid.end(), ways.begin(), ways.end());
    }
    return rigid.empty() ? all : rigid;
  }

  static bool turnsRigidly(std::span<const Way> ways) {
    if (!isRigid(ways)) return false;
    const auto axis = fitAxis(ways);
    return axis && isTurn(ways, *axis);
  }

  /// A ball that the axis runs through and the points move around.
  const Ball* ballOn(const Axis& axis, std::span<const Way> ways) const {
    Vector middle = Vector::Zero();
    for (const Way& w : ways) middle += w.from;
    middle /= static_cast<double>(ways.size());
    const auto distance = [&](const Ball& ball) {
      return (toEigen(ball.centre) - axis.pivot).cross(axis.direction).norm();
    };
    const Ball* nearest = nullptr;
    for (const Ball& ball : balls_)
      if (distance(ball) < kOffCentre * ball.radius &&
          (middle - toEigen(ball.centre)).norm() < 1.5 * ball.radius &&
          (!nearest || distance(ball) < distance(*nearest)))
        nearest = &ball;
    return nearest;
  }

  const Rig& rig_;
  Tessellation grid_;
  std::vector<Part> parts_;
  std::vector<Vector> neutral_;
  std::vector<Ball> balls_;
};

}  // namespace

std::vector<Turn> findTurns(const Rig& rig) {
  if (!rig.knowsTargets()) return {};
  const TurnFinder finder(rig);
  std::vector<Turn> turns;
  for (Index k = 0; k < static_cast<Index>(rig.targets.size()); ++k)
    if (const auto turn = finder.find(k)) turns.push_back(*turn);
  return turns;
}

std::vector<Turn> turnsOf(const Rig& rig) { return rig.turns.empty() ? findTurns(rig) : rig.turns; }

}  // namespace sweepface
