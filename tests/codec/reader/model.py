"""All vectors of a model and how they follow from the stored ones: docs/wireframe.md, "Vectors"."""

from collections import defaultdict

from charts import chart_point
from connectivity import CREASED, CROSSING, HANGING, IRREGULAR, Connectivity
from creases import fan_stores, fold
from jets import ALL, MIXED, SECOND_ORDER, Model, Owner
from predicted import hang, predict
from wireframe import Wireframe


def number_arms(m: Model, n: int):
    star = m.c.stars[n]
    m.arms[n] = len(m.owners)
    for _ in range(2 * len(star.arms)):
        m.add(Owner(n))
    for corner in star.sectors:
        m.mixed[corner] = len(m.owners)
        for _ in MIXED:
            m.add(Owner(n))


def number(m: Model):
    m.first, m.arms = [-1] * len(m.w.nodes), [-1] * len(m.w.nodes)
    of_point = {}
    for n, node in enumerate(m.w.nodes):
        m.first[n] = len(m.owners)
        if m.c.kinds[n] == IRREGULAR:
            if node.point not in of_point:
                of_point[node.point] = m.first[n]
                for i, j in SECOND_ORDER:
                    m.add(Owner(n, i, j), True)
            m.first[n] = of_point[node.point]
            number_arms(m, n)
        elif m.c.kinds[n] == CREASED:
            m.add(Owner(n), True)
            for f, fan in enumerate(m.c.fans[n]):
                for i, j in ALL[1:]:
                    m.add(Owner(n, i, j, f), fan_stores(fan, i, j))
            number_arms(m, n)
        else:
            for i, j in ALL:
                in_mask = i == 0 == j or node.stored >> (3 * i + j) & 1
                m.add(Owner(n, i, j), m.c.kinds[n] == CROSSING and bool(in_mask))


def derive_all(m: Model):
    points = defaultdict(list)
    for n, kind in enumerate(m.c.kinds):
        if kind == CROSSING:
            for i, j in ALL[1:]:
                if not m.is_stored[m.component(n, i, j)]:
                    predict(m, n, i, j)
        elif kind == HANGING:
            hang(m, n)
        elif kind == CREASED:
            fold(m, n)
        else:
            points[m.w.nodes[n].point].append(n)
    for nodes in points.values():
        chart_point(m, nodes)


def arrange(m: Model):
    """Orders derived vectors so that each depends only on earlier ones."""
    needs, behind = {}, defaultdict(list)
    for vector, stored in enumerate(m.is_stored):
        if not stored:
            below = [v for v, _ in m.sums.get(vector, []) if not m.is_stored[v]]
            needs[vector] = len(below)
            for v in below:
                behind[v].append(vector)
    m.order = [vector for vector, count in needs.items() if count == 0]
    for vector in m.order:
        for other in behind[vector]:
            needs[other] -= 1
            if needs[other] == 0:
                m.order.append(other)
    if len(m.order) < len(needs):
        raise ValueError("derivatives are derived from themselves")


def model_of(w: Wireframe, c: Connectivity) -> Model:
    m = Model(w, c)
    number(m)
    derive_all(m)
    arrange(m)
    return m
