#pragma once

#include <string>
#include <vector>

#include "sweepface/polygons.hpp"

#include "usd/looks.hpp"
#include "usd/prim_names.hpp"
#include "usd/text.hpp"

namespace sweepface::usd {

/// The materials of polygons, each as a prim and as a subset of the faces.
class Materials {
 public:
  /// `faces` are those that the mesh has; both must outlive this.
  Materials(const Polygons& polygons, const std::vector<Index>& faces);

  bool empty() const { return used_.empty(); }
  /// Adds subsets to a mesh whose other children have these names, bound to materials in a scope
  /// below `path`.
  void addSubsets(Text& text, const std::string& path, PrimNames& names) const;
  /// Adds that scope to the prim at `path`. Materials that the looks do not know are white and
  /// rough.
  void addScope(Text& text, const std::string& path, const Looks& looks) const;

 private:
  struct Used {
    std::string name, prim;
    std::vector<Index> faces;  // among those of the mesh
  };
  std::vector<Used> used_;
  bool coverAll_ = true;
};

}  // namespace sweepface::usd
