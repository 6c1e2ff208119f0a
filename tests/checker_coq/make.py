# SPDX-License-Identifier: BSD-3-Clause
"""Certificates by construction, in exact fractions: each is true because of how its bodies are placed."""
import random
from fractions import Fraction

EVEN = [(1, 2, 2), (2, 3, 6), (1, 4, 8), (2, 6, 9), (0, 3, 4), (1, 0, 0), (4, 4, 7), (6, 6, 7), (0, 5, 12), (2, 10, 11)]


def text(x):
    """A number of a file: a JSON number where that is exact, else a fraction."""
    if isinstance(x, (list, tuple)):
        return [text(y) for y in x]
    x = Fraction(x)
    if abs(x) < 2**53 and Fraction(float(x)) == x:
        return x.numerator if x.denominator == 1 else float(x)
    return str(x)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, b, k=1):
    return [x + k * y for x, y in zip(a, b)]


def times(k, a):
    return [k * x for x in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def through(rows, a):
    return [dot(row, a) for row in rows]


def transposed(rows):
    return [list(column) for column in zip(*rows)]


def det(m):
    return dot(m[0], cross(m[1], m[2]))


def times_matrix(k, m):
    return [times(k, row) for row in m]


def through_matrix(a, b):
    return transposed([through(a, column) for column in transposed(b)])


class Maker:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def number(self, size=4):
        kind = self.random.randrange(3)
        if kind == 0:
            return Fraction(self.random.randint(-size, size))
        if kind == 1:
            return Fraction(self.random.uniform(-size, size))
        return Fraction(self.random.randint(-9 * size, 9 * size), self.random.randint(1, 9))

    def vector(self, size=4):
        return [self.number(size) for _ in range(3)]

    def even(self):
        """A vector whose length is an integer."""
        a = list(self.random.choice(EVEN))
        self.random.shuffle(a)
        a = [x * self.random.choice((-1, 1)) for x in a]
        return [Fraction(x) for x in a], Fraction(round(dot(a, a) ** 0.5))

    def body(self, kind, n, length, x):
        """A body that reaches the point x as its farthest along n; the weights of x, if any."""
        if kind == "ball":
            r = abs(self.number()) + Fraction(1, 8)
            return {"kind": "ball", "center": plus(x, n, -r / length), "radius": r}, None
        if kind in ("factor", "shape"):
            m, rho = self.even()
            while True:  # F^T n = m, of length rho
                rows = [self.vector() for _ in range(3)]  # of F: F^T n = sum n_k rows_k
                k = next(i for i in range(3) if n[i])
                rest = [sum(n[i] * rows[i][j] for i in range(3) if i != k) for j in range(3)]
                rows[k] = [(a - b) / n[k] for a, b in zip(m, rest)]
                if det(rows):
                    break
            center = plus(x, through(rows, m), -1 / rho)
            if kind == "factor":
                return {"kind": "ellipsoid", "center": center, "factor": rows}, None
            return {"kind": "ellipsoid", "center": center, "shape": [[dot(a, b) for b in rows] for a in rows]}, None
        if kind == "box":
            size = [abs(self.number()) + Fraction(1, 4) for _ in range(3)]
            low = [(-size[i] if n[i] > 0 else Fraction(0)) for i in range(3)]
            high = plus(low, size)
            return {"kind": "box", "center": list(x), "low": low, "high": high}, None
        points = [list(x)]
        while len(points) < 4 + self.random.randrange(3) or not det([plus(p, x, -1) for p in points[1:4]]):
            p = plus(x, self.vector())
            if dot(n, p) <= dot(n, x):
                points.append(p)
            if len(points) > 7:
                points = [list(x)]
        return {"kind": "hull", "points": points}, [[0, 1]]

    def moved(self, body, by):
        body = dict(body)
        if body["kind"] == "hull":
            body["points"] = [plus(p, by) for p in body["points"]]
        else:
            body["center"] = plus(body["center"], by)
        return body

    def certificate(self, claim, proof):
        def written(value):
            if isinstance(value, dict):
                return {k: written(v) for k, v in value.items()}
            if isinstance(value, (list, tuple)):
                return [written(v) for v in value]
            return text(value) if isinstance(value, Fraction) else value
        return {"format": "vericone-certificate", "version": 1, "claim": written(claim), "proof": written(proof)}

    KINDS = ("factor", "shape", "ball", "hull", "box")

    def contact(self):
        """Two bodies that touch at the point x at the time t, and slide along a plane with normal n."""
        n, length = self.even()
        t = abs(self.number()) + Fraction(1, 16)
        x = self.vector()
        w = plus(times(self.number(), cross(n, [1, 2, 5])), cross(n, [3, -1, 1]), self.number())
        v_b = self.vector()
        v_a = plus(v_b, w)
        a, weights_a = self.body(self.random.choice(self.KINDS), n, length, plus(x, v_a, -t))
        b, weights_b = self.body(self.random.choice(self.KINDS), times(-1, n), length, plus(x, v_b, -t))
        proof = {"rule": "touch", "n": n, "time": t, "point": x}
        if weights_a:
            proof["agent_weights"] = weights_a
        if weights_b:
            proof["obstacle_weights"] = weights_b
        return n, t, x, w, a, b, v_a, v_b, proof

    def horizon(self, t):
        """One that contains t."""
        return self.random.choice([None, t + abs(self.number()), [t / 2, t + 1], [t / 3, None], [t, t + 1]])

    def on(self):
        _, t, _, _, a, b, v_a, v_b, proof = self.contact()
        claim = {"says": "on", "id": self.random.randrange(1000), "horizon": self.horizon(t),
                 "agent": {**a, "velocity": v_a}, "obstacle": {**b, "velocity": v_b}}
        return self.certificate(claim, proof)

    def touching(self):
        n, length = self.even()
        x = self.vector()
        a, weights_a = self.body(self.random.choice(self.KINDS), n, length, x)
        b, weights_b = self.body(self.random.choice(self.KINDS), times(-1, n), length, x)
        proof = {"rule": "touch", "n": n, "time": 0, "point": x}
        if weights_a:
            proof["agent_weights"] = weights_a
        if weights_b:
            proof["obstacle_weights"] = weights_b
        return self.certificate({"says": "touching", "agent": a, "obstacle": b}, proof)

    def out(self):
        n, t, x, w, a, b, v_a, v_b, _ = self.contact()
        depth = Fraction(1, self.random.choice((1, 7, 1000, 10**9, 10**16)))
        by = times(depth / dot(n, n), n)  # the gap along n is this deep
        b = self.moved(b, by)
        l = dot(n, plus(x, v_a, -t))
        m = dot(n, plus(x, v_b, -t)) + depth
        horizon = self.random.choice([None, abs(self.number()), [t, None], [t / 2, t]])
        if horizon is not None and not (isinstance(horizon, list) and horizon[1] is None) and self.random.random() < 0.5:
            last = horizon[1] if isinstance(horizon, list) else horizon
            v_a = plus(v_a, n, depth / (2 * dot(n, n) * (last + 1)))  # nearer, but not soon enough
        claim = {"says": "out", "horizon": horizon, "agent": {**a, "velocity": v_a}, "obstacle": {**b, "velocity": v_b}}
        proof = {"rule": "plane", "n": n}
        if self.random.random() < 0.6:
            proof["agent_at_most"], proof["obstacle_at_least"] = l, m
            if self.random.random() < 0.3:
                claim["by"] = depth / (10**6 * (dot(n, n) + 1))
        return self.certificate(claim, proof)

    def meeting(self):
        n, length = self.even()
        t, x = abs(self.number()), self.vector()
        v_a, v_b = self.vector(), self.vector()
        strict = self.random.choice(("agent", "obstacle"))
        proof = {"rule": "point", "time": t, "point": x, "inside": strict}
        claim = {"says": "in", "horizon": self.horizon(t)}
        for who, v in (("agent", v_a), ("obstacle", v_b)):
            y = plus(x, v, -t)
            body, weights = self.body(self.random.choice(self.KINDS), n if who == "agent" else times(-1, n), length, y)
            if who == strict:
                if weights:
                    weights = [[0, Fraction(1, 2)], [1, Fraction(1, 6)], [2, Fraction(1, 6)], [3, Fraction(1, 6)]]
                    by = plus(y, [sum(w * body["points"][k][i] for k, w in weights) for i in range(3)], -1)
                elif body["kind"] == "box":
                    by = plus(y, plus(body["center"], times(Fraction(1, 2), plus(body["low"], body["high"]))), -1)
                else:
                    by = times(Fraction(1, 10**self.random.randrange(1, 17)), plus(y, body["center"], -1))
                body = self.moved(body, by)
            if weights:
                proof[f"{who}_weights"] = weights
            claim[who] = {**body, "velocity": v}
        return self.certificate(claim, proof)

    def cross(self):
        """Hulls, some flat, that pass through one another."""
        t = abs(self.number()) + Fraction(1, 4)
        x, v_a, v_b = self.vector(), self.vector(), self.vector()
        flat = self.random.random() < 0.5
        while True:
            qs = [self.vector() for _ in range(3 if flat else 4)]
            normal = cross(plus(qs[1], qs[0], -1), plus(qs[2], qs[0], -1))
            if (dot(normal, plus(v_a, v_b, -1)) if flat else dot(normal, plus(qs[-1], qs[0], -1))):
                break
        weights = [Fraction(self.random.randint(1, 5)) for _ in qs]
        mean = times(1 / sum(weights), [sum(w * q[i] for w, q in zip(weights, qs)) for i in range(3)])
        qs = [plus(plus(q, plus(x, v_b, -t)), mean, -1) for q in qs]
        claim = {"says": "in", "horizon": self.random.choice([None, t + 1, [t / 2, t + 1]]),
                 "agent": {"kind": "hull", "points": [plus(x, v_a, -t)], "velocity": v_a},
                 "obstacle": {"kind": "hull", "points": qs, "velocity": v_b}}
        return self.certificate(claim, {"rule": "cross", "time": t, "pairs": [[0, k, w] for k, w in enumerate(weights)]})

    def mesh(self):
        """A ball or an ellipsoid between triangles on two sides; the pieces are mixed."""
        n, length = self.even()
        t, x = Fraction(1), self.vector()
        w = times(self.number(), cross(n, [1, 2, 5]))
        a, _ = self.body(self.random.choice(("factor", "ball")), n, length, x)
        top = dot(n, x)
        bottom = 2 * dot(n, a["center"]) - top
        points, triangles, runs = [], [], []
        for _ in range(self.random.randint(2, 6)):
            above = self.random.randrange(2)
            count = self.random.randint(1, 4)
            for _ in range(count):
                for _ in range(3):
                    p = plus(x, self.vector(8))
                    limit = top if above else bottom
                    gap = (dot(n, p) - limit) / dot(n, n)
                    if (gap <= Fraction(1, 100)) if above else (gap >= -Fraction(1, 100)):
                        p = plus(p, n, -gap + (1 if above else -1))
                    points.append([Fraction(float(c)) for c in p])
                triangles.append([len(points) - 3, len(points) - 2, len(points) - 1])
            if runs and runs[-1][0] == above:
                runs[-1][1] += count
            else:
                runs.append([above, count])
        used = sorted({k for k, _ in runs})
        runs = [[used.index(k), count] for k, count in runs]
        signs = [(-1, 1)[k] for k in used]
        claim = {"says": "out", "horizon": t, "agent": {**a, "velocity": w},
                 "obstacle": {"kind": "mesh", "points": points, "triangles": triangles, "velocity": [0, 0, 0]}}
        return self.certificate(claim, {"rule": "groups", "of": "obstacle", "runs": runs,
                                        "proofs": [{"rule": "plane", "n": times(s, n)} for s in signs]})

    def times(self):
        """A ball that passes another: first a plane across the way, then one beside it."""
        r, s = abs(self.number(2)) + Fraction(1, 8), abs(self.number(2)) + Fraction(1, 8)
        far = 4 * (r + s)
        claim = {"says": "out", "horizon": self.random.choice([None, 50]),
                 "agent": {"kind": "ball", "center": [0, 0, 0], "radius": r, "velocity": [1, 0, 0]},
                 "obstacle": {"kind": "ball", "center": [far, 0, 0], "radius": s, "velocity": [0, 1, 0]}}
        beside = {"rule": "plane", "n": [0, 1, 0]}
        if self.random.random() < 0.5:
            beside.update(agent_at_most=r, obstacle_at_least=-s)
        return self.certificate(claim, {"rule": "times", "cuts": [far / 2], "proofs": [{"rule": "plane", "n": [1, 0, 0]}, beside]})

    def run(self):
        """Two turning bodies whose planes hold with room."""
        n = self.random.choice([[1, 0, 0], [3, 4, 0], [2, 3, 6]])
        length = Fraction({1: 1, 25: 5, 49: 7}[dot(n, n)])
        bodies, tracks, reach = [], [], []
        for k in range(2):
            kind = self.random.choice(("factor", "shape", "ball", "hull", "box"))
            body, _ = self.body(kind, [Fraction(1), Fraction(2), Fraction(2)], Fraction(3), [Fraction(0)] * 3)
            if kind == "hull":
                size = max(sum(map(abs, p)) for p in body["points"])
            else:
                size = sum(map(abs, body["center"])) + (
                    body["radius"] if kind == "ball" else sum(map(abs, plus(body["low"], body["high"]))) + sum(
                        map(abs, body["low"])) if kind == "box" else
                    sum(abs(x) for row in body["factor"] for x in row) if kind == "factor" else
                    1 + sum(abs(x) for row in body["shape"] for x in row))
            bodies.append(body)
            reach.append(Fraction(int(size * length * 2) + 2))
        distance = sum(reach) / length + 8
        for k in range(2):
            base = times(k * distance / length, n)
            places = [[[round(4 * (c + self.random.uniform(-1, 1))) for c in base] for _ in range(self.random.randint(1, 6))]
                      for _ in range(2)]
            track = {"times": [0, 2, 4], "grid": 2, "positions": places, "radius": Fraction(self.random.randint(0, 100), 1000)}
            if self.random.random() < 0.7:
                track["turns"] = [[[4 + self.random.randint(-1, 1), *(self.random.randint(-1, 1) for _ in range(3))]
                                   for _ in range(self.random.randint(1, 4))] for _ in range(2)]
            tracks.append(track)
        start, end = Fraction(self.random.randint(0, 3), 2), Fraction(self.random.randint(5, 8), 2)
        cuts = sorted({start, Fraction(2), end} | {Fraction(self.random.uniform(float(start), float(end))) for _ in range(2)})
        planes = [[n, length, [reach[0]] * self.random.randint(1, 2), [reach[1]] * self.random.randint(1, 2)] for _ in cuts[1:]]
        claim = {"says": "apart", "from": start, "to": end, "by": Fraction(self.random.randint(0, 10), 7), "bodies": bodies,
                 "tracks": tracks, "pairs": [[0, 1]]}
        return self.certificate(claim, {"rule": "pairs", "pairs": {"0 1": {"rule": "pieces", "times": cuts, "planes": planes}}})

    def placed(self, body, f, x):
        """A body about the origin, mapped by f and moved to x; forms keep their values."""
        inverse = [[c / det(f) for c in row] for row in transposed([cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])])]
        body = {**body, "center": x}
        if body["kind"] == "hull":
            return {"kind": "hull", "points": [plus(x, through(f, p)) for p in body["points"]]}
        body["factor"] = through_matrix(f, body["factor"])
        if "delimiters" in body:
            body["delimiters"] = [{"matrix": through_matrix(transposed(inverse), through_matrix(d["matrix"], inverse)),
                                   "level": d["level"]} for d in body["delimiters"]]
        return body

    def dent(self):
        """In the dent of a delimited ball: a ball that leaves it, or a box, or beyond a delimiter; all mapped alike."""
        one = [[Fraction(i == j) for j in range(3)] for i in range(3)]
        biconcave = {"kind": "delimited", "factor": times_matrix(2, one), "delimiters": [
            {"matrix": [[Fraction(4), 0, 0], [0, Fraction(-4), 0], [0, 0, Fraction(-4)]], "level": Fraction(1)}]}
        while True:
            f = [[self.number(2) for _ in range(3)] for _ in range(3)]
            if det(f):
                break
        x, which = self.vector(), self.random.randrange(3)
        if which == 0:
            guest = {"kind": "ellipsoid", "factor": times_matrix(Fraction(self.random.randint(1, 8), 32), one)}
            a, b = self.placed(guest, f, plus(x, through(f, [1, 0, 0]))), self.placed(biconcave, f, x)
            claim = {"says": "out", "horizon": self.random.choice([None, 5]), "agent": {**a, "velocity": through(f, [1, 0, 0])},
                     "obstacle": {**b, "velocity": [0, 0, 0]}}
            return self.certificate(claim, {"rule": "forms", "agent": [Fraction(5, 16)], "obstacle": [0, 1],
                                            "products": [["from", "one", 2]]})
        if which == 1:
            low, high = [Fraction(9, 10), Fraction(-3, 5), Fraction(-1, 10)], [Fraction(11, 10), Fraction(3, 5), Fraction(1, 10)]
            guest = {"kind": "hull", "points": [[(high if k >> i & 1 else low)[i] for i in range(3)] for k in range(8)]}
            a, b = self.placed(guest, f, x), self.placed(biconcave, f, x)
            back = transposed([[c / det(f) for c in row] for row in transposed(
                [cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])])])

            def normal(i, sign):
                return through(back, [sign * (j == i) for j in range(3)])
            both = [[["agent", normal(0, 1)], ["agent", normal(0, -1)], 10], [["agent", normal(2, 1)], ["agent", normal(2, -1)], 5]]
            halves = [{"rule": "forms", "agent": [], "obstacle": [0, 1], "products": both + [
                [["cut", 0], ["agent", normal(1, sign)], 8]]} for sign in (-1, 1)]
            return self.certificate({"says": "disjoint", "agent": a, "obstacle": b}, {
                "rule": "halves", "normal": normal(1, 1), "at": dot(normal(1, 1), x), "below": halves[0], "above": halves[1]})
        cut = {"kind": "delimited", "factor": times_matrix(2, one), "center": x, "delimiters": [
            {"matrix": [[Fraction(-1), 0, 0], [0, Fraction(1), 0], [0, 0, Fraction(1)]], "level": Fraction(1)}]}
        n = [Fraction(0), Fraction(1), Fraction(0)]
        l = dot(n, x) + Fraction(17, 10)
        b = {"kind": "box", "center": x, "low": [-9, Fraction(7, 4), -9], "high": [9, 2, 9]}
        return self.certificate({"says": "disjoint", "agent": cut, "obstacle": b}, {
            "rule": "plane", "n": n, "agent_at_most": l, "agent_multipliers": [5, 1], "obstacle_at_least": l + Fraction(1, 20)})

    def inside(self):
        """A hull or a box within an ellipsoid, a ball or a box, around its center."""
        n, length = self.even()
        b, _ = self.body(self.random.choice(("factor", "shape", "ball")), n, length, self.vector())
        points = []
        while len(points) < 4:
            u, rho = self.even()
            if b["kind"] == "ball":
                points.append(plus(b["center"], u, b["radius"] / rho))
            elif "factor" in b:
                points.append(plus(b["center"], through(b["factor"], u), 1 / rho))
            else:
                points.append(plus(b["center"], through(b["shape"], u), 1 / (1 + dot(u, through(b["shape"], u)))))
        return self.certificate({"says": "inside", "agent": {"kind": "hull", "points": points}, "obstacle": b},
                                {"rule": "vertices"})

    def encounter(self):
        """Two turning bodies at one point at a time."""
        t, x = Fraction(self.random.randint(1, 7), 4), self.vector()
        bodies, tracks = [], []
        proof = {"rule": "point", "time": t, "point": x}
        for who in ("agent", "obstacle"):
            body, weights = self.body(self.random.choice(self.KINDS), *self.even(), [Fraction(0)] * 3)
            v = self.vector()  # the origin of the body is one of its points
            bodies.append(body)
            tracks.append({"times": [0, 2], "positions": [[plus(x, v, -t), plus(x, v, 2 - t)]], "radius": 0,
                           "turns": [[[2 + self.random.randint(0, 2), *(self.random.randint(-1, 1) for _ in range(3))]
                                      for _ in range(self.random.randint(1, 3))]]})
            if weights:
                proof[f"{who}_weights"] = weights
        claim = {"says": "meet", "from": 0, "to": 2, "bodies": bodies, "tracks": tracks, "pair": [0, 1]}
        return self.certificate(claim, proof)

    def robust(self):
        """Out for all errors of the obstacle's position and the agent's velocity."""
        value = self.out()
        claim, proof = value["claim"], value["proof"]
        n = [Fraction(x) for x in proof["n"]]
        length = Fraction(round(dot(n, n) ** 0.5))
        gap, horizon = Fraction(1, 3), abs(self.number()) + 1
        part = gap / (4 * (1 + horizon))
        sets = {"ball": lambda r: ({"ball": text(r)}, r * length),
                "box": lambda r: ({"box": text([r, r / 2, 0])}, r * abs(n[0]) + r / 2 * abs(n[1])),
                "factor": lambda r: ({"factor": text([[r, 0, 0], [0, r, 0], [0, 0, r]])}, r * length)}
        claim["horizon"] = text(horizon)
        claim.pop("by", None)
        kinds = {name: self.random.choice(sorted(sets)) for name in ("position_error", "velocity_error")}
        if self.random.random() < 0.3:
            del kinds[self.random.choice(sorted(kinds))]
        for name, kind in kinds.items():
            claim[name], reach = sets[kind](part / (2 * length))
            proof[f"{name}_at_most"] = text(reach)
        v_a = [Fraction(x) for x in claim["agent"]["velocity"]]
        claim["agent"]["velocity"] = text(plus(v_a, n, -2 * abs(dot(n, v_a)) / dot(n, n) - 1))
        slack = max(Fraction(0), horizon * (dot(n, v_a) - dot(n, [Fraction(x) for x in claim["obstacle"]["velocity"]])))
        # the obstacle is farther away by what they come nearer, and by the errors' part
        far, obstacle = gap + slack + 1, claim["obstacle"]
        shift = times(far / dot(n, n), n)
        if "points" in obstacle:
            obstacle["points"] = [text(plus([Fraction(x) for x in p], shift)) for p in obstacle["points"]]
        else:
            obstacle["center"] = text(plus([Fraction(x) for x in obstacle["center"]], shift))
        if "agent_at_most" not in proof:
            return self.robust()
        proof["obstacle_at_least"] = text(Fraction(proof["obstacle_at_least"]) + far)
        return value

    RULES = ("on", "touching", "out", "out", "out", "meeting", "meeting", "cross", "mesh", "times", "run", "dent", "inside",
             "encounter", "robust")

    def any(self):
        return getattr(self, self.random.choice(self.RULES))()
