"""One number for everything in a file: a second implementation of digestOf in
tests/codec/digest.hpp."""

import struct

from parts import Rig


class Digest:
    """FNV-1a over eight-byte numbers, lowest byte first."""

    def __init__(self):
        self.value = 0xCBF29CE484222325

    def add(self, thing):
        """Adds an integer, a boolean, a double, a text, or several of these."""
        if isinstance(thing, int):
            self.add_bytes((thing & 2**64 - 1).to_bytes(8, "little"))
        elif isinstance(thing, float):
            self.add_bytes(struct.pack("<d", thing))
        elif isinstance(thing, str):
            self.add(thing.encode())
        else:
            for item in thing:
                self.add(item)

    def add_list(self, things):
        self.add(len(things))
        for thing in things:
            if isinstance(thing, (bytes, str)):
                self.add_text(thing)
            else:
                self.add(thing)

    def add_text(self, text: bytes | str):
        raw = text.encode() if isinstance(text, str) else text
        self.add(len(raw))
        self.add(raw)

    def add_bytes(self, eight: bytes):
        for byte in eight:
            self.value = (self.value ^ byte) * 0x100000001B3 & 2**64 - 1


def add_wireframe(d: Digest, w):
    d.add(w.points)
    d.add_list([(n.point, n.stored) for n in w.nodes])
    d.add_list([(a.start, a.end, a.edges, a.ribbon, a.collapsed, a.crease) for a in w.arcs])
    d.add_list(w.patches)
    d.add_list(w.loops)
    d.add_list([(s.rho, s.eta, s.lam) for s in w.ribbons])


def add_source(d: Digest, rig: Rig):
    source, starts = rig.source, [0]
    for face in source.faces:
        starts.append(starts[-1] + len(face))
    d.add_list(source.order)
    d.add(source.own_order)
    for items in (rig.loose, starts, [v for face in source.faces for v in face], source.texcoords,
                  source.references, source.materials, source.face_materials, source.groups,
                  source.face_groups, source.material_files,
                  [corner for quad in source.quad_corners for corner in quad]):
        d.add_list(items)


def add_packing(d: Digest, rig: Rig):
    d.add((rig.neutral_step, rig.target_step, rig.axis))
    d.add_list(rig.pairs)
    d.add(len(rig.forms))
    for form in rig.forms:
        d.add((form.finer, form.image))
        d.add_list(form.carries)
    d.add_list(rig.bones)
    d.add_list(rig.rest)
    d.add(rig.source.texture_bits)


def digest_of(rig: Rig) -> int:
    d = Digest()
    add_wireframe(d, rig.wireframe)
    d.add_list(rig.neutral)
    d.add(len(rig.targets))
    for target in rig.targets:
        d.add_text(target.name)
        d.add_list(target.difference)
        d.add_list(target.loose)
    add_source(d, rig)
    d.add(rig.tolerance)
    d.add_text(rig.scene)
    d.add_text(rig.units)
    for names in rig.names:
        d.add_list(names)
    add_packing(d, rig)
    d.add_list([(t.target, t.pivot, t.axis) for t in rig.turns])
    return d.value
