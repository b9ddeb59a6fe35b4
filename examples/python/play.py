"""Moves one expression of a face by a spring and prints how far the face follows.

It needs Python alone, and the shared library of the C interface (docs/c-interface.md).
Usage: play.py libsweepface.so FACE.sweep EXPRESSION
"""

import os
import sys
from array import array
from ctypes import CDLL, POINTER, Structure, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_void_p

FRAMES_A_SECOND = 30


class Vectors(Structure):
    """sweepface_vectors: where to write three floats a vertex."""

    _fields_ = [("data", c_void_p), ("stride", c_size_t)]


# The functions that are called here: what they return and take, as sweepface.h declares it.
FUNCTIONS = {
    "message": (c_char_p,),
    "rig_load": (c_int32, c_char_p, c_size_t, c_char_p, POINTER(c_void_p)),
    "rig_find_target": (c_int32, c_void_p, c_char_p, POINTER(c_uint32)),
    "mesh_create": (c_int32, c_void_p, c_uint32, POINTER(c_void_p)),
    "mesh_point_count": (c_uint32, c_void_p),
    "face_create": (c_int32, c_void_p, POINTER(c_void_p)),
    "face_set_weight": (c_int32, c_void_p, c_uint32, c_double),
    "face_evaluate": (c_int32, c_void_p, c_size_t, Vectors, Vectors),
    "motion_create": (c_int32, POINTER(c_double), c_size_t, POINTER(c_void_p)),
    "motion_move_to": (c_int32, c_void_p, c_uint32, c_double, c_void_p),
    "motion_advance": (None, c_void_p, c_double),
    "motion_positions": (c_int32, c_void_p, POINTER(c_double), c_size_t),
    "rig_free": (None, c_void_p),
    "mesh_free": (None, c_void_p),
    "face_free": (None, c_void_p),
    "motion_free": (None, c_void_p),
}


class Library:
    """The functions by their names without `sweepface_`; those that return a status raise its message."""

    def __init__(self, path):
        library = CDLL(os.path.abspath(path) if os.path.exists(path) else path)
        for name, (result, *arguments) in FUNCTIONS.items():
            function = getattr(library, "sweepface_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(self, name, self.checked(function) if result is c_int32 else function)

    def checked(self, function):
        def call(*arguments):
            if function(*arguments):
                raise ValueError(self.message().decode(errors="replace"))

        return call

    def made(self, make, *arguments, kind=c_void_p):
        """What a function writes to its last argument."""
        out = kind()
        make(*arguments, byref(out))
        return out


def farthest(a, b):
    """The farthest that a vertex of one array lies from that of another."""
    squares = [(x - y) ** 2 for x, y in zip(a, b)]
    return max(map(sum, zip(squares[::3], squares[1::3], squares[2::3])), default=0) ** 0.5


def play(library, path, expression):
    with open(path, "rb") as file:
        data = file.read()
    rig = library.made(library.rig_load, data, len(data), os.fsencode(path))
    target = library.made(library.rig_find_target, rig, os.fsencode(expression), kind=c_uint32)
    mesh = library.made(library.mesh_create, rig, 0)
    face = library.made(library.face_create, mesh)
    weight = c_double(0)
    motion = library.made(library.motion_create, byref(weight), 1)

    count = library.mesh_point_count(mesh)
    rest, now = (array("f", bytes(12 * count)) for _ in range(2))
    nowhere = Vectors(None, 0)
    library.face_evaluate(face, count, Vectors(rest.buffer_info()[0], 0), nowhere)
    print(f"{count} vertices")

    library.motion_move_to(motion, 0, 1, None)
    for frame in range(FRAMES_A_SECOND + 1):
        library.motion_positions(motion, byref(weight), 1)
        library.face_set_weight(face, target, weight)
        library.face_evaluate(face, count, Vectors(now.buffer_info()[0], 0), nowhere)
        print(f"{frame / FRAMES_A_SECOND:4.2f} s  weight {weight.value:.3f}  moved {farthest(now, rest):.4f}")
        library.motion_advance(motion, 1 / FRAMES_A_SECOND)

    for free, handle in ((library.motion_free, motion), (library.face_free, face), (library.mesh_free, mesh),
                         (library.rig_free, rig)):
        free(handle)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("play.py: give libsweepface.so, a .sweep file and the name of an expression.")
    try:
        play(Library(sys.argv[1]), *sys.argv[2:])
    except (AttributeError, OSError, ValueError) as error:
        sys.exit(f"play.py: {error}")
