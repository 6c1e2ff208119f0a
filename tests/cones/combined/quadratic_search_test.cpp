// SPDX-License-Identifier: BSD-3-Clause
//
// The search that certified cones rest on: `empty` and `found` are never wrong, and near a tangency it needs
// boxes of the square root of the gap only.
#include <gtest/gtest.h>
#include <vericone/testing/random_bodies.h>

#include <limits>

#include "../../../cones/src/combined/point_certificate.h"
#include "../../../cones/src/combined/quadratic_search.h"

namespace vericone::quadratic_search_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::RandomBodies;

QuadraticConstraint<3> ball(const Vector3d& center, double radius) {
  QuadraticConstraint<3> q;
  q.h = Matrix3d::Identity();
  q.g = -center;
  q.c = center.squaredNorm() - radius * radius;
  q.slack = 1e-13;
  return q;
}

/// The outside of a ball.
QuadraticConstraint<3> outside(const Vector3d& center, double radius) {
  QuadraticConstraint<3> q = ball(center, radius);
  q.h *= -1;
  q.g *= -1;
  q.c *= -1;
  q.concavity = 1;
  return q;
}

const SearchBox<3> kBox{Vector3d::Zero(), Vector3d::Constant(2)};

TEST(QuadraticSearch, TwoBallsMeetOrNotByTheirDistance) {
  QuadraticSearch<3> search;
  for (const double gap : {0.5, 1e-2, 1e-5, 1e-8, -1e-8, -1e-5, -1e-2, -0.5}) {
    const Vector3d d = Vector3d(1, 2, -2) / 3;
    const auto r = search.run({ball(-d, 1), ball((1 + gap) * d, 1)}, kBox, {1e-9, 100000});
    EXPECT_EQ(r.outcome, gap > 0 ? SearchOutcome::empty : SearchOutcome::found) << gap;
    // Boxes of width sqrt(gap) near one point, halved from the whole: a few hundred, whatever the gap.
    EXPECT_LT(r.boxes, 400) << gap;
  }
}

TEST(QuadraticSearch, OnePointDecidesWhatIsConvexNearATangency) {
  RandomBodies random(4108);
  SCOPED_TRACE(random.trace());
  for (const double gap : {1e-2, 1e-4, 1e-7, 1e-10, -1e-10, -1e-7, -1e-4}) {
    const Vector3d d = random.direction(), touched = gap / 2 * d;
    const std::vector<QuadraticConstraint<3>> apart{ball(-d, 1), ball((1 + gap) * d, 1)};
    Vector3d x = touched + 0.1 * gap * random.direction();
    const SearchOutcome expected = gap > 0 ? SearchOutcome::empty : SearchOutcome::found;
    EXPECT_EQ(decide_from<3>(apart, kBox, x), expected) << gap;
    if (expected == SearchOutcome::found) {
      for (const QuadraticConstraint<3>& q : apart) EXPECT_LE(x.dot(q.h * x) + 2 * q.g.dot(x) + q.c, 0);
    }
    // A ball within another, whose outside is asked for: empty or not, one point may not say that it is.
    Vector3d y = d;
    const std::vector<QuadraticConstraint<3>> within{ball({0, 0, 0}, 1), outside(0.5 * d, 0.5 + gap)};
    EXPECT_NE(decide_from<3>(within, kBox, y), SearchOutcome::empty) << gap;
  }
}

TEST(QuadraticSearch, WhatAllMultipliersMustShare) {
  // A ball, and the outsides of two balls that cover all of it but little: neither alone empties it.
  QuadraticSearch<3> search;
  const auto covered = [&](double radius) {
    return search
        .run({ball({0, 0, 0}, 0.5), outside({0.4, 0, 0}, radius), outside({-0.4, 0, 0}, radius)}, kBox,
             {1e-6, 200000})
        .outcome;
  };
  // The circle where the two meet has the radius sqrt(radius^2 - 0.16): 0.5 at sqrt(0.41).
  EXPECT_EQ(covered(std::sqrt(0.41) + 1e-3), SearchOutcome::empty);
  EXPECT_EQ(covered(std::sqrt(0.41) - 1e-3), SearchOutcome::found);
}

TEST(QuadraticSearch, UndecidedWhereSlackDoesNotTell) {
  QuadraticSearch<3> search;
  auto second = ball({2, 0, 0}, 1);
  second.slack = 1e-3;
  EXPECT_EQ(search.run({ball({0, 0, 0}, 1), second}, kBox, {1e-4, 100000}).outcome, SearchOutcome::undecided);
}

TEST(QuadraticSearch, SideTermIsTheDistanceFromAHalfPlane) {
  // y^2 + min(0, x)^2 <= 1: within one of the half-plane { x >= 0, y = 0 }.
  QuadraticConstraint<3> q;
  q.h(1, 1) = 1;
  q.c = -1;
  q.u = Vector3d::UnitX();
  q.slack = 1e-13;
  QuadraticSearch<3> search;
  const auto meets = [&](const Vector3d& center, double radius) {
    return search.run({q, ball(center, radius)}, {Vector3d::Zero(), Vector3d::Constant(5)}, {1e-8, 100000})
        .outcome;
  };
  const Vector3d behind(-1.2, 1.6, 0);  // at the distance 2 from the edge
  EXPECT_EQ(meets(behind, 1 - 1e-6), SearchOutcome::empty);
  EXPECT_EQ(meets(behind, 1 + 1e-6), SearchOutcome::found);
  const Vector3d above(3, 2.5, 1);  // 2.5 from the half-plane
  EXPECT_EQ(meets(above, 1.5 - 1e-6), SearchOutcome::empty);
  EXPECT_EQ(meets(above, 1.5 + 1e-6), SearchOutcome::found);
}

TEST(QuadraticSearch, RandomListsAreNeverAnsweredWrong) {
  RandomBodies random(4107);
  SCOPED_TRACE(random.trace());
  QuadraticSearch<3> search;
  int empty = 0, found = 0, by_point = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<QuadraticConstraint<3>> list;
    const int count = random.integer(2, 6);
    for (int k = 0; k < count; ++k) {
      const Matrix3d r = random.rotation();
      const Vector3d d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      QuadraticConstraint<3> q;
      q.h = r * d.asDiagonal() * r.transpose();
      q.h = (0.5 * (q.h + q.h.transpose())).eval();
      q.g = random.in_box(1);
      q.c = random.uniform(-0.2, 1);
      q.concavity = std::max(0.0, -d.minCoeff()) + 1e-14;
      q.slack = 1e-12;
      list.push_back(q);
    }
    const SearchBox<3> box{Vector3d::Zero(), Vector3d::Ones()};
    const auto r = search.run(list, box, {1e-3, 20000});
    const auto holds = [&](const Vector3d& x, double tolerance) {
      return std::all_of(list.begin(), list.end(), [&](const QuadraticConstraint<3>& q) {
        return x.dot(q.h * x) + 2 * q.g.dot(x) + q.c <= tolerance;
      });
    };
    if (r.outcome == SearchOutcome::found) {
      ++found;
      ASSERT_TRUE(holds(r.point, 0));
      ASSERT_LE(r.point.cwiseAbs().maxCoeff(), 1 + 1e-9);
    }
    // From any points, where those say anything.
    for (int s = 0; s < 4; ++s) {
      Vector3d x = random.in_box(1);
      const SearchOutcome said = decide_from<3>(list, box, x);
      if (said == SearchOutcome::found) {
        ASSERT_TRUE(holds(x, 0));
      }
      if (said != SearchOutcome::empty) continue;
      ++by_point;
      ASSERT_NE(r.outcome, SearchOutcome::found);
    }
    if (r.outcome == SearchOutcome::empty) {
      ++empty;
      for (int s = 0; s < 300; ++s) ASSERT_FALSE(holds(random.in_box(1), -1e-9));
    }
  }
  // Both answers are common, or the test tests nothing.
  EXPECT_GT(empty, 300);
  EXPECT_GT(found, 1000);
  EXPECT_GT(by_point, 30);
}

}  // namespace
}  // namespace vericone::quadratic_search_test
