// SPDX-License-Identifier: BSD-3-Clause
//
// What a simulated LiDAR is: beams, ranges, faults, and where it sits on the agent.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

namespace vericone::lidar {

/// Directions of the beams in the sensor's frame, x forwards, y to the left, z up: one beam for every
/// elevation and every azimuth. Beam r * azimuths.size() + c has the elevation r and the azimuth c.
struct BeamPattern {
  std::vector<double> elevations;  // radians above the sensor's xy plane, in [-pi/2, pi/2]
  std::vector<double> azimuths;    // radians from the sensor's x axis towards its y axis

  [[nodiscard]] std::size_t size() const { return elevations.size() * azimuths.size(); }
  /// Unit vector.
  [[nodiscard]] Eigen::Vector3d direction(std::size_t beam) const;
  /// The largest angle between neighbouring elevations or azimuths, radians; 0 for a single beam.
  [[nodiscard]] double spacing() const;
};

/// A spinning sensor: `azimuths` equal steps of a full turn, the first one forwards. Throws InputError naming
/// "elevations" or "azimuths".
[[nodiscard]] BeamPattern spinning(std::vector<double> elevations, int azimuths);

/// A sensor with a field of view: rows x columns beams at equal steps of both angles about the x axis, those
/// of the edges included (one row or column: in the middle). `horizontal` in (0, 2 pi), `vertical` in
/// (0, pi], radians. Throws InputError naming "rows", "columns", "horizontal" or "vertical".
[[nodiscard]] BeamPattern raster(int rows, int columns, double horizontal, double vertical);

struct Lidar {
  /// From the sensor's frame to the agent's.
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  BeamPattern beams;
  double min_range = 0, max_range = 1000;  // m; what is nearer or farther gives no return
  double range_noise = 0;                  // m, standard deviation, normal, along the beam
  double dropout = 0;                      // probability that a return is lost
};

/// Throws InputError naming "lidar.beams", "lidar.pose", "lidar.min_range", "lidar.max_range",
/// "lidar.range_noise" or "lidar.dropout".
void check(const Lidar& lidar);

}  // namespace vericone::lidar
