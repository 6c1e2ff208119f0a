// SPDX-License-Identifier: BSD-3-Clause
#include "ellipsoids/containment.h"

namespace vericone::exact {
namespace {

/// Where the largest root of a polynomial lies against one; all roots are real and the leading coefficient is
/// positive. By the signs of all derivatives at one (Budan and Fourier): -1 below, 0 at, 1 above.
int largest_root_against_one(Polynomial p) {
  bool zero = false;
  for (; p.size() > 1; p = derivative(p)) {
    Integer value = 0;
    for (const Integer& x : p) value += x;
    if (value.sign() < 0) return 1;
    zero = zero || value == 0;
  }
  return zero ? 0 : -1;
}

}  // namespace

Containment containment(const Polynomial& whole, const Polynomial& pencil, bool concentric) {
  const int largest = largest_root_against_one(pencil);
  if (largest > 0) return Containment::outside;
  if (concentric) return largest < 0 ? Containment::inside : Containment::touching;
  if (largest == 0) return Containment::outside;
  // P(1) < 0 and P has no root beyond one, at most two beyond the pencil's largest, s*. The weights that
  // prove containment are those of [s*, 1] with P >= 0, an interval.
  RealRoot pole = positive_roots(pencil).back();
  std::vector<RealRoot> roots = positive_roots(whole);
  std::size_t beyond = 0;
  while (beyond < roots.size() && compare(roots[roots.size() - 1 - beyond], pole) > 0) ++beyond;
  if (beyond >= 2) return Containment::inside;
  if (beyond == 1)
    return multiplicity(roots.back(), whole) % 2 == 0 ? Containment::touching : Containment::inside;
  // Only the pole itself is left: P / det has a zero there iff c lies in the range of s* S_B - S_A and the
  // remaining inequality is an equality.
  return multiplicity(pole, whole) > multiplicity(pole, pencil) ? Containment::touching
                                                                : Containment::outside;
}

Containment containment(const Symmetric2<Integer>& a, const Symmetric2<Integer>& b,
                        const Symmetric2<Integer>& c) {
  const auto mixed = [](const Symmetric2<Integer>& x, const Symmetric2<Integer>& y) {
    return Integer(x.a * y.c + x.c * y.a - 2 * x.b * y.b);
  };
  const Integer det_a = a.a * a.c - a.b * a.b, det_b = b.a * b.c - b.b * b.b, ab = mixed(a, b);
  const Integer ea = mixed(a, c), eb = mixed(b, c);
  // (1-s)(det_b s^2 - ab s + det_a) - s (s eb - ea)
  Polynomial whole(4), pencil(3);
  whole[0] = pencil[0] = det_a;
  whole[1] = ea - ab - det_a;
  whole[2] = det_b + ab - eb;
  whole[3] = -det_b;
  pencil[1] = -ab;
  pencil[2] = det_b;
  return containment(whole, pencil, c.a == 0 && c.c == 0);
}

}  // namespace vericone::exact
