#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks certificates: vericone_check.py FILE... (`-` is the standard input). Python 3.10 or later, nothing else.

A file is one certificate, or one a line; docs/reference/certificates.md has the format, version 1. Printed is what is
proved, from what was read, or the first inequality that does not hold. Exit status: 0 all accepted, 1 one is refused,
2 one is no certificate (and none is refused).

All is computed with fractions and integers. What is proved is of a `Motion`, read from the claim alone; a proof is a
list of numbers that are tried on it. The parts: numbers and fields, algebra, bodies, claims, rules of verdicts, runs,
the program. The page says of each rule what it checks.
"""
import argparse
import hashlib
import json
import os
import re
import sys
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations_with_replacement, product
from math import comb, isqrt, lcm
from types import SimpleNamespace

class Malformed(Exception):
    """Not a certificate of this format."""
class Refused(Exception):
    """A certificate that does not prove its claim."""
def holds(true, inequality):
    if not true:
        raise Refused(inequality)
def form(true, complaint):
    if not true:
        raise Malformed(complaint)

# Numbers and fields. A reader takes a JSON value and returns what it means.

ZERO, ONE, LONGEST = Fraction(0), Fraction(1), 4300  # characters of a number

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
    if type(value) in (int, float, Fraction):
        return Fraction(value)
    form(type(value) is str and len(value) <= LONGEST and re.fullmatch("-?[0-9]+(/[0-9]+)?", value), "no number")
    top, _, bottom = value.partition("/")
    form(bottom == "" or int(bottom) > 0, "a denominator of 0")
    return Fraction(int(top), int(bottom or 1))
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
def vector(value):
    return V(map(number, items(value, 2, 3)))
def matrix(value):
    rows = [vector(row) for row in items(value, 2, 3)]
    form(all(len(row) == len(rows) for row in rows), "a matrix that is not square")
    return rows
def symmetric(value):
    form(matrix(value) == transposed(matrix(value)), "a matrix that is not symmetric")
    return matrix(value)
def horizon(value):
    start, end = items(value, 2, 2) if type(value) is list else (0, value)
    return positive(start), None if end is None else positive(end, positive(start))
def delimiter(value):
    return fields(value, "a delimiter", "matrix level")
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

# Algebra.

class V(tuple):
    """A vector; two must be of the same size."""
    def __add__(self, other):
        return V(x + y for x, y in zip(self, other, strict=True))
    def __sub__(self, other):
        return V(x - y for x, y in zip(self, other, strict=True))
    def __mul__(self, factor):
        return V(x * factor for x in self)
    def __neg__(self):
        return V(-x for x in self)
    def __matmul__(self, other):
        return sum(x * y for x, y in zip(self, other, strict=True))

def transposed(rows):
    return [V(column) for column in zip(*rows, strict=True)]
def through(rows, x):
    return V(row @ x for row in rows)
def zero(size):
    return V([ZERO] * size)
def diagonal(size, value):
    return [V(value if i == j else ZERO for j in range(size)) for i in range(size)]
def of_factor(rows):
    return [V(a @ b for b in rows) for a in rows]

def adjugate(m):
    """(adj M, det M) of a 2x2 or 3x3 matrix."""
    if len(m) == 2:
        (a, b), (c, d) = m
        return [V((d, -b)), V((-c, a))], a * d - b * c
    adjoint = [V(m[(j + 1) % 3][(i + 1) % 3] * m[(j + 2) % 3][(i + 2) % 3]
                 - m[(j + 1) % 3][(i + 2) % 3] * m[(j + 2) % 3][(i + 1) % 3] for j in range(3)) for i in range(3)]
    return adjoint, m[0] @ [row[0] for row in adjoint]

def positive_definite(rows):
    """Of a symmetric matrix, by elimination: whether all pivots are above 0."""
    rows = [V(map(Fraction, row)) for row in rows]
    for k, row in enumerate(rows):
        if row[k] <= 0:
            return False
        for i in range(k + 1, len(rows)):
            rows[i] = rows[i] - rows[k] * (rows[i][k] / row[k])
    return True

def spans(vectors, size):
    """Whether their rank is `size`, the size of each: the sum of their squares v v^T is then positive definite."""
    return positive_definite([sum((v * v[i] for v in vectors), zero(size)) for i in range(size)])

def root_above(q):
    """Not below sqrt(q), and above it by less than one part in 10^9."""
    shift = max(0, 64 + q.denominator.bit_length() - q.numerator.bit_length())
    return Fraction(isqrt((q.numerator << 2 * shift) // q.denominator) + 1, 1 << shift) if q else q

# Bodies. A body has `count` pieces; piece(k) is a body of one. tops(n, group) are pairs (base, q): the largest n.x of
# each piece of the group is base + sqrt(q), or less if delimited; curved(group) are the S of q = n^T S n, or None.

@dataclass
class Round:
    """{ x : y = x - p, y^T S^-1 y <= 1, y^T A y <= level for each delimiter }; of a ball S = radius^2 I."""
    p: V
    shape: list
    radius: object = None
    delimiters: tuple = ()
    count = 1

    @property
    def corners(self):
        return [self.p] if self.radius == 0 else None
    def piece(self, k):
        return self
    def tops(self, n, group):
        return [(n @ self.p, n @ through(self.shape, n))]
    def curved(self, group):
        return [self.shape]
    def forms(self):
        """(M, level) of each y^T M y <= level."""
        if self.radius is not None:
            return [(diagonal(len(self.p), ONE), self.radius ** 2)]
        adjoint, determinant = adjugate(self.shape)
        holds(determinant > 0, "det S > 0: the body is not flat")
        return [([row * (1 / determinant) for row in adjoint], ONE), *self.delimiters]
    def contains(self, x, less):
        y = x - self.p
        return all(less(y @ through(rows, y), level) for rows, level in self.forms())

@dataclass
class Grid:
    """Hulls, triangles, boxes or balls of one radius, by points p + row / scale with integers. Of each piece `pieces`
    has the numbers of its points; of a box these are its low and its high corner."""
    p: V
    scale: int
    rows: list
    pieces: list
    boxes: bool = False
    radius: object = None
    delimiters = ()

    @property
    def count(self):
        return len(self.pieces)
    def piece(self, k):
        return (replace(self, pieces=[self.pieces[k]]) if self.radius is None else
                ball(replace(self, radius=None, pieces=[self.pieces[k]]).corners[0], self.radius))
    @property
    def corners(self):
        """Of its only piece."""
        points = [self.p + V(Fraction(x, self.scale) for x in self.rows[i]) for i in self.pieces[0]]
        return points if not self.boxes else [
            V(points[bits >> i & 1][i] for i in range(len(self.p))) for bits in range(1 << len(self.p))]
    def tops(self, n, group):
        """The largest base of all, as they have one q."""
        unit = lcm(*(x.denominator for x in n))
        m = V(int(x * unit) for x in n)
        if self.boxes:
            ends = ((self.rows[i], self.rows[j]) for i, j in (self.pieces[k] for k in group))
            top = max(sum(x * (high if x > 0 else low) for x, low, high in zip(m, *both, strict=True))
                      for both in ends)
        else:
            top = max(m @ self.rows[i] for i in {i for k in group for i in self.pieces[k]})
        return [(n @ self.p + Fraction(top, unit * self.scale), (self.radius or 0) ** 2 * (n @ n))]
    def curved(self, group):
        return [self.radius and diagonal(len(self.p), self.radius ** 2)]
    def contains(self, x, less):
        form(self.boxes, "weights are missing")
        ends = zip(self.corners[0], x, self.corners[-1], strict=True)
        return all(less(low, y) and less(y, high) for low, y, high in ends)

@dataclass
class Union:
    parts: list

    @property
    def count(self):
        return len(self.parts)
    @property
    def p(self):
        return self.parts[0].p
    def piece(self, k):
        return self.parts[k].piece(0)
    def tops(self, n, group):
        return [self.parts[k].tops(n, (0,))[0] for k in group]
    def curved(self, group):
        return [self.parts[k].curved((0,))[0] for k in group]

def moved(body, by):
    return Union([moved(part, by) for part in body.parts]) if type(body) is Union else replace(body, p=body.p + by)
def ball(p, radius):
    return Round(p, diagonal(len(p), radius ** 2), radius)
def ellipsoid(read):
    form((read.factor is None) != (read.shape is None), "an ellipsoid has either factor or shape")
    form(read.factor or positive_definite(read.shape), "a shape that is not positive definite")
    cuts = tuple((cut.matrix, cut.level) for cut in getattr(read, "delimiters", ()))
    shape = of_factor(read.factor) if read.factor else read.shape
    return Round(zero(len(shape)), shape, None, cuts)
def grid(points, pieces, **more):
    scale = 1
    for x in {x.denominator for row in points for x in row}:
        scale = lcm(scale, x)
        form(scale.bit_length() < 20000, "points whose common denominator has more than 6000 digits")
    form(all(len(row) == len(points[0]) for row in points), "points of two sizes")
    return Grid(zero(len(points[0])), scale,
                [V(x.numerator * (scale // x.denominator) for x in row) for row in points], pieces, **more)
def boxes(ends):
    form(all(x >= 0 for low, high in ends for x in high - low), "a box with low > high")
    return grid([x for both in ends for x in both], [(2 * k, 2 * k + 1) for k in range(len(ends))], boxes=True)
def mesh(read):
    count = len(read.points)
    triangles = [tuple(index(i, count, "a triangle's point") for i in three) for three in read.triangles]
    return grid(read.points, triangles)

KINDS = {  # fields needed, fields allowed, and the body of what was read
    "ellipsoid": ("", "factor shape", ellipsoid), "delimited": ("delimiters", "factor shape", ellipsoid),
    "ball": ("center radius", "", lambda read: ball(read.center * 0, read.radius)),
    "hull": ("points", "", lambda read: grid(read.points, [tuple(range(len(read.points)))])),
    "box": ("low high", "", lambda read: boxes([(read.low, read.high)])), "mesh": ("points triangles", "", mesh),
    "cloud": ("points radius", "", lambda read: grid(read.points, [(k,) for k in range(len(read.points))],
                                                     radius=read.radius)),
    "boxes": ("boxes", "", lambda read: boxes(read.boxes)), "union": ("pieces", "", None),
    "file": ("name sha256", "", None)}

class Reader:
    """Reads bodies, and the files beside the certificate that have some."""
    def __init__(self, folder, most):
        self.folder, self.most, self.known = folder, most, (None, None)

    def body(self, value, what, more="", within=None):
        """(the body, what was read); `within` is the kind of body that this one is a part of."""
        kind = value.get("kind") if type(value) is dict else None
        form(type(kind) is str and kind in KINDS, f"{what}: kind must be one of {', '.join(KINDS)}")
        form(kind != "file" or within is None, f"{what}: no file within a {within}")
        form(within != "union" or kind in ("ellipsoid", "ball", "hull", "box", "delimited"), f"a {kind} in a union")
        needed, allowed, make = KINDS[kind]
        read = fields(value, what, f"kind {needed} {more}", f"center {allowed}")
        if kind == "file":
            found, read.body = self.body(self.file(read.name, read.sha256.lower()), what, within=kind)
        elif kind == "union":
            parts, read.pieces = zip(*(self.body(part, "a piece", within=kind) for part in read.pieces))
            found = Union(parts)
        else:
            found = make(read)
        return moved(found, read.center) if read.center else found, read

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
    body: object
    group: object
    v: object = None
    track: object = None

    def at_most(self, n, most, multipliers=None):
        """n.x <= most in these pieces."""
        if multipliers is not None:
            piece = self.body.piece(self.group[0])
            form(len(self.group) == 1 and type(piece) is Round, f"{self.who}: multipliers are of one round piece")
            (rows, level), r = weighted(piece.forms(), multipliers), most - n @ piece.p
            holds(r > 0 and level > 0, f"{self.who}: r = {say(r)} > 0, L = {say(level)} > 0")
            holds(positive_definite([(*row, x) for row, x in zip(rows, n)] + [(*n, r * r / level)]),
                  f"{self.who}: [[Q, n], [n, r^2 / L]] is positive definite")
            return
        for base, q in self.body.tops(n, self.group):
            holds(most >= base and q <= (most - base) ** 2,
                  f"{self.who}: {say(base)} + sqrt({say(q)}) <= {say(most)}")

    def piece(self, read):
        """The one that a proof names."""
        k = getattr(read, f"{self.who}_piece")
        form(k is not None or self.body.count == 1, f"{self.who}_piece is missing")
        k = 0 if k is None else index(k, self.body.count, f"{self.who}_piece")
        holds(k in self.group, f"{self.who}_piece is of its group")
        return self.body.piece(k)

    def contains(self, x, strictly, piece, weights=None):
        """x is a point of the piece: by its inequalities, or as the mean of corners."""
        if weights is None:
            return holds(piece.contains(x, (lambda a, b: a < b) if strictly else (lambda a, b: a <= b)),
                         f"{self.who}: the point is {'strictly ' * strictly}in it")
        own = piece.corners
        form(own, f"{self.who}_weights: the piece has no corners")
        corners = [own[index(k, len(own), "a corner")] for k, _ in weights]
        form(len({k for k, _ in weights}) == len(weights), f"{self.who}_weights: a corner twice")
        weights = [number(weight) for _, weight in weights]
        holds(all(weight > 0 for weight in weights) and sum(weights) == 1, f"{self.who}_weights > 0, of sum 1")
        holds(through(transposed(corners), weights) == x, f"{self.who}: the point is the mean of the corners")
        holds(not strictly or spans([x - corners[0] for x in corners], len(x)), f"{self.who}: corners span the space")

@dataclass
class Motion:
    """What a claim is about: two sides, times from t0 to t1 (None: without end), a distance, sets of errors."""
    a: Side
    b: Side
    t0: Fraction = ZERO
    t1: object = ZERO
    by: Fraction = ZERO
    errors: tuple = (None, None)  # Sides about 0: of the obstacle's position, of w
    cuts: tuple = ()  # of enclosing halves: (a, s, sign) with sign (a.y - s) >= 0, y = x - t v_B

    @property
    def w(self):
        return self.a.v - self.b.v
    def at(self, t):
        holds(self.t0 <= t and (self.t1 is None or t <= self.t1), f"time {say(t)} is within the horizon")
    def least(self, gap, speed):
        """Of gap - t speed."""
        holds(self.t1 is not None or speed <= 0, f"n.w = {say(speed)} <= 0, as the horizon has no end")
        return min(gap - t * speed for t in (self.t0, self.t1) if t is not None)

SAYS = {
    "out": "no common point at any time of the horizon", "in": "they meet within the horizon, not merely touching",
    "on": "they touch within the horizon, and no pieces overlap", "disjoint": "no common point",
    "overlapping": "they overlap", "touching": "they touch, and no pieces overlap",
    "depends": "some errors lead to a common point within the horizon, some to none",
    "inside": "each point of the agent is in the obstacle", "meet": "the two have a common point at a time",
    "apart": "no two points within the tubes of a pair are as near as `by` at any time",
    "in for all": "for any errors there is a common point at a time of the horizon"}
SAME = {"disjoint": "out", "overlapping": "in", "touching": "on"}

def set_of(name, read, origin):
    """A set of errors as a body about the origin, or None."""
    if read is None:
        return None
    if read.ball is not None:
        return Side(name, ball(origin, read.ball), (0,))
    return Side(name, boxes([(-read.box, read.box)]) if read.box else Round(origin, of_factor(read.factor)), (0,))

def verdict(claim, proof, reader):
    """(what is proved, what was read of the claim)."""
    says, moving = claim["says"], claim["says"] in ("out", "in", "on", "depends")
    read = fields(claim, "the claim", "says agent obstacle" + " horizon" * moving, "id" + " by" * (
        says in ("out", "disjoint")) + " position_error velocity_error" * (moving and says != "on"))
    sides = []
    for who in ("agent", "obstacle"):
        body, its = reader.body(getattr(read, who), who, "velocity" * moving)
        setattr(read, who, its)
        sides.append(Side(who, body, range(body.count), its.velocity if moving else body.p * 0))
    m = Motion(*sides, *(read.horizon if moving else ()), by=getattr(read, "by", None) or ZERO)
    m.errors = tuple(set_of(f"{name}_error", getattr(read, f"{name}_error", None), m.w * 0)
                     for name in ("position", "velocity"))
    rules = "in for all" if says == "in" and any(m.errors) else SAME.get(says, says)
    holds(prove(rules, m, proof) or rules != "on", "one of the groups touches")
    return rules if rules == "in for all" else says, read

# Rules of verdicts: what is to be proved, of which motion, and the proof.

def prove(says, m, proof):
    rule = proof.get("rule") if type(proof) is dict else None
    form(type(rule) is str, "a proof must have a rule")
    holds(rule in RULES[says], f"{rule[:20]!r} is a rule for {says!r}")
    return RULES[says][rule](says, m, proof)

def groups(says, m, proof):
    """For `on` it tells whether a part touches; others may be out."""
    read = fields(proof, "groups", "rule of runs proofs")
    form(read.of in ("agent", "obstacle"), "groups are of the agent or of the obstacle")
    name = "a" if read.of == "agent" else "b"
    group, first, parts, touched = getattr(m, name).group, 0, [[] for _ in read.proofs], False
    for k, count in read.runs:
        holds(index(count, len(group) - first + 1, "the count of a run") > 0, "runs have pieces")
        parts[index(k, len(parts), "the proof of a run")].append(group[first:first + count])
        first += count
    holds(first == len(group) and all(parts), f"the runs' {first} pieces are all {len(group)}, each proof has some")
    for part, sub in zip(parts, read.proofs):
        part = part[0] if len(part) == 1 else [k for run in part for k in run]
        its = "out" if says == "on" and type(sub) is dict and sub.get("rule") not in ("touch", "groups") else says
        touched = bool(prove(its, replace(m, **{name: replace(getattr(m, name), group=part)}), sub)) or touched
    return touched

def times(says, m, proof):
    read = fields(proof, "times", "rule cuts proofs")
    ends = [m.t0, *read.cuts, m.t1]
    form(len(read.proofs) == len(ends) - 1, "times have one proof more than cuts")
    for start, end, sub in zip(ends, ends[1:], read.proofs):
        holds(end is None or start < end, f"times grow: {say(start)} < {say(end)}")
        prove(says, replace(m, t0=start, t1=end), sub)

def weighted(forms_of_body, multipliers):
    """The sum of (M, level) with these multipliers."""
    multipliers = [number(x) for x in multipliers]
    form(len(multipliers) == len(forms_of_body), f"{len(forms_of_body)} multipliers are needed")
    holds(all(x >= 0 for x in multipliers), "multipliers >= 0")
    pairs = [(x, *one) for x, one in zip(multipliers, forms_of_body)]
    size = len(pairs[0][1])
    return ([sum((rows[i] * x for x, rows, _ in pairs), zero(size)) for i in range(size)],
            sum(x * level for x, _, level in pairs))

def plane(says, m, proof):
    holds(not m.cuts, "no plane within halves")
    bounded = type(proof) is dict and "agent_at_most" in proof
    more = [f"{side.who}_at_most" for side in m.errors if side] + ["agent_at_most", "obstacle_at_least"] * bounded
    read = fields(proof, "plane", " ".join(["rule", *more]),
                  "n across_w" + " agent_multipliers obstacle_multipliers" * bounded)
    form((read.n is None) != (read.across_w is None), "a plane has either n or across_w")
    n = read.n or across(m.w, *read.across_w)
    speed = n @ m.w
    if not bounded:  # the gap above the sum of two roots, by squaring twice
        form(not m.by and not any(m.errors), "a plane with `by` or errors has agent_at_most and obstacle_at_least")
        for (a, qa), (b, qb) in product(largest(m.a, n), largest(m.b, -n)):
            f = m.least(-a - b, speed)
            g = f * f - qa - qb
            holds(f > 0 and g > 0, f"f = {say(f)} > 0, G = {say(g)} > 0")
            holds(g * g > 4 * qa * qb, f"G^2 = {say(g * g)} > 4 q_A q_B = {say(4 * qa * qb)}")
        return
    m.a.at_most(n, read.agent_at_most, read.agent_multipliers)
    m.b.at_most(-n, -read.obstacle_at_least, read.obstacle_multipliers)
    more = [side and number(getattr(read, f"{side.who}_at_most")) for side in m.errors]
    for side, most in zip(m.errors, more):
        if side:
            side.at_most(n, most)
    gap = m.least(read.obstacle_at_least - read.agent_at_most - (more[0] or 0), speed + (more[1] or 0))
    holds(gap > 0 and (not m.by or gap ** 2 > m.by ** 2 * (n @ n)), f"the gap {say(gap)} > {say(m.by)} |n|, and > 0")

def largest(side, n):
    """(base, q) with the largest base of each q."""
    found = {}
    for base, q in side.body.tops(n, side.group):
        found[q] = max(base, found.get(q, base))
    return [(base, q) for q, base in found.items()]

def across(w, k, a, b):
    form(len(w) == 3, "across_w is for space")
    i, j = (axis for axis in range(3) if axis != index(k, 3, "the axis of across_w"))
    holds(w[k] != 0, f"w[{k}] != 0")
    n = {i: number(a) * w[k], j: number(b) * w[k], k: -number(a) * w[i] - number(b) * w[j]}
    return V(n[axis] for axis in range(3))

WHERE = "agent_piece obstacle_piece agent_weights obstacle_weights"

def touch(says, m, proof):
    read = fields(proof, "touch", "rule n time point", WHERE)
    m.at(read.time)
    holds(any(read.n), "n != 0")
    for side, n in ((m.a, read.n), (m.b, -read.n)):
        x = read.point - side.v * read.time
        side.contains(x, False, side.piece(read), getattr(read, f"{side.who}_weights"))
        side.at_most(n, n @ x)
    speed = read.n @ m.w
    holds(speed == 0 or (speed > 0 and read.time == m.t1) or (speed < 0 and read.time == m.t0),
          f"n.w = {say(speed)} is 0, or they touch at that end of the horizon")
    return True

def point(says, m, proof):
    read = fields(proof, "point", "rule time point inside", WHERE)
    form(read.inside in ("agent", "obstacle"), "inside must be agent or obstacle")
    m.at(read.time)
    for side in (m.a, m.b):
        side.contains(read.point - side.v * read.time, read.inside == side.who, side.piece(read),
                      getattr(read, f"{side.who}_weights"))

def cross(says, m, proof):
    read = fields(proof, "cross", "rule time pairs", "agent_piece obstacle_piece")
    m.at(read.time)
    a, b = m.a.piece(read).corners, m.b.piece(read).corners
    form(a and b, "cross is for pieces with corners")
    pairs = [items(pair, 3, 3) for pair in items(read.pairs)]
    ways = [b[index(j, len(b), "a corner")] - a[index(i, len(a), "a corner")] for i, j, _ in pairs]
    weights = [number(s) for _, _, s in pairs]
    holds(all(s > 0 for s in weights), "weights > 0")
    holds(not any(through(transposed(ways), weights) - m.w * (read.time * sum(weights))), "sum s (d - t w) = 0")
    if not spans([way - ways[0] for way in ways], len(m.w)):
        holds(spans(ways, len(m.w)), "the pairs span the space")
        holds(m.t0 < read.time and (m.t1 is None or read.time < m.t1), "t0 < t < t1")

def forms(says, m, proof):
    read = fields(proof, "forms", "rule agent obstacle", "products")
    form(len(m.a.group) == len(m.b.group) == 1 and not m.by and not any(m.errors),
         "forms are of one piece each, and prove no distance and nothing of errors")
    pieces, size = [side.body.piece(side.group[0]) for side in (m.a, m.b)], len(m.w)
    total = [zero(size + 2) for _ in range(size + 2)]  # of (1, x - t v_B, t)
    for piece, multipliers, v in zip(pieces, (read.agent, read.obstacle), (m.w, m.w * 0)):
        if type(piece) is Grid:
            form(multipliers == [], "multipliers of forms are of round bodies")
            continue
        rows, level = weighted(piece.forms(), items(multipliers))
        columns = [-piece.p, *diagonal(size, ONE), -v]  # y is the sum of these times (1, x - t v_B, t)
        total = [line + V(column @ through(rows, other) for other in columns)
                 for line, column in zip(total, columns)]
        total[0] = total[0] - V((level, *zero(size + 1)))
    for one in [] if read.products is None else items(read.products, 0):
        first, second, factor = items(one, 3, 3)
        a, b, factor = linear(m, first, pieces), linear(m, second, pieces), positive(factor)
        total = [line - (b * a[i] + a * b[i]) * (factor / 2) for i, line in enumerate(total)]
    if not any(m.w) or m.t0 == m.t1:  # t is t0, no variable
        total = [V((line[0] + m.t0 * line[-1], *line[1:-1])) for line in total]
        total = [total[0] + total[-1] * m.t0, *total[1:-1]]
    holds(positive_definite(total), "the sum of the forms is positive definite")

def linear(m, name, pieces):
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
    corners, a = pieces[who == "obstacle"].corners, vector(value)
    form(corners, f"the {who} has no corners")
    return V((max(a @ x for x in corners), *-a, a @ m.w * (who == "agent")))

def halves(says, m, proof):
    read = fields(proof, "halves", "rule normal at below above")
    form(len(read.normal) == len(m.w), "vectors of two sizes")
    for sub, sign in ((read.below, -1), (read.above, 1)):
        prove(says, replace(m, cuts=(*m.cuts, (read.normal, read.at, sign))), sub)

def vertices(says, m, proof):
    around = m.b.piece(fields(proof, "vertices", "rule", "obstacle_piece"))
    for k in m.a.group:
        corners = m.a.body.piece(k).corners
        form(corners, f"piece {k} of the agent has no corners")
        for x in corners:
            m.b.contains(x, False, around)
        for rows, level in around.delimiters:
            for u, v in combinations_with_replacement([x - around.p for x in corners], 2):
                holds(u @ through(rows, v) <= level, f"u A v <= level, of corners of piece {k}")

def octants(says, m, proof):
    read, sides = fields(proof, "octants", "rule nodes"), (m.a, m.b)
    pieces = [side.body.piece(0) for side in sides]
    form(len(m.w) == 3 and m.a.body.count == m.b.body.count == 1 and not any(piece.delimiters for piece in pieces),
         "octants are for one convex piece each, in space")

    def member(value, side, piece):
        if type(value) is list:
            side.contains(vector(value), False, piece)
            return vector(value)
        own = piece.corners
        form(own, f"the {side.who} has no corners")
        return own[index(value, len(own), "a corner")]

    def node(value, n1, n2, n3):
        if type(value) is list and len(value) == 4:
            m12, m23, m31 = n1 + n2, n2 + n3, n3 + n1
            for sub, corners in zip(value, ((n1, m12, m31), (m12, n2, m23), (m31, m23, n3), (m12, m23, m31))):
                node(sub, *corners)
            return
        t, *points = items(value, 3, 3)
        t = number(t)
        m.at(t)
        a, b = map(member, points, sides, pieces)
        for n in (n1, n2, n3):
            most = n @ (b - a - m.w * t)
            for factor, side in zip((1, t), m.errors):
                for base, q in side.body.tops(n, (0,)) if side else ():
                    most += factor * (base + root_above(q))
            holds(most < 0, f"{say(most)} < 0 along n = {say(n)}")

    for bits, sub in enumerate(items(read.nodes, 8, 8)):
        node(sub, *(row * (-1 if bits >> i & 1 else 1) for i, row in enumerate(diagonal(3, ONE))))

def depends(says, m, proof):
    read = fields(proof, "errors", "rule collides passes")
    for name, rules in (("collides", "in"), ("passes", "out")):
        one = fields(getattr(read, name), name, "proof", "position velocity")
        changes = [one.position or m.w * 0, one.velocity or m.w * 0]
        for change, side in zip(changes, m.errors):
            holds(side or not any(change), f"{name}: an error is in its set")
            if side:
                side.contains(change, False, side.body.piece(0))
        a, b = replace(m.a, v=m.a.v + changes[1]), replace(m.b, body=moved(m.b.body, changes[0]))
        prove(rules, replace(m, a=a, b=b, errors=(None, None)), one.proof)

# Runs. A form is a list of coefficients c_k of sum c_k sigma^(N-k) tau^k, tau from 0 to 1, sigma = 1 - tau.

def mul(a, b):
    found = [0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            found[i + j] += x * y
    return found
def raised(a, size):
    return mul(a, [comb(size - len(a), k) for k in range(size - len(a) + 1)]) if size > len(a) else a
def plus(*summands):
    size = max(map(len, summands))
    return [sum(column) for column in zip(*(raised(a, size) for a in summands))]
def times_number(a, factor):
    return [factor * x for x in a]
def bernstein(coefficients):
    return [comb(len(coefficients) - 1, k) * x for k, x in enumerate(coefficients)]
def not_negative(a):
    return all(x >= 0 for x in a)
def integers(numbers, scale=None):
    """(these times a scale, the scale), of their common denominator if none is given."""
    scale = scale or lcm(*(x.denominator for x in numbers))
    return [x.numerator * (scale // x.denominator) for x in numbers], scale

def restricted(a, start, end, unit):
    """The form with integers on the part of its interval from start / unit to end / unit, times unit^degree."""
    result, power = [], [1]
    for x in a:
        result = plus(mul(result, [unit - start, unit - end]) if result else [0], times_number(power, x))
        power = mul(power, [start, end])
    return result

def unturned(q, n):
    """(N(q)^T n, q.q) of forms q: R = N(q) / q.q."""
    w, x, y, z = q
    ww, xx, yy, zz = (mul(a, a) for a in q)
    wx, wy, wz, xy, xz, yz = (times_number(mul(a, b), 2) for a, b in ((w, x), (w, y), (w, z), (x, y), (x, z), (y, z)))
    less = [times_number(a, -1) for a in (ww, xx, yy, zz, wx, wy, wz)]
    rows = ((plus(ww, xx, less[2], less[3]), plus(xy, less[6]), plus(xz, wy)),
            (plus(xy, wz), plus(ww, less[1], yy, less[3]), plus(yz, less[4])),
            (plus(xz, less[5]), plus(yz, wx), plus(ww, less[1], less[2], zz)))
    return [plus(*(times_number(rows[i][j], n[i]) for i in range(3))) for j in range(3)], plus(ww, xx, yy, zz)

def track(value):
    read = fields(value, "a track", "times positions radius", "grid turns")
    read.grid = 0 if read.grid is None else index(read.grid, 1075, "grid")
    form(len(read.times) - 1 == len(read.positions) == len(read.turns or read.positions), "segments as the times have")
    form(all(a < b for a, b in zip(read.times, read.times[1:])), "the times of a track grow")
    form(all(len(p) == 3 for segment in read.positions for p in segment), "runs are in space")
    return read

def motion_of(its, start, end, after):
    """(P, a multiple of q) of a track from start to end, as forms; of segments that end after that time."""
    k = next((k for k, (a, b) in enumerate(zip(its.times, its.times[1:])) if a <= start and end <= b > after), None)
    holds(k is not None, f"the piece from {say(start)} to {say(end)} is in one segment of the track")
    span = its.times[k + 1] - its.times[k]
    (start, end), unit = integers([(start - its.times[k]) / span, (end - its.times[k]) / span])
    segment = its.positions[k], its.turns[k] if its.turns else [[ONE, ZERO, ZERO, ZERO]]
    columns = [bernstein(column) for points in segment for column in zip(*points)]
    scale = lcm(*(x.denominator for column in columns for x in column))
    found = [restricted(integers(column, scale)[0], start, end, unit) for column in columns]
    scale <<= its.grid
    return [[Fraction(x, scale * unit ** (len(a) - 1)) for x in a] for a in found[:3]], found[3:]

def run(claim, proof, reader):
    """(what is proved, what was read of the claim)."""
    says = claim["says"]
    apart = says == "apart"
    read = fields(claim, "the claim", "says from to bodies tracks" + (" by pairs" if apart else " pair"), "id")
    start, end = vars(read)["from"], read.to
    bodies, read.bodies = zip(*(reader.body(body, "a body") for body in read.bodies))
    form(len(bodies) == len(read.tracks), "each body has a track")
    holds(start < end and all(its.times[0] <= start and end <= its.times[-1] for its in read.tracks),
          "from < to, and tracks have all of it")
    pairs = [tuple(index(k, len(bodies), "a body") for k in items(pair, 2, 2))
             for pair in (items(read.pairs) if apart else [read.pair])]
    form(all(i < j for i, j in pairs) and len(set(pairs)) == len(pairs), "pairs are [i, j] with i < j, none twice")
    whole = fields(proof, "the proof", *(("rule pairs",) if apart else ("rule time point", WHERE)))
    holds(whole.rule == ("pairs" if apart else "point"), f"a rule for {says!r}")
    names = [f"{i} {j}" for i, j in pairs]
    form(not apart or type(whole.pairs) is dict and set(whole.pairs) == set(names), "a proof for each pair is missing")
    for (i, j), name in zip(pairs, names):
        m = Motion(*(Side(who, bodies[k], range(bodies[k].count), track=read.tracks[k])
                     for who, k in (("agent", i), ("obstacle", j))), start, end, getattr(read, "by", ZERO))
        if apart:
            prove(says, m, whole.pairs[name])
        else:
            meet(m, whole)
    return says, read

def meet(m, proof):
    m.at(proof.time)
    for side in (m.a, m.b):
        holds(side.track.radius == 0, "radius = 0")
        place, q = motion_of(side.track, proof.time, proof.time, m.t0)
        turned, square = unturned([a[:1] for a in q], proof.point - V(a[0] for a in place))
        holds(square[0] > 0, "q.q > 0")
        side.contains(V(a[0] / square[0] for a in turned), False, side.piece(proof),
                      getattr(proof, f"{side.who}_weights"))

def pieces(says, m, proof):
    read = fields(proof, "pieces", "rule times planes")
    holds(read.times[0] == m.t0 and read.times[-1] == m.t1, "pieces from the start to the end")
    form(len(read.planes) == len(read.times) - 1, "a plane for each piece")
    for start, end, (n, length, *limits) in zip(read.times, read.times[1:], read.planes):
        holds(start < end, f"times grow: {say(start)} < {say(end)}")
        n, length, when = vector(n), positive(length), f"from {say(start)} to {say(end)}"
        form(len(n) == 3, "runs are in space")
        limits = [bernstein([number(x) for x in items(limit, 1, 4)]) for limit in limits]
        holds(length ** 2 >= n @ n, f"length >= |n| {when}")
        gap = [[-length * (m.by + m.a.track.radius + m.b.track.radius)]]
        for side, n, limit in zip((m.a, m.b), (n, -n), limits):
            place, q = motion_of(side.track, start, end, start)
            bound(side, q, n, limit, when)
            gap += [times_number(a, -x) for x, a in zip(n, place)] + [times_number(limit, -1)]
        gap = plus(*gap)
        holds(not_negative(gap) and gap[0] > 0 and gap[-1] > 0, f"the gap is positive {when}")

def bound(side, q, n, limit, when):
    """n.R b <= limit for the points b of these pieces."""
    n, unit = integers(n)  # all by one factor, as that of q is of no matter either
    turned, square = unturned(q, n)
    holds(not_negative(square) and square[0] > 0 and square[-1] > 0, f"q.q is positive {when}")
    limit = mul(times_number(limit, unit), square)
    tops = [side.body.tops(V(c), side.group) for c in zip(*(raised(a, len(limit)) for a in turned))]
    for k, shape in enumerate(side.body.curved(side.group)):
        r = [most - top[k][0] for most, top in zip(limit, tops)]
        holds(not_negative(r), f"{side.who}: l q.q - n.N(q) p is not negative {when}")
        if shape:
            r, scale = integers(r, lcm(*(x.denominator for x in (*r, *(x for row in shape for x in row)))))
            squares = (times_number(mul(turned[i], turned[j]), -int(shape[i][j] * scale * scale))
                       for i in range(3) for j in range(3))
            holds(not_negative(plus(mul(r, r), *squares)),
                  f"{side.who}: r^2 - |F^T N(q)^T n|^2 is not negative {when}")

RULES = {"out": {"plane": plane, "groups": groups, "times": times, "forms": forms, "halves": halves},
         "in": {"point": point, "cross": cross}, "on": {"touch": touch, "groups": groups},
         "inside": {"vertices": vertices, "groups": groups}, "in for all": {"octants": octants},
         "depends": {"errors": depends}, "apart": {"pieces": pieces, "groups": groups}}
READERS = {  # of fields, by name; the others are read where they are used
    **dict.fromkeys("format says rule kind name sha256 of inside".split(), text),
    **dict.fromkeys("level time at from to agent_at_most obstacle_at_least".split(), number),
    **dict.fromkeys("by radius ball".split(), positive),
    **dict.fromkeys("center velocity low high n normal point position box".split(), vector),
    **dict.fromkeys("cuts agent_multipliers obstacle_multipliers".split(), several(number)),
    "times": several(number, 2),
    **dict.fromkeys("proofs pieces bodies".split(), several()), "tracks": several(track),
    **dict.fromkeys("runs agent_weights obstacle_weights".split(), several(several(most=2, least=2))),
    "factor": matrix, "matrix": symmetric, "shape": symmetric, "points": several(vector), "horizon": horizon,
    "triangles": several(several(least=3, most=3)), "boxes": several(several(vector, 2, 2)),
    "delimiters": several(delimiter), "position_error": errors, "velocity_error": errors,
    "across_w": several(least=3, most=3), "planes": several(several(least=4, most=4)),
    "positions": several(several(vector, 1, 16)),
    "turns": several(several(lambda q: [number(x) for x in items(q, 4, 4)], 1, 16))}

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
    form(type(says) is str and says in SAYS and " " not in says, f"`says` must be one of {', '.join(SAYS)}")
    proved, claim = (run if says in ("apart", "meet") else verdict)(read.claim, read.proof, reader)
    form(type(getattr(claim, "id", None)) in (str, int, float, type(None)), "id must be a text or a number")
    holds(answer.get("verdict", says) == says, f"the answer's verdict is that of its certificate, {says}")
    return f"{says}: {SAYS[proved]}. {say(claim)}"

def decoded(data, most):
    """The JSON value; refused if reading it could take more memory than `most` bytes."""
    cost = 4 * len(data) + 400 * data.count(b"{") + 200 * data.count(b"[") + 200 * data.count(b",")
    form(cost <= most, f"{cost} bytes of memory needed, {most} allowed (--memory)")
    return parsed(data.decode("utf-8"))

def documents(stream, most):
    """A reader of each JSON value of a file: one, or one a line."""
    longest = most // 4 + 1
    line = stream.readline(longest)
    try:
        decoded(line, most)
    except json.JSONDecodeError:
        line += stream.read(longest - len(line))
    except (Malformed, ValueError, RecursionError, MemoryError):
        pass  # told where the line is asked for
    while line:
        if line.strip():
            yield lambda line=line: decoded(line, most)
        line = stream.readline(longest)

def checked(stream, name, reader):
    """Prints a line for each certificate; the exit statuses that occurred."""
    seen, statuses = 0, set()
    for seen, document in enumerate(documents(stream, reader.most), 1):
        try:
            answer, status = f"accepted: {check(document(), reader)}", 0
        except Refused as wrong:
            answer, status = f"refused, this does not hold: {wrong}", 1
        except (Malformed, ValueError, RecursionError, MemoryError) as wrong:
            answer, status = f"no certificate: {str(wrong) or type(wrong).__name__}", 2
        print(f"{name}: {seen}: {answer[:20000]}")
        statuses.add(status)
    if not seen:
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
