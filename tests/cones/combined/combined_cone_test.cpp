// SPDX-License-Identifier: BSD-3-Clause
//
// The certified cones of combined quadrics against closed forms, exact predicates and laws. Against exact
// polyhedra and sampling: tests/verify.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include <numbers>

namespace vericone::combined_cone_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies;

/// A spool: an ellipsoid of revolution about z with a waist of radius `waist`, widening as sqrt(1 +
/// z^2/slope^2).
CombinedEllipsoid spool(const Vector3d& center, double half_length, double radius, double waist,
                        double slope) {
  Matrix3d z_first;  // the hyperboloid's axis is its local x
  z_first << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return {Ellipsoid::from_axes(center, {radius, radius, half_length}),
          {hyperboloid(1, {slope, waist, waist}, z_first)}};
}

/// An ellipsoid with dents at both ends of its x axis, `depth` from the centre at the bottom.
CombinedEllipsoid dented(RandomBodies& random, const Vector3d& center) {
  const Vector3d axes(random.uniform(2, 8), random.uniform(2, 8), random.uniform(2, 8));
  const Matrix3d r = random.rotation();
  return {
      Ellipsoid::from_axes(center, axes, r),
      {hyperboloid(2, {random.uniform(0.2, 0.9) * axes.x(), random.uniform(1, 5), random.uniform(1, 5)}, r)}};
}

CombinedEllipsoid star(RandomBodies& random, const Vector3d& center) {
  const Vector3d axes(random.uniform(3, 8), random.uniform(3, 8), random.uniform(3, 8));
  std::vector<Delimiter<3>> list;
  const int count = random.integer(2, 3);
  for (int i = 0; i < count; ++i)
    list.push_back(random.coin() ? hyperboloid(2, {random.uniform(1, 2.5), 2, 3}, random.rotation())
                                 : hyperboloid(1, {3, random.uniform(1, 2.5), 2}, random.rotation()));
  return {Ellipsoid::from_axes(center, axes, random.rotation()), list};
}

CombinedEllipsoid any_body(RandomBodies& random, const Vector3d& center) {
  switch (random.integer(0, 3)) {
    case 0:
      return random.ellipsoid(center, 1, 8);
    case 1:
      return dented(random, center);
    case 2: {
      const double waist = random.uniform(0.3, 2);
      return spool(center, random.uniform(4, 9), waist + random.uniform(0.5, 3), waist, random.uniform(1, 5));
    }
    default:
      return star(random, center);
  }
}

Vector3d direction(const AxisFrame& frame, double azimuth, double angle) {
  return std::cos(angle) * frame.axis +
         std::sin(angle) * (std::cos(azimuth) * frame.e1 + std::sin(azimuth) * frame.e2);
}

/// Largest angle known in, smallest known out, on a half-plane.
std::pair<double, double> edge(const CombinedOracle& oracle, const AxisFrame& frame, double azimuth) {
  double in = 0, out = pi;
  for (int i = 0; i < 60; ++i) {
    const double half = 0.5 * (in + out);
    const Certified answer = oracle.membership(direction(frame, azimuth, half));
    if (answer == Certified::undecided) break;
    (answer == Certified::in ? in : out) = half;
  }
  return {in, out};
}

TEST(CombinedOracle, EdgeBesideAWaistIsThatOfTheHyperbola) {
  // A ball of radius rho in the plane of the waist. Seen along a velocity in that plane at the offset h from
  // the spool's axis, the spool's shadow is |y| <= b sqrt(1 + z^2/s^2), and the ball grazes it where the
  // distance from (h, 0) to that hyperbola is rho.
  const double b = 1, s = 2, distance = 20;
  for (const double rho : {0.1, 0.5, 1.5, 3.0}) {
    const CombinedOracle oracle(Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(rho)),
                                spool({distance, 0, 0}, 9, 7, b, s), 1e-9);
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    const auto to_hyperbola = [&](double h) {
      double least = 1e9;
      for (int i = 0; i <= 20000; ++i) {
        const double z = 4e-4 * i, y = b * std::sqrt(1 + z * z / (s * s));
        least = std::min(least, std::hypot(h - y, z));
      }
      return least;
    };
    double low = b, high = b + 5;
    for (int i = 0; i < 60; ++i) {
      const double h = 0.5 * (low + high);
      (to_hyperbola(h) < rho ? low : high) = h;
    }
    const double expected = std::asin(low / distance);
    const auto at = [&](double angle) { return oracle.membership({std::cos(angle), std::sin(angle), 0}); };
    EXPECT_EQ(at(expected - 1e-6), Certified::in) << rho;
    EXPECT_EQ(at(expected + 1e-6), Certified::out) << rho;
  }
}

TEST(CombinedOracle, AVelocityPassesTheWaistThatTheHullForbids) {
  // docs/explanation/combined.md shows this engagement.
  const CombinedEllipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {1.2, 0.6, 0.6});
  const CombinedEllipsoid obstacle = spool({20, 0, 0}, 9, 5, 1, 1.5);
  const CombinedOracle oracle(agent, obstacle);
  const Vector3d past(20, 3, 0), high(20, 3, 5);
  EXPECT_EQ(oracle.membership(past), Certified::out);
  EXPECT_EQ(oracle.membership(high), Certified::in);
  // Points of the obstacle alone span a hull that is hit.
  std::vector<Vector3d> points;
  for (const double z : {-1.45, 1.45})
    for (int i = 0; i < 12; ++i) {
      const Vector3d u(std::cos(i * pi / 6), std::sin(i * pi / 6), z);  // the rims, nearly
      points.push_back(obstacle.center() + u / obstacle.gauge(u));
    }
  EXPECT_EQ(HullOracle(agent.ellipsoid(), HullBody(points)).membership(past), Membership::in);
  // On the plane through the velocity across the spool's axis the cone is one interval; on a parallel one
  // beside the waist, that misses the line of centres, it is two with the gap between.
  const auto intervals = plane_intervals(oracle, past.normalized(), Vector3d::UnitZ(), 1e-3);
  int in = 0;
  for (const PlaneInterval& i : intervals) in += i.answer == Certified::in;
  EXPECT_EQ(in, 2);
}

TEST(CombinedOracle, EllipsoidsAreDecidedExactly) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                  b = Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2});
  const CombinedOracle oracle(a, b);
  EXPECT_EQ(oracle.relation(), Relation::disjoint);
  EXPECT_EQ(oracle.membership({4, 3, 0}), Certified::in);  // sin = 3/5: grazes, and the cone is closed
  EXPECT_EQ(oracle.membership({4, std::nextafter(3, 4), 0}), Certified::out);
  EXPECT_EQ(oracle.membership({0, 0, 0}), Certified::out);
  EXPECT_EQ(CombinedOracle(a, Ellipsoid::from_axes({3, 0, 0}, {2, 2, 2})).relation(), Relation::touching);
}

TEST(CombinedOracle, AnswersAgreeWithTheLawsOfCones) {
  RandomBodies random(8821);
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0, disjoint = 0;
  for (int i = 0; i < 400; ++i) {
    const CombinedEllipsoid a = any_body(random, {0, 0, 0});
    const CombinedEllipsoid b = any_body(random, random.uniform(6, 25) * random.direction());
    const CombinedOracle oracle(a, b), mirrored(b, a);
    ASSERT_TRUE(oracle.relation().has_value());
    ASSERT_EQ(oracle.relation(), mirrored.relation());
    if (oracle.relation() != Relation::disjoint) continue;
    ++disjoint;
    const Ellipsoid hull_a = a.ellipsoid(), hull_b = b.ellipsoid();
    const ConeOracle around(hull_a, hull_b);
    const AxisFrame frame(b.center() - a.center());
    for (int k = 0; k < 20; ++k) {
      const double azimuth = random.uniform(-pi, pi), angle = random.uniform(0, 1.5);
      const Vector3d w = direction(frame, azimuth, angle);
      const Certified answer = oracle.membership(w);
      ++asked;
      decided += answer != Certified::undecided;
      const auto contradicts = [&](Certified other) {
        return answer != Certified::undecided && other != Certified::undecided && answer != other;
      };
      ASSERT_FALSE(contradicts(mirrored.membership(-w)));
      // What lies between the line of centres and a direction that is in, is in.
      if (answer == Certified::in) {
        ASSERT_NE(oracle.membership(direction(frame, azimuth, random.uniform() * angle)), Certified::out);
      }
      if (around.relation() == Relation::disjoint && around.membership(w) == Membership::out) {
        ASSERT_EQ(answer, Certified::out);
      }
      const Vector3d other =
          direction(frame, azimuth + 0.1 * random.uniform(), angle + 0.1 * random.uniform());
      const Vector3d between = 0.3 * w + 0.7 * other;
      if (oracle.all_in(w, other)) {
        ASSERT_EQ(oracle.membership(between), Certified::in);
      }
      if (oracle.all_out(w, other)) {
        ASSERT_EQ(oracle.membership(between), Certified::out);
      }
    }
  }
  EXPECT_GT(disjoint, 200);
  EXPECT_GT(decided, asked * 0.999);
}

TEST(CombinedOracle, UnitsOfLengthDoNotMatter) {
  RandomBodies random(77);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 40; ++i) {
    const CombinedEllipsoid a = any_body(random, {0, 0, 0}), b = any_body(random, 25 * random.direction());
    const Vector3d w = b.center() + random.in_box(12);
    const Certified answer = CombinedOracle(a, b).membership(w);
    for (const double scale : {0x1p-400, 0x1p-20, 0x1p20, 0x1p400}) {
      const CombinedOracle scaled(a.scaled(scale), b.scaled(scale));
      ASSERT_EQ(scaled.relation(), Relation::disjoint);
      EXPECT_EQ(scaled.membership(w), answer) << scale;
    }
  }
}

TEST(CombinedOracle, ManyDelimiters) {
  std::vector<Delimiter<3>> list;
  RandomBodies random(31);
  list.reserve(30);
  for (int i = 0; i < 30; ++i) list.push_back(hyperboloid(2, {2.5, 1, 1}, random.rotation()));
  const CombinedEllipsoid urchin(Ellipsoid::from_axes({0, 0, 0}, {4, 4, 4}), list);
  const CombinedOracle oracle(urchin, urchin.translated({12, 1, 2}));
  ASSERT_EQ(oracle.relation(), Relation::disjoint);
  EXPECT_EQ(oracle.membership({12, 1, 2}), Certified::in);
  EXPECT_EQ(oracle.membership({0, 1, 2}), Certified::out);
  EXPECT_TRUE(oracle.all_in({12, 1, 2}, {12, 1, 2.1}));
}

TEST(CombinedOracle, BracketsEdgesToItsTolerance) {
  RandomBodies random(4711);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 60; ++i) {
    const CombinedEllipsoid a = random.ellipsoid({0, 0, 0}, 1, 5),
                            b = any_body(random, 25 * random.direction());
    const CombinedOracle oracle(a, b, 1e-7);
    ASSERT_EQ(oracle.relation(), Relation::disjoint);
    const auto [in, out] = edge(oracle, AxisFrame(b.center()), random.uniform(-pi, pi));
    // Boxes of 1e-7 of A's extent, at a distance of five times that and more.
    EXPECT_LT(out - in, 1e-6) << i;
  }
}

TEST(CombinedOracle, TimesToContact) {
  RandomBodies random(515);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 1, 4);
    const Matrix3d turn = random.rotation();
    const Vector3d axes(random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4));
    const Ellipsoid b = Ellipsoid::from_axes(20 * random.direction(), axes, turn);
    const Vector3d w = b.center() + random.in_box(2);
    const auto expected = time_to_contact(a, b, w);
    // A delimiter that cuts off next to nothing far from where they meet: the time of the ellipsoids, within
    // what it cuts off.
    const CombinedEllipsoid cut(b, {hyperboloid(2, Vector3d(0.9999 * axes.x(), 1, 1), turn)});
    for (const CombinedEllipsoid& body : {CombinedEllipsoid(b), cut}) {
      const auto time = CombinedOracle(a, body).time_to_contact(w, 1e-7);
      if (!expected) {
        EXPECT_FALSE(time);
        continue;
      }
      ASSERT_TRUE(time);
      if (body.is_ellipsoid()) {
        EXPECT_TRUE(time->lo() <= *expected && *expected <= time->hi());
      } else {
        EXPECT_GE(time->hi(), *expected);
      }
      EXPECT_LT(time->hi() - time->lo(), 1e-5);
    }
  }
}

TEST(CombinedCone, BoundsHoldForEllipsoids) {
  RandomBodies random(99);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 20; ++i) {
    const auto [a, b] = random.separated_along_centers(1, 10, random.uniform(1.2, 3));
    const double exact = true_cone(a, b, 192).solid_angle;
    for (const double tolerance : {0.1, 0.01, 0.001}) {
      const CombinedCone cone = combined_cone(a, b, tolerance);
      ASSERT_EQ(cone.relation, Relation::disjoint);
      EXPECT_LE(std::abs(cone.solid_angle - exact), cone.solid_angle_error);
      EXPECT_LE(2 * cone.solid_angle_error, 1.001 * tolerance * cone.outer.solid_angle);
    }
  }
}

TEST(CombinedCone, InnerIsInAndOuterIsOut) {
  RandomBodies random(2024);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 12; ++i) {
    const CombinedEllipsoid a =
        i % 3 ? CombinedEllipsoid(random.ellipsoid({0, 0, 0}, 1, 4)) : dented(random, {0, 0, 0});
    const CombinedEllipsoid b = any_body(random, 25 * random.direction());
    const CombinedCone coarse = combined_cone(a, b, 0.1), fine = combined_cone(a, b, 0.03);
    ASSERT_EQ(coarse.relation, Relation::disjoint);
    EXPECT_LE(coarse.inner.solid_angle, fine.outer.solid_angle);
    EXPECT_LE(fine.inner.solid_angle, coarse.outer.solid_angle);
    const CombinedOracle oracle(a, b);
    for (const Vector3d& d : fine.inner.directions) ASSERT_NE(oracle.membership(d), Certified::out);
    for (const Vector3d& d : fine.outer.directions) ASSERT_NE(oracle.membership(d), Certified::in);
  }
}

TEST(CombinedCone, OfOverlappingBodiesIsEverything) {
  const CombinedEllipsoid body = spool({0, 0, 0}, 9, 5, 1, 1.5);
  const CombinedCone cone = combined_cone(body, body.translated({1, 0, 0}));
  EXPECT_EQ(cone.relation, Relation::overlapping);
  EXPECT_EQ(cone.solid_angle, 4 * pi);
  EXPECT_TRUE(cone.inner.directions.empty());
}

TEST(CombinedCone, OfABodyInAnothersMouth) {
  // A ball within the convex hull of the spool, beside its waist: disjoint, and most directions collide.
  const CombinedEllipsoid obstacle = spool({0, 0, 0}, 9, 7, 1, 1.5);
  const Ellipsoid agent = Ellipsoid::from_axes({2.2, 0, 0}, Vector3d::Constant(0.5));
  const CombinedCone cone = combined_cone(agent, obstacle, 0.02);
  ASSERT_EQ(cone.relation, Relation::disjoint);
  EXPECT_LE(2 * cone.solid_angle_error, 0.0201 * cone.outer.solid_angle);
  EXPECT_TRUE(std::isinf(cone.cross_section_area));
  const CombinedOracle oracle(agent, obstacle);
  EXPECT_EQ(oracle.membership({1, 0, 0}), Certified::out);  // straight away
  // Past the right angle to the line of centres, and still into the rim: 2.7 m from the axis where it is 3.5
  // m thick.
  EXPECT_EQ(oracle.membership({0.1, 0, 1}), Certified::in);
}

TEST(CombinedCone, BadToleranceIsRefused) {
  const Ellipsoid a, b = a.translated({5, 0, 0});
  for (const double bad : {0.0, -1.0, 1.0, std::nan("")}) {
    EXPECT_THROW(combined_cone(a, b, bad), InputError);
    EXPECT_THROW(CombinedOracle(a, b, bad), InputError);
  }
  // Below rounding nothing could be proved: the bounds would be those of no search at all.
  EXPECT_THROW(combined_cone(a, b, 1e-12), InputError);
  EXPECT_THROW(CombinedOracle(a, b).membership({1, std::nan(""), 0}), InputError);
}

}  // namespace
}  // namespace vericone::combined_cone_test
