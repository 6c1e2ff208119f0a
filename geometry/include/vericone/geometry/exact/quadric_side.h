// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of side() for input in rational numbers.
#pragma once

#include <vericone/geometry/exact/body.h>
#include <vericone/geometry/sign.h>

namespace vericone::exact {

/// For rational coordinates.
template <int D>
[[nodiscard]] Sign side(const RationalMatrix<D + 1>& quadric, const RationalVector<D>& point);
template <int D>
[[nodiscard]] Sign side(const RationalBody<D>& body, const RationalVector<D>& point);

}  // namespace vericone::exact
