"""The loops of the patches: docs/file-format.md, "Loops"."""

from container import check
from mirror import Spreader
from symbols import Symbols
from wireframe import Arc, Wireframe


class Loops:
    """Reads the loops of the patches, with all that is known so far."""

    def __init__(self, symbols: Symbols, w: Wireframe, pairs: list[tuple[int, int]]):
        self.s, self.w, self.pairs = symbols, w, pairs
        halves, nodes = 2 * len(w.arcs), len(w.nodes)
        self.next, self.prev, self.begins = ([-1] * halves for _ in range(3))  # of complete patches
        self.mirror = Spreader(w, self.next, self.prev, self.begins)
        self.used = [False] * halves
        self.queue = []
        self.arc_known, self.node_known = [False] * len(w.arcs), [False] * nodes
        self.arms = [[] for _ in w.nodes]
        self.within, self.corners = [0] * nodes, [0] * nodes
        # of the current loop
        self.side, self.length, self.guide, self.start = 0, [0] * 4, -1, -1

    # contexts

    def is_open(self, h: int) -> bool:
        return self.arc_known[h >> 1] and self.used[h ^ 1] and not self.used[h]

    def opened(self) -> list[int]:
        """The queue, without half-arcs that are no longer open."""
        self.queue = [h for h in self.queue if self.is_open(h)]
        return self.queue

    def d(self, n: int) -> int:
        return min(len(self.arms[n]), 6) + 8 * self.within[n]

    def w_of(self, n: int) -> int:
        return self.d(n) + 16 * min(self.corners[n], 7)

    def o(self, n: int) -> int:
        return min(3, sum(map(self.is_open, self.arms[n])))

    def across(self, h: int) -> int:
        """The twin of the partner of the twin, or -1."""
        partner = self.mirror.partner[h ^ 1]
        return -1 if partner < 0 else partner ^ 1

    def told_across(self, h: int) -> int:
        """The same if that half-arc bounds a complete patch, else -1."""
        g = self.across(h)
        return g if g >= 0 and self.next[g] >= 0 else -1

    def e(self, holds) -> int:
        """E of a condition about the guide."""
        return 0 if self.guide < 0 else 1 + bool(holds)

    # patches

    def patch(self):
        self.drop_borders()
        self.side, self.length, self.guide, self.start = 0, [0] * 4, -1, -1
        loop, sides, end = [], [len(self.w.loops)], -1
        while self.side < 4:
            if loop:
                self.guide = -1 if self.guide < 0 else self.prev[self.guide]
                h, start = self.following(end)
            else:
                h, start = self.first()
                self.start = start
            if self.arc_known[h >> 1]:
                end, ends = self.rest_of_known(h)
            else:
                end, ends = self.rest_of_new(h, start)
            check(not self.used[h], "an arc is used twice in the same direction")
            self.used[h] = True
            loop.append(h)
            if ends:
                self.side += 1
                sides.append(sides[0] + len(loop))
        check(end == self.start, "a patch is not closed")
        self.w.patches.append(sides)
        self.w.loops += loop
        self.complete(len(self.w.patches) - 1, loop)

    def drop_borders(self):
        while self.opened():
            h = self.queue[0]
            g = self.across(h)
            m = 0 if g < 0 else 1 if self.next[g] >= 0 else 2 if self.used[g] else 3
            if not self.s.bit(36, self.d(self.w.start(h)) + 16 * m, self.d(self.w.end(h))):
                break
            self.used[h] = True

    def complete(self, p: int, loop: list[int]):
        self.queue += [h ^ 1 for h in loop if not self.used[h ^ 1]]
        for h, g in zip(loop, loop[1:] + loop[:1]):
            self.next[h], self.prev[g] = g, h
        firsts = {self.w.side(p, s)[0] for s in range(4)}
        for h in loop:
            self.begins[h] = 0 if h in firsts else -1
            if h in firsts:
                self.corners[self.w.start(h)] += 1
            else:
                self.within[self.w.start(h)] = 1
        for h, g in self.pairs:
            self.mirror.spread(h, g)
        for h in loop:
            if (g := self.across(h)) >= 0:
                self.mirror.spread(h, g)

    # half-arcs, each with the node that it starts from

    def first(self) -> tuple[int, int]:
        waiting = self.opened()
        if not waiting or self.s.bit(2):
            start = self.node(3, 0)
            return self.new_half_arc(), start
        g = self.told_across(waiting[0])
        c = 0 if g < 0 else 1 + (self.begins[self.next[g]] >= 0)
        h = waiting[self.s.number(3, c, self.w_of(self.w.start(waiting[0])))]
        return h, self.w.start(h)

    def following(self, e: int) -> tuple[int, int]:
        c = next(filter(self.is_open, self.arms[e]), -1)
        if c >= 0:
            m = 0
            if self.guide >= 0:
                g = self.across(self.guide)
                m = 1 if g < 0 else 2 if g == c else 3
            if self.s.bit(5, self.o(e) + 4 * m, self.d(e)):
                return c, e
        if self.s.bit(6, c >= 0):
            h = self.s.index(7, 2 * len(self.w.arcs))
            check(self.arc_known[h >> 1] and self.w.start(h) == e,
                  "a patch is not a closed loop of arcs")
            return h, e
        return self.new_half_arc(), e

    def new_half_arc(self) -> int:
        lowest = self.arc_known.index(False)
        arc = lowest if self.s.bit(8) else self.s.index(9, len(self.w.arcs))
        check(not self.arc_known[arc], "an arc comes twice")
        return 2 * arc + self.s.bit(10)

    def rest_of_known(self, h: int) -> tuple[int, bool]:
        if (g := self.told_across(h)) >= 0:
            self.guide = g
        self.length[self.side] += self.w.arcs[h >> 1].edges
        end = self.w.end(h)
        context = 1 + 2 * self.d(end) + (self.side == 0)
        return end, self.side_ends(context, self.o(end))

    def side_ends(self, context: int, b: int) -> bool:
        if self.side < 2:
            return bool(self.s.bit(15, context + 32 * self.e(self.begins[self.guide] >= 0), b))
        missing = self.length[self.side - 2] - self.length[self.side]
        check(missing >= 0, "a patch has opposite sides of different length")
        return missing == 0

    def rest_of_new(self, h: int, start: int) -> tuple[int, bool]:
        arc = self.w.arcs[h >> 1]
        guide = self.w.arcs[self.guide >> 1] if self.guide >= 0 else None
        arc.edges = self.edges(guide)
        check(arc.edges <= 65535, "the length of an arc is out of range")
        arc.collapsed = bool(self.s.bit(14, self.e(guide and guide.collapsed)))
        self.length[self.side] += arc.edges
        ends = self.side_ends(0, self.side)
        a, b, c, d = self.length
        rest = (0, a + b if ends else 0, a - c + b, b - d)[self.side]
        end = self.start if ends and self.side == 3 else self.node(self.side, rest)
        arc.start, arc.end = (end, start) if h & 1 else (start, end)
        self.arc_known[h >> 1] = True
        self.arms[start].append(h)
        self.arms[end].append(h ^ 1)
        return end, ends

    def edges(self, guide: Arc | None) -> int:
        side = self.side
        if side >= 2:
            r = self.length[side - 2] - self.length[side]
            if self.s.bit(11, min(r, 9) + 16 * self.e(guide and guide.edges == r), side):
                return r
        if guide:
            c = 16 + min(guide.edges, 15)
        else:
            c = 1 + min(self.length[side - 1], 8) if side else 0
        return 1 + self.s.number(12, c, side)

    # nodes

    def met(self, rest: int) -> int:
        n, steps = self.start, 0
        while rest > 0 and steps < 64:
            steps += 1
            back = next((h for h in self.arms[n] if self.is_open(h ^ 1)), -1)
            if back < 0:
                return -1
            rest -= self.w.arcs[back >> 1].edges
            n = self.w.end(back)
        return n if rest == 0 else -1

    def node(self, side: int, rest: int) -> int:
        met = self.met(rest) if rest > 0 else -1
        expected = self.mirror.node_image[self.w.start(self.guide)] if self.guide >= 0 else -1
        m = self.guide >= 0 and (1 if expected < 0 else 2 if expected == met else 3)
        if met >= 0 and self.s.bit(16, side + 4 * m, self.w_of(met)):
            return met
        if self.s.bit(17, side + 4 * self.e(expected >= 0), met >= 0):
            if expected >= 0 and self.s.bit(39):
                return expected
            place = self.s.number(56)
            n = self.w.start(self.opened()[place - 1]) if place else self.s.index(
                18, len(self.w.nodes))
            check(self.node_known[n], "an arc ends at a node that does not exist")
            return n
        lowest = self.node_known.index(False)
        n = lowest if self.s.bit(19) else self.s.index(20, len(self.w.nodes))
        check(not self.node_known[n], "a node comes twice")
        self.node_known[n] = True
        return n
