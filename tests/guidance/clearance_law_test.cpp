// SPDX-License-Identifier: BSD-3-Clause
//
// The clearance law against finite differences of m(w) along motion that the test propagates itself.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/pair.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/guidance/laws.h>
#include <vericone/internal/guidance/laws.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "cones/ellipsoids/richardson.h"

namespace vericone::guidance::clearance_law_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using vericone::testing::RandomBodies;

/// An ellipsoid that moves on a parabola, turns at a constant rate and grows along its axes.
struct Flight {
  Vector3d center, velocity, acceleration, omega;
  Vector3d semi_axes, growth;
  Matrix3d rotation;

  Matrix3d turned(double t) const {
    const double angle = omega.norm() * t;
    return angle == 0 ? rotation : Matrix3d(Eigen::AngleAxisd(angle, omega.normalized()) * rotation);
  }
  Ellipsoid body(double t) const {
    return Ellipsoid::from_axes(center + velocity * t + 0.5 * t * t * acceleration, semi_axes + growth * t,
                                turned(t));
  }
  Vector3d velocity_at(double t) const { return velocity + acceleration * t; }
  BodyState state(Turning turning) const {
    BodyState state;
    state.shape = CombinedEllipsoid(body(0));
    state.position = center;
    state.velocity = velocity;
    state.turning = turning;
    if (turning == Turning::none) state.omega = omega;
    const Matrix3d rate =
        rotation * Vector3d(2 * semi_axes.cwiseProduct(growth)).asDiagonal() * rotation.transpose();
    state.rate.shape = (rate + rate.transpose()) / 2;
    return state;
  }
};

Flight random_flight(RandomBodies& random, const Vector3d& center) {
  Flight f;
  f.center = center;
  f.velocity = random.uniform(2, 12) * random.direction();
  f.acceleration = Vector3d::Zero();
  f.omega = 0.5 * random.in_box(1);
  f.semi_axes = {random.uniform(1, 5), random.uniform(1, 5), random.uniform(1, 5)};
  f.growth = 0.2 * random.in_box(1);
  f.rotation = random.rotation();
  return f;
}

double miss(const Flight& a, const Flight& b, double t) {
  return clearance(a.body(t), b.body(t), a.velocity_at(t) - b.velocity_at(t)).distance;
}

class ClearanceLaw : public ::testing::TestWithParam<bool> {};

/// m' = -K (m - required) along the motion that the command causes: 1,000 states a row, A turning with its
/// heading or not.
TEST_P(ClearanceLaw, MakesTheMissDistanceFollowItsOrder) {
  const bool heading = GetParam();
  RandomBodies random(heading ? 61 : 62);
  SCOPED_TRACE(random.trace());
  ClearanceOptions options;
  options.required = 3;
  options.gain = 0.7;
  options.hold = true;
  std::vector<double> errors;
  int inside = 0;
  while (errors.size() < 1000) {
    Flight a = random_flight(random, Vector3d::Zero()),
           b = random_flight(random, random.uniform(15, 40) * random.direction());
    const Vector3d ahead = (b.center + random.in_box(8)).normalized();
    a.velocity = b.velocity + random.uniform(5, 15) * ahead;
    if (heading) a.omega.setZero();
    b.acceleration = random.in_box(2);
    if (relation<3>(a.body(0), b.body(0)) != Relation::disjoint) continue;
    const ClearanceCommand command = clearance_law(a.state(heading ? Turning::with_heading : Turning::none),
                                                   b.state(Turning::none), options, b.acceleration);
    if (command.status != LawStatus::steering) continue;
    EXPECT_NEAR(command.acceleration.dot(a.velocity), 0, 1e-9 * command.demanded * a.velocity.norm());
    a.acceleration = command.acceleration;
    if (heading) a.omega = a.velocity.cross(a.acceleration) / a.velocity.squaredNorm();
    const double h = 1e-2 / (1 + a.acceleration.norm() + 10 * a.omega.norm());
    const double found = vericone::testing::richardson_derivative([&](double t) { return miss(a, b, t); }, h);
    const double wanted = -options.gain * (command.m - options.required - options.beyond);
    // The scale: what the terms of m' are made of.
    const double scale = std::abs(wanted) + std::abs(command.drift) +
                         std::abs(command.time_to_closest) * b.acceleration.norm();
    const double error = std::abs(found - wanted) / scale;
    // Where m < 0 another of its maxima may take over within the difference: m has a corner there and no
    // rate.
    if (command.m < 0) {
      const double left = (miss(a, b, 0) - miss(a, b, -h)) / h, right = (miss(a, b, h) - miss(a, b, 0)) / h;
      if (std::abs(left - right) > 0.05 * scale) continue;
      ++inside;
    }
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors.back(), 1e-6);
  EXPECT_GT(inside, 200);
}
INSTANTIATE_TEST_SUITE_P(Turning, ClearanceLaw, ::testing::Bool(),
                         [](const auto& param) { return param.param ? "WithHeading" : "None"; });

TEST(ClearanceLawPlanar, MakesTheMissDistanceFollowItsOrder) {
  RandomBodies random(63);
  SCOPED_TRACE(random.trace());
  ClearanceOptions options;
  options.required = 2;
  options.hold = true;
  int tested = 0;
  while (tested < 500) {
    const Eigen::Vector2d c = random.uniform(10, 30) * random.direction_2d();
    const Eigen::Vector2d va = random.uniform(3, 10) * random.direction_2d(),
                          vb = random.uniform(0, 3) * random.direction_2d();
    const double angle = random.uniform(-3, 3), angle_b = random.uniform(-3, 3);
    const Eigen::Vector2d axes(random.uniform(1, 4), random.uniform(1, 4)),
        axes_b(random.uniform(1, 4), random.uniform(1, 4));
    BodyState a, b;
    a.shape = CombinedEllipse(Ellipse::from_axes({0, 0}, axes, rotation_2d(angle)));
    a.velocity = {va.x(), va.y(), 0};
    a.turning = Turning::with_heading;
    b.shape = CombinedEllipse(Ellipse::from_axes(c, axes_b, rotation_2d(angle_b)));
    b.position = {c.x(), c.y(), 0};
    b.velocity = {vb.x(), vb.y(), 0};
    const ClearanceCommand command = clearance_law(a, b, options);
    if (command.status != LawStatus::steering) continue;
    EXPECT_EQ(command.acceleration.z(), 0);
    const Eigen::Vector2d lateral = command.acceleration.head<2>();
    const double turn = (va.x() * lateral.y() - va.y() * lateral.x()) / va.squaredNorm();
    // The widths of both bodies along the normals of the relative velocity, written out.
    const auto m = [&](double t) {
      const Eigen::Vector2d w = va + lateral * t - vb, p = c + vb * t - va * t - 0.5 * t * t * lateral;
      double most = -1e300;
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector2d n = side * Eigen::Vector2d(-w.y(), w.x()).normalized();
        const auto width = [&](const Eigen::Vector2d& semi_axes, double at) {
          return semi_axes.cwiseProduct(rotation_2d(-at) * n).norm();
        };
        most = std::max(most, n.dot(p) - width(axes, angle + turn * t) - width(axes_b, angle_b));
      }
      return most;
    };
    ASSERT_NEAR(command.m, m(0), 1e-10);
    const double h = 1e-2 / (1 + lateral.norm() + 10 * std::abs(turn));
    const double left = (m(0) - m(-h)) / h, right = (m(h) - m(0)) / h;
    const double wanted = -options.gain * (command.m - options.required - options.beyond);
    if (std::abs(left - right) > 0.1 * (std::abs(wanted) + 1)) continue;  // the other normal takes over
    EXPECT_NEAR(vericone::testing::richardson_derivative(m, h), wanted, 1e-6 * (std::abs(wanted) + 1));
    ++tested;
  }
}

BodyState ball(const Vector3d& center, const Vector3d& velocity, double radius) {
  BodyState state;
  state.shape = CombinedEllipsoid(Ellipsoid::from_axes(center, Vector3d::Constant(radius)));
  state.position = center;
  state.velocity = velocity;
  return state;
}

TEST(ClearanceLawStates, AreToldApart) {
  ClearanceOptions options;
  options.required = 1;
  options.most = 4;
  const BodyState b = ball({20, 0, 0}, {0, 0, 0}, 1);
  // Passing 3 m beside the other: enough.
  EXPECT_EQ(clearance_law(ball({0, 5, 0}, {5, 0, 0}, 1), b, options).status, LawStatus::clear);
  // Away from it.
  EXPECT_EQ(clearance_law(ball({0, 0, 0}, {-5, 0.1, 0}, 1), b, options).status, LawStatus::receding);
  EXPECT_EQ(clearance_law(ball({0, 0, 0}, {0, 0, 0}, 1), b, options).status, LawStatus::no_relative_velocity);
  // Head on: all sides are as good; one is taken, the same every time, with the most allowed.
  const ClearanceCommand head_on = clearance_law(ball({0, 0, 0}, {5, 0, 0}, 1), b, options);
  EXPECT_EQ(head_on.status, LawStatus::steering);
  EXPECT_NEAR(head_on.m, -2, 1e-12);
  EXPECT_NEAR(head_on.acceleration.x(), 0, 1e-12);
  EXPECT_EQ(clearance_law(ball({0, 0, 0}, {5, 0, 0}, 1), b, options).acceleration, head_on.acceleration);
  options.most = 0.1;
  const ClearanceCommand saturated = clearance_law(ball({0, 0.5, 0}, {5, 0, 0}, 1), b, options);
  EXPECT_EQ(saturated.status, LawStatus::saturated);
  EXPECT_NEAR(saturated.acceleration.norm(), 0.1, 1e-15);
  EXPECT_GT(saturated.acceleration.y(), 0.09);  // to the side on which it already is
}

/// Spheres: the shadow is a disc, m = distance of the line of motion - radii; closed form.
TEST(ClearanceLawStates, SpheresInClosedForm) {
  RandomBodies random(64);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const Vector3d c = random.uniform(10, 20) * random.direction(),
                   v = random.uniform(1, 9) * random.direction();
    const double m = c.cross(v).norm() / v.norm() - 3;
    EXPECT_NEAR(law_clearance(ball({0, 0, 0}, v, 1), ball(c, {0, 0, 0}, 2)), m, 1e-10);
  }
}

/// A mesh that is no box of an ellipsoid's, as it stands at a time.
struct MeshFlight {
  Vector3d position, velocity, acceleration, omega;
  Matrix3d rotation;
  Body body;

  Placed at(double t) const {
    const double angle = omega.norm() * t;
    const Matrix3d turned =
        angle == 0 ? rotation : Matrix3d(Eigen::AngleAxisd(angle, omega.normalized()) * rotation);
    return {body, {position + velocity * t + 0.5 * t * t * acceleration, turned}};
  }
};

Body random_mesh(RandomBodies& random) {
  std::vector<Vector3d> points;
  std::vector<Assembly::Triangle> triangles;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const Vector3d x = random.in_box(3);
    for (int k = 0; k < 3; ++k) points.push_back(x + random.in_box(1.5));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return Assembly::mesh(std::move(points), std::move(triangles));
}

/// m' = drift + by_acceleration . a of an ellipsoid, turning with its heading or not, that passes a mesh that
/// turns and is accelerated; seen along the motion by Pair::miss.
TEST(ClearanceLawOfPlaced, RatesAreThoseOfTheNearestPoints) {
  RandomBodies random(63);
  SCOPED_TRACE(random.trace());
  std::vector<double> errors;
  while (errors.size() < 150) {
    const bool heading = errors.size() % 2 == 0;
    Flight a = random_flight(random, Vector3d::Zero());
    a.growth.setZero();
    if (heading) a.omega.setZero();
    const MeshFlight b{random.uniform(14, 25) * random.direction(),
                       random.in_box(3),
                       random.in_box(2),
                       0.4 * random.in_box(1),
                       random.rotation(),
                       random_mesh(random)};
    a.velocity = b.velocity + random.uniform(5, 15) * (b.position + random.in_box(9)).normalized();
    a.acceleration = random.in_box(3);
    const auto m = [&](double t) {
      const Miss miss =
          Pair(Placed(Body(a.body(t))), b.at(t)).miss(a.velocity_at(t), b.velocity + b.acceleration * t);
      return miss.most > 0 && miss.time > 0 ? miss.distance : std::nan("");
    };
    BodyState obstacle;
    obstacle.shape = b.at(0);
    obstacle.position = b.position;
    obstacle.velocity = b.velocity;
    obstacle.omega = b.omega;
    ClearanceOptions options;
    options.required = 1e3;
    const ClearanceCommand command = clearance_law(a.state(heading ? Turning::with_heading : Turning::none),
                                                   obstacle, options, b.acceleration);
    if (heading) a.omega = a.velocity.cross(a.acceleration) / a.velocity.squaredNorm();
    const double h = 1e-4, left = (m(0) - m(-h)) / h, right = (m(h) - m(0)) / h;
    if (std::isnan(left + right)) continue;  // they meet, or recede
    EXPECT_NEAR(command.m, m(0), 1e-9);
    const double scale = 1 + std::abs(command.drift) + command.by_acceleration.norm() * a.acceleration.norm();
    if (std::abs(left - right) > 0.02 * scale) continue;  // another corner or triangle takes over
    const double wanted = command.drift + command.by_acceleration.dot(a.acceleration);
    errors.push_back(std::abs(0.5 * (left + right) - wanted) / scale);
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() * 9 / 10], 1e-4);
  EXPECT_LT(errors.back(), 2e-2);
}

/// m' = -K (m - required) of the worst error's clearance along the motion that the command causes, where the
/// velocity has the worst error; more for others.
TEST(ClearanceLawOfErrors, MakesTheWorstClearanceFollowItsOrder) {
  RandomBodies random(71);
  SCOPED_TRACE(random.trace());
  ClearanceOptions options;
  options.required = 3;
  options.gain = 0.7;
  options.hold = true;
  int tested = 0;
  for (int i = 0; tested < 300; ++i) {
    Flight a = random_flight(random, Vector3d::Zero()),
           b = random_flight(random, random.uniform(15, 40) * random.direction());
    a.velocity = b.velocity + random.uniform(5, 15) * (b.center + random.in_box(8)).normalized();
    b.acceleration = random.in_box(1);
    options.position_error = ErrorSet::ball(random.uniform(0.01, 1));
    options.velocity_error = i % 2 ? ErrorSet::ball(random.uniform(0.01, 1))
                                   : ErrorSet::ellipsoid({0.2, 1, 0.6}, random.rotation());
    const auto worst = [&](double t, const Vector3d& error) {
      return robust_clearance(a.body(t), b.body(t).translated(-t * error),
                              a.velocity_at(t) - b.velocity_at(t), options.position_error,
                              options.velocity_error)
          ->distance;
    };
    const ClearanceCommand command =
        clearance_law(a.state(Turning::none), b.state(Turning::none), options, b.acceleration);
    if (command.status != LawStatus::steering || command.m < 0) continue;
    EXPECT_NEAR(command.m, worst(0, Vector3d::Zero()), 1e-12 * (1 + command.m));
    const Vector3d n = -command.by_acceleration / command.time_to_closest;
    a.acceleration = command.acceleration;
    const double h = 1e-2 / (1 + a.acceleration.norm() + 10 * a.omega.norm());
    const double wanted = -options.gain * (command.m - options.required - options.beyond);
    const double scale = std::abs(wanted) + std::abs(command.drift) + 1;
    const auto rate = [&](const Vector3d& error) {
      return vericone::testing::richardson_derivative([&](double t) { return worst(t, error); }, h);
    };
    EXPECT_NEAR(rate(options.velocity_error.support_point(n)), wanted, 1e-5 * scale) << i;
    EXPECT_GT(rate(options.velocity_error.support_point(random.direction())), wanted - 1e-5 * scale) << i;
    ++tested;
  }
}

/// Without errors to the last bit what it was; errors that vanish change nothing in the end.
TEST(ClearanceLawOfErrors, EmptySetsChangeNothing) {
  RandomBodies random(72);
  ClearanceOptions options, empty, tiny;
  empty.position_error = ErrorSet::ball(0);
  empty.velocity_error = ErrorSet::box(Vector3d::Zero());
  tiny.position_error = ErrorSet::ball(1e-12);
  tiny.velocity_error = ErrorSet::ball(1e-12);
  int steering = 0;
  for (int i = 0; i < 300; ++i) {
    Flight a = random_flight(random, Vector3d::Zero()),
           b = random_flight(random, random.uniform(15, 40) * random.direction());
    a.velocity = b.velocity + 9 * (b.center + random.in_box(12)).normalized();
    const ClearanceCommand plain = clearance_law(a.state(Turning::none), b.state(Turning::none), options),
                           same = clearance_law(a.state(Turning::none), b.state(Turning::none), empty),
                           near = clearance_law(a.state(Turning::none), b.state(Turning::none), tiny);
    EXPECT_EQ(plain.acceleration, same.acceleration);
    EXPECT_EQ(plain.m, same.m);
    EXPECT_EQ(plain.drift, same.drift);
    EXPECT_EQ(plain.status, same.status);
    if (plain.m < 0 || plain.status != LawStatus::steering) continue;
    ++steering;
    EXPECT_LT((plain.acceleration - near.acceleration).norm(), 1e-5 * (1 + plain.demanded));
  }
  EXPECT_GT(steering, 5);
}

/// The law sees the obstacle where it is thought to be, another one flies: it is passed by what is required.
TEST(ClearanceLawOfErrors, KeepsTheDistanceForErrorsThatItDoesNotKnow) {
  RandomBodies random(73);
  ClearanceOptions options;
  options.required = 1;
  options.gain = 2;
  options.position_error = ErrorSet::ball(1.5);
  options.velocity_error = ErrorSet::ball(0.4);
  int without = 0, runs = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector3d c = random.uniform(50, 70) * random.direction();
    const Vector3d p = 1.5 * random.direction(), v = 0.4 * random.direction();
    const Vector3d start = random.uniform(6, 12) * (c + random.in_box(4)).normalized();
    const Ellipsoid body = Ellipsoid::from_axes(Vector3d::Zero(), {3, 2, 1}, random.rotation());
    const auto nearest_passage = [&](const ClearanceOptions& of) {
      // The obstacle moves by -v from c + p; measured, it rests, and p is left out.
      BodyState a = ball(Vector3d::Zero(), start, 1), b;
      double nearest = 1e300;
      constexpr double kStep = 0.02;
      for (double t = 0; t < 16; t += kStep) {
        const Ellipsoid now = Ellipsoid::from_axes(a.position, Vector3d::Ones());
        nearest = std::min(nearest, separation(now, body.translated(c + p - v * t)).distance);
        // What the law sees.
        b.shape = CombinedEllipsoid(body.translated(c - v * t));
        b.position = c - v * t;
        a.shape = CombinedEllipsoid(now);
        const ClearanceCommand command = clearance_law(a, b, of);
        a.velocity += kStep * command.acceleration;
        a.position += kStep * a.velocity;
      }
      return nearest;
    };
    ClearanceOptions blind = options;
    blind.position_error = blind.velocity_error = {};
    without += nearest_passage(blind) < options.required - 0.05;
    EXPECT_GT(nearest_passage(options), options.required - 0.05) << i;
    ++runs;
  }
  EXPECT_GT(without, runs / 10);
}

/// Errors as large as the velocity: no order is given.
TEST(ClearanceLawOfErrors, SaysWhereTheVelocityIsNotKnown) {
  ClearanceOptions options;
  options.velocity_error = ErrorSet::ball(5);
  EXPECT_EQ(clearance_law(ball({0, 0, 0}, {5, 0, 0}, 1), ball({20, 0, 0}, {0, 0, 0}, 1), options).status,
            LawStatus::no_relative_velocity);
}

}  // namespace
}  // namespace vericone::guidance::clearance_law_test
