#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// The rows of the derived vectors: sums of terms, appended to one list. A row may refer to vectors
/// whose own rows come later.
class JetRows {
 public:
  explicit JetRows(std::size_t vectors) : ranges_(vectors) { terms_.reserve(4 * vectors); }

  /// Begins the row of `vector`; it takes what is added until close().
  void open(Index vector) {
    open_ = vector;
    ranges_[vector].first = static_cast<Index>(terms_.size());
  }
  /// Keeps terms sorted by vector and adds up those of the same vector. Rows are short.
  void add(Index vector, double factor) {
    if (factor == 0) return;
    const auto first = terms_.begin() + ranges_[open_].first;
    auto place = terms_.end();
    while (place != first && place[-1].vector >= vector) --place;
    if (place != terms_.end() && place->vector == vector)
      place->factor += factor;
    else
      terms_.insert(place, {vector, factor});
  }
  void add(JetRef jet, double factor) { add(jet.vector, jet.sign * factor); }
  /// Ends the row and drops terms whose factor is zero.
  void close() {
    auto& [first, end] = ranges_[open_];
    end = first;
    for (auto t = terms_.begin() + first; t != terms_.end(); ++t)
      if (t->factor != 0) terms_[end++] = *t;
    terms_.resize(end);
  }
  /// Writes the row of a vector that equals another one.
  void follow(Index vector, JetRef other) {
    open(vector);
    add(other, 1);
    close();
  }

  std::span<const Term> of(Index vector) const {
    const auto [first, end] = ranges_[vector];
    return {terms_.data() + first, terms_.data() + end};
  }
  std::size_t termCount() const { return terms_.size(); }

 private:
  struct Range {
    Index first = 0, end = 0;
  };

  std::vector<Range> ranges_;  // [vectors]
  std::vector<Term> terms_;
  Index open_ = -1;
};

}  // namespace sweepface
