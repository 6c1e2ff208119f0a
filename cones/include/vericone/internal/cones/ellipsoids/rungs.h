// SPDX-License-Identifier: BSD-3-Clause
//
// Single rungs of the predicates of two ellipsoids.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <optional>

namespace vericone {

/// Last rung.
template <int D>
[[nodiscard]] Relation exact_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b);

/// A lower bound of g(n) = n.(p_B - p_A) - rho_A(n) - rho_B(n); -infinity where doubles tell nothing.
template <int D>
[[nodiscard]] double triage_gap(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                const Eigen::Matrix<double, D, 1>& n);

/// First rung of separates(): true is certain, false says nothing. No allocation, about 20 ns.
template <int D>
[[nodiscard]] bool triage_separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                    const Eigen::Matrix<double, D, 1>& n);

/// Second rung of verdicts within a horizon, for v_a != v_b: a plane with the whole way on its far side, or a
/// point of both bodies at one time of it; however they lie now. Never answers `on`.
[[nodiscard]] std::optional<Membership> interval_within(const Ellipsoid& a, const Ellipsoid& b,
                                                        const Eigen::Vector3d& v_a,
                                                        const Eigen::Vector3d& v_b, const Horizon& horizon);

/// Last rung, in integers.
[[nodiscard]] Membership exact_within(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& v_a,
                                      const Eigen::Vector3d& v_b, const Horizon& horizon);

/// With A and B exchanged.
[[nodiscard]] Position swapped(Position position);

/// First rung: a certificate searched for in plain doubles, its polynomials evaluated with a bound fixed by
/// their formulas. Nothing when rounding could matter. Never answers `touching`, `equal` or `..._touching`.
/// No allocation, no throw.
template <int D>
[[nodiscard]] std::optional<Position> triage_position(const BasicEllipsoid<D>& a,
                                                      const BasicEllipsoid<D>& b) noexcept;

/// Second rung: the same certificate in intervals. Never answers a degenerate position either. No allocation,
/// no throw.
template <int D>
[[nodiscard]] std::optional<Position> interval_position(const BasicEllipsoid<D>& a,
                                                        const BasicEllipsoid<D>& b) noexcept;

/// Last rung, in integers: always an answer. For rational input see exact_predicates.h.
template <int D>
[[nodiscard]] Position exact_position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b);

}  // namespace vericone
