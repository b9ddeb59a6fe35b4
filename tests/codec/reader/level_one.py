"""The grid of the patches: docs/file-format-source.md, "Level 1"."""

from dataclasses import dataclass


@dataclass
class LevelOne:
    vertices: int
    quads: list[list[int]]  # four vertices each
    vertex_images: list[int]  # -1: none
    quad_images: list[int]
    turns: list[int]  # of the quads with an image


def level_one(wireframe, connectivity, half_arc_images) -> LevelOne:
    """`half_arc_images`: the image of each half-arc, -1 for none."""
    vertices, grids = number_vertices(wireframe)
    grid = LevelOne(vertices, [q for rows in grids for q in quads_of(rows)], [], [], [])
    find_images(grid, [(len(rows[0]) - 1, len(rows) - 1) for rows in grids], wireframe,
                connectivity, half_arc_images)
    return grid


def number_vertices(w):
    """The number of vertices, and for each patch its rows of vertices."""
    at_node, at_point, count = [], {}, 0
    for node, n in enumerate(w.nodes):
        key = ("point", n.point) if n.point >= 0 else ("node", node)
        if key not in at_point:
            at_point[key] = count
            count += 1
        at_node.append(at_point[key])
    within_arc = []
    for arc in w.arcs:
        inner = 0 if arc.collapsed else arc.edges - 1
        within_arc.append(range(count, count + inner))
        count += inner
    grids = []
    for patch in range(len(w.patches)):
        sides = [side_vertices(w, patch, s, at_node, within_arc) for s in range(4)]
        m, n = len(sides[0]), len(sides[1])
        inner = (m - 1) * (n - 1)
        within = iter(range(count, count + inner))
        count += inner
        rows = [[next(within) if 0 < i < m and 0 < j < n else -1 for i in range(m + 1)]
                for j in range(n + 1)]
        for i in range(m):
            rows[0][i], rows[n][m - i] = sides[0][i], sides[2][i]
        for j in range(n):
            rows[j][m], rows[n - j][0] = sides[1][j], sides[3][j]
        grids.append(rows)
    return count, grids


def side_vertices(w, patch, side, at_node, within_arc):
    """The vertices of a side, without the last one."""
    vertices = []
    for h in w.side(patch, side):
        first = at_node[w.start(h)]
        vertices.append(first)
        if w.arcs[h >> 1].collapsed:
            vertices += [first] * (w.arcs[h >> 1].edges - 1)
        else:
            vertices += reversed(within_arc[h >> 1]) if h & 1 else within_arc[h >> 1]
    return vertices


def quads_of(rows):
    return [[below[i], below[i + 1], above[i + 1], above[i]]
            for below, above in zip(rows, rows[1:]) for i in range(len(below) - 1)]


def corners_at(grid):
    """For each vertex, its (quad, corner) pairs in ascending order."""
    at = [[] for _ in range(grid.vertices)]
    for q, quad in enumerate(grid.quads):
        for k, v in enumerate(quad):
            at[v].append((q, k))
    return at


def quad_neighbours(grid):
    first = {}  # the first quad with a side, by the ends of the side
    for q, quad in enumerate(grid.quads):
        for k in range(4):
            first.setdefault((quad[k], quad[(k + 1) % 4]), q)
    return [[first.get((quad[(k + 1) % 4], quad[k]), -1) for k in range(4)] for quad in grid.quads]


def vertex_neighbours(grid):
    return [around(v, [(grid.quads[q][(k + 1) % 4], grid.quads[q][k - 1]) for q, k in corners])
            for v, corners in enumerate(corners_at(grid))]


def around(v, pairs):
    found = []
    while pairs:
        seconds = {b for _, b in pairs}
        at = next((pair for pair in pairs if pair[0] not in seconds), pairs[0])
        while at:
            pairs.remove(at)
            found += [u for u in dict.fromkeys(at) if u != v and u not in found]
            at = next((pair for pair in pairs if pair[0] == at[1]), None)
    return found


def find_images(grid, sizes, w, c, half_arc_images):
    """`sizes`: m and n of each patch."""
    first = [0]  # the first quad of each patch
    for m, n in sizes:
        first.append(first[-1] + m * n)
    grid.quad_images, grid.turns = [-1] * len(grid.quads), [0] * len(grid.quads)
    grid.vertex_images = [-1] * grid.vertices
    for patch, (m, n) in enumerate(sizes):
        there, turn = image_of_patch(patch, sizes, w, c, half_arc_images)
        if there < 0:
            continue
        width, height = sizes[there]
        for q in range(first[patch], first[patch + 1]):
            j, i = divmod(q - first[patch], m)
            column, row = ((j, i), (width - 1 - i, j), (width - 1 - j, height - 1 - i),
                           (i, height - 1 - j))[turn]
            image = first[there] + row * width + column
            grid.quad_images[q], grid.turns[q] = image, turn
            for k, v in enumerate(grid.quads[q]):
                grid.vertex_images[v] = grid.quads[image][(turn - k) % 4]


def image_of_patch(patch, sizes, w, c, half_arc_images):
    """The image patch and the side t, or (-1, 0) for none."""
    image = half_arc_images[w.side(patch, 0)[0]]
    if image < 0 or c.patch_of[image ^ 1] < 0:
        return -1, 0
    corner = c.corner_at[c.next[image ^ 1]]  # 4 * patch + side, or -1
    if corner < 0:
        return -1, 0
    m, n = sizes[corner // 4]
    fits = sizes[patch] == ((n, m) if corner % 2 == 0 else (m, n))
    return (corner // 4, corner % 4) if fits else (-1, 0)
