#include "surface/groups.hpp"

namespace sweepface {

Groups::Groups(std::span<const Index> keys, std::size_t groups) : first_(groups + 1, 0) {
  for (const Index key : keys)
    if (key >= 0) ++first_[key];
  Index end = 0;
  for (Index& first : first_) first = end += first;
  all_.resize(end);
  // Backwards, so that each counter, counted down, ends where its group begins.
  for (std::size_t k = keys.size(); k-- > 0;)
    if (keys[k] >= 0) all_[--first_[keys[k]]] = static_cast<Index>(k);
}

}  // namespace sweepface
