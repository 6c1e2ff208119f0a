// SPDX-License-Identifier: BSD-3-Clause
//
// Single rungs of the side of a point.
#pragma once

#include <vericone/geometry/combined.h>

namespace vericone {

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

}  // namespace vericone
