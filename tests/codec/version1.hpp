#pragma once

#include <algorithm>
#include <span>
#include <string>

#include "sweepface/rig.hpp"

#include "codec/blocks.hpp"
#include "codec/chunks.hpp"
#include "codec/faces.hpp"
#include "codec/names.hpp"

// Writes files of version 1. The library still reads them but no longer writes them.
namespace sweepface::testing {

namespace version1 {

using namespace codec;

inline std::string head(const Rig& rig) {
  Writer out;
  out.f64(rig.tolerance);
  out.number(rig.neutral.size());
  out.number(rig.targets.size());
  out.number(rig.source.loose.size());
  return out.take();
}

inline void writeNodes(Writer& out, const Wireframe& w) {
  out.number(w.nodes.size());
  Index point = -1;
  for (const Node& node : w.nodes) {
    out.signedNumber(node.point - std::int64_t{point});
    out.number(node.stored);
    point = node.point;
  }
}

inline void writeArcs(Writer& out, const Wireframe& w) {
  out.number(w.arcs.size());
  Index from = 0, ribbon = 0;
  for (const Arc& arc : w.arcs) {
    out.signedNumber(arc.from - std::int64_t{from});
    out.signedNumber(arc.to - std::int64_t{arc.from});
    out.number(2 * static_cast<std::uint64_t>(arc.edges) + arc.collapsed);
    out.signedNumber(arc.ribbon - std::int64_t{ribbon});
    from = arc.from, ribbon = arc.ribbon;
  }
}

inline void writePatches(Writer& out, const Wireframe& w) {
  out.number(w.patches.size());
  HalfArc last = 0;
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s) {
      out.number(w.side(p, s).size());
      for (HalfArc h : w.side(p, s)) {
        out.signedNumber(h - std::int64_t{last});
        last = h;
      }
    }
}

inline std::string wireframe(const Wireframe& w) {
  Writer out;
  out.number(static_cast<std::uint64_t>(w.points));
  writeNodes(out, w);
  writeArcs(out, w);
  writePatches(out, w);
  return out.take();
}

inline bool hasCreases(const Wireframe& w) {
  return std::ranges::count(w.arcs, true, &Arc::crease) > 0;
}

inline std::string creases(const Wireframe& w) {
  Writer out;
  out.number(static_cast<std::uint64_t>(std::ranges::count(w.arcs, true, &Arc::crease)));
  Index last = -1;
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    if (!w.arcs[a].crease) continue;
    out.signedNumber(a - last);
    last = a;
  }
  return out.take();
}

inline std::string shapes(const std::vector<Shape>& ribbons) {
  Writer out;
  out.number(ribbons.size());
  std::vector<char> chosen;
  for (const Shape& shape : ribbons) chosen.push_back(shape != Shape{});
  writeMask(out, chosen);
  for (const Shape& shape : ribbons)
    if (shape != Shape{})
      for (const double x : {shape.rho, shape.eta, shape.lambda}) out.f64(x);
  return out.take();
}

inline std::string vectors(const std::vector<Vec3>& vectors, Precision precision) {
  Writer out;
  writeVectors(out, vectors, precision);
  return out.take();
}

inline std::string target(const Target& target) {
  Writer out;
  out.text(target.name);
  writeVectors(out, target.difference, Precision::single);
  writeVectors(out, target.looseDifference, Precision::exact);
  return out.take();
}

inline std::string sourceOrder(const std::vector<Index>& gridVertex) {
  Writer out;
  out.number(gridVertex.size());
  Index last = -1;
  for (Index v : gridVertex) {
    out.signedNumber(v - std::int64_t{last} - 1);
    last = v;
  }
  return out.take();
}

inline bool hasFaces(const Polygons& polygons) {
  return polygons.faceCount() > 0 || !polygons.materials.empty() || !polygons.groups.empty() ||
         !polygons.materialFiles.empty();
}

inline std::string polygons(const Polygons& polygons) {
  Writer out;
  std::vector<Index> sizes;
  for (Index f = 0; f < polygons.faceCount(); ++f) sizes.push_back(polygons.faceSize(f));
  writeRuns(out, sizes);
  Index last = 0;
  for (Index v : polygons.corners) {
    out.signedNumber(v - std::int64_t{last});
    last = v;
  }
  writeTexts(out, polygons.materials);
  writeRuns(out, polygons.faceMaterial);
  writeTexts(out, polygons.groups);
  writeRuns(out, polygons.faceGroup);
  writeTexts(out, polygons.materialFiles);
  return out.take();
}

inline std::string texcoords(const Polygons& polygons) {
  Writer out;
  out.number(polygons.texcoords.size());
  writeVectors(out, polygons.texcoords, Precision::exact);
  out.byte(!polygons.cornerTexcoords.empty());
  Index last = -1;
  for (Index t : polygons.cornerTexcoords) {
    out.signedNumber(t - std::int64_t{last});
    last = t;
  }
  return out.take();
}

// A quad that goes once around a face of four corners is stored as its first corner alone.
inline std::string quadCorners(const SourceMesh& source) {
  Writer out;
  Index last = 0;
  for (std::size_t q = 0; q + 4 <= source.quadCorners.size(); q += 4) {
    const Index* corner = &source.quadCorners[q];
    const std::int64_t step = corner[0] - std::int64_t{last};
    const bool whole =
        std::ranges::equal(aroundQuad(source.polygons, corner[0]), std::span(corner, 4));
    out.signedNumber(2 * step + !whole);
    for (int k = 1; k < 4 && !whole; ++k) out.signedNumber(corner[k] - std::int64_t{corner[k - 1]});
    last = corner[0];
  }
  return out.take();
}

inline std::string scene(std::string_view glb) {
  Writer out;
  out.text(glb);
  return out.take();
}

inline std::string names(const Names& names) {
  Writer out;
  writeNames(out, names);
  return out.take();
}

}  // namespace version1

inline std::string encodeVersion1(const Rig& rig) {
  using namespace version1;
  using namespace codec;
  const SourceMesh& source = rig.source;
  const Polygons& faces = source.polygons;
  Writer out;
  out.raw(kMagic);
  out.byte(1);
  writeChunk(out, "HEAD", head(rig));
  writeChunk(out, "WIRE", wireframe(rig.surface.wireframe()));
  if (hasCreases(rig.surface.wireframe()))
    writeChunk(out, "CREA", creases(rig.surface.wireframe()));
  writeChunk(out, "SHAP", shapes(rig.surface.wireframe().ribbons));
  writeChunk(out, "NEUT", vectors(rig.neutral, Precision::single));
  for (const Target& t : rig.targets) writeChunk(out, "TARG", target(t));
  if (!source.loose.empty()) writeChunk(out, "loos", vectors(source.loose, Precision::exact));
  if (!source.gridVertex.empty()) writeChunk(out, "ordr", sourceOrder(source.gridVertex));
  if (hasFaces(faces)) writeChunk(out, "poly", polygons(faces));
  if (!faces.texcoords.empty() || !faces.cornerTexcoords.empty())
    writeChunk(out, "texc", texcoords(faces));
  if (!source.quadCorners.empty()) writeChunk(out, "quad", quadCorners(source));
  if (!rig.scene.empty()) writeChunk(out, "scen", scene(rig.scene));
  if (hasNames(rig.names)) writeChunk(out, "name", names(rig.names));
  writeChunk(out, "END ", {});
  return out.take();
}

}  // namespace sweepface::testing
