// SPDX-License-Identifier: BSD-3-Clause
//
// Many agents that give way to each other, each with a stop in hand that is proved apart from all others'
// (docs/explanation/swarms.md), and the published method, ORCA, beside it.
#pragma once

#include <vericone/simulation/pilot.h>
#include <vericone/simulation/proof.h>
#include <vericone/simulation/scenario.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vericone::swarm {

/// An ellipsoid, or a box, about its centre.
struct Solid {
  Eigen::Vector3d half = Eigen::Vector3d::Ones();          // semi-axes, or half widths, m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // of its axes in the world
  bool box = false;

  [[nodiscard]] static Solid ball(double radius) { return {Eigen::Vector3d::Constant(radius)}; }
  [[nodiscard]] double reach() const;  // m, of its farthest point from its centre
};

/// The plane that two agents share: the first one's velocity relative to the second one's is to be on the
/// normal's side of relative velocity + change.
struct ReciprocalPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of length 1, away from velocities that lead to contact
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  // m/s
};

/// By what the boundary's nearest velocity is found.
enum class Nearest : std::uint8_t {
  in_shape,  // in coordinates in which the sum of both shape matrices is 1: there ORCA's form is exact
  in_speed,  // in m/s, on the cone's side; at the cut-off as the other
};

/// ORCA's plane (van den Berg, Guy, Lin, Manocha, Reciprocal n-body collision avoidance, 2011, section 4) of
/// two bodies that will touch within `horizon` seconds: at the relative velocity on the boundary of those
/// velocities that is nearest to the present one. Nearest in the coordinates in which S_1 + S_2, the sum of
/// both shape matrices, is the unit matrix: there balls, and ellipsoids of one shape and attitude, are balls,
/// and the closed form is exact; of other ellipsoids the ball that osculates their sum at the contact is
/// exchanged until it stays. A box at the second place: the plane between the bodies as they stand,
/// approached at no more than the gap over the horizon. `between`: second centre less first, m; `velocity`:
/// first less second, m/s. Bodies that overlap: `horizon` is to be the step. With both exchanged all is
/// negated, bit for bit. Cost: 50 ns for balls, 0.4 us for ellipsoids.
[[nodiscard]] ReciprocalPlane reciprocal_plane(const Solid& first, const Solid& second,
                                               const Eigen::Vector3d& between,
                                               const Eigen::Vector3d& velocity, double horizon,
                                               Nearest nearest = Nearest::in_shape);

/// Velocities v with normal.v >= offset, m/s.
struct VelocityHalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of length 1
  double offset = 0;
};

struct VelocityFound {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  double violation = 0;                                // m/s, the most by which a half-space is left; 0: none
};

/// The velocity nearest to `wished` among those of at most `fastest` m/s in all half-spaces; where there is
/// none, the one that leaves them by the least (the paper's section 5.3). To rounding. Cost: linear in the
/// number of half-spaces in most cases, 2 us for a hundred.
[[nodiscard]] VelocityFound nearest_velocity(const std::vector<VelocityHalfSpace>& half_spaces,
                                             double fastest, const Eigen::Vector3d& wished);

struct Agent {
  Solid body;                                          // an ellipsoid
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
  std::vector<Eigen::Vector3d> goals;                  // one after the other; at the last it stays, m
  double share = 1;   // of the effort beside the other's: 0 gives no way by itself, but flies proved commands
  double wished = 1;  // m/s, towards its goal
  double fastest = 2;  // m/s
  double most = 2;     // m/s^2, any way; ORCA changes its velocity at once and has no such bound
  /// rad/s: at most so fast its first axis turns towards its velocity, about the axis across both; 0: it
  /// keeps its attitude. ORCA's balls do not turn.
  double turning = 0;
  /// A law of its own, in place of planes: what it wants, of what is in sight, agents first, obstacles after.
  /// What is flown of it is proved as of all others. Called for one agent after the other.
  simulation::Steering steering = {};
};

/// At rest, and gives no way.
struct Obstacle {
  Solid body;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
};

enum class Method : std::uint8_t {
  proved,  // commands that are proved apart, with the stop after them, from all that others may do
  orca,    // as published, with the balls about the bodies
};
[[nodiscard]] const char* to_string(Method method);

struct SwarmOptions {
  Method method = Method::proved;
  double step = 0.125;          // s between two commands
  double horizon = 20;          // s within which a plane foresees contact
  double box_horizon = 2;       // s, of boxes
  double sight = 15;            // m, of centres: as far as planes are made
  std::size_t neighbours = 25;  // of the nearest of them; the proof minds all that can come near
  double lost = 0;              // of the messages of one agent to another the share that does not arrive
  std::uint64_t seed = 1;       // of what is lost
  int threads = 1;

  /// ORCA with the horizon and the neighbours of RVO2-3D's examples.
  [[nodiscard]] static SwarmOptions published();
};

/// What an agent did in a step: from `position` with `velocity` for `seconds` with an acceleration, then at
/// rest.
struct Flown {
  Eigen::Vector3d position, velocity, acceleration;  // m, m/s, m/s^2
  double seconds = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  // rad, in world axes, in those seconds at a constant rate
};

struct SwarmCounts {
  std::uint64_t commands = 0;   // agents times steps
  std::uint64_t fallbacks = 0;  // of them those in which an agent that was on its way braked instead
  std::uint64_t unsafe = 0;     // of them those in which ORCA found no velocity that keeps all planes
  std::uint64_t deadlocks = 0;  // that were found, and turned out of
};

/// Agents step by step. Deterministic, whatever the number of threads.
class Swarm {
 public:
  /// Throws InputError naming "agents[i].body.half[k]", "agents[i].goals", ..., "obstacles[i]...", "step",
  /// or "agents[i]" where its stop is not proved apart from another one's or an obstacle (not of ORCA).
  Swarm(std::vector<Agent> agents, std::vector<Obstacle> obstacles, const SwarmOptions& options);
  Swarm(Swarm&&) noexcept;
  Swarm& operator=(Swarm&&) noexcept;
  ~Swarm();

  /// Throws InputError where an agent gets farther than 1e5 m from the origin, or its own law says no finite
  /// acceleration. Cost: docs/measured/swarms.md.
  void step();

  [[nodiscard]] double time() const;  // s
  [[nodiscard]] const std::vector<Agent>& agents() const;
  [[nodiscard]] const std::vector<Obstacle>& obstacles() const;
  [[nodiscard]] const std::vector<Flown>& flown() const;  // in the last step
  [[nodiscard]] const SwarmCounts& counts() const;
  [[nodiscard]] const SwarmOptions& options() const;
  /// Of each agent which of its goals it heads for; as many as it has where it has reached the last one: has
  /// been nearer to it than its reach. Goals before the last are passed as well where the next is nearer.
  [[nodiscard]] const std::vector<std::size_t>& heading() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A swarm to begin with.
struct Start {
  std::vector<Agent> agents;
  std::vector<Obstacle> obstacles;
};
[[nodiscard]] const std::vector<std::string>& start_names();
/// circle, sphere, crossing, gap, forest, slender, turning: docs/explanation/swarms.md. Positions are
/// scattered by 1 cm by the seed, bodies of the forest drawn by it. Throws InputError naming "name", "agents"
/// or "bodies".
[[nodiscard]] Start start_of(const std::string& name, std::size_t agents, std::uint64_t seed);

/// Bodies at rest, and agents in the free space amid them, drawn by the seed: balls of 0.2 m, 1 m/s, each
/// with a goal 3 m off or more, the straight way there 0.5 m from all bodies. Throws InputError naming
/// "agents" where there is no such place for so many. Cost: linear in the bodies, 10 ms an agent in a map of
/// 100,000 boxes.
[[nodiscard]] Start start_amid(std::vector<Obstacle> obstacles, std::size_t agents, std::uint64_t seed);

/// Of a scenario: ellipsoids with a pilot that has goals are agents, which its `most` and `fastest` bound;
/// bodies without pilot, at rest, obstacles: ellipsoids, boxes, maps. Bodies that turn with their heading do
/// so at 1 rad/s at most. Throws InputError naming "bodies[i]..." where a body is neither.
[[nodiscard]] Start start_of(const simulation::Scenario& scenario);

struct TouchedPair {
  std::size_t a = 0, b = 0;  // agents; from the number of agents on obstacles
  double from = 0, to = 0;   // s: apart before `from`, meeting at `to`, both proved
};

struct FlightOptions {
  double duration = 600;  // s, at most; ends when all have arrived
  bool prove = true;
  double sample = 1;                                // s between two rows of `samples`
  std::function<bool(double share)> progress = {};  // false ends the flight, `interrupted`
};

struct SwarmSample {
  double t = 0;                            // s
  std::vector<Eigen::Vector3d> positions;  // of each agent, m
};

struct SwarmFlight {
  double end = 0;                    // s
  std::vector<double> arrived;       // of each agent when, s; infinite: not
  std::vector<double> path;          // of each, m flown until it arrived
  std::vector<double> straight;      // of each, m from its start along its goals to where it may arrive
  std::vector<TouchedPair> touched;  // proved
  std::vector<TouchedPair>
      undecided;              // nearer than the proof of runs resolves in [from, to], never proved to meet
  double least_distance = 0;  // m: all others were never nearer, proved; infinite where there is no pair
  SwarmCounts counts;
  std::vector<SwarmSample> samples;
  double stepping = 0, proving = 0;  // s by the clock
  bool interrupted = false;
};

/// Flies until all have arrived, and proves every pair, agents and obstacles, over the whole time
/// (docs/explanation/swarms.md). Memory is linear in the number of agents and samples. Throws InputError
/// naming "duration" or "sample".
[[nodiscard]] SwarmFlight fly(Swarm& swarm, const FlightOptions& options);

}  // namespace vericone::swarm
