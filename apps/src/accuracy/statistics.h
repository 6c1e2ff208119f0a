// SPDX-License-Identifier: BSD-3-Clause
//
// Summaries of tables and how they are written.
#pragma once

#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone::accuracy {

struct Spread {
  double median = 0, mean = 0, worst = 0;
};

Spread spread(std::vector<double> values);
Json spread_json(const Spread& s);

/// Slope of log(error) against log(n), by least squares.
double order(const std::vector<double>& n, const std::vector<double>& error);

/// Of a row of a summary: the errors against the finest count, 2/n and how many are above it; "-" for the
/// finest count, which is the reference.
std::string discretisation_text(const Json& row);

std::string percent(double x);
std::string scientific(double x);
/// Numbers with a space between.
std::string planes_text(const std::vector<int>& planes);

}  // namespace vericone::accuracy
