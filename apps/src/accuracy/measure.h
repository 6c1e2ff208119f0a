// SPDX-License-Identifier: BSD-3-Clause
//
// What is measured on one engagement.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace vericone::accuracy {

/// Numbers of boundary samples at which the exact cone is held against its own limit.
inline constexpr std::array<int, 8> kSampleCounts{8, 12, 16, 24, 32, 48, 64, 96};
/// Samples that stand for the limit: the rule has converged to rounding long before.
inline constexpr int kReferenceSamples = 512;

struct Measurement {
  double exact_area = 0;                                   // cross-section at distance 1, dimensionless
  double exact_solid_angle = 0;                            // sr
  std::vector<double> slice_areas;                         // one for each plane count
  std::array<double, kSampleCounts.size()> areas{};        // exact cone with few samples
  std::array<double, kSampleCounts.size()> area_bounds{};  // and its certified error bound
};

Measurement measure(const Ellipsoid& a, const Ellipsoid& b, const std::vector<int>& planes);

/// The columns that say which bodies these are: semi-axes in decreasing order, shape matrices, which hold the
/// attitudes, the obstacle's centre seen from the agent's and its distance. Each with a comma before it.
std::string body_columns();
std::string body_cells(const Ellipsoid& a, const Ellipsoid& b);
inline constexpr std::size_t kBodyColumns = 22;

/// Column names and one row of the table of engagements; numbers with all their digits.
std::string csv_header(const std::vector<int>& planes);
std::string csv_row(const std::string& id, const Measurement& m, const Ellipsoid& a, const Ellipsoid& b);
/// The numbers of a row after its id, and what was measured. Throws std::runtime_error for a table that has
/// rows of other than `count` numbers.
std::vector<std::vector<double>> read_numbers(const std::filesystem::path& table, std::size_t count);
std::vector<Measurement> read_table(const std::filesystem::path& table, std::size_t planes);

}  // namespace vericone::accuracy
