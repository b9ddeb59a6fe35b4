"""Sums at crossings and T-nodes: docs/wireframe.md, "Predicted components" and "T-nodes"."""

from basis import power, sweep_basis
from jets import ALL, Model, Sum, x_arm


def scaled(terms: Sum, factor: float) -> Sum:
    return [(vector, f * factor) for vector, f in terms]


def across_at_end(m: Model, last: int, order: int) -> Sum:
    """A derivative to the left of a rail, at the node where the rail arrives."""
    terms = []
    if m.c.patch_of[last] >= 0:
        terms.append(m.rail_jet(last, order, 0))
    if m.c.patch_of[last ^ 1] >= 0:
        vector, sign = m.corner_jet(m.c.corner_at[last ^ 1], 0, order)
        terms.append((vector, sign * (-1) ** order))
    return scaled(terms, 1 / len(terms))


def neighbours(m: Model, n: int, on_y: bool, across: int) -> dict[int, tuple[float, Sum]]:
    """Neighbours ahead (0) and behind (1) on a line: distance and derivative across the line."""
    arms, result = m.c.stars[n].arms, {}
    for e in (0, 1):
        if on_y + 2 * e < len(arms):
            rail = m.c.rails[arms[on_y + 2 * e]]
            sign = (-1) ** across if on_y == (e == 0) else 1
            result[e] = float(rail.edges), scaled(across_at_end(m, rail.last, across), sign)
    return result


def predict(m: Model, n: int, i: int, j: int):
    """Writes the component (i, j) of a crossing."""
    on_x = ([m.is_stored[m.component(n, x, j)] for x in range(3)] + [False]).index(False)
    on_y = ([m.is_stored[m.component(n, i, y)] for y in range(3)] + [False]).index(False)
    turn = on_y > on_x
    order, across = (j, i) if turn else (i, j)
    own = [m.component(n, across, k) if turn else m.component(n, k, across) for k in (0, 1)]
    beside = neighbours(m, n, turn, across)
    rule = from_slope if max(on_x, on_y) == 2 else from_values
    m.write(m.component(n, i, j), *rule(beside, own, order))


def from_slope(beside: dict[int, tuple[float, Sum]], own: list[int], _) -> Sum:
    terms = []
    for e, (h, value) in beside.items():
        other = beside[1 - e][0] if len(beside) == 2 else 0.0
        weight = other / (h + other) if other else 1.0
        s = 2 * weight / (h * h)
        terms += scaled(value, s) + [(own[0], -s), (own[1], (h if e else -h) * s)]
    return terms


def from_values(beside: dict[int, tuple[float, Sum]], own: list[int], order: int) -> Sum:
    if len(beside) == 2:
        (a, ahead), (b, behind) = beside[0], beside[1]
        s = order / (a * b * (a + b))
        factors = (b * b, -a * a, a * a - b * b) if order == 1 else (b, a, -(a + b))
        return (scaled(ahead, factors[0] * s) + scaled(behind, factors[1] * s)
                + [(own[0], factors[2] * s)])
    if len(beside) == 1 and order == 1:
        (e, (h, value)), = beside.items()
        s = (-1 if e else 1) / h
        return scaled(value, s) + [(own[0], -s)]
    return []


def hang(m: Model, n: int):
    arms, host = m.c.stars[n].arms, x_arm(m.c, n)
    ahead, behind = m.c.rails[arms[host]], m.c.rails[arms[(host + 2) % 3]]
    length = ahead.edges + behind.edges
    shape = m.w.ribbons[m.w.arcs[arms[host] >> 1].ribbon]
    g = sweep_basis(shape.eta / shape.rho * power(length, 2),
                    shape.lam / shape.rho * power(length, 4), behind.edges / length)
    for i, j in ALL:
        terms = []
        for a in range(3):
            scale = power(length, a - i)
            start, sign = m.corner_jet(m.c.corner_at[behind.last ^ 1], a, j)
            terms.append((start, sign * (g[i][a] * scale)))
            end, sign = m.rail_jet(ahead.last, j, a)
            terms.append((end, sign * (-1) ** a * (g[i][3 + a] * scale)))
        m.write(m.component(n, i, j), *terms)
