"""Reads a .sweep file of version 2 and prints the digest of everything in it.

    python3 read_sweep.py FILE

Written from docs/file-format.md and the pages it refers to, section by section."""

import sys

from container import Data, chunks_of
from digest import digest_of
from full_source import read_ordr, read_poly, read_quad, read_texc
from grid import read_grid
from level_one import level_one
from model import model_of
from parts import Rig, check_end, read_base, read_drif, read_exac, read_name, read_tnam, read_turn
from source import read_face, read_walk
from symbols import RangeDecoder, Symbols
from texture import read_text
from vectors import Vectors


def coded(payload: bytes, read):
    """What `read` reads from a range coded payload, which it must use up."""
    coder = RangeDecoder(payload)
    result = read(coder, Symbols(coder))
    coder.finish()
    return result


def plain(payload: bytes, read):
    data = Data(payload)
    result = read(data)
    data.finish()
    return result


def read_grid_chunk(payload: bytes, rig: Rig):
    """Reads GRID. Returns the connectivity and the images of half-arcs and nodes."""
    rig.wireframe, c, rig.axis, rig.pairs, half_images, node_images = coded(
        payload, lambda _, symbols: read_grid(symbols))
    return c, (half_images, node_images)


def read_source(chunks: dict[str, bytes], rig: Rig, grid):
    source = rig.source
    if "walk" in chunks:
        source.order = coded(chunks["walk"], lambda _, s: read_walk(s, grid, rig.loose_count))
    if "ordr" in chunks:
        source.order = plain(chunks["ordr"],
                             lambda data: read_ordr(data, grid.vertices, rig.loose_count))
    if "face" in chunks:
        coded(chunks["face"], lambda _, s: read_face(s, grid, source))
    if "poly" in chunks:
        plain(chunks["poly"], lambda data: read_poly(data, source))
    if "text" in chunks:
        coded(chunks["text"], lambda _, s: read_text(s, grid, source))
    if "texc" in chunks:
        plain(chunks["texc"], lambda data: read_texc(data, source))
    if "quad" in chunks:
        plain(chunks["quad"], lambda data: read_quad(data, source, len(grid.quads)))


def read_others(chunks: dict[str, bytes], rig: Rig):
    if "scen" in chunks:
        rig.scene = plain(chunks["scen"], Data.text)
    if "name" in chunks:
        plain(chunks["name"], lambda data: read_name(data, rig))
    if "turn" in chunks:
        plain(chunks["turn"], lambda data: read_turn(data, rig))


def read_sweep(file: bytes) -> Rig:
    rig, chunks = Rig(), chunks_of(file)
    targets = plain(chunks["BASE"], lambda data: read_base(data, rig))
    c, images = read_grid_chunk(chunks["GRID"], rig)
    if "TNAM" in chunks:
        coded(chunks["TNAM"], lambda _, symbols: read_tnam(symbols, rig, targets))
    vectors = Vectors(model_of(rig.wireframe, c), images, rig)
    coded(chunks["REST"], vectors.read_rest)
    if "MOVE" in chunks:
        coded(chunks["MOVE"], vectors.read_move)
    if "EXAC" in chunks:
        plain(chunks["EXAC"], lambda data: read_exac(data, rig))
    if "loos" in chunks:
        rig.loose = plain(chunks["loos"], lambda data: data.vectors(rig.loose_count))
    if "drif" in chunks:
        plain(chunks["drif"], lambda data: read_drif(data, rig))
    read_source(chunks, rig, level_one(rig.wireframe, c, images[0]))
    read_others(chunks, rig)
    check_end(rig, targets)
    plain(chunks["END "], lambda _: None)
    return rig


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as sweep:
        print(f"{digest_of(read_sweep(sweep.read())):016x}")
