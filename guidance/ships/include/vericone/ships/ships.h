// SPDX-License-Identifier: BSD-3-Clause
//
// Ships that keep the rules of the road (COLREG 1972, rules 13 to 17) and each other's domains, and the proof
// of their voyages (docs/explanation/ships.md). The plane: x east, y north, m; angles counter-clockwise from
// x, rad; m/s. Starboard is to the right. All motion is through the water, which a current carries along.
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/simulation/proof.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace vericone::ships {

/// A ship as another one sees it.
struct Sighting {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
  Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();    // from stern to bow, of any length but 0
};

/// The closest point of approach (CPA) of two ships that keep their velocities.
struct ClosestApproach {
  double time = 0;      // s, TCPA; negative: behind them; 0 without relative velocity
  double distance = 0;  // m, DCPA
};
/// With c the second position less the first and w the first velocity less the second: c.w / |w|^2 and
/// |c x w| / |w|, to four roundings of c and w, however near zero they come.
[[nodiscard]] ClosestApproach closest_approach(const Sighting& a, const Sighting& b);

/// Sign of DCPA less `distance`, decided exactly for the numbers given: negative where the ships, if they
/// keep their velocities, come nearer than that at some time, past or to come. Without relative velocity by
/// their present distance. Throws InputError naming "distance", "a.position", ...
[[nodiscard]] Sign compare_approach(const Sighting& a, const Sighting& b, double distance);

/// What the rules call an encounter, as the first of two ships sees it.
enum class Encounter : std::uint8_t {
  none,               // they do not come nearer
  head_on,            // rule 14: each within 11.25 degrees of ahead of the other
  overtaking,         // rule 13: comes up from more than 22.5 degrees abaft the other's beam
  overtaken,          // the other one does
  crossing_give_way,  // rule 15: has the other on her own starboard side
  crossing_stand_on,  // has her on her port side
  doubtful,           // each has the other on the same side, or abaft her beam: both keep out of the way
};
[[nodiscard]] const char* to_string(Encounter encounter);

/// Exact for the numbers given: 22.5 and 11.25 degrees are no rational numbers, but the signs that decide are
/// those of polynomials (docs/explanation/ships.md). With both exchanged the encounter is seen from the other
/// ship: overtaking and overtaken, give-way and stand-on change places. "Nearly reciprocal" is not a number
/// in rule 14; a point of the compass, 11.25 degrees, is chosen. Says nothing of the risk of collision.
/// Throws InputError naming "a.position", "b.ahead", ... where one is not finite, or ahead is zero. Cost: 50
/// ns; a few us where rounding cannot decide.
[[nodiscard]] Encounter classify(const Sighting& a, const Sighting& b);

/// The part of the effort to keep clear, without unit, by rules 14 to 17: 1 of who gives way, in head-on and
/// doubtful encounters of both; 0 of who stands on.
[[nodiscard]] double share_of_effort(Encounter encounter);

/// The elliptic water about a ship that others are to keep out of.
struct Domain {
  Eigen::Vector2d half{600, 300};  // semi-axes ahead and abeam, m
  Eigen::Vector2d center{0, 0};    // ahead and to port of the ship's own, m

  /// 4 by 1.6 lengths about the ship (Fujii and Tanaka, Traffic capacity, J. Navigation 24, 1971, p. 543).
  [[nodiscard]] static Domain fujii(double length);
  /// 5 by 2.5 lengths about a point 1.1 lengths ahead and 0.75 to starboard: 6.1 ahead, 3.9 astern, 3.25 to
  /// starboard, 1.75 to port (Coldwell, Marine traffic behaviour in restricted waters, J. Navigation 36,
  /// 1983, p. 430, head-on and crossing).
  [[nodiscard]] static Domain coldwell(double length);
  /// 6 by 1.75 lengths about the ship (the same, overtaking).
  [[nodiscard]] static Domain coldwell_overtaking(double length);
  /// The ellipse of least area, to 1 %, that contains the three sectors of Goodwin (A statistical study of
  /// ship domains, J. Navigation 28, 1975, p. 328): 0.85 nautical miles to starboard, 0.7 to port, both from
  /// ahead to 112.5 degrees, 0.45 astern.
  [[nodiscard]] static Domain goodwin();

  /// As it lies about a ship that heads along `heading`, rad.
  [[nodiscard]] Ellipse about(const Eigen::Vector2d& position, double heading) const;
  /// m, of its farthest point from the ship's own, rounded up.
  [[nodiscard]] double reach() const;
};

enum class Side : std::uint8_t { port, starboard };
[[nodiscard]] const char* to_string(Side side);

/// Velocities v with normal.v >= offset.
struct VelocityHalfPlane {
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  // of length 1
  double offset = 0;                                 // m/s
};
/// The side of passing as a constraint: velocities of `a` that keep clear of `b` with b on that side of a.
/// The collision cone of two ellipses is a sector of relative velocities; half of the others, those beyond
/// its other edge, pass on the wrong side, and the half-plane leaves both away. Velocities with which they
/// come no nearer pass nothing and need no such row. Throws InputError naming "bodies" unless they are apart.
/// Cost: that of sector_by_support, to its rounding.
[[nodiscard]] VelocityHalfPlane pass_with(Side side, const Ellipse& a, const Ellipse& b,
                                          const Eigen::Vector2d& velocity_of_b);

/// How a ship answers her rudder and her engine. Nomoto's first-order lag in lengths of the way, so that a
/// turning circle has the same radius at any speed: with k the curvature of the way, s its length and r the
/// rudder's command, |r| <= 1/radius: lag dk/ds = r - k (Nomoto's T' L; K' of the ship is in `radius`).
struct Handling {
  double length = 150, beam = 24;  // m
  double radius = 450;             // m, of the tightest turning circle (IMO MSC.137(76): at most 2.5 lengths
                                   // of tactical radius)
  double lag = 150;                // m
  double faster = 0.01;            // m/s^2, at most
  double slower = 0.02;            // m/s^2, at most; also what she stops with
};

struct Ship {
  Handling handling;
  Domain domain = Domain::coldwell(150);
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double heading = 0;                                  // rad
  double speed = 6;                                    // m/s, through the water
  double curvature = 0;                                // 1/m, of her way; to port positive
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  // m; over the ground she keeps the line that leads there
  double wished = 6;                               // m/s, through the water
  bool gives_way = true;  // false: acts by no rule, but sails proved commands as all do
};

struct FleetOptions {
  double step = 10;                                   // s between two commands
  double horizon = 1200;                              // s: a risk of collision is foreseen so early
  double room = 1.2;                                  // times the domain, that courses are chosen for
  Eigen::Vector2d current = Eigen::Vector2d::Zero();  // m/s, of the water, the same everywhere
};

struct FleetCounts {
  std::uint64_t commands = 0;   // ships times steps
  std::uint64_t fallbacks = 0;  // of them those in which a ship stopped because nothing else was proved
};

/// What became of a pair, and what is proved of it.
struct PairOfShips {
  std::size_t a = 0, b = 0;
  ClosestApproach at_start;               // of the velocities at the start
  Encounter starts_as = Encounter::none;  // a's, at the start, whether there is a risk or not
  Encounter encounter = Encounter::none;  // a's, when a risk was first seen; none: there was no risk
  double seen = -1;                       // s, when; -1: never
  bool side_kept = true;                  // no command of who gives way was chosen without the rules' side
  bool stand_on_acted = false;            // rule 17(b)
  double stand_on_turned =
      0;  // rad, the most that who stands on, and gave way to nobody yet, left her course before
  Side passed = Side::port;  // of a, on which b was left: by the relative velocity when they were nearest
  bool risk_when_nearest = false;    // whether the encounter was still on then
  double nearest = 0;                // m, their least distance, of middles, at commands
  double least_domain_distance = 0;  // m: no hull came nearer to the other's domain: proved
  simulation::ProofVerdict verdict = simulation::ProofVerdict::undecided;  // avoided: both domains kept
};

struct ShipSample {
  double t = 0;  // s
  std::vector<Eigen::Vector2d> positions;
  std::vector<double> headings, speeds;
};

struct VoyageOptions {
  double duration = 10800;                          // s, at most; ends when all have passed their goals
  double sample = 30;                               // s between two samples
  std::function<bool(double share)> progress = {};  // false ends the voyage, `interrupted`
};

struct Voyage {
  double end = 0;                  // s
  std::vector<double> arrived;     // of each ship when she passed her goal, s; infinite: not
  std::vector<double> path;        // of each, m through the water until then
  std::vector<PairOfShips> pairs;  // all
  FleetCounts counts;
  std::vector<ShipSample> samples;
  bool interrupted = false;

  /// Of all pairs: proved that no hull came into another's domain.
  [[nodiscard]] bool kept() const;
};

/// Sails until all have passed their goals, and proves of every pair, over the whole time, that neither hull
/// was in the other's domain (docs/explanation/ships.md). Deterministic. Throws InputError naming
/// "ships[i].speed", ..., "step", "duration", or "ships[i]" where the stop of a ship, sailed from the start,
/// is not proved clear of those of the others.
[[nodiscard]] Voyage sail(const std::vector<Ship>& ships, const FleetOptions& options = {},
                          const VoyageOptions& voyage = {});

[[nodiscard]] const std::vector<std::string>& encounter_names();
/// imazu-01 to imazu-22: own ship first (docs/explanation/ships.md has the sources); harbour. Throws
/// InputError naming "name".
[[nodiscard]] std::vector<Ship> ships_of(const std::string& name);

}  // namespace vericone::ships
