// The sample face: all of its parts and expressions.
#pragma once

#include "ear.hpp"
#include "expressions.hpp"
#include "eye.hpp"
#include "head.hpp"
#include "mouth.hpp"

namespace sample {

constexpr double kEdge = 0.45;  ///< of the source mesh, in cm

inline Sketch sketchFace() {
  Sketch sketch;
  Head head = drawHead(sketch);
  drawNeck(sketch, head);
  drawEar(sketch, head);
  drawNostril(sketch, head);
  drawLids(sketch, head);
  drawEyeball(sketch);
  drawMouth(sketch, head);
  drawTeeth(sketch);
  return sketch;
}

inline Drawing drawFace() {
  const Sketch sketch = sketchFace();
  Drawing drawing = sketch.drawing(kEdge);
  addExpressions(drawing, sketch);
  return drawing;
}

}  // namespace sample
