// SPDX-License-Identifier: BSD-3-Clause
//
// On which side of a quadric, of a body, or of a combination of quadrics a point lies. Exact.
//
// Laws (tests/geometry/quadric_side_test.cpp): a positive multiple of the matrix changes nothing, a negative
// one negates the answer; a body and its quadric agree where both are exact; the side of a combination is the
// largest of its members' sides; rungs that answer agree.
#pragma once

#include <vericone/geometry/combined.h>
#include <vericone/geometry/quadric.h>
#include <vericone/geometry/sign.h>
#include <span>

namespace vericone {

/// Sign of x~^T Q x~, x~ = (x, 1): negative inside where the quadric is written that way (Ellipsoid::quadric,
/// docs/reference/formats.md). A polynomial of degree 1 in Q and 2 in x. Throws InputError naming "point[i]"
/// for coordinates that are not finite. Cost: about 20 ns where the first rung decides.
template <int D>
[[nodiscard]] Sign side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// The same for a body, as the matrix that defines it says: negative inside, zero on the surface. In
/// determinants, sign of |adj(F)(x - p)|^2 - det(F)^2 or of (x - p)^T adj(S) (x - p) - det S.
template <int D>
[[nodiscard]] Sign side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// The same for combined quadrics: negative inside, zero on the boundary, positive outside. A delimiter's
/// value d^T M d - level, d = x - p, is of degree 1 in M and 2 in d. `rung`: the highest one asked.
template <int D>
[[nodiscard]] Sign side(const BasicCombined<D>& body, const Eigen::Matrix<double, D, 1>& point,
                        Rung* rung = nullptr);

/// Side of the combination { x : x~^T Q_i x~ <= 0 for all i }: negative in its interior, zero on its
/// boundary, positive outside. Empty: all of space. `rung`: the last one asked.
template <int D>
Sign side(std::span<const BasicQuadric<D>> quadrics, const Eigen::Matrix<double, D, 1>& point,
          Rung* rung = nullptr);

template <int D>
[[nodiscard]] FilteredSign triage_side(const BasicQuadric<D>& quadric,
                                       const Eigen::Matrix<double, D, 1>& point) noexcept;
template <int D>
[[nodiscard]] FilteredSign interval_side(const BasicQuadric<D>& quadric,
                                         const Eigen::Matrix<double, D, 1>& point) noexcept;
template <int D>
[[nodiscard]] Sign exact_side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point);

template <int D>
[[nodiscard]] FilteredSign triage_side(const BasicEllipsoid<D>& body,
                                       const Eigen::Matrix<double, D, 1>& point) noexcept;
template <int D>
[[nodiscard]] FilteredSign interval_side(const BasicEllipsoid<D>& body,
                                         const Eigen::Matrix<double, D, 1>& point) noexcept;
template <int D>
[[nodiscard]] Sign exact_side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point);

/// Tags of the ladders for rung_counts().
struct PointQuadric;
struct PointBody;
struct PointCombined;

}  // namespace vericone
