"""The smaller chunks: docs/file-format.md, "BASE", "TNAM" and "EXAC" to "turn"."""

import math
from dataclasses import dataclass, field

from container import Data, check
from source import Source
from symbols import Names, Symbols
from wireframe import Wireframe

Vector = tuple[float, ...]


@dataclass
class Target:
    name: str
    difference: list[Vector] = field(default_factory=list)
    loose: list[Vector] = field(default_factory=list)


@dataclass
class Turn:
    target: int
    pivot: Vector
    axis: Vector = (0.0, 0.0, 0.0)  # zero for a ball


@dataclass
class Rig:
    tolerance: float = 0.0
    neutral_step: float = 0.0
    target_step: float = 0.0
    loose_count: int = 0
    wireframe: Wireframe = field(default_factory=Wireframe)
    axis: int = 0
    pairs: list[tuple[int, int]] = field(default_factory=list)
    neutral: list[Vector] = field(default_factory=list)
    rest: list[Vector] = field(default_factory=list)  # the neutral before EXAC, if EXAC changes it
    targets: list[Target] = field(default_factory=list)
    forms: list = field(default_factory=list)  # [poses] see vectors.py
    bones: list[int] = field(default_factory=list)  # [stored vectors] empty without bones
    loose: list[Vector] = field(default_factory=list)
    source: Source = field(default_factory=Source)
    scene: bytes = b""
    units: bytes = b""
    names: list[list[bytes]] = field(default_factory=lambda: [[], [], [], []])
    turns: list[Turn] = field(default_factory=list)


def check_name(name: bytes, what: str):
    name.decode()
    check(all(letter >= 32 for letter in name), f"{what} has control characters")


def read_base(data: Data, rig: Rig) -> int:
    """Reads BASE. Returns the number of targets."""
    rig.tolerance, rig.neutral_step, rig.target_step = data.f64(), data.f64(), data.f64()
    check(min(rig.tolerance, rig.neutral_step, rig.target_step) >= 0, "a step is negative")
    targets, rig.loose_count = data.number(), data.number()
    check(max(targets, rig.loose_count) < 2**31, "there are too many targets or loose vertices")
    return targets


def read_tnam(symbols: Symbols, rig: Rig, count: int):
    names = Names(symbols)
    rig.targets = [Target(names.name()) for _ in range(count)]
    for target in rig.targets:
        check_name(target.name.encode(), "the name of a target")
        target.loose = [(0.0, 0.0, 0.0)] * rig.loose_count
    found = {target.name for target in rig.targets}
    check(len(found) == count and "" not in found, "names of targets are alike or empty")


def read_exac(data: Data, rig: Rig):
    pose = -1
    while data.left() > 0:
        pose += 1 + data.number()
        check(pose <= len(rig.targets), "a pose does not exist")
        vectors = rig.neutral if pose == 0 else rig.targets[pose - 1].difference
        if pose == 0:
            rig.rest = list(vectors)
        places, last = [], -1
        for _ in range(data.number()):
            last += 1 + data.signed()
            check(0 <= last < len(vectors), "a vector does not exist")
            places.append(last)
        for place, vector in zip(places, data.vectors(len(places))):
            vectors[place] = vector


def read_drif(data: Data, rig: Rig):
    check(rig.loose, "there are no loose vertices that could move")
    for target in rig.targets:
        target.loose = data.vectors(rig.loose_count)


def read_name(data: Data, rig: Rig):
    rig.units = data.text()
    check_name(rig.units, "the units")
    w = rig.wireframe
    for k, things in enumerate((w.nodes, w.arcs, w.patches, w.ribbons)):
        names = rig.names[k] = data.texts()
        check(len(names) in (0, len(things)), "there are too many or too few names")
        for name in names:
            check_name(name, "a name")
        own = [name for name in names if name]
        check(len(set(own)) == len(own), "two things have the same name")


def read_turn(data: Data, rig: Rig):
    target = -1
    for _ in range(data.number()):
        left_out, is_ball = divmod(data.number(), 2)
        target += 1 + left_out
        check(target < len(rig.targets), "a turn is of a target that there is not")
        turn = Turn(target, tuple(data.f32() for _ in range(3)))
        if not is_ball:
            turn.axis = tuple(data.f32() for _ in range(3))
            check(abs(math.hypot(*turn.axis) - 1) < 1e-5, "the axis of a turn is not of length 1")
        rig.turns.append(turn)


def check_end(rig: Rig, targets: int):
    check(len(rig.targets) == targets, "targets are missing")
    check(all(len(target.difference) == len(rig.neutral) for target in rig.targets),
          "the targets' vectors are missing")
    check(len(rig.loose) == rig.loose_count, "the loose vertices are missing")
