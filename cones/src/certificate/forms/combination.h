// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "certificate/forms/inequalities.h"

namespace vericone::certificates {

/// All pivots of the elimination above zero.
bool is_positive(Form<Rational> m, int size);

/// Multipliers >= 0 of matrices, of sum 1, so that the sum is positive definite; empty where none are found.
/// By Newton's method along the central path of: the least s for which the sum and s times the identity is.
std::vector<double> positive_combination(const std::vector<Matrix5>& forms, int size);

}  // namespace vericone::certificates
