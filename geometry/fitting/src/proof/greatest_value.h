// SPDX-License-Identifier: BSD-3-Clause
//
// The greatest value of a quadratic function on what a piece is to contain.
#pragma once

#include <vericone/fitting/hull.h>
#include <cstdint>
#include <vector>

#include "proof/quadratic_form.h"

namespace vericone::fitting {

/// Of one piece.
struct Contents {
  std::vector<std::uint32_t> points;     // with balls about them
  std::vector<std::uint32_t> triangles;  // all of each
  std::vector<std::uint32_t> corners;    // of the triangles, as far as they are not among the points

  bool empty() const { return points.empty() && triangles.empty(); }
};

/// Not below it. Without a radius the least such double, unless hundreds of points or triangles are within
/// the roundings of intervals of the greatest: then some of those roundings above. With a radius: of balls
/// about the points (BallBound), some roundings above. Minus infinity for empty contents. Throws InputError
/// naming "margin" where intervals find no bound for a ball.
double greatest_value(const QuadraticForm& form, const Sample& sample, const Contents& contents,
                      double radius);

}  // namespace vericone::fitting
