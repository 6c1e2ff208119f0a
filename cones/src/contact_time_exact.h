// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/predicates.h>
#include <vericone/geometry/algebraic.h>
#include <optional>

namespace vericone::exact {

/// When A, moving by w t, first touches B, in seconds: an algebraic number.
struct ContactTime {
  enum class When { now, later, never };
  When when;
  std::optional<RealRoot> root;  // `later`
};

/// For w = v_a - v_b, finite.
ContactTime contact_time(const ConeOracle& oracle, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b);

/// Sign of x - y, `never` being later than any other.
int compare(ContactTime& x, ContactTime& y);

}  // namespace vericone::exact
