# SPDX-License-Identifier: BSD-3-Clause
"""Random statements and simple makers of their certificates, in Python and fractions: slow, but enough to hold a checker
against. Where doubles look for a proof they only guess; whether it is one, the checker says."""
import math
import random
from fractions import Fraction

import decide
from decide import apply, dot, scale, solve, sub


def text(x):
    """A number as the format has it: a JSON number where a double is exact, else a fraction."""
    x = Fraction(x)
    if x.denominator == 1 and abs(x) < 2 ** 53:
        return int(x)
    if x.denominator & (x.denominator - 1) == 0 and abs(x) < 2 ** 500 and Fraction(float(x)) == x:
        return float(x)
    return str(x)


def texts(value):
    return [texts(x) for x in value] if isinstance(value, (list, tuple)) else text(value)


def certificate(claim, proof):
    return {"format": "vericone-certificate", "version": 1, "claim": claim, "proof": proof}


def rational(rng, low, high, bits=8):
    return Fraction(rng.randint(int(low * 2 ** bits), int(high * 2 ** bits)), 2 ** bits)


def vector(rng, size, low=-4, high=4):
    return [rational(rng, low, high) for _ in range(size)]


def unit(rng, size):
    """A rational vector of length 1."""
    if size == 2:
        t = rational(rng, -3, 3, 3)
        return [(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)]
    a, b = rational(rng, -2, 2, 3), rational(rng, -2, 2, 3)
    k = 1 + a * a + b * b
    return [(1 - a * a - b * b) / k, 2 * a / k, 2 * b / k]


def factor(rng, size):
    while True:
        m = [[rational(rng, -2, 2, 5) for _ in range(size)] for _ in range(size)]
        if abs(float(decide.determinant(m))) > 0.3:
            return m


def factor_for(rng, n):
    """F with |F^T n| rational, and that number."""
    m = factor(rng, len(n))
    length, u = rational(rng, 1, 3, 3), unit(rng, len(n))
    change = sub(scale(u, length), apply([list(c) for c in zip(*m)], n))
    m = [[x + a * y / dot(n, n) for x, y in zip(row, change)] for row, a in zip(m, n)]
    return m, length


def squared(f):
    return [[dot(a, b) for b in f] for a in f]


class Body:
    """An ellipsoid (factor, or shape), a ball, a hull or a box."""

    def __init__(self, rng, kind, center, size=3, f=None):
        self.kind, self.center, self.size = kind, center, size
        self.factor = self.points = None
        if kind in ("ellipsoid", "shape"):
            self.factor = f or factor(rng, size)
        elif kind == "ball":
            self.radius = rational(rng, 0.25, 2)
            self.factor = [[self.radius * (i == j) for j in range(size)] for i in range(size)]
        elif kind == "hull":
            self.points = [vector(rng, size, -2, 2) for _ in range(rng.randint(1, 6))]
        elif kind == "box":
            self.low, self.high = vector(rng, size, -2, 0), vector(rng, size, 0, 2)
            self.points = [[(self.high if k >> i & 1 else self.low)[i] for i in range(size)] for k in range(1 << size)]

    def corners(self):
        return [[x + y for x, y in zip(self.center, p)] for p in self.points]

    def json(self, velocity=None):
        out = {"center": texts(self.center)}
        if self.kind == "ellipsoid":
            out |= {"kind": "ellipsoid", "factor": texts(self.factor)}
        elif self.kind == "shape":
            out |= {"kind": "ellipsoid", "shape": texts(squared(self.factor))}
        elif self.kind == "ball":
            out |= {"kind": "ball", "radius": text(self.radius)}
        elif self.kind == "hull":
            out |= {"kind": "hull", "points": texts(self.points)}
        else:
            out |= {"kind": "box", "low": texts(self.low), "high": texts(self.high)}
        if velocity is not None:
            out["velocity"] = texts(velocity)
        return out

    def support(self, n):
        """Double: (largest n.x, a point of it)."""
        n = [float(x) for x in n]
        if self.factor is None:
            best = max(self.corners(), key=lambda p: dot(n, [float(x) for x in p]))
            return dot(n, [float(x) for x in best]), [float(x) for x in best]
        s = [[float(x) for x in row] for row in squared(self.factor)]
        m = apply(s, n)
        rho = math.sqrt(max(dot(n, m), 1e-300))
        x = [float(c) + y / rho for c, y in zip(self.center, m)]
        return dot(n, x), x


def truth(a, b, va, vb, horizon):
    """By decide.py."""
    w, c = sub(va, vb), sub(b.center, a.center)
    if a.factor and b.factor:
        return decide.ellipsoids(squared(a.factor), squared(b.factor), c, w, horizon)
    if a.factor:
        return decide.ball_image(a.factor, a.center, b.corners(), w, horizon)
    if b.factor:
        return decide.ball_image(b.factor, b.center, a.corners(), scale(w, -1), horizon)
    return decide.polytopes(a.corners(), b.corners(), w, horizon)


def claim(says, a, b, va, vb, horizon, **more):
    moving = says in ("out", "in", "on", "depends")
    out = {"says": says, "agent": a.json(va if moving else None), "obstacle": b.json(vb if moving else None), **more}
    if moving:
        out["horizon"] = None if horizon is None else text(horizon)
    return out


def gap(a, b, w, n, horizon):
    value = -b.support(scale(n, -1))[0] - a.support(n)[0]
    speed = dot(n, w)
    return min(value, value - horizon * speed) if horizon is not None else value


def exact_normal(a, b, va, vb, horizon):
    """A rational n that proves out, from how decide.py decides."""
    w, c = sub(va, vb), sub(b.center, a.center)
    if not (a.factor and b.factor):
        if b.factor:
            return scale(exact_normal(b, a, vb, va, horizon), -1)
        differences = [sub(y, x) for x in a.corners() for y in b.corners()] if not a.factor else \
            [solve(a.factor, sub(y, a.center)) for y in b.corners()]
        points, way = decide.swept(differences, w if not a.factor else solve(a.factor, w), horizon)
        x = decide.nearest(points)
        if any(way) and dot(x, way) < 0:
            x = decide.nearest([sub(p, scale(way, dot(p, way) / dot(way, way))) for p in points])
        return x if not a.factor else solve([list(column) for column in zip(*a.factor)], x)
    sa, sb = squared(a.factor), squared(b.factor)
    n = decide.normal(sa, sb, c)
    if not any(w) or dot(n, w) <= 0 or horizon == 0:
        return n
    if decide.shadow(sa, sb, c, w) > 0:
        return shadow_normal(sa, sb, c, w)
    return decide.normal(sa, sb, sub(c, scale(w, horizon)))


def shadow_normal(sa, sb, c, w):
    if len(w) == 2:
        n = [-w[1], w[0]]
        return n if dot(n, c) > 0 else scale(n, -1)
    k = next(i for i in range(3) if w[i])
    rows = []
    for axis in [i for i in range(3) if i != k]:
        row = [Fraction(0)] * 3
        row[axis], row[k] = w[k], -w[axis]
        rows.append(row)
    ma, mb = ([[dot(r, apply(s, q)) for q in rows] for r in rows] for s in (sa, sb))
    d = apply(rows, c)
    x = decide.parting(decide.contact(ma, mb, d))
    m = solve([[p + x * q for p, q in zip(ra, rb)] for ra, rb in zip(ma, mb)], d)
    return [dot(m, column) for column in zip(*rows)]


def plane(rng, a, b, va, vb, horizon):
    """A proof of out, of few bits where they are enough."""
    exact, w = exact_normal(a, b, va, vb, horizon), sub(va, vb)
    largest = max(map(abs, exact))
    for bits in (6, 12, 24, 48):
        n = [Fraction(round(x / largest * 2 ** bits)) for x in exact]
        proof = {"rule": "plane", "n": texts(n)}
        if horizon is None and len(w) == 3 and dot(exact, w) == 0 and any(w):
            k = max(range(3), key=lambda i: abs(w[i]))
            ab = [Fraction(round(exact[i] / w[k] / largest * 2 ** bits)) for i in range(3) if i != k]
            proof = {"rule": "plane", "across_w": [k, *texts(ab)]}
            n = normal_of(proof, va, vb)
        limit = None if horizon is None else float(horizon)
        if any(n) and (horizon is not None or dot(n, w) <= 0) and \
                gap(a, b, [float(x) for x in w], [float(x) for x in n], limit) > 1e-9 * float(max(map(abs, n))):
            return proof
    return {"rule": "plane", "n": texts(exact)}


def normal_of(proof, va, vb):
    if "n" in proof:
        return [Fraction(x) for x in proof["n"]]
    w, (k, p, q) = sub(va, vb), proof["across_w"]
    i, j = [i for i in range(3) if i != k]
    n = [Fraction(0)] * 3
    n[i], n[j], n[k] = Fraction(p) * w[k], Fraction(q) * w[k], -Fraction(p) * w[i] - Fraction(q) * w[j]
    return n


def with_limits(proof, a, b, va, vb, horizon):
    """The same plane with both numbers."""
    n = normal_of(proof, va, vb)
    most, least = a.support(n)[0], -b.support(scale(n, -1))[0]
    room = Fraction(max(gap(a, b, [float(x) for x in sub(va, vb)], [float(x) for x in n], None if horizon is None else float(horizon)), 0)) / 8
    grid = Fraction(2) ** max(-1000, math.floor(math.log2(room or Fraction(1, 2 ** 40))) - 2)
    up = (Fraction(most) + room) // grid * grid + grid
    down = (Fraction(least) - room) // grid * grid
    return {**proof, "agent_at_most": text(up), "obstacle_at_least": text(down)}


def inner(rng, a, b, va, vb, horizon):
    """A proof of in by a point, or None; one of the two has an inside."""
    w = sub(va, vb)
    most = horizon if horizon is not None else Fraction(40)
    best = None
    for k in range(41):
        t = most * k / 40
        for _ in range(6):
            # alternating projections, roughly: the middle of what the two centres see
            s = Fraction(rng.randint(1, 15), 16)
            middle_a = center_of(a, va, t)
            middle_b = center_of(b, vb, t)
            x = [p + s * (q - p) for p, q in zip(middle_a, middle_b)]
            depth = min(inside(a, x, va, t), inside(b, x, vb, t))
            if best is None or depth > best[0]:
                best = depth, t, x
    depth, t, x = best
    if depth <= 0:
        return None
    return {"rule": "point", "time": text(t), "point": texts(x), "inside": rng.choice(["agent", "obstacle"])}


def center_of(body, v, t):
    middle = body.center if body.factor else [sum(c) / len(body.points) for c in zip(*body.corners())]
    return [x + t * y for x, y in zip(middle, v)]


def inside(body, x, v, t):
    """Above 0 strictly inside."""
    y = [p - t * q for p, q in zip(x, v)]
    if body.factor:
        u = solve(body.factor, sub(y, body.center))
        return 1 - dot(u, u)
    if body.kind == "box":
        y = sub(y, body.center)
        return min(min(p - l, h - p) for p, l, h in zip(y, body.low, body.high))
    return Fraction(-1)


def touching(rng, size=3):
    """Two bodies that touch exactly at a time t >= 0: (claim of `on`, proof, bodies, velocities, horizon)."""
    n = scale(unit(rng, size), rng.choice([1, 2, 3]))
    bodies, ways = [], []
    for sign in (1, -1):
        f, rho = factor_for(rng, n)
        bodies.append((f, rho))
        ways.append(scale(apply(squared(f), n), sign / rho))
    w = vector(rng, size)
    w = sub(w, scale(n, dot(n, w) / dot(n, n)))
    t = rational(rng, 0, 4)
    p, va = vector(rng, size), vector(rng, size)
    vb = sub(va, w)
    x = [q + a + t * v for q, a, v in zip(p, ways[0], va)]
    q = [y - b - t * v for y, b, v in zip(x, ways[1], vb)]
    kinds = [rng.choice(["ellipsoid", "shape"]) for _ in range(2)]
    a, b = (Body(rng, kind, center, size, f) for kind, center, (f, _) in zip(kinds, (p, q), bodies))
    horizon = rng.choice([None, t, t + 1])
    n = scale(n, rng.choice([1, Fraction(3, 2)]))
    proof = {"rule": "touch", "n": texts(n), "time": text(t), "point": texts(x)}
    return claim("on", a, b, va, vb, horizon), proof, (a, b, va, vb, horizon)


def corner_touch(rng):
    """A ball that grazes a corner, and hulls that touch by corners: by construction."""
    n = unit(rng, 3)
    w = vector(rng, 3)
    w = sub(w, scale(n, dot(n, w)))
    t, va = rational(rng, 0, 4), vector(rng, 3)
    vb = sub(va, w)
    a = Body(rng, "ball", vector(rng, 3))
    x = [c + a.radius * k + t * v for c, k, v in zip(a.center, n, va)]
    points = [[Fraction(0)] * 3]
    for _ in range(rng.randint(0, 3)):
        p = vector(rng, 3, -2, 2)
        points.append(p if dot(p, n) >= 0 else scale(p, -1))
    b = Body(rng, "hull", sub(x, scale(vb, t)))
    b.points = points
    horizon = rng.choice([None, t, t + 2])
    proof = {"rule": "touch", "n": texts(n), "time": text(t), "point": texts(x), "obstacle_weights": [[0, 1]]}
    return claim("on", a, b, va, vb, horizon), proof, (a, b, va, vb, horizon)


def crossing(rng):
    """A hull of corners through whose triangle another's corner flies."""
    a, va, vb = Body(rng, "hull", vector(rng, 3)), vector(rng, 3), vector(rng, 3)
    a.points = a.points[:3]
    i = rng.randrange(len(a.points))
    t = rational(rng, 0.25, 4)
    weights = [Fraction(rng.randint(1, 9)) for _ in range(3)]
    triangle = [vector(rng, 3, -2, 2) for _ in range(3)]
    middle = [dot(weights, c) / sum(weights) for c in zip(*triangle)]
    meet = [p + t * (x - y) for p, x, y in zip(a.corners()[i], va, vb)]
    b = Body(rng, "hull", sub(meet, middle))
    b.points = triangle
    horizon = rng.choice([None, t + 1])
    proof = {"rule": "cross", "time": text(t), "pairs": [[i, j, text(s)] for j, s in enumerate(weights)]}
    return claim("in", a, b, va, vb, horizon), proof, (a, b, va, vb, horizon)


def pair(rng, size=3):
    kinds = [rng.choice(["ellipsoid", "shape", "ball", "hull", "box"]) for _ in range(2)]
    if {"hull", "box"} & set(kinds):  # a factor is needed to decide it
        kinds = ["ellipsoid" if kind == "shape" else kind for kind in kinds]
    a = Body(rng, kinds[0], vector(rng, size), size)
    b = Body(rng, kinds[1], vector(rng, size, -9, 9), size)
    if a.points and b.points:  # few corners: deciding them takes all planes through three
        a, b = (Body(rng, "hull", body.center, size) for body in (a, b))
        a.points, b.points = a.points[:3], b.points[:3]
    va, vb = vector(rng, size), vector(rng, size)
    if rng.random() < 0.5:  # towards each other
        va = [v + x / 4 for v, x in zip(vb, sub(b.center, a.center))]
        va = [x + rational(rng, -1, 1) for x in va]
    return a, b, va, vb, rng.choice([None, None, rational(rng, 0, 8), Fraction(0)])


def verdict(rng, size=3):
    """(certificate, statement) of a random pair, with any rule; None where these makers find none."""
    which = rng.random()
    if which < 0.2:
        its, proof, statement = touching(rng, size)
    elif which < 0.3 and size == 3:
        its, proof, statement = corner_touch(rng)
    elif which < 0.4 and size == 3:
        its, proof, statement = crossing(rng)
    else:
        statement = a, b, va, vb, horizon = pair(rng, size)
        says = truth(*statement)
        if says == "out":
            proof = plane(rng, *statement)
            if proof and rng.random() < 0.5:
                proof = with_limits(proof, *statement)
        elif says == "in":
            proof = inner(rng, *statement)
            if proof and not (a if proof["inside"] == "agent" else b).factor:
                proof["inside"] = "agent" if a.factor else "obstacle"
        else:
            proof = None
        if proof is None:
            return None
        if horizon == 0:
            says = {"out": "disjoint", "in": "overlapping", "on": "touching"}[says]
        its = claim(says, a, b, va, vb, horizon)
    return certificate(its, proof), statement


def read_body(body):
    """The statement of a certificate, read apart from the checker: a Body, or None where it is none of these."""
    out = Body.__new__(Body)
    out.kind, out.factor, out.points = body["kind"], None, None
    if "center" in body:
        out.center = [Fraction(x) for x in body["center"]]
    if out.kind == "ellipsoid":
        if "factor" in body:
            out.factor = [[Fraction(x) for x in row] for row in body["factor"]]
        else:
            out.factor = None
            out.shape = [[Fraction(x) for x in row] for row in body["shape"]]
    elif out.kind == "ball":
        r = Fraction(body["radius"])
        out.factor = [[r * (i == j) for j in range(len(out.center))] for i in range(len(out.center))]
    elif out.kind == "hull":
        out.points = [[Fraction(x) for x in p] for p in body["points"]]
    else:
        low, high = ([Fraction(x) for x in body[k]] for k in ("low", "high"))
        out.points = [[(high if k >> i & 1 else low)[i] for i in range(len(low))] for k in range(1 << len(low))]
    if "center" not in body:
        out.center = [Fraction(0)] * len((out.points or out.factor or out.shape)[0])
    return out


def shape_of(body):
    return squared(body.factor) if body.factor else body.shape


def true_verdict(its):
    """What decide.py says of the statement of a claim."""
    a, b = read_body(its["agent"]), read_body(its["obstacle"])
    moving = "horizon" in its
    va, vb = ([Fraction(x) for x in its[k]["velocity"]] if moving else [Fraction(0)] * len(a.center) for k in ("agent", "obstacle"))
    horizon = its["horizon"] if moving else 0
    horizon = None if horizon is None else Fraction(horizon)
    if not a.points and not b.points:
        return decide.ellipsoids(shape_of(a), shape_of(b), sub(b.center, a.center), sub(va, vb), horizon)
    return truth(a, b, va, vb, horizon)


def generator(seed):
    return random.Random(seed)


# Runs: two or three bodies that turn, on one segment a second.

def bernstein_at(coefficients, tau):
    n = len(coefficients) - 1
    return [sum(math.comb(n, k) * (1 - tau) ** (n - k) * tau ** k * c[i] for k, c in enumerate(coefficients))
            for i in range(len(coefficients[0]))]


def rotation(q):
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    return [[(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
            [2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n],
            [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n]]


class Flight:
    """A body on a track, as doubles see it."""

    def __init__(self, body, track):
        self.body, self.track = body, track
        self.unit = 2.0 ** -track.get("grid", 0)
        self.kind = body["kind"]
        if self.kind == "ellipsoid":
            self.factor = [[float(Fraction(x)) for x in row] for row in body["factor"]]
        elif self.kind == "ball":
            self.factor = [[float(Fraction(body["radius"])) * (i == j) for j in range(3)] for i in range(3)]
        else:
            self.points = [[float(Fraction(x)) for x in p] for p in body["points"]]
        self.offset = [float(Fraction(x)) for x in body.get("center", [0, 0, 0])]

    def pose(self, t):
        times = self.track["times"]
        k = max(0, min(len(times) - 2, sum(x <= t for x in times) - 1))
        tau = (t - times[k]) / (times[k + 1] - times[k])
        p = scale(bernstein_at(self.track["positions"][k], tau), self.unit)
        q = bernstein_at(self.track["turns"][k], tau) if "turns" in self.track else [1, 0, 0, 0]
        return p, rotation(q)

    def reach(self, n, r):
        """The largest n.R b, b in the body."""
        m = [dot(n, column) for column in zip(*r)]
        if self.kind == "hull":
            return max(dot(m, p) for p in self.points) + dot(m, self.offset)
        f = [dot(m, column) for column in zip(*self.factor)]
        return math.sqrt(dot(f, f)) + dot(m, self.offset)

    def least(self, n, t):
        """The largest n.x at time t."""
        p, r = self.pose(t)
        return dot(n, p) + self.reach(n, r)


def separation(a, b, n, t):
    return -b.least(scale(n, -1), t) - a.least(n, t)


def best_normal(a, b, t, start):
    """A unit vector of the largest gap, by turns of ever smaller steps."""
    n, step = start, 0.5
    here = separation(a, b, n, t)
    for _ in range(60):
        axes = [sub(e, scale(n, dot(e, n))) for e in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
        for e in axes + [scale(e, -1) for e in axes]:
            m = [x + step * y for x, y in zip(n, e)]
            m = scale(m, 1 / math.sqrt(dot(m, m)))
            there = separation(a, b, m, t)
            if there > here:
                n, here = m, there
                break
        else:
            step /= 2
    return n, here


def run(rng, count=2, duration=4, turning=True):
    """(claim, flights) of bodies that pass each other."""
    bodies, tracks = [], []
    grid = 20
    for k in range(count):
        kind = rng.choice(["ellipsoid", "ball", "hull"])
        if kind == "ellipsoid":
            bodies.append({"kind": kind, "factor": [[rng.randint(-8, 8) / 16 for _ in range(3)] for _ in range(3)]})
        elif kind == "ball":
            bodies.append({"kind": kind, "center": [0, 0, 0], "radius": rng.randint(1, 8) / 16})
        else:
            bodies.append({"kind": kind, "points": [[rng.randint(-8, 8) / 16 for _ in range(3)] for _ in range(5)]})
        if rng.random() < 0.3:
            bodies[-1]["center"] = [rng.randint(-4, 4) / 16 for _ in range(3)]
        positions, turns, p = [], [], [rng.uniform(-3, 3), 4.0 * k, rng.uniform(-1, 1)]
        v = [rng.uniform(-1, 1) for _ in range(3)]
        q = [rng.gauss(0, 1) for _ in range(4)]
        for _ in range(duration):
            out = [[round(x * 2 ** grid) for x in p]]
            for _ in range(3):
                p = [x + y / 3 for x, y in zip(p, v)]
                v = [y + rng.uniform(-0.1, 0.1) for y in v]
                out.append([round(x * 2 ** grid) for x in p])
            positions.append(out)
            next_q = [x + rng.uniform(-0.4, 0.4) for x in q]
            middle = [(x + y) / 2 + rng.uniform(-0.05, 0.05) for x, y in zip(q, next_q)]
            turns.append([[round(x * 2 ** grid) for x in one] for one in (q, middle, next_q)])
            q = next_q
        track = {"times": list(range(duration + 1)), "grid": grid, "positions": positions, "radius": 1e-6}
        if turning and kind != "ball":
            track["turns"] = turns
        tracks.append(track)
    pairs = [[i, j] for i in range(count) for j in range(i + 1, count)]
    its = {"says": "apart", "by": 0, "from": 0, "to": duration, "bodies": bodies, "tracks": tracks, "pairs": pairs}
    return its, [Flight(*both) for both in zip(bodies, tracks)]


def pieces(a, b, duration):
    """A proof for a pair, or None: halves each segment until the checker's inequalities hold at samples, with room."""
    times, planes, n = [Fraction(0)], [], [0.0, 1.0, 0.0]
    todo = [(Fraction(k), Fraction(k + 1)) for k in reversed(range(duration))]
    while todo:
        start, end = todo.pop()
        samples = [float(start + (end - start) * k / 12) for k in range(13)]
        n, gap_there = best_normal(a, b, samples[6], n)
        whole = [round(x * 2 ** 12) for x in n]
        length = math.isqrt(dot(whole, whole)) + 1
        reaches = [[x.reach(m, x.pose(t)[1]) for t in samples] for x, m in ((a, whole), (b, scale(whole, -1)))]
        limits = []
        for values in reaches:  # a chord, lifted above all samples, and by what the curve may do between them
            chord = [values[0] + (values[-1] - values[0]) * k / 12 for k in range(13)]
            lift = max(v - c for v, c in zip(values, chord))
            bend = max(abs(v - c) for v, c in zip(values, chord))
            more = lift + bend / 4 + 4
            limits.append([math.ceil(values[0] + more), math.ceil(values[-1] + more)])
        room = min(separation(a, b, whole, t) for t in samples)
        slack = max(limits[0][0] - reaches[0][0], limits[0][1] - reaches[0][-1]) + \
            max(limits[1][0] - reaches[1][0], limits[1][1] - reaches[1][-1])
        if room > slack * 1.5 + 8:
            times.append(end)
            planes.append([whole, length, *limits])
        elif end - start < Fraction(1, 64):
            return None
        else:
            middle = (start + end) / 2
            todo += [(middle, end), (start, middle)]
    return {"rule": "pieces", "times": texts(times), "planes": planes}
