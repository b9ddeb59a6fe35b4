"""Chunks and plain values: docs/file-format-1.md, "Values" and "Container"."""

import math
import struct
import zlib

ORDER = ["BASE", "GRID", "TNAM", "REST", "MOVE", "EXAC", "loos", "drif", "walk", "ordr", "face",
         "poly", "text", "texc", "quad", "scen", "name", "turn", "END "]
REQUIRED = ["BASE", "GRID", "REST", "END "]
TWO_WAYS = [("walk", "ordr"), ("face", "poly"), ("text", "texc"), ("face", "quad")]


def check(holds, what: str):
    if not holds:
        raise ValueError(what)


def chunks_of(file: bytes) -> dict[str, bytes]:
    """The payloads of the known chunks, in file order."""
    check(file[:7] == b"SWEEPFC" and file[7:8] == b"\2", "this is no .sweep file of version 2")
    chunks, at, last = {}, 8, -1
    while "END " not in chunks:
        head = file[at:at + 12]
        check(len(head) == 12, "the file ends before its last chunk")
        kind = head[:4].decode("latin-1")
        size, checksum = struct.unpack("<II", head[4:])
        payload = file[at + 12:at + 12 + size]
        check(len(payload) == size, "the file ends within a chunk")
        check(zlib.crc32(head[:4] + payload) == checksum, f"the checksum of {kind} does not match")
        at += 12 + size
        if kind in ORDER:
            check(ORDER.index(kind) > last, f"{kind} comes twice or out of its order")
            last = ORDER.index(kind)
            chunks[kind] = payload
        else:
            check(not "A" <= kind[0] <= "Z", f"{kind} is required and unknown")
    check(at == len(file), "the file goes on after its last chunk")
    for kind in REQUIRED:
        check(kind in chunks, f"{kind} is missing")
    for one, other in TWO_WAYS:
        check(not (one in chunks and other in chunks), f"{one} and {other} hold the same")
    return chunks


class Data:
    """Reads the values of a payload in sequence."""

    def __init__(self, payload: bytes):
        self.payload, self.at = payload, 0

    def left(self) -> int:
        return len(self.payload) - self.at

    def finish(self):
        check(self.left() == 0, "a chunk goes on after its last value")

    def raw(self, size: int) -> bytes:
        check(size <= self.left(), "a chunk ends within a value")
        self.at += size
        return self.payload[self.at - size:self.at]

    def byte(self) -> int:
        return self.raw(1)[0]

    def f32(self) -> float:
        return self.real("<f")

    def f64(self) -> float:
        return self.real("<d")

    def real(self, form: str) -> float:
        value, = struct.unpack(form, self.raw(struct.calcsize(form)))
        check(math.isfinite(value), "a value is not finite")
        return value

    def number(self) -> int:
        value = 0
        for shift in range(0, 56, 7):
            byte = self.byte()
            value |= (byte & 127) << shift
            if byte < 128:
                check(byte > 0 or shift == 0, "a number is not in its shortest form")
                return value
        raise ValueError("a number is too large")

    def signed(self) -> int:
        n = self.number()
        return n >> 1 ^ -(n & 1)

    def text(self) -> bytes:
        return self.raw(self.number())

    def texts(self) -> list[bytes]:
        return [self.text() for _ in range(self.number())]

    def mask(self, count: int) -> list[int]:
        value = int.from_bytes(self.raw((count + 7) // 8), "little")
        check(value >> count == 0, "a mask has bits beyond its end")
        return [value >> k & 1 for k in range(count)]

    def vectors(self, count: int, components: int = 3) -> list[tuple[float, ...]]:
        form = self.byte()
        if form == 4:
            return self.decimals(count, components)
        check(form < 4, "vectors are in an unknown form")
        held = self.mask(count) if form & 1 else [1] * count
        read = self.f64 if form & 2 else self.f32
        zero = (0.0,) * components
        return [tuple(read() for _ in range(components)) if there else zero for there in held]

    def decimals(self, count: int, components: int) -> list[tuple[float, ...]]:
        digits = self.byte()
        check(digits <= 12, "decimals have too many digits")
        vectors, last = [], [0] * components
        for _ in range(count):
            last = [n + self.signed() for n in last]
            check(all(abs(n) < 9 * 10**15 for n in last), "a decimal is too large")
            vectors.append(tuple(n / 10**digits for n in last))
        return vectors
