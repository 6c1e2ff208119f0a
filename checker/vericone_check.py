#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks certificates of collisions and of their absence: docs/reference/certificates.md has the format.

A file is one certificate, or one a line. Printed is what is proved, from what was read, or the first
inequality that does not hold. Exit status: 0 all accepted, 1 one is refused, 2 one is no certificate (and
none is refused). Python 3.10 or later, nothing else; all is computed with fractions and integers. What is
proved is of a `Motion`, read from the claim alone; a proof is a list of numbers that are tried on it."""
import argparse
import hashlib
import json
import re
import sys
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from itertools import accumulate
from math import comb, isqrt, lcm
from types import SimpleNamespace

class Malformed(Exception): """Not a certificate of this format."""
class Refused(Exception): """A certificate that does not prove its claim."""
FAULTS = (Malformed, ValueError, RecursionError, MemoryError)
def holds(true, inequality, fault=Refused):
    if not true:
        raise fault(inequality)
def form(true, complaint, value=None): return holds(true, complaint, Malformed) or value

# Numbers and fields. A reader takes a JSON value and returns what it means.

ZERO, HALF, ONE, LONGEST = Fraction(0), Fraction(1, 2), Fraction(1), 4300  # characters of a number

def double(text):
    """What a JSON number means: the nearest double, which must be finite."""
    form(len(text) <= LONGEST and abs(float(text)) <= sys.float_info.max, f"{text[:20]} is no finite double")
    return float(text) if re.search("[.eE]", text) else int(float(text))
def once(pairs):
    return form(len({name for name, _ in pairs}) == len(pairs), "a field twice", dict(pairs))
def parsed(text):
    return json.loads(text, parse_float=double, parse_int=double, parse_constant=double,
                      object_pairs_hook=once)

def number(value):
    form(type(value) in (int, float, Fraction) or type(value) is str and len(value) <= LONGEST
         and re.fullmatch("-?[0-9]+(/0*[1-9][0-9]*)?", value, re.A), "no number, or a denominator of 0")
    return Fraction(value)
def positive(value): return form(number(value) >= 0, "a number below 0", number(value))
def index(value, count, what):
    return form(type(value) is int and 0 <= value < count, f"{what} is an integer, 0 to {count - 1}", value)
def text(value): return form(type(value) is str, "a text is missing", value)
def items(value, least=1, most=None):
    form(type(value) is list and least <= len(value) <= (most or len(value)), f"a list of {least} to {most}")
    return value
def several(reader=lambda value: value, least=1, most=None):
    return lambda value: [reader(x) for x in items(value, least, most)]
def vector(value, size=3): return V(map(number, items(value, size, size)))
def matrix(value, size=3): return [vector(row, size) for row in items(value, size, size)]
def symmetric(value, size=3):
    return form(matrix(value, size) == transposed(matrix(value, size)), "not symmetric", matrix(value, size))
def horizon(value):
    start, end = items(value, 2, 2) if type(value) is list else (0, value)
    form(end is None or number(end) >= number(start), "a horizon that ends before it starts")
    return positive(start), None if end is None else number(end)
def errors(value):
    form(type(value) is dict and len(value) == 1, "a set of errors is one of ball, box, factor")
    return SimpleNamespace(**vars(fields(value, "a set of errors", "", "ball box factor")), shape=None)

def fields(value, what, needed, allowed=""):
    """The fields that are needed and those that are allowed (None if left out), each through its reader."""
    needed, allowed = needed.split(), allowed.split()
    form(type(value) is dict and all(name in value for name in needed), f"{what} has {needed}")
    for name in value:
        form(name in needed or name in allowed, f"{what}: unknown field {name[:40]!r}")
        form(value[name] is not None or name == "horizon", f"{what}: {name} is null")
    return SimpleNamespace(**{name: READERS.get(name, lambda x: x)(value[name]) if name in value else None
                              for name in needed + allowed})

# Algebra. Vectors and matrices (lists of rows) are of numbers, or of forms.

class V(tuple):
    def __str__(self): return f"({', '.join(map(str, self))})"
    def __add__(self, other): return V(x + y for x, y in zip(self, other))
    def __radd__(self, zero): return self  # as sum() begins
    def __sub__(self, other): return V(x - y for x, y in zip(self, other))
    def __mul__(self, factor): return V(x * factor for x in self)
    def __neg__(self): return V(-x for x in self)
    def __matmul__(self, other): return sum(x * y for x, y in zip(self, other))

class Form:
    """A polynomial on a piece of time: the sum of c_k sigma^(N-k) tau^k / scale, with integers c_0, ..., c_N;
    tau goes from 0 to 1 and sigma = 1 - tau. So it is not negative if no c_k is."""
    def __init__(self, numbers, scale=1):
        common = lcm(*(x.denominator for x in numbers))
        self.c, self.scale = [x.numerator * (common // x.denominator) for x in numbers], scale * common
    def __add__(self, other):
        columns, scale = table([self, other])
        return Form([x + y for x, y in columns], scale)
    def __mul__(self, other):
        other = other if type(other) is Form else Form([other])
        return Form(convolved(self.c, other.c), self.scale * other.scale)
    def __neg__(self): return self * -1
    def __sub__(self, other): return self + -other
    __radd__, __rmul__ = __add__, __mul__
    def part(self, start, end):
        """The same polynomial on the part of the piece from start to end."""
        sigma, tau = Form([1 - start, 1 - end]), Form([start, end])
        found, power = Form(self.c[:1]), tau
        for x in self.c[1:]:
            found, power = found * sigma + power * x, power * tau
        return found * Fraction(1, self.scale)
    def start(self): return Fraction(self.c[0], self.scale)
    def not_negative(self): return all(x >= 0 for x in self.c)
    def positive(self): return self.not_negative() and self.c[0] > 0 and self.c[-1] > 0

def convolved(a, b):
    found = [0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            found[i + j] += x * y
    return found
def bernstein(values): return Form([comb(len(values) - 1, k) * x for k, x in enumerate(values)])
def table(forms):
    """(for each k the c_k of all, raised to one size by (sigma + tau)^m, on one scale; that scale)."""
    forms = [x if type(x) is Form else Form([x]) for x in forms]
    scale, size = lcm(*(x.scale for x in forms)), max(len(x.c) for x in forms)
    raised = (convolved([c * (scale // x.scale) for c in x.c],
                        [comb(size - len(x.c), k) for k in range(size - len(x.c) + 1)]) for x in forms)
    return [V(column) for column in zip(*raised)], scale

def transposed(rows): return [V(column) for column in zip(*rows)]
def through(rows, x): return V(row @ x for row in rows)
def unit(size): return [V(ONE if i == j else ZERO for j in range(size)) for i in range(size)]
def flat(rows): return [x for row in rows for x in row]
def bordered(rows, side, corner): return [*(V((*row, x)) for row, x in zip(rows, side)), V((*side, corner))]
E, O = unit(3), V([ZERO] * 3)
def cross_product(a, b): return V(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))
def inverse(rows):
    """Of a symmetric matrix by elimination, if it is positive definite (all pivots are above 0), or None."""
    size = len(rows)
    rows = [V((*map(Fraction, row), *one)) for row, one in zip(rows, unit(size))]
    for k in range(size):
        if rows[k][k] <= 0:
            return None
        rows[k] = rows[k] * (1 / rows[k][k])
        rows = [row if i == k else row - rows[k] * row[k] for i, row in enumerate(rows)]
    return [V(row[size:]) for row in rows]
def definite(rows):
    """A symmetric matrix of forms, for all tau: of each k the matrix of c_k is positive definite."""
    size, (columns, _) = len(rows), table(flat(rows))
    return all(inverse([c[i:i + size] for i in range(0, size * size, size)]) for c in columns)
def weighted(matrices, multipliers):
    """Their sum with these multipliers."""
    form(len(multipliers) == len(matrices), f"{len(matrices)} multipliers are needed")
    holds(all(number(x) >= 0 for x in multipliers), "multipliers >= 0")
    return [sum(row * number(x) for x, row in zip(multipliers, rows)) for rows in zip(*matrices)]
def root_above(q):
    """Not below sqrt(q), and so little above that a sum of two such roots is told from any other number."""
    shift = 64 + 8 * (q.numerator.bit_length() + q.denominator.bit_length())
    return Fraction(isqrt((q.numerator << 2 * shift) // q.denominator) + 1, 1 << shift) if q else q
def turned(q, n):
    """N(q) n and q.q, of forms or numbers: R = N(q) / q.q is the rotation of q, of none that of 1."""
    if not q:
        return n, ONE
    w, u = q[0], V(q[1:])
    return n * (w * w - u @ u) + u * (u @ n * 2) + cross_product(u, n) * (w * 2), w * w + u @ u
def back(q): return q and V((q[0], *-V(q[1:])))
def rotated(q, x):
    x, square = turned(q, x)
    return x * (1 / square)

# Bodies. A piece is the hull of some points, with what its skin puts about each.

@dataclass(eq=False)
class Skin:
    """About a point p the ellipsoid { p + S m : m.S m <= 1 }, or the box of these half edges, or p alone; and
    all within `margin` of it. Of that the points where X^T C X <= 0, X = (x - p, 1), for each C of `cuts`;
    these alone, of all of space, if there is no S."""
    shape: list = None
    half: tuple = ()
    margin: Fraction = ZERO
    cuts: tuple = ()

    @cached_property
    def forms(self):
        """The matrices H of its points x, X^T H X <= 0 for each; of what has not both an S and a margin."""
        if self.half:
            return [bordered([e * x for x in e], O, -h * h) for e, h in zip(E, self.half)]
        own = inverse(self.shape) if self.shape else E
        holds(own, "det S > 0: the body is not flat")
        around = bordered(own, O, -ONE if self.shape else -self.margin ** 2)
        return [*([around] if self.shape or not self.cuts else []), *self.cuts]
    def squares(self, n):
        """Of the roots that it adds to n.p, where it is the farthest along n; a box adds no root, but:"""
        own = [n @ through(self.shape, n)] if self.shape else []
        return own + ([n @ n * self.margin ** 2] if self.margin else [])
    def straight(self, n): return sum(abs(x) * h for x, h in zip(n, self.half))

POINT, box_about = Skin(), cache(lambda half: Skin(half=half))

@dataclass
class Body:
    """Points row / scale, of integers; of each piece the (skin, number of a point), whose hull it is."""
    scale: int
    rows: list
    pieces: list
    read: object = None  # the fields that it is made of

    def moved(self, by):
        scale = lcm(self.scale, *(x.denominator for x in by))
        by, factor = V(int(x * scale) for x in by), scale // self.scale
        short([scale, *by], self.rows)
        return replace(self, scale=scale, rows=[row * factor + by for row in self.rows])
    def points(self, k): return [self.rows[i] * Fraction(1, self.scale) for _, i in self.pieces[k]]
    def forms(self, k):
        """As Skin.forms, of a piece about its point."""
        (skin, _), *others = self.pieces[k]
        form(not others and not (skin.shape and skin.margin), f"weights of piece {k} are missing")
        return skin.forms
    def corners(self, k):
        """(corner or centre, S or None) of which, but for its margin, a piece without dents is the hull."""
        form(not any(skin.cuts for skin, _ in self.pieces[k]), f"piece {k} has dents")
        return [(p + V(h if bits >> i & 1 else -h for i, h in enumerate(skin.half or O)), skin.shape)
                for p, (skin, _) in zip(self.points(k), self.pieces[k])
                for bits in range(1 << len(skin.half))]

def short(numbers, points):
    form(max(x.bit_length() for x in numbers) * (3000 + len(points)) < 6 * 10 ** 7, "a denominator too long")
def body_of(points, pieces):
    scale = 1
    for x in {x.denominator for row in points for x in row}:
        short([scale := lcm(scale, x)], points)
    return Body(scale, [V(x.numerator * (scale // x.denominator) for x in row) for row in points], pieces)
def hulls(points, pieces): return body_of(points, [[(POINT, i) for i in piece] for piece in pieces])
def single(points, skins): return body_of(points, [[(skin, k)] for k, skin in enumerate(skins)])
def balls(points, radius): return single(points, [Skin(margin=radius)] * len(points))
def boxes(ends):
    form(all(x >= 0 for low, high in ends for x in high - low), "a box with low > high")
    return single([(low + high) * HALF for low, high in ends],
                  [box_about((high - low) * HALF) for low, high in ends])
def shape_of(read):
    form((read.factor is None) != (read.shape is None), "an ellipsoid has either factor or shape")
    form(read.factor or inverse(read.shape), "a shape that is not positive definite")
    return [through(read.factor, row) for row in read.factor] if read.factor else read.shape
def ellipsoid(read):
    cuts = tuple(bordered(cut.matrix, O, -cut.level) for cut in getattr(read, "delimiters", ()))
    return single([O], [Skin(shape_of(read), cuts=cuts)])
def quadrics(read): return single([O], [Skin(cuts=tuple(read.matrices))])
def convex(read):
    skins = [Skin(shape_of(part) if part.factor or part.shape else None, margin=read.margin or ZERO)
             for part in read.parts]
    return body_of([part.center for part in read.parts], [[(skin, k) for k, skin in enumerate(skins)]])
def mesh(read):
    return hulls(read.points, [[index(i, len(read.points), "a triangle's point") for i in three]
                               for three in read.triangles])
def wall(read):
    """A flat ring about a hole that is star-shaped about the origin, in quadrangles."""
    rim, count = [V((*v, ZERO)) for v in read.outline], len(read.outline)
    edges = list(zip(rim, rim[1:] + rim[:1]))
    form(read.extent > 1 and all(cross_product(a, b)[2] > 0 for a, b in edges)
         and sum(a[1] < 0 <= b[1] for a, b in edges) == 1,
         "an outline goes round the origin once, counterclockwise, extent > 1")
    return hulls(rim + [v * read.extent for v in rim],
                 [(k, (k + 1) % count, count + (k + 1) % count, count + k) for k in range(count)])
def union(read):
    form(all(part.read.kind in PARTS and not part.read.velocity for part in read.pieces),
         f"a union is of {', '.join(PARTS)}")
    firsts = accumulate((len(part.rows) for part in read.pieces), initial=0)
    return body_of([row * Fraction(1, part.scale) for part in read.pieces for row in part.rows],
                   [[(skin, first + i) for skin, i in piece]
                    for first, part in zip(firsts, read.pieces) for piece in part.pieces])
def octree(read):
    """A node is eight characters, of its cell's eighths; the nodes of its `+` follow it in their order. In
    integers: twice the corners, so that the centres of cells are some."""
    form(set(read.tree) <= set(".#+") and len(read.tree) % 8 == 0, "nodes are eight of .#+ each")
    scale, found = 2 * lcm(read.cell.denominator, *(x.denominator for x in read.low)), []
    cell, blocks = int(read.cell * scale), (read.tree[k:k + 8] for k in range(0, len(read.tree), 8))
    skin = cache(lambda edge: Skin(half=V([Fraction(edge, 2 * scale)] * 3)))
    def node(low, edge):
        block = next(blocks, None)
        form(block and edge >= cell > 0, "each + has a node, and none has cells below the smallest")
        for bits, what in enumerate(block):
            at = [x + edge * (bits >> i & 1) for i, x in enumerate(low)]
            if what == "+":
                node(at, edge // 2)
            elif what == "#":
                found.append((V(x + edge // 2 for x in at), skin(edge)))
    node([int(x * scale) for x in read.low], cell << index(read.depth, 64, "depth"))
    form(found and next(blocks, None) is None, "an octree has cells, and no node too many")
    return Body(scale, [x for x, _ in found], [[(its, k)] for k, (_, its) in enumerate(found)])

KINDS = {  # fields needed, fields allowed, and the body of what was read
    "ellipsoid": ("", "factor shape", ellipsoid), "delimited": ("delimiters", "factor shape", ellipsoid),
    "ball": ("center radius", "", lambda read: balls([O], read.radius)),
    "cloud": ("points radius", "", lambda read: balls(read.points, read.radius)),
    "hull": ("points", "", lambda read: hulls(read.points, [range(len(read.points))])),
    "box": ("low high", "", lambda read: boxes([(read.low, read.high)])), "union": ("pieces", "", union),
    "boxes": ("boxes", "", lambda read: boxes(read.boxes)), "octree": ("low cell depth tree", "", octree),
    "convex": ("parts", "margin", convex), "wall": ("outline extent", "", wall),
    "mesh": ("points triangles", "", mesh), "quadrics": ("matrices", "", quadrics)}
PARTS = ("ellipsoid", "ball", "hull", "box", "convex", "delimited", "quadrics")  # of a union

def body(value):
    kind = value.get("kind") if type(value) is dict else None
    form(type(kind) is str and kind in KINDS, f"a body's kind must be one of {', '.join(KINDS)}")
    needed, allowed, make = KINDS[kind]
    read = fields(value, f"a body of the kind {kind}", f"kind {needed}", f"center velocity {allowed}")
    found = make(read).moved(read.center or O)
    found.read = read
    return found

# Claims.

def clock(start, end):
    """t and 1 as forms; both times sigma where there is no end: t = start + tau / sigma."""
    return (Form([start, ONE]), Form([ONE, ZERO])) if end is None else (Form([start, end]), Form([ONE]))

@dataclass
class Side:
    """Agent, obstacle or set of errors: a body, the pieces of it that are meant, its velocity or track."""
    who: str
    body: Body
    group: object
    v: object = None
    track: object = None

    def placed(self, start, end, after=None):
        """(P, a multiple of q or none) from start to end, as forms; of segments that end after that time."""
        its = self.track
        if not its:
            return V(x * clock(start, end)[0] for x in self.v), None
        after, segments = start if after is None else after, enumerate(zip(its.times, its.times[1:]))
        k = next((k for k, (a, b) in segments if a <= start and end <= b > after), None)
        holds(k is not None, f"the piece from {start} to {end} is in one segment of the track")
        part = [(t - its.times[k]) / (its.times[k + 1] - its.times[k]) for t in (start, end)]
        place, q = (V(bernstein(column).part(*part) for column in zip(*points))
                    for points in (its.positions[k], its.turns[k] if its.turns else ()))
        return place * Fraction(1, 1 << its.grid), q
    def instant(self, t, after):
        """placed() at a time, as numbers."""
        place, q = (forms and V(a.start() for a in forms) for forms in self.placed(t, t, after))
        holds(not q or q @ q > 0, f"{self.who}: q.q > 0")
        return place, q
    @cached_property
    def points(self):
        """Of each skin the numbers of the points that have it."""
        found = {}
        for skin, i in (both for k in self.group for both in self.body.pieces[k]):
            found.setdefault(skin, set()).add(i)
        return found
    def tops(self, n):
        """Of each skin the largest n.x of the points and boxes, of integers n; times the body's scale."""
        rows, scale = self.body.rows, self.body.scale
        return {skin: max(n @ rows[i] for i in its) + scale * skin.straight(n)
                for skin, its in self.points.items()}
    def reach(self, n):
        """Not below n.x in these pieces."""
        (m,), scale = table(n)
        return max(Fraction(top, scale * self.body.scale) + sum(map(root_above, skin.squares(n)))
                   for skin, top in self.tops(m).items())
    def at_most(self, n, most, multipliers=None, q=None, when=""):
        """n.R x <= most for the points x of these pieces, R the rotation of q, if any; all may be forms."""
        n, square = turned(back(q), n)
        holds(not q or square.positive(), f"{self.who}: q.q is positive{when}")
        columns, scale = table([*n, square * most])
        tops, own = [self.tops(V(column[:-1])) for column in columns], self.body.scale
        for skin in self.points:
            r = Form([column[-1] * own - top[skin] for column, top in zip(columns, tops)], scale * own)
            holds(r.not_negative(), f"{self.who}: r = l q.q - n.N(q) p is not negative{when}")
            if multipliers is not None:
                form(len(self.group) == 1, f"{self.who}: multipliers are of one round piece")
                rows = weighted(self.body.forms(self.group[0]), multipliers)
                holds(rows[-1][-1] < 0, f"{self.who}: L > 0")
                holds(definite(bordered([row[:-1] for row in rows[:-1]], n, r * r * (-1 / rows[-1][-1]))),
                      f"{self.who}: [[Q, n], [n, r^2 / L]] is positive definite{when}")
                continue
            squares = skin.squares(n)
            rest = r * r - sum(squares)
            holds(not squares or rest.not_negative(), f"{self.who}: r^2 - n.S n is not negative{when}")
            holds(len(squares) < 2 or (rest * rest - squares[0] * squares[1] * 4).not_negative(),
                  f"{self.who}: r is not below both roots{when}")
    def within(self, most):
        """No point of these pieces is farther than that from the origin."""
        for skin, i in ((skin, i) for skin, its in self.points.items() for i in its):
            far = V(abs(x) for x in self.body.rows[i]) * Fraction(1, self.body.scale)
            far += skin.half or O
            rest = most - skin.margin - root_above(far @ far)
            wide = skin.shape and [e * rest ** 2 - row for e, row in zip(E, skin.shape)]
            holds(rest >= 0 and (not wide or definite(wide)), f"{self.who}: within {most} of its origin")
    def named(self, read):
        """The number of the piece that a proof names."""
        k = getattr(read, f"{self.who}_piece", None)
        form(k is not None or len(self.body.pieces) == 1, f"{self.who}_piece is missing")
        k = index(0 if k is None else k, len(self.body.pieces), f"{self.who}_piece")
        holds(k in self.group, f"{self.who}_piece is of its group")
        return k
    def contains(self, x, k, weights=None, depth=ZERO):
        """x is a point of piece k, and the ball of radius `depth` about it is in it: by its inequalities, of
        x and x +- 2 depth e_i, or as a mean. Told are ways: some vectors that span what x can be moved along,
        a little, there and back, within the piece."""
        skin = self.body.pieces[k][0][0]
        form(not depth or not skin.cuts, f"{self.who}_depth: of what has no dents")
        if weights is None:
            steps = [O, *(e * (2 * depth * sign) for e in E for sign in (1, -1) if depth)]
            around = [V((*(x + step - self.body.points(k)[0]), ONE)) for step in steps]
            values = [y @ through(rows, y) for rows in self.body.forms(k) for y in around]
            holds(all(value <= 0 for value in values), f"{self.who}: the point is in it")
            return E if all(value < 0 for value in values) else []
        mean, ways = self.mean(k, weights)
        margin, off = skin.margin - depth, (x - mean) @ (x - mean)
        holds(margin >= 0 and off <= margin ** 2, f"{self.who}: the point is the mean of the corners")
        return ways if margin == 0 else E if off < margin ** 2 else []
    def mean(self, k, weights):
        """(the sum of weight corner, or of weight p + S m, m.S m <= weight^2; ways, but for the margin)."""
        own = self.body.corners(k)
        form(len({index(i, len(own), "a corner") for i, *_ in weights}) == len(weights),
             f"{self.who}_weights: a corner twice")
        total, x, ways, free = ZERO, O, [], True
        for i, weight, *along in weights:
            (corner, shape), weight = own[i], number(weight)
            form(shape or not along, f"{self.who}_weights: a corner has no width")
            m = vector(along[0]) if along else O
            image = through(shape, m) if shape else m
            holds(weight > 0 and m @ image <= weight ** 2, f"{self.who}_weights: m.S m <= weight^2, > 0")
            total, x, free = total + weight, x + corner * weight + image, free and m @ image < weight ** 2
            ways += [corner - own[weights[0][0]][0], *(shape or ())]
        holds(total == 1, f"{self.who}_weights of sum 1")
        return x, ways if free else []

@dataclass
class Motion:
    """What is claimed: of two sides, for times from t0 to t1 (None: no end), a distance, sets of errors."""
    says: str
    agent: Side
    obstacle: Side
    t0: Fraction
    t1: object
    by: Fraction = ZERO
    errors: tuple = (None, None)  # Sides about 0: of the obstacle's position, of w
    along: int = 0  # of what passes a wall: to the side z > 0, 1, or z < 0, -1, of its frame
    cuts: tuple = ()  # of enclosing halves: (a, s, sign) with sign (a.y - s) >= 0, y = x - t v_B

    @property
    def w(self): return self.agent.v - self.obstacle.v
    @property
    def sides(self): return self.agent, self.obstacle
    @property
    def tubes(self): return sum(side.track.radius for side in self.sides if side.track)
    def at(self, t):
        holds(self.t0 <= t and (self.t1 is None or t <= self.t1), f"time {t} is within the horizon")

BOTH = "position_error velocity_error"
MOVING, RUN = "agent obstacle horizon", "from to bodies tracks"
CLAIMS = {  # what is said, the fields needed, those allowed
    "out": ("no common point at any time of the horizon", MOVING, f"by {BOTH}"),
    "in": ("they meet within the horizon, not merely touching", MOVING, BOTH),
    "on": ("they touch within the horizon, and no pieces overlap", MOVING, ""),
    "disjoint": ("no common point", "agent obstacle", "by"),
    "overlapping": ("they overlap", "agent obstacle", ""),
    "touching": ("they touch, and no pieces overlap", "agent obstacle", ""),
    "depends": ("some errors lead to a common point within the horizon, some to none", MOVING, BOTH),
    "inside": ("each point of the agent is in the obstacle", "agent obstacle", ""),
    "apart": ("no two points of a pair, in their tubes, are ever as near as `by`", f"{RUN} by pairs", ""),
    "stays": ("wherever in the tubes, all of the one is in the other all the time", f"{RUN} pair", ""),
    "passed": ("any continuous motion in the tubes goes through the hole of the wall, and touches none of it",
               f"{RUN} pair along", ""),
    "meet": ("wherever in the tubes, the two have a common point at a time", f"{RUN} pair", ""),
    "near": ("wherever in the tubes, two points are at a time no farther than `by`", f"{RUN} by pair", "")}
SAME = {"disjoint": "out", "overlapping": "in", "touching": "on"}

def set_of(name, read):
    """A set of errors as a side about the origin, or None."""
    return read and Side(name, boxes([(-read.box, read.box)]) if read.box else balls([O], read.ball)
                         if read.factor is None else ellipsoid(read), (0,))

def bare(body): return any(skin.cuts and not skin.shape for piece in body.pieces for skin, _ in piece)

def sides_of(*bodies_and_more):
    """Of (body, velocity, track)."""
    return [Side(who, body, range(len(body.pieces)), *more)
            for who, (body, *more) in zip(("agent", "obstacle"), bodies_and_more)]

def verdict(read, proof):
    """Of two bodies and their velocities, none at rest."""
    bodies, moving = [body(read.agent), body(read.obstacle)], hasattr(read, "horizon")
    form(all((its.read.velocity is not None) == moving for its in bodies), "velocities with a horizon")
    form(not bare(bodies[0]) and (read.says == "inside" or not bare(bodies[1])),
         "quadrics are only what something is inside of")
    sets = tuple(set_of(name, getattr(read, name, None)) for name in BOTH.split())
    says = "in_for_all" if read.says == "in" and any(sets) else SAME.get(read.says, read.says)
    horizon = read.horizon if moving else (ZERO, ZERO)
    sides = sides_of(*((its, its.read.velocity or O) for its in bodies))
    touched = prove(Motion(says, *sides, *horizon, getattr(read, "by", None) or ZERO, sets), proof)
    holds(touched or says != "on", "one of the groups touches")

def track(value):
    read = fields(value, "a track", "times positions radius", "grid turns")
    read.grid = 0 if read.grid is None else index(read.grid, 1075, "grid")
    segments = len(read.times) - 1
    form(segments == len(read.positions) == len(read.turns or read.positions), "a segment less than times")
    form(all(a < b for a, b in zip(read.times, read.times[1:])), "the times of a track grow")
    return read

def run(read, proof):
    """Of bodies on their tracks, in pairs."""
    says, apart, bodies = read.says, read.says == "apart", read.bodies
    start, end = vars(read)["from"], read.to
    form(len(bodies) == len(read.tracks), "each body has a track")
    form(not any(bare(its) or its.read.velocity for its in bodies), "runs have no velocities or quadrics")
    holds(start < end and all(its.times[0] <= start and end <= its.times[-1] for its in read.tracks),
          "from < to, and tracks have all of it")
    pairs = [tuple(index(k, len(bodies), "a body") for k in items(pair, 2, 2))
             for pair in (items(read.pairs) if apart else [read.pair])]
    form(all(i < j for i, j in pairs) and len(set(pairs)) == len(pairs), "pairs are [i, j], i < j, once")
    along, second = getattr(read, "along", 0), bodies[pairs[0][1]].read
    form(says != "passed" or type(along) is int and abs(along) == 1 and second.kind == "wall"
         and not second.center, "passed: along is 1 or -1, the second body a wall about its origin")
    holds(not apart or type(proof) is dict and proof.get("rule") == "pairs", "pairs is the rule for 'apart'")
    names = [f"{i} {j}" for i, j in pairs]
    proofs = fields(proof, "the proof", "rule pairs").pairs if apart else {names[0]: proof}
    form(type(proofs) is dict and set(proofs) == set(names), "a proof for each pair, no other")
    for name, pair in zip(names, pairs):
        sides = sides_of(*((bodies[k], None, read.tracks[k]) for k in pair))
        prove(Motion(says, *sides, start, end, getattr(read, "by", ZERO), along=along), proofs[name])

# Rules. Each is a check of a Motion and of the proof's fields, which RULES names.

def prove(m, proof):
    """Whether something touches, if that is claimed."""
    rule = proof.get("rule") if type(proof) is dict else None
    form(type(rule) is str, "a proof must have a rule")
    holds((m.says, rule) in RULES, f"{rule[:20]!r} is a rule for {m.says!r}")
    check, needed, allowed = RULES[m.says, rule]
    return check(m, fields(proof, rule, f"rule {needed}", allowed))

def shared(m, read, count):
    """The lists of pieces that the runs give to each of `count`."""
    form(read.of in ("agent", "obstacle"), "`of` is the agent or the obstacle")
    group, first, parts = getattr(m, read.of).group, 0, [[] for _ in range(count)]
    for k, length in read.runs:
        holds(index(length, len(group) - first + 1, "the count of a run") > 0, "runs have pieces")
        parts[index(k, count, "what a run is of")].extend(group[first:first + length])
        first += length
    holds(first == len(group) and all(parts), f"the runs have all {len(group)} pieces, each proof some")
    return parts

def groups(m, read):
    """Of `on` some parts may be out."""
    touched = False
    for part, sub in zip(shared(m, read, len(read.proofs)), read.proofs):
        out = m.says == "on" and type(sub) is dict and sub.get("rule") not in ("touch", "groups")
        side = replace(getattr(m, read.of), group=part)
        touched |= bool(prove(replace(m, says="out" if out else m.says, **{read.of: side}), sub))
    return touched

def cover(m, read):
    """Boxes that hold the pieces stand for them."""
    parts, side = shared(m, read, len(read.boxes)), getattr(m, read.of)
    rows, scale = side.body.rows, side.body.scale
    for (low, high), part in zip(read.boxes, parts):
        for skin, points in Side(side.who, side.body, part).points.items():
            form(not skin.shape and not skin.cuts, "cover is for corners and balls")
            for axis, (a, b, half) in enumerate(zip(low, high, skin.half or O)):
                column, room = [rows[i][axis] for i in points], half + skin.margin
                holds((a + room) * scale <= min(column) and max(column) <= (b - room) * scale,
                      f"{len(part)} pieces are in the box from {low} to {high}")
    prove(replace(m, **{read.of: replace(side, body=boxes(read.boxes), group=range(len(parts)))}), read.proof)

def steps(m, times, each):
    """(the motion, what is given for it) of each of these pieces of time."""
    holds(times[0] == m.t0 and times[-1] == m.t1, "pieces from the start to the end")
    for a, b in zip(times, times[1:]):
        holds(b is None or a < b, f"times grow: {a} < {b}")
    form(len(each) == len(times) - 1, "one for each piece of time")
    return [(replace(m, t0=a, t1=b), given) for a, b, given in zip(times, times[1:], each)]

def times(m, read):
    for part, sub in steps(m, [m.t0, *read.cuts, m.t1], read.proofs):
        prove(part, sub)

def parted(m, n, length, limits, multipliers=(None, None)):
    """Along n the gap stays above length (by + radii), length >= |n|. The limits are how far each side, and
    each set of errors, reaches at most; what is not given is found."""
    t, one = clock(m.t0, m.t1)
    gap, when = one * (-length * (m.by + m.tubes)), f" from {m.t0} to {m.t1}"
    for k, (side, limit) in enumerate(zip((*m.sides, *m.errors), limits)):
        own = n * (-1 if k == 1 else 1)
        if side:
            place, q = side.placed(m.t0, m.t1) if k < 2 else (O, None)
            if limit is None:
                limit = side.reach(own)
            else:
                side.at_most(own, limit, multipliers[k] if k < 2 else None, q, when)
            gap = gap - own @ place - (t if k == 3 else one) * limit
    holds(gap.positive() or m.t1 is None and gap.not_negative() and gap.c[0] > 0, f"the gap > 0{when}")

def plane(m, read):
    holds(not m.cuts, "no plane within halves")
    form((read.n is None) != (read.across_w is None), "a plane has either n or across_w")
    n, levels = read.n or across(m.w, *read.across_w), [getattr(read, name) for name in LEVELS]
    multipliers, given = (read.agent_multipliers, read.obstacle_multipliers), [x is not None for x in levels]
    form(given == [bool(side) for side in (*m.sides, *m.errors)] or not any([*given, *multipliers]),
         "levels are of both bodies and each set of errors, or there are none")
    levels[1] = levels[1] and -levels[1]
    parted(m, n, root_above(n @ n), levels, multipliers)

def pieces(m, read):
    for part, (n, length, *rest) in steps(m, read.times, read.planes):
        n, length = vector(n), positive(length)
        form(len(rest) != 3, "a plane is [n, length, l_A, l_B], and, if wanted, the multipliers of both")
        holds(length ** 2 >= n @ n, "length >= |n|")
        limits = [bernstein([number(x) for x in items(limit, 1, 4)]) for limit in rest[:2]]
        multipliers = [items(its, 0) or None for its in rest[2:] or ([], [])]
        parted(part, n, length, limits, multipliers)

def across(w, k, *components):
    holds(w[index(k, 3, "the axis of across_w")] != 0, f"w[{k}] != 0")
    n = [*map(number, components)]
    n = V([*n[:k], ZERO, *n[k:]])
    return n * w[k] - E[k] * (n @ w)

def named_point(m, read, side):
    """(a point of a side at a time, given as it is then or by weights alone; its ways; its depth)."""
    own, weights, depth = (getattr(read, f"{side.who}_{x}", None) for x in ("point", "weights", "depth"))
    k, own, depth = side.named(read), own or read.point, depth or ZERO
    place, q = side.instant(read.time, m.t0)
    form(own or weights, f"{side.who}: a point or weights are missing")
    x = rotated(back(q), own - place) if own else side.mean(k, weights)[0]
    return own or place + rotated(q, x), side.contains(x, k, weights, depth), depth

def near(m, read):
    m.at(read.time)
    for start in {m.t0, read.time} - {m.t1}:  # between two segments the earlier ones, and the later ones
        (a, _, depth), (b, _, other) = (named_point(replace(m, t0=start), read, side) for side in m.sides)
        room = m.by + depth + other - m.tubes
        holds(room >= 0 and (b - a) @ (b - a) <= room ** 2, f"the points are near at {read.time}")

def touch(m, read):
    m.at(read.time)
    holds(any(read.n), "n != 0")
    for side, n in zip(m.sides, (read.n, -read.n)):
        named_point(m, read, side)
        side.at_most(n, n @ (read.point - side.v * read.time))
    speed = read.n @ m.w
    holds(speed == 0 or (speed > 0 and read.time == m.t1) or (speed < 0 and read.time == m.t0),
          "n.w is 0, or they touch at that end of the horizon")
    return True

def point(m, read):
    """They have a point in common when the agent and its velocity change a little: ways make up for it."""
    m.at(read.time)
    of_agent, of_obstacle = (named_point(m, read, side)[1] for side in m.sides)
    passing = [m.w] if m.t0 < read.time and (m.t1 is None or read.time < m.t1) else []
    form(read.inside in ("agent", "obstacle", "both"), "inside must be agent, obstacle or both")
    ways = {"agent": of_agent, "obstacle": of_obstacle}.get(read.inside, of_agent + of_obstacle + passing)
    holds(definite([sum((v * v[i] for v in ways), O) for i in range(3)]),  # they span all of space
          f"{read.inside}: the point is strictly in it")

def cross(m, read):
    """`point` for both, with the weights that the pairs of corners sum up to."""
    pairs = several(several(least=3, most=3))(read.pairs)
    form(all(type(i) is type(j) is int for i, j, _ in pairs), "corners are integers")
    holds(all(number(s) > 0 for *_, s in pairs), "weights > 0")
    total, weights = sum(number(s) for *_, s in pairs), ({}, {})
    for *corners, s in pairs:
        for its, k in zip(weights, corners):
            its[k] = its.get(k, 0) + number(s) / total
    read.inside, (read.agent_weights, read.obstacle_weights) = "both", ([*its.items()] for its in weights)
    read.point = m.agent.mean(m.agent.named(read), read.agent_weights)[0] + m.agent.v * read.time
    point(m, read)

def forms(m, read):
    form(all(len(side.group) == 1 for side in m.sides) and not m.by and not any(m.errors),
         "forms are of one piece each, and prove no distance and nothing of errors")
    total = [V([ZERO] * 5)] * 5  # of (1, x - t v_B, t)
    for side, v in zip(m.sides, (m.w, O)):
        multipliers, (k,) = getattr(read, side.who), side.group
        if multipliers == []:  # all 0
            continue
        rows = weighted(side.body.forms(k), items(multipliers))
        ways = [V((*-side.body.points(k)[0], 1)), *(V((*e, 0)) for e in E), V((*-v, 0))]
        total = [line + V(x @ through(rows, y) for y in ways) for line, x in zip(total, ways)]
    for first, second, factor in read.products or ():
        a, b, factor = linear(m, first), linear(m, second), positive(factor)
        total = [line - (b * a[i] + a * b[i]) * (factor / 2) for i, line in enumerate(total)]
    if not any(m.w) or m.t0 == m.t1:  # t is t0, no variable
        total = [V((line[0] + m.t0 * line[-1], *line[1:-1])) for line in total]
        total = [total[0] + total[-1] * m.t0, *total[1:-1]]
    holds(definite(total), "the sum of the forms is positive definite")

def linear(m, name):
    """The coefficients of (1, x - t v_B, t) in what is not negative at a common point."""
    known = {"one": (1, 0), "from": (-m.t0, 1), "until": (m.t1, -1)}
    if type(name) is str:
        form(name in known and known[name][0] is not None, f"no product of {name[:10]!r}")
        return V((known[name][0], *O, known[name][1]))
    who, value = items(name, 2, 2)
    if who == "cut":
        a, s, sign = m.cuts[index(value, len(m.cuts), "a cut")]
        return V((-s * sign, *a * sign, 0))
    form(who in ("agent", "obstacle"), "products are of one, from, until, agent, obstacle, cut")
    side, a = getattr(m, who), vector(value)
    return V((side.reach(a), *-a, a @ m.w * (who == "agent")))

def halves(m, read):
    for sub, sign in ((read.below, -1), (read.above, 1)):
        prove(replace(m, cuts=(*m.cuts, (read.normal, read.at, sign))), sub)

def vertices(m, read):
    """In integers: X = (x - p, 1) of corners x and forms H, times something above 0."""
    around = m.obstacle.named(read)
    p, matrices = m.obstacle.body.points(around)[0], []
    for rows in m.obstacle.body.forms(around):
        (entries,), _ = table(flat(rows))
        matrices.append([V(entries[i:i + 4]) for i in range(0, 16, 4)])
    for k in m.agent.group:
        form(not any(skin.shape or skin.margin for skin, _ in m.agent.body.pieces[k]), "agents have corners")
        points = [table([*(x - p), ONE])[0][0] for x, _ in m.agent.body.corners(k)]
        for rows in matrices:
            images = [-through(rows, x) for x in points]
            holds(never_negative([V(x @ y for y in images) for x in points]), f"piece {k} is in it")

def never_negative(m):
    """l^T M l, for all l >= 0: exactly, up to three; of more if no entry is below 0. The least value within
    the triangle of l of sum 1 is det M / sum(adj(M) 1), at adj(M) 1 over its sum, if that is within."""
    below = [(i, j) for i in range(len(m)) for j in range(i + 1) if m[i][j] < 0]
    if len(m) > 3 or any(i == j or m[i][j] ** 2 > m[i][i] * m[j][j] for i, j in below):
        return not below
    if len(below) < 2:
        return True
    adjoint = [cross_product(m[i - 2], m[i - 1]) for i in range(3)]
    return m[0] @ adjoint[0] >= 0 or not all(x > 0 for x in sum(adjoint))

def octants(m, read):
    form(all(len(side.body.pieces) == 1 and not side.body.pieces[0][0][0].cuts for side in m.sides),
         "octants are for one convex piece each")
    def member(value, side):
        if type(value) is not list:
            return side.mean(0, [[value, 1]])[0]
        side.contains(vector(value), 0)
        return vector(value)
    def node(value, n1, n2, n3):
        if type(value) is list and len(value) == 4:
            m12, m23, m31 = n1 + n2, n2 + n3, n3 + n1
            for sub, corners in zip(value, ((n1, m12, m31), (m12, n2, m23), (m31, m23, n3), (m12, m23, m31))):
                node(sub, *corners)
            return
        t, *points = items(value, 3, 3)
        t, (a, b) = number(t), map(member, points, m.sides)
        m.at(t)
        for n in (n1, n2, n3):
            most = n @ (b - a - m.w * t) + sum(x * side.reach(n) for x, side in zip((1, t), m.errors) if side)
            holds(most < 0, f"n.(b - a - t w) + h_P(n) + t h_W(n) < 0 along n = {n}")
    for bits, sub in enumerate(items(read.nodes, 8, 8)):
        node(sub, *(e * (-1 if bits >> i & 1 else 1) for i, e in enumerate(E)))

def depends(m, read):
    for name, says in (("collides", "in"), ("passes", "out")):
        one = fields(getattr(read, name), name, "proof", "position velocity")
        changes = [one.position or O, one.velocity or O]
        for change, side in zip(changes, m.errors):
            holds(side or not any(change), f"{name}: an error is in its set")
            if side:
                side.contains(change, 0)
        agent = replace(m.agent, v=m.agent.v + changes[1])
        obstacle = replace(m.obstacle, body=m.obstacle.body.moved(changes[0]))
        prove(replace(m, says=says, agent=agent, obstacle=obstacle, errors=(None, None)), one.proof)

def passage(m, read):
    """Wholly on one side of the wall, then wholly on the other, apart from it all the time, and never as far
    from its middle as its edge is. So what is continuous goes through the hole."""
    prove(replace(m, says="apart"), read.proof)
    for t, sign in ((m.t0, -m.along), (m.t1, m.along)):
        (x, q), (p, its) = (side.instant(t, m.t0) for side in m.sides)
        n = rotated(its, E[2] * sign)
        beyond = n @ (x - p) - m.agent.reach(rotated(back(q), -n))
        holds(beyond > m.tubes, f"wholly on a side at {t}, by more than the tubes")
    m.agent.within(read.reach)
    reach = read.room + read.reach + m.tubes
    edge = [(a, b) for *_, a, b in map(m.obstacle.body.points, m.obstacle.group)]
    for a, b in edge:
        holds(reach ** 2 * ((a - b) @ (a - b)) < cross_product(a, b)[2] ** 2, "its edge is far enough")
    times = sorted({m.t0, m.t1, *(t for side in m.sides for t in side.track.times if m.t0 < t < m.t1)})
    for start, end in zip(times, times[1:]):
        x, p = (side.placed(start, end)[0] for side in m.sides)
        off = Form([read.room ** 2]) - (x - p) @ (x - p)
        holds(off.not_negative(), f"within {read.room} from {start} to {end}")
    for side, t in ((side, t) for side in m.sides for t in times[1:-1]):
        (place, q), (other, its) = side.instant(t, m.t0), side.instant(t, t)
        for x in [O, *(flat(edge) if side is m.obstacle else [])]:  # a wall could turn over
            jump = place + rotated(q, x) - other - rotated(its, x)
            holds(jump @ jump <= (2 * side.track.radius) ** 2, f"{side.who}: no jump at {t}")

def chords(m, read):
    """The way's control points are so near to the obstacle's core that all of the agent is in its margin."""
    k = m.obstacle.named(read)
    room = m.obstacle.body.pieces[k][0][0].margin - read.reach - m.tubes
    form(not m.obstacle.track.turns, "what it stays within does not turn")
    m.agent.within(read.reach)
    for part, means in steps(m, read.times, read.means):
        (x, q), (p, _) = (side.placed(part.t0, part.t1) for side in m.sides)
        holds(not q or (q @ q).positive(), f"agent: q.q is positive from {part.t0}")
        columns, scale = table(x - p)
        form(len(means) == len(columns), f"{len(columns)} control points from {part.t0}")
        for i, (column, weights) in enumerate(zip(columns, means)):
            off = column * Fraction(1, scale * comb(len(columns) - 1, i)) - m.obstacle.mean(k, weights)[0]
            holds(room >= 0 and off @ off <= room ** 2, f"point {i} from {part.t0} is near its mean")

WHERE = "agent_piece obstacle_piece agent_weights obstacle_weights"
LEVELS = "agent_at_most", "obstacle_at_least", "position_error_at_most", "velocity_error_at_most"
RULES = {(claim, rule): (check, needed, allowed) for claims, rule, check, needed, allowed in (
    ("out on inside apart", "groups", groups, "of runs proofs", ""),
    ("out apart", "cover", cover, "of boxes runs proof", ""),
    ("out", "plane", plane, "", f"n across_w {' '.join(LEVELS)} agent_multipliers obstacle_multipliers"),
    ("out apart", "times", times, "cuts proofs", ""), ("out", "forms", forms, "agent obstacle", "products"),
    ("out", "halves", halves, "normal at below above", ""), ("on", "touch", touch, "n time point", WHERE),
    ("in", "point", point, "time point inside", WHERE),
    ("in", "cross", cross, "time pairs", "agent_piece obstacle_piece"),
    ("in_for_all", "octants", octants, "nodes", ""), ("depends", "errors", depends, "collides passes", ""),
    ("inside", "vertices", vertices, "", "obstacle_piece"), ("apart", "pieces", pieces, "times planes", ""),
    ("passed", "through", passage, "room reach proof", ""),
    ("stays", "chords", chords, "reach times means", ""),
    ("near meet", "point", near, "time",
     f"{WHERE} point agent_point obstacle_point agent_depth obstacle_depth")) for claim in claims.split()}
WEIGHTS = several(several(least=2, most=3))
READERS = {name: reader for names, reader in (  # of fields; the others are read where they are used
    ("format says rule kind of inside tree", text), (f"level time at from to {' '.join(LEVELS)}", number),
    ("by radius margin ball cell extent room reach agent_depth obstacle_depth", positive),
    ("center velocity low high n normal point position box agent_point obstacle_point", vector),
    ("cuts agent_multipliers obstacle_multipliers", several(number)), ("times", several(number, 2)),
    ("agent_weights obstacle_weights", WEIGHTS), ("means", several(several(WEIGHTS))),
    ("factor", matrix), ("matrix shape", symmetric), ("matrices", several(lambda rows: symmetric(rows, 4))),
    ("points", several(vector)), ("outline", several(lambda v: vector(v, 2), 3)),
    ("triangles", several(several(least=3, most=3))), ("boxes", several(several(vector, 2, 2))),
    ("delimiters", several(lambda cut: fields(cut, "a delimiter", "matrix level"))),
    ("parts", several(lambda part: fields(part, "a part", "center", "factor shape"))),
    ("pieces bodies", several(body)), ("tracks", several(track)), ("horizon", horizon), ("proofs", several()),
    ("position_error velocity_error", errors), ("positions", several(several(vector, 1, 16))),
    ("turns", several(several(lambda q: vector(q, 4), 1, 16))), ("pair", several(least=2, most=2)),
    ("runs", several(several(least=2, most=2))),
    ("products", several(several(least=3, most=3), 0)), ("across_w", several(least=3, most=3)),
    ("planes", several(several(least=4, most=6)))) for name in names.split()}

# The program.

def told(value):
    """What was read, but for long lists, of which the digest is told."""
    if type(value) is dict:
        return {name: told(x) for name, x in value.items()}
    text = json.dumps(value)
    digest = hashlib.sha256(text.encode()).hexdigest()
    return value if len(text) < 2000 else f"{len(text)} characters of JSON, SHA-256 {digest}"

def check(document):
    """In words what is proved, or Malformed or Refused."""
    answer = {} if type(document) is not dict or "format" in document else document
    read = fields(answer.get("certificate", document), "a certificate", "format version claim proof")
    form(read.format == "vericone-certificate" and type(read.version) is int and read.version == 1,
         "the format must be vericone-certificate, version 1")
    says = read.claim.get("says") if type(read.claim) is dict else None
    form(type(says) is str and says in CLAIMS, f"`says` must be one of {', '.join(CLAIMS)}")
    words, needed, allowed = CLAIMS[says]
    claim = fields(read.claim, "the claim", f"says {needed}", f"id {allowed}")
    form(type(claim.id) in (str, int, float, type(None)), "id must be a text or a number")
    (run if "tracks" in needed else verdict)(claim, read.proof)
    unsure = any(getattr(claim, name, None) for name in BOTH.split())
    said = "robust" if unsure and "robust" in answer else "verdict"
    holds(answer.get(said, says) == says, f"the answer's {said!r} is {says}")
    if unsure and says == "in":
        words = "for any errors there is a common point at a time of the horizon"
    return f"{says}: {words}. {json.dumps(told(read.claim))}"

def decoded(data, most):
    """The JSON value; refused if reading it could take more memory than `most` bytes."""
    bytes_of = {b"{": 400, b"[": 200, b",": 200, b"#": 500, b"u0023": 500}
    cost = len(data) * (4 if data.isascii() and b"\\u" not in data else 12)
    cost += sum(each * data.count(sign) for sign, each in bytes_of.items())
    form(cost <= most, f"{cost} bytes of memory needed, {most} allowed (--memory)")
    return parsed(data.decode("utf-8"))

def texts(stream, most):
    """Of each JSON value of a file, one or one a line."""
    line = next(filter(bytes.strip, iter(lambda: stream.readline(most // 4 + 1), b"")), b"")
    try:
        decoded(line, most)
    except FAULTS as wrong:  # others are told where it is checked
        if type(wrong) is json.JSONDecodeError:
            line += stream.read(most // 4 + 1 - len(line))
    yield line
    yield from iter(lambda: stream.readline(most // 4 + 1), b"")

def checked(stream, name, most):
    """Prints a line for each certificate; the exit statuses that occurred."""
    statuses = set()
    for k, line in enumerate(filter(bytes.strip, texts(stream, most)), 1):
        try:
            answer, status = f"accepted: {check(decoded(line, most))}", 0
        except Refused as wrong:
            answer, status = f"refused, this does not hold: {wrong}", 1
        except FAULTS as wrong:
            answer, status = f"no certificate: {str(wrong) or type(wrong).__name__}", 2
        print(f"{name}: {k}: {answer}")
        statuses.add(status)
    if not statuses:
        print(f"{name}: no certificate: empty")
    return statuses or {2}

def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("files", nargs="+", metavar="FILE", help="- is the standard input")
    options.add_argument("--memory", type=int, default=190, metavar="MB", help="at most to use (190)")
    given, statuses = options.parse_args(), set()
    if sys.platform == "linux":
        import resource
        most, hard = max(given.memory - 10, 30) * 10 ** 6, resource.getrlimit(resource.RLIMIT_DATA)[1]
        resource.setrlimit(resource.RLIMIT_DATA, (min(most, hard % 2 ** 63), hard))
    sys.stdout.reconfigure(errors="backslashreplace")
    for name in given.files:
        try:
            with open(name, "rb") if name != "-" else sys.stdin.buffer as stream:
                statuses |= checked(stream, name, (given.memory - 30) * 10 ** 6)
        except OSError as wrong:
            print(f"{name}: no certificate: {wrong.strerror}")
            statuses.add(2)
    return 1 if 1 in statuses else max(statuses)

if __name__ == "__main__":
    sys.exit(main())
