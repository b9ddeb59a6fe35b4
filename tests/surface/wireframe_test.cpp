#include <map>
#include <set>

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Connectivity connect(const Wireframe& w) { return Connectivity::make(w).value(); }
std::string refusal(const Wireframe& w) {
  const auto surface = Surface::make(w);
  return surface ? "" : surface.error().message;
}

TEST(Surfaces, areTheSameWhereItIsKnownWhoMeetsWhom) {
  for (const Wireframe& w : {twoPatches(), tee(), fan(5)}) {
    const Surface surface = Surface::make(w).value(), other = Surface::make(w, connect(w)).value();
    ASSERT_EQ(other.vectorCount(), surface.vectorCount());
    EXPECT_EQ(other.connectivity().patchOf, surface.connectivity().patchOf);
    const std::vector<Vec3> stored(surface.storedCount(), Vec3{1, 2, 3});
    std::vector<Vec3> vectors(surface.vectorCount()), others = vectors;
    surface.settle(stored, vectors);
    other.settle(stored, others);
    EXPECT_EQ(others, vectors);
  }
}

TEST(Kinds, cornersAndSidesOfABoundaryCross) {
  for (NodeKind kind : connect(twoPatches()).kinds) EXPECT_EQ(kind, NodeKind::crossing);
}

TEST(Kinds, aTNodeHangs) {
  const Connectivity c = connect(tee());
  for (std::size_t n = 0; n < c.kinds.size(); ++n)
    EXPECT_EQ(c.kinds[n], n == 3 ? NodeKind::hanging : NodeKind::crossing);
}

TEST(Kinds, threePatchesAroundANodeAreIrregular) {
  const Surface cube = surfaceOf(MeshRig{cubeSphere(2), {}});
  EXPECT_EQ(cube.connectivity().kinds, std::vector<NodeKind>(8, NodeKind::irregular));
  for (const Star& star : cube.connectivity().stars) {
    EXPECT_TRUE(star.closed);
    EXPECT_EQ(star.arms.size(), 3u);
  }
}

TEST(Kinds, aConcaveCornerIsIrregular) {
  const Surface l = surfaceOf(MeshRig{lShape(), {}});
  EXPECT_EQ(std::ranges::count(l.connectivity().kinds, NodeKind::irregular), 1);
}

TEST(Kinds, aPoleIsIrregularOnEveryRay) {
  const Connectivity c = connect(fan(5));
  EXPECT_EQ(std::ranges::count(c.kinds, NodeKind::irregular), 5);
}

TEST(Kinds, aRailRunsThroughTNodes) {
  const Wireframe w = tee();
  const Rail rail = connect(w).rails[2 * 1];
  EXPECT_EQ(rail.edges, 4);
  EXPECT_EQ(w.end(rail.last), 4);
}

// Arm by arm, the patch to the left of one arm is the patch to the right of the next.
TEST(Stars, areCounterClockwise) {
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const Wireframe& w = surface.wireframe();
    const Connectivity& c = surface.connectivity();
    for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n) {
      const Star& star = c.stars[n];
      ASSERT_EQ(star.sectors.size(), star.arms.size() - (star.closed ? 0 : 1));
      for (HalfArc arm : star.arms) EXPECT_EQ(w.start(arm), n);
      for (std::size_t s = 0; s < star.sectors.size(); ++s) {
        const HalfArc arm = star.arms[s], next = star.arms[(s + 1) % star.arms.size()];
        EXPECT_EQ(c.patchOf[arm], c.patchOf[twin(next)]);
        EXPECT_EQ(c.next[twin(next)], arm);
        EXPECT_EQ(star.sectors[s], c.cornerAt[arm]);
      }
      if (!star.closed) {
        EXPECT_EQ(c.patchOf[twin(star.arms.front())], -1);
        EXPECT_EQ(c.patchOf[star.arms.back()], -1);
      }
    }
  }
}

TEST(Stars, oppositeArmsAreEachOthersOpposite) {
  for (const auto& [name, surface] : everySurface()) {
    const Connectivity& c = surface.connectivity();
    for (Index n = 0; n < static_cast<Index>(c.stars.size()); ++n)
      for (int k = 0; k < static_cast<int>(c.stars[n].arms.size()); ++k)
        if (const int on = c.opposite(n, k); on >= 0) {
          EXPECT_EQ(c.opposite(n, on), k) << name;
        }
  }
}

struct Broken {
  const char* name;
  std::function<Wireframe()> make;
  const char* message;
  friend void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }
};

template <typename Change>
auto with(Wireframe w, Change change) {
  return [=] {
    Wireframe broken = w;
    change(broken);
    return broken;
  };
}

const Broken broken[] = {
    {"openLoop", with(onePatch(2, 2), [](Wireframe& w) { w.loops[2] = 4; }),
     "patch 0 is not a closed loop of arcs"},
    {"arcTwice",
     with(twoPatches(), [](Wireframe& w) { std::copy_n(w.loops.begin(), 4, w.loops.begin() + 4); }),
     "arc 0 is used twice in the same direction"},
    {"differentLengths", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[2].edges = 3; }),
     "patch 0 has opposite sides of different length"},
    {"differentWidths", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[1].edges = 3; }),
     "patch 0 has opposite sides of different length"},
    {"missingNode", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[1].to = 4; }),
     "arc 1 ends at a node that does not exist"},
    {"negativeNode", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[3].from = -1; }),
     "arc 3 ends at a node that does not exist"},
    {"lonelyNode", with(onePatch(2, 2), [](Wireframe& w) { w.nodes.push_back({0, kPosition}); }),
     "node 4 belongs to no patch"},
    {"noLength", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[0].edges = 0; }),
     "arc 0 has no length"},
    {"noRibbon", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[2].ribbon = 2; }),
     "arc 2 belongs to a ribbon that does not exist"},
    {"noPoint", with(onePatch(2, 2), [](Wireframe& w) { w.nodes[2].point = 4; }),
     "node 2 stands at a point that does not exist"},
    {"pointless", with(onePatch(2, 2), [](Wireframe& w) { w.nodes[2].point = -1; }),
     "node 2 needs a point of its own"},
    {"pointOnTNode", with(tee(), [](Wireframe& w) { w.nodes[3].point = 0; }),
     "node 3 hangs on an arc and must not have a point"},
    {"noSide", with(onePatch(2, 2), [](Wireframe& w) { w.patches[0].sides[2] = 1; }),
     "patch 0 lacks a side"},
    {"noArc", with(onePatch(2, 2), [](Wireframe& w) { w.loops[1] = 8; }),
     "a patch is bounded by an arc that does not exist"},
    {"jetWithGaps", with(onePatch(2, 2), [](Wireframe& w) { w.nodes[1].stored = 0b101; }),
     "node 1 stores a derivative without those before it"},
    {"tooLong",
     with(onePatch(2, 2),
          [](Wireframe& w) {
            for (Arc& a : w.arcs) a.edges = 1 << 30;
          }),
     "the arcs are too long, together 4294967296 edges"},
    {"gapInLoops",
     with(onePatch(2, 2),
          [](Wireframe& w) {
            w.loops.insert(w.loops.begin(), 1);
            for (Index& s : w.patches[0].sides) ++s;
          }),
     "patch 0 does not begin where the one before it ends"},
    {"loopsWithoutPatch", with(onePatch(2, 2), [](Wireframe& w) { w.loops.push_back(1); }),
     "the loops go on after all patches"},
    {"idleArc", with(onePatch(2, 2), [](Wireframe& w) { w.arcs.push_back(w.arcs[0]); }),
     "arc 4 bounds no patch"},
    {"halfT",
     [] {  // a side of two arcs on the boundary: no third arc arrives
       Wireframe w = onePatch(2, 2);
       w.points = 5;
       w.nodes.push_back({4, kWholeJet});
       w.arcs[0] = arc(0, 4, 1, 0);
       w.arcs.push_back(arc(4, 1, 1, 0));
       w.patches = {{{0, 2, 3, 4, 5}}};
       w.loops = {0, 8, 2, 5, 6};
       return w;
     },
     "node 4 stands on the side of a patch but is no T of three arcs"},
    {"boundaryT", with(tee(), [](Wireframe& w) { w.patches.pop_back(), w.loops.resize(9); }),
     "node 3 stands on the side of a patch but is no T of three arcs"},
    {"ringOfTNodes",
     [] {  // two patches around a tube, whose seams end on the ring between them
       Wireframe w;
       w.points = 2;
       w.nodes = {{0, kPosition}, {-1, kPosition}, {-1, kPosition}, {1, kPosition}};
       w.arcs = {arc(1, 2, 2, 0), arc(2, 1, 2, 0), arc(0, 0, 4, 0),
                 arc(0, 1, 1, 0), arc(3, 3, 4, 0), arc(2, 3, 1, 0)};
       w.patches = {{{0, 1, 2, 4, 5}}, {{5, 7, 8, 9, 10}}};
       w.loops = {4, 6, 3, 1, 7, 2, 0, 10, 9, 11};
       w.ribbons = {{}};
       return w;
     },
     "arc 0 lies on a ring of T-nodes; cut it at a node"},
    {"touching",
     [] {  // two patches that share one node and nothing else
       Wireframe w = onePatch(1, 1), other = onePatch(1, 1);
       w.points = 7;
       for (Index k = 4; k < 7; ++k) w.nodes.push_back({k, kWholeJet});
       for (Arc a : other.arcs) {
         a.from = a.from == 0 ? 2 : a.from + 3;
         a.to = a.to == 0 ? 2 : a.to + 3;
         w.arcs.push_back(a);
       }
       for (HalfArc h : other.loops) w.loops.push_back(h + 8);
       w.patches.push_back({{4, 5, 6, 7, 8}});
       return w;
     },
     "node 2 joins patches that only touch there; give each its own node"},
    {"ribbonHalfWay", with(tee(), [](Wireframe& w) { w.arcs[2].ribbon = 1; }),
     "a side of patch 0 changes its ribbon half-way"},
    {"twoRibbons", with(onePatch(2, 2), [](Wireframe& w) { w.arcs[2].ribbon = 1; }),
     "patch 0 sweeps along sides of two ribbons"},
    {"refusedShape",
     with(onePatch(2, 2), [](Wireframe& w) { w.ribbons[0] = {1, 80.7836 / 4, 1.0 / 16}; }),
     "ribbon 0: "},
    {"refusedLength",  // two ribbons of one shape, one of them too long for it
     with(onePatch(3, 40), [](Wireframe& w) { w.ribbons[0] = w.ribbons[1] = {1, 1000, 0}; }),
     "ribbon 1: "},
    {"noShape", with(onePatch(2, 2), [](Wireframe& w) { w.ribbons[1] = {0, 0, 0}; }), "ribbon 1: "},
};

class Refusal : public ::testing::TestWithParam<Broken> {};
INSTANTIATE_TEST_SUITE_P(Wireframe, Refusal, ::testing::ValuesIn(broken),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Refusal, namesThePlace) {
  const std::string message = refusal(GetParam().make());
  EXPECT_TRUE(message.starts_with(GetParam().message)) << message;
}

// Four T-nodes in a whirl: every arc ends on the next one's rail.
Wireframe whirl() {
  Wireframe w;
  const auto node = [&](Index point) { w.nodes.push_back({point, kPosition}); };
  for (Index k = 0; k < 8; ++k) node(k);
  for (Index k = 0; k < 4; ++k) node(-1);
  w.points = 8;
  // corners 0 (0,0), 2 (3,0), 4 (3,3), 6 (0,3); sides 1 (2,0), 3 (3,2), 5 (1,3), 7 (0,1);
  // inner 8 (2,1), 9 (2,2), 10 (1,2), 11 (1,1)
  const auto add = [&](Index a, Index b, Index edges, Index ribbon) {
    w.arcs.push_back(arc(a, b, edges, ribbon));
    return static_cast<HalfArc>(2 * w.arcs.size() - 2);
  };
  const HalfArc s01 = add(0, 1, 2, 0), s12 = add(1, 2, 1, 0), s23 = add(2, 3, 2, 0),
                s34 = add(3, 4, 1, 0), s45 = add(4, 5, 2, 0), s56 = add(5, 6, 1, 0),
                s67 = add(6, 7, 2, 0), s70 = add(7, 0, 1, 0);
  const HalfArc r1 = add(1, 8, 1, 0), q1 = add(8, 9, 1, 0), r3 = add(3, 9, 1, 0),
                q3 = add(9, 10, 1, 0), r5 = add(5, 10, 1, 0), q5 = add(10, 11, 1, 0),
                r7 = add(7, 11, 1, 0), q7 = add(11, 8, 1, 0);
  const auto patch = [&](std::initializer_list<std::initializer_list<HalfArc>> sides) {
    Patch p;
    int s = 0;
    for (const auto& side : sides) {
      p.sides[s++] = static_cast<Index>(w.loops.size());
      w.loops.insert(w.loops.end(), side);
    }
    p.sides[4] = static_cast<Index>(w.loops.size());
    w.patches.push_back(p);
  };
  patch({{s01}, {r1}, {twin(q7), twin(r7)}, {s70}});
  patch({{s23}, {r3}, {twin(q1), twin(r1)}, {s12}});
  patch({{s45}, {r5}, {twin(q3), twin(r3)}, {s34}});
  patch({{s67}, {r7}, {twin(q5), twin(r5)}, {s56}});
  patch({{q1}, {q3}, {q5}, {q7}});
  w.ribbons = {{}};
  return w;
}

// The arc between the patches is collapsed: both have a side there that is one point, with nothing
// that goes around it.
TEST(Poles, mustHaveAnAngle) {
  Wireframe w = twoPatches();
  const Connectivity c = connect(w);
  for (std::size_t a = 0; a < w.arcs.size(); ++a)
    if (c.patchOf[2 * a] >= 0 && c.patchOf[2 * a + 1] >= 0) {
      w.arcs[a].collapsed = true;
      w.nodes[w.arcs[a].to].point = w.nodes[w.arcs[a].from].point;
    }
  EXPECT_NE(refusal(w).find("have a side that is one point there"), std::string::npos)
      << refusal(w);
}

TEST(Circles, areRefusedAndNameANodeThatBreaksThem) {
  Wireframe w = whirl();
  for (int round = 0; round < 9; ++round) {
    std::vector<Index> circle;
    const auto surface = Surface::make(w, &circle);
    ASSERT_FALSE(surface);
    ASSERT_FALSE(circle.empty());
    EXPECT_TRUE(surface.error().message.ends_with(
        circle.front() < 8 ? "are derived from themselves; let it store its own"
                           : "make one of them a corner on both sides"))
        << surface.error().message;
    for (Index node : circle) {
      if (node >= 8) return;  // a T-node: it must become a crossing
      EXPECT_NE(w.nodes[node].stored, kWholeJet) << "node " << node;
      w.nodes[node].stored = kWholeJet;
    }
  }
  FAIL() << "no T-node is named";
}

/// Slices of a square, from the bottom and from the left in turn: each begins at a T-node on the
/// one before.
Wireframe slices(Index size) {
  using Place = std::array<Index, 2>;
  std::vector<std::array<Place, 4>> boxes;
  const auto add = [&](Index left, Index bottom, Index right, Index top) {
    boxes.push_back({{{left, bottom}, {right, bottom}, {right, top}, {left, top}}});
  };
  for (Index k = 0; k + 1 < size; ++k) {
    add(k, k, size, k + 1);
    add(k, k + 1, k + 1, size);
  }
  add(size - 1, size - 1, size, size);

  Wireframe w;
  std::map<Place, Index> nodes;
  for (const auto& box : boxes)
    for (const Place& corner : box)
      if (nodes.emplace(corner, static_cast<Index>(nodes.size())).second)
        w.nodes.push_back({-1, kPosition});
  std::map<std::array<Index, 2>, HalfArc> arcs;
  std::set<Index> inside;  // nodes within a side
  for (const auto& box : boxes) {
    Patch patch;
    for (int s = 0; s < 4; ++s) {
      patch.sides[s] = static_cast<Index>(w.loops.size());
      const Place goal = box[(s + 1) % 4];
      Index edges = 0, from = nodes.at(box[s]);
      for (Place at = box[s]; at != goal;) {
        for (int c = 0; c < 2; ++c) at[c] += (goal[c] > at[c]) - (goal[c] < at[c]);
        ++edges;
        const auto node = nodes.find(at);
        if (node == nodes.end()) continue;
        const Index to = node->second;
        if (at != goal) inside.insert(to);
        const auto [known, isNew] =
            arcs.emplace(std::array{from, to}, static_cast<HalfArc>(2 * w.arcs.size()));
        if (isNew) {
          arcs[{to, from}] = known->second + 1;
          w.arcs.push_back(arc(from, to, edges, 0));
        }
        w.loops.push_back(known->second);
        from = to, edges = 0;
      }
    }
    patch.sides[4] = static_cast<Index>(w.loops.size());
    w.patches.push_back(patch);
  }
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    if (!inside.contains(static_cast<Index>(n))) w.nodes[n] = {w.points++, kWholeJet};
  w.ribbons = {{}};
  return w;
}

// Tables for evaluation take as long as there are vectors behind a vertex.
TEST(Derivations, areRefusedWhereTheyGoOnAndOn) {
  EXPECT_EQ(refusal(slices(33)), "");
  const std::string why = refusal(slices(34));
  EXPECT_NE(why.find("take too many steps: nodes on sides stand on each other's"),
            std::string::npos)
      << why;
}

}  // namespace
}  // namespace sweepface
