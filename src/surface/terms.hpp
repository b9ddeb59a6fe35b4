#pragma once

#include <algorithm>
#include <array>
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

/// A sum of a few terms, held where it stands; only long ones take memory of their own.
class TermRow {
 public:
  TermRow() {}
  TermRow(TermRow&& other) noexcept : many_(std::move(other.many_)), size_(other.size_) {
    if (size_ <= few_.size()) std::copy_n(other.few_.begin(), size_, few_.begin());
  }
  TermRow& operator=(TermRow&& other) noexcept {
    many_ = std::move(other.many_);
    size_ = other.size_;
    if (size_ <= few_.size()) std::copy_n(other.few_.begin(), size_, few_.begin());
    return *this;
  }

  void push_back(const Term& term) {
    if (size_ < few_.size()) {
      few_[size_++] = term;
      return;
    }
    if (size_ == few_.size()) many_.assign(few_.begin(), few_.end());
    many_.push_back(term);
    ++size_;
  }

  Term* begin() { return size_ > few_.size() ? many_.data() : few_.data(); }
  Term* end() { return begin() + size_; }
  const Term* begin() const { return size_ > few_.size() ? many_.data() : few_.data(); }
  const Term* end() const { return begin() + size_; }

  /// Sorts the terms by vector, adds up those of the same one and drops those without a factor.
  void merge() {
    Term* const first = begin();
    sortFew(first, end());
    std::size_t n = 0;
    for (const Term* t = first; t != end();) {
      Term sum = *t++;
      for (; t != end() && t->vector == sum.vector; ++t) sum.factor += t->factor;
      if (sum.factor != 0) first[n++] = sum;
    }
    if (size_ > few_.size() && n <= few_.size()) std::copy_n(first, n, few_.begin());
    size_ = n;
  }

 private:
  // By insertion: rows are short, and terms of the same vector keep their order everywhere.
  static void sortFew(Term* first, Term* last) {
    for (Term* t = first; t != last; ++t) {
      const Term moved = *t;
      Term* place = t;
      for (; place != first && moved.vector < place[-1].vector; --place) *place = place[-1];
      *place = moved;
    }
  }

  union {  // most rows of a surface never hold any: nothing is written where nothing is
    std::array<Term, 6> few_;
  };
  std::vector<Term> many_;  // all of them, once they are more
  std::size_t size_ = 0;
};

}  // namespace sweepface
