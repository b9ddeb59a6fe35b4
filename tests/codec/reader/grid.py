"""The chunk GRID except for its loops: docs/file-format.md, "GRID"."""

import math
import struct

from connectivity import CROSSING, HANGING, Connectivity, connect
from container import check
from loops import Loops
from mirror import mirror_images
from symbols import Symbols
from wireframe import Arc, Node, Shape, Wireframe


class Sets:
    """Disjoint sets, in a slow but short implementation."""

    def __init__(self, size: int):
        self.of = [{k} for k in range(size)]

    def join(self, a: int, b: int):
        if self.of[a] is not self.of[b]:
            self.of[a] |= self.of[b]
            for k in self.of[b]:
                self.of[k] = self.of[a]

    def numbered(self, members) -> dict[int, int]:
        """The number of each member's set, with sets numbered by their first members."""
        numbers = {}
        return {k: numbers.setdefault(id(self.of[k]), len(numbers)) for k in members}


def turn_loops(s: Symbols, w: Wireframe) -> Sets:
    """Turns the loops. Returns the sets of arcs."""
    sets = Sets(len(w.arcs))
    for p in range(len(w.patches)):
        for side in range(4):
            arcs = [h >> 1 for h in w.side(p, side)]
            for a, b in zip(arcs, arcs[1:]):
                sets.join(a, b)
    for p in range(len(w.patches)):
        sides = [w.side(p, side) for side in range(4)]
        firsts = [side[0] >> 1 for side in sides]
        odd = s.bit(21, cost(sets, firsts[1], firsts[3]) < cost(sets, firsts[0], firsts[2]))
        turn = odd + 2 * s.bit(22, odd)
        sides = sides[turn:] + sides[:turn]
        at = w.patches[p][0]
        for side, halves in enumerate(sides):
            w.loops[at:at + len(halves)] = halves
            at += len(halves)
            w.patches[p][side + 1] = at
        sets.join(firsts[turn], firsts[(turn + 2) % 4])
    return sets


def cost(sets: Sets, a: int, b: int) -> int:
    return 0 if sets.of[a] is sets.of[b] else len(sets.of[a]) + len(sets.of[b])


def read_points(s: Symbols, w: Wireframe):
    hanging = {w.start(h) for p in range(len(w.patches)) for side in range(4)
               for h in w.side(p, side)[1:]}
    sets = Sets(len(w.nodes))
    for arc in w.arcs:
        if arc.collapsed:
            sets.join(arc.start, arc.end)
    points = sets.numbered(n for n in range(len(w.nodes)) if n not in hanging)
    same = s.bit(23)
    for n, node in enumerate(w.nodes):
        node.point = points.get(n, -1) + (0 if same else s.signed(24))
        check(-1 <= node.point < len(w.nodes), "a node stands at a point that does not exist")
    for arc in w.arcs:
        start, end = w.nodes[arc.start].point, w.nodes[arc.end].point
        check(not arc.collapsed or start == end >= 0, "a collapsed arc joins two points")
    more = s.number(0, 1)
    check(more <= len(w.nodes), "there are more points than nodes")
    w.points = max((node.point for node in w.nodes), default=-1) + 1 + more


def read_ribbons(s: Symbols, w: Wireframe, sets: Sets):
    ribbons = sets.numbered(range(len(w.arcs)))
    same = s.bit(23, 1)
    for a, arc in enumerate(w.arcs):
        arc.ribbon = ribbons[a] + (0 if same else s.signed(26))
        check(0 <= arc.ribbon < len(w.arcs), "an arc belongs to a ribbon that does not exist")
    more = s.number(0, 2)
    check(more <= len(w.arcs), "there are more ribbons than arcs")
    count = max((arc.ribbon for arc in w.arcs), default=-1) + 1 + more
    w.ribbons = [Shape() for _ in range(count)]


def read_creases(s: Symbols, w: Wireframe):
    if not s.bit(37):
        return
    before = False
    for arc in w.arcs:
        arc.crease = before = bool(s.bit(38, before))
        check(not (arc.crease and arc.collapsed), "a collapsed arc is no crease")


def line_class(w: Wireframe, c: Connectivity, n: int, axis: int) -> int:
    if c.kinds[n] != CROSSING:
        return 15
    reach = []
    for arm in c.stars[n].arms[axis::2]:
        last, edges = c.rails[arm]
        reach.append(2 * edges - 1 if c.kinds[w.end(last)] == HANGING else edges)
    if len(reach) == 1:
        return 6 if reach[0] + 1 < 6 else 7
    v = min(reach) + min(max(reach), 3 * min(reach))
    return 1 if v < 4 else 2 if v < 6 else 3


def image_stores(w: Wireframe, c: Connectivity, image: int, x: int) -> list[int]:
    """For each component in a node's frame: whether the node's image stores it. x is the image of
    the node's first arm."""
    arms = c.stars[image].arms
    q = arms.index(x) if x in arms else len(arms)
    places = [k if q % 2 == 0 else 3 * (k % 3) + k // 3 for k in range(9)]
    return [w.nodes[image].stored >> k & 1 for k in places]


def read_masks(s: Symbols, w: Wireframe, c: Connectivity, half_images: list[int],
               node_images: list[int]):
    for n, node in enumerate(w.nodes):
        image, there = node_images[n], []
        if 0 <= image < n and w.nodes[image].stored:
            there = image_stores(w, c, image, half_images[c.stars[n].arms[0]])
        x, y = line_class(w, c, n, 0), line_class(w, c, n, 1)
        node.stored = 0
        for k in range(9):
            before = ([k - 3] if k >= 3 else []) + ([k - 1] if k % 3 else [])
            if all(node.stored >> b & 1 for b in before):
                m = 1 + there[k] if there else 0
                node.stored |= s.bit(28, ((16 * m + x) * 16 + y) * 16 + k, node.stored) << k


def read_shapes(s: Symbols, w: Wireframe):
    for shape in w.ribbons:
        if not s.bit(29):
            continue
        if s.bit(30):
            e, l, r = s.number(31), s.number(31, 1), 1 + s.number(33)
            check(r < 2**32, "a shape parameter is out of range")
            square = float(r) * r
            shape.rho = 1.0
            shape.eta = -e / square if e else 0.0
            shape.lam = l / (square * square)
        else:
            shape.rho, shape.eta, shape.lam = (
                struct.unpack("<d", s.raw(35).to_bytes(8, "little"))[0] for _ in range(3))
            check(all(map(math.isfinite, (shape.rho, shape.eta, shape.lam))),
                  "a shape parameter is not finite")


def read_grid(s: Symbols):
    """The wireframe, its connectivity, the mirror's axis and pairs, and the images of half-arcs and
    nodes."""
    nodes, arcs, patches = s.number(0), s.number(0), s.number(0)
    axis = s.index(40, 3)
    pairs = [(s.index(43, 2 * arcs), s.index(43, 2 * arcs)) for _ in range(s.number(41))]
    check(len(pairs) <= 64, "the mirror begins in too many places")
    w = Wireframe(nodes=[Node() for _ in range(nodes)], arcs=[Arc() for _ in range(arcs)])
    loops = Loops(s, w, pairs)
    for _ in range(patches):
        loops.patch()
    check(all(loops.arc_known) and all(loops.node_known), "a node or an arc bounds no patch")
    sets = turn_loops(s, w)
    read_points(s, w)
    read_ribbons(s, w, sets)
    read_creases(s, w)
    c = connect(w)
    half_images, node_images = mirror_images(w, c, pairs)
    read_masks(s, w, c, half_images, node_images)
    read_shapes(s, w)
    return w, c, axis, pairs, half_images, node_images
