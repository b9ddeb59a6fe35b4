"""A wireframe (docs/wireframe.md) as plain lists of numbers, shared by all parts of the reader.

A half-arc is 2 * arc, plus 1 if it runs from the arc's end to its start; its twin is `h ^ 1`."""

from dataclasses import dataclass, field


@dataclass
class Node:
    point: int = -1  # place in the numbering of points; -1 for a T-node
    stored: int = 1  # the stored jet components: bit 3 i + j is the derivative by x^i y^j


@dataclass
class Arc:
    start: int = -1  # nodes
    end: int = -1
    edges: int = 1  # its length in source edges
    ribbon: int = 0
    collapsed: bool = False
    crease: bool = False


@dataclass
class Shape:
    rho: float = 1.0
    eta: float = 0.0
    lam: float = 0.0


@dataclass
class Wireframe:
    points: int = 0
    nodes: list[Node] = field(default_factory=list)
    arcs: list[Arc] = field(default_factory=list)
    # Five places in `loops` each: side s is the range from place s to place s + 1.
    patches: list[list[int]] = field(default_factory=list)
    loops: list[int] = field(default_factory=list)  # half-arcs
    ribbons: list[Shape] = field(default_factory=list)

    def side(self, patch: int, s: int) -> list[int]:
        places = self.patches[patch]
        return self.loops[places[s]:places[s + 1]]

    def side_edges(self, patch: int, s: int) -> int:
        return sum(self.arcs[h >> 1].edges for h in self.side(patch, s))

    def start(self, h: int) -> int:
        arc = self.arcs[h >> 1]
        return arc.end if h & 1 else arc.start

    def end(self, h: int) -> int:
        return self.start(h ^ 1)
