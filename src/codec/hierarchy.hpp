#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/mirror.hpp"

namespace sweepface::codec {

/// The stored vectors of one node, or of all nodes at an irregular point.
struct CodedSite {
  Index node = -1;    ///< the first of them
  Index first = -1;   ///< its first stored vector: the position
  Index count = 0;    ///< of stored vectors
  Index parent = -1;  ///< the site that weighs most in its prediction; -1 for a root
  Index mirror = -1;  ///< its mirror image, itself on the middle line; -1 if it has none
  Index span = 0;     ///< distance between the sites that predict it from both sides, 0 for a root
  bool leaf = true;   ///< nobody's parent
};

/// How each stored vector follows from those before it.
struct Prediction {
  struct Step {
    Index vector = -1;  ///< a stored one
    Index site = -1;
    Index terms = 0, termsEnd = 0;
    double reach = 1;  ///< the vector's step is the pose's divided by this
  };
  std::vector<Step> steps;  ///< [S] in the order of reconstruction: positions first, site by site
  std::vector<Term> terms;

  std::span<const Term> of(const Step& step) const {
    return {terms.data() + step.terms, terms.data() + step.termsEnd};
  }
};

/// The stored vectors of a surface from coarse to fine, and how each follows from those before it.
/// Depends on the wireframe alone, so reader and writer build the same.
///
/// Nodes are removed from their lines one by one, those with the nearest neighbours first, until
/// none is left between two others. Each is predicted from its neighbours at that moment, by the
/// cubic through four neighbours on a line. First and second derivatives are predicted from
/// positions by the rules of the surface for derivatives that are not stored.
class Hierarchy {
 public:
  Hierarchy(const Surface& surface, const Mirror& mirror);

  /// Coarse to fine: parents come before children, and mirror images are adjacent. Sites other than
  /// roots are in reverse order of their removal from the lines.
  const std::vector<CodedSite>& sites() const { return sites_; }

  /// What predicts the stored vectors of the neutral.
  const Prediction& prediction() const { return prediction_; }

  /// The terms that predict the position of a site.
  std::span<const Term> beside(Index site) const { return prediction_.of(prediction_.steps[site]); }

  /// The stored vector that mirrors another, or -1, and the sign of the reflection.
  struct Image {
    Index vector = -1;
    int sign = 1;
  };
  const std::vector<Image>& images() const { return images_; }

 private:
  friend class HierarchyBuilder;
  std::vector<CodedSite> sites_;
  Prediction prediction_;
  std::vector<Image> images_;
};

}  // namespace sweepface::codec
