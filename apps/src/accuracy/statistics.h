// SPDX-License-Identifier: BSD-3-Clause
//
// Summaries of tables and how they are written.
#pragma once

#include <cstddef>
#include <optional>
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

/// The errors of one plane count against the finest, which is the reference and has none.
struct Discretisation {
  int planes = 0;
  std::optional<Spread> error;
  double two_over_n = 0;
  std::ptrdiff_t above = 0;  // engagements whose error is above 2/n
};

/// Of slice cones by the number of their planes.
struct SliceErrors {
  std::vector<Discretisation> counts;
  std::optional<double> order;  // of the median error, in n
};
/// `areas`: of every engagement one for each plane count; the last is the reference.
SliceErrors slice_errors(const std::vector<std::vector<double>>& areas, const std::vector<int>& planes);

/// "planes", "discretisation_error", "two_over_n" and "above_two_over_n", the errors null for the finest.
Json discretisation_json(const Discretisation& row);
/// The same in columns, without the planes; "-" for the finest.
std::string discretisation_text(const Discretisation& row);

std::string percent(double x);
std::string scientific(double x);
/// Numbers with a space between.
std::string planes_text(const std::vector<int>& planes);

}  // namespace vericone::accuracy
