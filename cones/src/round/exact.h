// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of the questions about two bodies that are hulls of round pieces, in whole numbers on one
// grid (docs/explanation/shapes.md). Verdicts of rays are decided at every touch.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <optional>
#include <vector>

namespace vericone::round {

/// { center + F x : |x| <= 1 } with shape = F F^T, symmetric and positive semidefinite; 0 for a point.
struct ExactPiece {
  exact::IntegerVector<3> center;
  exact::IntegerMatrix<3> shape{};
};

/// The hull of the pieces, at least one. In all questions `margin` >= 0 is that of both bodies together: the
/// difference obstacle - agent is swollen by a ball of that radius. Directions are of any length but 0.
struct ExactBody {
  std::vector<ExactPiece> pieces;
};

/// Whether a plane with the normal n, which points from the agent to the obstacle, parts them strictly.
[[nodiscard]] bool separates(const ExactBody& agent, const ExactBody& obstacle, const exact::Integer& margin,
                             const exact::IntegerVector<3>& n);

/// Whether the agent, moving along w forwards or backwards, meets the obstacle: `in` where the origin is in
/// the interior of the image of obstacle - agent along w, `on` where it is on the boundary. Always decided.
[[nodiscard]] Membership line_meets(const ExactBody& agent, const ExactBody& obstacle,
                                    const exact::Integer& margin, const exact::IntegerVector<3>& w);

/// The ray verdict of disjoint bodies. Nothing where the line meets the obstacle and no plane was found that
/// tells the future from the past: bodies whose distance is 2^-700 of their size.
[[nodiscard]] std::optional<Membership> exact_membership(const ExactBody& agent, const ExactBody& obstacle,
                                                         const exact::Integer& margin,
                                                         const exact::IntegerVector<3>& w);

/// How the bodies lie. Nothing where they touch (or all but touch) with a common normal that is not rational,
/// or whose numbers have some 100 digits and more.
[[nodiscard]] std::optional<Relation> exact_relation(const ExactBody& agent, const ExactBody& obstacle,
                                                     const exact::Integer& margin);

}  // namespace vericone::round
