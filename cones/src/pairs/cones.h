// SPDX-License-Identifier: BSD-3-Clause
//
// Cones by the methods that there are.
#pragma once

#include <vericone/cones/cone.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>

#include "pairs/family.h"

namespace vericone::pairs {

Cone cone_of_ellipsoids(const Ellipsoid& a, const Ellipsoid& b, const ConeOptions& options);
Cone cone_of_combined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const ConeOptions& options);
/// `inside`: a direction from the agent into the hull.
Cone cone_of_hulls(const AssemblyOracle& oracle, const Eigen::Vector3d& inside, const ConeOptions& options);
/// Of any family; `axis`: from the agent towards the obstacle, as reported.
Cone cone_by_map(const Family& family, const Eigen::Vector3d& axis, const ConeOptions& options);
/// Of -w.
Cone mirror_image(Cone cone);

}  // namespace vericone::pairs
