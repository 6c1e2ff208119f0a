// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace vericone::verify {

/// a + b = sum + rest without error, |rest| <= ulp(sum)/2 (Knuth).
struct TwoSum {
  double sum, rest;

  TwoSum(double a, double b) : sum(a + b) {
    const double b_part = sum - a;
    rest = (a - (sum - b_part)) + (b - b_part);
  }
};

}  // namespace vericone::verify
