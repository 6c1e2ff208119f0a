// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies as quadrics in rational numbers, and rational numbers as doubles rounded to a known side.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>

namespace vericone::fitting {

/// (x - center)^T A (x - center) + constant as a symmetric matrix of homogeneous coordinates.
exact::RationalMatrix<4> quadric_about(const exact::RationalVector<3>& center,
                                       const exact::RationalMatrix<3>& a, const exact::Rational& constant);

/// S^{-1} of the shape matrix that defines the body; of an ellipse with rows and columns of zeros for z.
exact::RationalMatrix<3> inverse_shape(const Ellipsoid& body);
exact::RationalMatrix<3> inverse_shape(const Ellipse& body);

/// The centre; of an ellipse with z = 0.
exact::RationalVector<3> center_in_space(const Ellipsoid& body);
exact::RationalVector<3> center_in_space(const Ellipse& body);

/// x within some units in the last place; the least double that is not below x, and the greatest that is not
/// above it.
double nearly(const exact::Rational& x);
double rounded_up(const exact::Rational& x);
double rounded_down(const exact::Rational& x);
Interval enclosed(const exact::Rational& x);

}  // namespace vericone::fitting
