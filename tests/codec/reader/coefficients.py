"""The coefficients of successive poses: docs/file-format-vectors.md, "Coefficients"."""

from hierarchy import Hierarchy
from symbols import MASK, Model, mixed

Steps = list[int]  # a coefficient: x, y, z
NOTHING = [0, 0, 0]
ANY, BELOW, VECTOR, ZERO, SIGN, MORE = range(6)


def bucket(x: int) -> int:
    return sum(abs(x) >= least for least in (1, 2, 3, 5, 9, 17, 40))


def way(x: int) -> int:
    return 0 if x == 0 else 1 if x < 0 else 2


def largest_bucket(steps: Steps) -> int:
    return max((bucket(x) for x in steps), default=0)


def reflected(steps: Steps, sign: int, axis: int) -> Steps:
    return [-x if (a == axis) == (sign > 0) else x for a, x in enumerate(steps)]


class Coefficients:
    """Reads the coefficients of the neutral or of all targets."""

    def __init__(self, hierarchy: Hierarchy, coder, axis: int, neutral: bool):
        self.sites, self.images, self.axis = hierarchy.sites, hierarchy.images, axis
        self.terms = [[v for v, _ in step.terms] for step in hierarchy.steps[:len(self.sites)]]
        self.neutral = neutral
        self.count = len(hierarchy.steps)
        self.slots = 1 << 10
        while self.slots < min(32 * self.count, 1 << 18):
            self.slots *= 2
        self.model = Model(coder, 5, self.slots, 240, 30 if neutral else 16)
        self.recent = 0  # H
        self.history = [0] * len(self.sites)

    def read(self, expected: list[Steps], compared: str, like: list[Steps] | None) -> list[Steps]:
        """`compared`: with the pose's "own" image, that of "another" pose, or "none"."""
        self.look_at(like)
        self.residual = [NOTHING] * self.count
        self.active, self.below = [0] * len(self.sites), [0] * len(self.sites)
        result = [steps[:] for steps in expected]
        for s, site in enumerate(self.sites):
            follows = compared == "own" and self.image_came(s)
            self.phase = self.phase_of(follows, compared)
            if site.parent < 0 or self.below[site.parent]:
                self.read_site(s)
            for v in site.vectors:
                if follows:
                    other, sign = self.images[v] or (None, 1)
                    result[v] = (NOTHING if other is None
                                 else reflected(result[other], sign, self.axis))
                result[v] = [x + y for x, y in zip(result[v], self.residual[v])]
        for s, active in enumerate(self.active):
            self.history[s] += active
        return result

    def look_at(self, like: list[Steps] | None):
        self.like = like or [NOTHING] * self.count
        self.like_site, self.like_below = [0] * len(self.sites), [0] * len(self.sites)
        if not any(map(any, self.like)):
            return
        for s, site in enumerate(self.sites):
            position, *derivatives = (self.like[v] for v in site.vectors)
            self.like_site[s] = (1 + any(map(any, derivatives)) +
                                 2 * min(3, largest_bucket(position)))
            up = site.parent if self.like_site[s] > 1 else -1
            while up >= 0:
                self.like_below[up] = 1
                up = self.sites[up].parent

    def image_came(self, s: int) -> bool:
        return 0 <= self.sites[s].image < s

    def phase_of(self, follows: bool, compared: str) -> int:
        if self.neutral:
            return 4 if follows else 0
        return 2 if follows else 3 if compared == "another" else 1

    def bit(self, kind: int, sub: int, *contexts: int) -> int:
        slots = [mixed((5 * c + i) * 0x9E3779B1 + (64 * kind + sub) * 0x85EBCA6B & MASK)
                 % self.slots for i, c in enumerate(contexts)]
        bit = self.model.bit(slots, (6 * self.phase + kind) * 8 + min(sub, 7))
        self.recent = (self.recent << 4 ^ 2 * (kind ^ sub) + bit) & MASK
        return bit

    def recently(self, c: int) -> int:
        return c << 12 | self.recent & 0xFFF

    def read_site(self, s: int):
        site, p, likely = self.sites[s], self.phase, self.like_site[s]
        e = sum(site.span > most for most in (0, 2, 4, 8, 16))
        q = 2 if site.parent < 0 else self.active[site.parent]
        m = 1 + self.active[site.image] if self.image_came(s) else 0
        n = min(4, sum(any(self.residual[v]) for v in self.terms[s]))
        t, d = min(6, self.history[s]), self.like_below[s]
        y = self.active[s] = self.bit(
            ANY, site.leaf, self.recently(64 * p + 8 * e + q), 8 * s + p, 8 * (4 * p + m) + n,
            8 * (8 * (8 * p + t) + e) + n, 2 * (8 * (16 * p + likely) + n) + d)
        if y:
            self.read_vectors(s, e)
        if not site.leaf:
            self.below[s] = self.bit(
                BELOW, y, self.recently(64 * p + 8 * e + q), 8 * s + p, 2 * (4 * p + m) + y,
                2 * (8 * (8 * p + t) + e) + y, 2 * (2 * (16 * p + likely) + y) + d)

    def read_vectors(self, s: int, e: int):
        vectors, p = self.sites[s].vectors, self.phase
        before = 0
        for k, v in enumerate(vectors):
            h = 8 * len(vectors) + k
            likely = 2 * (16 * p + self.like_site[s]) + any(self.like[v])
            moved = k == len(vectors) - 1 and before == 0 or self.bit(
                VECTOR, min(k, 7), self.recently(0), 64 * (64 * p + h) + before, 8 * v + p,
                64 * (8 * p + e) + before, 128 * likely + h)
            before = 2 * before + moved
            if moved:
                self.read_vector(s, k, v, e)

    def around(self, s: int, k: int) -> Steps:
        if k > 0:
            return self.residual[self.sites[s].vectors[0]]
        return [max((self.residual[v][a] for v in self.terms[s]), key=abs, default=0)
                for a in range(3)]

    def read_vector(self, s: int, k: int, v: int, e: int):
        p = self.phase
        o = 0 if k == 0 else 1 if k < 3 else 2
        x, like = self.around(s, k), self.like[v]
        known, r = [], 0
        for a in range(3):
            z, by, alike, lean = 4 * (4 * p + o) + a, bucket(x[a]), bucket(like[a]), way(x[a])
            moved = a == 2 and r == 0 or self.bit(
                ZERO, o, self.recently(0), 16 * z + r, 8 * z + by, 8 * (4 * v + a) + p,
                16 * (16 * z + self.like_site[s]) + alike)
            size = 0
            if moved:
                negative = self.bit(
                    SIGN, o, self.recently(0), 16 * z + r, 8 * (4 * v + a) + p,
                    8 * (4 * z + lean) + e, 4 * (4 * z + way(like[a])) + lean)
                w = 8 * (8 * (3 * o + a) + largest_bucket(known)) + largest_bucket(x)
                size = self.magnitude(z, 8 * by + e, 4 * v + a, w, alike)
                known.append(-size if negative else size)
            else:
                known.append(0)
            r = 4 * r + min(2, size)
        self.residual[v] = known

    def magnitude(self, z: int, by: int, place: int, w: int, alike: int) -> int:
        n = 1
        while n < 28 and self.bit(
                MORE, min(n, 8), self.recent & 0xFFFF, 32 * place + n, 32 * w + n, 32 * by + n,
                32 * (8 * z + alike) + n):
            n += 1
        size = 1
        for j in range(1, n):
            f = 32 * (size if j < 4 else 16 + j) + n
            size = 2 * size + self.bit(
                MORE, 9 + min(j, 3), self.recently(0), 64 * f + z, 2048 * f + w, j, 8 * f + alike)
        return size
