// SPDX-License-Identifier: BSD-3-Clause
//
// A simulated LiDAR's scan of a mesh.
#pragma once

#include <vericone/lidar/lidar.h>
#include <vericone/lidar/mesh_scene.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vericone::lidar {

/// What became of a beam.
enum class Beam : std::uint8_t {
  returned,
  missed,    // nothing there up to the maximal range, or measured beyond it (noise)
  too_near,  // the first thing is, or is measured, nearer than the minimal range; it hides the rest
  dropped,   // hit, but lost
};

struct Return {
  Eigen::Vector3d in_sensor, in_world;  // m, as measured: with noise along the beam
  std::uint32_t beam = 0;
  std::uint32_t triangle = 0;  // the one that was hit
};

struct Scan {
  Eigen::Isometry3d pose;       // from the sensor's frame to the world's
  std::vector<Return> returns;  // in the order of the beams
  std::vector<Beam> beams;      // one for every beam

  [[nodiscard]] std::size_t count(Beam what) const;
  [[nodiscard]] std::vector<Eigen::Vector3d> sensor_points() const;  // m
  [[nodiscard]] std::vector<Eigen::Vector3d> world_points() const;   // m
};

/// Every beam's first hit. `agent` from the agent's frame to the world's. Noise and dropout are a function of
/// `seed` and the beam's index alone, whatever the number of threads. Threads: as many as there are cores.
/// Throws InputError for a bad lidar or an agent pose that is no rigid motion. Cost: below a microsecond a
/// beam and core.
[[nodiscard]] Scan scan(const MeshScene& scene, const Lidar& lidar, const Eigen::Isometry3d& agent,
                        std::uint64_t seed);

}  // namespace vericone::lidar
