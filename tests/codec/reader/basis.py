"""The basis of a sweep: docs/mathematics.md, "Elementary functions" and "The basis to the bit"."""

import math
import struct

INVERSE_FACTORIAL = [1 / math.factorial(n) for n in range(20)]
LN2_HIGH, LN2_LOW = float.fromhex("0x1.62e42feep-1"), float.fromhex("0x1.a39ef35793c76p-33")
QUARTER = [float.fromhex(x)
           for x in ("0x1.921fb544p+0", "0x1.0b4611a6p-34", "0x1.3198a2e037073p-69")]
ROOT_HALF = 0x3FE6A09E667F3BCD
SMALL = 16
TERMS = 14


def power(base: float, exponent: int) -> float:
    product = 1.0
    for _ in range(abs(exponent)):
        product *= base
    return 1 / product if exponent < 0 else product


def alternating(r: float, first: int) -> float:
    total = 0.0
    for n in range(16 + first, first - 1, -2):
        total = INVERSE_FACTORIAL[n] - r * r * total
    return total


def sine_cosine(x: float) -> tuple[float, float]:
    if abs(x) >= 2.0 ** 52:
        return 0.0, 1.0
    turns = float(math.floor(x / (math.pi / 2) + 0.5))
    part = x - turns * QUARTER[0]
    r = part - turns * QUARTER[1]
    rest = ((part - r) - turns * QUARTER[1]) - turns * QUARTER[2]
    s, c = r * alternating(r, 1), alternating(r, 0)
    sine, cosine = s + rest * c, c - rest * s
    return [(sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine)][int(turns) & 3]


def power_of_e(x: float) -> tuple[int, float]:
    """k and q with e^x = 2^k (1 + q)."""
    k = math.floor(x / math.log(2) + 0.5)
    high, low = x - k * LN2_HIGH, k * LN2_LOW
    r, q = high - low, 0.0
    for n in range(14, 0, -1):
        q = q * r + INVERSE_FACTORIAL[n]
    return k, r * q + ((high - r) - low)


def exponential(x: float) -> float:
    if x < -745:
        return 0.0
    k, q = power_of_e(x)
    half = int(k / 2)
    return (1 + q) * 2.0 ** half * 2.0 ** (k - half)


def exponential_less_1(x: float) -> float:
    if x < -50:
        return exponential(x) - 1
    k, q = power_of_e(x)
    return 2.0 ** k * q + (2.0 ** k - 1)


def logarithm(x: float) -> float:
    bits = struct.unpack("<q", struct.pack("<d", x))[0]
    k = (bits - ROOT_HALF) >> 52
    m = struct.unpack("<d", struct.pack("<q", bits - (k << 52)))[0]
    f = m - 1
    s = f / (m + 1)
    total = 0.0
    for n in range(25, 1, -2):
        total = (total + 2 / n) * (s * s)
    return k * LN2_HIGH + (f - s * (f - total) + k * LN2_LOW)


def product_plus(a: float, b: float, c: float) -> float:
    """a b + c, accurate where c is nearly -a b."""
    def high(x: float) -> float:
        split = 134217729.0 * x
        return split - (split - x)

    product, a1, b1 = a * b, high(a), high(b)
    a2, b2 = a - a1, b - b1
    return (product + c) + (((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)


def wave(s: float, tail: float, u: float) -> tuple[float, float]:
    t = u - 0.5
    if s == 0:
        return 1.0, t
    r = math.sqrt(abs(s))
    if s < 0:
        phase = r * t
        rest = product_plus(r, t, -phase) + tail * t
        sine, cosine = sine_cosine(phase)
        return cosine - rest * sine, (sine + rest * cosine) / r
    end = min(u, 1 - u)
    decay, rest = 0.5 * exponential(-r * end), exponential_less_1(-r * (1 - 2 * end))
    return decay * (2 + rest), math.copysign(decay * rest / r, t)


def bend(s: float, u: float) -> tuple[float, float]:
    t, even, odd, term = u - 0.5, 0.0, 0.0, 1.0
    for k in range(2, 2 * TERMS + 1, 2):
        term *= t * t / ((k - 1) * k)
        even += term
        odd += term * t / (k + 1)
        term *= s
    return even, odd


def apart(s: float, tail: float, u: float) -> tuple[float, float]:
    return bend(s, u) if abs(s) <= SMALL else wave(s, tail, u)


def series(a: float, b: float, u: float) -> list[float]:
    """G2 to G5."""
    t = u - 0.5
    h, before, factor, g = 1.0, 0.0, t * t / 2, [0.0] * 4
    for k in range(TERMS):
        term = factor
        for m in range(4):
            g[m] += h * term
            term *= t / (2 * k + m + 3)
        factor *= t * t / ((2 * k + 3) * (2 * k + 4))
        h, before = -a * h - b * before, h
    return g


def two_sum(a: float, b: float) -> tuple[float, float]:
    s = a + b
    part = s - a
    return s, (a - (s - part)) + (b - part)


def root_tail(value: float, tail: float) -> float:
    if not value < 0:
        return 0.0
    r = math.sqrt(-value)
    return (product_plus(-r, r, -value) - tail) / (2 * r)


def close_square(a: float, b: float, sign: int) -> tuple[float, float]:
    root = math.sqrt(b)
    rest = product_plus(-root, root, b) / (2 * root) if root > 0 else 0.0
    large, small = two_sum(-a / 2, sign * root)
    value, tail = two_sum(large, small + sign * rest)
    return value / 2, tail / 2


def apart_roots(a: float, b: float, s1: float) -> list[tuple[float, float]]:
    other, other_tail = two_sum(s1, a)
    product = s1 * other
    residual = (product + b) + product_plus(s1, other, -product) + s1 * other_tail
    tail1 = -residual / (s1 + other)
    s2 = b / s1
    return [(s1, tail1), (s2, (product_plus(-s2, s1, b) - s2 * tail1) / s1)]


def find_form(a: float, b: float) -> tuple[str, list[tuple[float, float]]]:
    """The form of the solutions, and its two numbers, each with the tail of its root."""
    discriminant = a * a / 4 - b
    s1 = -a / 2 - math.copysign(math.sqrt(max(discriminant, 0.0)), a)
    if (math.sqrt(b) if discriminant < 0 else abs(s1)) <= SMALL:
        return "small", [(a, 0.0), (b, 0.0)]
    form, roots = "apart", None
    if b >= 0:
        roots = [close_square(a, b, 1), close_square(a, b, -1)]
        if discriminant <= 0 or min(abs(value) for value, _ in roots) < 1.5:
            form = "close"
    if form == "apart":
        roots = apart_roots(a, b, s1)
    return form, [(value, root_tail(value, tail)) for value, tail in roots]


def atoms_at(form: str, roots: list[tuple[float, float]], u: float) -> list[list[float]]:
    """The three even atoms and the three odd ones."""
    t, (first, second) = u - 0.5, roots
    if form == "small":
        g = series(first[0], second[0], u)
        return [[1.0, g[0], g[2]], [t, g[1], g[3]]]
    shape = wave if form == "close" else apart
    (even1, odd1), (even2, odd2) = shape(*first, u), shape(*second, u)
    if form == "close":
        return [[1.0, even1 * even2, odd1 * odd2], [t, odd1 * even2, even1 * odd2]]
    return [[1.0, even1, even2], [t, odd1, odd2]]


def derivatives(form: str, roots: list[tuple[float, float]]) -> list[list[list[float]]]:
    """Matrices: row i is the derivative of even atom i by the odd atoms, then vice versa."""
    first, second = roots[0][0], roots[1][0]
    same = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    if form == "small":
        return [[[0, 0, 0], [1, -first, -second], [0, 1, 0]], same]
    if form == "close":
        return [[[0, 0, 0], [0, first, second], [0, 1, 1]],
                [[1, 0, 0], [0, 1, second], [0, 1, first]]]
    return [[[0, 0, 0], [abs(first) <= SMALL, first, 0], [abs(second) <= SMALL, 0, second]], same]


def dot(a: list[float], b: list[float]) -> float:
    total = 0.0
    for x, y in zip(a, b):
        total += x * y
    return total


def times(row: list[float], matrix: list[list[float]]) -> list[float]:
    return [dot(row, [line[j] for line in matrix]) for j in range(3)]


def solutions(m: list[list[float]], right: list[list[float]]) -> list[list[float]]:
    """Row c solves m x = column c of `right`."""
    for k in range(3):
        pivot = max(range(k, 3), key=lambda i: abs(m[i][k]))
        m[k], m[pivot] = m[pivot], m[k]
        right[k], right[pivot] = right[pivot], right[k]
        for i in range(k + 1, 3):
            factor = m[i][k] / m[k][k]
            m[i] = m[i][:k] + [x - factor * y for x, y in zip(m[i][k:], m[k][k:])]
            right[i] = [x - factor * y for x, y in zip(right[i], right[k])]
    result = []
    for c in range(3):
        x = [0.0] * 3
        for k in (2, 1, 0):
            x[k] = (right[k][c] - dot(m[k], x)) / m[k][k]
        result.append(x)
    return result


def modes_of(form: str, roots: list[tuple[float, float]], parity: int) -> list[list[float]]:
    """Half the solution for each condition at u = 1, in terms of the atoms."""
    end, matrices = atoms_at(form, roots, 1.0), derivatives(form, roots)
    square = SMALL if form == "small" else abs(roots[0][0]) + abs(roots[1][0])
    scale = math.sqrt(max(1.0, square))
    m, right, unit = [[0.0] * 3 for _ in range(3)], [[0.0] * 3 for _ in range(3)], 1.0
    rows = [[1.0 if i == k else 0.0 for k in range(3)] for i in range(3)]
    for order in range(3):
        which = (order + parity) % 2
        m[order] = [unit * dot(row, end[which]) for row in rows]
        right[order][order] = unit / 2
        rows = [times(row, matrices[which]) for row in rows]
        unit /= scale
    return solutions(m, right)


def sweep_basis(a: float, b: float, u: float) -> list[list[float]]:
    """g1 to g6 and their first two derivatives at 0 < u < 1."""
    form, roots = find_form(a, b)
    atoms, matrices = atoms_at(form, roots, u), derivatives(form, roots)
    modes = [modes_of(form, roots, parity) for parity in (0, 1)]
    result = []
    for order in range(3):
        parts = [[dot(row, atoms[(order + parity) % 2]) for row in modes[parity]]
                 for parity in (0, 1)]
        result.append([o - e if c % 2 else e - o for c, (e, o) in enumerate(zip(*parts))]
                      + [e + o for e, o in zip(*parts)])
        modes = [[times(row, matrices[(order + parity) % 2]) for row in modes[parity]]
                 for parity in (0, 1)]
    return result
