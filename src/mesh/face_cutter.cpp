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

// Quads that share the first corner, and a triangle where one corner is left.
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
  if (face.size() <= 4) return keep(std::move(face));
  for (Piece& piece : cutLarge(std::move(face))) keep(std::move(piece));
}

// A convex polygon is cut from its first corner on, any other from the first one that will do.
std::vector<Piece> FaceCutter::cutLarge(Piece face) const {
  std::vector<Vec3> polygon;
  for (const Corner& c : face) polygon.push_back(positions_[c.vertex]);
  const Vec3 normal = meanNormal(polygon);
  // Rounded coordinates may have corners in line lean inwards, by a part of a corner's share in the
  // area.
  constexpr double kInLine = 0.01;
  const double least = -kInLine * dot(normal, normal) / static_cast<double>(face.size());
  for (std::size_t k = 0; k < face.size(); ++k) {
    std::vector<Piece> cuts = fan(face);
    if (areConvex(cuts, normal, least)) return cuts;
    std::ranges::rotate(face, face.begin() + 1);
  }
  std::vector<Piece> cuts;
  for (const Triangle& t : triangulate(polygon))
    cuts.push_back({face[t[0]], face[t[1]], face[t[2]]});
  return cuts;
}

// As seen along a normal: no corner turns by less.
bool FaceCutter::areConvex(const std::vector<Piece>& cuts, const Vec3& normal, double least) const {
  const auto turn = [&](const Piece& p, std::size_t a, std::size_t b, std::size_t c) {
    const Vec3& from = positions_[p[a % p.size()].vertex];
    return cross(positions_[p[b % p.size()].vertex] - from,
                 positions_[p[c % p.size()].vertex] - from);
  };
  return std::ranges::all_of(cuts, [&](const Piece& p) {
    for (std::size_t k = 0; k < p.size(); ++k)
      if (dot(turn(p, k, k + 1, k + 2), normal) < least) return false;
    return true;
  });
}

void FaceCutter::keep(Piece piece) {
  simplify(piece);
  if (piece.size() == 4 &&
      (piece[0].vertex == piece[2].vertex || piece[1].vertex == piece[3].vertex))
    piece.clear();
  if (piece.size() >= 3) pieces.push_back(std::move(piece));
}

}  // namespace sweepface
