// SPDX-License-Identifier: BSD-3-Clause
//
// Tracks of others as polynomials: splines against the recursion of Cox and de Boor in long double, fits
// against the trajectory, greatest speeds against samples and closed forms; bad input; verdicts that do not
// change where the same way is given by more samples; certificates.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <vericone/simulation/trajectory.h>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "../moving_pairs.h"

namespace vericone::simulation::trajectory_test {
namespace {

void expect_refused(const std::function<void()>& made, const std::string& field) {
  try {
    made();
    ADD_FAILURE() << field;
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), field) << e.what();
  }
}

/// N_i,p(t) of the recursion.
long double basis(const std::vector<double>& knots, std::size_t i, int p, long double t) {
  if (p == 0) return t >= knots[i] && t < knots[i + 1] ? 1 : 0;
  const auto n = static_cast<std::size_t>(p);
  const long double left = static_cast<long double>(knots[i + n]) - knots[i],
                    right = static_cast<long double>(knots[i + n + 1]) - knots[i + 1];
  long double sum = 0;
  if (left > 0) sum += (t - knots[i]) / left * basis(knots, i, p - 1, t);
  if (right > 0) sum += (knots[i + n + 1] - t) / right * basis(knots, i + 1, p - 1, t);
  return sum;
}

TEST(Trajectory, SplinesOfAllDegreesClampedAndNot) {
  SCOPED_TRACE("seed 401");
  Random random(401);
  for (int degree = 1; degree <= 9; ++degree)
    for (const bool clamped : {true, false}) {
      const std::size_t count = static_cast<std::size_t>(degree) + 4;
      std::vector<Vector3d> points;
      for (std::size_t i = 0; i < count; ++i) points.push_back(random.vector(10));
      std::vector<double> knots;
      double t = -1;
      for (std::size_t i = 0; i < count + static_cast<std::size_t>(degree) + 1; ++i) {
        const bool end = i < static_cast<std::size_t>(degree) || i > count;
        if (!(clamped && (end || i == 0)) && i > 0) t += random.uniform(0.1, 1);
        if (clamped && i == static_cast<std::size_t>(degree)) t = knots.empty() ? t : knots.back();
        knots.push_back(t);
      }
      const Piecewise spline = piecewise_of_spline(degree, knots, points);
      EXPECT_EQ(spline.from(), knots[static_cast<std::size_t>(degree)]);
      EXPECT_EQ(spline.to(), knots[count]);
      for (int k = 0; k <= 40; ++k) {
        const double at = spline.from() + (spline.to() - spline.from()) * k / 40.001;
        Eigen::Matrix<long double, 3, 1> sum = Eigen::Matrix<long double, 3, 1>::Zero();
        for (std::size_t i = 0; i < count; ++i)
          sum += basis(knots, i, degree, at) * points[i].cast<long double>();
        EXPECT_LE((spline.at(at) - sum.cast<double>()).norm(), 1e-12) << degree << clamped << at;
      }
    }
}

TEST(Trajectory, FitsAreWithinTheirErrors) {
  SCOPED_TRACE("seed 402");
  Random random(402);
  for (int degree = 0; degree <= 9; ++degree) {
    std::vector<std::vector<Vector3d>> place(3), turn(3);
    std::vector<double> times{2, 3.5, 4, 6};
    for (std::size_t piece = 0; piece < 3; ++piece) {
      for (int i = 0; i <= degree; ++i) {
        place[piece].push_back(random.vector(2 / std::pow(2, i)));
        turn[piece].push_back(random.vector(1 / std::pow(2, i)));
      }
      // Continuous, but for a millionth.
      const auto end = [&](const std::vector<std::vector<Vector3d>>& of) {
        Vector3d sum = Vector3d::Zero();
        for (std::size_t i = of[piece - 1].size(); i-- > 0;)
          sum = sum * (times[piece] - times[piece - 1]) + of[piece - 1][i];
        return sum;
      };
      if (piece > 0) {
        place[piece][0] = end(place) + Vector3d(5e-7, 0, 0);
        turn[piece][0] = end(turn);
      }
    }
    const Trajectory trajectory{
        piecewise_of_powers(times, place), piecewise_of_powers(times, turn), {random.rotation()}};
    const FittedTrack fitted = fitted_track(ball(1), trajectory);
    EXPECT_LE(fitted.position_error, 4e-7);
    EXPECT_LE(fitted.turn_error, 2e-9);
    for (int k = 0; k <= 400; ++k) {
      const double t = 2 + 0.01 * k;
      const std::size_t piece = t < 3.5 ? 0 : t < 4 ? 1 : 2;
      Vector3d p = Vector3d::Zero(), by = Vector3d::Zero();
      for (std::size_t i = place[piece].size(); i-- > 0;) {
        p = p * (t - times[piece]) + place[piece][i];
        by = by * (t - times[piece]) + turn[piece][i];
      }
      const Motion motion = fitted.track.motion(t);
      EXPECT_LE((motion.position - p).norm(), fitted.position_error + 5e-7 + 1e-12) << degree << " " << t;
      const double angle = by.norm();
      const Matrix3d r = angle > 0 ? Matrix3d(Eigen::AngleAxisd(angle, by / angle) * trajectory.rotation[0])
                                   : trajectory.rotation[0];
      EXPECT_LE((motion.rotation - r).norm(), 2 * fitted.turn_error + 1e-12);
    }
  }
}

TEST(Trajectory, PosesAreReachedAndTurnedTheShortestWay) {
  SCOPED_TRACE("seed 403");
  Random random(403);
  std::vector<double> times;
  std::vector<Vector3d> points, velocities;
  std::vector<Matrix3d> rotations;
  for (int i = 0; i < 20; ++i) {
    times.push_back(0.3 * i);
    points.push_back(random.vector(3));
    velocities.push_back(random.vector(3));
    rotations.push_back(random.rotation());
  }
  const Trajectory straight = turned_through({piecewise_through(times, points), {}}, times, rotations),
                   cubic =
                       turned_through({piecewise_through(times, points, velocities), {}}, times, rotations);
  const Track a = fitted_track(ball(1), straight).track, b = fitted_track(ball(1), cubic).track;
  for (std::size_t i = 0; i < times.size(); ++i)
    for (const Track* track : {&a, &b}) {
      EXPECT_LE((track->motion(times[i]).position - points[i]).norm(), 1e-12);
      EXPECT_LE((track->motion(times[i]).rotation - rotations[i]).norm(), 1e-12);
    }
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double t = times[i] + 0.1;
    const Eigen::Quaterniond q(rotations[i]), r(rotations[i + 1]);
    EXPECT_LE((a.motion(t).rotation - q.slerp(1.0 / 3, r).toRotationMatrix()).norm(), 1e-9);
    EXPECT_LE((a.motion(t).position - (2 * points[i] + points[i + 1]) / 3).norm(), 1e-12);
    EXPECT_LE((cubic.position.at(times[i], 1) - velocities[i]).norm(), 1e-9);
  }
}

TEST(Trajectory, TheGreatestSpeedIsEnclosed) {
  SCOPED_TRACE("seed 404");
  Random random(404);
  for (int i = 0; i < 50; ++i) {
    std::vector<Vector3d> powers;
    for (int k = 0; k <= i % 10; ++k) powers.push_back(random.vector(1));
    const Piecewise p = piecewise_of_powers({0, 1.5}, {powers});
    for (int derivative = 1; derivative <= 3; ++derivative) {
      const Greatest found = greatest(p, derivative);
      double sampled = 0;
      for (int k = 0; k <= 2000; ++k) {
        // The derivative of powers, term by term.
        Vector3d sum = Vector3d::Zero();
        const double t = 1.5 * k / 2000;
        for (int j = derivative; j < static_cast<int>(powers.size()); ++j) {
          double factor = std::pow(t, j - derivative);
          for (int m = 0; m < derivative; ++m) factor *= j - m;
          sum += factor * powers[static_cast<std::size_t>(j)];
        }
        sampled = std::max(sampled, sum.norm());
      }
      EXPECT_GE(found.most * (1 + 1e-12) + 1e-12, sampled);
      EXPECT_LE(found.least, sampled * (1 + 1e-4) + 1e-12);
      EXPECT_LE(found.most - found.least, 2e-9 * found.most + 1e-12);
    }
  }
  // A chain of straight lines: speeds 1 and 2, a velocity that jumps by sqrt(5).
  const Piecewise lines = piecewise_through({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}});
  EXPECT_NEAR(greatest(lines, 1).most, 2, 1e-12);
  EXPECT_NEAR(greatest(lines, 2).jump, std::sqrt(5), 1e-12);
  EXPECT_EQ(greatest(lines, 2).least, 0);
}

TEST(Certify, LimitsAreKeptOrBroken) {
  TrackedBody body;
  body.shape = ball(0.1);
  body.trajectory = Trajectory{piecewise_of_powers({0, 2}, {{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}}), {}};
  // x = t + t^2 / 2: 3 m/s at the end, 1 m/s^2 all the time.
  for (const double speed : {2.999, 3.001})
    for (const double acceleration : {0.999, 1.001}) {
      body.most_speed = speed;
      body.most_acceleration = acceleration;
      const CertifiedTracks found = certify({body});
      ASSERT_EQ(found.limits.size(), 2u);
      EXPECT_EQ(found.limits[0].verdict, speed > 3 ? LimitVerdict::kept : LimitVerdict::broken);
      EXPECT_EQ(found.limits[1].verdict, acceleration > 1 ? LimitVerdict::kept : LimitVerdict::broken);
      EXPECT_NEAR(found.limits[0].greatest.time, 2, 1e-9);
    }
  body.trajectory = Trajectory{piecewise_through({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), {}};
  EXPECT_EQ(certify({body}).limits[1].verdict, LimitVerdict::broken);
}

TEST(Certify, TenTimesAsManySamplesOfTheSameWayChangeNoVerdict) {
  SCOPED_TRACE("seed 405");
  Random random(405);
  std::array<int, 4> counts{};
  for (int i = 0; i < 60; ++i) {
    const bool cubic = i % 2 == 0;
    const auto body = [&](double radius) {
      std::vector<double> times;
      std::vector<Vector3d> points;
      std::vector<Matrix3d> rotations;
      for (int k = 0; k <= 10; ++k) {
        times.push_back(0.4 * k);
        points.push_back(random.vector(2.5));
        rotations.push_back(random.rotation());
      }
      TrackedBody coarse, fine;
      coarse.radius = fine.radius = radius;
      coarse.shape = fine.shape =
          i % 3 == 0 ? ShapeInTime(RigidShape{HullBody::box({-0.5, -0.2, -0.1}, {0.5, 0.2, 0.1})})
                     : ellipsoid({0.6, 0.3, 0.2});
      const std::vector<Vector3d> velocities = velocities_through(times, points);
      const Piecewise way =
          cubic ? piecewise_through(times, points, velocities) : piecewise_through(times, points);
      coarse.trajectory = turned_through({way, {}}, times, rotations);
      const Track track = fitted_track(coarse.shape, *coarse.trajectory).track;
      std::vector<double> often;
      std::vector<Vector3d> more, rates;
      std::vector<Matrix3d> turns;
      for (int k = 0; k <= 100; ++k) {
        often.push_back(0.04 * k);
        more.push_back(way.at(often.back()));
        rates.push_back(way.at(often.back(), 1));
        turns.push_back(track.motion(often.back()).rotation);
      }
      fine.trajectory = turned_through(
          {cubic ? piecewise_through(often, more, rates) : piecewise_through(often, more), {}}, often, turns);
      return std::pair(coarse, fine);
    };
    const auto [a, fine_a] = body(0.01 * (i % 4));
    const auto [b, fine_b] = body(0);
    CertifyOptions options;
    options.required = i % 5 == 0 ? 0.3 : 0;
    const PairOnTracks one = certify({a, b}, options).pairs.at(0),
                       other = certify({fine_a, fine_b}, options).pairs.at(0);
    ++counts[static_cast<std::size_t>(one.verdict)];
    EXPECT_EQ(one.verdict, other.verdict) << i;
    if (one.verdict == TrackVerdict::apart)
      EXPECT_NEAR(one.least_distance, other.least_distance, 0.03 * one.least_distance + 1e-5) << i;
    else
      EXPECT_NEAR(one.to, other.to, 1e-5) << i;
  }
  for (const TrackVerdict verdict : {TrackVerdict::apart, TrackVerdict::contact})
    EXPECT_GT(counts[static_cast<std::size_t>(verdict)], 5);
  EXPECT_GT(counts[static_cast<std::size_t>(TrackVerdict::nearer)], 0);
}

/// Two balls that fly towards each other: all times by hand.
TEST(Certify, RadiiAndRequiredDistancesByHand) {
  TrackedBody a, b;
  a.shape = b.shape = ball(1);
  a.trajectory = Trajectory{piecewise_through({0, 10}, {{-10, 0, 0}, {0, 0, 0}}), {}};
  b.trajectory = Trajectory{piecewise_through({0, 10}, {{10, 0, 0}, {0.5, 0, 0}}), {}};
  CertifyOptions options;
  // The gap is 18 - 1.95 t: closed at 18 / 1.95 s.
  const PairOnTracks meet = certify({a, b}, options).pairs.at(0);
  EXPECT_EQ(meet.verdict, TrackVerdict::contact);
  EXPECT_NEAR(meet.to, 18 / 1.95, 1e-6);
  EXPECT_LE(meet.from, 18 / 1.95);
  EXPECT_LE(meet.place.x() - (-10 + 18 / 1.95 + 1), 1e-5);
  options.to = 9;  // a gap of 0.45 m then
  EXPECT_NEAR(certify({a, b}, options).pairs.at(0).least_distance, 0.45, 0.005);
  a.radius = 0.1;
  b.radius = 0.2;
  EXPECT_NEAR(certify({a, b}, options).pairs.at(0).least_distance, 0.15, 0.002);
  options.required = 0.1;
  EXPECT_EQ(certify({a, b}, options).pairs.at(0).verdict, TrackVerdict::apart);
  options.required = 0.2;  // a gap of 0.5 m at 17.5 / 1.95 s
  const PairOnTracks near = certify({a, b}, options).pairs.at(0);
  EXPECT_EQ(near.verdict, TrackVerdict::nearer);
  EXPECT_LE(near.from, 17.5 / 1.95);
  EXPECT_GE(near.to, 17.5 / 1.95 - 1e-9);
  EXPECT_LE(near.to - near.from, 1e-6);
  EXPECT_NEAR(near.stated->least_distance, 0.45, 0.005);
}

TEST(Certify, CertificatesHoldTracksAndRadii) {
  TrackedBody a, b, c;
  a.name = "a", b.name = "b", c.name = "c";
  a.shape = ellipsoid({0.4, 0.3, 0.1});
  b.shape = RigidShape{HullBody::box({-0.3, -0.3, -0.1}, {0.3, 0.3, 0.1})};
  c.shape = ball(0.2);
  a.trajectory = Trajectory{piecewise_of_powers({0, 3}, {{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}}}),
                            piecewise_of_powers({0, 3}, {{{0, 0, 0}, {0, 0, 0.7}}})};
  b.trajectory = Trajectory{piecewise_through({0, 3}, {{3, 2, 0}, {0, 2.5, 0}}), {}};
  c.start.position = {2, 0.6, 0};
  a.radius = 0.05;
  CertifyOptions options;
  options.required = 0.1;
  const std::vector<TrackedBody> bodies{a, b, c};
  const CertifiedTracks certified = certify(bodies, options);
  const RunCertificates made = certificates(bodies, certified, options);
  std::size_t pairs = 0;
  for (const RunCertificate& one : made.made) pairs += one.pairs.size();
  EXPECT_EQ(pairs + made.none.size(), 3u);  // of the contact perhaps
  ASSERT_FALSE(made.made.empty());
  EXPECT_EQ(made.made[0].by, 0.1);
  EXPECT_EQ(made.made[0].pairs.size(), 2u);
  EXPECT_EQ(made.made[0].to, 3);
  // Not of other bodies.
  expect_refused([&] { (void)certificates({a}, certified, options); }, "certified");
  CertifiedTracks wrong = certified;
  wrong.pairs[0].b = 7;
  expect_refused([&] { (void)certificates(bodies, wrong, options); }, "certified");
}

/// The frame along the velocity, level, by its definition.
Matrix3d along(const Vector3d& v) {
  Matrix3d r;
  r.col(0) = v.normalized();
  r.col(1) = Vector3d::UnitZ().cross(v).normalized();
  r.col(2) = r.col(0).cross(r.col(1));
  return r;
}

TEST(Trajectory, FacesAlongItsVelocity) {
  Random random(77);
  for (int i = 0; i < 20; ++i) {
    std::vector<Vector3d> powers{random.vector(3), Vector3d(3, 0.5, 0.3)};
    for (int k = 2; k < 6; ++k) powers.push_back(random.vector(1.5 / std::pow(2, k)));
    const Trajectory plain{piecewise_of_powers({1, 3}, {powers}), {}};
    for (const double within : {1e-3, 1e-5}) {
      const Trajectory made = turned_along(plain, within);
      EXPECT_LE(made.turned->error, within * (1 + 1e-9));
      const FittedTrack fitted = fitted_track(ball(1), made);
      double most = 0;
      for (int j = 0; j <= 3000; ++j) {
        const double t = 1 + 2 * j / 3000.0;
        const Matrix3d off = fitted.track.motion(t).rotation.transpose() * along(plain.position.at(t, 1));
        most = std::max(most, Eigen::AngleAxisd(off).angle());
      }
      EXPECT_LE(most, fitted.turn_error);
      EXPECT_GT(most, 0.01 * within);  // no closer than asked for
    }
  }
  // A circle: at every time a quarter of a turn from its radius.
  const auto circle = [](double t) { return Vector3d(std::cos(t), std::sin(t), 0); };
  std::vector<double> times;
  std::vector<Vector3d> points, velocities;
  for (int k = 0; k <= 60; ++k) {
    times.push_back(0.1 * k);
    points.push_back(circle(times.back()));
    velocities.push_back(Vector3d::UnitZ().cross(points.back()));
  }
  const FittedTrack round =
      fitted_track(ball(1), turned_along({piecewise_through(times, points, velocities), {}}));
  for (double t = 0; t <= 6; t += 0.01)
    EXPECT_LT((round.track.motion(t).rotation.col(1) + circle(t)).norm(), 2e-4);
  // Standing, climbing straight up, or round a corner there is none.
  expect_refused([&] { (void)turned_along({piecewise_of_powers({0, 1}, {{{1, 0, 0}}}), {}}); }, "position");
  expect_refused(
      [&] {
        (void)turned_along({piecewise_through({0, 1}, {{0, 0, 0}, {0, 0, 1}}), {}});
      },
      "position");
  expect_refused(
      [&] {
        (void)turned_along({piecewise_through({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), {}});
      },
      "position");
  expect_refused(
      [&] {
        (void)turned_along({piecewise_of_powers({-1, 1}, {{{1, 0, 0}, {-2, 0, 0}, {1, 0, 0}}}), {}});
      },
      "position");  // reverses where it stands
  expect_refused(
      [&] {
        (void)turned_along({piecewise_through({0, 1}, {{0, 0, 0}, {1, 0, 0}}), {}}, 0);
      },
      "within");
}

TEST(Trajectory, BadInput) {
  const Vector3d o(0, 0, 0), bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  expect_refused([&] { (void)piecewise_through({0, 0}, {o, o}); }, "times[1]");
  expect_refused([&] { (void)piecewise_through({0, 1}, {o, bad}); }, "points[1]");
  expect_refused([&] { (void)piecewise_through({0, 1}, {o}); }, "points");
  expect_refused([&] { (void)piecewise_through({0, 1}, {o, o}, {o}); }, "velocities");
  expect_refused([&] { (void)piecewise_of_spline(0, {0, 1}, {o}); }, "degree");
  expect_refused([&] { (void)piecewise_of_spline(1, {0, 1}, {o, o}); }, "knots");
  expect_refused([&] { (void)piecewise_of_spline(1, {0, 1, 0, 2}, {o, o}); }, "knots[2]");
  expect_refused([&] { (void)piecewise_of_spline(3, {0, 1}, {o, o}); }, "points");
  expect_refused([&] { (void)piecewise_of_powers({0, 1}, {std::vector<Vector3d>(11, o)}); }, "powers[0]");
  expect_refused([&] { (void)piecewise_of_powers({0, 1}, {}); }, "powers");
  const Piecewise way = piecewise_through({0, 1, 2}, {o, o, o});
  Piecewise torn = way;
  torn.points[1][0] = {0, 0, 0.1};
  expect_refused([&] { (void)fitted_track(ball(1), {torn, {}}); }, "position[1]");
  expect_refused([&] { (void)fitted_track(ball(1), {way, piecewise_through({0, 1}, {o, o})}); }, "turned");
  expect_refused([&] { (void)fitted_track(ball(1), {Piecewise{}, {}}); }, "position");
  expect_refused([&] { (void)turned_through({way, {}}, {0, 1}, {Matrix3d::Identity()}); }, "rotations");
  const Matrix3d half = Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
  expect_refused(
      [&] {
        (void)turned_through({way, {}}, {0, 1}, {Matrix3d::Identity(), half});
      },
      "rotations[1]");
  expect_refused([&] { (void)greatest(way, 0); }, "derivative");
  expect_refused([&] { (void)greatest({{0, 1}, {{}}, 0}, 1); }, "points[0]");
  expect_refused([&] { (void)greatest({{0, 1}, {{bad}}, 0}, 1); }, "points[0]");
  expect_refused([&] { (void)greatest({{0, 1}, {{o}}, -1}, 1); }, "points");
  expect_refused([&] { (void)way.at(3); }, "t");
  expect_refused([&] { (void)way.at(1, 10); }, "derivative");
  expect_refused([&] { (void)Piecewise{}.at(0); }, "times");
  EXPECT_TRUE(std::isnan(Piecewise{}.from()));
  TrackedBody body;
  body.shape = ball(1);
  expect_refused([&] { (void)certify({body}); }, "from");
  expect_refused([&] { (void)certify({}); }, "bodies");
  body.trajectory = Trajectory{torn, {}};
  expect_refused([&] { (void)certify({body}); }, "bodies[0].trajectory.position[1]");
  body.trajectory = Trajectory{way, {}};
  body.radius = -1;
  expect_refused([&] { (void)certify({body}); }, "bodies[0].radius");
  CertifyOptions options;
  options.to = -1;
  body.radius = 0;
  expect_refused([&] { (void)certify({body}, options); }, "to");
  TrackedBody planar = body;
  planar.shape = RigidShape{CombinedEllipse(Ellipse::from_axes({0, 0}, {1, 1}))};
  expect_refused([&] { (void)certify({body, planar}); }, "bodies[1].shape");
  planar.trajectory->position.points[0][1] = {0, 0, 1};
  planar.trajectory->position.points[1][0] = {0, 0, 1};
  expect_refused([&] { (void)certify({planar}); }, "bodies[0].trajectory.position");
}

}  // namespace
}  // namespace vericone::simulation::trajectory_test
