# SPDX-License-Identifier: BSD-3-Clause
"""Decides verdicts exactly, in fractions, by other ways than the checker and the library: what is true.

Two ellipsoids: by the signs and the number of positive roots (Sturm) of the contact polynomial, of the bodies and of
their shadows. All else that is convex: by the point nearest to the origin (Wolfe) of a polytope with a ray."""
from fractions import Fraction
from itertools import combinations


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def scale(a, k):
    return [x * k for x in a]


def apply(m, x):
    return [dot(row, x) for row in m]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def solve(rows, right):
    """x with rows x = right, or None where the rows are dependent."""
    rows = [[Fraction(x) for x in row] + [Fraction(y)] for row, y in zip(rows, right)]
    n = len(rows)
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k and rows[i][k]:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k])]
    return [row[-1] for row in rows]


# Polynomials, lowest coefficient first.

def trimmed(p):
    p = list(p)
    while p and not p[-1]:
        p.pop()
    return p


def times(p, q):
    out = [Fraction(0)] * max(0, len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            out[i + j] += x * y
    return out


def added(p, q, k=1):
    size = max(len(p), len(q))
    return [(p[i] if i < len(p) else 0) + k * (q[i] if i < len(q) else 0) for i in range(size)]


def value(p, x):
    out = Fraction(0)
    for c in reversed(p):
        out = out * x + c
    return out


def divided(p, q):
    p, q, quotient = trimmed(p), trimmed(q), [Fraction(0)] * max(1, len(p) - len(q) + 1)
    while len(p) >= len(q):
        k = p[-1] / q[-1]
        shift = len(p) - len(q)
        quotient[shift] = k
        p = trimmed(added(p, [Fraction(0)] * shift + q, -k)[:len(p) - 1])
    return trimmed(quotient), p


def derived(p):
    return [k * c for k, c in enumerate(p)][1:]


def common(p, q):
    p, q = trimmed(p), trimmed(q)
    while q:
        p, q = q, divided(p, q)[1]
    return scale(p, 1 / p[-1])


def chain_of(p):
    chain = [trimmed(p), trimmed(derived(p))]
    while len(chain[-1]) > 1:
        chain.append(trimmed(scale(divided(chain[-2], chain[-1])[1], -1)))
    return [q for q in chain if q]


def changes(signs):
    signs = [s for s in signs if s]
    return sum((a > 0) != (b > 0) for a, b in zip(signs, signs[1:]))


def positive_roots(p, below=None):
    """The number of distinct ones, with p(0) != 0; up to `below`, if given."""
    chain = chain_of(p)
    end = [q[-1] for q in chain] if below is None else [value(q, below) for q in chain]
    return changes([q[0] for q in chain]) - changes(end)


def parts(p):
    """p = p_1 p_2^2 p_3^3 ...: [p_1, p_2, ...] (Yun)."""
    found, a = [], trimmed(p)
    b = derived(a)
    c = common(a, b)
    w = divided(a, c)[0]
    while len(c) > 1 or len(w) > 1:
        y = common(w, c)
        found.append(divided(w, y)[0])
        w, c = y, divided(c, y)[0]
        if len(w) == 1 and len(c) == 1:
            break
    return found


def sign_above(p):
    """Of the largest value of p over x > 0, where p(0) < 0 and p < 0 far out: 1, 0 or -1."""
    odd = even = 0
    for multiplicity, part in enumerate(parts(p), 1):
        if len(part) > 1:
            count = positive_roots(part)
            odd, even = (odd + count, even) if multiplicity % 2 else (odd, even + count)
    return 1 if odd else 0 if even else -1


def polynomial_matrix(a, b):
    return [[[x, y] for x, y in zip(ra, rb)] for ra, rb in zip(a, b)]


def det(m):
    if len(m) == 1:
        return m[0][0]
    if len(m) == 2:
        return added(times(m[0][0], m[1][1]), times(m[0][1], m[1][0]), -1)
    out = []
    for j in range(3):
        minor = [[row[k] for k in range(3) if k != j] for row in m[1:]]
        out = added(out, times(m[0][j], det(minor)), (-1) ** j)
    return out


def adj(m):
    n = len(m)
    if n == 2:
        return [[m[1][1], scale(m[0][1], -1)], [scale(m[1][0], -1), m[0][0]]]

    def minor(i, j):
        return det([[m[r][s] for s in range(n) if s != j] for r in range(n) if r != i])
    return [[scale(minor(j, i), (-1) ** (i + j)) for j in range(n)] for i in range(n)]


def contact(sa, sb, d):
    """x d adj(S_A + x S_B) d - (1 + x) det(S_A + x S_B): above 0 for some x > 0 iff the bodies about 0 and d are apart."""
    m = polynomial_matrix(sa, sb)
    q = []
    for i, row in enumerate(adj(m)):
        for j, p in enumerate(row):
            q = added(q, scale(p, d[i] * d[j]))
    return trimmed(added(times([0, 1], q), times([1, 1], det(m)), -1))


def at_rest(sa, sb, c):
    """1 apart, 0 touching, -1 overlapping."""
    return sign_above(contact(sa, sb, c))


def shadow(sa, sb, c, w):
    """The same of the shadows along w != 0, and the rows that make them."""
    k = next(i for i in range(len(w)) if w[i])
    if len(w) == 2:
        rows = [[-w[1], w[0]]]
    else:
        i, j = [i for i in range(3) if i != k]
        rows = []
        for axis in (i, j):
            row = [Fraction(0)] * 3
            row[axis], row[k] = w[k], -w[axis]
            rows.append(row)
    ma, mb = ([[dot(r, apply(s, q)) for q in rows] for r in rows] for s in (sa, sb))
    d = apply(rows, c)
    if len(d) == 1:  # |d| against the sum of two roots
        g = d[0] ** 2 - ma[0][0] - mb[0][0]
        f = g * g - 4 * ma[0][0] * mb[0][0]
        return (1 if g > 0 and f > 0 else 0 if g > 0 and f == 0 else -1)
    return sign_above(contact(ma, mb, d))


def normal(sa, sb, c):
    """A normal that parts, or where they touch supports, bodies that do not overlap: n.c > 0."""
    p = contact(sa, sb, c)
    if sign_above(p) == 1:
        x = parting(p)
    else:  # rational double root of each even part (there is one)
        x = next(r for k, part in enumerate(parts(p), 1) if k % 2 == 0 for r in positive_rational(part))
    return solve([[a + x * b for a, b in zip(ra, rb)] for ra, rb in zip(sa, sb)], c)


def positive_rational(part):
    """Of linear and quadratic ones."""
    part = trimmed(part)
    if len(part) == 2:
        roots = [-part[0] / part[1]]
    else:
        d = part[1] ** 2 - 4 * part[0] * part[2]
        root = Fraction(isqrt_exact(d.numerator), isqrt_exact(d.denominator))
        roots = [(-part[1] + s * root) / (2 * part[2]) for s in (1, -1)]
    return [r for r in roots if r > 0]


def isqrt_exact(n):
    from math import isqrt
    assert isqrt(n) ** 2 == n
    return isqrt(n)


def parting(p):
    """x > 0 with p(x) > 0, which is between the two positive roots."""
    low, high = Fraction(0), Fraction(1)
    while positive_roots(p, high) == 0:
        high *= 2
    while True:
        x = (low + high) / 2
        if value(p, x) > 0:
            return x
        low, high = (x, high) if positive_roots(p, x) == 0 else (low, x)


def ellipsoids(sa, sb, c, w, horizon):
    """'out', 'on' or 'in' of motion within [0, T] (T None: for ever); w may be 0."""
    now = at_rest(sa, sb, c)
    if now < 0:
        return "in"
    if not any(w) or horizon == 0:
        return "on" if now == 0 else "out"
    n = normal(sa, sb, c)
    if now == 0:  # n supports: do they go into each other?
        return "in" if dot(n, w) > 0 else "on"
    line = shadow(sa, sb, c, w)
    if line > 0 or dot(n, w) <= 0:
        return "out"
    ahead = "on" if line == 0 else "in"
    if horizon is None:
        return ahead
    c_end = sub(c, scale(w, horizon))
    end = at_rest(sa, sb, c_end)
    if end < 0:
        return "in"
    n = normal(sa, sb, c_end)
    going_in = dot(n, w) > 0
    if end == 0:
        return "on" if going_in or line == 0 else "in"
    if line == 0:  # one touch: at which side of the end?
        return "out" if going_in else "on"
    return "out" if going_in else "in"


# Polytopes.

def nearest(points):
    """The point of their hull that is nearest to the origin (Wolfe's algorithm)."""
    best = min(points, key=lambda p: dot(p, p))
    active, weights = [best], [Fraction(1)]
    while True:
        x = [dot(weights, column) for column in zip(*active)]
        new = min(points, key=lambda p: dot(p, x))
        if dot(new, x) >= dot(x, x) or new in active:
            return x
        active.append(new)
        weights.append(Fraction(0))
        while True:
            size = len(active)
            rows = [[dot(a, b) for b in active] + [1] for a in active] + [[1] * size + [0]]
            found = solve(rows, [0] * size + [1])
            if found is None:  # affinely dependent: drop what can be dropped
                active, weights = reduced(active, weights)
                continue
            target = found[:-1]
            if all(t > 0 for t in target):
                weights = target
                break
            step = min((a / (a - t) for a, t in zip(weights, target) if t <= 0 and a != t), default=Fraction(0))
            weights = [a + step * (t - a) for a, t in zip(weights, target)]
            kept = [(p, a) for p, a in zip(active, weights) if a > 0]
            active, weights = [p for p, _ in kept], [a for _, a in kept]


def reduced(active, weights):
    """The same point by fewer, affinely independent ones."""
    for k in range(2, len(active) + 1):
        for some in combinations(range(len(active)), k):
            base = active[some[0]]
            rows = [sub(active[i], base) for i in some[1:]]
            gram = [[dot(a, b) for b in rows] for a in rows]
            if solve(gram, [0] * len(rows)) is None:
                direction = null(rows)
                change = [Fraction(0)] * len(active)
                for i, d in zip(some[1:], direction):
                    change[i] = d
                change[some[0]] = -sum(direction)
                for sign in (1, -1):
                    steps = [w / (-sign * d) for w, d in zip(weights, change) if sign * d < 0]
                    if steps:
                        step = min(steps)
                        new = [w + step * sign * d for w, d in zip(weights, change)]
                        kept = [(p, a) for p, a in zip(active, new) if a > 0]
                        return [p for p, _ in kept], [a for _, a in kept]
    raise AssertionError("independent")


def null(rows):
    """k, not 0, with sum k_i rows_i = 0, of dependent rows."""
    for i in range(len(rows)):
        before = rows[:i]
        if not before:
            if not any(rows[0]):
                return [Fraction(1)] + [Fraction(0)] * (len(rows) - 1)
            continue
        gram = [[dot(a, b) for b in before] for a in before]
        k = solve(gram, [dot(a, rows[i]) for a in before])
        if k is None:
            continue
        rest = sub(rows[i], [dot(k, column) for column in zip(*before)])
        if not any(rest):
            return [-x for x in k] + [Fraction(1)] + [Fraction(0)] * (len(rows) - i - 1)
    raise AssertionError("independent")


def distance2(points, way):
    """The square of the distance of the origin from the hull of points + t way, t >= 0 (way 0: none)."""
    x = nearest(points)
    if any(way) and dot(x, way) < 0:
        across = [sub(p, scale(way, dot(p, way) / dot(way, way))) for p in points]
        x = nearest(across)
    return dot(x, x)


def interior(points, way):
    """Whether the origin is in the interior of that set: by all planes through three generators, made homogeneous."""
    rays = [p + [Fraction(1)] for p in points] + ([list(way) + [Fraction(0)]] if any(way) else [])
    size = len(rays[0])
    target = [Fraction(0)] * (size - 1) + [Fraction(1)]
    if solve([[sum(r[i] * r[j] for r in rays) for j in range(size)] for i in range(size)], [0] * size) is None:
        return False
    for some in combinations(rays, size - 1):
        n = perpendicular(some)
        if not any(n):
            continue
        values = [dot(n, r) for r in rays]
        if all(v >= 0 for v in values) and dot(n, target) <= 0 or all(v <= 0 for v in values) and dot(n, target) >= 0:
            return False
    return True


def perpendicular(rows):
    """The vector of minors."""
    size = len(rows[0])
    out = []
    for j in range(size):
        minor = [[[row[k]] for k in range(size) if k != j] for row in rows]
        out.append((-1) ** j * (determinant([[x[0] for x in row] for row in minor])))
    return out


def determinant(m):
    if len(m) == 1:
        return m[0][0]
    return sum((-1) ** j * m[0][j] * determinant([row[:j] + row[j + 1:] for row in m[1:]]) for j in range(len(m)))


def polytopes(a, b, w, horizon):
    """'out', 'in' or 'on' of the hulls of points a and b."""
    differences = [sub(y, x) for x in a for y in b]
    generators, way = swept(differences, w, horizon)
    if distance2(generators, way) > 0:
        return "out"
    return "in" if interior(generators, way) else "on"


def swept(differences, w, horizon):
    """The hull of d - t w for 0 <= t <= T, as points and a way."""
    if horizon is None:
        return differences, scale(w, -1)
    return differences + [sub(d, scale(w, horizon)) for d in differences], [Fraction(0)] * len(w)


def ball_image(factor, center, points, w, horizon):
    """'out', 'in', 'on' of { center + F u } and a hull, w of the ellipsoid against the hull; F invertible."""
    image = [solve(factor, sub(p, center)) for p in points]
    generators, way = swept(image, solve(factor, w), horizon)
    d2 = distance2(generators, way)
    return "out" if d2 > 1 else "on" if d2 == 1 else "in"
