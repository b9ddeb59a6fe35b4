#pragma once

#include <algorithm>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Sorts the terms of a sum by vector and adds up those of the same one.
inline void mergeTerms(std::vector<Term>& terms) {
  std::sort(terms.begin(), terms.end(),
            [](const Term& a, const Term& b) { return a.vector < b.vector; });
  std::size_t n = 0;
  for (const Term& t : terms)
    if (n > 0 && terms[n - 1].vector == t.vector)
      terms[n - 1].factor += t.factor;
    else
      terms[n++] = t;
  terms.resize(n);
}

}  // namespace sweepface
