#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "codec/hierarchy.hpp"

namespace sweepface::codec {

using Terms = std::vector<Term>;

/// The few terms of one value at a crossing or a T-node, held where they stand: no more than those
/// of two places and two slopes.
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

/// The half-arc that leads straight on where one leaves a node, on its other side; -1 if none does.
HalfArc oppositeOf(const Wireframe& w, const Connectivity& c, HalfArc h);

/// How stored derivatives follow from positions and from derivatives before them, by the rules of
/// the surface for those that are not stored (docs/file-format-vectors.md, Prediction).
class DerivativeRules {
 public:
  /// `sites` in coding order, `siteOf` [nodes] the site of a node or -1.
  DerivativeRules(const Surface& surface, const std::vector<CodedSite>& sites,
                  const std::vector<Index>& siteOf);

  /// Adds what predicts a stored derivative of a site; nothing where it is expected to be zero.
  void predict(const CodedSite& site, const StoredVector& s, Terms& terms) const;

 private:
  // The stored derivative of a node, or -1.
  Index derivative(Index node, int i, int j) const;
  bool isSite(Index node) const { return siteOf_[node] >= 0; }
  struct Neighbour {
    bool has = false;
    double distance = 0;
    Index node = -1;
    HalfArc back = -1;
    FewTerms value;
  };
  Neighbour neighbour(Index node, int arm) const;
  // Those along an axis, ahead and behind.
  std::array<Neighbour, 2> neighbours(Index node, int axis) const {
    return {neighbour(node, axis), neighbour(node, axis + 2)};
  }
  // The position of a site, or of a T-node by what stands on the line it hangs on.
  bool placeAll(Index node, FewTerms& terms) const;
  // The slope along a half-arc that leaves a node: by the parabola through the node and its
  // neighbours, both sites.
  bool slope(Index node, HalfArc h, FewTerms& terms) const;
  Index position(Index node) const { return sites_[siteOf_[node]].first; }
  void atCrossing(const CodedSite& site, const StoredVector& s, Terms& terms) const;
  // Derivative 1 or 2 of the polynomial through the neighbours on a line and what the node knows.
  void along(const std::array<Neighbour, 2>& at, Index own, Index slope, int order,
             Terms& terms) const;
  // ∂x∂y: how the slope along x changes from neighbour to neighbour along y, and the other way
  // round; the mean where both are known.
  void mixed(Index node, Terms& terms) const;
  // How the slope along axis d changes along the other one.
  bool changeAcross(Index node, const std::array<Neighbour, 2>& at, int d, FewTerms& terms) const;
  // The slope at a neighbour to the right of travel, or to the left of it.
  bool slopeAcross(const Neighbour& n, bool right, FewTerms& terms) const;
  // First derivatives at an irregular point: least squares over the slopes of its spokes, which are
  // combinations of A and B.
  void atHub(const CodedSite& site, const StoredVector& s, Terms& terms) const;
  std::vector<std::pair<Index, int>> spokes(const CodedSite& site) const;

  const Surface& surface_;
  const Wireframe& w_;
  const Connectivity& c_;
  const std::vector<CodedSite>& sites_;
  const std::vector<Index>& siteOf_;
  std::vector<std::vector<Index>> nodesAt_;  // [points] those that are irregular
};

/// The stored vector that mirrors each [S], and how.
std::vector<Hierarchy::Image> imagesOf(const Surface& surface, const Mirror& mirror,
                                       const std::vector<CodedSite>& sites);

}  // namespace sweepface::codec
