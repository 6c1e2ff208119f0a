// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_outlier.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/min_volume_ellipsoid.h>
#include <algorithm>
#include <cstdio>

namespace vericone::fit {
namespace {

constexpr double kWorthSaying = 1.5;
constexpr std::size_t kFewest = 12;  // of less points none is far from the others: there are no others

Eigen::Vector3d median(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d middle;
  std::vector<double> values(points.size());
  for (int i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) values[k] = points[k](i);
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle(i) = *half;
  }
  return middle;
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

}  // namespace

std::optional<std::string> outlier_note(const fitting::Sample& sample) {
  std::vector<char> used(sample.points.size(), !sample.is_mesh());
  for (const auto& t : sample.triangles)
    for (const auto i : t) used[i] = 1;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < sample.points.size(); ++i)
    if (used[i]) {
      points.push_back(sample.points[i]);
      indices.push_back(i);
    }
  if (points.size() < kFewest) return std::nullopt;

  const Eigen::Vector3d middle = median(points);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - middle).squaredNorm() > (points[farthest] - middle).squaredNorm()) farthest = i;
  const Eigen::Vector3d x = points[farthest];
  const std::size_t index = indices[farthest];
  try {
    const MinVolumeOptions roughly{.tolerance = 1e-3};
    const double with = min_volume_ellipsoid<3>(points, roughly).body.volume();
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(farthest));
    const double without = min_volume_ellipsoid<3>(points, roughly).body.volume();
    if (with < kWorthSaying * without) return std::nullopt;
    return "point " + std::to_string(index) + " at (" + short_number(x.x()) + ", " + short_number(x.y()) +
           ", " + short_number(x.z()) + ") is far from the others: without it the ellipsoid would have " +
           short_number(without) + " m^3, with it it has " + short_number(with) +
           " m^3; --coverage below 1 leaves such points out";
  } catch (const InputError&) {
    return std::nullopt;  // in one plane but for this one: no ellipsoid to compare with
  }
}

}  // namespace vericone::fit
