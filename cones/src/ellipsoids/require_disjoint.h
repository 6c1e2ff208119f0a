// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>

namespace vericone {

/// Of what has an answer for disjoint bodies only. Throws InputError naming "bodies".
inline void require_disjoint(Relation relation) {
  if (relation != Relation::disjoint)
    throw InputError("bodies", to_string(relation), "disjoint, for a cone with edges");
}
inline void require_disjoint(const Ellipsoid& a, const Ellipsoid& b) { require_disjoint(relation<3>(a, b)); }

}  // namespace vericone
