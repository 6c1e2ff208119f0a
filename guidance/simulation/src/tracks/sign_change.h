// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace vericone::simulation {

/// A time in [from, to] at which `value` changes its sign, to 1e-12 of the interval; it is to differ at the
/// two ends. A value that is not finite counts as that of `to`.
double sign_change(const std::function<double(double)>& value, double from, double to);

}  // namespace vericone::simulation
