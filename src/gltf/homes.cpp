#include "gltf/homes.hpp"

namespace sweepface::gltf {

Homes::Homes(const Parts& parts, const FineMesh& mesh)
    : parts_(parts), mesh_(mesh), homes_(parts.meshes.size()), strangers_(mesh.runs.size()) {
  const auto settle = [&](bool beyond) {
    for (std::size_t r = 0; r < mesh.runs.size(); ++r)
      for (Index v = 0; v < static_cast<Index>(mesh.runs[r].places.size()); ++v)
        if (mesh.runs[r].places[v].isBeyond() == beyond)
          homes_[parts.runs[r].rigMesh].try_emplace(mesh.runs[r].gridVertex[v], Home{r, v});
  };
  settle(false);
  settle(true);  // seen from elsewhere alone: wherever it was seen first
  for (std::size_t r = 0; r < mesh.runs.size(); ++r)
    for (Index v = 0; v < static_cast<Index>(mesh.runs[r].places.size()); ++v)
      if (mesh.runs[r].places[v].isBeyond()) strangers_[r].push_back(v);
}

Home Homes::of(std::size_t run, Index stranger) const {
  return homes_[parts_.runs[run].rigMesh].at(mesh_.runs[run].gridVertex[stranger]);
}

}  // namespace sweepface::gltf
