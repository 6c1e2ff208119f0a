// SPDX-License-Identifier: BSD-3-Clause
//
// A scenario carried out: what moved where, what was commanded, what happened, and what is proved of it.
#pragma once

#include <vericone/simulation/proof.h>
#include <vericone/simulation/scenario.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

/// One agent and one of the bodies it minds, at the time of a command. Body indices are the scenario's.
struct EncounterSample {
  double t = 0;  // s
  std::size_t agent = 0, obstacle = 0;
  guidance::SpatialState state;  // (6.10)'s states; planar scenarios have phi = 0
  guidance::GuideStep step;      // what the law says for this obstacle alone
  double plane_azimuth = 0;      // of step.across about the line of sight, rad from AxisFrame.e1
  bool cone = false;             // false: no cone (not apart as the method sees it); y, psi are NaN
  bool attended = false;         // the agent follows this one
};

/// The same moment on all planes.
struct PlaneSample {
  double t = 0;  // s
  std::size_t agent = 0, obstacle = 0;
  guidance::PlaneCandidate plane;
};

/// What an agent with a sensor measured of an obstacle at the time of a command, and what its law made of it,
/// beside the truth. On the plane that the law looked at; `on_plane` is false where it looked at none.
struct SightSample {
  double t = 0;  // s
  std::size_t agent = 0, obstacle = 0;
  Measurement measurement;
  guidance::SpatialState measured;                              // as measured: r, V_r, V_theta, V_phi, ...
  Eigen::Vector3d believed_position = Eigen::Vector3d::Zero();  // m, as given to the law
  Eigen::Vector3d believed_velocity = Eigen::Vector3d::Zero();  // m/s, as given to the law
  bool on_plane = false;
  guidance::PlanarState state;  // true
  guidance::PlaneCone cone;     // true, with the rates in closed form
  double y = 0;                 // dimensionless, true
  guidance::GuideReading reading;
  /// (7.4), (7.5) of this measurement, and the deviations that (7.7), (7.8), (7.13) give for it.
  guidance::NoiseTerms terms;
  double y_deviation = 0, a_deviation = 0, v_deviation = 0;  // dimensionless, dimensionless, 1/s
};

/// What a vehicle logs at the time of a command.
struct VehicleSample {
  double t = 0;  // s
  std::size_t body = 0;
  std::vector<double> values;  // in the order and the units of VehicleModel::channels()
};

/// A vehicle that was beyond one of its limits.
struct VehicleBeyond {
  std::size_t body = 0;
  LimitBroken broken;
};

/// One agent and the orifice that it heads for, at the time of a command.
struct OrificeSample {
  double t = 0;                        // s
  std::size_t agent = 0, orifice = 0;  // of the scenario's
  guidance::SpatialState state;        // of the centres
  guidance::OrificeCommand command;
  double from_plane = 0;  // m, of the agent's reference point, along the normal
};

enum class EventKind : std::uint8_t {
  appears,       // body `agent`
  enters_cone,   // y < 0 and closing from now on, as the law sees it (of an agent with a sensor: in truth)
  leaves_cone,   // y >= 0 (or m >= required) from now on; the last sample before it was inside
  passes,        // as the pilot's `passing` says; of a placed body: out of its bounds, whose middle recedes
  aligned,       // the velocity points at the goal from now on
  reaches_goal,  // its number from 1 is the value
  contact,       // proved
  cannot_avoid,  // every course tried meets `obstacle`, as far as a guarded pilot can foresee
  goes_through,  // the agent's reference point crosses the plane of an orifice inside the rim
  goes_beside,   // or outside of it
  sees,          // the agent measures the obstacle from now on
  loses,         // its sensor does not see the obstacle any more
};
[[nodiscard]] const char* to_string(EventKind kind);

struct Event {
  double t = 0;  // s
  EventKind kind = EventKind::appears;
  std::size_t agent = 0, obstacle = 0;  // equal where only one body is concerned; goes_*: of an orifice
  /// passes: distance of the centres (of a placed body of the middle of its bounds), m; enters_cone: y (or m,
  /// metres) at that command; leaves_cone: what it had to reach, cease or required; contact: the earliest
  /// time, s; goes_*: from the opening's centre, m; reaches_goal: which of the pilot's, from 1.
  double value = 0;
};

struct PairOutcome {
  std::size_t a = 0, b = 0;
  PairProof proof;
  double required = 0;  // metres, the most that a clearance law of either is to keep from the other

  /// Proved never nearer than required.
  [[nodiscard]] bool kept() const {
    return proof.verdict == ProofVerdict::avoided && proof.least_distance >= required;
  }
};

struct PassageOutcome {
  std::size_t agent = 0, orifice = 0;
  bool ordered = false;  // the agent was to pass it
  PassageProof proof;
};

/// A pair without a verdict: without pilots, rigid, with one velocity, so pieces of one body, which may
/// overlap.
struct NotChecked {
  std::size_t a = 0, b = 0;
};

/// Of a guarded pilot: how often the course that it flew was proved to touch nothing, and what that took for
/// granted: that the others are where it knows them, each keeps its velocity or accelerates no more than
/// `others_most`, and what is farther than `range` and not seen stays where it is.
struct PlansProved {
  std::size_t agent = 0;
  std::uint64_t commands = 0, proved = 0;
  double others_most = 0;                                  // m/s^2
  double range = std::numeric_limits<double>::infinity();  // m, of its sensor
};

/// Of a goal with a corridor, while its agent was on its way to it.
struct CorridorOutcome {
  std::size_t agent = 0, goal = 0;  // goal: of the pilot's, from 0
  double from = 0, to = 0;          // s
  /// m: so much was left at least between the body and the wall, proved, between the commands too; the body
  /// counts as a ball about its reference point. Negative: not proved to have stayed inside.
  double room = 0;
  bool left = false;  // its reference point was outside: proved
};

/// What a run cost in seconds, by the clock: another each time. A decision is all that a pilot does at one
/// command: sensor, estimator, laws of all that it minds, courses.
struct RunTimes {
  std::uint64_t decisions = 0;
  double mean = 0, within = 0, worst = 0;  // of a decision; 99 % of them took no longer than `within`
  double proofs = 0;                       // of all pairs and passages together
};

struct Run {
  std::vector<Track> tracks;                // one a body
  double end = 0;                           // s
  std::vector<EncounterSample> encounters;  // by time, agent, obstacle
  std::vector<PlaneSample> planes;
  std::vector<SightSample> sights;           // of agents with a sensor; by time, agent, obstacle
  std::vector<VehicleSample> vehicles;       // by time, body
  std::vector<VehicleBeyond> limits_broken;  // the first of each vehicle that broke one
  std::vector<Event> events;                 // by time
  std::vector<PairOutcome> proofs;           // every pair of bodies that are there together, but:
  std::vector<NotChecked> not_checked;
  std::vector<OrificeSample> orifices;     // by time, agent
  std::vector<PassageOutcome> passages;    // of every body that is flown, and every orifice
  std::vector<CorridorOutcome> corridors;  // by agent, goal; of those that it set out for
  std::vector<PlansProved> plans;  // of every guarded pilot that commanded, in the order of their bodies
  bool interrupted = false;
  RunTimes times;

  /// touched if any pair or body and orifice touched; else undecided if any is; else avoided, of none too.
  [[nodiscard]] ProofVerdict verdict() const;
};

struct RunOptions {
  bool prove = true;
  bool log = true;          // encounters, planes, sights, and when agents with a sensor cross a cone
  std::uint64_t trial = 0;  // other noise of the same seed
  /// Called after every step with the time reached; false ends the run there, `interrupted`.
  std::function<bool(double t)> progress;
  /// Called before every proof with the share of them that is done; false as above, without those to come.
  std::function<bool(double share)> proving;
};

/// Deterministic, but for `times`. Throws InputError like check().
[[nodiscard]] Run simulate(const Scenario& scenario, const RunOptions& options = {});

/// The first event of a kind, at or after a time; `obstacle` and `agent` by name.
[[nodiscard]] std::optional<Event> find_event(const Scenario& scenario, const Run& run, EventKind kind,
                                              const std::string& agent, const std::string& obstacle,
                                              double after = 0);

/// The sample of an encounter nearest in time; nothing where there is none within one step.
[[nodiscard]] std::optional<EncounterSample> sample_at(const Scenario& scenario, const Run& run,
                                                       const std::string& agent, const std::string& obstacle,
                                                       double t);

}  // namespace vericone::simulation
