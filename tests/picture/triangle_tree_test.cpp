#include "picture/triangle_tree.hpp"

#include <random>

#include "picture/obstacles.hpp"
#include "picture/scenes.hpp"

namespace sweepface {
namespace {

using Triangle = std::array<Index, 3>;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

/// Triangles of a tenth of the unit cube's size all over it.
Soup soup(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> all(0, 1), near(-0.05, 0.05);
  Soup soup;
  for (int t = 0; t < count; ++t) {
    const Vec3 centre{all(random), all(random), all(random)};
    const auto first = static_cast<Index>(soup.positions.size());
    for (int k = 0; k < 3; ++k)
      soup.positions.push_back(centre + Vec3{near(random), near(random), near(random)});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// Whether a ray meets a triangle between `near` and `far`: by the volumes that it spans with the
/// edges.
bool meets(const Soup& soup, const Triangle& t, const Vec3& from, const Vec3& direction,
           double near, double far) {
  const Vec3 a = soup.positions[t[0]] - from, b = soup.positions[t[1]] - from,
             c = soup.positions[t[2]] - from;
  const double ab = dot(direction, cross(a, b)), bc = dot(direction, cross(b, c)),
               ca = dot(direction, cross(c, a));
  if ((ab < 0 || bc < 0 || ca < 0) && (ab > 0 || bc > 0 || ca > 0)) return false;
  const Vec3 normal = cross(b - a, c - a);
  const double distance = dot(a, normal) / dot(direction, normal);
  return distance >= near && distance <= far;
}

TEST(TriangleTree, FindsWhatALookAtEveryTriangleFinds) {
  std::mt19937 random(7);
  const Soup all = soup(1500, random);
  const TriangleTree tree(all.positions, all.triangles);
  std::uniform_real_distribution<double> place(-0.2, 1.2);
  int blocked = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from{place(random), place(random), place(random)};
    const Vec3 direction =
        normalized({place(random) - 0.5, place(random) - 0.5, place(random) - 0.5});
    const double far = k % 2 == 0 ? 0.3 : 2;
    const bool expected = std::ranges::any_of(all.triangles, [&](const Triangle& t) {
      return meets(all, t, from, direction, 0.01, far);
    });
    blocked += expected;
    EXPECT_EQ(tree.blocks(from, direction, 0.01, far), expected) << k;
  }
  EXPECT_GT(blocked, 100);
  EXPECT_LT(blocked, 900);
}

TEST(TriangleTree, SeesAlongAxesAndWithinPlanes) {
  // A square in the plane z = 0: boxes without depth.
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
  const TriangleTree tree(corners, square);
  EXPECT_TRUE(tree.blocks({0.3, 0.6, 1}, {0, 0, -1}, 0.1, 2));
  EXPECT_TRUE(tree.blocks({0.5, 0.5, 1}, {0, 0, -1}, 0.1, 2)) << "the edge between the two";
  EXPECT_TRUE(tree.blocks({0, 0, 1}, {0, 0, -1}, 0.1, 2)) << "a corner";
  EXPECT_FALSE(tree.blocks({0.3, 0.6, 1}, {0, 0, 1}, 0.1, 2)) << "behind";
  EXPECT_FALSE(tree.blocks({0.3, 0.6, 1}, {0, 0, -1}, 0.1, 0.9)) << "too far";
  EXPECT_FALSE(tree.blocks({0.3, 0.6, 1}, {0, 0, -1}, 1.1, 2)) << "too near";
  EXPECT_FALSE(tree.blocks({-1, 0.5, 0}, {1, 0, 0}, 0.1, 5)) << "has no thickness";
}

TEST(TriangleTree, HasNothingWhereThereIsNothing) {
  EXPECT_FALSE(TriangleTree({}, {}).blocks({0, 0, 0}, {0, 0, 1}, 0, 1));
}

TEST(TriangleTree, SeesWhatPicturesSee) {
  std::mt19937 random(11);
  const Soup all = soup(500, random);
  const TriangleTree tree(all.positions, all.triangles);
  const auto obstacles = Obstacles::make(all.positions, all.triangles);
  ASSERT_TRUE(obstacles);
  std::uniform_real_distribution<double> place(0, 1);
  int different = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 from{place(random), place(random), place(random)};
    const Vec3 direction =
        normalized({place(random) - 0.5, place(random) - 0.5, place(random) - 0.5});
    different +=
        tree.blocks(from, direction, 1e-3, 0.5) != obstacles->blocks(from, direction, 1e-3, 0.5);
  }
  EXPECT_LE(different, 5) << "rays that graze an edge, which floats round to either side";
}

}  // namespace
}  // namespace sweepface
