"""Coded bits and the values made of them: docs/file-format.md, "Range coder" to "Names"."""

MASK = 0xFFFFFFFF

# squash at multiples of 128 from -3072 to 3072
PIECES = [
    1, 1, 1, 2, 3, 5, 8, 13, 22, 36, 60, 98, 162, 267, 439, 720, 1179, 1921, 3108, 4971, 7812,
    11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565, 62428, 63615, 64357, 64816,
    65097, 65269, 65374, 65438, 65476, 65500, 65514, 65523, 65528, 65531, 65533, 65534, 65535,
    65535, 65535]


class RangeDecoder:
    def __init__(self, payload: bytes):
        if payload.endswith(b"\0"):
            raise ValueError("the payload ends with a zero byte")
        self.payload, self.at = payload, 0
        self.low, self.high, self.number = 0, MASK, 0
        for _ in range(4):
            self.take()

    def take(self):
        byte = self.payload[self.at] if self.at < len(self.payload) else 0
        self.at += 1
        self.number = (self.number << 8 | byte) & MASK

    def bit(self, one: int) -> int:
        middle = self.low + ((self.high - self.low) * one >> 16)
        if self.number <= middle:
            answer, self.high = 1, middle
        else:
            answer, self.low = 0, middle + 1
        while (self.low ^ self.high) >> 24 == 0:
            self.low = self.low << 8 & MASK
            self.high = (self.high << 8 | 255) & MASK
            self.take()
        return answer

    def finish(self):
        if self.at < len(self.payload):
            raise ValueError("the payload goes on after its last value")


def squash_of(x: int) -> int:
    if x == 3072:
        return PIECES[48]
    left, rest = divmod(x + 3072, 128)
    return PIECES[left] + ((PIECES[left + 1] - PIECES[left]) * rest + 64 >> 7)


SQUASH = [squash_of(x) for x in range(-3072, 3073)]


def stretch_table() -> list[int]:
    table = []
    for x in range(-3072, 3073):
        table += [x] * (SQUASH[x + 3072] // 16 + 1 - len(table))
    return table + [3072] * (4096 - len(table))


def toward_zero(a: int, b: int) -> int:
    return a // b if a >= 0 else -(-a // b)


STRETCH = stretch_table()
TRUST = [0] + [16 * n // (n + 1) + 4 for n in range(1, 31)]
# what an input contributes before its weight: [count][probability / 16]
SAYS = [[toward_zero(s * trust, 16) for s in STRETCH] for trust in TRUST]


class Model:
    """Decodes bits by the slots of several contexts and one of several sets of weights."""

    def __init__(self, coder: RangeDecoder, inputs: int, slots: int, sets: int, most: int = 30):
        self.coder, self.most = coder, most
        self.probability, self.count = [32768] * slots, [0] * slots
        self.weights = [[87381 // (inputs + 1)] * inputs for _ in range(sets)]

    def bit(self, contexts: list[int], weight_set: int) -> int:
        """`contexts`: a slot for each input."""
        weights = self.weights[weight_set]
        said = [SAYS[self.count[c]][self.probability[c] >> 4] for c in contexts]
        x = sum(s * w for s, w in zip(said, weights)) >> 16
        one = SQUASH[max(-3071, min(3071, x)) + 3072]
        bit = self.coder.bit(one)
        error = toward_zero((65536 * bit - one) * 14, 16)
        for k, s in enumerate(said):
            weights[k] += s * error + 32768 >> 16
        for c in contexts:
            self.learn(c, bit)
        return bit

    def learn(self, c: int, bit: int):
        p, n = self.probability[c], self.count[c]
        step = 2 * (65535 - p if bit else p) // (2 * n + 3)
        self.probability[c] = p + step if bit else p - step
        if n < self.most:
            self.count[c] = n + 1


def mixed(y: int) -> int:
    """Scatters 32 bits."""
    y = (y ^ y >> 15) * 0x2C1B3C6D & MASK
    return y ^ y >> 13


class Symbols:
    """The values of all parts but coefficients. Tags and contexts are plain integers."""

    def __init__(self, coder: RangeDecoder):
        self.model = Model(coder, 3, 1 << 15, 64)
        self.recent = 0

    def bit(self, tag: int, a: int = 0, b: int = 0) -> int:
        contexts = (self.recent, 521 * a + self.recent % 4096, 521 * a + b)
        slots = [mixed((3 * c + i) * 0x9E3779B1 + tag * 0x85EBCA6B & MASK) & 0x7FFF
                 for i, c in enumerate(contexts)]
        bit = self.model.bit(slots, tag % 64)
        self.recent = (self.recent << 4 ^ 2 * tag + bit) & MASK
        return bit

    def number(self, tag: int, a: int = 0, b: int = 0) -> int:
        length = 1
        while length < 33 and self.bit(tag, 64 * a + length, b):
            length += 1
        n = 1
        for k in range(length - 2, -1, -1):
            known = n if n < 16 else 0
            n = 2 * n + self.bit(tag + 1, 64 * a + length, 32 * known + k)
        return (n - 1) & MASK

    def signed(self, tag: int, a: int = 0, b: int = 0) -> int:
        n = self.number(tag, a, b)
        return n >> 1 ^ -(n & 1)

    def index(self, tag: int, count: int) -> int:
        n = 0
        for k in range(max(0, count - 1).bit_length() - 1, -1, -1):
            n = 2 * n + self.bit(tag, k)
        if n >= count:
            raise ValueError("an index is out of range")
        return n

    def raw(self, tag: int) -> int:
        n = 0
        for k in range(63, -1, -1):
            n = 2 * n + self.bit(tag, k)
        return n


USUAL = (
    "browDown,browInnerUp browOuterUp,cheekPuff cheekSquint,eyeBlink,eyeLookDown,eyeLookIn,"
    "eyeLookOut,eyeLookUp,eyeSquint,eyeWide,jawForward jawLeft jawOpen jawRight mouthClose "
    "mouthDimple,mouthFrown,mouthFunnel mouthLeft mouthLowerDown,mouthPress,mouthPucker mouthRight "
    "mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper mouthSmile,mouthStretch,"
    "mouthUpperUp,noseSneer,tongueOut ")


def usual_names(left: str, right: str) -> list[str]:
    pairs = USUAL.replace(",", ", ").split()
    return [name.rstrip(",") + end for name in pairs
            for end in ((left, right) if name.endswith(",") else ("",))]


class Names:
    """Reads successive names, predicted from a growing text of names."""

    def __init__(self, symbols: Symbols):
        self.symbols = symbols
        self.text = bytearray()
        self.last_after = {}  # by table entry: the length of the text at that time
        self.found = 0  # F
        self.guess_at, self.alike = 0, 0  # no guess while guess_at is 0
        for name in usual_names("_L", "_R") + usual_names("Left", "Right"):
            for letter in name.encode() + b"\0":
                self.add(letter)

    def add(self, letter: int):
        self.text.append(letter)
        past = int.from_bytes(self.text[-3:], "big")
        entry = past * 0x9E3779B1 % 2**32 >> 20
        self.found = self.last_after.get(entry, 0)
        self.last_after[entry] = len(self.text)

    def seek(self):
        self.guess_at, self.alike, end = self.found, 0, len(self.text)
        while self.alike < min(15, self.guess_at) and (
                self.text[self.guess_at - 1 - self.alike] == self.text[end - 1 - self.alike]):
            self.alike += 1
        if self.alike < 3:
            self.guess_at = 0

    def letter(self) -> int:
        if self.guess_at > 0:
            guess = self.text[self.guess_at]
            if self.symbols.bit(56, min(self.alike, 15), guess):
                self.guess_at += 1
                self.alike += 1
                self.add(guess)
                return guess
        past, known = int.from_bytes(self.text[-3:], "big"), 1
        for _ in range(8):
            known = 2 * known + self.symbols.bit(44, 256 * known + past % 256, past >> 8)
        self.add(known - 256)
        self.seek()
        return known - 256

    def name(self) -> str:
        letters = bytearray()
        while letter := self.letter():
            letters.append(letter)
        return letters.decode()
