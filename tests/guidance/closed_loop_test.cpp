// SPDX-License-Identifier: BSD-3-Clause
//
// Laws in a loop: bodies integrated in Cartesian coordinates with the commands of every instant, y(t) of
// their sectors against the exponential that K and w promise.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/guidance/laws.h>

#include <cmath>

#include "guidance/planar_engagement.h"
#include "guidance/spatial_engagement.h"

namespace vericone::guidance::closed_loop_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd;
using testing::Errors, testing::PlanarEngagement, testing::RandomBodies, testing::SpatialEngagement;

/// One classical Runge-Kutta step.
template <typename Rate>
VectorXd stepped(const VectorXd& x, double t, double dt, Rate&& rate) {
  const VectorXd k1 = rate(x, t), k2 = rate(x + 0.5 * dt * k1, t + 0.5 * dt),
                 k3 = rate(x + 0.5 * dt * k2, t + 0.5 * dt), k4 = rate(x + dt * k3, t + dt);
  return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

constexpr double kDuration = 0.5;     // s
constexpr double kShortest = 1e-4;    // s; runs that need shorter steps end: they are at a singularity
constexpr double kTolerance = 1e-10;  // of a step, in parts of 1 + |x|

/// A step of a length at which two halves say the same: advances x and t; false where there is none. Trial
/// steps into the other body are too long.
template <typename Rate>
bool advance(VectorXd& x, double& t, double& dt, Rate&& rate) {
  for (dt = std::min(2 * dt, kDuration / 10); dt > kShortest; dt /= 2) try {
      const VectorXd whole = stepped(x, t, dt, rate), half = stepped(x, t, dt / 2, rate),
                     twice = stepped(half, t + dt / 2, dt / 2, rate);
      const double error = ((whole - twice).array().abs() / (1 + twice.array().abs())).maxCoeff();
      if (!(error < kTolerance)) continue;
      x = twice;
      t += dt;
      return true;
    } catch (const InputError&) {
    }
  return false;
}

LawOptions random_options(RandomBodies& random) {
  LawOptions options;
  options.gain = random.uniform(0.5, 4);
  options.reference = random.uniform(0, 0.1);
  options.cease = std::numeric_limits<double>::infinity();
  return options;
}

/// x: positions and velocities of A and B. The bodies of `start` moved and turned to there.
PlanarEngagement planar_at(const PlanarEngagement& start, const VectorXd& x, double t) {
  PlanarEngagement now = start;
  int at = 0;
  for (auto [body, first] : {std::pair{&now.a, &start.a}, std::pair{&now.b, &start.b}}) {
    body->path = {x.segment<2>(at), x.segment<2>(at + 2), Vector2d::Zero()};
    at += 4;
    const double angle =
        first->with_heading ? testing::angle_between(first->path.v, body->path.v) : first->omega * t;
    const Eigen::Matrix2d r = rotation_2d(angle), s = r * first->at_start.shape() * r.transpose();
    body->at_start = Ellipse::from_shape(body->path.p, 0.5 * (s + s.transpose()));
  }
  return now;
}

VectorXd packed(const PlanarEngagement& e) {
  VectorXd x(8);
  x << e.a.path.p, e.a.path.v, e.b.path.p, e.b.path.v;
  return x;
}

/// `law` sets accelerations and returns whether it steers. Errors of y and V^2 against their exponentials in
/// parts of what is left of the first deviation.
template <typename Law>
void fly_planar(PlanarEngagement start, const LawOptions& options, double gain_speed, Law&& law, Errors& of_y,
                Errors* of_speed, int& steps) {
  start.a.growth.setZero();
  start.b.growth.setZero();
  VectorXd x = packed(start);
  const double y0 = start.y(0), v0 = start.relative(0).squaredNorm();
  bool steers = true;
  const auto rate = [&](const VectorXd& state, double t) {
    PlanarEngagement now = planar_at(start, state, t);
    steers = law(now) && steers;
    VectorXd of(8);
    of << now.a.path.v, now.a.path.a, now.b.path.v, now.b.path.a;
    return of;
  };
  double t = 0, dt = kDuration;
  while (t < kDuration && advance(x, t, dt, rate)) {
    steers = true;
    rate(x, t);
    if (!steers) return;
    const PlanarEngagement now = planar_at(start, x, t);
    if (sector_by_support(now.a.at(0), now.b.at(0)).psi > 2.5) return;  // about to touch
    const double left = std::exp(-options.gain * t);
    of_y.add(std::abs(now.y(0) - options.reference - (y0 - options.reference) * left) /
             std::abs((y0 - options.reference) * left));
    if (of_speed)
      of_speed->add(std::abs(now.relative(0).squaredNorm() / (v0 * std::exp(-gain_speed * t)) - 1));
    ++steps;
  }
}

TEST(ClosedLoop, AvoidanceFollowsItsExponential) {
  RandomBodies random(5122);
  SCOPED_TRACE(random.trace());
  Errors errors;
  int steps = 0;
  for (int i = 0; i < 20; ++i) {
    const LawOptions options = random_options(random);
    fly_planar(
        testing::random_planar_engagement(random, 0.95), options, 0,
        [&](PlanarEngagement& e) {
          const LawCommand command = avoidance(e.state(), e.cone(), options);
          e.apply(command.a, 0);
          return command.status == LawStatus::steering;
        },
        errors, nullptr, steps);
  }
  std::printf("avoidance in a loop, %d steps: worst relative error of y - w %.1e\n", steps, errors.worst());
  EXPECT_GT(steps, 500);
  EXPECT_LT(errors.worst(), 1e-6);
}

TEST(ClosedLoop, RendezvousFollowsItsExponential) {
  RandomBodies random(5142);
  SCOPED_TRACE(random.trace());
  Errors errors;
  int steps = 0;
  for (int i = 0; i < 20; ++i) {
    const LawOptions options = random_options(random);
    fly_planar(
        testing::random_planar_engagement(random, 1.3), options, 0,
        [&](PlanarEngagement& e) {
          const CooperativeCommand command = cooperative_rendezvous(e.state(), e.cone(), options);
          e.apply(command.a, command.b);
          return command.status == LawStatus::steering;
        },
        errors, nullptr, steps);
  }
  std::printf("rendezvous in a loop, %d steps: worst relative error of y - w %.1e\n", steps, errors.worst());
  EXPECT_GT(steps, 500);
  EXPECT_LT(errors.worst(), 1e-6);
}

TEST(ClosedLoop, MatchingFollowsBothExponentials) {
  RandomBodies random(5162);
  SCOPED_TRACE(random.trace());
  Errors errors, of_speed;
  int steps = 0;
  for (int i = 0; i < 20; ++i) {
    const LawOptions options = random_options(random);
    const double gain_speed = random.uniform(0.5, 3);
    fly_planar(
        testing::random_planar_engagement(random, 0.95), options, gain_speed,
        [&](PlanarEngagement& e) {
          const MatchingCommand command = matching_rendezvous(e.state(), e.cone(), options, gain_speed);
          e.apply(command.lateral, 0, command.longitudinal);
          return command.status == LawStatus::steering;
        },
        errors, &of_speed, steps);
  }
  std::printf("matching in a loop, %d steps: worst relative error of y - w %.1e, of V^2 %.1e\n", steps,
              errors.worst(), of_speed.worst());
  EXPECT_GT(steps, 500);
  EXPECT_LT(errors.worst(), 1e-6);
  EXPECT_LT(of_speed.worst(), 1e-6);
}

/// x: positions and velocities of A and B, the plane's axis, both bodies' turning since the start.
SpatialEngagement spatial_at(const SpatialEngagement& start, const VectorXd& x) {
  SpatialEngagement now = start;
  int at = 0, turning = 15;
  for (auto [body, first] : {std::pair{&now.a, &start.a}, std::pair{&now.b, &start.b}}) {
    body->path = {x.segment<3>(at), x.segment<3>(at + 3), Vector3d::Zero()};
    const Matrix3d r = Eigen::Map<const Matrix3d>(x.data() + turning);
    const Matrix3d s = r * first->at_start.shape() * r.transpose();
    body->at_start = Ellipsoid::from_shape(body->path.p, 0.5 * (s + s.transpose()));
    at += 6;
    turning += 9;
  }
  now.across = x.segment<3>(12);
  return now;
}

VectorXd rate_of(const SpatialEngagement& e, const VectorXd& x) {
  VectorXd rate(33);
  const Vector3d c = e.b.path.p - e.a.path.p, u = c.normalized();
  const Vector3d frame = u.cross(e.relative(0)) / c.norm() + e.plane_spin * u;
  rate << e.a.path.v, e.a.path.a, e.b.path.v, e.b.path.a, frame.cross(e.across), VectorXd::Zero(18);
  int turning = 15;
  for (const testing::SpatialBody* body : {&e.a, &e.b}) {
    Vector3d omega = body->omega;
    if (body->with_heading) omega += body->path.v.cross(body->path.a) / body->path.v.squaredNorm();
    const Eigen::Map<const Matrix3d> r(x.data() + turning);
    for (int j = 0; j < 3; ++j) rate.segment<3>(turning + 3 * j) = omega.cross(r.col(j));
    turning += 9;
  }
  return rate;
}

/// On the plane that is carried along and spins, both bodies turning with their headings or by themselves.
TEST(ClosedLoop, CooperativeAvoidanceInSpaceFollowsItsExponential) {
  RandomBodies random(6194);
  SCOPED_TRACE(random.trace());
  Errors errors;
  int steps = 0;
  for (int i = 0; i < 12; ++i) {
    SpatialEngagement start = testing::random_spatial_engagement(random, 0.95);
    start.a.growth.setZero();
    start.b.growth.setZero();
    const LawOptions options = random_options(random);
    const double mu = i % 3 == 0 ? 0 : random.uniform(-1, 1);
    VectorXd x(33);
    const Matrix3d one = Matrix3d::Identity();
    x << start.a.path.p, start.a.path.v, start.b.path.p, start.b.path.v, start.across, one.reshaped(),
        one.reshaped();
    const double y0 = start.y(0);
    bool steers = true;
    const auto commanded = [&](const VectorXd& state) {
      SpatialEngagement now = spatial_at(start, state);
      const CooperativeCommand command = cooperative_avoidance(now.state(), now.cone(), options, mu);
      now.apply(command.a, command.b);
      steers = steers && command.status == LawStatus::steering;
      return now;
    };
    double t = 0, dt = kDuration;
    while (t < kDuration && advance(x, t, dt, [&](const VectorXd& state, double) {
             return rate_of(commanded(state), state);
           })) {
      steers = true;
      commanded(x);
      if (!steers) break;
      const SpatialEngagement now = spatial_at(start, x);
      if (true_sector(now.a.at(0), now.b.at(0), now.across).psi() > 2.5) break;
      const double left = std::exp(-options.gain * t);
      errors.add(std::abs(now.y(0) - options.reference - (y0 - options.reference) * left) /
                 std::abs((y0 - options.reference) * left));
      ++steps;
    }
  }
  std::printf("cooperative avoidance in space in a loop, %d steps: worst relative error of y - w %.1e\n",
              steps, errors.worst());
  EXPECT_GT(steps, 500);
  EXPECT_LT(errors.worst(), 1e-6);
}

}  // namespace
}  // namespace vericone::guidance::closed_loop_test
