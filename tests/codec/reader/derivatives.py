"""Predictions of stored derivatives: docs/file-format-vectors.md, "Prediction"."""

from typing import NamedTuple

from connectivity import CREASED, CROSSING
from lines import host_arms, opposite_of
from rounding import nearest


class Neighbour(NamedTuple):
    distance: float
    node: int
    back: int
    value: list  # terms


class Derivatives:
    """`predict` returns the terms that predict a stored derivative of a site."""

    def __init__(self, model, sites):
        self.model, self.w, self.c = model, model.w, model.c
        self.site_of = {n: site for site in sites for n in site.nodes}

    def predict(self, site, v: int) -> list:
        node, i, j, _ = self.model.owners[self.model.stored[v]]
        if self.c.kinds[node] == CREASED:
            return []
        if self.c.kinds[node] != CROSSING:
            return self.at_hub(site, i, j) if i + j == 1 else []
        axis = 0 if i > 0 else 1
        if i + j == 1:
            return self.first(node, axis)
        if (i, j) == (1, 1):
            return self.mixed(node)
        return self.second(node, axis) if i + j == 2 else []

    def own(self, node: int, i: int, j: int) -> int | None:
        """The stored vector of derivative (i, j) at the node's site, or None."""
        return find_derivative(self.model, self.site_of[node].vectors, i, j)

    def position(self, node: int) -> int:
        return self.site_of[node].vectors[0]

    # Neighbours

    def neighbour(self, node: int, arm: int) -> Neighbour | None:
        arms = self.c.stars[node].arms
        if arm >= len(arms):
            return None
        rail = self.c.rails[arms[arm]]
        end = self.w.end(rail.last)
        value = self.value(end)
        return value and Neighbour(float(rail.edges), end, rail.last ^ 1, value)

    def value(self, node: int) -> list | None:
        if node in self.site_of:
            return [(self.position(node), 1.0)]
        b, a = (self.c.rails[h] for h in host_arms(self.c, node))
        p, q = self.w.end(a.last), self.w.end(b.last)
        if p not in self.site_of or q not in self.site_of:
            return None
        edges = a.edges + b.edges
        t = b.edges / edges
        s = 1 - t
        at_p, at_q = self.slope(a.last ^ 1), self.slope(b.last ^ 1)
        if not at_p or not at_q:
            return [(self.position(q), s), (self.position(p), t)]
        return [(self.position(q), s * s * (1 + 2 * t)), (self.position(p), t * t * (1 + 2 * s)),
                *scaled(at_q, t * s * s * edges), *scaled(at_p, s * t * t * edges)]

    def slope(self, h: int) -> list | None:
        """The derivative along a half-arc at its start."""
        node = self.w.start(h)
        back = opposite_of(self.w, self.c, h) if self.c.kinds[node] == CROSSING else None
        if back is None:
            return None
        ahead, behind = self.c.rails[h], self.c.rails[back]
        ends = self.w.end(ahead.last), self.w.end(behind.last)
        if not all(end in self.site_of for end in ends):
            return None
        values = [[(self.position(end), 1.0)] for end in ends]
        return parabola_slope(float(ahead.edges), float(behind.edges), *values, self.position(node))

    # Crossings

    def first(self, node: int, axis: int) -> list:
        return self.change(*(self.neighbour(node, arm) for arm in (axis, axis + 2)),
                           self.position(node))

    @staticmethod
    def change(ahead, behind, own: int) -> list:
        """The first derivative of a value that is known at the neighbours and here."""
        if ahead and behind:
            return parabola_slope(ahead.distance, behind.distance, ahead.value, behind.value, own)
        for n, sign in (ahead, 1), (behind, -1):
            if n:
                return [*scaled(n.value, sign / n.distance), (own, -(sign / n.distance))]
        return []

    def second(self, node: int, axis: int) -> list:
        ahead, behind = (self.neighbour(node, arm) for arm in (axis, axis + 2))
        own, slope = self.position(node), self.own(node, 1 - axis, axis)
        terms = []
        for n, other, sign in (ahead, behind, 1), (behind, ahead, -1):
            if n:
                h = n.distance
                k = 2 * (other.distance / (h + other.distance) if other else 1) / (h * h)
                terms += [*scaled(n.value, k), (own, -k), (slope, -sign * h * k)]
        return terms

    def mixed(self, node: int) -> list:
        changes = [change for axis in (0, 1) if (change := self.change_across(node, axis))]
        return [t for change in changes for t in scaled(change, 1 / len(changes))]

    def change_across(self, node: int, axis: int) -> list:
        """How the slope along an axis changes along the other one."""
        telling = []
        for e in range(2):
            n = self.neighbour(node, 1 - axis + 2 * e)
            slope = n and self.slope_across(n, to_right=axis == e)
            telling.append(n._replace(value=slope) if slope else None)
        return self.change(*telling, self.own(node, 1 - axis, axis))

    def slope_across(self, n: Neighbour, to_right: bool) -> list | None:
        star = self.c.stars[n.node]
        if self.c.kinds[n.node] != CROSSING or not star.closed:
            return None
        arm = (star.arms.index(n.back) + (1 if to_right else 3)) % 4
        stored = self.own(n.node, 1 - arm % 2, arm % 2)
        if stored is not None:
            return [(stored, 1.0 if arm < 2 else -1.0)]
        return self.slope(star.arms[arm])

    # Irregular points

    def at_hub(self, site, i: int, j: int) -> list:
        xx = xy = yy = 0.0
        along_x, along_y = [], []
        own = site.vectors[0]
        for node in site.nodes:
            for arm, h in enumerate(self.c.stars[node].arms):
                n = self.neighbour(node, arm)
                if self.w.arcs[h >> 1].collapsed or not n:
                    continue
                a, b = self.spoke(site, node, arm)
                xx, xy, yy = xx + a * a, xy + a * b, yy + b * b
                r = 1 / n.distance
                along_x += [*scaled(n.value, a * r), (own, -a * r)]
                along_y += [*scaled(n.value, b * r), (own, -b * r)]
        d = xx * yy - xy * xy
        if not d > 1e-3:
            return []
        x, y = (yy, -xy) if i == 1 else (-xy, xx)
        return scaled(along_x, x / d) + scaled(along_y, y / d)

    def spoke(self, site, node: int, arm: int) -> list[float]:
        """The factors of A and B in the derivative along an arm."""
        factors = dict(self.model.sums.get(self.model.arm_vector(node, arm, 1), []))
        return [nearest(factors.get(self.model.stored[site.vectors[k]], 0.0) * 2**20) / 2**20
                for k in (1, 2)]


def find_derivative(model, vectors: list[int], i: int, j: int) -> int | None:
    return next((v for v in vectors if model.owners[model.stored[v]][1:3] == (i, j)), None)


def parabola_slope(a: float, b: float, ahead: list, behind: list, own: int) -> list:
    k = 1 / (a * b * (a + b))
    return [*scaled(ahead, b * b * k), *scaled(behind, -a * a * k), (own, (a * a - b * b) * k)]


def scaled(terms: list, factor: float) -> list:
    return [(v, factor * f) for v, f in terms]
