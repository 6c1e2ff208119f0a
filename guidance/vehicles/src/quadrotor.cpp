// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/vehicles/quadrotor_dynamics.h>
#include <vericone/vehicles/quadrotor.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::vehicles {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using simulation::Curve;
using simulation::Jet;
using simulation::Motion;

/// Between the source's axes and ours, in the world and in the body alike.
Vector3d flipped(const Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

using Twelve = std::array<double, 12>;

Twelve twelve(const QuadrotorState& s) {
  Twelve x;
  Eigen::Map<Eigen::Matrix<double, 3, 4>>(x.data()) << s.position, s.velocity, s.rates, s.angles;
  return x;
}

QuadrotorState state_of(const Twelve& x) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> columns(x.data());
  return {columns.col(0), columns.col(1), columns.col(2), columns.col(3)};
}

/// The rotation vector of Exp(turned) = R R0', with the derivatives that angular velocity and acceleration
/// give it: phi' = J^-1 omega with J^-1 = 1 - [phi] / 2 + [phi]^2 / 12, up to phi^4.
Jet turned(const Matrix3d& rotation, const Vector3d& omega, const Vector3d& alpha) {
  const Eigen::AngleAxisd by(rotation);
  const Vector3d phi = by.angle() * by.axis();
  const auto inverse = [&](const Vector3d& v) {
    return Vector3d(v - 0.5 * phi.cross(v) + phi.cross(phi.cross(v)) / 12);
  };
  const Vector3d rate = inverse(omega);
  return {phi, rate,
          inverse(alpha) - 0.5 * rate.cross(omega) +
              (rate.cross(phi.cross(omega)) + phi.cross(rate.cross(omega))) / 12};
}

class Quadrotor : public simulation::Vehicle {
 public:
  Quadrotor(const QuadrotorOptions& options, const Motion& start, double t, const simulation::Current& air)
      : options_(options), air_(air), set_(t) {
    if (air.moves() && options.drag.isZero(0))
      throw InputError("vehicle", "a quadrotor without drag, which no current moves",
                       "one with drag, or the current left out");
    constexpr double kPeriods = 10;  // of the curves, which are smooth in each
    if (air.shortest() < kPeriods * options.period)
      throw InputError("vehicle", "a period of " + to_text(options.period) + " s",
                       "at most a tenth of the shortest of the gusts, " + to_text(air.shortest()) + " s");
    const Vector3d ahead = start.rotation.col(0);
    if (!(ahead.head<2>().norm() > 1e-6))
      throw InputError("rotation", "upright", "a heading: a quadrotor starts level");
    state_.position = start.position;
    yaw_ = state_.angles.z() = -std::atan2(ahead.y(), ahead.x());
    state_.velocity = flipped(quadrotor_rotation(state_).transpose() * start.velocity);
    wrench_.thrust = std::min(options.mass * options.gravity, options.most_thrust);
  }

  Motion motion() const override {
    const Matrix3d rotation = quadrotor_rotation(state_);
    return {state_.position, rotation * flipped(state_.velocity), rotation};
  }

  void advance(const simulation::VehicleCommand& command, double from, double to,
               std::vector<Curve>& way) override {
    // Times that differ by rounding only are one.
    constexpr double kOne = 1e-9;
    double t = from;
    while (t < to) {
      checkpoint();
      if (set_ <= t + kOne) {
        wrench_ =
            quadrotor_wrench(options_, state_, thrust_and_tilt(options_, state_, command.acceleration), yaw_);
        set_ = std::max(set_, t - options_.period) + options_.period;
      }
      double next = std::min(to, set_);
      if (to - next < kOne) next = to;
      way.push_back(fly(t, next));
      t = next;
    }
  }

  void log(std::vector<double>& values) const override {
    values.clear();
    for (const Vector3d& v : {state_.velocity, state_.rates, state_.angles})
      values.insert(values.end(), v.begin(), v.end());
    values.push_back(wrench_.thrust);
    values.insert(values.end(), wrench_.torque.begin(), wrench_.torque.end());
  }

  std::optional<simulation::LimitBroken> broken() const override { return {}; }

 private:
  struct At {
    Jet position;
    Vector3d omega, alpha;  // in our world
    Matrix3d rotation;
  };
  At at(double t) const {
    const QuadrotorState rate = rates(state_, t);
    const Matrix3d rotation = quadrotor_rotation(state_);
    const Vector3d acceleration = rotation * flipped(rate.velocity + state_.rates.cross(state_.velocity));
    // The angular velocity turns with the body without changing: its rate in the world is that in the body.
    return {{state_.position, rate.position, acceleration},
            rotation * flipped(state_.rates),
            rotation * flipped(rate.rates),
            rotation};
  }

  QuadrotorState rates(const QuadrotorState& state, double t) const {
    return quadrotor_rates(options_, state, wrench_, air_.velocity(state.position.z(), t));
  }

  Curve fly(double from, double to) {
    const At begin = at(from);
    const auto steps = std::max(1L, long(std::ceil((to - from) / options_.step * (1 - 1e-9))));
    boost::numeric::odeint::runge_kutta4<Twelve> stepper;
    Twelve x = twelve(state_);
    const double step = (to - from) / double(steps);
    for (long k = 0; k < steps; ++k)
      stepper.do_step(
          [&](const Twelve& now, Twelve& rate, double t) { rate = twelve(rates(state_of(now), t)); }, x,
          from + double(k) * step, step);
    state_ = state_of(x);
    constexpr double kTumbles = 1.5;  // rad
    if (!(std::abs(state_.angles.y()) < kTumbles))
      throw InputError("vehicle", "a quadrotor that tumbles at " + to_text(std::round(1e3 * to) / 1e3) + " s",
                       "one whose gains, torques and inertia keep it upright");
    const At end = at(to);
    const double h = to - from;
    const Jet still{Vector3d::Zero(), begin.omega, begin.alpha};
    return {simulation::quintic(begin.position, end.position, h),
            simulation::quintic(still,
                                turned(end.rotation * begin.rotation.transpose(), end.omega, end.alpha), h),
            begin.rotation, from, to};
  }

  const QuadrotorOptions& options_;
  simulation::Current air_;
  QuadrotorState state_;
  Wrench wrench_;
  double yaw_ = 0;
  double set_;  // s, when thrust and torques are set next
};

class QuadrotorModel : public simulation::VehicleModel {
 public:
  explicit QuadrotorModel(const QuadrotorOptions& options) : options_(options) {}

  std::unique_ptr<simulation::Vehicle> launch(const Motion& start, double t,
                                              const simulation::Current& air) const override {
    return std::make_unique<Quadrotor>(options_, start, t, air);
  }
  bool carried() const override { return !options_.drag.isZero(0); }
  std::vector<std::string> channels() const override {
    return {"U [m/s]",       "V [m/s]",         "W [m/s]",      "P [rad/s]", "Q [rad/s]",
            "R [rad/s]",     "phi [rad]",       "theta [rad]",  "psi [rad]", "F [N]",
            "tau_phi [N m]", "tau_theta [N m]", "tau_psi [N m]"};
  }
  simulation::VehicleLimits limits(const Motion&) const override {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return {kNone, kNone, kNone, kNone, kNone, -kNone};
  }

 private:
  QuadrotorOptions options_;
};

}  // namespace

void check(const QuadrotorOptions& options) {
  const auto positive = [](double value, const std::string& field, const char* unit) {
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(field, to_text(value), std::string("a positive finite number") + unit);
  };
  positive(options.mass, "mass", " (kg)");
  for (int i = 0; i < 3; ++i) positive(options.inertia[i], "inertia[" + std::to_string(i) + "]", " (kg m^2)");
  for (int i = 0; i < 3; ++i)
    if (!(2 * options.inertia[i] <= options.inertia.sum() * (1 + 1e-12)))
      throw InputError("inertia[" + std::to_string(i) + "]", to_text(options.inertia[i]),
                       "no more than the two others together");
  positive(options.gravity, "gravity", " (m/s^2)");
  positive(options.gain_attitude, "gain_attitude", " (N m/rad)");
  positive(options.gain_rate, "gain_rate", " (N m s/rad)");
  positive(options.most_thrust, "most_thrust", " (N)");
  const double weight = options.mass * options.gravity;
  if (!(options.most_thrust > weight))
    throw InputError("most_thrust", to_text(options.most_thrust),
                     "more than the weight, " + to_text(weight) + " N");
  positive(options.most_torque, "most_torque", " (N m)");
  constexpr double kMostTilt = 1.4;
  if (!(options.most_tilt > 0 && options.most_tilt <= kMostTilt))
    throw InputError("most_tilt", to_text(options.most_tilt), "above 0, at most 1.4 rad");
  for (int i = 0; i < 3; ++i)
    if (!(options.drag[i] >= 0) || !std::isfinite(options.drag[i]))
      throw InputError("drag[" + std::to_string(i) + "]", to_text(options.drag[i]),
                       "a finite number, 0 or more (N s/m)");
  positive(options.step, "step", " (s)");
  positive(options.period, "period", " (s)");
  // Jury's conditions of I x'' = -K_p x - K_d x' with the right side held.
  const double longest = std::min(2 * options.inertia.minCoeff() / options.gain_rate,
                                  2 * options.gain_rate / options.gain_attitude);
  if (!(options.period < longest))
    throw InputError("period", to_text(options.period),
                     "below " + to_text(longest) + " s: the attitude loop would swing up");
}

QuadrotorState quadrotor_rates(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                               const Wrench& wrench, const Vector3d& air) {
  const double U = state.velocity.x(), V = state.velocity.y(), W = state.velocity.z();
  const double P = state.rates.x(), Q = state.rates.y(), R = state.rates.z(), g = quadrotor.gravity;
  const double sp = std::sin(state.angles.x()), cp = std::cos(state.angles.x());
  const double st = std::sin(state.angles.y()), ct = std::cos(state.angles.y());
  const double ix = quadrotor.inertia.x(), iy = quadrotor.inertia.y(), iz = quadrotor.inertia.z();
  const double turning = Q * sp + R * cp;
  const Matrix3d rotation = quadrotor_rotation(state);
  QuadrotorState rate{
      rotation * flipped(state.velocity),
      {R * V - Q * W - g * st, -R * U + P * W + g * sp * ct,
       Q * U - P * V + g * cp * ct - wrench.thrust / quadrotor.mass},
      {(iy - iz) / ix * Q * R + wrench.torque.x() / ix, (iz - ix) / iy * P * R + wrench.torque.y() / iy,
       (ix - iy) / iz * P * Q + wrench.torque.z() / iz},
      {P + st / ct * turning, Q * cp - R * sp, turning / ct}};
  const Vector3d past = state.velocity - flipped(rotation.transpose() * air);
  rate.velocity -= quadrotor.drag.cwiseProduct(past) / quadrotor.mass;
  return rate;
}

ThrustAndTilt thrust_and_tilt(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                              const Vector3d& acceleration) {
  const double most = quadrotor.most_thrust / quadrotor.mass;
  const double up =
      std::clamp(quadrotor.gravity + acceleration.z(), 0.1 * quadrotor.gravity, most);  // g - a_z
  const double c = std::cos(state.angles.z()), s = std::sin(state.angles.z());
  const double x = acceleration.x(), y = -acceleration.y();
  Vector2d aside(c * x + s * y, c * y - s * x);
  const double most_aside =
      std::min(up * std::tan(quadrotor.most_tilt), std::sqrt(std::max(0.0, most * most - up * up)));
  if (const double wanted = aside.norm(); wanted > most_aside) aside *= most_aside / wanted;
  const double cos_pitch = std::cos(state.angles.y());
  return {quadrotor.mass * up / (std::cos(state.angles.x()) * cos_pitch),
          std::atan(aside.y() * cos_pitch / up), std::atan(-aside.x() / up)};
}

Wrench quadrotor_wrench(const QuadrotorOptions& quadrotor, const QuadrotorState& state,
                        const ThrustAndTilt& wanted, double yaw) {
  const Vector3d error(wanted.roll - state.angles.x(), wanted.pitch - state.angles.y(),
                       std::remainder(yaw - state.angles.z(), 2 * std::numbers::pi));
  const Vector3d torque = quadrotor.gain_attitude * error - quadrotor.gain_rate * state.rates;
  return {std::clamp(wanted.thrust, 0.0, quadrotor.most_thrust),
          torque.cwiseMax(-quadrotor.most_torque).cwiseMin(quadrotor.most_torque)};
}

Matrix3d quadrotor_rotation(const QuadrotorState& state) {
  using Eigen::AngleAxisd;
  // The flip turns y and z, and with them the sense of pitch and yaw.
  return (AngleAxisd(-state.angles.z(), Vector3d::UnitZ()) *
          AngleAxisd(-state.angles.y(), Vector3d::UnitY()) * AngleAxisd(state.angles.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

std::shared_ptr<const simulation::VehicleModel> quadrotor(const QuadrotorOptions& options) {
  check(options);
  return std::make_shared<QuadrotorModel>(options);
}

}  // namespace vericone::vehicles
