#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

// Hand-made meshes, and the topology of any mesh.
namespace sweepface::testing {

using Loop = std::vector<Index>;

inline void addFace(PolygonMesh& mesh, const Loop& face) {
  Polygons& p = mesh.polygons;
  p.corners.insert(p.corners.end(), face.begin(), face.end());
  p.faceStart.push_back(static_cast<Index>(p.corners.size()));
}

inline std::vector<Loop> loopsOf(const Polygons& p) {
  std::vector<Loop> faces;
  for (Index f = 0; f < p.faceCount(); ++f)
    faces.emplace_back(p.corners.begin() + p.faceStart[f], p.corners.begin() + p.faceStart[f + 1]);
  return faces;
}

/// The same for quads or triangles stored as arrays.
template <std::size_t Corners>
std::vector<Loop> loopsOf(const std::vector<std::array<Index, Corners>>& faces) {
  std::vector<Loop> loops;
  for (const auto& face : faces) loops.emplace_back(face.begin(), face.end());
  return loops;
}

/// Keeps only the vertices for which `keep` is true, and the faces between them.
inline PolygonMesh only(const PolygonMesh& mesh, const std::function<bool(const Vec3&)>& keep) {
  PolygonMesh result;
  std::vector<Index> place(mesh.positions.size(), -1);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (keep(mesh.positions[v])) {
      place[v] = static_cast<Index>(result.positions.size());
      result.positions.push_back(mesh.positions[v]);
    }
  for (Loop face : loopsOf(mesh.polygons)) {
    for (Index& v : face) v = place[v];
    if (std::ranges::count(face, -1) == 0) addFace(result, face);
  }
  return result;
}

/// A grid of m × n quads with vertices at `place(i, j)`, optionally closed in either direction.
inline PolygonMesh grid(Index m, Index n, const std::function<Vec3(double, double)>& place,
                        bool closedU = false, bool closedV = false) {
  PolygonMesh mesh;
  const Index columns = closedU ? m : m + 1, rows = closedV ? n : n + 1;
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) mesh.positions.push_back(place(i, j));
  const auto at = [&](Index i, Index j) { return (j % rows) * columns + i % columns; };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i)
      addFace(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return mesh;
}

inline double turn(double share) { return 2 * std::numbers::pi * share; }

/// A smooth hill over the plane.
inline Vec3 onHill(double x, double y) {
  return {x, y, 2 * std::exp(-0.04 * ((x - 5) * (x - 5) + (y - 4) * (y - 4)))};
}

inline PolygonMesh plane(Index m = 10, Index n = 8) { return grid(m, n, onHill); }

inline PolygonMesh cylinder(Index around = 16, Index along = 8, bool seam = false) {
  const auto place = [=](double i, double j) {
    const double a = turn(std::fmod(i, around) / around), r = 3 + 0.3 * std::sin(0.5 * j);
    return Vec3{r * std::cos(a), r * std::sin(a), j};
  };
  return grid(around, along, place, !seam, false);
}

inline PolygonMesh torus(Index around = 18, Index across = 12) {
  const auto place = [=](double i, double j) {
    const double a = turn(i / around), b = turn(j / across), r = 5 + 2 * std::cos(b);
    return Vec3{r * std::cos(a), r * std::sin(a), 2 * std::sin(b)};
  };
  return grid(around, across, place, true, true);
}

/// A flat ring seen from above.
inline PolygonMesh annulus(Index around = 20, Index across = 5) {
  const auto place = [=](double i, double j) {
    const double a = turn(i / around), r = 3 + 1.2 * j;
    return Vec3{r * std::cos(a), -r * std::sin(a), 0.1 * r * std::cos(2 * a)};
  };
  return grid(around, across, place, true, false);
}

/// Six grids of n × n quads: eight vertices where three quads meet.
inline PolygonMesh cubeSphere(Index n = 6, double radius = 4) {
  PolygonMesh mesh;
  std::map<std::array<Index, 3>, Index> known;
  const auto at = [&](std::array<Index, 3> p) {
    const auto [it, isNew] = known.try_emplace(p, static_cast<Index>(mesh.positions.size()));
    if (isNew) {
      const auto bend = [&](Index k) { return std::tan((2.0 * k / n - 1) * std::numbers::pi / 4); };
      const Vec3 q{bend(p[0]), bend(p[1]), bend(p[2])};
      mesh.positions.push_back(radius * normalized(q));
    }
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index side : {0, n})
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          Loop face;
          for (auto [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<Index, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = i + a, p[(axis + 2) % 3] = j + b;
            face.push_back(at(p));
          }
          if (side == 0) std::ranges::reverse(face);
          addFace(mesh, face);
        }
  return mesh;
}

/// Rings of quads between two fans of triangles.
inline PolygonMesh uvSphere(Index around = 16, Index rings = 8, double radius = 4) {
  PolygonMesh mesh;
  for (Index j = 1; j < rings; ++j)
    for (Index i = 0; i < around; ++i) {
      const double a = turn(1.0 * i / around), b = std::numbers::pi * (1.0 * j / rings - 0.5);
      mesh.positions.push_back(
          radius * Vec3{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
    }
  const auto south = static_cast<Index>(mesh.positions.size()), north = south + 1;
  mesh.positions.push_back({0, 0, -radius});
  mesh.positions.push_back({0, 0, radius});
  const auto at = [&](Index i, Index j) { return (j - 1) * around + i % around; };
  for (Index i = 0; i < around; ++i) {
    addFace(mesh, {south, at(i + 1, 1), at(i, 1)});
    for (Index j = 1; j + 1 < rings; ++j)
      addFace(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    addFace(mesh, {at(i, rings - 1), at(i + 1, rings - 1), north});
  }
  return mesh;
}

/// Three quarters of a plane: a concave corner on the boundary.
inline PolygonMesh lShape() {
  return only(plane(10, 10), [](const Vec3& p) { return p.x < 5.5 || p.y < 5.5; });
}

/// A plane with a rectangular hole: four concave corners.
inline PolygonMesh windowed() {
  return only(plane(10, 9),
              [](const Vec3& p) { return !(p.x > 3.5 && p.x < 6.5 && p.y > 3.5 && p.y < 5.5); });
}

/// A plane in which one row contains a face with `corners` (3 or 5) corners; the rows above it
/// have one more column.
inline PolygonMesh dart(Index corners, Index m = 8, Index n = 8) {
  PolygonMesh mesh;
  const Index low = n / 2, middle = m / 2;
  std::vector<Index> start;
  for (Index j = 0; j <= n; ++j) {
    start.push_back(static_cast<Index>(mesh.positions.size()));
    const Index columns = j <= low ? m : m + 1;
    for (Index i = 0; i <= columns; ++i) mesh.positions.push_back(onHill(10.0 * i / columns, j));
  }
  for (Index j = 0; j < n; ++j) {
    const Index a = start[j], b = start[j + 1];
    const Index columns = j <= low ? m : m + 1;
    for (Index i = 0; i < columns; ++i) {
      const Index up = j == low && (i > middle || (i == middle && corners == 3)) ? i + 1 : i;
      if (j == low && i == middle && corners == 3) addFace(mesh, {a + i, b + i + 1, b + i});
      if (j == low && i == middle && corners == 5)
        addFace(mesh, {a + i, a + i + 1, b + i + 2, b + i + 1, b + i});
      else
        addFace(mesh, {a + i, a + i + 1, b + up + 1, b + up});
    }
  }
  return mesh;
}

/// `valence` grids of n × n quads around vertex 0.
inline PolygonMesh pinwheel(Index valence, Index n = 4) {
  PolygonMesh mesh;
  mesh.positions.push_back(onHill(5, 4));
  const auto at = [&](Index sector, Index i, Index j) {  // 1 ≤ i ≤ n, 0 ≤ j ≤ n
    return 1 + (sector % valence) * n * (n + 1) + (i - 1) * (n + 1) + j;
  };
  const auto spoke = [&](Index s) {
    return Vec3{std::cos(turn(1.0 * s / valence)), std::sin(turn(1.0 * s / valence)), 0};
  };
  for (Index s = 0; s < valence; ++s)
    for (Index i = 1; i <= n; ++i)
      for (Index j = 0; j <= n; ++j) {
        const Vec3 p = 1.0 * i * spoke(s) + 1.0 * j * spoke(s + 1);
        mesh.positions.push_back(onHill(5 + p.x, 4 + p.y));
      }
  const auto vertex = [&](Index s, Index i, Index j) {
    return i == 0 && j == 0 ? 0 : i == 0 ? at(s + 1, j, 0) : at(s, i, j);
  };
  for (Index s = 0; s < valence; ++s)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        addFace(mesh, {vertex(s, i, j), vertex(s, i + 1, j), vertex(s, i + 1, j + 1),
                       vertex(s, i, j + 1)});
  return mesh;
}

inline PolygonMesh joined(PolygonMesh a, const PolygonMesh& b, const Vec3& offset) {
  const auto first = static_cast<Index>(a.positions.size());
  for (const Vec3& p : b.positions) a.positions.push_back(p + offset);
  for (Loop face : loopsOf(b.polygons)) {
    for (Index& v : face) v += first;
    addFace(a, face);
  }
  return a;
}

/// Displaces everything smoothly, differently for every k, by about a twentieth of `size`.
inline std::vector<Vec3> deformed(const std::vector<Vec3>& positions, int k, double size = 10) {
  std::vector<Vec3> result = positions;
  const double f = 3 / size, a = 0.05 * size;
  for (Vec3& p : result)
    p += a * Vec3{std::sin(f * p.y + k), std::sin(f * p.z + 2.0 * k), std::cos(f * p.x + 3.0 * k)};
  return result;
}

inline MeshRig withTargets(PolygonMesh mesh, int targets = 2, double size = 10) {
  MeshRig rig{std::move(mesh), {}};
  for (int k = 1; k <= targets; ++k)
    rig.targets.push_back({"target" + std::to_string(k), deformed(rig.neutral.positions, k, size)});
  return rig;
}

/// The same vertices, with faces removed, cut, flipped or sewn together, differently for every
/// seed.
inline PolygonMesh damaged(const PolygonMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  PolygonMesh result{mesh.positions, {}};
  const auto how = any(32);
  for (Loop face : loopsOf(mesh.polygons)) {
    if (how & 1 && any(100) < 8) continue;
    if (how & 4 && any(100) < 3) std::ranges::reverse(face);
    if (how & 2 && face.size() == 4 && any(100) < 15) {
      addFace(result, {face[0], face[1], face[2]});
      face.erase(face.begin() + 1);
    }
    addFace(result, face);
  }
  if (how & 8) {
    auto& corners = result.polygons.corners;
    const Index from = corners[any(corners.size())], to = corners[any(corners.size())];
    std::ranges::replace(corners, from, to);
  }
  if (how & 16) {
    Loop fin;
    for (int k = 0; k < 3; ++k) fin.push_back(static_cast<Index>(any(mesh.positions.size())));
    addFace(result, fin);
  }
  return result;
}

struct Face {
  const char* name;
  MeshRig rig;
  friend void PrintTo(const Face& face, std::ostream* out) { *out << face.name; }
};

/// One face of every kind, each with two targets.
inline const std::vector<Face>& everyFace() {
  static const std::vector<Face> faces = [] {
    std::vector<Face> list;
    const auto add = [&](const char* name, PolygonMesh mesh) {
      list.push_back({name, withTargets(std::move(mesh))});
    };
    add("plane", plane());
    add("cylinder", cylinder());
    add("seam", cylinder(16, 8, true));
    add("torus", torus());
    add("annulus", annulus());
    add("cubeSphere", cubeSphere());
    add("uvSphere", uvSphere());
    add("lShape", lShape());
    add("windowed", windowed());
    add("triangle", dart(3));
    add("pentagon", dart(5));
    add("pinwheel", pinwheel(5));
    add("two", joined(plane(6, 5), cubeSphere(3, 2), {4, 3, 12}));
    return list;
  }();
  return faces;
}

inline auto eachFace() { return ::testing::ValuesIn(everyFace()); }
inline std::string faceName(const ::testing::TestParamInfo<Face>& info) { return info.param.name; }

/// For every vertex, the first vertex that coincides with it in all poses.
inline std::vector<Index> weldedVertices(const MeshRig& rig) {
  std::map<std::vector<double>, Index> known;
  std::vector<Index> first;
  for (std::size_t v = 0; v < rig.neutral.positions.size(); ++v) {
    std::vector<double> key;
    const auto append = [&](const Vec3& p) { key.insert(key.end(), {p.x, p.y, p.z}); };
    append(rig.neutral.positions[v]);
    for (const MeshTarget& t : rig.targets) append(t.positions[v]);
    first.push_back(known.try_emplace(key, static_cast<Index>(v)).first->second);
  }
  return first;
}

/// The faces of a rig's neutral, with vertices welded.
inline std::vector<Loop> weldedLoops(const MeshRig& rig) {
  const std::vector<Index> first = weldedVertices(rig);
  std::vector<Loop> faces = loopsOf(rig.neutral.polygons);
  for (Loop& face : faces)
    for (Index& v : face) v = first[v];
  return faces;
}

struct Topology {
  int euler = 0;  ///< V − E + F
  int boundaryLoops = 0;
  int overfullEdges = 0;  ///< shared by more than two faces, or by two in the same direction
  std::size_t vertices = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
  friend void PrintTo(const Topology& t, std::ostream* out) {
    *out << "euler " << t.euler << ", boundary loops " << t.boundaryLoops << ", overfull edges "
         << t.overfullEdges << ", vertices " << t.vertices;
  }
};

/// Consecutive repetitions of a vertex in a face count once.
inline Topology topologyOf(const std::vector<Loop>& faces) {
  Topology t;
  std::set<Index> vertices;
  std::map<std::pair<Index, Index>, int> directed;
  int faceCount = 0;
  for (Loop face : faces) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    while (face.size() > 1 && face.front() == face.back()) face.pop_back();
    if (face.size() < 3) continue;
    ++faceCount;
    for (std::size_t k = 0; k < face.size(); ++k) {
      vertices.insert(face[k]);
      ++directed[{face[k], face[(k + 1) % face.size()]}];
    }
  }
  int edges = 0;
  std::map<Index, Index> onward;
  for (const auto& [edge, count] : directed) {
    const auto back = directed.find({edge.second, edge.first});
    if (count > 1) ++t.overfullEdges;
    if (back == directed.end()) onward[edge.first] = edge.second;
    edges += back == directed.end() || edge.first < edge.second;
  }
  while (!onward.empty()) {
    ++t.boundaryLoops;
    for (auto it = onward.begin(); it != onward.end();) {
      const Index next = it->second;
      onward.erase(it);
      it = onward.find(next);
    }
  }
  t.vertices = vertices.size();
  t.euler = static_cast<int>(vertices.size()) - edges + faceCount;
  return t;
}

/// The folder of real faces, or an empty string, in which case tests that need it are skipped.
inline std::string realFaces() {
  const char* folder = std::getenv("SWEEPFACE_DATA");
  return folder ? folder : "";
}

#define SKIP_WITHOUT_REAL_FACES()              \
  if (sweepface::testing::realFaces().empty()) \
  GTEST_SKIP() << "SWEEPFACE_DATA does not name a folder of real faces"

}  // namespace sweepface::testing
