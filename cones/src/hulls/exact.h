// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of the predicates of hulls: the same search in integers, which ends and is never wrong.
#pragma once

#include <vericone/cones/answers.h>
#include <cstdint>
#include <vector>

#include "hulls/scene.h"

namespace vericone::exact {

/// Where the origin lies with regard to the image of K.
enum class OriginIn : std::uint8_t { interior, boundary, outside };

/// Rows of a linear map of space to D dimensions.
template <int D>
using Rows = std::array<IntegerVector<3>, D>;

/// The pair with the least n.(b - a), exactly; linear in the number of points.
struct ExactSupport {
  HullPair pair;
  Integer value;
};
ExactSupport exact_support(const HullScene& scene, const IntegerVector<3>& n);

/// What shows where the origin lies: the point of the points' hull that is nearest to it, by weights > 0 up
/// to a common factor; and, unless it is in the interior, a normal in space with n.x >= 0 on all of K.
struct Shown {
  std::vector<HullPair> pairs;
  std::vector<Integer> weights;
  IntegerVector<3> normal{0, 0, 0};
};

/// Position of the origin in the image of K under `rows` (linearly independent; D = 2 or 3). `start`: pairs
/// to start the search from, may be empty. Where it is outside, `normal` becomes a normal in space with n.x >
/// 0 on all of K.
template <int D>
OriginIn origin_in_image(const HullScene& scene, const Rows<D>& rows, const std::vector<HullPair>& start,
                         IntegerVector<3>* normal, Shown* shown = nullptr);

/// Where the origin lies with regard to K; of a stretch: whether the bodies overlap on it, only touch, or
/// stay apart.
Relation relation(const HullScene& scene);

/// Whether n.x > 0 on all of K.
bool separates(const HullScene& scene, const IntegerVector<3>& n);

/// L x = (w_k x_i - w_i x_k, w_k x_j - w_j x_k) for a w_k != 0; its kernel is the line of w != 0.
Rows<2> shadow_rows(const IntegerVector<3>& w);

}  // namespace vericone::exact
