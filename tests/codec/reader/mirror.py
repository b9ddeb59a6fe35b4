"""The mirror symmetry of a wireframe: docs/file-format.md, "The mirror"."""

from connectivity import Connectivity
from wireframe import Wireframe


class Spreader:
    """Pairs half-arcs. `next`, `prev` and `corner_at` are those of Connectivity; they may grow."""

    def __init__(self, w: Wireframe, next: list[int], prev: list[int], corner_at: list[int]):
        self.w, self.next, self.prev, self.corner_at = w, next, prev, corner_at
        self.partner = [-1] * len(next)  # [half-arcs]
        self.node_image = [-1] * len(w.nodes)

    def spread(self, h: int, g: int):
        pairs = []
        self.pair(h, g, pairs)
        for h, g in pairs:  # the list grows
            self.pair(self.next[h], self.prev[g], pairs)
            self.pair(self.prev[h], self.next[g], pairs)
            self.pair(h ^ 1, g ^ 1, pairs)
        for pair in pairs:
            for h, g in (pair, pair[::-1]):
                self.node_image[self.w.start(h)] = self.w.end(g)
                self.node_image[self.w.end(h)] = self.w.start(g)

    def pair(self, h: int, g: int, pairs: list[tuple[int, int]]):
        if self.next[h] < 0 or self.next[g] < 0 or self.partner[h] >= 0 or self.partner[g] >= 0:
            return
        a, b = self.w.arcs[h >> 1], self.w.arcs[g >> 1]
        if (a.edges, a.collapsed) != (b.edges, b.collapsed):
            return
        if (self.corner_at[h] >= 0) != (self.corner_at[self.next[g]] >= 0):
            return
        self.partner[h], self.partner[g] = g, h
        pairs.append((h, g))


def mirror_images(w: Wireframe, c: Connectivity, seeds: list[tuple[int, int]]):
    """The image of each half-arc and of each node, or -1. `seeds`: the pairs in the file."""
    spreader = Spreader(w, c.next, c.prev, c.corner_at)
    for h, g in seeds:
        spreader.spread(h, g)
    half_arc, node = [-1] * len(c.next), [-1] * len(w.nodes)
    for h, g in enumerate(spreader.partner):
        if g >= 0:
            half_arc[h], half_arc[h ^ 1] = g ^ 1, g
            node[w.start(h)], node[w.end(h)] = w.end(g), w.start(g)
    return half_arc, node
