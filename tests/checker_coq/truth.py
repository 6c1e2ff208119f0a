# SPDX-License-Identifier: BSD-3-Clause
"""Whether a certificate proves what it claims, by fractions: a second opinion that shares nothing with the checkers.
Ellipsoids by solving for u, roots by brackets of 600 bits, forms of runs by polynomials in powers of tau."""
import json
import re
from fractions import Fraction
from math import comb, isfinite, isqrt


class Malformed(Exception):
    pass


def need(true):
    if not true:
        raise Malformed


def number(x):
    if isinstance(x, str):
        need(re.fullmatch(r"-?[0-9]+(/[0-9]+)?", x) and len(x) <= 4300)
        top, _, bottom = x.partition("/")
        need(not bottom or int(bottom) > 0)
        return Fraction(int(top), int(bottom or 1))
    need(type(x) in (int, float) and isfinite(x))
    return Fraction(float(x))


def whole(x):
    need(type(x) is int and 0 <= x)
    return x


def array(x, least=1):
    need(isinstance(x, list) and len(x) >= least)
    return x


def vector(x, size=3):
    need(len(array(x)) == size)
    return [number(y) for y in x]


def matrix(x):
    need(len(array(x)) == 3)
    return [vector(row) for row in x]


def fields(x, needed, allowed=()):
    need(isinstance(x, dict) and set(needed) <= set(x) <= set(needed) | set(allowed))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, b, k=1):
    return [x + k * y for x, y in zip(a, b)]


def eliminated(rows):
    """(echelon rows, rank) of a matrix."""
    rows, rank = [list(r) for r in rows], 0
    for j in range(len(rows[0])):
        found = next((i for i in range(rank, len(rows)) if rows[i][j]), None)
        if found is not None:
            rows[rank], rows[found] = rows[found], rows[rank]
            for i in range(len(rows)):
                if i != rank:
                    rows[i] = plus(rows[i], rows[rank], -rows[i][j] / rows[rank][j])
            rank += 1
    return rows, rank


def solve(m, y):
    """u with m u = y, or None."""
    if eliminated(m)[1] < 3:
        return None
    rows, _ = eliminated([row + [b] for row, b in zip(m, y)])
    return [rows[i][3] / rows[i][i] for i in range(3)]


def definite(m):
    m = [list(row) for row in m]
    for k in range(3):
        if m[k][k] <= 0:
            return False
        for i in range(k + 1, 3):
            m[i] = plus(m[i], m[k], -m[i][k] / m[k][k])
    return True


BITS = 600


def root(q, up):
    """A bound of sqrt(q)."""
    k = isqrt((q.numerator << 2 * BITS) // q.denominator)
    exact = Fraction(k, 1 << BITS)
    return exact if exact * exact == q else exact + Fraction(up, 1 << BITS)


def minors_positive(m):
    """All leading minors of a symmetric matrix, each by itself."""
    def determinant(rows):
        if not rows:
            return Fraction(1)
        return sum((-1) ** j * rows[0][j] * determinant([r[:j] + r[j + 1:] for r in rows[1:]]) for j in range(len(rows)))
    return all(determinant([row[:k] for row in m[:k]]) > 0 for k in range(1, len(m) + 1))


def definite_form(q, size):
    """Of a quadratic function of size numbers: its matrix is that of its values."""
    def at(*which):
        return q([Fraction(sum(i == j for j in which)) for i in range(size)])
    single = [at(i) for i in range(size)]
    return minors_positive([[single[i] if i == j else (at(i, j) - single[i] - single[j]) / 2 for j in range(size)]
                            for i in range(size)])


class Piece:
    def __init__(self, kind, p, data, cuts=()):
        self.kind, self.p, self.data, self.cuts = kind, p, data, cuts

    def forms(self):
        """(function of y = x - p, level) of each y with f(y) <= level; None where the body is flat."""
        if self.kind in ("hull", "box"):
            return []
        if self.kind == "ball":
            return [(lambda y: dot(y, y), self.data ** 2)]
        if solve(self.data, [1, 0, 0]) is None:
            return None

        def own(y):
            u = solve(self.data, y)
            return dot(u, u) if self.kind == "factor" else dot(u, y)
        return [(own, Fraction(1))] + [(lambda y, m=m: dot(y, [dot(row, y) for row in m]), level) for m, level in self.cuts]

    def corners(self):
        if self.kind == "hull":
            return self.data
        if self.kind == "box":
            low, high = self.data
            return [[(high if k >> i & 1 else low)[i] for i in range(3)] for k in range(8)]
        return [self.p] if self.kind == "ball" and self.data == 0 else []

    def middle_bulge(self, n):
        if self.kind in ("hull", "box"):
            return max(dot(n, x) for x in self.corners()), Fraction(0)
        if self.kind == "ball":
            return dot(n, self.p), self.data ** 2 * dot(n, n)
        if self.kind == "factor":
            return dot(n, self.p), sum(dot(column, n) ** 2 for column in zip(*self.data))
        return dot(n, self.p), sum(n[i] * n[j] * self.data[i][j] for i in range(3) for j in range(3))

    def at_most_by(self, n, l, multipliers):
        forms = self.forms()
        if not forms or len(multipliers) != len(forms) or any(m < 0 for m in multipliers):
            return False
        r, level = l - dot(n, self.p), sum(m * its for m, (_, its) in zip(multipliers, forms))
        return r > 0 and level > 0 and definite_form(
            lambda z: sum(m * f(z[:3]) for m, (f, _) in zip(multipliers, forms)) + 2 * z[3] * dot(n, z[:3])
            + z[3] ** 2 * r ** 2 / level, 4)

    def at_most(self, n, l):
        middle, bulge = self.middle_bulge(n)
        return middle <= l and bulge <= (l - middle) ** 2

    def has(self, x, strictly, weights):
        less = (lambda a, b: a < b) if strictly else (lambda a, b: a <= b)
        if self.cuts and not weights:
            y, forms = plus(x, self.p, -1), self.forms()
            return forms is not None and all(less(f(y), level) for f, level in forms)
        if weights:
            corners = self.corners()
            used = [k for k, _ in weights]
            if any(k >= len(corners) for k in used) or any(w <= 0 for _, w in weights) or sum(w for _, w in weights) != 1:
                return False
            if any(sum(w * corners[k][i] for k, w in weights) != x[i] for i in range(3)):
                return False
            ways = [plus(corners[k], corners[used[0]], -1) for k in used]
            return not strictly or eliminated(ways)[1] == 3
        y = plus(x, self.p, -1)
        if self.kind == "ball":
            return less(dot(y, y), self.data ** 2)
        if self.kind == "box":
            return all(less(a, b) and less(b, c) for a, b, c in zip(self.data[0], x, self.data[1]))
        if self.kind == "hull":
            return False
        u = solve(self.data, y)
        if u is None:
            return False
        return less(dot(u, u) if self.kind == "factor" else dot(u, y), 1)


def body(value, moves):
    kind = value.get("kind") if isinstance(value, dict) else None
    own = {"ellipsoid": ["factor", "shape"], "ball": ["radius"], "hull": ["points"], "box": ["low", "high"],
           "mesh": ["points", "triangles"], "delimited": ["factor", "shape"]}
    need(isinstance(kind, str) and kind in own)
    round_one = kind in ("ellipsoid", "delimited")
    names = own[kind] if not round_one else [name for name in own[kind] if name in value]
    need(not round_one or len(names) == 1)
    fields(value, ["kind", *names] + ["velocity"] * moves + ["delimiters"] * (kind == "delimited")
           + ["center"] * (kind == "ball"), ["center"])
    p = vector(value["center"]) if "center" in value else [Fraction(0)] * 3
    if round_one:
        data = matrix(value[names[0]])
        if names[0] == "shape":
            need(data == [list(c) for c in zip(*data)] and definite(data))
        cuts = []
        for cut in array(value["delimiters"]) if kind == "delimited" else ():
            fields(cut, ["matrix", "level"])
            cuts.append((matrix(cut["matrix"]), number(cut["level"])))
            need(cuts[-1][0] == [list(c) for c in zip(*cuts[-1][0])])
        return [Piece(names[0], p, data, cuts)]
    if kind == "ball":
        need(number(value["radius"]) >= 0)
        return [Piece("ball", p, number(value["radius"]))]
    if kind == "box":
        low, high = vector(value["low"]), vector(value["high"])
        need(all(a <= b for a, b in zip(low, high)))
        return [Piece("box", [0, 0, 0], (plus(p, low), plus(p, high)))]
    points = [plus(p, vector(x)) for x in array(value["points"])]
    if kind == "hull":
        return [Piece("hull", p, points)]
    for x in value["points"]:
        need(all(type(c) in (int, float) for c in x))
    found = []
    for three in array(value["triangles"]):
        need(len(array(three)) == 3)
        need(all(whole(k) < len(points) for k in three))
        found.append(Piece("hull", p, [points[k] for k in three]))
    return found


def error_set(value):
    need(isinstance(value, dict) and len(value) == 1)
    (kind, data), zero = *value.items(), [Fraction(0)] * 3
    need(kind in ("ball", "box", "factor"))
    if kind == "ball":
        need(number(data) >= 0)
        return Piece("ball", zero, number(data))
    if kind == "factor":
        return Piece("factor", zero, matrix(data))
    high = vector(data)
    need(min(high) >= 0)
    return Piece("box", zero, ([-x for x in high], high))


class Verdict:
    def __init__(self, a, b, v_a, v_b, t0, t1, by):
        self.a, self.b, self.v_a, self.v_b, self.t0, self.t1, self.by = a, b, v_a, v_b, t0, t1, by
        self.w = plus(v_a, v_b, -1)
        self.all_a, self.all_b, self.cuts, self.errors = list(a), list(b), [], {}

    def part(self, **changes):
        other = object.__new__(Verdict)
        other.__dict__.update(self.__dict__, **changes)
        return other

    def within(self, t):
        return self.t0 <= t and (self.t1 is None or t <= self.t1)


def weights_of(proof, name):
    if name not in proof:
        return None
    found = []
    for pair in array(proof[name]):
        need(len(array(pair)) == 2)
        found.append((whole(pair[0]), number(pair[1])))
    need(len({k for k, _ in found}) == len(found))
    return found


def chosen(proof, name, group, everything):
    need(name in proof or len(everything) == 1)
    k = whole(proof.get(name, 0))
    need(k < len(everything))
    return everything[k] if any(piece is everything[k] for piece in group) else None


PLACES = ["agent_piece", "obstacle_piece", "agent_weights", "obstacle_weights"]


def places(v, proof, t, x, strict):
    true = True
    for who, group, everything, u in (("agent", v.a, v.all_a, v.v_a), ("obstacle", v.b, v.all_b, v.v_b)):
        piece = chosen(proof, f"{who}_piece", group, everything)
        weights = weights_of(proof, f"{who}_weights")
        true = true and piece is not None and piece.has(plus(x, u, -t), strict == who, weights)
    return true


def plane(v, proof):
    bounded = isinstance(proof, dict) and "agent_at_most" in proof
    fields(proof, ["rule"] + [f"{name}_at_most" for name in v.errors], ["n", "across_w", "agent_at_most", "obstacle_at_least"] + [
        "agent_multipliers", "obstacle_multipliers"] * bounded)
    need(bounded or not v.errors)
    errors = {name: number(proof[f"{name}_at_most"]) for name in v.errors}
    need(("n" in proof) != ("across_w" in proof))
    need(("agent_at_most" in proof) == ("obstacle_at_least" in proof))
    if "n" in proof:
        n = vector(proof["n"])
    else:
        need(len(array(proof["across_w"])) == 3)
        k, a, b = whole(proof["across_w"][0]), *map(number, proof["across_w"][1:])
        need(k < 3)
        i, j = (axis for axis in range(3) if axis != k)
        n = [Fraction(0)] * 3
        n[i], n[j], n[k] = a * v.w[k], b * v.w[k], -a * v.w[i] - b * v.w[j]
        if not v.w[k]:
            return False
    o, speed = [-x for x in n], dot(n, v.w)
    ends = [v.t0] + [v.t1] * (v.t1 is not None)
    speed += errors.get("velocity_error", 0)
    endless = v.t1 is not None or speed <= 0
    if "agent_at_most" in proof:
        l, m = number(proof["agent_at_most"]), number(proof["obstacle_at_least"])
        gap = min(m - l - errors.get("position_error", 0) - t * speed for t in ends)
        reached = all(v.errors[name].at_most(n, limit) for name, limit in errors.items())
        for group, who, normal, limit in ((v.a, "agent", n, l), (v.b, "obstacle", o, -m)):
            if f"{who}_multipliers" in proof:
                multipliers = [number(c) for c in array(proof[f"{who}_multipliers"])]
                reached = reached and len(group) == 1 and group[0].at_most_by(normal, limit, multipliers)
            else:
                reached = reached and all(x.at_most(normal, limit) for x in group)
        return (endless and reached and gap > 0 and gap ** 2 > v.by ** 2 * dot(n, n))
    need(v.by == 0)
    true = endless
    for x in v.a:
        for y in v.b:
            (a, qa), (b, qb) = x.middle_bulge(n), y.middle_bulge(o)
            true = true and min(-a - b - t * speed for t in ends) > root(qa, 1) + root(qb, 1)
    return true


def touch(v, proof):
    fields(proof, ["rule", "n", "time", "point"], PLACES)
    n, t, x = vector(proof["n"]), number(proof["time"]), vector(proof["point"])
    true = places(v, proof, t, x, None)
    speed = dot(n, v.w)
    return (true and v.within(t) and any(n) and all(p.at_most(n, dot(n, plus(x, v.v_a, -t))) for p in v.a)
            and all(p.at_most([-c for c in n], -dot(n, plus(x, v.v_b, -t))) for p in v.b)
            and (speed == 0 or (speed > 0 and t == v.t1) or (speed < 0 and t == v.t0)))


def point(v, proof):
    fields(proof, ["rule", "time", "point", "inside"], PLACES)
    need(proof["inside"] in ("agent", "obstacle"))
    t = number(proof["time"])
    return places(v, proof, t, vector(proof["point"]), proof["inside"]) and v.within(t)


def cross(v, proof):
    fields(proof, ["rule", "time", "pairs"], ["agent_piece", "obstacle_piece"])
    t = number(proof["time"])
    a = chosen(proof, "agent_piece", v.a, v.all_a).corners()
    b = chosen(proof, "obstacle_piece", v.b, v.all_b).corners()
    ways, weights = [], []
    for pair in array(proof["pairs"]):
        need(len(array(pair)) == 3)
        i, j = whole(pair[0]), whole(pair[1])
        weights.append(number(pair[2]))
        if i >= len(a) or j >= len(b):
            return False
        ways.append(plus(b[j], a[i], -1))
    zero = [sum(s * (d[i] - t * v.w[i]) for s, d in zip(weights, ways)) for i in range(3)]
    overlap = eliminated([plus(d, ways[0], -1) for d in ways])[1] == 3
    passing = eliminated(ways)[1] == 3 and v.t0 < t and (v.t1 is None or t < v.t1)
    return v.within(t) and all(s > 0 for s in weights) and not any(zero) and (overlap or passing)


def groups(v, proof, says, prove):
    """(whether it holds, whether something touches)."""
    fields(proof, ["rule", "of", "runs", "proofs"])
    need(proof["of"] in ("agent", "obstacle"))
    name = "a" if proof["of"] == "agent" else "b"
    rest, parts = list(getattr(v, name)), [[] for _ in array(proof["proofs"])]
    true = True
    for run in array(proof["runs"]):
        need(len(array(run)) == 2)
        k, count = whole(run[0]), whole(run[1])
        true = true and 1 <= count <= len(rest) and k < len(parts)
        if true:
            parts[k] += rest[:count]
            rest = rest[count:]
    results = [prove(v.part(**{name: part}), sub, says) for part, sub in zip(parts, proof["proofs"])]
    return true and not rest and all(parts) and all(r for r, _ in results), any(t for _, t in results)


def split(v, proof, prove):
    fields(proof, ["rule", "cuts", "proofs"])
    cuts = [number(c) for c in array(proof["cuts"])]
    need(len(array(proof["proofs"])) == len(cuts) + 1)
    ends = [v.t0, *cuts, v.t1]
    results = [prove(v.part(t0=a, t1=b), sub, "out")[0] for a, b, sub in zip(ends, ends[1:], proof["proofs"])]
    return all(results) and all(b is None or a < b for a, b in zip(ends, ends[1:]))


def forms(v, proof):
    fields(proof, ["rule", "agent", "obstacle"], ["products"])
    multipliers = [[number(m) for m in array(proof[who], 0)] for who in ("agent", "obstacle")]
    products = []
    for one in array(proof.get("products", []), 0):
        need(len(array(one)) == 3 and number(one[2]) >= 0)
        products.append((factor(v, one[0]), factor(v, one[1]), number(one[2])))
    if len(v.a) != 1 or len(v.b) != 1 or any(a is None or b is None for a, b, _ in products):
        return False
    sums = []
    for piece, ms, u in ((v.a[0], multipliers[0], v.w), (v.b[0], multipliers[1], [0, 0, 0])):
        its = piece.forms()
        if its is None or len(its) != len(ms) or any(m < 0 for m in ms):
            return False
        sums += [(f, level, m, piece.p, u) for (f, level), m in zip(its, ms)]

    def total(z):
        s, y, t = z[0], z[1:4], z[4] if len(z) == 5 else z[0] * v.t0
        value = sum(m * (f([c - s * p - t * w for c, p, w in zip(y, center, u)]) - level * s * s)
                    for f, level, m, center, u in sums)
        return value - sum(m * a(s, y, t) * b(s, y, t) for a, b, m in products)
    return definite_form(total, 4 if not any(v.w) or v.t0 == v.t1 else 5)


def factor(v, value):
    """A function of (s, y, t), homogeneous; None where there is none."""
    if isinstance(value, str):
        need(value in ("one", "from", "until"))
        if value == "one":
            return lambda s, y, t: s
        if value == "from":
            return lambda s, y, t: t - v.t0 * s
        return None if v.t1 is None else lambda s, y, t: v.t1 * s - t
    need(len(array(value)) == 2 and value[0] in ("agent", "obstacle", "cut"))
    if value[0] == "cut":
        k = whole(value[1])
        if k >= len(v.cuts):
            return None
        a, at, sign = v.cuts[k]
        return lambda s, y, t: sign * (dot(a, y) - at * s)
    a = vector(value[1])
    piece, u = (v.a[0], v.w) if value[0] == "agent" else (v.b[0], [0, 0, 0])
    if not piece.corners():
        return None
    top = max(dot(a, c) for c in piece.corners())
    return lambda s, y, t: top * s - dot(a, plus(y, u, -t))


def halves(v, proof):
    fields(proof, ["rule", "normal", "at", "below", "above"])
    a, at = vector(proof["normal"]), number(proof["at"])
    true = True
    for name, sign in (("below", -1), ("above", 1)):
        sub = proof[name]
        need(isinstance(sub, dict) and isinstance(sub.get("rule"), str))
        its = v.part(cuts=[*v.cuts, (a, at, sign)])
        true = sub["rule"] in ("forms", "halves") and prove(its, sub, "out")[0] and true
    return true


def inside(claim, proof):
    fields(claim, ["says", "agent", "obstacle"], ["id"])
    a, b = body(claim["agent"], False), body(claim["obstacle"], False)
    need(isinstance(proof, dict) and isinstance(proof.get("rule"), str))
    if proof["rule"] != "vertices":
        return False
    fields(proof, ["rule"], ["obstacle_piece"])
    piece = chosen(proof, "obstacle_piece", b, b)
    true = piece.kind != "hull"
    for part in a:
        corners = part.corners()
        true = true and bool(corners) and all(piece.has(x, False, None) for x in corners)
        for m, level in piece.cuts:
            true = true and all(dot(plus(x, piece.p, -1), [dot(row, plus(y, piece.p, -1)) for row in m]) <= level
                                for x in corners for y in corners)
    return true


def meet(claim, proof):
    fields(claim, ["says", "from", "to", "bodies", "tracks", "pair"], ["id"])
    bodies, tracks = [body(b, False) for b in array(claim["bodies"])], [track(t) for t in array(claim["tracks"])]
    start, end = number(claim["from"]), number(claim["to"])
    need(len(bodies) == len(tracks) and len(array(claim["pair"])) == 2)
    i, j = map(whole, claim["pair"])
    need(i < j < len(bodies))
    true = start < end and all(t[0][0] <= start and end <= t[0][-1] for t in tracks)
    true = true and all(a < b for t in tracks for a, b in zip(t[0], t[0][1:]))
    fields(proof, ["rule", "time", "point"], PLACES)
    if proof["rule"] != "point":
        return False
    time, x = number(proof["time"]), vector(proof["point"])
    true = true and start <= time <= end
    for who, k in (("agent", i), ("obstacle", j)):
        piece, weights = chosen(proof, f"{who}_piece", bodies[k], bodies[k]), weights_of(proof, f"{who}_weights")
        its = tracks[k]
        where = [g for g in range(len(its[1])) if its[0][g] <= time <= its[0][g + 1]]
        true = true and its[3] == 0 and bool(where)
        if true:
            g = where[0]
            tau = (time - its[0][g]) / (its[0][g + 1] - its[0][g])
            at = [sum(c * tau ** e for e, c in enumerate(of_bernstein(list(col)))) for col in zip(*its[1][g])]
            q = [[sum(c * tau ** e for e, c in enumerate(of_bernstein(list(col))))] for col in zip(*its[2][g])]
            m, square = turned_back(q, plus(x, at, -1))
            true = square[0] > 0 and piece.has([c[0] / square[0] for c in m], False, weights)
    return true


def prove(v, proof, says):
    need(isinstance(proof, dict) and isinstance(proof.get("rule"), str))
    rule = proof["rule"]
    if v.errors and rule not in ("plane", "groups", "times"):
        return False, False
    need(rule in ("plane", "touch", "point", "cross", "groups", "times", "forms", "halves"))
    if rule in ("forms", "halves"):
        return (forms if rule == "forms" else halves)(v, proof) and says != "in" and v.by == 0, False
    if rule == "groups":
        if says == "in":
            groups(v, proof, says, lambda *_: (False, False))
            return False, False
        return groups(v, proof, says, prove)
    if rule == "touch":
        true = touch(v, proof)
        return true and says == "on", True
    if rule == "plane":
        return plane(v, proof) and says != "in", False
    if rule == "times":
        return split(v, proof, prove) and says != "in", False
    return (point if rule == "point" else cross)(v, proof) and says == "in", False


# Runs: polynomials in tau as (coefficients of powers, degree of the form).

def poly_times(p, q):
    found = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            found[i + j] += x * y
    return found


def poly_sum(*ps):
    size = max(map(len, ps))
    return [sum(p[i] if i < len(p) else 0 for p in ps) for i in range(size)]


def scaled(k, p):
    return [k * x for x in p]


def of_bernstein(bs):
    n, found = len(bs) - 1, [Fraction(0)] * len(bs)
    for k, b in enumerate(bs):
        for j in range(n - k + 1):
            found[k + j] += comb(n, k) * comb(n - k, j) * (-1) ** j * b
    return found


def on_part(p, alpha, beta):
    """p(alpha + (beta - alpha) tau)."""
    found = [Fraction(0)]
    for c in reversed(p):
        found = poly_sum(poly_times(found, [alpha, beta - alpha]), [c])
    return (found + [Fraction(0)] * len(p))[:len(p)]


def form(p):
    n = len(p) - 1
    return [sum(comb(n - j, k - j) * p[j] for j in range(k + 1)) for k in range(n + 1)]


def not_negative(p):
    return all(c >= 0 for c in form(p))


def positive(p):
    f = form(p)
    return all(c >= 0 for c in f) and f[0] > 0 and f[-1] > 0


def turned_back(q, n):
    w, x, y, z = q
    two = lambda a, b: scaled(2, poly_times(a, b))  # noqa: E731
    s = lambda *signs: poly_sum(*(scaled(k, poly_times(a, a)) for k, a in zip(signs, q)))  # noqa: E731
    rows = [[s(1, 1, -1, -1), poly_sum(two(x, y), scaled(-1, two(w, z))), poly_sum(two(x, z), two(w, y))],
            [poly_sum(two(x, y), two(w, z)), s(1, -1, 1, -1), poly_sum(two(y, z), scaled(-1, two(w, x)))],
            [poly_sum(two(x, z), scaled(-1, two(w, y))), poly_sum(two(y, z), two(w, x)), s(1, -1, -1, 1)]]
    return [poly_sum(*(scaled(n[i], rows[i][j]) for i in range(3))) for j in range(3)], s(1, 1, 1, 1)


def reaches(piece, m, limit):
    def along(v):
        return poly_sum(*(scaled(c, f) for c, f in zip(v, m)))
    if piece.kind in ("hull", "box"):
        return all(not_negative(poly_sum(limit, scaled(-1, along(v)))) for v in piece.corners())
    r = poly_sum(limit, scaled(-1, along(piece.p)))
    if piece.kind == "ball":
        shape = [[piece.data ** 2 * (i == j) for j in range(3)] for i in range(3)]
    elif piece.kind == "factor":
        shape = [[dot(a, b) for b in piece.data] for a in piece.data]
    else:
        shape = piece.data
    square = poly_sum(*(scaled(shape[i][j], poly_times(m[i], m[j])) for i in range(3) for j in range(3)))
    return not_negative(r) and not_negative(poly_sum(poly_times(r, r), scaled(-1, square)))


def track(value):
    fields(value, ["times", "positions", "radius"], ["grid", "turns"])
    unit = Fraction(1, 2 ** whole(value.get("grid", 0)))
    need(value.get("grid", 0) <= 1074)
    times = [number(t) for t in array(value["times"], 2)]
    places = [[[unit * c for c in vector(p)] for p in array(g)] for g in array(value["positions"])]
    turns = [[[Fraction(1), 0, 0, 0]] for _ in places]
    if "turns" in value:
        turns = [[[unit * c for c in vector(q, 4)] for q in array(g)] for g in array(value["turns"])]
    need(len(times) - 1 == len(places) == len(turns) and all(len(g) <= 16 for g in places + turns))
    need(number(value["radius"]) >= 0)
    return times, places, turns, number(value["radius"])


def run(claim, proof):
    fields(claim, ["says", "from", "to", "bodies", "tracks", "by", "pairs"], ["id"])
    bodies = [body(b, False) for b in array(claim["bodies"])]
    tracks = [track(t) for t in array(claim["tracks"])]
    start, end, by = number(claim["from"]), number(claim["to"]), number(claim["by"])
    need(len(bodies) == len(tracks) and by >= 0)
    names = []
    for pair in array(claim["pairs"]):
        need(len(array(pair)) == 2 and whole(pair[0]) < whole(pair[1]) < len(bodies))
        names.append(f"{pair[0]} {pair[1]}")
    need(len(set(names)) == len(names))
    true = start < end and all(t[0][0] <= start and end <= t[0][-1] for t in tracks)
    true = true and all(a < b for t in tracks for a, b in zip(t[0], t[0][1:]))
    fields(proof, ["rule", "pairs"])
    need(isinstance(proof["rule"], str))
    if proof["rule"] != "pairs":
        return False
    fields(proof["pairs"], names)
    for (i, j), name in zip(claim["pairs"], names):
        true = pieces(proof["pairs"][name], bodies[i], bodies[j], tracks[i], tracks[j], start, end, by) and true
    return true


def pieces(proof, a, b, track_a, track_b, start, end, by):
    need(isinstance(proof, dict) and isinstance(proof.get("rule"), str))
    if proof["rule"] != "pieces":
        return False
    fields(proof, ["rule", "times", "planes"])
    times = [number(t) for t in array(proof["times"], 2)]
    need(len(array(proof["planes"])) == len(times) - 1)
    true = times[0] == start and times[-1] == end and all(x < y for x, y in zip(times, times[1:]))
    for x, y, one in zip(times, times[1:], proof["planes"]):
        need(len(array(one)) == 4)
        n, length = vector(one[0]), number(one[1])
        limits = [of_bernstein([number(c) for c in array(l)]) for l in one[2:]]
        need(length >= 0 and all(len(l) <= 4 for l in limits))
        true = true and length ** 2 >= dot(n, n)
        gap = [scaled(-length, [by + track_a[3] + track_b[3]])] + [scaled(-1, l) for l in limits]
        for group, its, sign, limit in ((a, track_a, 1, limits[0]), (b, track_b, -1, limits[1])):
            found = [k for k in range(len(its[1])) if its[0][k] <= x and y <= its[0][k + 1]]
            if not found or not true:
                true = False
                continue
            k = found[0]
            span = its[0][k + 1] - its[0][k]
            ends = (x - its[0][k]) / span, (y - its[0][k]) / span
            place = [on_part(of_bernstein(list(c)), *ends) for c in zip(*its[1][k])]
            q = [on_part(of_bernstein(list(c)), *ends) for c in zip(*its[2][k])]
            m, square = turned_back(q, [sign * c for c in n])
            true = true and positive(square) and all(reaches(p, m, poly_times(limit, square)) for p in group)
            gap += [scaled(-sign * c, f) for c, f in zip(n, place)]
        true = true and positive(poly_sum(*gap))
    return true


SAYS = {"out": "out", "in": "in", "on": "on", "disjoint": "out", "overlapping": "in", "touching": "on"}


def decide(line):
    """True or False; None: no certificate."""
    def once(pairs):
        need(len({k for k, _ in pairs}) == len(pairs))
        return dict(pairs)
    try:
        value = json.loads(line, object_pairs_hook=once)
        fields(value, ["format", "version", "claim", "proof"])
        need(value["format"] == "vericone-certificate" and value["version"] == 1 and type(value["version"]) is int)
        claim, proof = value["claim"], value["proof"]
        need(isinstance(claim, dict))
        says = claim.get("says")
        if says in ("apart", "inside", "meet"):
            return {"apart": run, "inside": inside, "meet": meet}[says](claim, proof)
        need(isinstance(says, str) and says in SAYS)
        moves = says in ("out", "in", "on")
        fields(claim, ["says", "agent", "obstacle"] + ["horizon"] * moves, ["id"] + ["by"] * (SAYS[says] == "out")
               + ["position_error", "velocity_error"] * (says == "out"))
        need(isinstance(claim.get("id", ""), (str, int, float)) and not isinstance(claim.get("id"), bool))
        a, b = body(claim["agent"], moves), body(claim["obstacle"], moves)
        v_a, v_b = ([vector(claim[who]["velocity"]) if moves else [Fraction(0)] * 3 for who in ("agent", "obstacle")])
        horizon = claim["horizon"] if moves else 0
        t0, t1 = horizon if isinstance(horizon, list) and len(horizon) == 2 else (0, horizon)
        t0, t1 = number(t0), None if t1 is None else number(t1)
        need(0 <= t0 and (t1 is None or t0 <= t1))
        by = number(claim.get("by", 0))
        need(by >= 0)
        v = Verdict(a, b, v_a, v_b, t0, t1, by)
        v.errors = {name: error_set(claim[name]) for name in ("position_error", "velocity_error") if name in claim}
        true, touches = prove(v, proof, SAYS[says])
        return true and (touches or SAYS[says] != "on")
    except (Malformed, ValueError, RecursionError):
        return None
