// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/fit.h>
#include <vericone/fitting/containing.h>
#include <vericone/fitting/convex_hull.h>
#include <vericone/geometry/error.h>

namespace vericone::fitting {

}  // namespace vericone::fitting
