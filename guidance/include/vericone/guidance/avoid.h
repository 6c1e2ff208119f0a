// SPDX-License-Identifier: BSD-3-Clause
//
// The safe velocity nearest to the one that is wanted, with a proof that nothing safe is much nearer, or that
// nothing is safe (docs/explanation/avoid.md).
#pragma once

#include <vericone/guidance/bands.h>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace vericone::guidance {

struct AvoidOptions {
  double until = 60;                               // s: contacts later than that do not count
  double margin = 0;                               // m to keep from every body
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s, added to the agent's velocity through the air
  /// What the agent can fly, through the air: |v|, and upwards, m/s; to 1e-12 of the speed.
  Range speed{0, std::numeric_limits<double>::infinity()};
  Range climb{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  /// m/s^2 across its present velocity and along it, with which it gets there at a constant acceleration;
  /// both 0: at once.
  double lateral = 0, longitudinal = 0;
  double gap = 0.01;  // between `lower` and `distance`, relative, at which the search ends; of times likewise
  /// Rays from the wanted velocity that are looked along; a tenth of them where a body with delimiters is in
  /// the way.
  std::size_t most = 2000;
};

enum class AvoidStatus : std::uint8_t {
  free,          // the velocity is safe until then
  nothing_safe,  // no velocity that can be flown is, proved; this one is nearly as long as any
  not_found,     // none was found, and that there is none is not proved: as nothing_safe
};
[[nodiscard]] const char* to_string(AvoidStatus status);

struct Avoidance {
  AvoidStatus status = AvoidStatus::not_found;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // through the air, m/s
  double distance = 0;                                 // m/s, from the velocity that is wanted
  double lower = 0;  // m/s: no safe velocity is nearer, proved, of those that are changed to at once
  /// s: until then the velocity keeps the margin, proved; where it is free, until the end.
  double safe_until = 0;
  /// s: no velocity that can be flown, changed to at once, keeps the margin until then, proved; infinite
  /// where that is not known. As a rule within `gap` of `safe_until`, relative.
  double latest = std::numeric_limits<double>::infinity();
  /// Of the velocity, where it is not free: what is met first, and when, s (the earliest, proved).
  struct First {
    std::size_t obstacle;
    double time;
  };
  std::optional<First> first;
};

/// Free: flown at once, or after the change of velocity at the accelerations given, no intruder comes nearer
/// than the margin until then; every intruder keeps its velocity. Deterministic. Throws InputError naming
/// "velocity", "wanted", "wind" or an option. Cost: docs/measured/guidance.md.
[[nodiscard]] Avoidance avoid(const Placed& agent, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d& wanted, std::span<const Intruder> intruders,
                              const AvoidOptions& options);

}  // namespace vericone::guidance
