// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/mixed.h>
#include <vericone/lidar/lidar.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <thread>

#include "rigid.h"

namespace vericone::lidar {
namespace {

using detail::mixed;
using Eigen::Vector3d;

/// Random numbers of one beam: a function of seed, beam and how many were drawn.
class BeamNumbers {
 public:
  BeamNumbers(std::uint64_t seed, std::uint64_t beam) : state_(mixed(mixed(seed) ^ beam)) {}
  /// In [0, 1).
  double uniform() { return static_cast<double>(mixed(state_ + drawn_++) >> 11) * 0x1p-53; }
  double normal() {
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t state_, drawn_ = 0;
};

constexpr std::size_t kBeamsWorthAThread = 4096;

}  // namespace

std::size_t Scan::count(Beam what) const {
  return static_cast<std::size_t>(std::count(beams.begin(), beams.end(), what));
}

std::vector<Vector3d> Scan::sensor_points() const {
  std::vector<Vector3d> points;
  points.reserve(returns.size());
  for (const Return& r : returns) points.push_back(r.in_sensor);
  return points;
}

std::vector<Vector3d> Scan::world_points() const {
  std::vector<Vector3d> points;
  points.reserve(returns.size());
  for (const Return& r : returns) points.push_back(r.in_world);
  return points;
}

Scan scan(const MeshScene& scene, const Lidar& lidar, const Eigen::Isometry3d& agent, std::uint64_t seed) {
  check(lidar);
  if (!is_rigid(agent)) throw InputError("agent", "another matrix", "a rotation and a finite translation");
  Scan scan;
  scan.pose = agent * lidar.pose;
  const std::size_t count = lidar.beams.size();
  scan.beams.assign(count, Beam::missed);
  const Stop* const stop = stop_of_this_thread();
  const auto measure = [&](std::size_t from, std::size_t to, std::vector<Return>& returns) {
    const StopScope scope(stop);
    for (std::size_t i = from; i < to; ++i) {
      if (i % 256 == 0 && stop_requested()) return;
      const Vector3d beam = lidar.beams.direction(i), direction = scan.pose.linear() * beam;
      const std::optional<Hit> hit = scene.first_hit(scan.pose.translation(), direction, 0, lidar.max_range);
      if (!hit) continue;
      BeamNumbers numbers(seed, i);
      if (hit->range < lidar.min_range) {
        scan.beams[i] = Beam::too_near;
      } else if (numbers.uniform() < lidar.dropout) {
        scan.beams[i] = Beam::dropped;
      } else {
        // Measured beyond its ranges, or behind it, a sensor reports nothing.
        const double range = hit->range + lidar.range_noise * numbers.normal();
        scan.beams[i] = range > lidar.max_range                 ? Beam::missed
                        : range < lidar.min_range || range <= 0 ? Beam::too_near
                                                                : Beam::returned;
        if (scan.beams[i] != Beam::returned) continue;
        returns.push_back({range * beam, scan.pose.translation() + range * direction,
                           static_cast<std::uint32_t>(i), hit->triangle});
      }
    }
  };
  const std::size_t most = std::max(1U, std::thread::hardware_concurrency()),
                    threads = std::clamp<std::size_t>(count / kBeamsWorthAThread, 1, most);
  std::vector<std::vector<Return>> parts(threads);
  std::vector<std::jthread> workers;
  const auto start = [&](std::size_t part) { return count * part / threads; };
  for (std::size_t part = 1; part < threads; ++part)
    workers.emplace_back([&, part] { measure(start(part), start(part + 1), parts[part]); });
  measure(start(0), start(1), parts[0]);
  workers.clear();
  checkpoint();
  for (const auto& part : parts) scan.returns.insert(scan.returns.end(), part.begin(), part.end());
  return scan;
}

}  // namespace vericone::lidar
