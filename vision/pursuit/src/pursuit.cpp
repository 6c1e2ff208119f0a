// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/run.h>
#include <vericone/vision/pursuit/pursuit.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "bars.h"
#include "pilot.h"
#include "stopwatch.h"

namespace vericone::vision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A point mass at a constant altitude as the source's simulator steps it: the new velocity moves it for the
/// whole step.
class SummedPoint : public simulation::Vehicle {
 public:
  explicit SummedPoint(const simulation::Motion& start) : motion_(start) {}
  [[nodiscard]] simulation::Motion motion() const override { return motion_; }
  void advance(const simulation::VehicleCommand& command, double from, double to,
               std::vector<simulation::Curve>& way) override {
    motion_.velocity += (to - from) * command.acceleration;
    way.push_back(simulation::Curve::steady(motion_, Vector3d::Zero(), from, to));
    motion_.position += (to - from) * motion_.velocity;
  }
  void log(std::vector<double>&) const override {}
  [[nodiscard]] std::optional<simulation::LimitBroken> broken() const override { return std::nullopt; }

 private:
  simulation::Motion motion_;
};

class SummedPointModel : public simulation::VehicleModel {
 public:
  [[nodiscard]] std::unique_ptr<simulation::Vehicle> launch(const simulation::Motion& start, double,
                                                            const simulation::Current&) const override {
    return std::make_unique<SummedPoint>(start);
  }
  [[nodiscard]] std::vector<std::string> channels() const override { return {}; }
  [[nodiscard]] simulation::VehicleLimits limits(const simulation::Motion&) const override {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return {kNone, kNone, kNone, kNone, kNone, -kNone};
  }
};

/// A road whose velocities add up step by step, as those of the source's simulator do.
class SummedRoad : public simulation::Road {
 public:
  SummedRoad(std::shared_ptr<const simulation::Road> road, double step, double duration)
      : road_(std::move(road)), step_(step), places_{road_->at(0).position} {
    while (double(places_.size()) * step < duration + 2 * step)
      places_.push_back(places_.back() + step * road_->at(double(places_.size()) * step).velocity);
  }
  [[nodiscard]] simulation::RoadPoint at(double t) const override {
    simulation::RoadPoint point = road_->at(t);
    const double steps = std::clamp(t / step_, 0.0, double(places_.size() - 2));
    const auto k = std::size_t(steps + 1e-9);
    const double rest = std::max(0.0, steps - double(k));
    point.position = (1 - rest) * places_[k] + rest * places_[k + 1];
    return point;
  }

 private:
  std::shared_ptr<const simulation::Road> road_;
  double step_;
  std::vector<Vector2d> places_;
};

/// A picture on its way from the camera to the tracker.
struct Picture {
  double t = 0;
  Image image;
  Pose camera;
  std::vector<simulation::RoadPoint> truth;  // of all cars
  std::vector<VehicleTruth> seen;
};

/// From pictures to commands, through a run.
class FlyingCamera : public simulation::FlyingPilot {
 public:
  FlyingCamera(const Pursuit& pursuit, const PursuitOptions& options, PursuitRun& run)
      : pursuit_(pursuit),
        options_(options),
        run_(run),
        pilot_(pursuit),
        true_follower_(pursuit.side),
        view_(pursuit.eyes == Eyes::source ? pursuit.source_view : pursuit.perspective_view),
        mount_(view_.mount),
        bars_(view_.bars, pursuit.seed) {
    for (std::size_t i = 0; i < pursuit.cars.size(); ++i)
      if (pursuit.cars[i].followed) followed_.push_back(i);
    if (pursuit.eyes == Eyes::exact) return;
    SceneOptions scene = view_.scene;
    scene.vehicles.clear();
    for (const Car& car : pursuit.cars) {
      scene.vehicles.push_back(car.look);
      if (pursuit.eyes == Eyes::source) scene.vehicles.back().size.z() = 0;  // sprites
    }
    scene.seed = pursuit.seed;
    scene_.emplace(scene);
    perception_.emplace(perception_of(pursuit), tracker_of(pursuit));
  }

  void command(const simulation::Instant& now, std::span<simulation::VehicleCommand> commands,
               simulation::Run&) override {
    commands[now.self] = step(motion_at(now, now.t), now.vehicle, now.command);
    if (!pursuit_.vehicle) commands[now.self].acceleration.z() = 0;
  }

  /// What is seen at the end is thought of too.
  void moved(const simulation::Instant& now, simulation::Run&) override {
    const bool last = now.command + 1 == steps_of(pursuit_);
    if (!last && !run_.interrupted) return;
    if (!run_.interrupted) static_cast<void>(step(motion_at(now, now.until), now.vehicle, now.command + 1));
    run_.layer_share = pilot_.layer_share();
    close_hidden();
  }

  static std::uint64_t steps_of(const Pursuit& pursuit) {
    return std::uint64_t(std::ceil(pursuit.duration / pursuit.step - 1e-9));
  }

 private:
  static simulation::Motion motion_at(const simulation::Instant& now, double t) {
    return now.vehicle ? now.vehicle->motion() : now.tracks[now.self].motion(t);
  }

  simulation::VehicleCommand step(const simulation::Motion& own, const simulation::Vehicle* vehicle,
                                  std::uint64_t k) {
    const auto every = std::uint64_t(std::llround(pursuit_.picture_step / pursuit_.step));
    const double t = double(k) * pursuit_.step;
    sample_ = {};
    const bool due = k % every == 0;
    if (due) look(own, t, k / every);
    const auto start = Clock::now();
    const bool told = tell(t);
    simulation::VehicleCommand command;
    if (told) command = pilot_.step(own, known_, view_.camera.focal, t, sample_);
    if (told) {
      keep_in_picture(own, command);
      keep_gimbal_up(command);
      sample_.acceleration = command.acceleration;
    }
    sample_.controller = seconds_since(start) - sample_.ellipse_seconds;
    if (due && told) log(own, vehicle, t);
    run_.interrupted = options_.progress && due && !options_.progress(t);
    if (!run_.interrupted) run_.end = t;
    return command;
  }

  [[nodiscard]] std::vector<simulation::RoadPoint> cars_at(double t) const {
    std::vector<simulation::RoadPoint> list;
    for (const Car& car : pursuit_.cars) list.push_back(car.road->at(t));
    return list;
  }

  [[nodiscard]] Vector2d middle_of(const std::vector<simulation::RoadPoint>& cars) const {
    Vector2d sum = Vector2d::Zero();
    for (const std::size_t i : followed_) sum += cars[i].position;
    return sum / double(followed_.size());
  }

  /// Takes a picture, and perceives those that have arrived.
  void look(const simulation::Motion& own, double t, std::uint64_t number) {
    if (!perception_) return;
    Picture picture;
    picture.t = t;
    // Before anything is believed the camera looks where whoever detected the vehicles has turned it.
    const Vector2d at = told_ ? aim_ : middle_of(cars_at(t));
    const std::optional<Vector3d> aim = Vector3d(at.x(), at.y(), 0);
    picture.camera = mount_.at(t, {own.position, own.rotation}, aim);
    picture.truth = cars_at(t);
    std::vector<PlacedVehicle> placed;
    for (const simulation::RoadPoint& car : picture.truth)
      placed.push_back({car.position, std::atan2(car.velocity.y(), car.velocity.x()), car.velocity});
    if (bars_.step(own, view_.camera, t)) scene_->set_occluders(bars_.with(view_.scene.occluders));
    const std::optional<Pose> before = when_opened(picture.camera);
    scene_->render(view_.camera, picture.camera, placed, t, number, picture.image,
                   before ? &*before : nullptr);
    looked_ = picture.camera;
    picture.seen = scene_->truth(view_.camera, picture.camera, placed, t);
    under_way_.push_back(std::move(picture));
    while (!under_way_.empty() && under_way_.front().t + view_.latency <= t + 1e-9) {
      last_ = std::move(under_way_.front());
      under_way_.pop_front();
      perceive();
    }
  }

  /// Where the camera was when the shutter opened, between the last picture and this one.
  [[nodiscard]] std::optional<Pose> when_opened(const Pose& now) const {
    if (!looked_ || !(view_.scene.exposure > 0)) return std::nullopt;
    const double back = std::min(1.0, view_.scene.exposure / pursuit_.picture_step);
    const Eigen::Quaterniond from(now.rotation), to(looked_->rotation);
    return Pose{now.position + back * (looked_->position - now.position),
                from.slerp(back, to).toRotationMatrix()};
  }

  void perceive() {
    if (run_.boxes.empty()) {
      for (const std::size_t i : followed_) {
        // The vehicles are detected in the first picture (source 3.2, 4.1): the one thing that is told.
        if (!(last_->seen[i].visible > 0.99))
          throw InputError("cars[" + std::to_string(i) + "]", "not whole in the first picture",
                           "a start where the camera sees it");
        run_.boxes.push_back(last_->seen[i].box);
      }
      perception_->start(last_->image, last_->camera, last_->t, run_.boxes);
    } else {
      perception_->step(last_->image, last_->camera, last_->t);
    }
    told_ = true;
    follow_hidden();
  }

  /// What is believed now. Whether anything is.
  bool tell(double t) {
    known_.clear();
    aim_.setZero();
    if (!perception_) {
      for (const std::size_t i : followed_) {
        const simulation::RoadPoint car = pursuit_.cars[i].road->at(t);
        known_.push_back({car.position, car.velocity, car.acceleration, Eigen::Matrix4d::Zero(), false});
      }
      return true;
    }
    if (!told_) return false;
    double count = 0;
    Vector2d sum = Vector2d::Zero();
    for (const Followed& one : perception_->vehicles()) {
      const guidance::Belief<6> belief = one.filter.predicted(t);
      Known known;
      known.position = {belief.mean[0], belief.mean[3]};
      known.velocity = {belief.mean[1], belief.mean[4]};
      known.acceleration = {belief.mean[2], belief.mean[5]};
      constexpr int kOrder[] = {0, 3, 1, 4};
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) known.covariance(r, c) = belief.covariance(kOrder[r], kOrder[c]);
      known.left_out =
          pursuit_.law == Whose::ours && one.hidden_since >= 0 && t - one.hidden_since > pursuit_.give_up;
      if (!known.left_out) {
        sum += known.position;
        ++count;
      }
      known_.push_back(known);
    }
    if (count > 0) last_aim_ = sum / count;
    aim_ = last_aim_;
    return true;
  }

  /// A camera that tilts with the body keeps everything in its picture: the level acceleration is at most
  /// what leaves it there, and where that is too little the UAS climbs, which brings everything nearer to the
  /// middle.
  void keep_in_picture(const simulation::Motion& own, simulation::VehicleCommand& command) {
    constexpr double kEdge = 20, kMostWanted = 12, kClimb = 5, kGain = 0.5;  // px, m/s^2, m/s, 1/s
    if (view_.mount.kind != MountKind::strapdown || !perception_) return;
    const Vector2d wanted = command.acceleration.head<2>();
    if (!(wanted.norm() > 1e-9)) return;
    points_.clear();
    for (const Known& one : known_)
      if (!one.left_out) points_.emplace_back(one.position.x(), one.position.y(), view_.height);
    const double most = most_acceleration_in_sight(view_.camera, own.position, 0, points_, wanted,
                                                   kMostWanted, kEdge, command.acceleration.z());
    if (wanted.norm() <= most) return;
    command.acceleration.head<2>() *= most / wanted.norm();
    command.acceleration.z() = std::max(command.acceleration.z(), kGain * (kClimb - own.velocity.z()));
  }

  /// A gimbal keeps up with a body that tilts no faster than it turns: the level acceleration changes at most
  /// so fast.
  void keep_gimbal_up(simulation::VehicleCommand& command) {
    constexpr double kPart = 0.7, kGravity = 9.81;  // of the gimbal's rate; m/s^2
    if (view_.mount.kind != MountKind::gimbal || pursuit_.eyes != Eyes::perspective || !pursuit_.vehicle ||
        pursuit_.law != Whose::ours)
      return;
    const double most = kPart * kGravity * view_.mount.rate * pursuit_.step;
    const Vector2d change = command.acceleration.head<2>() - commanded_;
    if (change.norm() > most) command.acceleration.head<2>() = commanded_ + change * (most / change.norm());
    commanded_ = command.acceleration.head<2>();
  }

  void log(const simulation::Motion& own, const simulation::Vehicle* vehicle, double t) {
    PursuitSample& sample = sample_;
    sample.t = t;
    sample.uas = own;
    const std::vector<simulation::RoadPoint> truth = cars_at(t);
    std::vector<simulation::RoadPoint> wanted;
    for (const std::size_t i : followed_) wanted.push_back(truth[i]);
    evaluate(pursuit_, own, wanted, true_follower_, sample);
    for (std::size_t k = 0; k < followed_.size(); ++k) {
      CarSample car;
      car.truth = wanted[k];
      if (!perception_) {
        car.belief.mean << wanted[k].position.x(), wanted[k].velocity.x(), wanted[k].acceleration.x(),
            wanted[k].position.y(), wanted[k].velocity.y(), wanted[k].acceleration.y();
      } else {
        const Followed& one = perception_->vehicles()[k];
        car.truth = last_->truth[followed_[k]];  // when the picture was taken
        car.belief = one.filter.belief();
        car.measured = one.measured;
        car.sighting = one.sighting;
        car.seen = last_->seen[followed_[k]];
        double best = 0;
        for (std::size_t i = 0; i < pursuit_.cars.size(); ++i)
          if (const double both = overlap(one.sighting.box, last_->seen[i].box);
              i != followed_[k] && both > best) {
            best = both;
            car.other = last_->seen[i].box;
          }
      }
      sample.cars.push_back(std::move(car));
    }
    if (perception_) {
      sample.camera = last_->camera;
      sample.camera_time = last_->t;
      sample.filter = perception_->filter_seconds();
      sample.tracker = perception_->tracker_seconds();
      if (options_.picture) options_.picture(last_->image, sample, perception_->vehicles());
    }
    run_.vehicle.emplace_back();
    if (vehicle) vehicle->log(run_.vehicle.back());
    run_.samples.push_back(sample);
  }

  /// From the truth, for the summary alone.
  void follow_hidden() {
    constexpr double kNothing = 0.02, kEnough = 0.5;  // visible parts
    hidden_now_.resize(followed_.size());
    for (std::size_t k = 0; k < followed_.size(); ++k) {
      const VehicleTruth& seen = last_->seen[followed_[k]];
      const Sighting& sighting = perception_->vehicles()[k].sighting;
      const bool says_hidden = sighting.sight == Sight::total || sighting.sight == Sight::lost;
      std::optional<HiddenTime>& now = hidden_now_[k];
      if (!now && seen.visible <= kNothing) now = HiddenTime{k, last_->t, -1, std::nullopt, std::nullopt};
      if (!now) continue;
      if (!now->said && now->to < 0 && says_hidden) now->said = last_->t - now->from;
      if (now->to < 0 && seen.visible >= kEnough) now->to = last_->t;
      if (now->to >= 0 && sighting.measured && overlap(sighting.box, seen.box) > 0) {
        now->regained = last_->t - now->to;
        run_.hidden.push_back(*now);
        now.reset();
      } else if (now->to >= 0 && seen.visible <= kNothing) {  // hidden again before it was found
        run_.hidden.push_back(*now);
        now = HiddenTime{k, last_->t, -1, std::nullopt, std::nullopt};
      }
    }
  }

  void close_hidden() {
    for (std::optional<HiddenTime>& now : hidden_now_)
      if (now) run_.hidden.push_back(*now);
    std::sort(run_.hidden.begin(), run_.hidden.end(),
              [](const HiddenTime& a, const HiddenTime& b) { return a.from < b.from; });
  }

  static std::unique_ptr<Tracker> tracker_of(const Pursuit& pursuit) {
    if (pursuit.tracker == Whose::source) return source_tracker();
    TrackerOptions options;
    options.frame_seconds = pursuit.picture_step;
    return vision::tracker(options);
  }

  const Pursuit& pursuit_;
  const PursuitOptions& options_;
  PursuitRun& run_;
  Pilot pilot_;
  guidance::EllipseFollower true_follower_;
  const View& view_;
  CameraMount mount_;
  Bars bars_;
  std::optional<Scene> scene_;
  std::optional<Perception> perception_;
  std::vector<std::size_t> followed_;
  std::deque<Picture> under_way_;
  std::optional<Picture> last_;
  std::optional<Pose> looked_;  // the camera at the last picture taken
  bool told_ = false;
  std::vector<Known> known_;
  std::vector<Vector3d> points_;
  Vector2d commanded_ = Vector2d::Zero();  // the level acceleration before
  Vector2d aim_ = Vector2d::Zero(), last_aim_ = Vector2d::Zero();
  PursuitSample sample_;
  std::vector<std::optional<HiddenTime>> hidden_now_;
};

class CameraPilot : public simulation::PilotModel {
 public:
  CameraPilot(const Pursuit& pursuit, const PursuitOptions& options, PursuitRun& run)
      : pursuit_(pursuit), options_(options), run_(run) {}
  [[nodiscard]] std::unique_ptr<simulation::FlyingPilot> launch(
      const simulation::Scenario&, std::size_t, const simulation::RunOptions&) const override {
    return std::make_unique<FlyingCamera>(pursuit_, options_, run_);
  }
  [[nodiscard]] bool may_rest() const override { return true; }

 private:
  const Pursuit& pursuit_;
  const PursuitOptions& options_;
  PursuitRun& run_;
};

/// The UAS, a ball; and the cars, boxes, where somebody wants the whole flight.
simulation::Scenario scenario_of(const Pursuit& pursuit, bool with_cars) {
  simulation::Scenario scenario;
  scenario.name = pursuit.name;
  scenario.step = pursuit.step;
  scenario.multiples = true;
  scenario.duration = double(FlyingCamera::steps_of(pursuit)) * pursuit.step;
  simulation::Body& uas = scenario.bodies.emplace_back();
  uas.name = "uas";
  uas.shape = simulation::RigidShape{
      CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(pursuit.radius)))};
  uas.start = pursuit.start;
  uas.orientation = simulation::Orientation::fixed;
  uas.vehicle = pursuit.vehicle;
  if (!uas.vehicle && pursuit.source_steps) uas.vehicle = std::make_shared<const SummedPointModel>();
  for (const Car& car : pursuit.cars) {
    if (!with_cars) break;
    simulation::Body& body = scenario.bodies.emplace_back();
    body.name = car.name;
    const Vector3d half = 0.5 * car.look.size;
    body.shape = simulation::RigidShape{HullBody::box(-half, half)};
    body.road = car.road;
    body.start = start_of(*car.road, 0.5 * car.look.size.z());
  }
  return scenario;
}

PursuitRun fly(const Pursuit& pursuit, const PursuitOptions& options) {
  PursuitRun run;
  simulation::Scenario scenario = scenario_of(pursuit, bool(options.flown));
  scenario.bodies.front().pilot.emplace().own = std::make_shared<CameraPilot>(pursuit, options, run);
  simulation::RunOptions flight;
  flight.prove = flight.log = bool(options.flown);
  flight.progress = [&](double) { return !run.interrupted; };
  const simulation::Run flown = simulation::simulate(scenario, flight);
  if (options.flown) options.flown(scenario, flown);
  return run;
}

}  // namespace

const char* to_string(Eyes eyes) {
  return eyes == Eyes::exact ? "exact" : eyes == Eyes::source ? "source" : "perspective";
}
const char* to_string(Whose whose) { return whose == Whose::source ? "source" : "ours"; }

PerceptionOptions perception_of(const Pursuit& pursuit) {
  const View& view = pursuit.eyes == Eyes::source ? pursuit.source_view : pursuit.perspective_view;
  PerceptionOptions options;
  options.camera = view.camera;
  options.height = view.height;
  options.source = pursuit.tracker == Whose::source;
  options.filter = options.source ? pursuit.source_filter : pursuit.our_filter;
  options.noise = pursuit.noise;
  options.hidden_noise = pursuit.hidden_noise;
  options.own_noise = pursuit.own_noise;
  return options;
}

PursuitRun pursue(const Pursuit& pursuit, const PursuitOptions& options) {
  const double ratio = pursuit.picture_step / pursuit.step;
  if (!(pursuit.step > 0)) throw InputError("step", std::to_string(pursuit.step), "a positive number (s)");
  if (!(ratio > 0.5) || std::abs(ratio - std::round(ratio)) > 1e-6)
    throw InputError("picture_step", std::to_string(pursuit.picture_step), "a whole number of steps (s)");
  if (!pursuit.start.position.allFinite() || !pursuit.start.velocity.allFinite() ||
      !pursuit.start.rotation.allFinite())
    throw InputError("start", "a number that is not finite", "finite (m, m/s)");
  if (std::none_of(pursuit.cars.begin(), pursuit.cars.end(), [](const Car& car) { return car.followed; }))
    throw InputError("cars", "none that is followed", "at least one");
  for (std::size_t i = 0; i < pursuit.cars.size(); ++i)
    if (!pursuit.cars[i].road) throw InputError("cars[" + std::to_string(i) + "].road", "none", "a road");
  if (pursuit.source_steps && options.flown)
    throw InputError("flown", "given with source_steps",
                     "left out: cars leave their roads as velocities add up");
  if (pursuit.vehicle) static_cast<void>(pursuit.vehicle->launch(pursuit.start, 0, {}));
  if (!pursuit.source_steps) return fly(pursuit, options);
  Pursuit stepped = pursuit;
  for (Car& car : stepped.cars)
    car.road = std::make_shared<SummedRoad>(car.road, pursuit.step, pursuit.duration);
  return fly(stepped, options);
}

}  // namespace vericone::vision
