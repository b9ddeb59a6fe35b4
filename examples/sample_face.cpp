// Writes a small head and eight expressions as OBJ files: sample_face OUTDIR
//
// The mesh starts as the surface of a box of grid cells. Blocks of cells at the eyes and the mouth
// give way to rings round a hole; relaxing evens out the rest. sample_head.hpp gives the shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sample_head.hpp"

namespace {

using namespace sample;

// ---- The mesh ----

constexpr std::string_view headSkin = "g head\nusemtl skin\n";
constexpr std::string_view faceSkin = "g face\nusemtl skin\n";
constexpr std::string_view faceLips = "g face\nusemtl lips\n";

struct Quad {
  std::array<int, 4> corners;
  std::string_view part;  ///< an OBJ group and material
};

struct Mesh {
  std::vector<Site> sites;
  std::vector<Quad> quads;
};

using Cell = std::array<int, 3>;
constexpr Cell cells{20, 34, 14};

/// The site of a point of the box's surface, seen from inside: equal angles along its middle lines.
Site boxSite(const Cell& at) {
  const auto angle = [&](int axis, double first, double last) {
    return std::tan((first + (last - first) * at[axis] / cells[axis]) * degree);
  };
  const double width = std::tan(52 * degree), x = angle(0, -52, 52), y = angle(1, -76, 62);
  const double z = angle(2, -38, 38) * width;
  return {std::atan2(x, z) / degree, std::atan2(std::hypot(x, z), y) / degree};
}

Vec3 direction(const Site& site) {
  const double a = site.around * degree, d = site.down * degree;
  return {std::sin(d) * std::sin(a), std::cos(d), std::sin(d) * std::cos(a)};
}

/// A hole in the front: the block of cells that it replaces, and its loops.
struct Opening {
  int left, right, bottom, top;
  Loop outline, hole;
  std::string_view part;  ///< inside the outline
  double depth;           ///< how far the hole's edge is turned in

  bool covers(int i, int j) const { return i >= left && i < right && j >= bottom && j < top; }

  /// Where a point of the block's border goes on the loops, at whose corners there is one each.
  double angle(const Cell& at) const {
    const double x = 2.0 * at[0] - left - right, y = 2.0 * at[1] - bottom - top;
    return std::atan2(y / (top - bottom), x / (right - left));
  }
};

const std::array<Opening, 3> openings{{
    {11, 19, 19, 25, eyeCrease, eyeHole, faceSkin, 0.4},
    {1, 9, 19, 25, mirrored(eyeCrease), mirrored(eyeHole), faceSkin, 0.4},
    {3, 17, 10, 14, lipOutline, mouthHole, faceLips, 0.5},
}};

bool isOpen(int i, int j) {
  return std::ranges::any_of(openings, [&](const Opening& o) { return o.covers(i, j); });
}

/// The box's points along an opening's block, counter-clockwise seen from the front.
std::vector<Cell> border(const Opening& o) {
  std::vector<Cell> loop;
  for (int i = o.left; i < o.right; ++i) loop.push_back({i, o.bottom, cells[2]});
  for (int j = o.bottom; j < o.top; ++j) loop.push_back({o.right, j, cells[2]});
  for (int i = o.right; i > o.left; --i) loop.push_back({i, o.top, cells[2]});
  for (int j = o.top; j > o.bottom; --j) loop.push_back({o.left, j, cells[2]});
  return loop;
}

/// The sites of one ring; rings 1 to 3 lead to the outline, 4 and 5 to the hole, 6 turns in.
Site ringSite(const Opening& o, Vec2 from, double angle, int ring) {
  const Vec2 outline = o.outline.at(angle), hole = o.hole.at(angle);
  const Vec2 a = ring <= 3 ? from : outline, b = ring <= 3 ? outline : hole;
  const double t = ring <= 3 ? ring / 3.0 : std::min(1.0, (ring - 3) / 2.0);
  Site site = siteAt({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
  site.in = ring == 6 ? o.depth : 0;
  site.near = smoothstep(0, 5, ring);
  site.edge = hole;
  return site;
}

class MeshBuilder {
 public:
  Mesh build() && {
    for (int axis = 0; axis < 3; ++axis) {
      addSide(axis, 0);
      addSide(axis, cells[axis]);
    }
    for (const Opening& opening : openings) addRings(opening);
    for (int pass = 0; pass < 30; ++pass) relax();
    return std::move(mesh_);
  }

 private:
  int vertex(const Cell& at) {
    const auto [found, isNew] = vertices_.try_emplace(at, static_cast<int>(mesh_.sites.size()));
    if (isNew) mesh_.sites.push_back(boxSite(at));
    return found->second;
  }

  void addSide(int axis, int level) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool front = axis == 2 && level > 0;
    for (int i = 0; i < cells[u]; ++i)
      for (int j = 0; j < cells[v]; ++j) {
        if (front && isOpen(i, j)) continue;
        const auto corner = [&](int di, int dj) {
          Cell at;
          at[axis] = level, at[u] = i + di, at[v] = j + dj;
          return vertex(at);
        };
        std::array corners{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        if (level == 0) std::swap(corners[1], corners[3]);
        mesh_.quads.push_back({corners, front ? faceSkin : headSkin});
      }
  }

  void addRings(const Opening& opening) {
    const std::vector<Cell> loop = border(opening);
    std::vector<int> outer;
    for (const Cell& at : loop) outer.push_back(vertex(at));
    for (int ring = 1; ring <= 6; ++ring) {
      std::vector<int> inner;
      for (const Cell& at : loop) {
        const Vec3 p = loft(mesh_.sites[vertex(at)]);
        inner.push_back(static_cast<int>(mesh_.sites.size()));
        mesh_.sites.push_back(ringSite(opening, {p.x, p.y}, opening.angle(at), ring));
      }
      const std::string_view part = ring > 3 ? opening.part : faceSkin;
      for (std::size_t k = 0, last = loop.size() - 1; k <= last; ++k) {
        const std::size_t next = k < last ? k + 1 : 0;
        mesh_.quads.push_back({{outer[k], outer[next], inner[next], inner[k]}, part});
      }
      outer = inner;
    }
  }

  /// Moves every site towards the middle of its neighbours, but those of the lips and lids.
  void relax() {
    std::vector<Vec3> sums(mesh_.sites.size());
    for (const Quad& quad : mesh_.quads)
      for (int k = 0; k < 4; ++k) {
        sums[quad.corners[k]] += direction(mesh_.sites[quad.corners[(k + 1) % 4]]);
        sums[quad.corners[k]] += direction(mesh_.sites[quad.corners[(k + 3) % 4]]);
      }
    for (std::size_t v = 0; v < sums.size(); ++v) {
      Site& site = mesh_.sites[v];
      if (site.near > 0.6) continue;
      const Vec3 to = normalized(sums[v]) + direction(site);
      site.around = std::atan2(to.x, to.z) / degree;
      site.down = std::atan2(std::hypot(to.x, to.z), to.y) / degree;
    }
  }

  Mesh mesh_;
  std::map<Cell, int> vertices_;
};

// ---- Writing ----

struct Expression {
  const char* name;
  std::function<Vec3(const Skin&)> offset;
};

const std::vector<Expression> expressions{
    {"jawOpen", jawOpen},
    {"eyeBlinkLeft", [](const Skin& skin) { return eyeBlink(skin, 1); }},
    {"eyeBlinkRight", [](const Skin& skin) { return eyeBlink(skin, -1); }},
    {"mouthSmileLeft", [](const Skin& skin) { return mouthSmile(skin, 1); }},
    {"mouthSmileRight", [](const Skin& skin) { return mouthSmile(skin, -1); }},
    {"browInnerUp", browInnerUp},
    {"mouthPucker", mouthPucker},
    {"noseSneerLeft", noseSneerLeft},
};

/// Texture coordinates wrap round the head; vertices on the seam at the back have a second set.
std::string objText(const Mesh& mesh, const std::vector<Vec3>& points) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const Vec3& p : points) fmt::format_to(out, "v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);

  std::string seam;
  std::map<int, int> beyondSeam;
  for (int v = 0, count = static_cast<int>(points.size()); const Site& site : mesh.sites) {
    const double height = 1 - site.down / 180;
    fmt::format_to(out, "vt {:.9g} {:.9g}\n", 0.5 + site.around / 360, height);
    if (site.around > 179.99) {
      beyondSeam[v] = count + static_cast<int>(beyondSeam.size());
      fmt::format_to(std::back_inserter(seam), "vt 0 {:.9g}\n", height);
    }
    ++v;
  }
  text += seam;

  std::string_view part;
  for (const Quad& quad : mesh.quads) {
    if (quad.part != part) text += part = quad.part;
    const bool right =
        std::ranges::any_of(quad.corners, [&](int v) { return mesh.sites[v].around < -90; });
    text += 'f';
    for (int v : quad.corners) {
      const int vt = right && beyondSeam.contains(v) ? beyondSeam[v] : v;
      fmt::format_to(out, " {}/{}", v + 1, vt + 1);
    }
    text += '\n';
  }
  return text;
}

bool write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) fmt::print(stderr, "sample_face: cannot write {}\n", path.string());
  return file.good();
}

bool writeAll(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder / "expressions", error);
  const Mesh mesh = MeshBuilder().build();
  std::vector<Skin> skins;
  std::vector<Vec3> points;
  for (const Site& site : mesh.sites) {
    skins.push_back({site, loft(site), neutralPoint(site)});
    points.push_back(skins.back().point);
  }
  if (!write(folder / "neutral.obj", objText(mesh, points))) return false;
  for (const Expression& expression : expressions) {
    std::ranges::transform(skins, points.begin(),
                           [&](const Skin& s) { return s.point + expression.offset(s); });
    const auto path = folder / "expressions" / (std::string(expression.name) + ".obj");
    if (!write(path, objText(mesh, points))) return false;
  }
  fmt::print("{}: neutral.obj and expressions/ with {} more, of {} vertices and {} quads\n",
             folder.string(), expressions.size(), mesh.sites.size(), mesh.quads.size());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: sample_face OUTDIR\n");
    return 2;
  }
  return writeAll(argv[1]) ? 0 : 1;
}
