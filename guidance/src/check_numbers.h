// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <cmath>
#include <string>

namespace vericone::guidance {

inline void require_positive(double value, const char* field, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
}
inline void require_not_negative(double value, const char* field, const char* unit) {
  if (!(value >= 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a finite number, 0 or more") + unit);
}
inline void require_finite(const Eigen::Vector3d& value, const char* field, const char* unit) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(value(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(value(i)),
                       std::string("a finite number") + unit);
}

}  // namespace vericone::guidance
