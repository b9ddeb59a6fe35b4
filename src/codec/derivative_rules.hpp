#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "codec/hierarchy.hpp"
#include "surface/line_prediction.hpp"

namespace sweepface::codec {

using Terms = std::vector<Term>;

/// The few terms of one value at a crossing or a T-node, held inline: at most those of two
/// positions and two slopes.
class FewTerms {
 public:
  void push_back(const Term& term) { terms_[size_++] = term; }
  const Term* begin() const { return terms_.data(); }
  const Term* end() const { return begin() + size_; }

 private:
  std::array<Term, 8> terms_;
  std::size_t size_ = 0;
};

template <typename List>
void addTerms(List& terms, std::span<const Term> more, double factor) {
  for (const Term& t : more) terms.push_back({t.vector, factor * t.factor});
}

/// Predicts stored derivatives from positions and earlier derivatives, by the rules that the
/// surface applies to derivatives that are not stored (docs/file-format-vectors.md, Prediction).
class DerivativeRules {
 public:
  /// `sites` in coding order, `siteOf` [nodes] the site of a node or -1.
  DerivativeRules(const Surface& surface, const std::vector<CodedSite>& sites,
                  const std::vector<Index>& siteOf);

  /// Adds the terms that predict a stored derivative of a site; none where zero is predicted.
  void predict(const CodedSite& site, const StoredVector& s, Terms& terms) const;

 private:
  // The stored derivative of a node, or -1.
  Index derivative(Index node, int i, int j) const;
  bool isSite(Index node) const { return siteOf_[node] >= 0; }
  struct Reached {
    Index node = -1;
    HalfArc back = -1;
    FewTerms position;
  };
  LineNeighbour<Reached> neighbour(Index node, int arm) const;
  LineNeighbours<Reached> neighbours(Index node, int axis) const {
    return {neighbour(node, axis), neighbour(node, axis + 2)};
  }
  // The position of a site, or of a T-node by interpolation along the line that it lies on.
  bool placeAll(Index node, FewTerms& terms) const;
  // The slope along a half-arc that leaves a node, by the parabola through the node and its two
  // neighbours, both of which must be sites.
  bool slope(Index node, HalfArc h, FewTerms& terms) const;
  Index position(Index node) const { return sites_[siteOf_[node]].first; }
  void atCrossing(const CodedSite& site, const StoredVector& s, Terms& terms) const;
  // Derivative 1 or 2 of the polynomial through the neighbours on a line and the known values at
  // the node.
  void along(const LineNeighbours<Reached>& at, Index own, Index slope, int order,
             Terms& terms) const;
  // ∂x∂y: the change of the slope along x from neighbour to neighbour along y, and vice versa; the
  // mean of the two where both are known.
  void mixed(Index node, Terms& terms) const;
  // The change of the slope along axis d along the other axis.
  bool changeAcross(Index node, const LineNeighbours<Reached>& at, int d, FewTerms& terms) const;
  // The slope at a neighbour towards the right of the direction of travel, or towards the left.
  bool slopeAcross(const Reached& n, bool right, FewTerms& terms) const;
  // First derivatives A and B at an irregular point: least squares over the slopes of its spokes,
  // which are combinations of A and B.
  void atHub(const CodedSite& site, const StoredVector& s, Terms& terms) const;
  std::vector<std::pair<Index, int>> spokes(const CodedSite& site) const;

  const Surface& surface_;
  const Wireframe& w_;
  const Connectivity& c_;
  const std::vector<CodedSite>& sites_;
  const std::vector<Index>& siteOf_;
  std::vector<std::vector<Index>> nodesAt_;  // [points] the irregular ones
};

/// The stored vector that mirrors each stored vector [S], and its sign.
std::vector<Hierarchy::Image> imagesOf(const Surface& surface, const Mirror& mirror,
                                       const std::vector<CodedSite>& sites);

}  // namespace sweepface::codec
