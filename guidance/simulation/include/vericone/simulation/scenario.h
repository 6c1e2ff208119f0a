// SPDX-License-Identifier: BSD-3-Clause
//
// What a run is made of. Read from YAML by the command (docs/reference/scenarios.md).
#pragma once

#include <vericone/guidance/guide.h>
#include <vericone/guidance/orifice_law.h>
#include <vericone/simulation/curve.h>
#include <vericone/simulation/proof.h>
#include <vericone/simulation/sensor.h>
#include <vericone/simulation/track.h>
#include <vericone/simulation/vehicle.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

/// Where an agent wants to go once nothing threatens it. Turning towards it may cost a margin what one step
/// turns, before the law is asked again.
struct Goal {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // m
  double most = 0;                                  // m/s^2, with which it turns towards the point
  std::string after;   // obstacle that has to be passed first; empty: none, or all orifices
  double reached = 1;  // metres; when all agents with goals have been this near the run ends
};

/// How a pilot avoids.
enum class Manner : std::uint8_t {
  /// On courses that no cone holds, tested against every body that it minds (guidance::Navigator), its goal
  /// pursued on such a course only. Of the laws avoidance and clearance; the metres to keep are those of
  /// `guide.clearance` for the clearance law, else a part of the agent's size.
  guarded,
  /// As the source does: the law's own command for the body met first, without regard of others; to the goal
  /// whenever that is silent. The other laws know this manner alone.
  source,
};

/// When a body is passed: from then on the law is not asked until they close again, and goals `after` it
/// open.
enum class Passing : std::uint8_t {
  bisector,  // the centres recede, and so does the relative velocity along the cone's bisector, V_r_hat >= 0
             // (5.1)
  centres,   // V_r >= 0; always of the clearance law, which knows no cone
};

/// The way through orifices, one after the other. An orifice is behind the agent when its reference point has
/// crossed the plane inside the rim and all of its body has left the plane.
struct Through {
  enum class Law : std::uint8_t {
    orifice,  // the source's (2.4), of the circle about the centre that the rim holds and the ball about the
              // agent
    passage,  // ours, of the true outlines
  } law = Law::passage;
  std::vector<std::string> orifices;  // names, in this order
  /// These laws see no bodies. A scenario that has others is refused unless this says that it is meant so:
  /// whether they were met is proved, nothing is done about it.
  bool minds_none = false;
  guidance::OrificeLawOptions source;
  guidance::PassageLawOptions passage;
  /// m/s, held by an acceleration along the velocity (of a vehicle along its level part: depth is its
  /// control's) of gain_speed times what is missing. One for all orifices, or one for each; empty: nothing is
  /// done about it.
  std::vector<double> speeds;
  double gain_speed = 1;  // 1/s
};
[[nodiscard]] const char* to_string(Through::Law law);

/// What flies a body. Bodies without one keep their velocity.
struct Pilot {
  /// In place of a law about bodies: `guide`, `manner`, `passing`, `minds`, `partners` and sensors are not
  /// read.
  std::optional<Through> through;
  guidance::GuideOptions guide;
  Manner manner = Manner::guarded;
  Passing passing = Passing::bisector;
  /// Names of what is avoided (met, for rendezvous). Empty: all other bodies, except for a partner's own
  /// agent.
  std::vector<std::string> minds;
  /// Cooperative laws: the body that carries out the second acceleration. Has no pilot of its own.
  std::vector<std::string> partners;
  std::optional<Goal> goal;
  /// What it measures of the bodies it minds; left out: it knows them. Its law sees nothing else, so neither
  /// does it know when a body has been passed but by what it measures.
  std::optional<Sensor> sensor;
  Estimator estimator = Estimator::none;
  double estimator_intensity = 0;  // m^2/s^3, of Estimator::state: white acceleration of the bodies minded
  double obstacle_most = 0;        // m/s^2, of Estimator::set_membership: what they can accelerate at most
};

struct Body {
  std::string name;
  ShapeInTime shape;
  Motion start;  // at `appears`
  Orientation orientation = Orientation::heading;
  double appears = 0;  // s
  std::optional<Pilot> pilot;
  /// What moves it in place of a point mass under its pilot's acceleration; its orientation is the vehicle's.
  std::shared_ptr<const VehicleModel> vehicle;
  /// What a body without pilot and vehicle follows, to 1e-6 m and rad, in place of its velocity; its time
  /// begins when the body appears. `start` is start_of it.
  std::shared_ptr<const Road> road;
};

struct Scenario {
  std::string name;
  double duration = 10;           // s, at most
  double step = 0.01;             // s, between two commands, which are held in between
  bool stop_when_passed = false;  // ends when every agent has passed all that it minds, and none is to come
  int planes_logged = 0;          // y and psi are logged on this many planes (Fig 6.9)
  std::vector<Body> bodies;
  Current water;  // that vehicles swim in
  std::vector<MovingOrifice> orifices;
  ProofOptions proof;
  std::uint64_t seed = 1;  // of all noise
};

/// Whether this pilot's courses are guarded: of the laws that can be.
[[nodiscard]] bool guarded(const Pilot& pilot);

/// What the law of this pilot commands at most, m/s^2; infinite where it has no limit.
[[nodiscard]] double most_commanded(const Pilot& pilot);

/// The time of the k-th command, seconds. Of steps such as 0.01 s, a whole number of which is a second, the
/// double nearest to the decimal: 1.63 and not 1.6300000000000001.
[[nodiscard]] double time_of_step(const Scenario& scenario, std::uint64_t k);

/// Throws InputError with the field's path: "bodies[2].shape.k", "bodies[0].pilot.minds[1]", ...
void check(const Scenario& scenario);

}  // namespace vericone::simulation
