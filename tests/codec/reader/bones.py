"""Parts that targets move as a whole: docs/file-format-vectors.md, "Bones" and "Values"."""

import math
from typing import NamedTuple

from container import check
from hierarchy import Hierarchy

Vector = tuple[float, float, float]


class Carry(NamedTuple):
    bone: int
    by: list[list[int]]  # T, X, Y, Z


def read_bones(symbols, hierarchy: Hierarchy) -> tuple[int, list[int]]:
    """The number of bones, and each stored vector's bone or -1 (an empty list without bones)."""
    count = symbols.number(57)
    if count > 64:
        raise ValueError("there are too many bones")
    if count == 0:
        return 0, []
    bones, was_expected, bone = [-1] * len(hierarchy.steps), [], -1
    for s, site in enumerate(hierarchy.sites):
        terms = hierarchy.steps[s].terms
        expected = bones[terms[0][0]] if terms else bone
        a = 1 + was_expected[site.image] if 0 <= site.image < s else 0
        b = 0 if site.parent >= 0 else 2 if terms else 4
        was_expected.append(symbols.bit(59, a, b + (expected < 0)))
        bone = expected if was_expected[s] else symbols.number(60) - 1
        if bone >= count:
            raise ValueError("there is no such bone")
        for v in site.vectors:
            bones[v] = bone
    return count, bones


def read_carries(symbols, count: int) -> list[Carry]:
    carries = []
    for bone in range(count):
        if symbols.bit(62, bone):
            by = [[symbols.signed(63, int(k > 0)) for _ in range(3)] for k in range(4)]
            if any(abs(x) > 2**26 for row in by for x in row):
                raise ValueError("a bone is carried too far")
            carries.append(Carry(bone, by))
    return carries


def bone_places(model, bones: list[int], neutral: list[Vector]) -> list[tuple[bool, Vector]]:
    """For each stored vector: whether it is a position, and its coordinates in its bone's box."""
    is_position = [model.owners[number][1:3] == (0, 0) for number in model.stored]
    places, boxes = [], {}
    for bone in set(bones):
        positions = [p for p, b, is_one in zip(neutral, bones, is_position) if b == bone and is_one]
        boxes[bone] = [(min(x), max(x)) for x in zip(*positions)]
    for p, bone, is_one in zip(neutral, bones, is_position):
        size = max(high - low for low, high in boxes[bone])
        k = 2 / size if size > 0 else 0.0
        if is_one:
            p = tuple(x - 0.5 * (low + high) for x, (low, high) in zip(p, boxes[bone]))
        places.append((is_one, tuple(k * x for x in p)))
    return places


def add_carries(vectors: list[Vector], carries: list[Carry], bones: list[int],
                places: list[tuple[bool, Vector]], unit: float) -> list[Vector]:
    if not carries:
        return vectors
    by_bone = {carry.bone: carry.by for carry in carries}
    result = []
    for vector, bone, (is_position, p) in zip(vectors, bones, places):
        if bone in by_bone:
            t, x, y, z = by_bone[bone]
            vector = tuple(
                vector[c] + unit * (p[0] * x[c] + p[1] * y[c] + p[2] * z[c] +
                                    (t[c] if is_position else 0)) for c in range(3))
        check(all(map(math.isfinite, vector)), "a coordinate is not finite")
        result.append(vector)
    return result
