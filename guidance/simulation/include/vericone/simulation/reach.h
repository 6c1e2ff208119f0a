// SPDX-License-Identifier: BSD-3-Clause
//
// Before any run: when an agent can be in openings at the earliest, by what its limits prove. Method:
// docs/explanation/proof-of-runs.md.
#pragma once

#include <vericone/simulation/proof.h>
#include <vericone/simulation/run.h>
#include <vericone/simulation/scenario.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace vericone::simulation {

/// What no motion of an agent exceeds, in the world; what is infinite is not limited.
struct ReachLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double speed = kNone;                 // m/s
  double acceleration = kNone;          // m/s^2
  double turn_rate = kNone;             // rad/s, of the velocity's direction in space
  double course_rate = kNone;           // rad/s, of the velocity's direction as seen from above
  double climb = kNone;                 // m/s, up or down
  double climb_jerk = kNone;            // m/s^3, of the height
  double top = kNone, bottom = -kNone;  // z of the highest and the lowest place, m
};

/// Where an agent sets out.
struct ReachStart {
  double t = 0;                                                                            // s
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();  // m, m/s
  double climb_acceleration = 0;  // m/s^2, for `climb_jerk`
  /// Metres: how far the point that passes, the body's middle, is from the reference point at most.
  double offset = 0;
};

/// Which limit an opening is out of by the most, at the time that is said.
enum class ReachLimit : std::uint8_t {
  none,        // there already
  speed,       // too far for its speed or its acceleration
  turning,     // too far aside for how fast it turns
  climb,       // too far above or below for how fast it climbs
  height,      // above the highest or below the lowest place where it can be
  appearance,  // it was not there before
};
[[nodiscard]] const char* to_string(ReachLimit limit);

/// When a point first can be at the centre of an opening, or anywhere inside of its rim; s.
struct ReachTime {
  /// Proved: not before this; infinite: not until the horizon either.
  double not_before = 0;
  /// What forbids it until then, at last; of one that is infinite what forbids it at the horizon.
  ReachLimit by = ReachLimit::none;
};
struct Reach {
  ReachTime edge, center;
};

/// Of openings that are passed one after the other. A lower bound each: convex hulls stand for outlines, each
/// limit is taken by itself, and an agent leaves an opening from any place inside of it at any time that is
/// not before its own bound, with any course. `horizon`: until when is looked, s. Throws InputError naming
/// "limits" where one is negative or not a number. Cost: 0.1 ms an opening, about.
[[nodiscard]] std::vector<Reach> earliest_passages(const ReachStart& start, const ReachLimits& limits,
                                                   const std::vector<const MovingOrifice*>& orifices,
                                                   double horizon);

/// An agent of a scenario and the openings of its `through`.
struct AgentReach {
  std::size_t agent = 0;
  ReachLimits limits;
  std::vector<std::size_t> orifices;  // of the scenario's, in the agent's order
  std::vector<Reach> reach;           // of each
};

/// Of every agent with `through`; the horizon is the scenario's duration. Limits: a vehicle's own, through
/// the water, and what the water does; of a point mass its speed, where its law turns it only, and the most
/// that its law and its goal command. Throws InputError naming "bodies" where no agent has any `through`.
[[nodiscard]] std::vector<AgentReach> reach(const Scenario& scenario);

/// The largest drift (ProofOptions) with which every ordered passage of a run is still proved, m/s, found by
/// halving to 1 % of it: what the recorded commands endure of any constant current. At least `proof.drift` of
/// the scenario where that is proved; nothing where not all are proved without drift.
[[nodiscard]] std::optional<double> largest_drift(const Scenario& scenario, const Run& run);

/// The largest uniform current in a direction, beside the water of the scenario, with which the scenario,
/// flown again in it by its vehicles, has every ordered passage proved: found by doubling from `first` m/s
/// and halving, `runs` in all. Sampled: a weaker current that was not tried may fail. Nothing where none that
/// was tried, 0 included, does. `go_on`: false ends it.
[[nodiscard]] std::optional<double> largest_current(const Scenario& scenario,
                                                    const Eigen::Vector3d& direction, double first, int runs,
                                                    const std::function<bool()>& go_on = {});

}  // namespace vericone::simulation
