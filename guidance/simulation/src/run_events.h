// SPDX-License-Identifier: BSD-3-Clause
//
// When between two commands something happened: roots on the tracks.
#pragma once

#include <vericone/simulation/run.h>
#include <functional>

namespace vericone::simulation {

/// A time in [from, to] at which `value` changes its sign, to 1e-12 of the interval; it is to differ at the
/// two ends. A value that is not finite counts as that of `to`.
double sign_change(const std::function<double(double)>& value, double from, double to);

/// c.V at time t: negative while the centres close.
double closing_rate(const Track& a, const Track& b, double t);

/// y on the plane the law chooses, or m - required: what leaves or enters the cone. `across`: of the plane at
/// `from`.
double margin(const Track& a, const Track& b, const guidance::GuideOptions& options,
              const Eigen::Vector3d& across, double t);

}  // namespace vericone::simulation
