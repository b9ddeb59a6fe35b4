"""Sums at creased nodes: docs/wireframe.md, "Creased nodes"."""

from basis import sine_cosine
from charts import characteristic, compose, compose_arm, scale_of, spoke
from connectivity import Fan
from jets import MIXED, SECOND_ORDER, Model, turned


def fan_stores(fan: Fan, i: int, j: int) -> bool:
    if not fan.regular and i + j > 2:
        return False
    if fan.first_given and j == 0:
        return False
    tells_y = fan.sectors == 1 if fan.regular else abs(sine_cosine(opening(fan))[0]) > 1e-9
    return not (fan.last_given and tells_y and i == 0)


def opening(fan: Fan) -> float:
    return fan.step * fan.sectors


def fold(m: Model, n: int):
    """Writes all sums of a creased node."""
    scale = scale_of(m, m.c.stars[n].arms)
    for f, fan in enumerate(m.c.fans[n]):
        (fold_regular if fan.regular else fold_chart)(m, n, f, fan, scale)


def owned_arms(fan: Fan) -> range:
    """The arms that get their derivatives from the fan, counted from its first arm."""
    return range(fan.first_given, fan.sectors + (not fan.last_given))


def corner_of(m: Model, n: int, sector: int) -> int:
    sectors = m.c.stars[n].sectors
    return sectors[sector % len(sectors)]


def fold_regular(m: Model, n: int, f: int, fan: Fan, _):
    """Writes the sums of a fan with one jet, in axes that turn with the sectors."""
    def own(q, i, j):
        x, y, sign = turned(q, i, j)
        return m.fan_vector(n, f, x, y), sign

    for i in (1, 2):
        if fan.first_given:
            m.write(m.fan_vector(n, f, i, 0), (m.arm_vector(n, fan.first, i), 1))
        if fan.last_given and fan.sectors == 1:
            m.write(m.fan_vector(n, f, 0, i), (m.arm_vector(n, fan.first + 1, i), 1))
        for k in owned_arms(fan):
            m.write(m.arm_vector(n, fan.first + k, i), own(k, i, 0))
    for k in range(fan.sectors):
        for i, j in MIXED:
            m.write(m.mixed_vector(corner_of(m, n, fan.first + k), i, j), own(k, i, j))


def fold_chart(m: Model, n: int, f: int, fan: Fan, scale: float):
    """Writes the sums of a fan with a second-order jet in a chart."""
    quadratic = [m.fan_vector(n, f, i, j) for i, j in SECOND_ORDER[1:]]
    solve_given(m, n, fan, quadratic, scale)
    for k in owned_arms(fan):
        compose_arm(m, n, fan.first + k, quadratic, spoke(k * fan.step, fan.step, scale))
    for k in range(fan.sectors):
        jet = characteristic(k * fan.step, fan.step, scale)
        for i, j in MIXED:
            compose(m, m.mixed_vector(corner_of(m, n, fan.first + k), i, j), quadratic, jet, i, j)


def solve_given(m: Model, n: int, fan: Fan, quadratic: list[int], scale: float):
    """Writes those of A to E that other fans determine."""
    ca, cb, cc, cd, ce = quadratic
    jet = spoke(0.0, fan.step, scale)
    s, t = jet[1, 0].real, jet[2, 0].real
    if fan.first_given:
        m.write(ca, (m.arm_vector(n, fan.first, 1), 1 / s))
        m.write(cc, (m.arm_vector(n, fan.first, 2), 1 / (s * s)), (ca, -t / (s * s)))
    d, c = sine_cosine(opening(fan))
    if fan.last_given and abs(d) > 1e-9:
        last, e = fan.first + fan.sectors, 1 / (s * s * d * d)
        m.write(cb, (m.arm_vector(n, last, 1), 1 / (s * d)), (ca, -c / d))
        m.write(ce, (m.arm_vector(n, last, 2), e), (cc, -c * c / (d * d)), (cd, -2 * c / d),
                (ca, -t * c * e), (cb, -t * d * e))
