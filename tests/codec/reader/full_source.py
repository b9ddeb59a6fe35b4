"""Vertices, faces and texture as version 1 holds them: docs/file-format-1.md, "ordr" to "quad"."""

from container import check


def read_ordr(data, vertices, loose):
    """The order. `vertices`: their number at level 1; `loose`: the number of those on no face."""
    order, last = [], -1
    for _ in range(data.number()):
        last += 1 + data.signed()
        check(-loose <= last < vertices, "a vertex is out of range")
        order.append(last)
    return order


def read_poly(data, source):
    sizes, last = read_runs(data), 0
    check(min(sizes, default=3) >= 3, "a face has two corners")
    for size in sizes:
        source.faces.append([])
        for _ in range(size):
            last += data.signed()
            check(0 <= last < len(source.order), "a vertex is out of range")
            source.faces[-1].append(last)
    source.materials = data.texts()
    source.face_materials = read_choices(data, len(sizes), len(source.materials))
    source.groups = data.texts()
    source.face_groups = read_choices(data, len(sizes), len(source.groups))
    source.material_files = data.texts()


def read_runs(data):
    values = []
    for _ in range(data.number()):
        value, times = data.signed(), data.number()
        check(times > 0, "a run has a wrong length")
        values += [value] * times
    return values


def read_choices(data, faces, names):
    choices = read_runs(data)
    check(len(choices) in (0, faces), "some faces have no name")
    check(all(-1 <= name < names for name in choices), "the name of a face is out of range")
    return choices


def read_texc(data, source):
    count = data.number()
    source.texcoords = data.vectors(count, 2)
    if data.number():
        last = -1
        for _ in range(sum(map(len, source.faces))):
            last += data.signed()
            check(-1 <= last < count, "a texture coordinate is out of range")
            source.references.append(last)


def read_quad(data, source, quads):
    """`quads`: their number at level 1."""
    face_at = [(first, len(face)) for first, face in with_first_corners(source.faces) for _ in face]
    first = 0
    for _ in range(quads):
        told = data.signed()
        first += told >> 1
        check(0 <= first < len(face_at), "a corner is out of range")
        corners = [first]
        if told & 1:
            for _ in range(3):
                corners.append(corners[-1] + data.signed())
                check(0 <= corners[-1] < len(face_at), "a corner is out of range")
        else:
            begin, size = face_at[first]
            check(size == 4, "a quad goes around a face that has not four corners")
            corners += [begin + (first - begin + k) % 4 for k in (1, 2, 3)]
        source.quad_corners.append(corners)


def with_first_corners(faces):
    first = 0
    for face in faces:
        yield first, face
        first += len(face)
