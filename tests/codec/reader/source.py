"""The places of source vertices, and faces: docs/file-format-source.md, "Walks" to "face"."""

from dataclasses import dataclass, field

from container import check
from level_one import quad_neighbours, vertex_neighbours

TRAIL = 64


@dataclass
class Source:
    order: list[int] = field(default_factory=list)
    own_order: bool = True
    faces: list[list[int]] = field(default_factory=list)  # source vertices
    texcoords: list[tuple[float, float]] = field(default_factory=list)
    references: list[int] = field(default_factory=list)
    texture_bits: int = 0
    materials: list[bytes] = field(default_factory=list)
    face_materials: list[int] = field(default_factory=list)
    groups: list[bytes] = field(default_factory=list)
    face_groups: list[int] = field(default_factory=list)
    material_files: list[bytes] = field(default_factory=list)
    quad_corners: list[list[int]] = field(default_factory=list)  # four per quad


class Walk:
    def __init__(self, symbols, neighbours, images):
        self.symbols, self.neighbours, self.images = symbols, neighbours, images
        self.trail, self.after = [], {}  # after: the item visited right after each
        self.far, self.last = 0, 15

    def visited(self, item):
        return item in self.after

    def next(self):
        item = self.guessed()
        if item < 0:
            item = self.near() if self.trail and self.symbols.bit(3, self.last) else self.jump()
        check(0 <= item < len(self.neighbours) and not self.visited(item), "a walk goes astray")
        if self.trail:
            self.after[self.trail[-1]] = item
        self.after[item] = -1
        self.trail.append(item)
        self.far = item + 1
        return item

    def guessed(self):
        """The guess that is confirmed by a bit 1, or -1."""
        guesses = [(40, 17, self.mirrored()), (38, 16, self.following())]
        for tag, kind, item in guesses[::-1] if self.last == 16 else guesses:
            if item >= 0 and not self.visited(item) and self.symbols.bit(tag, self.last == kind):
                self.last = kind
                return item
        return -1

    def following(self):
        return self.far if self.far < len(self.neighbours) else -1

    def mirrored(self):
        image = self.images[self.trail[-1]] if self.trail else -1
        behind = self.after.get(image, -1)
        return self.images[behind] if behind >= 0 else -1

    def near(self):
        place = self.symbols.number(4, min(self.last, 15))
        self.last = min(place, 14)
        for p, item in enumerate(self.candidates()):
            if p == place:
                return item
        return -1

    def candidates(self):
        for k in range(len(self.trail) - 1, max(len(self.trail) - TRAIL, 0) - 1, -1):
            around = self.neighbours[self.trail[k]]
            begin = 0
            if k > 0 and self.trail[k - 1] in around:
                begin = (around.index(self.trail[k - 1]) + len(around) // 2) % len(around)
            for item in around[begin:] + around[:begin]:
                if item >= 0 and not self.visited(item):
                    yield item

    def jump(self):
        self.last = 15
        return self.far + self.symbols.signed(6)


def read_walk(symbols, grid, loose):
    """The order. `loose`: the number of loose vertices."""
    walk = Walk(symbols, vertex_neighbours(grid), grid.vertex_images)
    order, before, next_loose = [], 0, 0
    for _ in range(symbols.number(0, 0)):
        if symbols.bit(8):
            k = next_loose + symbols.signed(9)
            check(0 <= k < loose, "a loose vertex is out of range")
            next_loose = k + 1
            order.append(-1 - k)
            continue
        before = before + symbols.signed(6, 1) if symbols.bit(2) else walk.next()
        check(0 <= before < grid.vertices, "a vertex is out of range")
        order.append(before)
    return order


def read_face(symbols, grid, source):
    if not source.order:
        source.order = list(range(grid.vertices))
    count = symbols.number(0, 1)
    source.own_order = bool(symbols.bit(37))
    has_quads = symbols.bit(36)
    walk = Walk(symbols, quad_neighbours(grid), grid.quad_images)
    corners = {}  # the face corners of quads that plain faces go around
    read_faces(symbols, grid, source, count, has_quads, walk, corners)
    if has_quads:
        read_other_quads(symbols, grid, source, corners)
    source.materials = read_names(symbols)
    source.face_materials = read_choices(symbols, 0, count, len(source.materials))
    source.groups = read_names(symbols)
    source.face_groups = read_choices(symbols, 1, count, len(source.groups))
    source.material_files = read_names(symbols)


def read_faces(symbols, grid, source, count, has_quads, walk, corners):
    here = [[] for _ in range(grid.vertices)]
    for vertex, place in enumerate(source.order):
        if place >= 0:
            here[place].append(vertex)
    begins = {}  # by quad: the corner at which its face begins
    last_place = {3: 0, 4: 0}  # in the ring, by its size
    plain, last, total = 1, 0, 0
    for _ in range(count):
        plain = symbols.bit(11, plain)
        if plain:
            check(has_quads, "a face goes around a quad of none")
            quad = walk.next()
            ring = turned_ring(symbols, grid, quad, begins, last_place)
            face = [chosen(symbols, here[grid.quads[quad][k]]) for k in ring]
            corners[quad] = quad_corners(ring, total)
        else:
            face = odd_face(symbols, last, len(source.order))
        last = face[-1]
        total += len(face)
        source.faces.append(face)


def turned_ring(symbols, grid, quad, begins, last_place):
    """The corners of a quad in the order of its face."""
    vertices = grid.quads[quad]
    ring = [k for k in range(4) if vertices[k] != vertices[k - 1]]
    check(len(ring) >= 3, "a face goes around a line")
    begin = begins.get(grid.quad_images[quad], -1)
    z = 1 + (grid.turns[quad] - begin) % 4 if begin >= 0 else 0
    context = last_place[len(ring)] + 8 * (4 - len(ring)) + 16 * z
    x = symbols.bit(12, context)
    place = 2 * x + symbols.bit(12, 4 + context, x)
    check(place < len(ring), "a triangle has no fourth corner")
    last_place[len(ring)] = place
    begins[quad] = ring[place]
    return ring[place:] + ring[:place]


def chosen(symbols, vertices):
    check(vertices, "a face has a corner where the source has no vertex")
    which = symbols.number(13) if len(vertices) > 1 else 0
    check(which < len(vertices), "a vertex is out of range")
    return vertices[which]


def quad_corners(ring, first):
    """The face corners at the corners of a quad whose face has `first` as its first corner."""
    at = {k: first + place for place, k in enumerate(ring)}
    return [at[k] if k in at else at[(k - 1) % 4] for k in range(4)]


def odd_face(symbols, last, vertices):
    face = []
    for k in range(3 + symbols.number(15)):
        last += symbols.signed(17, min(k, 4))
        check(0 <= last < vertices, "a vertex is out of range")
        face.append(last)
    return face


def read_other_quads(symbols, grid, source, corners):
    total, last = sum(map(len, source.faces)), 0
    for quad in range(len(grid.quads)):
        if quad not in corners:
            corners[quad] = []
            for k in range(4):
                last += symbols.signed(19, k)
                check(0 <= last < total, "a corner is out of range")
                corners[quad].append(last)
    source.quad_corners = [corners[quad] for quad in range(len(grid.quads))]


def read_names(symbols):
    return [read_bytes(symbols, symbols.number(0, 3)) for _ in range(symbols.number(0, 2))]


def read_bytes(symbols, size):
    text = bytearray(3)
    for _ in range(size):
        known = 1
        for _ in range(8):
            known = 2 * known + symbols.bit(26, 256 * known + text[-1], 256 * text[-3] + text[-2])
        text.append(known - 256)
    return bytes(text[3:])


def read_choices(symbols, what, faces, names):
    if not symbols.bit(21, 8 + what):
        return []
    choices, last = [], -1
    for _ in range(faces):
        if not symbols.bit(21, what):
            last += symbols.signed(22, what)
            check(-1 <= last < names, "the name of a face is out of range")
        choices.append(last)
    return choices
