"""Sums at irregular points: docs/wireframe.md, "Irregular points"."""

import math

from basis import exponential, logarithm, power, sine_cosine
from jets import ALL, MIXED, Model

PARABOLA = [[1, 0, 0], [-1.5, 2, -0.5], [1, -2, 1]]  # derivatives 0, 1, 2 at 0 by values at 0, 1, 2

Jet = dict[tuple[int, int], complex]  # derivatives of a map into the plane of a chart


def cis(angle: float) -> complex:
    sine, cosine = sine_cosine(angle)
    return complex(cosine, sine)


def compose(m: Model, vector: int, quadratic: list[int], jet: Jet, i: int, j: int):
    xx = xy = yy = 0.0
    for a in range(i + 1):
        for b in range(j + 1):
            p, q = jet.get((a, b), 0j), jet.get((i - a, j - b), 0j)
            k = math.comb(i, a) * math.comb(j, b)
            xx += k * p.real * q.real
            xy += k * p.real * q.imag
            yy += k * p.imag * q.imag
    d = jet.get((i, j), 0j)
    factors = [d.real, d.imag, xx / 2, xy, yy / 2]
    m.write(vector, *((v, f) for v, f in zip(quadratic, factors) if abs(f) > 1e-14))


def points_of_map(angle: float) -> list[list[complex]]:
    c, w = sine_cosine(angle)[1], cis(angle)
    lam = (c + 5 + math.sqrt((c + 9) * (c + 1))) / 16
    back, edge = w.conjugate(), lam - 1 / 16
    k = 1 / (16 * edge)
    h = (1 + w) / (4 * lam - 1)
    f0 = (3 / 8 * (1 + h) + w / 16) / edge
    g0 = (3 / 8 * (w + h) + 1 / 16) / edge
    e = ((9 / 16 + 3 / 32 * (h + back * h) + (w + back + f0 + back * g0) / 64)
         / (lam - 3 / 32 - 2 * k / 64))
    f, g = f0 + k * e, g0 + k * w * e
    q = (9 / 16 * h + 3 / 32 * (1 + w + f + g) + (e + w * e) / 64) / (lam - 1 / 64)
    return [[0j, w, w * e], [1 + 0j, h, g], [e, f, q]]


def characteristic(start: float, step: float, scale: float) -> Jet:
    if step == math.pi:
        return {}
    points, jet = points_of_map(step), {}
    for i, j in ALL:
        total = 0j
        for a, b in ALL:
            total += PARABOLA[i][a] * PARABOLA[j][b] * points[a][b]
        jet[i, j] = total * cis(start) * power(scale, 1 - i - j)
    return jet


def spoke(angle: float, step: float, scale: float) -> Jet:
    if step == math.pi:
        return {}
    reach = points_of_map(step)[2][0].real
    return {(1, 0): cis(angle) * (2 - reach / 2), (2, 0): cis(angle) * ((reach - 2) / scale)}


def pole(angle: float, step: float, along_alpha: bool) -> Jet:
    ray, turn = cis(angle), complex(0, step)
    values = [ray, turn * ray, turn * turn * ray]
    return {(k, 1) if along_alpha else (1, k): value for k, value in enumerate(values)}


def compose_arm(m: Model, n: int, arm: int, quadratic: list[int], jet: Jet):
    for i in (1, 2):
        compose(m, m.arm_vector(n, arm, i), quadratic, jet, i, 0)


def is_collapsed(m: Model, n: int, arm: int) -> bool:
    arms = m.c.stars[n].arms
    return m.w.arcs[arms[arm % len(arms)] >> 1].collapsed


def ring_of(m: Model, nodes: list[int]) -> list[int]:
    starts = [n for n in nodes if not m.c.stars[n].closed and not is_collapsed(m, n, 0)]
    ring = [starts[-1] if starts else nodes[0]]
    while len(ring) < len(nodes):
        n = ring[-1]
        if m.c.stars[n].closed or not is_collapsed(m, n, -1):
            break
        n = m.w.end(m.c.stars[n].arms[-1])
        if n == ring[0]:
            break
        ring.append(n)
    return ring


def scale_of(m: Model, arms: list[int]) -> float:
    total = 0.0
    for h in arms:
        total += logarithm(m.c.rails[h].edges)
    return max(1.0, 0.25 * exponential(total / max(1, len(arms))))


def last_edges(m: Model, n: int) -> int:
    """The edges of the last arm of an open star if that arm is collapsed, else 0."""
    star = m.c.stars[n]
    if star.closed or not is_collapsed(m, n, -1):
        return 0
    return m.w.arcs[star.arms[-1] >> 1].edges


def chart_point(m: Model, nodes: list[int]):
    ring = ring_of(m, nodes)
    arms = [h for n in ring for h in m.c.stars[n].arms if not m.w.arcs[h >> 1].collapsed]
    count = 0
    for n in ring:
        count += last_edges(m, n) + sum(not is_collapsed(m, n, k) and not is_collapsed(m, n, k + 1)
                                        for k in range(len(m.c.stars[n].sectors)))
    if count == 0:
        raise ValueError("an irregular point has no sectors")
    is_open = not m.c.stars[ring[0]].closed and not is_collapsed(m, ring[0], 0)
    step = (1 if is_open else 2) * math.pi / count
    angle, scale = 0.0, scale_of(m, arms)
    for n in ring:
        angle = chart_node(m, n, angle, step, scale)


def chart_node(m: Model, n: int, angle: float, step: float, scale: float) -> float:
    """Writes the sums of one node. Returns the angle after its last sector."""
    star, quadratic = m.c.stars[n], [m.first[n] + k for k in range(1, 6)]

    def write_arm(k, is_ray):
        is_ray = is_ray or k > 0 and is_collapsed(m, n, k - 1)
        jet = {(1, 0): cis(angle)} if is_ray else spoke(angle, step, scale)
        compose_arm(m, n, k, quadratic, jet)

    for k, corner in enumerate(star.sectors):
        before, behind = is_collapsed(m, n, k), is_collapsed(m, n, k + 1)
        if before:
            jet = pole(angle, -step, True)
        else:
            write_arm(k, behind)
            jet = pole(angle, step, False) if behind else characteristic(angle, step, scale)
        for i, j in MIXED:
            compose(m, m.mixed_vector(corner, i, j), quadratic, jet, i, j)
        if not before and not behind:
            angle += step
    last = len(star.arms) - 1
    if not star.closed and not is_collapsed(m, n, last):
        write_arm(last, False)
    return angle + step * last_edges(m, n)
