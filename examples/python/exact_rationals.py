# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that no double holds: fractions reach the predicates as they are."""
from fractions import Fraction

import vericone as vc

third = Fraction(1, 3)
identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
a = vc.exact.RationalBody3([0, 0, 0], identity)  # centre, shape matrix S
b = vc.exact.RationalBody3([third * 10, 0, 0], identity)
# Balls of radius 1, their centres 10/3 m apart: w grazes where sin = 2 / (10/3) = 3/5, so along (4, 3, 0).
graze = [Fraction(4), Fraction(3), Fraction(0)]
tiny = Fraction(1, 10**100)
for step in (Fraction(0), -tiny, tiny):
    print(vc.exact.membership(a, b, [graze[0], graze[1] + step, graze[2]]))
assert vc.exact.membership(a, b, graze) == vc.Membership.on
assert vc.exact.membership(a, b, [4, 3 - tiny, 0]) == vc.Membership.in_
assert vc.exact.membership(a, b, [4, 3 + tiny, 0]) == vc.Membership.out
