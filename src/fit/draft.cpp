#include "fit/draft.hpp"

namespace sweepface {

namespace {

// Extends the lines that end at T-nodes and lets other nodes store their jets. Returns whether a
// line was extended, so that there are other patches now.
bool breakCircles(const std::vector<Index>& breakers, MeshWireframe& on, Layout& layout,
                  ExtraJets& extra) {
  bool extended = false;
  for (const Index n : breakers) {
    const Index vertex = on.nodeVertices[n];
    if (on.wireframe.nodes[n].point < 0) {
      layout.extend(vertex);
      extended = true;
      continue;
    }
    on.wireframe.nodes[n].stored = kWholeJet;
    extra[vertex] = kWholeJet;
    if (const Index image = layout.image(vertex); image >= 0) extra[image] = kWholeJet;
  }
  return extended;
}

}  // namespace

Result<Draft> makeDraft(Layout& layout, ExtraJets& extra) {
  while (true) {
    auto patches = layout.patches();
    if (!patches) return std::unexpected(patches.error());
    MeshWireframe on = layout.wireframe(*patches);
    for (std::size_t n = 0; n < on.nodeVertices.size(); ++n)
      if (Node& node = on.wireframe.nodes[n]; node.point >= 0)
        node.stored |= extra[on.nodeVertices[n]];
    std::vector<Index> breakers;
    do {
      breakers.clear();
      auto surface = Surface::make(on.wireframe, &breakers);
      if (surface) return Draft{std::move(*patches), std::move(*surface)};
      if (breakers.empty()) return std::unexpected(surface.error());
    } while (!breakCircles(breakers, on, layout, extra));
  }
}

}  // namespace sweepface
