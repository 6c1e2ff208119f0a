// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that spin, accelerate and brake: against closed forms, against sweeps that place the bodies by code
// of their own and ask a Pair at many instants, against Pair where all is straight, and laws.
#include <gtest/gtest.h>
#include <vericone/cones/motion.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace vericone::motion_test {
namespace {

using Eigen::Vector3d;
using testing::RandomBodies;

constexpr double kEver = std::numeric_limits<double>::infinity();

bool long_campaign() { return std::getenv("VERICONE_CAMPAIGN") != nullptr; }

Placed at(Body body, const Vector3d& position) { return {std::move(body), Pose{position}}; }

Body ball(double radius) { return Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(radius)); }

/// The bracket holds the time, and is narrow.
void expect_contact(const MotionAnswer& answer, double time, double width = 1e-9) {
  ASSERT_EQ(answer.verdict, Verdict::in);
  // Closed forms are rounded as well.
  EXPECT_LE(answer.earliest, time * (1 + 1e-14));
  EXPECT_GE(answer.latest, time * (1 - 1e-14));
  EXPECT_LE(answer.latest - answer.earliest, width * time);
}

/// The first root after 0 of |c + v t + a t^2 / 2| = r, by the eigenvalues of the companion matrix.
std::optional<double> quartic_contact(const Vector3d& c, const Vector3d& v, const Vector3d& a, double r) {
  const double lead = 0.25 * a.squaredNorm();
  const double coefficients[] = {c.squaredNorm() - r * r, 2 * c.dot(v), v.squaredNorm() + c.dot(a), v.dot(a)};
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) {
    companion(i, 3) = -coefficients[i] / lead;
    if (i < 3) companion(i + 1, i) = 1;
  }
  std::optional<double> first;
  for (const auto& root : companion.eigenvalues()) {
    if (std::abs(root.imag()) > 1e-7 * (1 + std::abs(root)) || root.real() < 0) continue;
    if (!first || root.real() < *first) first = root.real();
  }
  return first;
}

TEST(Motion, AcceleratingBallsMeetAtTheRootsOfTheirQuartic) {
  RandomBodies random(20);
  SCOPED_TRACE(random.trace());
  int met = 0, missed = 0;
  for (int i = 0; i < 200; ++i) {
    const double r_a = random.uniform(0.5, 2), r_b = random.uniform(0.5, 2);
    const Vector3d c = random.uniform(6, 20) * random.direction();
    const Vector3d v_a = random.in_box(1), a_a = 0.4 * random.in_box(1);
    const Vector3d v_b = random.in_box(1) - 0.3 * c, a_b = 0.4 * random.in_box(1);
    const auto answer =
        motion_answer(at(ball(r_a), {1, 2, 3}), {v_a, a_a}, at(ball(r_b), Vector3d(1, 2, 3) + c), {v_b, a_b});
    const auto root = quartic_contact(c, v_b - v_a, a_b - a_a, r_a + r_b);
    ASSERT_NE(answer.verdict, Verdict::undecided);
    ASSERT_EQ(answer.verdict == Verdict::in, root.has_value());
    if (root) {
      ++met;
      EXPECT_NEAR(answer.time, *root, 1e-8 * (1 + *root));
      EXPECT_LE(answer.latest - answer.earliest, 1e-9 * (1 + *root));
      continue;
    }
    ++missed;
    double least = kEver;
    for (double t = 0; t < 40; t += 1e-3)
      least = std::min(least, (c + t * (v_b - v_a) + 0.5 * t * t * (a_b - a_a)).norm() - r_a - r_b);
    EXPECT_LE(answer.least, least);
    EXPECT_GE(answer.most, least - 1e-4);
    EXPECT_GE(answer.least, 0.98 * least);
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(missed, 30);
}

// A needle of half-length 2 turns about z; a ball of radius r beside it at the distance h < 2 is touched
// when h cos(angle) = r, whatever the kind that stands for the needle.
TEST(Motion, ASpinningNeedleMeetsABallAtTheAngleThatTheTriangleSays) {
  const std::vector<Body> needles{Convex::segment({-2, 0, 0}, {2, 0, 0}), HullBody({{-2, 0, 0}, {2, 0, 0}}),
                                  Assembly::mesh({{-2, 0, 0}, {2, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}),
                                  Assembly::convexes({Convex::segment({-2, 0, 0}, {2, 0, 0})})};
  for (const Body& needle : needles)
    for (const double spin : {0.3, -0.3, 20.0}) {
      const double r = 0.25, h = 1.5, time = std::acos(r / h) / std::abs(spin);
      const BodyMotion turning{Vector3d::Zero(), Vector3d::Zero(), {0, 0, spin}};
      const Horizon horizon{0, 30};
      expect_contact(motion_answer(at(needle, {5, 5, 5}), turning, at(ball(r), {5, 5 + h, 5}), {}, horizon),
                     time);
      // Carried along, both of them, by a motion that the two have in common.
      BodyMotion carried = turning, also;
      carried.velocity = also.velocity = Vector3d(3, -1, 2);
      carried.acceleration = also.acceleration = Vector3d(0.5, 1, -2);
      expect_contact(motion_answer(at(needle, {5, 5, 5}), carried, at(ball(r), {5, 5 + h, 5}), also, horizon),
                     time);
      // Too far away for ever: the tip passes at h - 2 - r.
      const auto out = motion_answer(at(needle, {5, 5, 5}), turning, at(ball(r), {5, 8, 5}), {}, horizon);
      ASSERT_EQ(out.verdict, Verdict::out);
      EXPECT_LE(out.least, 0.75);
      EXPECT_GE(out.least, 0.75 * 0.99);
      EXPECT_GE(out.most, 0.75 - 1e-12);
    }
}

// The corner (a, b) of a box is at a cos - b sin, b cos + a sin.
TEST(Motion, ACornerOfASpinningBoxMeetsAWall) {
  const double a = 2, b = 1, spin = 0.7, distance = 2.1;
  const double reach = std::hypot(a, b), corner = std::atan2(b, a);
  const double time = (corner - std::acos(distance / reach)) / spin;  // the corner (2, -1) rises
  const Placed box = at(Convex::box({a, b, 3}), {0, 0, 0}),
               wall = at(Convex::box({0.5, 50, 50}), {distance + 0.5, 0, 0});
  expect_contact(motion_answer(box, {Vector3d::Zero(), Vector3d::Zero(), {0, 0, spin}}, wall, {}, {0, 10}),
                 time);
  // Seen from the box the wall goes around it.
  BodyMotion around{Vector3d::Zero(), Vector3d::Zero(), {0, 0, -spin}};
  around.center = Vector3d::Zero();
  expect_contact(motion_answer(box, {}, wall, around, {0, 10}), time);
}

TEST(Motion, ABodyThatBrakesStandsAndDoesNotTurnBack) {
  // 30 m/s at 5 m/s^2: 90 m.
  const BodyMotion braking{{30, 0, 0}, Vector3d::Zero(), Vector3d::Zero(), 5};
  const Placed car = at(Convex::box({2, 1, 1}), {0, 0, 0});
  const auto wall = [](double gap) { return at(Convex::box({1, 5, 5}), {gap + 3, 0, 0}); };
  const auto stands = motion_answer(car, braking, wall(90.5), {});
  ASSERT_EQ(stands.verdict, Verdict::out);
  EXPECT_EQ(stands.latest, kEver);
  EXPECT_LE(stands.least, 0.5);
  EXPECT_GE(stands.least, 0.495);
  EXPECT_NEAR(stands.time, 6, 1e-6);
  expect_contact(motion_answer(car, braking, wall(80), {}), 6 - 2);
  // Not from behind either, as an acceleration would have it come back.
  const Placed behind = at(Convex::box({1, 1, 1}), {-4, 0, 0});
  EXPECT_EQ(motion_answer(car, braking, behind, {}).verdict, Verdict::out);
  EXPECT_EQ(motion_answer(car, {{30, 0, 0}, {-5, 0, 0}}, behind, {}).verdict, Verdict::in);
  // One brakes behind another that brakes harder.
  const BodyMotion harder{{30, 0, 0}, Vector3d::Zero(), Vector3d::Zero(), 10};
  const Placed ahead = at(Convex::box({2, 1, 1}), {4 + 44.9, 0, 0}),
               far = at(Convex::box({2, 1, 1}), {4 + 45.1, 0, 0});
  EXPECT_EQ(motion_answer(car, braking, ahead, harder).verdict, Verdict::in);
  EXPECT_EQ(motion_answer(car, braking, far, harder).verdict, Verdict::out);
}

TEST(Motion, ABodyBrakesAsHardOrAsGentlyAsNumbersGo) {
  const Placed car = at(Convex::box({2, 1, 1}), {0, 0, 0}), wall = at(Convex::box({1, 5, 5}), {13, 0, 0});
  const auto answer = [&](double braking, const Horizon& horizon) {
    return motion_answer(car, {{30, 0, 0}, Vector3d::Zero(), Vector3d::Zero(), braking}, wall, {}, horizon);
  };
  for (const double hard : {1e150, 1e300}) {
    const auto stands = answer(hard, {});  // at once
    ASSERT_EQ(stands.verdict, Verdict::out) << hard;
    EXPECT_NEAR(stands.most, 10, 1e-9);
    EXPECT_LE(stands.least, 10);
  }
  expect_contact(answer(1e-300, {0, 20}), 10.0 / 30);
  EXPECT_EQ(answer(1e-300, {0, 0.3}).verdict, Verdict::out);
}

TEST(Motion, RoundBodiesDoNotTurnAboutTheirAxis) {
  const Placed rotor = at(Convex::cylinder(3, 0.5), {0, 0, 1}),
               disc = at(Convex::cylinder(2, 1), {5.25, 0, 1});
  const BodyMotion fast{Vector3d::Zero(), Vector3d::Zero(), {0, 0, 400}};
  const auto answer = motion_answer(rotor, fast, disc, fast, {0, 1000});
  EXPECT_EQ(answer.verdict, Verdict::out);
  EXPECT_NEAR(answer.least, 0.25, 0.0026);
  EXPECT_LT(answer.steps, 20U);
  // About another axis they do.
  EXPECT_EQ(motion_answer(rotor, {Vector3d::Zero(), Vector3d::Zero(), {0, 1, 0}}, at(ball(0.1), {2, 0, 1.5}),
                          {}, {0, 10})
                .verdict,
            Verdict::in);
}

// Sweeps: the bodies at many instants, placed by Eigen.

Placed moved(const Placed& body, const BodyMotion& motion, double t) {
  Vector3d own = Vector3d::Zero();  // in its frame
  if (const auto* quadric = body.body.quadric()) own = quadric->center();
  const Convex* convex = body.body.convex();  // an ellipsoid with a margin is one piece
  if (convex && convex->pieces().size() == 1 && convex->pieces()[0].rank == 3)
    own = convex->pieces()[0].center;
  const Vector3d center = motion.center.value_or(body.pose.to_world(own));
  const Vector3d shift = t * motion.velocity + 0.5 * t * t * motion.acceleration;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (const double rate = motion.spin.norm(); rate > 0)
    turn = Eigen::AngleAxisd(rate * t, motion.spin / rate).toRotationMatrix();
  return {body.body, {center + shift + turn * (body.pose.position - center), turn * body.pose.rotation}};
}

struct Engagement {
  Placed a{Body()}, b{Body()};
  BodyMotion motion_a, motion_b;
};

Engagement any_engagement(RandomBodies& random, BodyKind agent, BodyKind obstacle) {
  Engagement e;
  e.a = Placed(any_body(random, agent), any_pose(random, 1));
  e.b = Placed(any_body(random, obstacle), any_pose(random, random.uniform(9, 14)));
  const double time = random.uniform(2, 6);
  for (BodyMotion* motion : {&e.motion_a, &e.motion_b}) {
    if (random.coin()) motion->spin = random.uniform(0.1, 1.5) * random.direction();
    if (random.coin()) motion->acceleration = 0.3 * random.in_box(1);
    if (random.integer(0, 3) == 0) motion->center = Vector3d(random.in_box(3));
  }
  // Towards each other, about.
  const Vector3d to = e.b.middle() + random.in_box(3) - e.a.middle();
  e.motion_a.velocity = (to - 0.5 * time * time * e.motion_a.acceleration) / time;
  return e;
}

/// Nothing that was proved is contradicted.
void expect_true(const Engagement& e, const MotionAnswer& answer, const Horizon& horizon, int instants) {
  const auto relation = [&](double t) {
    return Pair(moved(e.a, e.motion_a, t), moved(e.b, e.motion_b, t)).relation();
  };
  const double apart_until = std::min(answer.earliest, horizon.until);
  for (int i = 0; i <= instants; ++i) {
    const double t = horizon.from + (apart_until - horizon.from) * i / instants;
    // At the very end of the bracket roundings of the test's own decide.
    if (answer.verdict == Verdict::in && t > answer.earliest * (1 - 1e-9)) continue;
    const Pair pair(moved(e.a, e.motion_a, t), moved(e.b, e.motion_b, t));
    const auto found = pair.relation();
    ASSERT_TRUE(!found || *found == Relation::disjoint) << t;
    if (answer.verdict == Verdict::out) {
      ASSERT_LE(answer.least, pair.miss(Vector3d::Zero(), Vector3d::Zero()).most * (1 + 1e-9)) << t;
    }
  }
  if (answer.verdict == Verdict::in) {
    const auto met = relation(answer.latest);
    ASSERT_TRUE(!met || *met != Relation::disjoint) << answer.latest;
    EXPECT_LE(answer.earliest, answer.latest);
  }
}

TEST(Motion, SweepsOfEveryTwoKindsContradictNothing) {
  RandomBodies random(21);
  SCOPED_TRACE(random.trace());
  int met = 0, missed = 0, undecided = 0, delimited_undecided = 0;
  std::size_t steps = 0;
  const int rounds = long_campaign() ? 10 : 1;
  for (int round = 0; round < rounds; ++round)
    for (const BodyKind agent : kBodyKinds)
      for (const BodyKind obstacle : kBodyKinds) {
        SCOPED_TRACE(std::string(to_string(agent)) + " " + to_string(obstacle));
        const Engagement e = any_engagement(random, agent, obstacle);
        const Horizon horizon{0, 12};
        const auto answer = motion_answer(e.a, e.motion_a, e.b, e.motion_b, horizon);
        expect_true(e, answer, horizon, 60);
        (answer.verdict == Verdict::in ? met : answer.verdict == Verdict::out ? missed : undecided) += 1;
        const bool delimited = agent == BodyKind::combined || obstacle == BodyKind::combined ||
                               agent == BodyKind::pieces || obstacle == BodyKind::pieces;
        if (answer.verdict == Verdict::undecided && delimited) ++delimited_undecided;
        steps += answer.steps;
        if (answer.verdict == Verdict::in) {
          EXPECT_LT(answer.latest - answer.earliest, delimited ? 1e-2 : 1e-6);
        }
      }
  if (std::getenv("VERICONE_TELL"))
    std::printf("met %d missed %d undecided %d (%d delimited), %zu steps\n", met, missed, undecided,
                delimited_undecided, steps);
  EXPECT_EQ(undecided, 0);
  EXPECT_GT(met, 10 * rounds);
  EXPECT_GT(missed, 10 * rounds);
}

TEST(Motion, StraightMotionIsWhatPairSays) {
  RandomBodies random(22);
  SCOPED_TRACE(random.trace());
  int met = 0;
  for (int round = 0; round < (long_campaign() ? 4 : 1); ++round)
    for (const BodyKind agent : kBodyKinds)
      for (const BodyKind obstacle : kBodyKinds) {
        SCOPED_TRACE(std::string(to_string(agent)) + " " + to_string(obstacle));
        Engagement e = any_engagement(random, agent, obstacle);
        e.motion_a.acceleration = e.motion_a.spin = e.motion_b.acceleration = e.motion_b.spin =
            Vector3d::Zero();
        const Pair pair(e.a, e.b);
        const Vector3d &v_a = e.motion_a.velocity, &v_b = e.motion_b.velocity;
        const auto answer = motion_answer(e.a, e.motion_a, e.b, e.motion_b);
        const Verdict verdict = pair.verdict(v_a, v_b);
        if (verdict == Verdict::undecided || answer.verdict == Verdict::undecided) continue;
        ASSERT_EQ(answer.verdict, verdict);
        if (verdict == Verdict::in) {
          ++met;
          const Contact contact = *pair.contact(v_a, v_b);
          EXPECT_LE(answer.earliest, contact.latest * (1 + 1e-12));
          EXPECT_GE(answer.latest, contact.earliest * (1 - 1e-12));
        } else {
          const Miss miss = pair.miss(v_a, v_b);
          EXPECT_LE(answer.least, miss.most * (1 + 1e-12));
          EXPECT_GE(answer.most, miss.least * (1 - 1e-12));
        }
      }
  EXPECT_GT(met, 10);
}

bool same(const MotionAnswer& x, const MotionAnswer& y) {
  return x.verdict == y.verdict && x.earliest == y.earliest && x.latest == y.latest;
}

TEST(Motion, TheSameSeenFromTheOtherBody) {
  RandomBodies random(23);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 16; ++i) {
    const BodyKind one = kBodyKinds[static_cast<std::size_t>(i) % 8],
                   other = kBodyKinds[static_cast<std::size_t>(i * 3 + 1) % 8];
    const Engagement e = any_engagement(random, one, other);
    const auto x = motion_answer(e.a, e.motion_a, e.b, e.motion_b, {0, 12}),
               y = motion_answer(e.b, e.motion_b, e.a, e.motion_a, {0, 12});
    EXPECT_EQ(x.verdict, y.verdict);
    // Both brackets hold the same time; both bounds the same distance.
    EXPECT_LE(x.earliest, y.latest);
    EXPECT_LE(y.earliest, x.latest);
    EXPECT_LE(x.least, y.most);
    EXPECT_LE(y.least, x.most);
  }
}

TEST(Motion, LengthsAndTimesScaleExactly) {
  RandomBodies random(24);
  SCOPED_TRACE(random.trace());
  int met = 0;
  for (int i = 0; i < 12; ++i) {
    const Ellipsoid a = random.ellipsoid(Vector3d::Zero(), 0.5, 3),
                    b = random.ellipsoid(Vector3d::Zero(), 0.5, 3);
    Engagement e = any_engagement(random, BodyKind::ellipsoid, BodyKind::ellipsoid);
    const auto answer = [&](double length, double time) {
      const auto placed = [&](const Ellipsoid& body, const Pose& pose) {
        return Placed(body.scaled(length), {length * pose.position, pose.rotation});
      };
      const auto motion = [&](BodyMotion m) {
        m.velocity *= length / time;
        m.acceleration *= length / time / time;
        m.spin /= time;
        if (m.center) *m.center *= length;
        return m;
      };
      return motion_answer(placed(a, e.a.pose), motion(e.motion_a), placed(b, e.b.pose), motion(e.motion_b),
                           {0, 12 * time});
    };
    const auto plain = answer(1, 1);
    if (plain.verdict == Verdict::in) ++met;
    for (const double length : {0x1p-20, 0x1p+20}) EXPECT_TRUE(same(plain, answer(length, 1)));
    const auto later = answer(1, 8);
    EXPECT_EQ(plain.verdict, later.verdict);
    if (plain.verdict == Verdict::in) {
      EXPECT_EQ(8 * plain.earliest, later.earliest);
      EXPECT_EQ(8 * plain.latest, later.latest);
    }
    EXPECT_EQ(plain.least, later.least);
  }
  EXPECT_GT(met, 2);
}

TEST(Motion, BodiesThatTouchOrOverlapAtOnceDoSo) {
  const BodyMotion turning{Vector3d::Zero(), {1, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(motion_answer(at(ball(1), {0, 0, 0}), turning, at(ball(1), {2, 0, 0}), {}, {0, 1}).verdict,
            Verdict::touching);
  EXPECT_EQ(motion_answer(at(ball(1), {0, 0, 0}), turning, at(ball(1), {1, 0, 0}), {}, {0, 1}).verdict,
            Verdict::overlapping);
  // At an instant, and of bodies that stay as they are.
  EXPECT_EQ(motion_answer(at(ball(1), {0, 0, 0}), turning, at(ball(1), {2.5, 0, 0}), {}, {0, 0}).verdict,
            Verdict::out);
  const auto still = motion_answer(at(ball(1), {0, 0, 0}), {}, at(ball(1), {2.5, 0, 0}), {});
  EXPECT_EQ(still.verdict, Verdict::out);
  EXPECT_NEAR(still.least, 0.5, 1e-12);
  EXPECT_LE(still.least, 0.5);
  // Later than the contact the horizon begins in it, or after it.
  const BodyMotion there{{1, 0, 0}, {0, 0, 0.001}};
  const Placed a = at(ball(1), {0, 0, 0}), b = at(ball(1), {10, 0, 0});
  EXPECT_EQ(motion_answer(a, there, b, {}, {10, 12}).verdict, Verdict::overlapping);
  EXPECT_EQ(motion_answer(a, there, b, {}, {13, 20}).verdict, Verdict::out);
  EXPECT_EQ(motion_answer(a, there, b, {}, {0, 7}).verdict, Verdict::out);
}

// They touch in one point at one instant: nothing can be proved there, and nothing wrong is said.
TEST(Motion, AGrazeIsUndecidedAndSaysWhere) {
  const BodyMotion thrown{{1, 2, 0}, {0, -1, 0}};  // the ball's top is at t = 2
  const auto answer = motion_answer(at(ball(1), {0, 0, 0}), thrown, at(ball(1), {2, 4, 0}), {});
  ASSERT_EQ(answer.verdict, Verdict::undecided);
  EXPECT_LT(answer.earliest, 2);
  EXPECT_GT(answer.latest, 2);
  EXPECT_NEAR(answer.earliest, 2, 1e-5);
  ASSERT_TRUE(answer.point);
  EXPECT_NEAR((*answer.point - Vector3d(2, 3, 0)).norm(), 0, 1e-5);
  EXPECT_NEAR((*answer.normal - Vector3d(0, 1, 0)).norm(), 0, 1e-5);
  // A little to either side it is decided.
  const auto beside = [&](double y) {
    return motion_answer(at(ball(1), {0, 0, 0}), thrown, at(ball(1), {2, y, 0}), {}).verdict;
  };
  EXPECT_EQ(beside(4 + 1e-9), Verdict::out);
  EXPECT_EQ(beside(4 - 1e-9), Verdict::in);
}

std::string refused(const BodyMotion& motion, const Horizon& horizon = {0, 1}) {
  try {
    (void)motion_answer(at(ball(1), {0, 0, 0}), motion, at(ball(1), {5, 0, 0}), {}, horizon);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Motion, BadInputIsNamed) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Vector3d zero = Vector3d::Zero();
  EXPECT_EQ(refused({zero, zero, {0, kNone, 0}}), "agent.spin[1]: got nan, must be a finite number (rad/s)");
  EXPECT_EQ(refused({zero, {kEver, 0, 0}}),
            "agent.acceleration[0]: got inf, must be a finite number (m/s^2)");
  EXPECT_EQ(refused({{0, 0, kNone}}), "agent.velocity[2]: got nan, must be a finite number (m/s)");
  EXPECT_EQ(refused({zero, zero, zero, -1}), "agent.braking: got -1, must be not negative (m/s^2)");
  EXPECT_EQ(refused({{1, 0, 0}, zero, zero, 1e301}),
            "agent.braking: got 1e+301, must be at most 1e300 (m/s^2)");
  EXPECT_EQ(refused({{1, 0, 0}, zero, zero, 1e-300}, {}),
            "agent.braking: got 1e-300, must be 0, or enough to stand within 1e150 m (m/s^2); or within a "
            "horizon, [from, until]");
  EXPECT_EQ(refused({{1, 0, 0}, {1, 0, 0}, zero, 1}),
            "agent.braking: got 1, must be left out beside an acceleration");
  EXPECT_EQ(refused({zero, zero, zero, 0, Vector3d(0, 0, kNone)}),
            "agent.center[2]: got nan, must be a finite number (m)");
  EXPECT_EQ(refused({}, {2, 1}), "horizon: got [2, 1], must be two times, 0 <= from <= until (s)");
  BodyMotion turning{zero, zero, {0, 1, 0}};
  turning.center = Vector3d(1, 0, 0);
  EXPECT_EQ(refused(turning, {}),
            "horizon: got no end, must be one with an end: these bodies turn beside each other for ever");
}

}  // namespace
}  // namespace vericone::motion_test
