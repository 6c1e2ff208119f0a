#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks certificates: vericone_check.py FILE... (`-` is the standard input). Python 3.10 or later, nothing else.

A file is one certificate, or one a line; docs/reference/certificates.md has the format, version 1. Printed is what
is proved, from what was read, or the first inequality that does not hold. Exit status: 0 all accepted, 1 one is
refused, 2 one is no certificate (and none is refused).

All is computed with fractions and integers. What is proved is of a `Motion`, read from the claim alone; a proof is a
list of numbers that are tried on it. The page says of each rule what it checks.
"""
import argparse
import hashlib
import json
import os
import re
import sys
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from math import comb, isqrt, lcm
from types import SimpleNamespace

class Malformed(Exception): """Not a certificate of this format."""
class Refused(Exception): """A certificate that does not prove its claim."""
FAULTS = (Malformed, ValueError, RecursionError, MemoryError)
def holds(true, inequality, fault=Refused):
    if not true:
        raise fault(inequality)
def form(true, complaint): holds(true, complaint, Malformed)

# Numbers and fields. A reader takes a JSON value and returns what it means.

ZERO, HALF, ONE, LONGEST = Fraction(0), Fraction(1, 2), Fraction(1), 4300  # characters of a number

def double(text):
    """What a JSON number means: the nearest double, which must be finite."""
    form(len(text) <= LONGEST and abs(float(text)) <= sys.float_info.max, f"{text[:20]} is no finite double")
    return float(text) if re.search("[.eE]", text) else int(float(text))
def once(pairs):
    form(len({name for name, _ in pairs}) == len(pairs), "a field twice")
    return dict(pairs)
def parsed(text):
    return json.loads(text, parse_float=double, parse_int=double, parse_constant=double, object_pairs_hook=once)

def number(value):
    text = type(value) is str and len(value) <= LONGEST and re.fullmatch("-?[0-9]+(/0*[1-9][0-9]*)?", value, re.A)
    form(text or type(value) in (int, float, Fraction), "no number, or a denominator of 0")
    return Fraction(value)
def positive(value, least=0):
    form(number(value) >= least, f"a number below {least}")
    return number(value)
def index(value, count, what):
    form(type(value) is int and 0 <= value < count, f"{what} must be an integer from 0 to {count - 1}")
    return value
def text(value):
    form(type(value) is str, "a text is missing")
    return value
def items(value, least=1, most=None):
    form(type(value) is list and least <= len(value) <= (most or len(value)), f"no list of {least} to {most} items")
    return value
def several(reader=lambda value: value, least=1, most=None):
    return lambda value: [reader(x) for x in items(value, least, most)]
def vector(value, least=2, most=3): return V(map(number, items(value, least, most)))
def matrix(value, most=3): return [vector(row, len(value), len(value)) for row in items(value, 2, most)]
def symmetric(value, most=3):
    form(matrix(value, most) == transposed(matrix(value, most)), "a matrix that is not symmetric")
    return matrix(value, most)
def horizon(value):
    start, end = items(value, 2, 2) if type(value) is list else (0, value)
    return positive(start), None if end is None else positive(end, positive(start))
def errors(value):
    form(type(value) is dict and len(value) == 1, "a set of errors is one of ball, box, factor")
    return fields(value, "a set of errors", "", "ball box factor")

def fields(value, what, needed, allowed=""):
    """The fields that are needed and those that are allowed (None if left out), each through its reader below."""
    needed, allowed = needed.split(), allowed.split()
    form(type(value) is dict and all(name in value for name in needed), f"{what} must have {', '.join(needed)}")
    for name in value:
        form(name in needed or name in allowed, f"{what}: unknown field {name[:40]!r}")
        form(value[name] is not None or name == "horizon", f"{what}: {name} is null")
    return SimpleNamespace(**{name: READERS.get(name, lambda x: x)(value[name]) if name in value else None
                              for name in needed + allowed})

# Algebra. Vectors and matrices (lists of rows) are of numbers, or of forms.

class V(tuple):
    """A vector; two must be of the same size."""
    def __add__(self, other): return V(x + y for x, y in zip(self, other, strict=True))
    def __sub__(self, other): return V(x - y for x, y in zip(self, other, strict=True))
    def __mul__(self, factor): return V(x * factor for x in self)
    def __neg__(self): return V(-x for x in self)
    def __matmul__(self, other): return sum(x * y for x, y in zip(self, other, strict=True))

class Form:
    """A polynomial on a piece of time: the sum of c_k sigma^(N-k) tau^k / scale, with integers c_0, ..., c_N; tau
    goes from 0 to 1 and sigma = 1 - tau. So it is not negative if no c_k is."""
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
def bernstein(coefficients): return Form([comb(len(coefficients) - 1, k) * x for k, x in enumerate(coefficients)])
def table(forms):
    """(for each k the c_k of all, raised to one size by (sigma + tau)^m, integers on one scale; that scale)."""
    forms = [x if type(x) is Form else Form([x]) for x in forms]
    scale, size = lcm(*(x.scale for x in forms)), max(len(x.c) for x in forms)
    raised = (convolved([c * (scale // x.scale) for c in x.c],
                        [comb(size - len(x.c), k) for k in range(size - len(x.c) + 1)]) for x in forms)
    return [V(column) for column in zip(*raised)], scale

def transposed(rows): return [V(column) for column in zip(*rows, strict=True)]
def through(rows, x): return V(row @ x for row in rows)
def zero(size): return V([ZERO] * size)
def unit(size): return [V(ONE if i == j else ZERO for j in range(size)) for i in range(size)]
def flat(rows): return [x for row in rows for x in row]
def bordered(rows, side, corner): return [*(V((*row, x)) for row, x in zip(rows, side)), V((*side, corner))]
def cross_product(a, b): return V(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))
def inverse(rows):
    """Of a symmetric matrix by elimination, if that is positive definite (all pivots are above 0), else None."""
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
def spans(vectors, size):
    """Whether their rank is `size`, the size of each: the sum of their squares v v^T is then positive definite."""
    return definite([sum((v * v[i] for v in vectors), zero(size)) for i in range(size)])
def root_above(q):
    """Not below sqrt(q), and above it by so little that a sum of two such roots is told from any other number."""
    shift = 64 + 8 * (q.numerator.bit_length() + q.denominator.bit_length())
    return Fraction(isqrt((q.numerator << 2 * shift) // q.denominator) + 1, 1 << shift) if q else q

# Bodies. A piece is the hull of some points, with what its skin puts about each.

@dataclass(eq=False)
class Skin:
    """About a point p the ellipsoid { p + S m : m.S m <= 1 }, or the box of these half edges, or p alone; and all that
    is within `margin` of it. Of that the points where X^T C X <= 0, X = (x - p, 1), for each C of `cuts`; these alone,
    of all of space, if there is no S."""
    shape: list = None
    half: tuple = ()
    margin: Fraction = ZERO
    cuts: tuple = ()

    @cache
    def forms(self, size):
        """The matrices H of its points x, X^T H X <= 0 for each; of what has not both an S and a margin."""
        if self.half:
            return [bordered([e * x for x in e], e * ZERO, -h * h) for e, h in zip(unit(size), self.half)]
        own = inverse(self.shape) if self.shape else unit(size)
        holds(own, "det S > 0: the body is not flat")
        around = bordered(own, zero(size), -ONE if self.shape else -self.margin ** 2)
        return [*self.cuts] if self.cuts and not self.shape else [around, *self.cuts]
    def squares(self, n):
        """Of the roots that it adds to n.p, where it is the farthest along n; a box adds no root, but:"""
        own = [n @ through(self.shape, n)] if self.shape else []
        return own + ([n @ n * self.margin ** 2] if self.margin else [])
    def straight(self, n): return sum(abs(x) * h for x, h in zip(n, self.half))

POINT, box_about = Skin(), cache(lambda half: Skin(half=half))

@dataclass
class Body:
    """Points row / scale, with integers; of each piece the (skin, number of a point) of which it is the hull."""
    scale: int
    rows: list
    pieces: list

    def moved(self, by):
        scale = lcm(self.scale, *(x.denominator for x in by))
        by, factor = V(int(x * scale) for x in by), scale // self.scale
        return Body(scale, [row * factor + by for row in self.rows], self.pieces)
    def quadrics(self): return any(skin.cuts and not skin.shape for piece in self.pieces for skin, _ in piece)
    def points(self, k): return [self.rows[i] * Fraction(1, self.scale) for _, i in self.pieces[k]]
    def forms(self, k):
        """As Skin.forms, of a piece about its point."""
        (skin, _), *others = self.pieces[k]
        form(not others and not (skin.shape and skin.margin), f"weights of piece {k} are missing")
        return skin.forms(len(self.rows[0]))
    def corners(self, k):
        """(corner or centre, S or None) of which, but for its margin, a piece without dents is the hull."""
        found = []
        for p, (skin, _) in zip(self.points(k), self.pieces[k]):
            form(not skin.cuts, f"piece {k} has dents")
            found += [(V(x + (h if bits >> i & 1 else -h) for i, (x, h) in enumerate(zip(p, skin.half))), None)
                      for bits in range(1 << len(p))] if skin.half else [(p, skin.shape)]
        return found

def body_of(points, pieces):
    scale = 1
    for x in {x.denominator for row in points for x in row}:
        scale = lcm(scale, x)
        form(scale.bit_length() < 20000, "points whose common denominator has more than 6000 digits")
    form(all(len(row) == len(points[0]) for row in points), "points of two sizes")
    return Body(scale, [V(x.numerator * (scale // x.denominator) for x in row) for row in points], pieces)
def hulls(points, pieces): return body_of(points, [[(POINT, i) for i in piece] for piece in pieces])
def single(points, skins): return body_of(points, [[(skin, k)] for k, skin in enumerate(skins)])
def boxes(ends):
    form(all(x >= 0 for low, high in ends for x in high - low), "a box with low > high")
    return single([(low + high) * HALF for low, high in ends], [box_about((high - low) * HALF) for low, high in ends])
def balls(points, radius): return single(points, [Skin(margin=radius)] * len(points))
def shape_of(read):
    form((read.factor is None) != (read.shape is None), "an ellipsoid has either factor or shape")
    form(read.factor or inverse(read.shape), "a shape that is not positive definite")
    return [through(read.factor, row) for row in read.factor] if read.factor else read.shape
def ellipsoid(read):
    shape, origin = shape_of(read), zero(len(read.factor or read.shape))
    delimiters = getattr(read, "delimiters", ())
    form(all(len(cut.matrix) == len(shape) for cut in delimiters), "matrices of two sizes")
    cuts = tuple(bordered(cut.matrix, origin, -cut.level) for cut in delimiters)
    return single([origin], [Skin(shape, cuts=cuts)])
def quadrics(read):
    form(len({len(rows) for rows in read.matrices}) == 1, "matrices of two sizes")
    return single([zero(len(read.matrices[0]) - 1)], [Skin(cuts=tuple(read.matrices))])
def convex(read):
    skins = [Skin(shape_of(part) if part.factor or part.shape else None, margin=read.margin or ZERO)
             for part in read.parts]
    form(all(len(skin.shape or part.center) == len(part.center) for skin, part in zip(skins, read.parts)),
         "parts of two sizes")
    return body_of([part.center for part in read.parts], [[(skin, k) for k, skin in enumerate(skins)]])
def mesh(read):
    return hulls(read.points, [[index(i, len(read.points), "a triangle's point") for i in three]
                               for three in read.triangles])
def wall(read):
    """A flat ring about a hole that is star-shaped about the origin, in quadrangles."""
    rim = [V((*v, ZERO)) for v in read.outline]
    edges, count = list(zip(rim, rim[1:] + rim[:1])), len(rim)
    upper = [y > 0 or y == 0 < x for x, y, _ in rim]
    rounds = sum(not a and b for a, b in zip(upper, upper[1:] + upper))
    form(rounds == 1 and all(cross_product(a, b)[2] > 0 for a, b in edges) and read.extent > 1,
         "an outline goes round the origin once, counterclockwise, extent > 1")
    return hulls(rim + [v * read.extent for v in rim],
                 [(k, (k + 1) % count, count + (k + 1) % count, count + k) for k in range(count)])
def union(parts):
    firsts = [sum(len(part.rows) for part in parts[:k]) for k in range(len(parts))]
    return body_of([row * Fraction(1, part.scale) for part in parts for row in part.rows], [
        [(skin, first + i) for skin, i in piece] for first, part in zip(firsts, parts) for piece in part.pieces])
def octree(read):
    """A node is eight characters, of its cell's eighths; the nodes of its `+` follow it in their order. In integers:
    twice the corners, so that the centres of cells are some."""
    blocks = re.findall("[.#+]{8}", read.tree)
    form(8 * len(blocks) == len(read.tree) and len(read.low) == 3, "nodes are eight of .#+ each, in space")
    scale, blocks, found = lcm(read.cell.denominator, *(x.denominator for x in read.low)), iter(blocks), []
    def node(low, edge):
        block = next(blocks, None)
        form(block and edge >= cell > 0, "each + has a node, and none has cells below the smallest")
        for bits, what in enumerate(block):
            at = [x + edge * (bits >> i & 1) for i, x in enumerate(low)]
            if what == "+":
                node(at, edge // 2)
            elif what == "#":
                found.append((V(x + edge // 2 for x in at), edge))
    cell = int(read.cell * 2 * scale)
    node([int(x * 2 * scale) for x in read.low], cell << index(read.depth, 64, "depth"))
    form(found and next(blocks, None) is None, "an octree has cells, and no node too many")
    skins = {edge: Skin(half=V([Fraction(edge, 4 * scale)] * 3)) for _, edge in found}
    return Body(2 * scale, [middle for middle, _ in found], [[(skins[edge], k)] for k, (_, edge) in enumerate(found)])

KINDS = {  # fields needed, fields allowed, and the body of what was read
    "ellipsoid": ("", "factor shape", ellipsoid), "delimited": ("delimiters", "factor shape", ellipsoid),
    "ball": ("center radius", "", lambda read: balls([read.center * 0], read.radius)),
    "hull": ("points", "", lambda read: hulls(read.points, [range(len(read.points))])),
    "convex": ("parts", "margin", convex), "quadrics": ("matrices", "", quadrics),
    "box": ("low high", "", lambda read: boxes([(read.low, read.high)])), "mesh": ("points triangles", "", mesh),
    "cloud": ("points radius", "", lambda read: balls(read.points, read.radius)),
    "boxes": ("boxes", "", lambda read: boxes(read.boxes)), "octree": ("low cell depth tree", "", octree),
    "wall": ("outline extent", "", wall), "union": ("pieces", "", None), "file": ("name sha256", "", None)}
PARTS = ("ellipsoid", "ball", "hull", "box", "convex", "delimited", "quadrics")  # of a union

class Reader:
    """Reads bodies, and the files beside the certificate that have some."""
    def __init__(self, folder, most): self.folder, self.most, self.known = folder, most, (None, None)
    def body(self, value, what, more="", within=None):
        """(the body, what was read); `within` is the kind of body that this one is a part of."""
        kind = value.get("kind") if type(value) is dict else None
        form(type(kind) is str and kind in KINDS, f"{what}: kind must be one of {', '.join(KINDS)}")
        form(kind != "file" or not within, f"{what}: no file within a {within}")
        form(within != "union" or kind in PARTS, f"a {kind} in a union")
        needed, allowed, make = KINDS[kind]
        read = fields(value, what, f"kind {needed} {more}", f"center {allowed}")
        if kind == "file":
            found, read.body = self.body(self.file(read.name, read.sha256.lower()), what, within=kind)
        elif kind == "union":
            parts, read.pieces = zip(*(self.body(part, "a piece", within=kind) for part in read.pieces))
            found = union(parts)
        else:
            found = make(read)
        return found.moved(read.center) if read.center else found, read
    def file(self, name, digest):
        """The very bytes of which the digest is are those that are parsed."""
        form(name and not re.search(r"[/\\\0]", name), "a file's name must be without slashes")
        if self.known[0] != (name, digest):
            path = os.path.join(self.folder, name)
            form(os.path.isfile(path), f"there is no file {path}")
            with open(path, "rb") as stream:
                data = stream.read(self.most // 4 + 1)
            holds(hashlib.sha256(data).hexdigest() == digest, f"the file {name} has the SHA-256 {digest}")
            self.known = (name, digest), decoded(data, self.most)
        return self.known[1]

# Claims.

@dataclass
class Side:
    """Agent, obstacle or set of errors: a body, the pieces of it that are meant, its velocity or its track."""
    who: str
    body: Body
    group: object
    v: object = None
    track: object = None

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
        return {skin: max(n @ rows[i] for i in its) + scale * skin.straight(n) for skin, its in self.points.items()}
    def reach(self, n):
        """Not below n.x in these pieces."""
        (m,), scale = table(n)
        return max(Fraction(top, scale * self.body.scale) + sum(map(root_above, skin.squares(n)))
                   for skin, top in self.tops(m).items())
    def at_most(self, n, most, multipliers=None, q=None, when=""):
        """n.R x <= most for the points x of these pieces, R the rotation of q, if any; all may be forms."""
        n, square = unturned(q, n)
        holds(not q or square.positive(), f"{self.who}: q.q is positive{when}")
        columns, scale = table([*n, square * most])
        tops, unit_of_r = [self.tops(V(column[:-1])) for column in columns], scale * self.body.scale
        for skin in self.points:
            r = Form([column[-1] * self.body.scale - top[skin] for column, top in zip(columns, tops)], unit_of_r)
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
            rest = most - skin.margin - root_above(sum(x * x for x in (far + skin.half if skin.half else far)))
            wide = skin.shape and [e * rest ** 2 - row for e, row in zip(unit(len(far)), skin.shape)]
            holds(rest >= 0 and (not wide or definite(wide)), f"{self.who}: within {say(most)} of its origin")
    def named(self, read):
        """The number of the piece that a proof names."""
        k = getattr(read, f"{self.who}_piece", None)
        form(k is not None or len(self.body.pieces) == 1, f"{self.who}_piece is missing")
        k = index(0 if k is None else k, len(self.body.pieces), f"{self.who}_piece")
        holds(k in self.group, f"{self.who}_piece is of its group")
        return k
    def contains(self, x, k, weights=None, depth=ZERO):
        """x is a point of piece k, by its inequalities or as a mean (then with the ball of radius `depth` about it);
        told are ways: some vectors that span what it can be moved along, a little, there and back, within it."""
        size, margin = len(x), self.body.pieces[k][0][0].margin - depth
        if weights is None:
            y = V((*(x - self.body.points(k)[0]), ONE))
            values = [y @ through(rows, y) for rows in self.body.forms(k)]
            holds(all(value <= 0 for value in values), f"{self.who}: the point is in it")
            return unit(size) if all(value < 0 for value in values) else []
        mean, ways = self.mean(k, weights)
        rest = (x - mean) @ (x - mean)
        holds(margin >= 0 and rest <= margin ** 2, f"{self.who}: the point is the mean of the corners")
        return ways if margin == 0 else unit(size) if rest < margin ** 2 else []
    def mean(self, k, weights):
        """(the sum of weight corner, or of weight p + S m, m.S m <= weight^2; ways as above, but for the margin)."""
        own = self.body.corners(k)
        form(len({index(i, len(own), "a corner") for i, *_ in weights}) == len(weights),
             f"{self.who}_weights: a corner twice")
        total, x, ways, free = ZERO, zero(len(own[0][0])), [], True
        for i, weight, *along in weights:
            (corner, shape), weight = own[i], number(weight)
            form(shape or not along, f"{self.who}_weights: a corner has no width")
            m = vector(along[0]) if along else zero(len(corner))
            image = through(shape, m) if shape else m
            holds(weight > 0 and m @ image <= weight ** 2, f"{self.who}_weights: weight > 0, m.S m <= weight^2")
            total, x = total + weight, x + corner * weight + image
            ways, free = [*ways, corner - own[weights[0][0]][0], *(shape or ())], free and m @ image < weight ** 2
        holds(total == 1, f"{self.who}_weights of sum 1")
        return x, ways if free else []

@dataclass
class Motion:
    """What is claimed: of two sides, for times from t0 to t1 (None: without end), a distance, sets of errors."""
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
    def at(self, t):
        holds(self.t0 <= t and (self.t1 is None or t <= self.t1), f"time {say(t)} is within the horizon")

ERRORS = "position_error", "velocity_error"
MOVING, RUN = "agent obstacle horizon", "from to bodies tracks"
CLAIMS = {  # what is said, the fields needed, those allowed
    "out": ("no common point at any time of the horizon", MOVING, f"by {' '.join(ERRORS)}"),
    "in": ("they meet within the horizon, not merely touching", MOVING, " ".join(ERRORS)),
    "on": ("they touch within the horizon, and no pieces overlap", MOVING, ""),
    "disjoint": ("no common point", "agent obstacle", "by"), "overlapping": ("they overlap", "agent obstacle", ""),
    "touching": ("they touch, and no pieces overlap", "agent obstacle", ""),
    "depends": ("some errors lead to a common point within the horizon, some to none", MOVING, " ".join(ERRORS)),
    "inside": ("each point of the agent is in the obstacle", "agent obstacle", ""),
    "apart": ("no two points within the tubes of a pair are as near as `by` at any time", f"{RUN} by pairs", ""),
    "stays": ("whatever the motions within the tubes, all of the one is in the other all the time", f"{RUN} pair", ""),
    "passed": ("any continuous motion within the tubes goes through the hole of the wall, and touches none of it",
               f"{RUN} pair along", ""),
    "meet": ("whatever the motions within the tubes, the two have a common point at a time", f"{RUN} pair", ""),
    "near": ("whatever the motions within the tubes, two points are at a time no farther apart than `by`",
             f"{RUN} by pair", "")}
SAME = {"disjoint": "out", "overlapping": "in", "touching": "on"}

def set_of(name, read, origin):
    """A set of errors as a side about the origin, or None."""
    return read and Side(name, balls([origin], read.ball) if read.ball is not None else boxes([(-read.box, read.box)])
                         if read.box else ellipsoid(SimpleNamespace(factor=read.factor, shape=None)), (0,))

def verdict(read, proof, reader):
    """Of two bodies and their velocities, none at rest."""
    moving, sides = hasattr(read, "horizon"), []
    for who in ("agent", "obstacle"):
        body, its = reader.body(getattr(read, who), who, "velocity" * moving)
        setattr(read, who, its)
        form(read.says == "inside" and who == "obstacle" or not body.quadrics(),
             "quadrics are only what something is inside of")
        sides.append(Side(who, body, range(len(body.pieces)), its.velocity if moving else zero(len(body.rows[0]))))
    sets = tuple(set_of(name, getattr(read, name, None), sides[0].v * 0) for name in ERRORS)
    says = "in_for_all" if read.says == "in" and any(sets) else SAME.get(read.says, read.says)
    horizon = read.horizon if moving else (ZERO, ZERO)
    touched = prove(Motion(says, *sides, *horizon, getattr(read, "by", None) or ZERO, sets), proof)
    holds(touched or says != "on", "one of the groups touches")

# Rules of verdicts. Each is a check of a Motion and of the proof's fields, which RULES names.

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
    holds(first == len(group) and all(parts), f"the runs' {first} pieces are all {len(group)}, and none is left out")
    return parts

def groups(m, read):
    """Of `on` some parts may be out."""
    touched = False
    for part, sub in zip(shared(m, read, len(read.proofs)), read.proofs):
        out = m.says == "on" and type(sub) is dict and sub.get("rule") not in ("touch", "groups")
        touched = bool(prove(replace(m, says="out" if out else m.says, **{
            read.of: replace(getattr(m, read.of), group=part)}), sub)) or touched
    return touched

def cover(m, read):
    """Boxes that hold the pieces stand for them."""
    parts = shared(m, read, len(read.boxes))
    side = getattr(m, read.of)
    for (low, high), part in zip(read.boxes, parts):
        for skin, points in Side(side.who, side.body, part).points.items():
            form(not skin.shape and not skin.cuts, "cover is for corners and balls")
            columns = zip(*(side.body.rows[i] for i in points))
            for a, b, half, column in zip(low, high, skin.half or zero(len(low)), columns, strict=True):
                holds((a + skin.margin + half) * side.body.scale <= min(column)
                      and max(column) <= (b - skin.margin - half) * side.body.scale,
                      f"{side.who}: {len(part)} pieces are in the box from {say(low)} to {say(high)}")
    prove(replace(m, **{read.of: replace(side, body=boxes(read.boxes), group=range(len(parts)))}), read.proof)

def times(m, read):
    for start, end, sub in steps(m, [m.t0, *read.cuts, m.t1], read.proofs):
        prove(replace(m, t0=start, t1=end), sub)

def weighted(matrices, multipliers):
    """Their sum with these multipliers."""
    form(len(multipliers) == len(matrices), f"{len(matrices)} multipliers are needed")
    holds(all(number(x) >= 0 for x in multipliers), "multipliers >= 0")
    size = len(matrices[0])
    return [sum((rows[i] * number(x) for x, rows in zip(multipliers, matrices)), zero(size)) for i in range(size)]

def plane(m, read):
    holds(not m.cuts, "no plane within halves")
    form((read.n is None) != (read.across_w is None), "a plane has either n or across_w")
    n, levels = read.n or across(m.w, *read.across_w), []
    parts = any(len(piece) > 1 and piece[0][0] is not POINT for side in m.sides
                for piece in map(side.body.pieces.__getitem__, side.group))
    bounded = parts or m.by or any(m.errors) or read.agent_at_most is not None
    for side, name, sign in zip((*m.sides, *m.errors), LEVELS, (1, -1, 1, 1)):
        level, multipliers = getattr(read, name), getattr(read, f"{side and side.who}_multipliers", None)
        form((level is not None) == bool(side and bounded), f"{name} is missing, or is none of a plane's here")
        form(bounded or multipliers is None, "multipliers are of levels")
        levels.append(level * sign if level is not None else side.reach(n * sign) if side else ZERO)
        if level is not None:
            side.at_most(n * sign, levels[-1], multipliers)
    speed = n @ m.w + levels[3]
    holds(m.t1 is not None or speed <= 0, f"n.w = {say(speed)} <= 0, as the horizon has no end")
    gap = min(-sum(levels[:3]) - t * speed for t in (m.t0, m.t1) if t is not None)
    holds(gap > 0 and (not m.by or gap ** 2 > m.by ** 2 * (n @ n)), f"the gap {say(gap)} > {say(m.by)} |n|, and > 0")

def across(w, k, a, b):
    form(len(w) == 3, "across_w is for space")
    i, j = (axis for axis in range(3) if axis != index(k, 3, "the axis of across_w"))
    holds(w[k] != 0, f"w[{k}] != 0")
    e = unit(3)
    return (e[i] * w[k] - e[k] * w[i]) * number(a) + (e[j] * w[k] - e[k] * w[j]) * number(b)

def common_point(m, read):
    """The ways of both."""
    m.at(read.time)
    return [side.contains(read.point - side.v * read.time, side.named(read), getattr(read, f"{side.who}_weights"))
            for side in m.sides]

def touch(m, read):
    common_point(m, read)
    holds(any(read.n), "n != 0")
    for side, n in zip(m.sides, (read.n, -read.n)):
        side.at_most(n, n @ (read.point - side.v * read.time))
    speed = read.n @ m.w
    holds(speed == 0 or (speed > 0 and read.time == m.t1) or (speed < 0 and read.time == m.t0),
          f"n.w = {say(speed)} is 0, or they touch at that end of the horizon")
    return True

def point(m, read):
    """What they have in common they have when the agent and its velocity change a little: the ways make up for it."""
    form(read.inside in ("agent", "obstacle", "both"), "inside must be agent, obstacle or both")
    of_agent, of_obstacle = common_point(m, read)
    passing = [m.w] if m.t0 < read.time and (m.t1 is None or read.time < m.t1) else []
    ways = {"agent": of_agent, "obstacle": of_obstacle, "both": of_agent + of_obstacle + passing}[read.inside]
    holds(spans(ways, len(m.w)), f"{read.inside}: the point is strictly in it")

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
    size = len(m.w)
    form(all(len(side.group) == 1 for side in m.sides) and not m.by and not any(m.errors),
         "forms are of one piece each, and prove no distance and nothing of errors")
    total = [zero(size + 2) for _ in range(size + 2)]  # of (1, x - t v_B, t)
    for side, v in zip(m.sides, (m.w, m.w * 0)):
        multipliers, (k,) = getattr(read, side.who), side.group
        if multipliers == []:  # all 0
            continue
        rows = weighted(side.body.forms(k), items(multipliers))
        ways = [V((*-side.body.points(k)[0], 1)), *(V((*e, 0)) for e in unit(size)), V((*-v, 0))]
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
        return V((known[name][0], *m.w * 0, known[name][1]))
    who, value = items(name, 2, 2)
    if who == "cut":
        a, s, sign = m.cuts[index(value, len(m.cuts), "a cut")]
        return V((-s * sign, *a * sign, 0))
    form(who in ("agent", "obstacle"), "products are of one, from, until, agent, obstacle, cut")
    side, a = getattr(m, who), vector(value)
    return V((side.reach(a), *-a, a @ m.w * (who == "agent")))

def halves(m, read):
    form(len(read.normal) == len(m.w), "vectors of two sizes")
    for sub, sign in ((read.below, -1), (read.above, 1)):
        prove(replace(m, cuts=(*m.cuts, (read.normal, read.at, sign))), sub)

def vertices(m, read):
    """In integers: X = (x - p, 1) of corners x and forms H, times something above 0."""
    around = m.obstacle.named(read)
    p, matrices = m.obstacle.body.points(around)[0], []
    for rows in m.obstacle.body.forms(around):
        (entries,), _ = table(flat(rows))
        matrices.append([V(entries[i:i + len(rows)]) for i in range(0, len(entries), len(rows))])
    for k in m.agent.group:
        form(not any(skin.shape or skin.margin for skin, _ in m.agent.body.pieces[k]), f"piece {k} has no corners")
        points = [table([*(x - p), ONE])[0][0] for x, _ in m.agent.body.corners(k)]
        for rows in matrices:
            images = [-through(rows, x) for x in points]
            holds(never_negative([V(x @ y for y in images) for x in points]), f"piece {k} of the agent is in it")

def never_negative(m):
    """l^T M l, for all l >= 0: exactly, up to three; of more if no entry is below 0. The least value within the
    triangle of l of sum 1 is det M / sum(adj(M) 1), at adj(M) 1 over its sum, if that is within."""
    below = [(i, j) for i in range(len(m)) for j in range(i + 1) if m[i][j] < 0]
    if len(m) > 3 or any(i == j or m[i][j] ** 2 > m[i][i] * m[j][j] for i, j in below):
        return not below
    if len(below) < 2:
        return True
    adjoint = [cross_product(m[i - 2], m[i - 1]) for i in range(3)]
    return m[0] @ adjoint[0] >= 0 or not all(x > 0 for x in sum(adjoint, zero(3)))

def octants(m, read):
    form(len(m.w) == 3 and all(len(side.body.pieces) == 1 and not side.body.pieces[0][0][0].cuts for side in m.sides),
         "octants are for one convex piece each, in space")
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
            holds(most < 0, f"{say(most)} < 0 along n = {say(n)}")
    for bits, sub in enumerate(items(read.nodes, 8, 8)):
        node(sub, *(e * (-1 if bits >> i & 1 else 1) for i, e in enumerate(unit(3))))

def depends(m, read):
    for name, says in (("collides", "in"), ("passes", "out")):
        one = fields(getattr(read, name), name, "proof", "position velocity")
        changes = [one.position or m.w * 0, one.velocity or m.w * 0]
        for change, side in zip(changes, m.errors):
            holds(side or not any(change), f"{name}: an error is in its set")
            if side:
                side.contains(change, 0)
        agent = replace(m.agent, v=m.agent.v + changes[1])
        obstacle = replace(m.obstacle, body=m.obstacle.body.moved(changes[0]))
        prove(replace(m, says=says, agent=agent, obstacle=obstacle, errors=(None, None)), one.proof)

# Runs: positions and quaternions are forms.

def unturned(q, n):
    """(N(q)^T n, q.q) of forms q, or none: R = N(q) / q.q."""
    if not q:
        return n, ONE
    w, u = q[0], V(q[1:])
    return n * (w * w - u @ u) + u * (u @ n * 2) + cross_product(n, u) * (w * 2), w * w + u @ u

def track(value):
    read = fields(value, "a track", "times positions radius", "grid turns")
    read.grid = 0 if read.grid is None else index(read.grid, 1075, "grid")
    form(len(read.times) - 1 == len(read.positions) == len(read.turns or read.positions), "segments as of the times")
    form(all(a < b for a, b in zip(read.times, read.times[1:])), "the times of a track grow")
    form(all(len(p) == 3 for segment in read.positions for p in segment), "runs are in space")
    return read

def placed(its, start, end, after):
    """(P, a multiple of q or none) of a track from start to end, as forms; of segments that end after that time."""
    k = next((k for k, (a, b) in enumerate(zip(its.times, its.times[1:])) if a <= start and end <= b > after), None)
    holds(k is not None, f"the piece from {say(start)} to {say(end)} is in one segment of the track")
    part = [(t - its.times[k]) / (its.times[k + 1] - its.times[k]) for t in (start, end)]
    place, q = (V(bernstein(column).part(*part) for column in zip(*points))
                for points in (its.positions[k], its.turns[k] if its.turns else ()))
    return place * Fraction(1, 1 << its.grid), q

def run(read, proof, reader):
    """Of bodies on their tracks, in pairs."""
    says, apart = read.says, read.says == "apart"
    start, end = vars(read)["from"], read.to
    bodies, read.bodies = zip(*(reader.body(body, "a body") for body in read.bodies))
    form(len(bodies) == len(read.tracks), "each body has a track")
    form(all(len(body.rows[0]) == 3 and not body.quadrics() for body in bodies), "runs are in space, not of quadrics")
    holds(start < end and all(its.times[0] <= start and end <= its.times[-1] for its in read.tracks),
          "from < to, and tracks have all of it")
    pairs = [tuple(index(k, len(bodies), "a body") for k in items(pair, 2, 2))
             for pair in (items(read.pairs) if apart else [read.pair])]
    form(all(i < j for i, j in pairs) and len(set(pairs)) == len(pairs), "pairs are [i, j] with i < j, none twice")
    along, second = getattr(read, "along", 0), read.bodies[pairs[0][1]]
    form(says != "passed" or type(along) is int and abs(along) == 1 and second.kind == "wall" and not second.center,
         "passed: along is 1 or -1, the second body a wall about its origin")
    holds(not apart or type(proof) is dict and proof.get("rule") == "pairs", "pairs is the rule for 'apart'")
    proofs = fields(proof, "the proof", "rule pairs").pairs if apart else {f"{i} {j}": proof for i, j in pairs}
    form(type(proofs) is dict and set(proofs) == {f"{i} {j}" for i, j in pairs}, "a proof for each pair, no other")
    for i, j in pairs:
        sides = (Side(who, bodies[k], range(len(bodies[k].pieces)), track=read.tracks[k])
                 for who, k in (("agent", i), ("obstacle", j)))
        prove(Motion(says, *sides, start, end, getattr(read, "by", ZERO), along=along), proofs[f"{i} {j}"])

def instant(side, t, after):
    """placed() at a time, as numbers."""
    place, q = (V(a.start() for a in forms) for forms in placed(side.track, t, t, after))
    q = q or V((ONE, *zero(3)))
    holds(q @ q > 0, f"{side.who}: q.q > 0")
    return place, q

def passage(m, read):
    """Wholly on one side of the wall, then wholly on the other, apart from it all the time, and never as far from its
    middle as its edge is. So what is continuous goes through the hole."""
    prove(replace(m, says="apart"), read.proof)
    wide, up = sum(side.track.radius for side in m.sides), unit(3)[2]
    for t, sign in ((m.t0, -m.along), (m.t1, m.along)):
        (x, q), (p, its) = (instant(side, t, m.t0) for side in m.sides)
        n = unturned(V((its[0], *-V(its[1:]))), up * sign)[0]
        beyond = n @ (x - p) - m.agent.reach(unturned(q, -n)[0] * (1 / (q @ q)))
        holds(beyond > wide * (its @ its), f"wholly on a side at {say(t)}: {say(beyond)} > {say(wide * (its @ its))}")
    m.agent.within(read.reach)
    reach = read.room + read.reach + wide
    edge = [(a, b) for *_, a, b in map(m.obstacle.body.points, m.obstacle.group)]
    for a, b in edge:
        holds(reach ** 2 * ((a - b) @ (a - b)) <= cross_product(a, b)[2] ** 2, f"its edge is beyond {say(reach)}")
    times = sorted({m.t0, m.t1, *(t for side in m.sides for t in side.track.times if m.t0 < t < m.t1)})
    for start, end in zip(times, times[1:]):
        x, p = (placed(side.track, start, end, start)[0] for side in m.sides)
        holds((Form([read.room ** 2]) - (x - p) @ (x - p)).not_negative(), f"within {say(read.room)} from {say(start)}")
    for side, t in ((side, t) for side in m.sides for t in times[1:-1]):
        for x in [zero(3), *(flat(edge) if side is m.obstacle else [])]:  # a wall could turn over
            jump = at(x, *instant(side, t, m.t0)) - at(x, *instant(side, t, t))
            holds(jump @ jump <= (2 * side.track.radius) ** 2, f"{side.who}: no jump at {say(t)}")

def at(x, place, q):
    """Where a body's point x is."""
    return place + unturned(V((q[0], *-V(q[1:]))), x)[0] * (1 / (q @ q))

def chords(m, read):
    """The control points of the way are so near to the obstacle's core that all of the agent is in its margin."""
    k = m.obstacle.named(read)
    room = m.obstacle.body.pieces[k][0][0].margin - read.reach - sum(side.track.radius for side in m.sides)
    form(not m.obstacle.track.turns, "what it stays within does not turn")
    m.agent.within(read.reach)
    for start, end, means in steps(m, read.times, read.means):
        (x, q), (p, _) = (placed(side.track, start, end, start) for side in m.sides)
        holds(not q or (q @ q).positive(), f"agent: q.q is positive from {say(start)}")
        columns, scale = table(x - p)
        form(len(means) == len(columns), f"{len(columns)} control points from {say(start)}")
        for i, (column, weights) in enumerate(zip(columns, means)):
            off = column * Fraction(1, scale * comb(len(columns) - 1, i)) - m.obstacle.mean(k, weights)[0]
            holds(room >= 0 and off @ off <= room ** 2, f"control point {i} from {say(start)} is within {say(room)}")

def steps(m, times, each):
    """(start, end, what is given for it) of the pieces of time."""
    holds(times[0] == m.t0 and times[-1] == m.t1, "pieces from the start to the end")
    for a, b in zip(times, times[1:]):
        holds(b is None or a < b, f"times grow: {say(a)} < {say(b)}")
    form(len(each) == len(times) - 1, "one for each piece of time")
    return zip(times, times[1:], each)

def near(m, read):
    """A point of each at a time, and its depth: the ball of that radius is in its piece. Points are given as they are
    then, or as means of corners."""
    m.at(read.time)
    room, way = m.by, zero(3)
    for side, sign in zip(m.sides, (-1, 1)):
        own, weights, depth = (getattr(read, f"{side.who}_{name}") for name in ("point", "weights", "depth"))
        k, own, depth = side.named(read), own or read.point, depth or ZERO
        form(own or weights, f"{side.who}: a point or weights are missing")
        form(not depth or not side.body.pieces[k][0][0].cuts, f"{side.who}_depth: of what has no dents")
        place, q = instant(side, read.time, m.t0)
        x = unturned(q, own - place)[0] * (1 / (q @ q)) if own else side.mean(k, weights)[0]
        side.contains(x, k, weights, depth)
        for away in unit(3) if depth and not weights else ():  # the ball is within the octahedron of x +- 2 depth e_i
            side.contains(x + away * (2 * depth), k)
            side.contains(x - away * (2 * depth), k)
        way += (own or at(x, place, q)) * sign
        room += depth - side.track.radius
    holds(room >= 0 and way @ way <= room ** 2, f"{say(way)} is no longer than {say(room)}")

def pieces(m, read):
    for start, end, (n, length, *rest) in steps(m, read.times, read.planes):
        n, length, when = vector(n, 3), positive(length), f" from {say(start)} to {say(end)}"
        form(len(rest) != 3, "a plane is [n, length, l_A, l_B], and, if wanted, the multipliers of both")
        holds(length ** 2 >= n @ n, f"length >= |n|{when}")
        gap = Form([-length * (m.by + sum(side.track.radius for side in m.sides))])
        for side, n, limit, multipliers in zip(m.sides, (n, -n), rest, rest[2:] or ([], [])):
            place, q = placed(side.track, start, end, start)
            limit = bernstein([number(x) for x in items(limit, 1, 4)])
            side.at_most(n, limit, items(multipliers, 0) or None, q, when)
            gap = gap - n @ place - limit
        holds(gap.positive(), f"the gap is positive{when}")

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
    ("passed", "through", passage, "room reach proof", ""), ("stays", "chords", chords, "reach times means", ""),
    ("near meet", "point", near, "time", f"{WHERE} point agent_point obstacle_point agent_depth obstacle_depth"),
    ) for claim in claims.split()}
READERS = {  # of fields, by name; the others are read where they are used
    **dict.fromkeys("format says rule kind name sha256 of inside tree".split(), text),
    **dict.fromkeys(("level", "time", "at", "from", "to", *LEVELS), number),
    **dict.fromkeys("by radius margin ball cell extent room reach agent_depth obstacle_depth".split(), positive),
    **dict.fromkeys("center velocity low high n normal point position box agent_point obstacle_point".split(), vector),
    **dict.fromkeys("cuts agent_multipliers obstacle_multipliers".split(), several(number)),
    **dict.fromkeys("agent_weights obstacle_weights".split(), several(several(least=2, most=3))),
    **dict.fromkeys("proofs pieces bodies".split(), several()), "tracks": several(track), "times": several(number, 2),
    "factor": matrix, "matrix": symmetric, "shape": symmetric, "points": several(vector), "horizon": horizon,
    "means": several(several(several(several(least=2, most=3)))), "outline": several(lambda v: vector(v, 2, 2), 3),
    "matrices": several(lambda value: symmetric(value, 4)), "products": several(several(least=3, most=3), 0),
    "triangles": several(several(least=3, most=3)), "boxes": several(several(vector, 2, 2)),
    "delimiters": several(lambda value: fields(value, "a delimiter", "matrix level")),
    "parts": several(lambda value: fields(value, "a part", "center", "factor shape")),
    "position_error": errors, "velocity_error": errors, "runs": several(several(least=2, most=2)),
    "pair": several(least=2, most=2), "across_w": several(least=3, most=3), "planes": several(several(least=4, most=6)),
    "positions": several(several(vector, 1, 16)), "turns": several(several(lambda q: vector(q, 4, 4), 1, 16))}

# The program.

def say(value):
    """What was read, in full but for long lists, of which the digest is told."""
    if type(value) is Fraction:
        if max(value.numerator.bit_length(), value.denominator.bit_length()) > 14000:
            return "a number of more than 4000 digits"
        if 1 < value.denominator < 2 ** 1000 > abs(value.numerator) and Fraction(float(value)) == value:
            return repr(float(value))
        return str(value)
    if isinstance(value, (tuple, list)):
        inside = ", ".join(map(say, value))
        digest = hashlib.sha256(inside.encode()).hexdigest()
        return f"({inside})" if len(inside) < 2000 else f"({len(value)} items, SHA-256 of their text {digest})"
    if type(value) is SimpleNamespace:
        return "{" + ", ".join(f"{name} {say(x)}" for name, x in vars(value).items() if x is not None) + "}"
    return json.dumps(value)

def check(document, reader):
    """In words what is proved, or Malformed or Refused."""
    answer = document if type(document) is dict and "certificate" in document and "format" not in document else {}
    read = fields(answer.get("certificate", document), "a certificate", "format version claim proof")
    form(read.format == "vericone-certificate" and type(read.version) is int and read.version == 1,
         "the format must be vericone-certificate, version 1")
    says = read.claim.get("says") if type(read.claim) is dict else None
    form(type(says) is str and says in CLAIMS, f"`says` must be one of {', '.join(CLAIMS)}")
    words, needed, allowed = CLAIMS[says]
    claim = fields(read.claim, "the claim", f"says {needed}", f"id {allowed}")
    form(type(claim.id) in (str, int, float, type(None)), "id must be a text or a number")
    (run if "tracks" in needed else verdict)(claim, read.proof, reader)
    unsure = any(getattr(claim, name, None) for name in ERRORS)
    said = "robust" if unsure and "robust" in answer else "verdict"
    holds(answer.get(said, says) == says, f"the answer's {said!r} is {says}")
    words = "for any errors there is a common point at a time of the horizon" if unsure and says == "in" else words
    return f"{says}: {words}. {say(claim)}"

def decoded(data, most):
    """The JSON value; refused if reading it could take more memory than `most` bytes."""
    bytes_of = {b"{": 400, b"[": 200, b",": 200, b"#": 500}
    cost = 4 * len(data) + sum(most * data.count(sign) for sign, most in bytes_of.items())
    form(cost <= most, f"{cost} bytes of memory needed, {most} allowed (--memory)")
    return parsed(data.decode("utf-8"))

def texts(stream, most):
    """Of each JSON value of a file, one or one a line."""
    line = stream.readline(most // 4 + 1)
    try:
        decoded(line, most)
    except json.JSONDecodeError:
        line += stream.read(most // 4 + 1 - len(line))
    except FAULTS:
        pass  # told where it is checked
    yield line
    yield from iter(lambda: stream.readline(most // 4 + 1), b"")

def checked(stream, name, reader):
    """Prints a line for each certificate; the exit statuses that occurred."""
    statuses = set()
    for k, line in enumerate(filter(bytes.strip, texts(stream, reader.most)), 1):
        try:
            answer, status = f"accepted: {check(decoded(line, reader.most), reader)}", 0
        except Refused as wrong:
            answer, status = f"refused, this does not hold: {wrong}", 1
        except FAULTS as wrong:
            answer, status = f"no certificate: {str(wrong) or type(wrong).__name__}", 2
        print(f"{name}: {k}: {answer[:20000]}")
        statuses.add(status)
    if not statuses:
        print(f"{name}: no certificate: empty")
    return statuses or {2}

def main():
    options = argparse.ArgumentParser(description="Checks certificates. Exit status: 0 all are accepted, 1 one is "
                                      "refused, 2 one is no certificate.")
    options.add_argument("files", nargs="+", metavar="FILE", help="one certificate, or one a line; - standard input")
    options.add_argument("--bodies", metavar="DIR", help="where files of bodies are, if not beside the certificate")
    options.add_argument("--memory", type=int, default=190, metavar="MB", help="at most to use (190)")
    given, statuses = options.parse_args(), set()
    sys.stdout.reconfigure(errors="backslashreplace")
    for name in given.files:
        reader = Reader(given.bodies or os.path.dirname(name) or ".", (given.memory - 30) * 10 ** 6)
        try:
            with open(name, "rb") if name != "-" else sys.stdin.buffer as stream:
                statuses |= checked(stream, name, reader)
        except OSError as wrong:
            print(f"{name}: no certificate: {wrong.strerror}")
            statuses.add(2)
    return 1 if 1 in statuses else max(statuses)

if __name__ == "__main__":
    sys.exit(main())
