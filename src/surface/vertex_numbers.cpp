#include "surface/vertex_numbers.hpp"

namespace sweepface {

VertexNumbers::VertexNumbers(const Wireframe& wireframe) {
  std::vector<Index> ofPoint(wireframe.points, -1);
  for (const Node& node : wireframe.nodes) {
    const bool isKnown = node.point >= 0 && ofPoint[node.point] >= 0;
    ofNode.push_back(isKnown ? ofPoint[node.point] : count++);
    if (node.point >= 0) ofPoint[node.point] = ofNode.back();
  }
}

}  // namespace sweepface
