// SPDX-License-Identifier: BSD-3-Clause
//
// Bands: which headings, speeds, climb rates and altitudes keep an agent apart from all others within a
// horizon, as intervals with proved ends (docs/explanation/bands.md).
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/body.h>
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace vericone::guidance {

/// A closed interval; rad of a heading, m/s of a speed or a climb rate, m of an altitude.
struct Range {
  double from = 0, to = 0;
};

/// Another body: it keeps its velocity, m/s over ground.
struct Intruder {
  Placed body{Body()};  // where it is now
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

struct BandOptions {
  Horizon horizon;                                 // contacts at other times do not count
  double margin = 0;                               // m to keep from every body
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  // m/s, added to the agent's velocity through the air
  Range speed{0, 0};     // what is asked about, horizontal, m/s; both 0: from 0 to twice the agent's
  Range climb{0, 0};     // m/s upwards; both 0: as fast down and up as the agent is fast
  Range altitude{0, 0};  // m above where it is; both 0: no band of altitudes
  /// m/s^2 across the velocity, along it and upwards, with which the agent changes its heading on a circle,
  /// its speed, its climb rate, and then goes straight on; 0: at once. Needs a horizon from now that ends.
  double lateral = 0, longitudinal = 0, vertical = 0;
  bool last = false;  // whether to find Band::last: milliseconds an intruder that is met
};

/// One quantity changed, all else kept. Ranges are in order and apart.
struct Band {
  std::vector<Range> free;      // proved: no intruder comes nearer than the margin within the horizon
  std::vector<Range> conflict;  // one does, at every value (but for rounding of velocities, 1e-15)
  /// Seconds for which the agent may go on as it does and still have a free value, by a manoeuvre or at once:
  /// a moment at which one was found, sought by halving. Negative where it has none now, infinite where its
  /// own course is free, NaN where it was not asked or the horizon does not begin now and end.
  double last = std::numeric_limits<double>::quiet_NaN();
};

/// Headings are measured clockwise from y (north), from 0 to 2 pi; a range across north is two.
struct Bands {
  Band heading, speed, climb;
  Band altitude;  // of the agent flying level there, from now on; `last` is not found
  /// Seconds until the margin is lost on the present course, at least; nothing where it is kept within the
  /// horizon.
  std::optional<double> time_to_violation;
  /// Where nothing is free: the heading on which the agent is apart from all others soonest, and stays so
  /// until the horizon ends, and when, s. Nothing where there is none.
  struct Recovery {
    double heading, time;
  };
  std::optional<Recovery> recovery;
};

/// For an agent with a velocity through the air. What is between free and conflict is neither proved: some
/// 1e-12 rad at each end, and ranges where bodies only touch; by manoeuvres that take time at most 1e-4 of
/// the range at each end; beside bodies with delimiters 1e-4, and by manoeuvres all that delimiters cut away
/// (there they count as their ellipsoids). Convex parts of intruders are asked one by
/// one. Throws InputError naming "velocity", "wind", "horizon", "margin", an acceleration or a range. Cost:
/// docs/measured/guidance.md.
[[nodiscard]] Bands bands(const Placed& agent, const Eigen::Vector3d& velocity,
                          std::span<const Intruder> intruders, const BandOptions& options);

/// Nested volumes about the intruders: bands of each, and how to get out where the outermost leaves nothing.
struct AlertBands {
  std::vector<Bands> levels;
  /// Where nothing is free at the outermost level, and some heading at the innermost: a heading on which the
  /// agent keeps the least margin all the time, and the largest one soonest and then until the horizon ends.
  std::optional<Bands::Recovery> recovery;
};

/// `margins`: m, the largest first; options.margin does not count. Throws like bands(), and naming
/// "margins[i]". Cost: as many calls of it.
[[nodiscard]] AlertBands alert_bands(const Placed& agent, const Eigen::Vector3d& velocity,
                                     std::span<const Intruder> intruders, std::span<const double> margins,
                                     const BandOptions& options);

}  // namespace vericone::guidance
