// SPDX-License-Identifier: BSD-3-Clause
//
// One agent among many bodies: a course that no cone holds.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/guidance/kinematics.h>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vericone::guidance {

namespace courses {
class Route;
struct Near;
struct Sweep;
struct Wanted;
enum class Meeting : std::uint8_t;
}  // namespace courses

struct NavigatorOptions {
  /// Metres to keep from every body; left out: a twentieth of the agent's half-length.
  std::optional<double> required = {};
  /// Metres more that a course must keep when it is taken; left out: a tenth of it.
  std::optional<double> beyond = {};
  double most = std::numeric_limits<double>::infinity();  // m/s^2, across the velocity
  bool longitudinal = false;  // it may change its speed too: `most` is of the whole acceleration
  // Of who may change its speed:
  double fastest = std::numeric_limits<double>::infinity();  // m/s; given: the speed that it goes at
  double range = std::numeric_limits<double>::infinity();    // m: it comes to rest within what it sees
  /// m/s^2: so much every other body may accelerate, at any time and any way; 0: each keeps its velocity. A
  /// mesh, a cloud, a map or a union that is at rest stays so.
  double others_most = 0;
  /// Distances measured a step, about, at most; 0: as many as it takes, or 400 where a stop is in hand.
  std::size_t looks = 0;
};

/// The leg that an agent is to keep to: all points within `radius` of the line from a point to its
/// destination.
struct Corridor {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  // m
  double radius = 0;                               // m
};

/// Where the agent wants to go.
struct Destination {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     // m
  double most = 0;                                     // m/s^2, with which it turns towards the point
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the point
  bool stay = false;  // who may change its speed comes to rest there, or goes on with the point
  /// Of who may change its speed: it stays in it with all of its body, and courses end at rest there.
  std::optional<Corridor> corridor = {};
};

enum class NavigatorStatus : std::uint8_t {
  straight,      // nothing to avoid, nowhere to go
  homing,        // goes to its destination, or points at it
  avoiding,      // on a course beside the one that it wants
  too_near,      // every course tried comes nearer to a body than required, this one least
  cannot_avoid,  // every course tried hits a body, this one last
  no_course,     // at rest, and must not change its speed; nothing hits it
};
[[nodiscard]] const char* to_string(NavigatorStatus status);

struct NavigatorStep {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, across the velocity
  NavigatorStatus status = NavigatorStatus::straight;
  bool aligned = false;  // points at the destination
  /// Of the course flown, as far as it is judged: metres to what it comes nearest to, to a hundredth; where
  /// it hits, negative: how far aside the agent would have to be at the first contact to pass (of many
  /// pieces, the one touched first). Infinite without bodies. `nearest`: its index in `others`.
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  /// s from now when it is at rest by the course flown; infinite: that goes straight on for ever.
  double rest = std::numeric_limits<double>::infinity();
  /// s from now when it begins to circle for ever by the course flown; infinite: never.
  double circles = std::numeric_limits<double>::infinity();
  /// The course flown is proved to stay in the corridor, if there is one.
  bool inside = true;
  /// Of the course flown: metres, at most what is required, that it is proved to keep from every body until
  /// `until`, if the agent flies as it is commanded and all that it is given is so; nothing where that it
  /// touches none is not proved. Never nothing where the status is straight, homing or avoiding; there it may
  /// be a fiftieth less than required, or what is kept by who is nearer already.
  std::optional<double> proved = {};
  /// s from now: its end at the destination, or as long as it counts within a body; where others may
  /// accelerate, when it is at rest; else infinite.
  double until = std::numeric_limits<double>::infinity();
};

/// Where a course has the agent.
struct PlannedMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s
};

/// Flies by courses: turn to a direction on a circle, as hard as allowed, then straight on; where the speed
/// may change (`longitudinal`), accelerate to a velocity, as hard as allowed, then straight on. What a course
/// keeps is its least distance to any body, each going on as it does now, for ever (the way to the
/// destination: until there); it is safe if it keeps what is required. Whoever flies a safe course and is
/// among bodies that keep their velocities has a safe course at every later step: the one it is on. So it
/// takes the way to its destination where that is safe, else stays on its course while that is, and looks for
/// a better one twice a second; velocities are tried outwards from the one it wants.
///
/// The same courses are tried whatever is required. Where none is safe it takes the one that keeps most, and
/// where all hit the one that hits last: asking for more never makes a decision hit. Before it says so it
/// looks for further courses that may follow that one, and holds what it finds.
///
/// Who may change its speed goes to its destination at `fastest`, or at the speed of its first step; without
/// either, as fast as it can still stop there. Without a destination it goes back to the speed of its first
/// step: who was at rest stops again. Where no straight line is safe for ever, and within the bounds of a
/// body that is judged as it is, its courses end at rest: the command of this step, then braking as hard as
/// allowed, and staying there. Such a stop is then in hand at every step, and is flown where nothing else is
/// found. There it also looks for a way to its destination among the bodies at rest, some hundred cells a
/// step, and goes to the farthest point of it that it sees. At rest without `longitudinal` it stays.
///
/// Who keeps its speed has a circle in hand in place of a stop, within such bounds: its courses turn, go
/// straight on for the command of a step, and then round and round as tightly as allowed; that is judged for
/// ever. Where there is no room for any circle its courses are judged for a while, below.
///
/// In a corridor courses are tried that stay in it. Where none does (the agent is too fast, or a gust took it
/// out) the step says so, `inside`, and is taken as without a corridor; out of it already, the agent goes no
/// farther out while it can.
///
/// Placed bodies that do not turn are judged as they are (of combined quadrics in unions what their
/// delimiters cut away counts too), so that an agent can fly through them; within the bounds of one, where
/// every straight line may end at a wall, a course at constant speed that ends on no circle is judged for
/// half a second more than it takes to turn right round. Other bodies stand for themselves as ellipsoids that
/// contain them; one that turns or changes its shape by the ball about it. Deterministic. No allocation once
/// it has searched, but for a way round walls.
///
/// Cost: where the course is kept 0.2 to 0.3 us an ellipsoid among many, 20 to 200 us a map of 140,000 boxes
/// that the agent is in; where a course is looked for up to 30 ms, where all hit up to 0.3 s, in a map with a
/// stop in hand up to 10 ms (docs/measured/guidance.md).
class Navigator {
 public:
  /// Throws InputError naming "required", "beyond" or "others_most" unless finite and not negative, and
  /// "most", "fastest" or "range" unless positive (they may be infinite).
  explicit Navigator(const NavigatorOptions& options);

  /// At `time`; the command is held for `step` seconds. Throws InputError naming "step" unless it is positive
  /// and finite, "time", "destination.point", "destination.most" or
  /// "destination.velocity" unless finite, "agent.position" and the
  /// like where it holds a number that is not finite, and "others[i]" where one is planar and the agent is
  /// not, or the other way round; "destination.corridor" unless its radius is positive and finite, its point
  /// finite, the destination at rest, and the speed may change. `others_most`: m/s^2, of each of the others,
  /// in place of that of the options; empty: that. Throws naming it unless there are as many as others,
  /// finite and not negative.
  NavigatorStep step(const BodyState& agent, std::span<const BodyState> others,
                     const std::optional<Destination>& destination, double time, double step,
                     std::span<const double> others_most = {});

  /// Of the course flown since the last step, `seconds` after it: what is proved is proved of that. A step
  /// commands the beginning of it. Throws InputError naming "seconds" unless finite and not negative.
  [[nodiscard]] PlannedMotion planned(double seconds) const;

 private:
  /// A manoeuvre to another velocity, then straight on: a turn about a circle, or a constant acceleration
  /// where the speed may change. It may end at rest: it brakes, and stays where it is; or on a circle.
  struct Course {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();        // m/s, at the end
    Eigen::Vector3d aside = Eigen::Vector3d::Zero();           // unit: of the acceleration now
    double most = 0;                                           // m/s^2, of the acceleration
    double asked = 0;                                          // m/s^2, of which it may be less
    double angle = 0;                                          // rad, of a turn
    double radius = 0;                                         // m, of its circle; 0: no turn
    double turning = 0;                                        // s, how long the manoeuvre takes
    double until = std::numeric_limits<double>::infinity();    // s from its moment, when it ends
    double brakes = std::numeric_limits<double>::infinity();   // s from its moment, when it brakes
    double braking = 0;                                        // s, how long that takes
    double circles = std::numeric_limits<double>::infinity();  // s from its moment, when it begins to circle
    Eigen::Vector3d inward = Eigen::Vector3d::Zero();          // unit: from there to the circle's centre

    [[nodiscard]] double rests() const { return brakes + braking; }
  };
  /// A course that is to follow the one that is flown.
  struct Leg {
    double begin;  // s
    Eigen::Vector3d velocity;
    double most;
  };
  struct Foreseen;
  struct Moment;
  struct Flight;
  struct Choice;
  struct Approach;
  struct Chord;

  struct Body {
    Ellipsoid body;
    Eigen::Vector3d velocity;
    double reach = 0;                                          // of the ball about its centre
    double now = std::numeric_limits<double>::infinity();      // m from the agent, where it is near
    double matters = std::numeric_limits<double>::infinity();  // s: what it does later does not count
    std::optional<Placed> itself = std::nullopt;               // judged as it is; `body` is a ball about it
    mutable Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // to it, when it was last asked how near it is
    double swerves = 0;                                        // m/s^2, so much it may accelerate
    double offset = 0;  // m: so far its middle may be from what it turns about

    [[nodiscard]] bool stays() const { return swerves == 0 && velocity.isZero(0); }

    [[nodiscard]] courses::Near near(const courses::Sweep& sweep, courses::Wanted wanted) const;
    /// Whether the point is nearer than `margin` to the bounds of a body that is judged as it is.
    [[nodiscard]] bool holds(const Eigen::Vector3d& point, double margin) const;
  };
  [[nodiscard]] Body body_of(const BodyState& other, bool planar, double swerves) const;

  NavigatorStep fly(const Moment& now, const std::optional<Destination>& destination, double time);
  [[nodiscard]] bool fails(const Flight& flight, const Body& other, double begin, double end,
                           double hopeless) const;
  [[nodiscard]] bool fails_at(const Flight& flight, const Body& other, double t, double hopeless) const;
  void see_turn(const Flight& flight, const Body& other, double begin, double end, courses::Meeting meeting,
                Approach& seen) const;
  void see_straight(const Flight& flight, const Body& other, double begin, double end,
                    courses::Meeting meeting, Approach& seen) const;
  void see_stop(const Flight& flight, const Body& other, double begin, double end, courses::Meeting meeting,
                Approach& seen) const;
  void see_curved(const Flight& flight, const Body& other, double begin, double end, courses::Meeting meeting,
                  Approach& seen) const;
  [[nodiscard]] Approach see(const Flight& flight, const Body& other, double begin, double enough,
                             double hopeless, courses::Meeting meeting) const;
  [[nodiscard]] static double round_until(const Flight& flight, const Body& other, double enough);
  void see_circle(const Flight& flight, const Body& other, double end, courses::Meeting meeting,
                  Approach& seen) const;
  [[nodiscard]] bool in_sight(const Flight& flight) const;
  [[nodiscard]] double out_of_corridor(const Eigen::Vector3d& position, double reach) const;
  [[nodiscard]] double out_of_corridor(const Flight& flight) const;
  [[nodiscard]] Foreseen foresee(const Moment& now, const Course& course, const Foreseen& floor);
  [[nodiscard]] bool meets(const Flight& flight, const Body& other, double until) const;
  void tell(const Moment& now, Course course, double time, NavigatorStep& step) const;

  [[nodiscard]] Course as_flown(const Moment& now, Course course) const;
  [[nodiscard]] double surely(const Body& other, const courses::Sweep& sweep, double reach,
                              double enough) const;
  [[nodiscard]] double surely_curved(const Flight& flight, const Body& other, double begin, double end,
                                     double enough) const;
  [[nodiscard]] double surely_straight(const Flight& flight, const Body& other, double begin, double end,
                                       double enough) const;
  [[nodiscard]] double surely_round(const Flight& flight, const Body& other, double enough) const;
  [[nodiscard]] double surely_all(const Flight& flight, const Body& other, double end, double enough) const;
  void prove(const Moment& now, Course course, double time, NavigatorStep& step) const;
  void fly_on(const Moment& now, const Course& course, double time);

  [[nodiscard]] double beside(const Moment& now, const Eigen::Vector3d& u, const Eigen::Vector3d& v) const;
  [[nodiscard]] Course towards(const Moment& now, const Eigen::Vector3d& velocity, double most) const;
  [[nodiscard]] static double soon(const Moment& now, double most);
  static void brake_from(const Moment& now, double t, Course& course);
  static void circle_from(const Moment& now, double t, Course& course);
  [[nodiscard]] std::optional<Course> to_destination(const Moment& now, const Destination& destination,
                                                     double part) const;
  void closer(const Moment& now, const Eigen::Vector3d& wanted, double most, Course& course,
              Foreseen& foreseen);
  bool refine(const Moment& now, Course& course, Foreseen& foreseen);
  void spread(const Moment& now, const Eigen::Vector3d& wanted, double less_than, int finer);
  bool search(const Moment& now, const Eigen::Vector3d& wanted, double less_than, bool any, Course& course,
              Foreseen& foreseen);
  [[nodiscard]] Foreseen foresee_towards(const Moment& now, const Eigen::Vector3d& velocity, double most,
                                         const Foreseen& floor, Course& course, bool patient = false);
  [[nodiscard]] Choice choose(const Moment& now, const std::optional<Destination>& destination, double time);
  [[nodiscard]] Choice decide(const Moment& now, const std::optional<Destination>& destination, double time,
                              NavigatorStep& step);
  [[nodiscard]] std::optional<Course> way(const Moment& now, const std::optional<Destination>& destination,
                                          double part) const;
  [[nodiscard]] Destination on_the_way(const Moment& now, const Destination& destination, double time);
  [[nodiscard]] Course in_hand(const Moment& now, double time) const;
  /// As many distances were measured in this step as may be.
  [[nodiscard]] bool spent() const { return limit_ > 0 && looks_ >= limit_; }

  [[nodiscard]] static Moment later(const Moment& now, const Course& course, double t);
  [[nodiscard]] Foreseen foresee_all(const Moment& now, Course course, const std::vector<Leg>& legs,
                                     double time);
  [[nodiscard]] static double look_again(const Moment& now, double left);
  /// The way to its destination, or back to its speed; null: none.
  struct Way {
    const Course* course;
    const Eigen::Vector3d* point;  // m; null: no destination
  };
  [[nodiscard]] Eigen::Vector3d wanted(const Way& way, const Moment& at, const Eigen::Vector3d& held) const;
  bool look_farther(const Moment& now, const Way& way, double time, Course& course, Foreseen& foreseen);

  NavigatorOptions options_;
  std::optional<double> pace_;                                   // m/s, of the start
  std::optional<Eigen::Vector3d> held_;                          // m/s, at the end of the course taken
  bool held_is_way_ = false;                                     // it is the way to the destination
  double turn_ = 0;                                              // m/s^2 with which it is turned to
  std::vector<Leg> legs_;                                        // after it
  double kept_ = 0;                                              // m, by it, of those required
  double hit_ = std::numeric_limits<double>::infinity();         // s, by it
  double next_look_ = -std::numeric_limits<double>::infinity();  // s
  double brakes_ = std::numeric_limits<double>::infinity();      // s, when what was taken brakes to rest
  double circles_ = std::numeric_limits<double>::infinity();     // s, when what was taken begins to circle
  Eigen::Vector3d about_ = Eigen::Vector3d::Zero();              // unit: the axis of that circle
  bool stopping_ = false;                                        // it is the stop that was in hand
  bool clear_ = false;                             // of bodies at rest it has kept what is required
  double required_ = 0, beyond_ = 0;               // metres
  std::optional<Corridor> corridor_;               // of the step
  Eigen::Vector3d leg_ = Eigen::Vector3d::Zero();  // m, along it
  // What is flown since the last step; `legs_` after it.
  Course flown_;
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero(), at_ = Eigen::Vector3d::Zero();  // m, m/s, at its beginning
  double time_ = 0, step_ = 1;                                                     // s
  // Of the step; members to keep their memory.
  std::vector<Body> bodies_;
  struct Candidate {
    double cost;
    Eigen::Vector3d velocity;
  };
  std::vector<Candidate> candidates_;
  std::vector<Leg> tried_;
  std::size_t failed_by_ = 0;              // the body that the course tried before failed by
  std::size_t resume_ = 0;                 // the candidate that a search goes on with
  std::shared_ptr<courses::Route> route_;  // written to where no copy has it too
  mutable long looks_ = 0;                 // distances measured in this step
  long limit_ = 0;                         // of them; 0: none
};

}  // namespace vericone::guidance
