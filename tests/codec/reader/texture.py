"""Texture coordinates: docs/file-format-source.md, "text"."""

from container import check

MOST_VALUE, MOST_OFF = 1 << 26, 1 << 20


def read_text(symbols, grid, source):
    """`grid` may be missing if `source` has no quad corners."""
    source.texture_bits = bits = symbols.number(32)
    check(1 <= bits <= 24, "texture coordinates have too many bits")
    count = symbols.number(0, 4)
    corners = sum(map(len, source.faces))
    images = corner_images(grid, source.quad_corners, corners)
    values = Values(symbols, count)
    if symbols.bit(27):
        source.references = read_references(symbols, source.faces, images, count)
        read_by_faces(values, source, images)
    for t in range(count):
        if t not in values.known:
            values.read(t, values.last, 3, 0)
    source.texcoords = [tuple(x * 2.0 ** -bits for x in values.known[t]) for t in range(count)]


def corner_images(grid, quad_corners, corners):
    images = [-1] * corners
    for quad, here in enumerate(quad_corners):
        if grid.quad_images[quad] >= 0:
            there = quad_corners[grid.quad_images[quad]]
            for k in range(4):
                images[here[k]] = there[(grid.turns[quad] - k) % 4]
    return images


def read_references(symbols, faces, images, count):
    references, last_of, answers, new = [], {}, {}, 0
    for corner, vertex in enumerate(v for face in faces for v in face):
        asked = vertex in last_of
        if asked:
            expected = 1 + answers[images[corner]] if images[corner] in answers else 0
            answers[corner] = symbols.bit(29, expected)
        if not answers.get(corner, 0):
            last_of[vertex] = new if symbols.bit(28, asked) else new + symbols.signed(30)
        t = last_of[vertex]
        check(-1 <= t < count, "a texture coordinate is out of range")
        new = max(new, t + 1)
        references.append(t)
    return references


class Values:
    def __init__(self, symbols, count):
        self.symbols = symbols
        self.known, self.off = {}, [0] * count
        self.last = (0, 0)

    def read(self, t, guess, how, active):
        differences = [self.symbols.signed(34, 2 * how + axis, active) for axis in range(2)]
        self.off[t] = sum(min(abs(d), MOST_OFF) for d in differences)
        self.known[t] = self.last = (guess[0] + differences[0], guess[1] + differences[1])
        check(max(map(abs, self.last)) <= MOST_VALUE, "a texture coordinate is out of range")


class Faces:
    """The references at the corners of faces."""

    def __init__(self, faces, references):
        self.size = [len(face) for face in faces]
        self.first = [0]
        for size in self.size:
            self.first.append(self.first[-1] + size)
        self.references = references
        self.sides = {}
        for face, size in enumerate(self.size):
            for k in range(size):
                self.sides.setdefault((self.at(face, k), self.at(face, k + 1)), (face, k))

    def corner(self, face, k):
        return self.first[face] + k % self.size[face]

    def at(self, face, k):
        return self.references[self.corner(face, k)]

    def across(self, face, k):
        """The side across side k, as its face and the corner where it begins, or None."""
        return self.sides.get((self.at(face, k + 1), self.at(face, k)))

    def beyond(self, face, k, known):
        """The references of the opposite side in the quad across, in the same direction."""
        other = self.across(face, k)
        if other and self.size[other[0]] == 4:
            ends = self.at(other[0], other[1] + 3), self.at(other[0], other[1] + 2)
            if ends[0] in known and ends[1] in known:
                return ends[1], ends[0]
        return None


def plus(*terms):
    """The sum of factor · value over pairs (factor, value)."""
    return tuple(sum(factor * value[axis] for factor, value in terms) for axis in range(2))


def read_by_faces(values, source, images):
    faces, reached, misses = Faces(source.faces, source.references), set(), [0] * 9
    for seed in range(len(source.faces)):
        queue = [] if seed in reached else [(seed, 0, None)]
        reached.add(seed)
        for face, begin, entered in queue:
            for k in range(begin, begin + faces.size[face]):
                read_corner(values, faces, images, misses, face, k, k - begin, entered)
            for k in range(faces.size[face]):
                other = faces.across(face, k)
                if other and other[0] not in reached:
                    reached.add(other[0])
                    queue.append((*other, (face, k)))


def read_corner(values, faces, images, misses, face, k, place, entered):
    t = faces.at(face, k)
    if t < 0:
        return
    if t not in values.known:
        guess = guess_without_image(values, faces, face, k, place, entered)
        pair = pair_beside(values, faces, images, face, k)
        if pair:
            read_by_image(values, misses, t, guess, *pair)
        else:
            values.read(t, *guess)
    values.last = values.known[t]


def guess_without_image(values, faces, face, k, place, entered):
    """The guess, `how` and `active`."""
    known, at = values.known, faces.at
    a, c, d = at(face, k - 1), at(face, k + 1), at(face, k + 2)
    if faces.size[face] == 4 and a in known and c in known and d in known:
        guess = plus((1, known[a]), (1, known[c]), (-1, known[d]), (1, bend(known, faces, face, k)))
        return guess, 0, activity(values, a, c, d)
    if place == 2 and entered and a in known:
        there, side = entered
        b = at(there, side - 1)
        if b in known:
            guess = plus((2, known[a]), (-1, known[b]))
            far = faces.beyond(there, side + 2, known) if faces.size[there] == 4 else None
            if far:
                guess = plus((3, known[a]), (-3, known[b]), (1, known[far[1]]))
            return guess, 1, activity(values, a, b)
    return known.get(a, values.last), 2, 0


def bend(known, faces, face, k):
    a, c, d = faces.at(face, k - 1), faces.at(face, k + 1), faces.at(face, k + 2)
    bends = []
    if far := faces.beyond(face, k + 1, known):
        bends.append(plus((1, known[c]), (-1, known[d]), (-1, known[far[0]]), (1, known[far[1]])))
    if far := faces.beyond(face, k + 2, known):
        bends.append(plus((1, known[a]), (-1, known[d]), (1, known[far[0]]), (-1, known[far[1]])))
    if len(bends) == 2:
        return tuple((x + y + 1) // 2 for x, y in zip(*bends))
    return bends[0] if bends else (0, 0)


def activity(values, *around):
    return 1 + (4 * sum(values.off[t] for t in around) // len(around)).bit_length()


def pair_beside(values, faces, images, face, k):
    """The references t', v and v', or None if the image gives no guess."""
    def image_at(place):
        image = images[faces.corner(face, place)]
        return faces.references[image] if image >= 0 else -1

    if image_at(k) in values.known:
        for beside in (k - 1, k + 1):
            pair = faces.at(face, beside), image_at(beside)
            if pair[0] in values.known and pair[1] in values.known:
                return image_at(k), *pair
    return None


def read_by_image(values, misses, t, guess, image, here, there):
    known = values.known
    guesses = [mirrored(known[here], plus((1, known[image]), (-1, known[there])), w)
               for w in range(8)] + [guess[0]]
    best = misses.index(min(misses))
    if best == 8:
        values.read(t, *guess)
    else:
        values.read(t, guesses[best], 4, misses[best].bit_length())
        values.off[t] = values.off[image]
    for w in range(9):
        off = sum(map(abs, plus((1, guesses[w]), (-1, known[t]))))
        misses[w] += min(off, MOST_OFF) - misses[w] // 16


def mirrored(here, step, w):
    x, y = (step[1], step[0]) if w & 4 else step
    return here[0] + (x if w & 1 else -x), here[1] + (-y if w & 2 else y)
