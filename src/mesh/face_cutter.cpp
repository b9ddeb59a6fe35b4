#include "mesh/face_cutter.hpp"

#include <algorithm>
#include <utility>

#include "eval/triangulate.hpp"

namespace sweepface {

namespace {

using Piece = FaceCutter::Piece;

void simplify(Piece& face) {
  for (std::size_t k = 0; k < face.size() && face.size() > 1;)
    if (face[k].vertex == face[(k + 1) % face.size()].vertex)
      face.erase(face.begin() + static_cast<std::ptrdiff_t>((k + 1) % face.size()));
    else
      ++k;
}

// Removes spikes: tips to which the face runs out and back.
void dropSpikes(Piece& face) {
  for (std::size_t k = 0; k < face.size() && face.size() > 4;) {
    const std::size_t tip = (k + 1) % face.size(), back = (k + 2) % face.size();
    if (face[k].vertex != face[back].vertex) {
      ++k;
      continue;
    }
    face.erase(face.begin() + static_cast<std::ptrdiff_t>(std::max(tip, back)));
    face.erase(face.begin() + static_cast<std::ptrdiff_t>(std::min(tip, back)));
    k = 0;
  }
}

// Quads between the rungs of a ladder, so that no corner is in more than two of them, and a
// triangle at the end if a corner is left.
std::vector<Piece> ladder(const Piece& face) {
  std::vector<Piece> pieces;
  for (std::size_t low = 0, high = face.size() - 1; high >= low + 2; ++low, --high) {
    pieces.push_back({face[low], face[low + 1]});
    if (high > low + 2) pieces.back().push_back(face[high - 1]);
    pieces.back().push_back(face[high]);
  }
  return pieces;
}

// Quads that share the first corner, and a triangle if one corner is left.
std::vector<Piece> fan(const Piece& face) {
  std::vector<Piece> pieces;
  for (std::size_t k = 1; k + 1 < face.size(); k += 2) {
    const auto end = std::min(face.size(), k + 3);
    pieces.push_back({face[0]});
    pieces.back().insert(pieces.back().end(), face.begin() + static_cast<std::ptrdiff_t>(k),
                         face.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return pieces;
}

}  // namespace

void FaceCutter::cut(Piece face) {
  simplify(face);
  dropSpikes(face);
  if (face.size() <= 4) return keep(std::move(face));
  for (Piece& piece : cutLarge(std::move(face))) keep(std::move(piece));
}

// The first good ladder; if there is none, as for polygons that are not convex or have collinear
// corners, the first good fan, or else the best of all ladders, fans and a triangulation.
std::vector<Piece> FaceCutter::cutLarge(Piece face) const {
  std::vector<Vec3> polygon;
  for (const Corner& c : face) polygon.push_back(positions_[c.vertex]);
  const Vec3 normal = meanNormal(polygon);
  std::vector<Piece> best;
  double bestWorth = 0;
  const auto offer = [&](std::vector<Piece> cuts) {
    // Only clearly better ones, so that rounding does not decide.
    if (const double worth = worthOf(cuts, normal); worth > 1.01 * bestWorth)
      best = std::move(cuts), bestWorth = worth;
  };
  constexpr std::size_t kMostPieces = 1 << 20;  // tries all corners of up to a thousand
  const std::size_t tries = std::min(face.size(), kMostPieces / face.size());
  const double good = 1.5 / static_cast<double>(face.size());  // a quarter of a regular polygon's
  for (const auto& way : {ladder, fan}) {
    Piece from = face;
    if (way == ladder) std::ranges::rotate(from, from.begin() + 2);  // the first rung begins at 0
    for (std::size_t k = 0; k < tries && bestWorth < good; ++k) {
      offer(way(from));
      std::ranges::rotate(from, from.begin() + 1);
    }
  }
  if (bestWorth >= good) return best;
  std::vector<Piece> triangles;
  for (const Triangle& t : triangulate(polygon))
    triangles.push_back({face[t[0]], face[t[1]], face[t[2]]});
  offer(triangles);
  return best.empty() ? triangles : best;
}

// The smallest sine of a corner of the pieces, as seen along the normal: hardly anything if one is
// straight, and 0 if one turns inwards or a piece has next to no area.
double FaceCutter::worthOf(const std::vector<Piece>& cuts, const Vec3& normal) const {
  // Rounded coordinates may make collinear corners lean inwards.
  constexpr double kInLine = 0.01, kThin = 1e-3;
  const double up = norm(normal);
  double worth = 1;
  for (const Piece& p : cuts) {
    double area = 0, longest = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Vec3& here = positions_[p[k].vertex];
      const Vec3 next = positions_[p[(k + 1) % p.size()].vertex] - here;
      const Vec3 last = positions_[p[(k + p.size() - 1) % p.size()].vertex] - here;
      const double turn = dot(cross(next, last), normal), full = norm(next) * norm(last) * up;
      if (!(turn >= -kInLine * full)) return 0;
      worth = std::min(worth, std::max(turn / full, 1e-3 * kInLine));
      area += turn / up, longest = std::max(longest, dot(next, next));
    }
    if (!(area > kThin * longest)) return 0;
  }
  return worth;
}

void FaceCutter::keep(Piece piece) {
  simplify(piece);
  if (piece.size() == 4 &&
      (piece[0].vertex == piece[2].vertex || piece[1].vertex == piece[3].vertex))
    piece.clear();
  if (piece.size() >= 3) pieces.push_back(std::move(piece));
}

}  // namespace sweepface
