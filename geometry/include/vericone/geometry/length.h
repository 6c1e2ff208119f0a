// SPDX-License-Identifier: BSD-3-Clause
//
// The length of a vector, the same wherever the vector lies in memory.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vericone::detail {

/// |v|, to 3 units in the last place, without overflow or underflow in between. Eigen's stableNorm() adds in
/// an order that depends on the address of v, so that its last bit does too.
template <typename Derived>
[[nodiscard]] double length(const Eigen::MatrixBase<Derived>& v) {
  const double square = v.squaredNorm();
  if (square > 1e-280 && square < 1e280) return std::sqrt(square);
  const double most = v.cwiseAbs().maxCoeff();
  if (!(most > 0) || std::isinf(most)) return square > 0 ? square : most;  // zero, infinite or not a number
  const double scale = most < 1 ? 0x1p600 : 0x1p-600;
  return std::sqrt((v * scale).squaredNorm()) / scale;
}

}  // namespace vericone::detail
