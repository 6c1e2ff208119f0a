// SPDX-License-Identifier: BSD-3-Clause
//
// What flies a body and what it measures of others, which move, and are proved, as they truly are: a law with
// its parameters as a file has them (Pilot), and the object that answers for it (PilotModel; the one under
// way: internal/simulation/flying_pilot.h). A new law is one (docs/howto/add-a-law.md).
#pragma once

#include <vericone/guidance/guide.h>
#include <vericone/guidance/kinematics.h>
#include <vericone/guidance/orifice_law.h>
#include <vericone/guidance/robust_law.h>
#include <vericone/simulation/track.h>
#include <vericone/simulation/vehicle.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vericone::simulation {

struct Body;
struct Scenario;
struct RunOptions;
struct ReachLimits;
class FlyingPilot;
class PilotModel;

/// What errors are made of position and velocity, at every command. Shape and attitude are known.
enum class Noise : std::uint8_t {
  /// (7.2): of r, V_r and V_theta parts of the true value, of theta, theta_b and psi angles, each times m. Of
  /// the avoidance law; it acts on the plane that the law looks at.
  engagement,
  /// (7.27): along each axis of the world a part of the true relative position and velocity there, times m.
  /// So
  /// it depends on the axes, and vanishes where a component is 0.
  per_axis,
  isotropic,  // along each axis metres and metres a second, times m
  bounded,    // uniform in balls of these radii, m and m/s: nothing is ever beyond them
};
[[nodiscard]] const char* to_string(Noise noise);

struct Sensor {
  Noise noise = Noise::isotropic;
  guidance::EngagementParts engagement;  // of Noise::engagement
  double position = 0, velocity = 0;     // parts, or m and m/s: of the others
  double deviation = 1;                  // standard deviation of m; the source has 1/3
  /// One m for all channels of a measurement, the literal reading of m(t); otherwise each has its own, as the
  /// source's variances assume.
  bool shared = false;
  // When it measures; between measurements a body goes on as it was measured last.
  double period = 0;   // s, from one to the next; 0: at every command
  double delay = 0;    // s, after which one arrives
  double dropout = 0;  // share of measurements that never arrive
  double bias = 0;     // m, of every position of one body, in a direction drawn once
  // What it sees; a body that it has never seen is not minded.
  double range = std::numeric_limits<double>::infinity();  // m, from the agent to the nearest of the body
  double view = std::numeric_limits<double>::infinity();   // rad, to each side of the heading
  bool occluded = false;                                   // not what is behind other bodies

  /// All errors times a number.
  [[nodiscard]] Sensor times(double factor) const;
};

/// What the law is given of a measured body.
enum class Estimator : std::uint8_t {
  none,
  state,  // ConstantVelocityFilter, told how large the errors usually are
  /// SetMembershipFilter, told their bounds: for Noise::bounded. The middle of what is possible.
  set_membership,
};
[[nodiscard]] const char* to_string(Estimator estimator);

/// Numbers that depend on what they are for alone: the same for every law, number of threads and order.
struct Draw {
  std::uint64_t seed = 0, trial = 0;
  std::uint64_t pair = 0;  // which agent sees which body
  std::uint64_t step = 0;  // number of the command

  /// Uniform in (0, 1), and standard normal, dimensionless, of a channel.
  [[nodiscard]] double uniform(std::uint64_t channel) const;
  [[nodiscard]] double normal(std::uint64_t channel) const;
};

/// Position and velocity of a body as measured, and their standard deviations along each axis (m, m/s). Of
/// Noise::engagement they are the true ones.
struct Measurement {
  Eigen::Vector3d position, velocity;
  Eigen::Vector3d position_deviation = Eigen::Vector3d::Zero(), velocity_deviation = Eigen::Vector3d::Zero();
};

/// Of B by A, which knows itself. Planar bodies stay in their plane.
[[nodiscard]] Measurement measure(const Sensor& sensor, const guidance::BodyState& a,
                                  const guidance::BodyState& b, const Draw& draw);

/// Throws InputError naming "noise", "position", "velocity", "deviation", "r", "theta", ...
void check(const Sensor& sensor);

/// Where an agent wants to go once nothing threatens it. Turning towards it may cost a margin what one step
/// turns, before the law is asked again.
struct Goal {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // m
  double most = 0;                                  // m/s^2, with which it turns towards the point
  std::string after = {};  // obstacle that has to be passed first; empty: none, or all orifices
  double reached = 1;      // metres; when all agents have been this near to all their goals the run ends
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the point, from the start of the run
  std::string follows = {};  // body from whose reference point `point` is, in the axes of the world; or none
  double stay = 0;           // s there, before the next goal
  /// m: so near to the leg that leads to it a guarded pilot stays with all of its body; it may change its
  /// speed.
  double corridor = std::numeric_limits<double>::infinity();
  std::optional<Eigen::Vector3d> from =
      {};  // m, where the leg begins; left out: the goal before, or the start
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
  /// In place of all the laws below, of which nothing but `partners` and `goals` is read then.
  std::shared_ptr<const PilotModel> own;
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
  std::vector<Goal> goals;  // one after the other
  /// m/s: it goes to its goals at this speed, and never faster. Of a guarded pilot that may change its speed.
  double fastest = std::numeric_limits<double>::infinity();
  std::size_t looks = 0;   // of a guarded pilot, NavigatorOptions::looks
  double others_most = 0;  // m/s^2, of a guarded pilot, NavigatorOptions::others_most
  std::vector<std::pair<std::string, double>> others_most_of;  // m/s^2, by name, in place of it
  /// What it measures of the bodies it minds; left out: it knows them. Its law sees nothing else, so neither
  /// does it know when a body has been passed but by what it measures.
  std::optional<Sensor> sensor;
  Estimator estimator = Estimator::none;
  double estimator_intensity = 0;  // m^2/s^3, of Estimator::state: white acceleration of the bodies minded
  double obstacle_most = 0;        // m/s^2, of Estimator::set_membership: what they can accelerate at most
};

/// A kind of pilot with its parameters.
class PilotModel {
 public:
  virtual ~PilotModel() = default;
  /// Throws InputError naming the pilot's field where it cannot fly `self`: what it minds or goes through is
  /// not there, or of a kind that it does not see.
  virtual void check(const Scenario&, const Body& /*self*/) const {}
  /// For body `self` of a scenario that is checked; scenario and model outlive it.
  [[nodiscard]] virtual std::unique_ptr<FlyingPilot> launch(const Scenario& scenario, std::size_t self,
                                                            const RunOptions& options) const = 0;
  /// Of its law, for texts.
  [[nodiscard]] virtual std::string name() const { return "own"; }
  /// What it commands at most, m/s^2; infinite where it has no limit.
  [[nodiscard]] virtual double most() const { return std::numeric_limits<double>::infinity(); }
  /// What no motion exceeds of a point mass that it flies, commanded every `step` s.
  [[nodiscard]] virtual ReachLimits limits(const Body& body, double step) const;
  /// Metres that it is to keep from another body, by name.
  [[nodiscard]] virtual double required(const std::string& /*other*/) const { return 0; }
  /// Names of the orifices that it is to go through, in this order.
  [[nodiscard]] virtual std::vector<std::string> orifices() const { return {}; }
  /// Its function of a body is a length, m: of others y, dimensionless.
  [[nodiscard]] virtual bool in_metres() const { return false; }
  /// It may start at rest.
  [[nodiscard]] virtual bool may_rest() const { return false; }
};

/// The object that answers for a pilot: its own one, or that of its law. It refers to the pilot.
[[nodiscard]] std::shared_ptr<const PilotModel> model_of(const Pilot& pilot);

/// The acceleration, m/s^2, that a pilot wants: at a time, s, of its body, among all others that are there.
using Steering = std::function<Eigen::Vector3d(double, const guidance::BodyState&,
                                               const std::vector<guidance::BodyState>&)>;
/// One that a function flies, called once a step; what it returns is held. The run throws InputError naming
/// "acceleration" where that is not finite.
[[nodiscard]] std::shared_ptr<const PilotModel> pilot_by(Steering steering);

/// Whether its law is one about bodies, `guide`.
[[nodiscard]] bool minds_bodies(const Pilot& pilot);

/// Whether this pilot's courses are guarded: of the laws that can be.
[[nodiscard]] bool guarded(const Pilot& pilot);

/// What the law of this pilot commands at most, m/s^2; infinite where it has no limit.
[[nodiscard]] double most_commanded(const Pilot& pilot);

}  // namespace vericone::simulation
