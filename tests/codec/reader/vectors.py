"""The neutral and the differences of targets: docs/file-format-vectors.md, "REST and MOVE" to
"Forms", and "Values"."""

import math
from dataclasses import dataclass, field

from bones import Carry, add_carries, bone_places, read_bones, read_carries
from coefficients import NOTHING, Coefficients, Steps, reflected
from hierarchy import Hierarchy, Step, make_hierarchy
from kriging import move_steps
from symbols import RangeDecoder, Symbols

Vector = tuple[float, float, float]


@dataclass
class Form:
    finer: int = 0
    image: int = -1  # the pose with whose image it is compared
    like: tuple[int, int, int] | None = None  # pose, mirrored, negated
    carries: list[Carry] = field(default_factory=list)

    def step(self, base: float) -> float:
        return math.ldexp(base, -self.finer)


class Vectors:
    """Reads the chunks into a rig, whose steps, axis and targets must be known."""

    def __init__(self, model, images: tuple[list[int], list[int]], rig):
        """`images`: those of half-arcs and of nodes, -1 for none."""
        self.model, self.rig = model, rig
        self.hierarchy = make_hierarchy(model, images)

    def read_rest(self, coder: RangeDecoder, symbols: Symbols):
        rig, form = self.rig, read_form(symbols, 0)
        rig.forms = [form]
        coefficients = Coefficients(self.hierarchy, coder, rig.axis, neutral=True)
        steps = read_coefficients(coefficients, rig.forms, [], 0)
        rig.neutral = values(self.hierarchy.steps, steps, form.step(rig.neutral_step))

    def read_move(self, coder: RangeDecoder, symbols: Symbols):
        rig = self.rig
        coefficients = Coefficients(self.hierarchy, coder, rig.axis, neutral=False)
        bone_count, rig.bones = read_bones(symbols, self.hierarchy)
        steps = [[]]  # by pose
        for pose in range(1, len(rig.targets) + 1):
            rig.forms.append(read_form(symbols, pose))
            rig.forms[pose].carries = read_carries(symbols, bone_count)
            steps.append(read_coefficients(coefficients, rig.forms, steps, pose))
        moves = move_steps(self.model, self.hierarchy, rig.neutral,
                           rig.forms[0].step(rig.neutral_step))
        places = bone_places(self.model, rig.bones, rig.neutral) if rig.bones else []
        for form, target, its_steps in zip(rig.forms[1:], rig.targets, steps[1:]):
            vectors = values(moves, its_steps, form.step(rig.target_step))
            target.difference = add_carries(vectors, form.carries, rig.bones, places,
                                            rig.target_step / 16)


def read_form(symbols: Symbols, pose: int) -> Form:
    form = Form(symbols.number(45))
    if form.finer > 40:
        raise ValueError("a step is too fine")
    if symbols.bit(47):
        form.image = pose if symbols.bit(48) else earlier(symbols, 49, pose)
    if form.image not in (-1, pose):
        form.like = form.image, 1, 0
    elif pose >= 2 and symbols.bit(51):
        form.like = earlier(symbols, 52, pose), symbols.bit(54), symbols.bit(55)
    return form


def earlier(symbols: Symbols, tag: int, pose: int) -> int:
    target = pose - 1 - symbols.number(tag)
    if target < 1:
        raise ValueError("there is no such target before")
    return target


def in_finer_steps(steps: Steps, finer: int) -> Steps:
    shift = min(30, abs(finer))
    shifted = [x << shift if finer >= 0 else x >> shift for x in steps]
    return [max(-2**26, min(2**26, x)) for x in shifted]


def image_of(pose: list[Steps], images: list, v: int, axis: int, finer: int = 0) -> Steps:
    """The coefficient that the mirror image of a pose gives a vector."""
    if images[v] is None:
        return NOTHING
    vector, sign = images[v]
    return reflected(in_finer_steps(pose[vector], finer), sign, axis)


def read_coefficients(coefficients: Coefficients, forms: list[Form], steps: list[list[Steps]],
                      pose: int) -> list[Steps]:
    """`steps`: those of earlier poses."""
    form, every = forms[pose], range(coefficients.count)
    images, axis = coefficients.images, coefficients.axis
    expected, compared = [[0, 0, 0] for _ in every], "none"
    if form.image == pose:
        compared = "own"
    elif form.image >= 0:
        compared = "another"
        finer = form.finer - forms[form.image].finer
        expected = [image_of(steps[form.image], images, v, axis, finer) for v in every]
    like = None
    if form.like:
        other, mirrored, negated = form.like
        like = [image_of(steps[other], images, v, axis) if mirrored else
                in_finer_steps(steps[other][v], 0) for v in every]
        if negated:
            like = [[-x for x in vector] for vector in like]
    return coefficients.read(expected, compared, like)


def values(steps: list[Step], coefficients: list[Steps], pose_step: float) -> list[Vector]:
    vectors = [()] * len(steps)
    for step in steps:
        unit = pose_step / step.reach
        vector = []
        for c in range(3):
            known = 0.0
            for v, factor in step.terms:
                known += factor * vectors[v][c]
            vector.append(known + coefficients[step.vector][c] * unit)
        if not all(map(math.isfinite, vector)):
            raise ValueError("a coordinate is not finite")
        vectors[step.vector] = tuple(vector)
    return vectors
