#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Sorts the terms of a sum by vector and adds up those of the same vector.
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

/// Expands a sum of vectors, each of which is itself a combination, given by `vectors`.
inline std::vector<Term> expanded(std::span<const Term> sum,
                                  std::span<const std::vector<Term>> vectors) {
  std::vector<Term> terms;
  for (const Term& t : sum)
    for (const Term& s : vectors[t.vector]) terms.push_back({s.vector, s.factor * t.factor});
  mergeTerms(terms);
  return terms;
}

/// Every vector of a surface as a combination of stored ones: [vectorCount].
inline std::vector<std::vector<Term>> inStoredVectors(const Surface& surface) {
  std::vector<std::vector<Term>> vectors(surface.vectorCount());
  for (Index v = 0; v < surface.storedCount(); ++v) vectors[v] = {{v, 1}};
  for (Index v = surface.storedCount(); v < surface.vectorCount(); ++v)
    vectors[v] = expanded(surface.derivation(v), vectors);
  return vectors;
}

}  // namespace sweepface
