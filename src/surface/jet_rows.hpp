#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// What derived vectors are: sums of terms, written one after the other into one list, in which
/// rows may refer to vectors whose own rows come later.
class JetRows {
 public:
  explicit JetRows(std::size_t vectors) : ranges_(vectors) { terms_.reserve(4 * vectors); }

  /// What is added from here on belongs to `vector`, until it is closed.
  void open(Index vector) {
    open_ = vector;
    ranges_[vector].first = static_cast<Index>(terms_.size());
  }
  /// Terms are kept in the order of their vectors, those of the same one added up. Rows are short.
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
  /// Drops what has no factor.
  void close() {
    auto& [first, end] = ranges_[open_];
    end = first;
    for (auto t = terms_.begin() + first; t != terms_.end(); ++t)
      if (t->factor != 0) terms_[end++] = *t;
    terms_.resize(end);
  }
  /// The row of a vector that is another one.
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
