// SPDX-License-Identifier: BSD-3-Clause
#include "contraction_probe.h"

double vericone::testing::difference_of_products_contracted(double a, double b, double c, double d) {
  return a * b - c * d;
}
