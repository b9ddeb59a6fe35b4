"""Lines, as sites are taken out of them: docs/file-format-vectors.md, "Lines"."""

from typing import NamedTuple

from connectivity import STRAIGHT


class Next(NamedTuple):
    node: int
    distance: int
    back: int  # the half-arc that leaves the node backwards along the line


class Lines:
    """`site_of`: the sites of nodes, -1 for T-nodes."""

    def __init__(self, w, c, site_of: list[int]):
        self.w, self.c, self.site_of = w, c, site_of
        self.out = set()  # sites
        self.known = {}  # by half-arcs; sites never come back

    def next(self, h: int) -> Next | None:
        """The next node along a line that has not been taken out."""
        end, passed = self.known_end(h), set()
        while end and self.site_of[end.node] in self.out:
            on = opposite_of(self.w, self.c, end.back)
            more = None if on is None or on in passed else self.known_end(on)
            passed.add(on)  # a line may be a ring with no sites left
            end = more and Next(more.node, end.distance + more.distance, more.back)
        self.known[h] = end
        return end

    def known_end(self, h: int) -> Next | None:
        return self.known[h] if h in self.known else self.rail_end(h)

    def rail_end(self, h: int) -> Next:
        rail = self.c.rails[h]
        return Next(self.w.end(rail.last), rail.edges, rail.last ^ 1)

    def beyond(self, near: Next) -> Next | None:
        """The site after `near` on the same line."""
        on = opposite_of(self.w, self.c, near.back)
        end = on is not None and self.site_of[near.node] >= 0 and self.next(on)
        if not end or self.site_of[end.node] < 0:
            return None
        return Next(end.node, near.distance + end.distance, end.back)


def opposite_of(w, c, h: int) -> int | None:
    """The half-arc that continues the line of h across the start of h, or None."""
    node = w.start(h)
    arms = c.stars[node].arms
    on = c.opposite(node, arms.index(h))
    return None if on < 0 else arms[on]


def host_arms(c, node: int) -> tuple[int, int]:
    """The arms of a T-node along the side that it lies on, in order."""
    star = c.stars[node]
    k = star.sectors.index(STRAIGHT)
    return star.arms[k], star.arms[(k + 1) % 3]
