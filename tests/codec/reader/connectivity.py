"""The connectivity of a wireframe: docs/wireframe.md, "Half-arcs, stars and lines"."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from wireframe import Wireframe

CROSSING, IRREGULAR, HANGING, CREASED = range(4)  # kinds of nodes
STRAIGHT = -1  # a sector where the side of a patch runs straight through


@dataclass
class Star:
    arms: list[int]  # half-arcs that leave the node, counter-clockwise
    sectors: list[int]  # sector k follows arm k counter-clockwise: 4 * patch + corner, or STRAIGHT
    closed: bool


class Rail(NamedTuple):
    last: int  # the half-arc that arrives at its end
    edges: int


@dataclass
class Fan:
    first: int  # arm
    sectors: int
    step: float = 0.0
    regular: bool = True
    first_given: bool = False
    last_given: bool = False


@dataclass
class Connectivity:
    patch_of: list[int]  # [half-arcs] the patch on the left, or -1
    corner_at: list[int]  # [half-arcs] 4 * patch + side where a side starts with it, or -1
    next: list[int]  # [half-arcs] the next one in the loop of the patch on the left, or -1
    prev: list[int]
    stars: list[Star] = field(default_factory=list)  # [nodes]
    kinds: list[int] = field(default_factory=list)  # [nodes]
    fans: list[list[Fan]] = field(default_factory=list)  # [nodes] empty unless creased
    corner_sector: list[int] = field(default_factory=list)  # [4 * patches] the place in the star
    corner_node: list[int] = field(default_factory=list)  # [4 * patches]
    rails: list[Rail] = field(default_factory=list)  # [half-arcs] the straight run from it

    def opposite(self, node: int, arm: int) -> int:
        """The arm that continues an arm straight on across the node, or -1."""
        star, kind = self.stars[node], self.kinds[node]
        if kind in (IRREGULAR, CREASED):
            return -1
        if not star.closed:
            return 2 - arm if len(star.sectors) == 2 and arm != 1 else -1
        quarters, arms = 0, len(star.arms)
        for k in range(arms):
            if quarters == 2:
                return (arm + k) % arms
            quarters += 2 if star.sectors[(arm + k) % arms] == STRAIGHT else 1
        return -1


def linked(w: Wireframe) -> Connectivity:
    """Connectivity with the loops only."""
    halves = 2 * len(w.arcs)
    c = Connectivity(*([-1] * halves for _ in range(4)))
    for p, sides in enumerate(w.patches):
        loop = w.loops[sides[0]:sides[4]]
        for h, g in zip(loop, loop[1:] + loop[:1]):
            if c.patch_of[h] >= 0 or w.end(h) != w.start(g):
                raise ValueError("a patch is not a closed loop of arcs")
            c.patch_of[h], c.next[h], c.prev[g] = p, g, h
        for s in range(4):
            c.corner_at[w.loops[sides[s]]] = 4 * p + s
    return c


def star_at(c: Connectivity, leaving: list[int]) -> Star:
    """`leaving`: the half-arcs of loops that leave the node, in the order of the loops."""
    first = ([leaving[0]] + [h for h in leaving if c.patch_of[h ^ 1] < 0])[-1]
    arms, sectors, h = [], [], first
    while True:
        arms.append(h)
        sectors.append(c.corner_at[h])
        h = c.prev[h] ^ 1
        if h == first or c.patch_of[h] < 0:
            break
    if h != first:
        arms.append(h)
    if len(sectors) != len(leaving):
        raise ValueError("a node joins patches that only touch there")
    return Star(arms, sectors, h == first)


def is_crease(w: Wireframe, c: Connectivity, h: int) -> bool:
    return w.arcs[h >> 1].crease and c.patch_of[h] >= 0 and c.patch_of[h ^ 1] >= 0


def fans_of(w: Wireframe, c: Connectivity, star: Star) -> list[Fan]:
    """The fans of a star, an empty list if creases do not cut it."""
    cuts = [k for k, h in enumerate(star.arms) if is_crease(w, c, h)]
    if len(cuts) < (2 if star.closed else 1):
        return []
    if star.closed:
        cuts.append(cuts[0] + len(star.arms))
    else:
        cuts = [0, *cuts, len(star.sectors)]
    fans = [Fan(a, b - a) for a, b in zip(cuts, cuts[1:])]
    if star.closed:
        fans = in_turn(fans)
        fans[-1].last_given = True
    single = star.closed and fans[-1].sectors == 1
    for k, fan in enumerate(fans):
        fan.first_given = k > 0
        if single:
            angle = 2 * math.pi * fan.sectors / len(star.sectors)
        elif star.closed:
            angle = 2 * math.pi / len(fans)
        else:
            angle = math.pi / 2 * min(fan.sectors, 2)
        fan.step = angle / fan.sectors
        fan.regular = fan.sectors == 1 or abs(fan.step - math.pi / 2) < 1e-9
    return fans


def in_turn(fans: list[Fan]) -> list[Fan]:
    """The fans of a closed star, rotated so that the last one can join any two arms if possible."""
    sizes = [fan.sectors for fan in fans]
    if 1 in sizes:
        first = sizes.index(1) + 1
    else:
        first = 1 if len(fans) == 2 and sizes[0] != 2 else 0
    return fans[first:] + fans[:first]


def kind_of(w: Wireframe, c: Connectivity, star: Star) -> int:
    if STRAIGHT in star.sectors:
        if star.sectors.count(STRAIGHT) > 1 or not star.closed or len(star.arms) != 3:
            raise ValueError("a node on the side of a patch is no T of three arcs")
        return HANGING
    if any(w.arcs[h >> 1].collapsed for h in star.arms):
        return IRREGULAR
    if fans_of(w, c, star):
        return CREASED
    regular = len(star.sectors) == 4 if star.closed else len(star.sectors) <= 2
    return CROSSING if regular else IRREGULAR


def straight_on(w: Wireframe, c: Connectivity, h: int) -> int:
    """The half-arc that continues `h` beyond the T-node where it arrives, or -1."""
    node = w.end(h)
    if c.kinds[node] != HANGING:
        return -1
    arms = c.stars[node].arms
    on = c.opposite(node, arms.index(h ^ 1))
    return -1 if on < 0 else arms[on]


def rail_from(w: Wireframe, c: Connectivity, h: int) -> Rail:
    last, edges = h, w.arcs[h >> 1].edges
    while (on := straight_on(w, c, last)) >= 0:
        if on == h:
            raise ValueError("an arc lies on a ring of T-nodes")
        last, edges = on, edges + w.arcs[on >> 1].edges
    return Rail(last, edges)


def connect(w: Wireframe) -> Connectivity:
    c = linked(w)
    leaving = [[] for _ in w.nodes]
    for h in w.loops:
        leaving[w.start(h)].append(h)
    c.stars = [star_at(c, halves) for halves in leaving]
    c.kinds = [kind_of(w, c, star) for star in c.stars]
    c.fans = [fans_of(w, c, star) if kind == CREASED else []
              for star, kind in zip(c.stars, c.kinds)]
    c.corner_sector, c.corner_node = [-1] * 4 * len(w.patches), [-1] * 4 * len(w.patches)
    for n, star in enumerate(c.stars):
        for place, sector in enumerate(star.sectors):
            if sector != STRAIGHT:
                c.corner_sector[sector], c.corner_node[sector] = place, n
    c.rails = [rail_from(w, c, h) for h in range(2 * len(w.arcs))]
    return c
