#pragma once

#include <span>
#include <string>
#include <vector>

#include "gltf/column.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Lengths in a GLB have 32 bits, and the JSON needs room as well.
inline constexpr std::uint64_t mostBytes = (std::uint64_t{1} << 32) - (std::uint64_t{1} << 24);
inline std::unexpected<Error> tooLargeForGlb() {
  return fail(
      "The face would need more than the 4 GiB of a GLB; choose a lower level of detail or a "
      "smaller budget.");
}

/// What an accessor's values are for.
enum class Use {
  vertices,  ///< an attribute
  morphs,    ///< an attribute of a morph target; held sparsely where that is smaller
  indices,   ///< of triangles
  other      ///< animations, skins
};

/// Appends values to a document's first buffer, in new buffer views. Sparse values are collected
/// until finish(). From the constructor to finish(), references into the document's JSON stay
/// valid, except into the lists of accessors and views, which grow.
class Builder {
 public:
  explicit Builder(Document& document);

  /// Adds an accessor and returns its index.
  std::size_t add(const Column& column, Use use);
  /// Replaces the values of an accessor; its name and whatever else it has stay.
  void set(std::size_t accessor, const Column& column, Use use);
  /// Writes what is left; call it once, last.
  void finish();

  /// [views] whether accessors lay in each before their values were replaced.
  std::vector<bool> leftViews() const;

  /// All bytes so far.
  std::size_t size() const;
  /// Whether the types could hold every value given.
  bool sound() const { return sound_; }

 private:
  void leaveViews(const Json& accessor);
  std::size_t addView(std::string_view bytes, std::size_t stride, int target);
  void setDense(Json& accessor, const Column& column, Use use);
  void setSparse(Json& accessor, const Column& column, std::span<const double> rows);

  Document& document_;
  std::string sparseIndices_, sparseValues_;
  std::size_t sparseIndexView_ = 0, sparseValueView_ = 0;  // set if the strings are not empty
  std::vector<std::size_t> left_;                          // views
  bool sound_ = true;
};

}  // namespace sweepface::gltf
