"""The vectors of a model, and which of them each jet is: docs/wireframe.md, "Vectors"."""

from collections import defaultdict
from dataclasses import dataclass, field
from typing import NamedTuple

from connectivity import CROSSING, HANGING, STRAIGHT, Connectivity
from wireframe import Wireframe

ALL = [(i, j) for i in range(3) for j in range(3)]  # components of a jet
SECOND_ORDER = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
MIXED = [(1, 1), (1, 2), (2, 1), (2, 2)]

Sum = list[tuple[int, float]]  # vectors and their factors


class Owner(NamedTuple):
    node: int
    i: int = 0
    j: int = 0
    fan: int = 0


@dataclass
class Model:
    w: Wireframe
    c: Connectivity
    owners: list[Owner] = field(default_factory=list)  # [vectors]
    stored: list[int] = field(default_factory=list)  # the vectors in a pose, in this order
    is_stored: list[bool] = field(default_factory=list)
    sums: dict[int, Sum] = field(default_factory=dict)  # define the derived vectors
    order: list[int] = field(default_factory=list)  # the derived vectors, each after all it needs
    first: list[int] = field(default_factory=list)  # [nodes] its first vector, or its point's
    arms: list[int] = field(default_factory=list)  # [nodes] the first vector of its arms
    mixed: dict[int, int] = field(default_factory=dict)  # the first mixed vector of corners

    def add(self, owner: Owner, stored: bool = False) -> int:
        vector = len(self.owners)
        self.owners.append(owner)
        self.is_stored.append(stored)
        if stored:
            self.stored.append(vector)
        return vector

    def write(self, vector: int, *terms: tuple[int, float]):
        """Defines a vector as a sum of others."""
        factors = defaultdict(float)
        for other, factor in terms:
            factors[other] += factor
        self.sums[vector] = sorted((v, f) for v, f in factors.items() if f != 0)

    def component(self, n: int, i: int, j: int) -> int:
        """A vector of a crossing or a T-node."""
        return self.first[n] + 3 * i + j

    def fan_vector(self, n: int, fan: int, i: int, j: int) -> int:
        return self.first[n] + 8 * fan + 3 * i + j

    def arm_vector(self, n: int, arm: int, i: int) -> int:
        return self.arms[n] + 2 * (arm % len(self.c.stars[n].arms)) + i - 1

    def mixed_vector(self, corner: int, i: int, j: int) -> int:
        return self.mixed[corner] + 2 * i + j - 3

    def corner_jet(self, corner: int, i: int, j: int) -> tuple[int, int]:
        """The vector that is d^i alpha d^j beta at a corner, and its sign."""
        n, k = self.c.corner_node[corner], self.c.corner_sector[corner]
        if self.c.kinds[n] in (CROSSING, HANGING):
            q = (k - x_arm(self.c, n)) % 3 if self.c.kinds[n] == HANGING else k
            x, y, sign = turned(q, i, j)
            return self.component(n, x, y), sign
        if i == 0 == j:
            return self.first[n], 1
        if j == 0:
            return self.arm_vector(n, k, i), 1
        return (self.arm_vector(n, k + 1, j) if i == 0 else self.mixed_vector(corner, i, j)), 1

    def rail_jet(self, h: int, i: int, j: int) -> tuple[int, int]:
        """The jet at the node where h arrives: derivative i to the left of h, j back along it."""
        return self.corner_jet(self.c.corner_at[self.c.next[h]], i, j)


def turned(q: int, i: int, j: int) -> tuple[int, int, int]:
    """The component (x, y) that is (i, j) in axes turned by q right angles, and its sign."""
    flips = (j if q in (1, 2) else 0) + (i if q >= 2 else 0)
    return (j, i, (-1) ** flips) if q % 2 else (i, j, (-1) ** flips)


def x_arm(c: Connectivity, n: int) -> int:
    return (c.stars[n].sectors.index(STRAIGHT) + 1) % 3 if c.kinds[n] == HANGING else 0
