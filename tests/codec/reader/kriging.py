"""Predictions of the moves of targets: docs/file-format-vectors.md, "Moves"."""

import heapq
import math
from typing import NamedTuple

from hierarchy import Hierarchy, Site, Step, site_of_nodes
from lines import Lines
from rounding import nearest, total

Vector = tuple[float, float, float]


class Stand(NamedTuple):
    """A place on the neutral and its normal."""
    position: Vector
    normal: Vector


def move_steps(model, hierarchy: Hierarchy, neutral: list[Vector], step: float) -> list[Step]:
    """`step`: that of the neutral pose."""
    if step == 0:
        return hierarchy.steps
    stands = stands_of(model, hierarchy.sites, neutral)
    near = near_sites(model, hierarchy.sites)
    return [with_weights(hierarchy.sites, s, stands, near, 20 * step) for s in hierarchy.steps]


def with_weights(sites: list[Site], step: Step, stands: list[Stand], near: list[list[int]],
                 turned: float) -> Step:
    if step.vector != sites[step.site].vectors[0] or not near[step.site]:
        return step
    weights = weigh(stands[step.site], [stands[n] for n in near[step.site]], turned)
    if not weights:
        return step
    return step._replace(
        terms=[(sites[n].vectors[0], w) for n, w in zip(near[step.site], weights)])


# Near sites

def near_sites(model, sites: list[Site]) -> list[list[int]]:
    lines = Lines(model.w, model.c, site_of_nodes(model, sites))
    near = [[] for _ in sites]
    s = len(sites) - 1
    while s >= 0 and sites[s].parent >= 0:
        together = [s - 1, s] if sites[s].image == s - 1 else [s]
        for k in together:
            near[k] = search(model, lines, sites, k)
        lines.out.update(together)
        s -= len(together)
    return near


def search(model, lines: Lines, sites: list[Site], own: int) -> list[int]:
    waiting, reached, found, last = [(0, sites[own].nodes[0])], set(), [], 0
    while waiting and len(reached) < 128:
        distance, node = heapq.heappop(waiting)
        place = place_of(lines, node)
        if place in reached:
            continue
        reached.add(place)
        site = lines.site_of[node]
        if site >= 0 and site not in (own, sites[own].image):
            if len(found) >= 12 and distance > last:
                break
            found.append(site)
            last = distance
            if len(found) == 16:
                break
        for n in sites[site].nodes[:128] if site >= 0 else [node]:
            go_on(model, lines, n, distance, reached, waiting)
    return found


def place_of(lines: Lines, node: int) -> tuple[str, int]:
    site = lines.site_of[node]
    return ("T-node", node) if site < 0 else ("site", site)


def go_on(model, lines: Lines, node: int, distance: int, reached: set, waiting: list):
    for arm in model.c.stars[node].arms:
        if len(waiting) >= 1024:
            return
        end = None if model.w.arcs[arm >> 1].collapsed else lines.next(arm)
        if end and place_of(lines, end.node) not in reached:
            heapq.heappush(waiting, (distance + end.distance, end.node))


# Weights

def stands_of(model, sites: list[Site], neutral: list[Vector]) -> list[Stand]:
    vectors = all_vectors(model, neutral)
    facing = {}  # by position vectors
    for corner in range(4 * len(model.w.patches)):
        alpha, beta = (signed(vectors, model.corner_jet(corner, i, j)) for i, j in [(1, 0), (0, 1)])
        position, _ = model.corner_jet(corner, 0, 0)
        facing[position] = plus(facing.get(position, (0.0, 0.0, 0.0)), cross(alpha, beta))
    return [Stand(neutral[site.vectors[0]], unit(facing[model.stored[site.vectors[0]]]))
            for site in sites]


def all_vectors(model, stored: list[Vector]) -> dict[int, Vector]:
    vectors = dict(zip(model.stored, stored))
    for derived in model.order:
        terms = model.sums.get(derived, [])
        vectors[derived] = tuple(total(f * vectors[v][a] for v, f in terms) for a in range(3))
    return vectors


def signed(vectors: dict[int, Vector], jet: tuple[int, int]) -> Vector:
    vector, sign = jet
    return tuple(sign * x for x in vectors[vector])


def plus(a: Vector, b: Vector) -> Vector:
    return tuple(x + y for x, y in zip(a, b))


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def square(a: Vector) -> float:
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]


def unit(a: Vector) -> Vector:
    length = math.sqrt(square(a))
    return tuple(x * (1 / length) for x in a) if length > 0 else (0.0, 0.0, 0.0)


def apart(a: Stand, b: Stand, turned: float) -> float:
    way, turn = (tuple(x - y for x, y in zip(p, q)) for p, q in zip(a, b))
    r = math.sqrt(square(way) + turned * turned * square(turn))
    return r * math.sqrt(r)


def weigh(own: Stand, near: list[Stand], turned: float) -> list[float] | None:
    """The weights of the near sites, None if they cannot be determined."""
    n = len(near)
    v = [apart(own, stand, turned) for stand in near]
    mean = total(v) / n
    if not 0 < mean < math.inf:
        return None
    c = [[v[i] + v[j] - apart(near[i], near[j], turned) for j in range(i)] for i in range(n)]
    for j in range(n):
        c[j].append(2 * v[j] + 1e-6 * mean)
    w = solve_ones(c)
    if not w:
        return None
    whole = total(reversed(w))
    rounded = [nearest(x / whole * 65536) / 65536 for x in w]
    if not all(abs(x) <= 4 for x in rounded):
        return None
    return [1 - sum(rounded[1:]), *rounded[1:]]


def solve_ones(c: list[list[float]]) -> list[float] | None:
    """Solves C w = 1 by Cholesky factorisation, from the lower half of C."""
    n = len(c)
    w = [1.0] * n
    for j in range(n):
        if not c[j][j] > 0:
            return None
        c[j][j] = math.sqrt(c[j][j])
        for i in range(j + 1, n):
            c[i][j] /= c[j][j]
        for i in range(j + 1, n):
            for k in range(j + 1, i + 1):
                c[i][k] -= c[i][j] * c[k][j]
        w[j] /= c[j][j]
        for i in range(j + 1, n):
            w[i] -= c[i][j] * w[j]
    for i in reversed(range(n)):
        for k in range(i + 1, n):
            w[i] -= c[k][i] * w[k]
        w[i] /= c[i][i]
    return w
