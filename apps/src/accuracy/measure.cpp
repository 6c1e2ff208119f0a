// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/measure.h"

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace vericone::accuracy {

Measurement measure(const Ellipsoid& a, const Ellipsoid& b, const std::vector<int>& planes) {
  Measurement m;
  const TrueCone reference = true_cone(a, b, kReferenceSamples);
  m.exact_area = reference.cross_section_area;
  m.exact_solid_angle = reference.solid_angle;
  for (const int n : planes) m.slice_areas.push_back(slice_cone(a, b, n).polyhedral().cross_section_area);
  for (std::size_t i = 0; i < kSampleCounts.size(); ++i) {
    const TrueCone cone = true_cone(a, b, kSampleCounts[i]);
    const ConeBounds bounds = cone_bounds(cone, a, b);
    m.areas[i] = bounds.cross_section_area;
    m.area_bounds[i] = bounds.cross_section_area_error;
  }
  return m;
}

std::string body_columns() {
  std::string columns;
  for (const std::string body : {"agent", "obstacle"}) {
    for (const char* axis : {"a", "b", "c"}) columns += "," + body + "_semi_axis_" + axis;
    for (const char* entry : {"xx", "xy", "xz", "yy", "yz", "zz"}) columns += "," + body + "_shape_" + entry;
  }
  return columns + ",to_obstacle_x,to_obstacle_y,to_obstacle_z,distance";
}

std::string body_cells(const Ellipsoid& a, const Ellipsoid& b) {
  std::string cells;
  const auto add = [&](double x) { cells += "," + to_text(x); };
  for (const Ellipsoid* body : {&a, &b}) {
    for (const double axis : body->semi_axes()) add(axis);
    for (int i = 0; i < 3; ++i)
      for (int k = i; k < 3; ++k) add(body->shape()(i, k));
  }
  const Eigen::Vector3d to_obstacle = b.center() - a.center();
  for (const double x : to_obstacle) add(x);
  add(to_obstacle.norm());
  return cells;
}

std::string csv_header(const std::vector<int>& planes) {
  std::string header = "engagement,exact_area,exact_solid_angle_sr";
  for (const int n : planes) header += ",slice_area_n" + std::to_string(n);
  for (const int m : kSampleCounts) header += ",exact_area_m" + std::to_string(m);
  for (const int m : kSampleCounts) header += ",exact_area_bound_m" + std::to_string(m);
  return header + body_columns();
}

std::string csv_row(const std::string& id, const Measurement& m, const Ellipsoid& a, const Ellipsoid& b) {
  std::string row = id;
  const auto add = [&](double x) { row += "," + to_text(x); };
  add(m.exact_area);
  add(m.exact_solid_angle);
  for (const double x : m.slice_areas) add(x);
  for (const double x : m.areas) add(x);
  for (const double x : m.area_bounds) add(x);
  return row + body_cells(a, b);
}

std::vector<std::vector<double>> read_numbers(const std::filesystem::path& table, std::size_t count) {
  std::ifstream in(table);
  std::string line, cell;
  std::getline(in, line);  // settings
  std::getline(in, line);  // header
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::vector<double>& row = rows.emplace_back();
    std::getline(cells, cell, ',');
    while (std::getline(cells, cell, ',')) row.push_back(std::stod(cell));
    if (row.size() != count)
      throw std::runtime_error(table.string() + ": row " + std::to_string(rows.size()) + " has " +
                               std::to_string(row.size() + 1) + " columns");
  }
  return rows;
}

std::vector<Measurement> read_table(const std::filesystem::path& table, std::size_t planes) {
  std::vector<Measurement> all;
  for (const auto& row : read_numbers(table, 2 + planes + 2 * kSampleCounts.size() + kBodyColumns)) {
    Measurement& m = all.emplace_back();
    m.exact_area = row[0];
    m.exact_solid_angle = row[1];
    auto it = row.begin() + 2;
    m.slice_areas.assign(it, it + static_cast<std::ptrdiff_t>(planes));
    it += static_cast<std::ptrdiff_t>(planes);
    for (double& x : m.areas) x = *it++;
    for (double& x : m.area_bounds) x = *it++;
  }
  return all;
}

}  // namespace vericone::accuracy
