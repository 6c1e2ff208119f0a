// SPDX-License-Identifier: BSD-3-Clause
//
// Robust verdicts against the exact predicates at errors drawn from their sets, against closed forms, and
// against mistakes planted into the condition.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/uncertain/robust.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/uncertain/turned.h>
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>

#include "cones/uncertain/robust_engagements.h"
#include "support/allocations.h"
#include "support/campaign.h"

namespace vericone::robust_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::RobustDice, testing::RobustEngagement, testing::collides;

constexpr double kForEver = std::numeric_limits<double>::infinity();

RobustAnswer verdict(const RobustEngagement& e) { return robust_verdict(e.a, e.b, e.v_a, e.v_b, e.errors); }

/// The left side of the condition less the right, with signs and a horizon of one's choice.
double margin(const RobustEngagement& e, const Vector3d& n, double sign_p = -1, double sign_w = 1,
              bool bounded = true) {
  const Vector3d c = e.b.center() - e.a.center(), w = e.v_a - e.v_b;
  const double gap = n.dot(c) - e.a.radius(n) - e.b.radius(n) + sign_p * e.errors.position.support(n);
  const double closing = n.dot(w) + sign_w * e.errors.velocity.support(n);
  if (bounded && std::isfinite(e.errors.horizon)) return gap - std::max(0.0, e.errors.horizon * closing);
  return closing <= 1e-9 ? gap : -1;
}

struct Counts {
  int in = 0, out = 0, depends = 0, undecided = 0;
};

TEST(RobustCone, NoSampledErrorContradictsAVerdict) {
  RobustDice dice(1);
  const int engagements = testing::campaign_size(3'000, 100'000);
  const int draws = testing::campaign_size(20, 1'000);
  Counts counts;
  for (int i = 0; i < engagements; ++i) {
    const RobustEngagement e = dice.engagement(i);
    const RobustAnswer answer = verdict(e);
    switch (answer.verdict) {
      case RobustVerdict::in:
        ++counts.in;
        break;
      case RobustVerdict::out:
        ++counts.out;
        break;
      case RobustVerdict::depends:
        ++counts.depends;
        break;
      case RobustVerdict::undecided:
        ++counts.undecided;
        continue;
    }
    if (answer.verdict == RobustVerdict::depends) {
      ASSERT_EQ(collides(e, answer.collides).value_or(true), true) << i;
      ASSERT_EQ(collides(e, answer.passes).value_or(false), false) << i;
      continue;
    }
    const bool all = answer.verdict == RobustVerdict::in;
    if (!all) {
      ASSERT_GE(margin(e, answer.normal), 0) << i;
    }
    for (int j = 0; j < draws; ++j) {
      const RelativeError error{dice.error(e.errors.position), dice.error(e.errors.velocity)};
      ASSERT_EQ(collides(e, error).value_or(all), all) << i << " " << j;
    }
  }
  RecordProperty("in", counts.in);
  RecordProperty("out", counts.out);
  RecordProperty("depends", counts.depends);
  RecordProperty("undecided", counts.undecided);
  std::printf("%d in, %d out, %d depends, %d undecided\n", counts.in, counts.out, counts.depends,
              counts.undecided);
  EXPECT_LT(counts.undecided, 1e-3 * engagements);
  // None is so rare that nothing was tested.
  EXPECT_GT(std::min({counts.in, counts.out, counts.depends}), engagements / 10);
}

/// Errors that are as bad as can be: those that the normals of other verdicts point to. `out` and `in` are
/// tight: with sets slightly larger an error of the other kind is found.
TEST(RobustCone, VerdictsTurnWhereTheSetsReachTheGraze) {
  RobustDice dice(2);
  const int engagements = testing::campaign_size(200, 5'000);
  int turned = 0;
  for (int i = 0; i < engagements; ++i) {
    RobustEngagement e = dice.engagement(1);
    const Vector3d axes = dice.axes(0.1, 1), fast = dice.axes(0.1, 1);
    const Matrix3d turn = dice.rotation(), turn_fast = dice.rotation();
    const double speed = (e.v_a - e.v_b).norm();
    const auto at = [&](double size) {
      e.errors.position = ErrorSet::ellipsoid(size * axes, turn);
      e.errors.velocity = ErrorSet::ellipsoid(0.02 * size * speed * fast, turn_fast);
      return verdict(e).verdict;
    };
    double low = 1e-3, high = 20;
    const RobustVerdict first = at(low);
    if (first == RobustVerdict::depends || first == RobustVerdict::undecided ||
        at(high) != RobustVerdict::depends)
      continue;
    while (high - low > 1e-8) {
      const double middle = 0.5 * (low + high);
      (at(middle) == first ? low : high) = middle;
    }
    // Between the two at most a sliver of a micrometre is not decided, of bodies of 0.3 to 3 m.
    EXPECT_EQ(at(high + 1e-6), RobustVerdict::depends) << i;
    ++turned;
  }
  EXPECT_GT(turned, engagements / 2);
}

/// Two balls, errors in balls, no horizon: the shadow of the sum, and the cone of velocities about w.
TEST(RobustCone, BallsHaveTheClosedForm) {
  RobustDice dice(3);
  for (int i = 0; i < 2'000; ++i) {
    RobustEngagement e;
    const double radii = 2, rho = dice.between(0, 1.5), speed = 10, sigma = dice.between(0, 3);
    const double distance = dice.between(4, 30), aside = dice.between(0, 0.6);
    e.a = Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Constant(0.5 * radii));
    const Matrix3d turn = dice.rotation();
    e.b = Ellipsoid::from_axes(distance * turn.col(0), Vector3d::Constant(0.5 * radii));
    e.v_a = speed * (std::cos(aside) * turn.col(0) + std::sin(aside) * turn.col(1));
    e.v_b = Vector3d::Zero();
    e.errors.position = ErrorSet::ball(rho);
    e.errors.velocity = ErrorSet::ball(sigma);
    // Angles of the line of sight: of the bodies seen, larger or smaller by the error, and of the velocities.
    const double spread = std::asin(sigma / speed);
    const double wide = std::asin((radii + rho) / distance), narrow = std::asin((radii - rho) / distance);
    const RobustVerdict truth = aside > wide + spread     ? RobustVerdict::out
                                : aside < narrow - spread ? RobustVerdict::in
                                                          : RobustVerdict::depends;
    if (std::min(std::abs(aside - wide - spread), std::abs(aside - narrow + spread)) < 1e-6) continue;
    EXPECT_EQ(verdict(e).verdict, truth)
        << i << " " << aside << " " << wide << " " << narrow << " " << spread;
  }
}

TEST(RobustCone, WithoutErrorsItIsTheVerdictOfTheBodies) {
  RobustDice dice(4);
  for (int i = 0; i < 2'000; ++i) {
    RobustEngagement e = dice.engagement(i);
    e.errors.position = e.errors.velocity = {};
    const std::optional<bool> truth = collides(e, {});
    if (!truth) continue;
    EXPECT_EQ(verdict(e).verdict, *truth ? RobustVerdict::in : RobustVerdict::out) << i;
  }
}

/// Mistakes of the kind that are easily made give a normal, or deny one, where the exact predicates say
/// otherwise: the draws of the first test would show each of them.
TEST(RobustCone, PlantedMistakesAreContradictedByTheExactPredicates) {
  RobustDice dice(5);
  int wrong_p = 0, wrong_w = 0, no_horizon = 0;
  for (int i = 0; i < 400; ++i) {
    const RobustEngagement e = dice.engagement(i);
    // A normal that each mistaken condition accepts although the right one does not, and an error there.
    for (int j = 0; j < 60; ++j) {
      const Vector3d n = dice.direction();
      const RelativeError worst{-(1 - 1e-9) * e.errors.position.support_point(n),
                                (1 - 1e-9) * e.errors.velocity.support_point(n)};
      const bool hit = collides(e, worst).value_or(false);
      wrong_p += margin(e, n, 1) > 0 && hit;
      wrong_w += margin(e, n, -1, -1) > 0 && hit;
    }
    // T ignored: none is out within a horizon that is not out for ever.
    RobustEngagement for_ever = e;
    for_ever.errors.horizon = kForEver;
    no_horizon += verdict(e).verdict == RobustVerdict::out && verdict(for_ever).verdict != RobustVerdict::out;
  }
  EXPECT_GT(wrong_p, 20);
  EXPECT_GT(wrong_w, 20);
  EXPECT_GT(no_horizon, 20);
}

/// Bodies widened by rho + sigma t, t the time of the nearest passage, are a usual shortcut.
TEST(RobustCone, InflationByTheTimeOfPassageIsNoProof) {
  RobustDice dice(6);
  const int engagements = testing::campaign_size(3'000, 100'000);
  int says_out = 0, wrong = 0;
  for (int i = 0; i < engagements; ++i) {
    RobustEngagement e = dice.engagement(0);
    e.errors.horizon = kForEver;
    const Vector3d w = e.v_a - e.v_b;
    const Clearance c = clearance(e.a, e.b, w);
    if (!(c.time > 0 && c.distance > e.errors.position.radius() + e.errors.velocity.radius() * c.time))
      continue;
    ++says_out;
    const RobustAnswer answer = verdict(e);
    if (answer.verdict != RobustVerdict::depends) continue;
    EXPECT_TRUE(collides(e, answer.collides).value_or(false)) << i;
    ++wrong;
  }
  std::printf("inflation says out %d times, wrongly %d times\n", says_out, wrong);
  EXPECT_GT(wrong, 0);
  EXPECT_LT(wrong, says_out / 10);
}

TEST(RobustCone, TurnedBodiesStayBetweenTheirBounds) {
  RobustDice dice(7);
  for (int i = 0; i < 300; ++i) {
    const Ellipsoid body = i % 2 ? dice.body(dice.normal())
                                 : Ellipsoid::from_shape(dice.normal(), dice.body(Vector3d::Zero()).shape());
    const double angle = dice.between(0, 1.8);
    const Ellipsoid around = around_turned(body, angle), within = within_turned(body, angle);
    double nearest = kForEver;
    for (int j = 0; j < 300; ++j) {
      const Matrix3d turn =
          Eigen::AngleAxisd((j % 2 ? 1 : dice.between(0, 1)) * angle, dice.direction()).toRotationMatrix();
      const Vector3d n = dice.direction();
      const double h = body.radius(turn.transpose() * n);
      EXPECT_LE(h, around.radius(n) * (1 + 1e-14)) << angle;
      EXPECT_GE(h, within.radius(n) * (1 - 1e-14)) << angle;
      nearest = std::min(nearest, around.radius(n) - h);
    }
    EXPECT_GE(nearest, 0);
  }
  const Ellipsoid body = dice.body(Vector3d::Zero());
  EXPECT_EQ(around_turned(body, 0).factor(), body.factor());
  // To the first order the bound is reached: at 45 degrees between the longest and the shortest axis.
  const Ellipsoid long_one = Ellipsoid::from_axes(Vector3d::Zero(), {2, 1, 1});
  const Vector3d n = Vector3d(1, 1, 0).normalized();
  const Matrix3d turn = Eigen::AngleAxisd(1e-4, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR((around_turned(long_one, 1e-4).radius(n) - long_one.radius(n)) /
                  (long_one.radius(turn.transpose() * n) - long_one.radius(n)),
              1, 1e-3);
}

/// Attitudes, sizes and accelerations drawn as well.
TEST(RobustCone, InflatedErrorsAreProvedToo) {
  RobustDice dice(8);
  Counts counts;
  const int engagements = testing::campaign_size(200, 20'000);
  for (int i = 0; i < engagements; ++i) {
    RobustEngagement e = dice.engagement(i);
    const Vector3d c = e.b.center() - e.a.center(), w = e.v_a - e.v_b;
    e.errors.horizon = dice.between(0.3, 2) * c.norm() / w.norm();
    e.errors.attitude_a = dice.between(0, 0.5);
    e.errors.attitude_b = i % 3 ? dice.between(0, 0.2) : 0;
    e.errors.size = i % 2 ? dice.between(0, 0.2) : 0;
    e.errors.acceleration = dice.between(0, 0.5) / (e.errors.horizon * e.errors.horizon);
    const RobustAnswer answer = verdict(e);
    counts.in += answer.verdict == RobustVerdict::in;
    counts.out += answer.verdict == RobustVerdict::out;
    counts.depends += answer.verdict == RobustVerdict::depends;
    if (answer.verdict == RobustVerdict::depends) {
      EXPECT_TRUE(collides(e, answer.collides).value_or(true)) << i;
      EXPECT_FALSE(collides(e, answer.passes).value_or(false)) << i;
      continue;
    }
    if (answer.verdict == RobustVerdict::undecided) continue;
    for (int j = 0; j < 20; ++j) {
      const auto turned = [&](const Ellipsoid& body, double angle) {
        const Matrix3d turn = Eigen::AngleAxisd(angle, dice.direction()).toRotationMatrix();
        Matrix3d axes = turn * body.axis_directions();
        if (axes.determinant() < 0) axes.col(0) *= -1;
        return Ellipsoid::from_axes(body.center(), body.semi_axes(), axes);
      };
      const Ellipsoid a = turned(e.a, e.errors.attitude_a), b = turned(e.b, e.errors.attitude_b);
      const Vector3d p = dice.error(e.errors.position), v = dice.error(e.errors.velocity);
      const Vector3d push = 0.5 * e.errors.acceleration * dice.direction(),
                     size = e.errors.size * dice.direction();
      bool met = false;
      for (int k = 0; k <= 200 && !met; ++k) {
        const double t = e.errors.horizon * k / 200;
        const Vector3d shift = p + size - t * (w + v) + push * t * t;
        met = relation(a, b.translated(shift)) != Relation::disjoint;
      }
      // A contact shorter than a 200th of the horizon would be missed; these draws have none.
      EXPECT_EQ(met, answer.verdict == RobustVerdict::in) << i;
    }
  }
  std::printf("%d in, %d out, %d depends\n", counts.in, counts.out, counts.depends);
  EXPECT_GT(std::min({counts.in, counts.out, counts.depends}), engagements / 20);
}

TEST(RobustCone, OverlappingAndRestingBodies) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                  near = Ellipsoid::from_axes({1, 0, 0}, {1, 1, 1}),
                  far = Ellipsoid::from_axes({5, 0, 0}, {1, 1, 1});
  RelativeErrors errors;
  errors.position = ErrorSet::ball(0.5);
  const Vector3d rest = Vector3d::Zero();
  EXPECT_EQ(robust_verdict(a, near, rest, rest, errors).verdict, RobustVerdict::in);
  EXPECT_EQ(robust_verdict(a, far, rest, rest, errors).verdict, RobustVerdict::out);
  errors.position = ErrorSet::ball(4);
  EXPECT_EQ(robust_verdict(a, far, rest, rest, errors).verdict, RobustVerdict::depends);
  errors.position = {};
  errors.velocity = ErrorSet::ball(0.1);
  // Sooner or later some velocity brings them together; not within a horizon.
  EXPECT_EQ(robust_verdict(a, far, rest, rest, errors).verdict, RobustVerdict::depends);
  errors.horizon = 29;
  EXPECT_EQ(robust_verdict(a, far, rest, rest, errors).verdict, RobustVerdict::out);
  errors.horizon = 31;
  EXPECT_EQ(robust_verdict(a, far, rest, rest, errors).verdict, RobustVerdict::depends);
  // The same body twice.
  EXPECT_EQ(robust_verdict(a, a, {1, 0, 0}, rest, errors).verdict, RobustVerdict::in);
}

/// At rest, 3 m apart or 1 m into one another: each bound to a hundredth.
TEST(RobustCone, InflationIsAsLargeAsItMustBe) {
  const auto ball = [](const Vector3d& center) { return Ellipsoid::from_axes(center, Vector3d::Ones()); };
  const Ellipsoid a = ball({0, 0, 0}), far = ball({5, 0, 0}), near = ball({1, 0, 0});
  const Vector3d rest = Vector3d::Zero();
  const auto of = [&](const Ellipsoid& one, const Ellipsoid& other, auto set) {
    RelativeErrors errors;
    errors.horizon = 2;
    set(errors);
    return robust_verdict(one, other, rest, rest, errors).verdict;
  };
  for (const double more : {0.99, 1.01}) {
    const bool enough = more < 1;
    // a T^2 / 2 = 3 m.
    const auto accelerated = [&](RelativeErrors& e) { e.acceleration = 1.5 * more; };
    EXPECT_EQ(of(a, far, accelerated) == RobustVerdict::out, enough);
    EXPECT_EQ(of(a, far, [&](RelativeErrors& e) { e.size = 3 * more; }) == RobustVerdict::out, enough);
    EXPECT_EQ(of(a, near, [&](RelativeErrors& e) { e.size = more; }) == RobustVerdict::in, enough);
    // Of semi-axes 3 and 1: S + sin(t) 8 I reaches 2 m across at sin(t) = 3/8.
    const Ellipsoid long_one = Ellipsoid::from_axes({0, 0, 0}, {3, 1, 1});
    const double angle = std::asin(0.375 * more);
    const auto turned = [&](RelativeErrors& e) { e.attitude_a = angle; };
    EXPECT_EQ(of(long_one, ball({0, 3, 0}), turned) == RobustVerdict::out, enough);
    EXPECT_EQ(
        of(ball({0, 3, 0}), long_one, [&](RelativeErrors& e) { e.attitude_b = angle; }) == RobustVerdict::out,
        enough);
  }
}

TEST(RobustCone, DoesNotAllocate) {
  RobustDice dice(9);
  for (int i = 0; i < 200; ++i) {
    const RobustEngagement e = dice.engagement(i);
    const std::size_t before = testing::allocations();
    const RobustAnswer answer = verdict(e);
    EXPECT_EQ(testing::allocations(), before) << to_string(answer.verdict);
    const Vector3d w = e.v_a - e.v_b;
    const auto clear = robust_clearance(e.a, e.b, w, e.errors.position, e.errors.velocity);
    EXPECT_EQ(testing::allocations(), before) << clear.has_value();
    const Vector3d reached = e.errors.position.support_point(w);
    EXPECT_NEAR(reached.dot(w), e.errors.position.support(w), 1e-9 * w.norm() * (1 + reached.norm()));
    EXPECT_EQ(testing::allocations(), before);
  }
}

/// In rational arithmetic, of the doubles as they stand.
TEST(RobustCone, ErrorsOfDependsLieInTheirSetsExactly) {
  using Rational = boost::multiprecision::cpp_rational;
  const auto inside = [](const ErrorSet& set, const Vector3d& e) {
    const Rational x = e.x(), y = e.y(), z = e.z();
    if (set.radius() > 0) return x * x + y * y + z * z <= Rational(set.radius()) * Rational(set.radius());
    if (!set.segments().empty()) {
      bool all = true;
      for (const Vector3d& g : set.segments())
        for (int i = 0; i < 3; ++i) all = all && (g(i) == 0 || std::abs(e(i)) <= std::abs(g(i)));
      return all;
    }
    if (set.none()) return e.isZero(0);
    // |adj(F) e|^2 <= det(F)^2.
    const Matrix3d& f = set.factors().front();
    const auto minor = [&](int i, int j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      return Rational(Rational(f(r0, c0)) * f(r1, c1) - Rational(f(r0, c1)) * f(r1, c0));
    };
    Rational sum = 0, det = 0;
    for (int i = 0; i < 3; ++i) {
      const Rational u = minor(i, 0) * x + minor(i, 1) * y + minor(i, 2) * z;
      sum += u * u;
      det += Rational(f(0, i)) * minor(i, 0);
    }
    return sum <= det * det;
  };
  RobustDice dice(12);
  int looked_at = 0;
  for (int i = 0; i < 900; ++i) {
    const RobustEngagement e = dice.engagement(5 * i + i % 3);
    const RobustAnswer answer = verdict(e);
    if (answer.verdict != RobustVerdict::depends) continue;
    ++looked_at;
    for (const RelativeError& error : {answer.collides, answer.passes}) {
      EXPECT_TRUE(inside(e.errors.position, error.position)) << i;
      EXPECT_TRUE(inside(e.errors.velocity, error.velocity)) << i;
    }
    // Outside of them all is `inside` of none: the check can fail.
    if (!answer.passes.position.isZero(0)) {
      EXPECT_FALSE(inside(e.errors.position, 1.001 * answer.passes.position)) << i;
    }
  }
  EXPECT_GT(looked_at, 100);
}

/// Of a hull that is nearly the ellipsoid the verdicts are the ellipsoid's; bodies that are not convex are
/// never called `in`.
TEST(RobustCone, OtherBodiesAgreeWithTheirPairs) {
  RobustDice dice(13);
  Counts hulls, shells, dents;
  const auto count = [](Counts& counts, RobustVerdict verdict) {
    counts.in += verdict == RobustVerdict::in;
    counts.out += verdict == RobustVerdict::out;
    counts.depends += verdict == RobustVerdict::depends;
    counts.undecided += verdict == RobustVerdict::undecided;
  };
  for (int i = 0; i < testing::campaign_size(100, 1'000); ++i) {
    const RobustEngagement e = dice.engagement(i);
    std::vector<Vector3d> points;
    for (int j = 0; j < 40; ++j) points.push_back(e.b.support_point(dice.direction()));
    std::vector<Assembly::Triangle> triangles;
    for (std::uint32_t j = 0; j + 2 < points.size(); ++j) triangles.push_back({j, j + 1, j + 2});
    const double size = e.b.semi_axes()(2);
    const CombinedEllipsoid dented(e.b,
                                   {hyperboloid(2, Vector3d::Constant(0.4 * size), Matrix3d::Identity())});
    const auto check = [&](const Pair& pair, Counts& counts, bool convex) {
      const RobustAnswer answer = robust_verdict(pair, e.v_a, e.v_b, e.errors);
      count(counts, answer.verdict);
      if (!convex) {
        EXPECT_NE(answer.verdict, RobustVerdict::in);
      }
      const auto of_error = [&](const RelativeError& error) -> std::optional<bool> {
        Placed moved = pair.obstacle();
        moved.pose.position += error.position;
        const Pair other(pair.agent(), moved);
        const Verdict verdict = other.verdict(e.v_a + error.velocity, e.v_b);
        if (verdict == Verdict::undecided) return std::nullopt;
        const auto contact = other.contact(e.v_a + error.velocity, e.v_b);
        return contact && contact->latest < e.errors.horizon;
      };
      if (answer.verdict == RobustVerdict::depends) {
        EXPECT_TRUE(of_error(answer.collides).value_or(true)) << i;
        EXPECT_FALSE(of_error(answer.passes).value_or(false)) << i;
      }
      if (answer.verdict == RobustVerdict::in || answer.verdict == RobustVerdict::out)
        for (int j = 0; j < 5; ++j) {
          const bool all = answer.verdict == RobustVerdict::in;
          EXPECT_EQ(of_error({dice.error(e.errors.position), dice.error(e.errors.velocity)}).value_or(all),
                    all)
              << i;
        }
    };
    check(Pair(Body(e.a), Body(HullBody(points))), hulls, true);
    check(Pair(Body(e.a), Body(Assembly::mesh(points, triangles))), shells, false);
    check(Pair(Body(e.a), Body(dented)), dents, false);
  }
  EXPECT_GT(std::min({hulls.in, hulls.out, hulls.depends}), 5);
  EXPECT_LE(hulls.undecided, 1);
  EXPECT_GT(std::min(shells.out, shells.depends), 5);
  EXPECT_GT(std::min(dents.out, dents.depends), 5);
}

TEST(RobustClearance, WithoutErrorsItIsTheClearance) {
  RobustDice dice(10);
  for (int i = 0; i < 500; ++i) {
    const RobustEngagement e = dice.engagement(i);
    const Vector3d w = e.v_a - e.v_b;
    const Clearance truth = clearance(e.a, e.b, w);
    const auto found = robust_clearance(e.a, e.b, w, {}, {});
    ASSERT_TRUE(found);
    if (truth.distance < 0) {
      EXPECT_LE(found->distance, truth.distance + 1e-9);
      EXPECT_NEAR(found->distance, truth.distance, 0.05 * (1 - truth.distance)) << i;
      continue;
    }
    EXPECT_NEAR(found->distance, truth.distance, 1e-9 * (1 + truth.distance)) << i;
    EXPECT_NEAR(found->time, truth.time, 1e-6 * (1 + std::abs(truth.time))) << i;
  }
}

/// No error passes nearer, and the one that the normal points to passes as near.
TEST(RobustClearance, IsTheLeastOverTheErrors) {
  RobustDice dice(11);
  int passing = 0;
  for (int i = 0; i < 600; ++i) {
    RobustEngagement e = dice.engagement(i % 2);
    const Vector3d w = e.v_a - e.v_b;
    const auto found = robust_clearance(e.a, e.b, w, e.errors.position, e.errors.velocity);
    e.errors.horizon = kForEver;
    const RobustVerdict all = verdict(e).verdict;
    if (!found || !(found->time > 0)) continue;
    EXPECT_EQ(found->distance > 0, all == RobustVerdict::out) << i << " " << found->distance;
    if (!(found->distance > 0)) continue;
    ++passing;
    const auto of_error = [&](const Vector3d& p, const Vector3d& v) {
      return clearance_ahead(ConeOracle(e.a, e.b.translated(p)), e.v_a + v, e.v_b);
    };
    for (int j = 0; j < 30; ++j)
      EXPECT_GE(of_error(dice.error(e.errors.position), dice.error(e.errors.velocity)),
                found->distance * (1 - 1e-9));
    const Vector3d p = e.errors.position.none() ? Vector3d::Zero()
                                                : Vector3d(-e.errors.position.support_point(found->normal));
    EXPECT_NEAR(of_error(p, e.errors.velocity.support_point(found->normal)), found->distance,
                1e-6 * (1 + found->distance))
        << i;
    // The envelope theorem.
    const Vector3d dw = 1e-6 * dice.direction(), dc = 1e-6 * dice.direction();
    const auto moved =
        robust_clearance(e.a, e.b.translated(dc), w + dw, e.errors.position, e.errors.velocity);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(moved->distance - found->distance,
                found->gradient_velocity().dot(dw) + found->gradient_center().dot(dc), 1e-8);
  }
  EXPECT_GT(passing, 100);
}

TEST(RobustClearance, NothingWhereTheVelocityMayBeZero) {
  const Ellipsoid a, b = Ellipsoid::from_axes({9, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(robust_clearance(a, b, {2, 0, 0}, {}, ErrorSet::ball(2)));
  EXPECT_TRUE(robust_clearance(a, b, {2, 0, 0}, {}, ErrorSet::ball(1.9)));
  EXPECT_FALSE(robust_clearance(a, b, Vector3d::Zero(), {}, {}));
}

TEST(RobustCone, BadInputNamesItsField) {
  const Ellipsoid a, b = Ellipsoid::from_axes({9, 0, 0}, {1, 1, 1});
  const auto field = [](auto call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  const auto of_errors = [&](auto set) {
    return field([&] {
      RelativeErrors errors;
      set(errors);
      (void)robust_verdict(a, b, {1, 0, 0}, {0, 0, 0}, errors);
    });
  };
  EXPECT_EQ(field([] { (void)ErrorSet::ball(-1); }), "ball");
  EXPECT_EQ(field([] { (void)ErrorSet::ball(std::nan("")); }), "ball");
  EXPECT_EQ(field([] { (void)ErrorSet::ellipsoid({1, 0, 1}); }), "semi_axes[1]");
  EXPECT_EQ(field([] { (void)ErrorSet::box({1, 1, -1}); }), "box[2]");
  EXPECT_EQ(of_errors([](RelativeErrors& e) { e.horizon = 0; }), "horizon");
  EXPECT_EQ(of_errors([](RelativeErrors& e) { e.acceleration = 1; }), "horizon");
  EXPECT_EQ(of_errors([](RelativeErrors& e) { e.acceleration = -1; }), "acceleration");
  EXPECT_EQ(of_errors([](RelativeErrors& e) { e.attitude_b = -1; }), "attitude_b");
  EXPECT_EQ(of_errors([](RelativeErrors& e) { e.size = kForEver; }), "size");
  EXPECT_EQ(field([&] { (void)robust_verdict(a, b, {1, kForEver, 0}, {0, 0, 0}, {}); }), "agent_velocity[1]");
}

}  // namespace
}  // namespace vericone::robust_test
