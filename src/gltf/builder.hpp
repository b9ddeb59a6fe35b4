#pragma once

#include <span>
#include <string>
#include <vector>

#include "gltf/column.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Lengths in a GLB have 32 bits, and the JSON must find room as well.
inline constexpr std::size_t mostBytes = (std::size_t{1} << 32) - (std::size_t{1} << 24);

/// What the values of an accessor are there for.
enum class Use {
  vertices,  ///< an attribute
  morphs,    ///< an attribute of a morph target; held sparsely where that is smaller
  indices,   ///< of triangles
  other      ///< animations, skins
};

/// Puts values into a document: behind all that its first buffer holds, in new buffer views. Sparse
/// values gather until finish(). Between constructor and finish() references into the document's
/// JSON stay valid, except into the lists of accessors and views, which grow.
class Builder {
 public:
  explicit Builder(Document& document);

  /// A new accessor.
  std::size_t add(const Column& column, Use use);
  /// Other values for an accessor; its name and whatever else it has stay.
  void set(std::size_t accessor, const Column& column, Use use);
  /// Writes what is left; call it once, last.
  void finish();

  /// [views] those that accessors lay in until they were given other values.
  std::vector<bool> leftViews() const;

  /// All bytes so far.
  std::size_t size() const;
  /// Whether every value that was given could be held.
  bool sound() const { return sound_; }

 private:
  void leaveViews(const Json& accessor);
  std::size_t addView(std::string_view bytes, std::size_t stride, int target);
  void setDense(Json& accessor, const Column& column, Use use);
  void setSparse(Json& accessor, const Column& column, std::span<const double> rows);

  Document& document_;
  std::string sparseIndices_, sparseValues_;
  std::size_t sparseIndexView_ = 0, sparseValueView_ = 0;  // where the strings are not empty
  std::vector<std::size_t> left_;                          // views
  bool sound_ = true;
};

}  // namespace sweepface::gltf
