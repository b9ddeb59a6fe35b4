"""Sites, their order, predictions, steps and images: docs/file-format-vectors.md, "Sites",
"Order of sites", "Steps", "Mirror images"."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

from connectivity import CREASED, CROSSING, IRREGULAR
from derivatives import Derivatives, find_derivative
from lines import Lines, Next, host_arms
from rounding import total

Terms = list[tuple[int, float]]  # stored vectors and their factors


@dataclass
class Site:
    nodes: list[int]
    vectors: list[int]  # the stored ones, the position first
    image: int = -1
    parent: int = -1
    span: int = 0
    leaf: bool = True
    terms: Terms = field(default_factory=list)  # that predict its position


class Step(NamedTuple):
    """How a stored vector is reconstructed."""
    vector: int
    site: int
    terms: Terms
    reach: float


class Guess(NamedTuple):
    """How the position of a site follows from its lines."""
    terms: Terms
    span: int
    beside: list[int]  # sites


@dataclass
class Hierarchy:
    sites: list[Site]
    steps: list[Step]
    images: list[tuple[int, int] | None]  # [stored vectors] the image and its sign


def make_hierarchy(model, mirror: tuple[list[int], list[int]]) -> Hierarchy:
    """`mirror`: the images of half-arcs and of nodes, -1 for none."""
    sites = find_sites(model)
    find_site_images(model, mirror[1], sites)
    sites = Order(model, sites).renumbered()
    reach = reach_of(model)
    steps = [make_step(model, reach, sites, s, site.vectors[0], site.terms)
             for s, site in enumerate(sites)]
    rules = Derivatives(model, sites)
    for orders in (1,), (2, 3, 4):
        for s, site in enumerate(sites):
            for v in site.vectors:
                if sum(model.owners[model.stored[v]][1:3]) in orders:
                    steps.append(make_step(model, reach, sites, s, v, rules.predict(site, v)))
    return Hierarchy(sites, steps, vector_images(model, mirror, sites))


# Sites

def find_sites(model) -> list[Site]:
    sites = []
    for v, number in enumerate(model.stored):
        node, i, j, _ = model.owners[number]
        if i == j == 0:
            sites.append(Site([node], []))
        sites[-1].vectors.append(v)
    for site in sites:
        first = site.nodes[0]
        if model.c.kinds[first] == IRREGULAR:
            point = model.w.nodes[first].point
            site.nodes = [n for n, node in enumerate(model.w.nodes)
                          if node.point == point and model.c.kinds[n] == IRREGULAR]
    return sites


def site_of_nodes(model, sites: list[Site]) -> list[int]:
    """The site of each node, -1 for T-nodes."""
    site_of = [-1] * len(model.w.nodes)
    for s, site in enumerate(sites):
        for n in site.nodes:
            site_of[n] = s
    return site_of


def find_site_images(model, node_images: list[int], sites: list[Site]):
    site_of = site_of_nodes(model, sites)
    images = []
    for site in sites:
        node = node_images[site.nodes[0]]
        creased = model.c.kinds[site.nodes[0]] == CREASED
        images.append(-1 if node < 0 or creased else site_of[node])
    for s, image in enumerate(images):
        if image >= 0 and images[image] == s:
            if len(sites[s].vectors) == len(sites[image].vectors):
                sites[s].image = image


# Order of sites

class Order:
    """Takes sites out of their lines and orders all sites."""

    def __init__(self, model, sites: list[Site]):
        self.model, self.sites = model, sites
        self.lines = Lines(model.w, model.c, site_of_nodes(model, sites))
        self.taken = []  # sites in the order in which they were taken out
        self.take_out()
        self.order = self.roots() + self.taken[::-1]

    def renumbered(self) -> list[Site]:
        rank = {s: k for k, s in enumerate(self.order)}
        rank[-1] = -1
        result = [self.sites[s] for s in self.order]
        for site in result:
            site.image, site.parent = rank[site.image], rank[site.parent]
        for site in result:
            if site.parent >= 0:
                result[site.parent].leaf = False
        return result

    # Taking out

    def take_out(self):
        longest = min(4096, max(2, max(rail.edges for rail in self.model.c.rails)))
        most = 2
        while most <= 8 * longest:
            while self.take_out_once(most):
                pass
            most += max(1, most // 3)

    def take_out_once(self, most: int) -> bool:
        blocked = set()
        return any([self.try_site(s, most, blocked) for s in range(len(self.sites))])

    def is_candidate(self, s: int) -> bool:
        node = self.sites[s].nodes[0]
        return self.model.c.kinds[node] == CROSSING and bool(self.pairs_of_arms(node))

    def pairs_of_arms(self, node: int) -> list[tuple[int, int]]:
        """The arms of each line through a crossing."""
        star = self.model.c.stars[node]
        arms = star.arms
        if star.closed:
            return [(arms[0], arms[2]), (arms[1], arms[3])]
        return [(arms[0], arms[2])] if len(arms) == 3 else []

    def may_go(self, s: int, blocked: set[int]) -> bool:
        return s not in blocked and s not in self.lines.out and self.is_candidate(s)

    def try_site(self, s: int, most: int, blocked: set[int]) -> bool:
        image = self.sites[s].image
        if not self.may_go(s, blocked) or 0 <= image < s:
            return False
        guesses = [(s, self.guess(s))]
        if not guesses[0][1] or guesses[0][1].span > most:
            return False
        if image > s:
            if not self.may_go(image, blocked):
                return False
            guesses.insert(0, (image, self.guess(image)))
            if not guesses[0][1] or guesses[0][1].span != guesses[1][1].span:
                return False
        for site, guess in guesses:
            self.sites[site].span, self.sites[site].terms = guess.span, guess.terms
            self.sites[site].parent = self.parent_by(guess.terms)
            self.lines.out.add(site)
            self.taken.append(site)
            blocked.update(guess.beside)
        return True

    def parent_by(self, terms: Terms) -> int:
        most, parent = 0.0, -1
        for v, factor in terms:
            if abs(factor) > most + 1e-9:
                most = abs(factor)
                parent = self.lines.site_of[self.model.owners[self.model.stored[v]].node]
        return parent

    # Guesses

    def guess(self, s: int) -> Guess | None:
        """None if no line predicts the site."""
        site = self.sites[s]
        barred = {site.nodes[0]}
        if site.image >= 0:
            barred.add(self.sites[site.image].nodes[0])
        found, beside = [], []
        for ahead, behind in self.pairs_of_arms(site.nodes[0]):
            if line := self.between(ahead, behind, barred):
                found.append(line)
                ends = [self.lines.site_of[self.lines.next(h).node] for h in (ahead, behind)]
                beside += [s for s in ends if s >= 0]
        weights = [1 / (float(span) * span * span) for _, span in found]
        terms = [term for (terms, _), weight in zip(found, weights)
                 for term in scaled(terms, weight / total(weights))]
        return Guess(terms, min(span for _, span in found), beside) if found else None

    def between(self, ahead: int, behind: int, barred: set[int], depth: int = 0):
        """The terms and the span, or None."""
        near = [self.lines.next(ahead), self.lines.next(behind)]
        if not all(n and n.node not in barred for n in near):
            return None
        span = near[0].distance + near[1].distance
        added = []  # places on the line, with their terms
        for n, sign in zip(near, (1, -1)):
            terms = self.placed(n, barred, depth)
            if not terms:
                return None
            added.append((sign * n.distance, terms))
            far = self.lines.beyond(n)
            if far and far.node not in barred and far.distance <= 3 * n.distance + 2 * span:
                added.append((sign * far.distance, self.placed(far, barred, depth)))
        result = []
        for k, (place, terms) in enumerate(added):
            factor = 1.0
            for o, (other, _) in enumerate(added):
                if o != k:
                    factor *= other / (other - place)
            result += scaled(terms, factor)
        return result, span

    def placed(self, end: Next, barred: set[int], depth: int) -> Terms | None:
        site = self.lines.site_of[end.node]
        if site >= 0:
            return [(self.sites[site].vectors[0], 1.0)]
        if depth > 3:
            return None
        b, a = host_arms(self.model.c, end.node)
        found = self.between(a, b, barred, depth + 1)
        return found and found[0]

    # Roots

    def roots(self) -> list[int]:
        result, reached = [], set()
        for r in range(len(self.sites)):
            if r in self.lines.out or r in reached:
                continue
            queue = [r]
            reached |= {r, self.sites[r].image}
            for s in queue:
                pair = [s] if self.sites[s].image in (-1, s) else [s, self.sites[s].image]
                for p in pair:
                    self.sites[p].terms = self.root_terms(p, result)
                for p in pair:
                    result.append(p)
                    for n, _ in self.neighbours(p):
                        if n not in reached:
                            image = self.sites[n].image
                            reached |= {n, image}
                            queue.append(n if image < 0 else min(n, image))
        return result

    def neighbours(self, s: int) -> list[tuple[int, int]]:
        """The sites that a site's lines lead to, and their distances."""
        ends = [self.lines.next(arm) for n in self.sites[s].nodes
                for arm in self.model.c.stars[n].arms if not self.model.w.arcs[arm >> 1].collapsed]
        found = [(self.lines.site_of[end.node], end.distance) for end in ends if end]
        return [(n, distance) for n, distance in found if n not in (-1, s)]

    def root_terms(self, s: int, placed: list[int]) -> Terms:
        terms = [(self.sites[n].vectors[0], 1 / distance)
                 for n, distance in self.neighbours(s) if n in placed]
        all_of_them = total(factor for _, factor in terms)
        return [(v, factor / all_of_them) for v, factor in terms]


def scaled(terms: Terms, factor: float) -> Terms:
    return [(v, f * factor) for v, f in terms]


# Steps

def make_step(model, reach: list[float], sites: list[Site], s: int, v: int, terms: Terms) -> Step:
    _, i, j, _ = model.owners[model.stored[v]]
    finer = 3 if i + j > 0 else 2 if sites[s].span == 0 else next(
        f for most, f in [(2, 1), (4, 1.25), (8, 1.5), (16, 1.9), (math.inf, 2.3)]
        if sites[s].span <= most)
    return Step(v, s, [t for t in terms if t[1] != 0],
                rounded_reach(reach[model.stored[v]] * finer))


def reach_of(model) -> list[float]:
    """The reach of every vector, by number."""
    reach = [0.0] * len(model.owners)
    on_curve = [lambda edges: 1, lambda edges: 0.16 * edges,
                lambda edges: 0.0173 * edges * edges]
    for corner in range(4 * len(model.w.patches)):
        p, s = divmod(corner, 4)
        alpha, beta = model.w.side_edges(p, s), model.w.side_edges(p, (s + 3) % 4)
        for i in range(3):
            for j in range(3):
                v, _ = model.corner_jet(corner, i, j)
                reach[v] = max(reach[v], on_curve[i](alpha) * on_curve[j](beta))
    for derived in reversed(model.order):
        for v, factor in model.sums.get(derived, []):
            reach[v] = max(reach[v], abs(factor) * reach[derived])
    return reach


def rounded_reach(reach: float) -> float:
    if not reach > 1e-6:
        return 1e-6
    m, e = math.frexp(min(reach, 1e12))
    return math.ldexp(0.5 if m < 0.5843 else 0.703125 if m < 0.8217 else 1, e)


# Mirror images

def vector_images(model, mirror, sites: list[Site]) -> list[tuple[int, int] | None]:
    images = [None] * len(model.stored)
    for site in sites:
        if site.image >= 0:
            for v in site.vectors:
                images[v] = vector_image(model, mirror, site, sites[site.image], v)
    return images


def vector_image(model, mirror, site: Site, other: Site, v: int) -> tuple[int, int] | None:
    node, i, j, _ = model.owners[model.stored[v]]
    if i == j == 0:
        return other.vectors[0], 1
    star = model.c.stars[node]
    g, there = mirror[0][star.arms[0]], model.c.stars[mirror[1][node]].arms
    if g not in there:
        return None
    n = there.index(g)
    if model.c.kinds[node] == IRREGULAR:
        if n != 0 or not star.closed:
            return None
        sign = -1 if j % 2 else 1
    else:
        n %= 4
        sign = (1, 1, -1, -1)[n] ** i * (1, 1, -1, -1)[(n + 3) % 4] ** j
        if n % 2:
            i, j = j, i
    image = find_derivative(model, other.vectors, i, j)
    return None if image is None else (image, sign)
