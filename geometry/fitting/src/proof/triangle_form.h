// SPDX-License-Identifier: BSD-3-Clause
//
// The greatest value of a quadratic function on a triangle, from the matrix C of its polar forms at the
// corners: the value at the point with barycentric coordinates l is l^T C l.
//
// It is at a corner, or inside an edge along which the function is concave, or inside the triangle where it
// is concave on its plane. With M = -C, "nowhere positive" is "M is copositive", decided by signs of
// polynomials:
//  1. corners: M_ii >= 0;
//  2. edges: a l^2 + 2 b l m + c m^2 >= 0 for all l, m >= 0 if and only if b >= 0 or b^2 <= a c;
//  3. inside, the edges being right. A negative least value would be attained inside only, where M l = v 1, v
//     < 0 the value; and the form would be positive definite on the differences of such l (a direction
//     without curvature would lead to an edge at the same value). In the basis (1,0,-1), (0,1,-1) its
//     determinant is s = 1^T adj(M) 1, so that s > 0 and M_00 - 2 M_02 + M_22 > 0; from M l = v 1 follow
//     l = adj(M) 1 / s > 0 and v = det M / s, so that det M < 0. Conversely these signs are that of such a
//     point.
// With at most one entry off the diagonal negative, 2 suffices: the form is then that of an edge and products
// that are not negative.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <array>

namespace vericone::fitting {

/// What is known of the statement "nowhere positive on the triangle".
enum class Known : char { yes, no, unsure };

/// Given that it is not positive at the corners. C by intervals, or by integers up to a positive factor: then
/// never unsure.
Known not_positive(const std::array<std::array<Interval, 3>, 3>& c);
Known not_positive(const exact::IntegerMatrix<3>& c);

/// The greatest value, exactly.
exact::Rational greatest_value(const exact::RationalMatrix<3>& c);

}  // namespace vericone::fitting
