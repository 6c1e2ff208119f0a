// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/requires.h>
#include <vericone/lidar/lidar.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "rigid.h"

namespace vericone::lidar {
namespace {

using std::numbers::pi;

/// `count` equal steps over `width` about 0, both ends included.
std::vector<double> steps(int count, double width) {
  std::vector<double> angles(count);
  for (int i = 0; i < count; ++i) angles[i] = count == 1 ? 0 : width * (double(i) / (count - 1) - 0.5);
  return angles;
}

constexpr int kMostBeams = 1 << 28;

void check_elevations(const std::vector<double>& elevations, const char* field) {
  for (const double e : elevations)
    if (!(std::abs(e) <= pi / 2 * (1 + 1e-12)))
      throw InputError(field, to_text(e), "elevations from -pi/2 to pi/2 (radians)");
}

}  // namespace

Eigen::Vector3d BeamPattern::direction(std::size_t beam) const {
  VERICONE_REQUIRES(beam < size(), "beam", "no such beam", "below size()");
  const double elevation = elevations[beam / azimuths.size()], azimuth = azimuths[beam % azimuths.size()];
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

double BeamPattern::spacing() const {
  double widest = 0;
  for (const auto* angles : {&elevations, &azimuths})
    for (std::size_t i = 1; i < angles->size(); ++i)
      widest = std::max(widest, std::abs((*angles)[i] - (*angles)[i - 1]));
  return widest;
}

BeamPattern spinning(std::vector<double> elevations, int azimuths) {
  if (azimuths < 1) throw InputError("azimuths", std::to_string(azimuths), "a positive whole number");
  if (double(azimuths) * std::max<double>(1, double(elevations.size())) > kMostBeams)
    throw InputError("azimuths", std::to_string(azimuths), "no more than 2^28 beams in all");
  BeamPattern beams;
  beams.elevations = std::move(elevations);
  for (int i = 0; i < azimuths; ++i) beams.azimuths.push_back(2 * pi * i / azimuths);
  check_elevations(beams.elevations, "elevations");
  return beams;
}

BeamPattern raster(int rows, int columns, double horizontal, double vertical) {
  if (rows < 1) throw InputError("rows", std::to_string(rows), "a positive whole number");
  if (columns < 1) throw InputError("columns", std::to_string(columns), "a positive whole number");
  if (double(rows) * columns > kMostBeams)
    throw InputError("columns", std::to_string(columns), "no more than 2^28 beams in all");
  if (!(horizontal > 0 && horizontal < 2 * pi))
    throw InputError("horizontal", to_text(horizontal), "between 0 and 2 pi (radians)");
  if (!(vertical > 0 && vertical <= pi))
    throw InputError("vertical", to_text(vertical), "between 0 and pi (radians)");
  return {steps(rows, vertical), steps(columns, horizontal)};
}

void check(const Lidar& lidar) {
  const BeamPattern& beams = lidar.beams;
  if (beams.elevations.empty() || beams.azimuths.empty() ||
      double(beams.elevations.size()) * double(beams.azimuths.size()) > kMostBeams)
    throw InputError("lidar.beams",
                     std::to_string(beams.elevations.size()) + " elevations and " +
                         std::to_string(beams.azimuths.size()) + " azimuths",
                     "at least one of each and no more than 2^28 beams");
  check_elevations(beams.elevations, "lidar.beams");
  for (const double a : beams.azimuths)
    if (!std::isfinite(a)) throw InputError("lidar.beams", to_text(a), "finite azimuths (radians)");
  if (!is_rigid(lidar.pose))
    throw InputError("lidar.pose", "another matrix", "a rotation and a finite translation");
  if (!(lidar.min_range >= 0 && std::isfinite(lidar.min_range)))
    throw InputError("lidar.min_range", to_text(lidar.min_range), "a finite number from 0 up (metres)");
  if (!(lidar.max_range > lidar.min_range))
    throw InputError("lidar.max_range", to_text(lidar.max_range), "greater than min_range (metres)");
  if (!(lidar.range_noise >= 0 && std::isfinite(lidar.range_noise)))
    throw InputError("lidar.range_noise", to_text(lidar.range_noise), "a finite number from 0 up (metres)");
  if (!(lidar.dropout >= 0 && lidar.dropout <= 1))
    throw InputError("lidar.dropout", to_text(lidar.dropout), "a probability, 0 to 1");
}

}  // namespace vericone::lidar
