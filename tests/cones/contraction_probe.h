// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone::testing {

/// x y - x y as a difference of two products: 0 when each product is rounded, the rounding error of one of
/// them when the compiler fused it into the subtraction.
double difference_of_products(double a, double b, double c, double d);
double difference_of_products_contracted(double a, double b, double c, double d);

}  // namespace vericone::testing
