// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/track.h>
#include <Eigen/Geometry>
#include <cmath>

#include "random.h"

namespace vericone::simulation::track_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Closed form of the motion in its plane: speed linear in time, turning at lateral / speed. x' = s cos(chi)
/// with s = s0 exp(chi / kappa), dt = s dchi / lateral, so x = s0^2 / lateral times the integral of exp(2 chi
/// / kappa) cos(chi).
Motion closed_form(const Motion& start, const Vector3d& a, double t) {
  const double s0 = start.velocity.norm();
  const Vector3d u = start.velocity / s0;
  const double longitudinal = a.dot(u);
  const Vector3d across = a - longitudinal * u;
  const double lateral = across.norm();
  const Vector3d n = across / lateral;
  double chi, x, y;
  if (std::abs(longitudinal) < 1e-12 * lateral) {
    chi = lateral * t / s0;
    x = s0 * s0 / lateral * std::sin(chi);
    y = s0 * s0 / lateral * 2 * std::sin(chi / 2) * std::sin(chi / 2);
  } else {
    const double kappa = lateral / longitudinal, g = 2 / kappa;
    chi = kappa * std::log1p(longitudinal * t / s0);
    const auto along = [&](double c) { return std::exp(g * c) * (g * std::cos(c) + std::sin(c)); };
    const auto aside = [&](double c) { return std::exp(g * c) * (g * std::sin(c) - std::cos(c)); };
    const double scale = s0 * s0 / lateral / (g * g + 1);
    x = scale * (along(chi) - along(0));
    y = scale * (aside(chi) - aside(0));
  }
  Motion m;
  m.position = start.position + x * u + y * n;
  m.velocity = (s0 + longitudinal * t) * (std::cos(chi) * u + std::sin(chi) * n);
  m.rotation = Eigen::AngleAxisd(chi, u.cross(n).normalized()) * start.rotation;
  return m;
}

void expect_same(const Motion& x, const Motion& y, double tolerance) {
  EXPECT_LE((x.position - y.position).norm(), tolerance);
  EXPECT_LE((x.velocity - y.velocity).norm(), tolerance);
  EXPECT_LE((x.rotation - y.rotation).norm(), tolerance);
}

TEST(Arc, AgreesWithTheClosedFormEverywhere) {
  SCOPED_TRACE("seed 21");
  Random random(21);
  for (int i = 0; i < 500; ++i) {
    const double speed = random.uniform(3, 30);
    const Vector3d u = random.vector(1).normalized();
    const Motion start{random.vector(50), speed * u, random.rotation()};
    const double duration = std::pow(10, random.uniform(-2, 0.7));
    Vector3d across = random.vector(10);
    across -= across.dot(u) * u;
    // Never brakes to less than a fifth of the speed.
    const double longitudinal = i % 3 == 0 ? 0 : random.uniform(-0.8 * speed / duration, 5);
    const Vector3d a = across + longitudinal * u;
    const double from = random.uniform(0, 10);
    const Arc arc(start, a, Orientation::heading, from, from + duration);
    for (int j = 0; j <= 20; ++j) {
      const double t = duration * j / 20;
      expect_same(arc.at(from + t), closed_form(start, a, t), 1e-9);
    }
    expect_same(arc.end(), arc.at(from + duration), 0);
  }
}

TEST(Arc, LateralAccelerationMakesAnExactCircle) {
  const Motion start{{1, 2, 3}, {0, 8, 6}, Matrix3d::Identity()};
  const Vector3d a(5, 0, 0);
  const Arc arc(start, a, Orientation::heading, 2, 14);
  const Vector3d middle = start.position + Vector3d(20, 0, 0);  // radius v^2 / a
  for (int j = 0; j <= 1000; ++j) {
    const double t = 2 + 12 * j / 1000.0;
    const Motion m = arc.at(t);
    EXPECT_NEAR((m.position - middle).norm(), 20, 1e-10);
    EXPECT_NEAR(m.velocity.norm(), 10, 1e-12);
    expect_same(m, closed_form(start, a, t - 2), 1e-10);
    EXPECT_NEAR(arc.acceleration(t).dot(m.velocity), 0, 1e-10);
    EXPECT_NEAR(arc.acceleration(t).norm(), 5, 1e-12);
  }
  EXPECT_NEAR(arc.most_turn_rate(), 0.5, 1e-9);
  EXPECT_EQ(arc.most_acceleration(), 5);
}

TEST(Arc, LongitudinalAccelerationIsAStraightLine) {
  const Motion start{{1, 2, 3}, {3, 4, 0}, Matrix3d::Identity()};
  const Arc faster(start, {0.6, 0.8, 0}, Orientation::heading, 0, 4);
  EXPECT_TRUE(faster.at(4).position.isApprox(Vector3d(1 + 16.8, 2 + 22.4, 3), 1e-14));
  EXPECT_NEAR(faster.at(4).velocity.norm(), 9, 1e-13);
  EXPECT_EQ(faster.most_turn_rate(), 0);
  const Arc still(start, Vector3d::Zero(), Orientation::heading, 0, 4);
  EXPECT_TRUE(still.at(2).position == Vector3d(7, 10, 3));
  EXPECT_EQ(still.most_acceleration(), 0);
}

TEST(Arc, BrakingBeyondRestGoesOnWithAFixedAcceleration) {
  // Straight: comes back.
  const Motion start{{0, 0, 0}, {2, 0, 0}, Matrix3d::Identity()};
  const Arc back(start, {-1, 0, 0}, Orientation::heading, 0, 4);
  EXPECT_NEAR(back.end().position.x(), 0, 1e-14);
  EXPECT_NEAR(back.end().velocity.x(), -2, 1e-14);
  EXPECT_TRUE(back.end().rotation == Matrix3d::Identity());
  // Turning: at 1 mm/s the acceleration is that of the moment, and position and velocity are continuous.
  const Arc turning(start, {-1, 0.2, 0}, Orientation::heading, 0, 4);
  double step = 1;
  const double rest = 1.999;
  for (const double h : {1e-4, 1e-5, 1e-6}) {
    const double now = (turning.at(rest + h).position - turning.at(rest - h).position).norm();
    EXPECT_LT(now, step / 5);
    step = now;
    EXPECT_NEAR((turning.at(rest + h).velocity - turning.at(rest - h).velocity).norm(), 0, 3 * h);
  }
  EXPECT_TRUE(turning.acceleration(2.5) == turning.acceleration(3.5));
  EXPECT_NEAR(turning.acceleration(2.5).norm(), std::sqrt(1.04), 1e-12);
  // At rest from the beginning.
  const Arc away({{0, 0, 0}, {0, 0, 0}, Matrix3d::Identity()}, {0, 3, 0}, Orientation::heading, 0, 2);
  EXPECT_TRUE(away.end().position.isApprox(Vector3d(0, 6, 0)));
  EXPECT_TRUE(away.end().rotation == Matrix3d::Identity());
}

TEST(Arc, TurnRateIsABound) {
  SCOPED_TRACE("seed 22");
  Random random(22);
  for (const Orientation orientation : {Orientation::fixed, Orientation::heading, Orientation::level})
    for (int i = 0; i < 200; ++i) {
      Motion start{random.vector(5), random.vector(20), random.rotation()};
      const Vector3d a = random.vector(6);
      // Tracks level their start.
      Track track(RigidShape{CombinedEllipsoid(Ellipsoid())}, start, orientation, 0);
      track.advance(a, 2);
      const Leg& arc = *track.legs()[0];
      const double h = 1e-5;
      for (int j = 0; j < 100; ++j) {
        const double t = random.uniform(0, 2 - h);
        const Matrix3d r = arc.at(t).rotation;
        EXPECT_TRUE((r.transpose() * r - Matrix3d::Identity()).isZero(1e-14));
        const double angle = Eigen::AngleAxisd(Matrix3d(arc.at(t + h).rotation * r.transpose())).angle();
        EXPECT_LE(angle, arc.most_turn_rate() * h * (1 + 1e-6) + 1e-10);
        const double speed = track.motion(0).velocity.norm();
        const bool rests = speed + 2 * a.dot(track.motion(0).velocity) / speed < 0.01;
        if (orientation == Orientation::heading && !rests) {
          // What is ahead in the frame stays along the velocity.
          const Vector3d ahead = r * (track.motion(0).rotation.transpose() * track.motion(0).velocity);
          EXPECT_NEAR(ahead.normalized().dot(arc.at(t).velocity.normalized()), 1, 1e-12);
        }
        if (orientation == Orientation::level) {
          EXPECT_NEAR(r(2, 1), 0, 1e-15);
          EXPECT_TRUE(r.col(0).isApprox(arc.at(t).velocity.normalized(), 1e-13));
        }
      }
    }
}

TEST(Arc, LevelFramesJumpOnlyWhereTheBoundIsInfinite) {
  Track vertical(RigidShape{CombinedEllipsoid(Ellipsoid())}, {{0, 0, 0}, {5, 0, 5}, Matrix3d::Identity()},
                 Orientation::level, 0);
  vertical.advance(5 * Vector3d(-1, 0, 1).normalized(), 5);  // over the top
  EXPECT_FALSE(std::isfinite(vertical.bounds(0, 5).turn_rate));
  Track straight_up(RigidShape{CombinedEllipsoid(Ellipsoid())}, {{0, 0, 0}, {0, 0, 5}, Matrix3d::Identity()},
                    Orientation::level, 0);
  straight_up.advance(Vector3d::Zero(), 5);
  EXPECT_TRUE(straight_up.motion(5).rotation.isApprox(rotation_from_heading(0, M_PI / 2)));
  EXPECT_EQ(straight_up.bounds(0, 5).turn_rate, 0);
}

TEST(Arc, PlanarMotionStaysInThePlane) {
  SCOPED_TRACE("seed 23");
  Random random(23);
  for (int i = 0; i < 100; ++i) {
    const double heading = random.uniform(-3, 3);
    Track track(DentedConic{6, 2, {}},
                {{1, 2, 0},
                 20 * Vector3d(std::cos(heading), std::sin(heading), 0),
                 rotation_from_heading(heading, 0)},
                Orientation::heading, 0);
    for (int j = 1; j <= 50; ++j) {
      Vector3d a = random.vector(15);
      a.z() = 0;
      track.advance(a, 0.02 * j);
    }
    const Motion end = track.motion(track.end());
    EXPECT_EQ(end.position.z(), 0);
    EXPECT_EQ(end.velocity.z(), 0);
    const double azimuth = std::atan2(end.velocity.y(), end.velocity.x());
    EXPECT_TRUE(end.rotation.isApprox(rotation_from_heading(azimuth, 0), 1e-12));
  }
}

TEST(Track, ArcsJoin) {
  SCOPED_TRACE("seed 24");
  Random random(24);
  Track track(RigidShape{CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {3, 2, 1}))},
              {random.vector(5), random.vector(20), random.rotation()}, Orientation::heading, 1.5);
  EXPECT_EQ(track.end(), 1.5);
  for (int j = 1; j <= 300; ++j)
    track.advance(j % 4 == 0 ? Vector3d::Zero() : random.vector(10), 1.5 + 0.01 * j);
  EXPECT_EQ(track.end(), 4.5);
  for (std::size_t i = 0; i + 1 < track.legs().size(); ++i) {
    const double t = track.legs()[i]->to();
    EXPECT_EQ(t, track.legs()[i + 1]->from());
    expect_same(track.legs()[i]->end(), track.motion(t), 1e-13);
  }
  // Over any interval the position is within |a| dt^2 / 8 of its chord.
  for (int j = 0; j < 500; ++j) {
    const double from = random.uniform(1.5, 4), to = random.uniform(from, 4.5), t = random.uniform(from, to);
    const Track::Bounds bounds = track.bounds(from, to);
    const double share = (t - from) / (to - from);
    const Vector3d chord = (1 - share) * track.motion(from).position + share * track.motion(to).position;
    EXPECT_LE((track.motion(t).position - chord).norm(),
              bounds.acceleration * (to - from) * (to - from) / 8 + 1e-11);
  }
  const guidance::BodyState state = track.state(3.333);
  EXPECT_EQ(state.turning, guidance::Turning::with_heading);
  EXPECT_EQ(state.shape.quadric()->center(), state.position);
  EXPECT_EQ(state.position, track.motion(3.333).position);
}

TEST(Track, StraightArcsAreOne) {
  Track track(RigidShape{CombinedEllipsoid(Ellipsoid())}, {{0, 0, 0}, {1, 2, 3}, Matrix3d::Identity()},
              Orientation::fixed, 0);
  for (int i = 1; i <= 100; ++i) track.advance(Vector3d::Zero(), 0.1 * i);
  EXPECT_EQ(track.legs().size(), 1u);
  EXPECT_TRUE(track.motion(10).position.isApprox(Vector3d(10, 20, 30), 1e-15));
  EXPECT_THROW(track.advance(Vector3d::Zero(), 10), InputError);
}

}  // namespace
}  // namespace vericone::simulation::track_test
