// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <vericone/simulation/track.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "tracks/level_frame.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using State = std::array<double, 3>;  // along, across, turned
using Dopri5 = boost::numeric::odeint::runge_kutta_dopri5<State>;

/// x' = s cos(chi), y' = s sin(chi), chi' = a_lateral / s; the speed s is linear in time.
struct PlaneMotion {
  double speed, longitudinal, lateral;

  void operator()(const State& x, State& rate, double t) const {
    const double s = speed + longitudinal * t;
    rate = {s * std::cos(x[2]), s * std::sin(x[2]), lateral / s};
  }
};

}  // namespace

Arc::Arc(const Motion& start, const Vector3d& acceleration, Orientation orientation, double from, double to)
    : Leg(from, to), acceleration_(acceleration), orientation_(orientation) {
  start_ = start;
  if (!(to > from) || !std::isfinite(to))
    throw InputError("to", to_text(to), "a time after " + to_text(from) + " s");
  most_acceleration_ = acceleration.norm();
  speed_ = start.velocity.norm();
  if (speed_ > kRestSpeed && accelerated()) {
    ahead_ = start.velocity / speed_;
    longitudinal_ = acceleration.dot(ahead_);
    aside_ = acceleration - longitudinal_ * ahead_;
    // Twice is enough; what is left of an acceleration along the velocity is rounding.
    aside_ -= aside_.dot(ahead_) * ahead_;
    lateral_ = aside_.norm();
    if (lateral_ > 8 * std::numeric_limits<double>::epsilon() * most_acceleration_) {
      aside_ /= lateral_;
      carried_ = to_ - from_;
      if (longitudinal_ < 0) carried_ = std::min(carried_, (speed_ - kRestSpeed) / -longitudinal_);
      integrate();
    } else {
      lateral_ = 0;
    }
  }
  end_ = at(to_);
  most_turn_rate_ = turn_rate_bound();
  bound_turn_acceleration();
}

void Arc::integrate() {
  using namespace boost::numeric::odeint;
  auto stepper = make_controlled<Dopri5>(1e-12, 1e-14);
  const PlaneMotion motion{speed_, longitudinal_, lateral_};
  std::vector<Step> steps;
  State x{};
  double t = 0, dt = carried_;
  for (std::size_t i = 1; t < carried_; ++i) {
    if (i % 256 == 0) checkpoint();
    dt = std::min(dt, carried_ - t);
    if (stepper.try_step(motion, x, t, dt) != success || !(t < carried_)) continue;
    // Times that differ by rounding only are the end.
    if (carried_ - t <= 4 * std::numeric_limits<double>::epsilon() * carried_) break;
    steps.push_back({t, {x[0], x[1], x[2]}});
  }
  last_ = {x[0], x[1], x[2]};
  if (!steps.empty()) steps_ = std::make_shared<const std::vector<Step>>(std::move(steps));
}

Arc::InPlane Arc::in_plane(double elapsed) const {
  if (elapsed >= carried_) return last_;
  Step step{0, {}};
  if (steps_) {
    const auto after = std::upper_bound(steps_->begin(), steps_->end(), elapsed,
                                        [](double t, const Step& s) { return t < s.begin; });
    if (after != steps_->begin()) step = *(after - 1);
  }
  State x{step.state.along, step.state.across, step.state.turned};
  if (elapsed > step.begin)
    Dopri5().do_step(PlaneMotion{speed_, longitudinal_, lateral_}, x, step.begin, elapsed - step.begin);
  return {x[0], x[1], x[2]};
}

Motion Arc::at(double t) const {
  const double elapsed = std::clamp(t, from_, to_) - from_;
  Motion m;
  InPlane state;
  if (lateral_ == 0) {
    m.position = start_.position + elapsed * (start_.velocity + 0.5 * elapsed * acceleration_);
    m.velocity = start_.velocity + elapsed * acceleration_;
  } else {
    const double carried = std::min(elapsed, carried_), s = speed(carried);
    state = in_plane(carried);
    const double c = std::cos(state.turned), w = std::sin(state.turned);
    m.position = start_.position + state.along * ahead_ + state.across * aside_;
    m.velocity = s * (c * ahead_ + w * aside_);
    if (elapsed > carried) {
      const Vector3d a = acceleration(from_ + carried);
      const double rest = elapsed - carried;
      m.position += rest * (m.velocity + 0.5 * rest * a);
      m.velocity += rest * a;
    }
  }
  m.rotation = rotation(state, m.velocity);
  return m;
}

Vector3d Arc::acceleration(double t) const {
  if (lateral_ == 0) return acceleration_;
  const double turned = in_plane(std::min(std::clamp(t, from_, to_) - from_, carried_)).turned;
  const double c = std::cos(turned), s = std::sin(turned);
  return longitudinal_ * (c * ahead_ + s * aside_) + lateral_ * (c * aside_ - s * ahead_);
}

Matrix3d Arc::rotation(const InPlane& state, const Vector3d& velocity) const {
  switch (orientation_) {
    case Orientation::fixed:
      break;
    case Orientation::heading:
      if (lateral_ == 0) break;
      // Rodrigues' formula about the normal of the plane.
      return orthonormal<3>(
          Matrix3d(Eigen::AngleAxisd(state.turned, ahead_.cross(aside_).normalized()) * start_.rotation));
    case Orientation::level:
      return level_frame(velocity, start_.rotation);
  }
  return start_.rotation;
}

double Arc::turn_rate_bound() const {
  constexpr double kUp = 1 + 1e-12;
  if (orientation_ == Orientation::fixed) return 0;
  const double slowest = std::min(speed_, speed(carried_));
  const double heading = lateral_ > 0 ? lateral_ / slowest * kUp : 0;
  if (orientation_ == Orientation::heading) return heading;
  // A level frame turns at (azimuth' z, elevation' y), both from the turning of the velocity: by at most the
  // rate of the velocity's direction over the cosine of the elevation.
  constexpr double kJump = std::numeric_limits<double>::infinity();
  if (!(level_frame(start_.velocity, start_.rotation) - start_.rotation).isZero(1e-9)) return kJump;
  if (!accelerated()) return 0;
  const bool rests = speed_ <= kRestSpeed || (lateral_ > 0 && carried_ < to_ - from_);
  const bool reverses = lateral_ == 0 && end_.velocity.dot(start_.velocity) <= 0;
  if (rests || reverses) return kJump;
  if (lateral_ == 0) return 0;
  // The height of the direction cos(chi) u + sin(chi) n is peak cos(chi - steepest).
  const double turned = in_plane(carried_).turned, peak = std::hypot(ahead_.z(), aside_.z());
  const double steepest = std::atan2(aside_.z(), ahead_.z());
  using std::numbers::pi;
  const bool passes = std::floor((turned - steepest) / pi) >= std::ceil(-steepest / pi);
  const double most =
      passes ? peak : std::max(std::abs(ahead_.z()), std::abs(end_.velocity.z()) / end_.velocity.norm());
  const double level = std::sqrt(std::max(0.0, 1 - most * most));
  return level > 1e-6 ? heading / level * kUp * (1 + 1e-9) : kJump;
}

// Turning about one axis at omega = lateral / s: |(omega x (omega x e)) + omega' x e| <= omega^2 + |omega'|.
void Arc::bound_turn_acceleration() {
  if (most_turn_rate_ == 0) return;
  if (orientation_ == Orientation::level || carried_ < to_ - from_) {
    most_turn_acceleration_ = std::numeric_limits<double>::infinity();
    return;
  }
  const Vector3d axis = ahead_.cross(aside_);
  first_turn_ = lateral_ / speed_ * axis;
  last_turn_ = lateral_ / speed(carried_) * axis;
  const double slowest = std::min(speed_, speed(carried_));
  most_turn_acceleration_ = most_turn_rate_ * most_turn_rate_ +
                            lateral_ * std::abs(longitudinal_) / (slowest * slowest) * (1 + 1e-12);
}

}  // namespace vericone::simulation
