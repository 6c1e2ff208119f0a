// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/testing/random_bodies.h>

#include <numbers>

namespace vericone::combined_slice_cone_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies;

/// A body cut by one to three hyperboloids of either kind; each leaves 0.2 to 0.9 of the ellipsoid on its
/// axis (two sheets) or across it (one sheet).
CombinedEllipsoid random_combined(RandomBodies& random, const Vector3d& center, int hyperboloids) {
  const Vector3d axes(random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4));
  const Ellipsoid ellipsoid = Ellipsoid::from_axes(center, axes, random.rotation());
  const CombinedEllipsoid whole(ellipsoid);
  std::vector<Delimiter<3>> delimiters;
  for (int i = 0; i < hyperboloids; ++i) {
    const Eigen::Matrix3d turn = random.rotation();
    const int sheets = random.integer(1, 2);
    Vector3d h;
    for (int k = 0; k < 3; ++k)
      h(k) = random.uniform(0.2, 0.9) / whole.gauge(turn.col(k)) *
             ((k == 0) == (sheets == 2) ? 1 : random.uniform(0.5, 3));
    delimiters.push_back(hyperboloid(sheets, h, turn));
  }
  return {ellipsoid, std::move(delimiters)};
}

Vector3d across(const CombinedSliceCone& cone, const Slice& s) {
  const AxisFrame frame(cone.axis);
  return std::cos(s.azimuth) * frame.e1 + std::sin(s.azimuth) * frame.e2;
}

/// Boundary points of a body in a plane through its centre, from its gauge in space, as offsets from the
/// centre in coordinates of the plane.
std::vector<Vector2d> section_points(const CombinedEllipsoid& body, const Vector3d& x, const Vector3d& y,
                                     int count) {
  std::vector<Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const double t = 2 * pi * i / count;
    points.push_back(Vector2d(std::cos(t), std::sin(t)) / body.gauge(std::cos(t) * x + std::sin(t) * y));
  }
  return points;
}

/// The largest signed angle from the line of sight to b - a over all pairs, on each side.
struct Sampled {
  double left = 0, right = 0, step = 0;
};
Sampled sampled_edges(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Vector3d& x,
                      const Vector3d& y, int count) {
  const double distance = (b.center() - a.center()).norm();
  const auto on_a = section_points(a, x, y, count), on_b = section_points(b, x, y, count);
  Sampled found;
  for (const Vector2d& p : on_a)
    for (const Vector2d& q : on_b) {
      const Vector2d d = Vector2d(distance, 0) + q - p;
      const double angle = std::atan2(d.y(), d.x());
      found.left = std::max(found.left, angle);
      found.right = std::max(found.right, -angle);
    }
  for (const auto* points : {&on_a, &on_b})
    for (int i = 0; i < count; ++i)
      found.step = std::max(found.step, ((*points)[i] - (*points)[(i + 1) % count]).norm());
  return found;
}

TEST(CombinedSliceCone, OfEllipsoidsIsTheSliceCone) {
  RandomBodies random(4101);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const auto [a, b] = random.scaled_from_touching(1, 4, random.uniform(1.05, 3));
    const SliceCone plain = slice_cone(a, b, 9);
    const CombinedSliceCone combined = combined_slice_cone(a, b, 9);
    ASSERT_EQ(combined.relation, Relation::disjoint);
    ASSERT_EQ(combined.slices.size(), plain.slices.size());
    for (std::size_t k = 0; k < plain.slices.size(); ++k) {
      ASSERT_EQ(combined.slices[k].azimuth, plain.slices[k].azimuth);
      ASSERT_NEAR(combined.slices[k].left, plain.slices[k].left, 1e-11) << "case " << i;
      ASSERT_NEAR(combined.slices[k].right, plain.slices[k].right, 1e-11) << "case " << i;
    }
    ASSERT_NEAR(combined.polyhedral().solid_angle, plain.polyhedral().solid_angle, 1e-10);
  }
}

TEST(CombinedSliceCone, EdgesAreTheLargestAnglesOfSampledPairs) {
  RandomBodies random(4102);
  SCOPED_TRACE(random.trace());
  constexpr int kPoints = 500;
  int cases = 0, delimited = 0;
  while (cases < 60) {
    const CombinedEllipsoid a = random_combined(random, random.in_box(3), random.integer(0, 2));
    CombinedEllipsoid b = random_combined(random, Vector3d::Zero(), random.integer(1, 3));
    const Vector3d d = random.direction();
    // From nearly touching on the line of centres, in a dent perhaps, to far apart.
    b = b.translated(a.center() +
                     random.uniform(1.05, 2.5) * (1 / a.gauge(d) + 1 / b.gauge(Vector3d(-d))) * d);
    const CombinedSliceCone cone = combined_slice_cone(a, b, 2);
    if (cone.relation != Relation::disjoint) continue;
    for (const Slice& s : cone.slices) {
      const Sampled sampled = sampled_edges(a, b, cone.axis, across(cone, s), kPoints);
      ASSERT_GE(s.left, sampled.left - 1e-10) << "case " << cases;
      ASSERT_GE(s.right, sampled.right - 1e-10) << "case " << cases;
      // Each extreme point is within half a step of a sample, which turns the pair by at most the two half
      // steps over its length.
      const Vector3d e = across(cone, s);
      const double length = std::min(
          {1.0, (b.center() - a.center()).norm() - 1 / a.gauge(cone.axis) - 1 / b.gauge(-cone.axis)});
      ASSERT_LE(s.left - sampled.left, 2 * sampled.step / length) << "case " << cases << ' ' << e;
      ASSERT_LE(s.right - sampled.right, 2 * sampled.step / length) << "case " << cases;
    }
    delimited += !a.is_ellipsoid();
    ++cases;
  }
  EXPECT_GT(delimited, 20);
}

/// Every direction of a slice is a collision: the certified predicate never contradicts.
TEST(CombinedSliceCone, DirectionsAreInTheCone) {
  RandomBodies random(4103);
  SCOPED_TRACE(random.trace());
  int in = 0, undecided = 0;
  for (int cases = 0; cases < 60;) {
    const CombinedEllipsoid a = random_combined(random, Vector3d::Zero(), random.integer(0, 1));
    CombinedEllipsoid b = random_combined(random, Vector3d::Zero(), random.integer(1, 2));
    const Vector3d d = random.direction();
    b = b.translated(random.uniform(1.1, 2.5) * (1 / a.gauge(d) + 1 / b.gauge(Vector3d(-d))) * d);
    const CombinedSliceCone cone = combined_slice_cone(a, b, 4);
    if (cone.relation != Relation::disjoint) continue;
    const CombinedOracle oracle(a, b);
    for (const Slice& s : cone.slices)
      for (const double edge : {s.left, -s.right})
        for (const double part : {1 - 1e-4, 0.5}) {
          const double angle = part * edge;
          const Certified answer =
              oracle.membership(std::cos(angle) * cone.axis + std::sin(angle) * across(cone, s));
          ASSERT_NE(answer, Certified::out) << "case " << cases << " part " << part;
          ++(answer == Certified::in ? in : undecided);
        }
    ++cases;
  }
  EXPECT_GT(in, 20 * undecided);
}

/// A ball on the axis of a biconcave body of revolution, in its mouth. All edges pass by the rim, a circle
/// that crosses the ellipsoid x^2/A^2 + r^2/R^2 = 1 and the hyperboloid x^2/a^2 - r^2/c^2 = 1.
TEST(CombinedSliceCone, FromWithinTheMouthSeesPastTheRim) {
  const double ball = 0.25, big_a = 3, big_r = 4, a = 0.5, c = 1;
  const CombinedEllipsoid agent(Ellipsoid::from_axes({-1.2, 0, 0}, Vector3d::Constant(ball)));
  const CombinedEllipsoid obstacle(Ellipsoid::from_axes({0, 0, 0}, {big_a, big_r, big_r}),
                                   {hyperboloid(2, {a, c, c})});
  const double r2 = (1 - a * a / (big_a * big_a)) / (a * a / (big_a * big_a * c * c) + 1 / (big_r * big_r));
  const double x = -a * std::sqrt(1 + r2 / (c * c)), r = std::sqrt(r2);
  const double half = std::atan2(r, x + 1.2) + std::asin(ball / std::hypot(r, x + 1.2));
  ASSERT_GT(half, 1.7);  // 97 degrees: a velocity straight aside collides
  const CombinedSliceCone cone = combined_slice_cone(agent, obstacle, 720);
  ASSERT_EQ(cone.relation, Relation::disjoint);
  EXPECT_EQ(cone.hulls_overlap, 720);
  for (const Slice& s : cone.slices) {
    ASSERT_NEAR(s.left, half, 1e-11);
    ASSERT_NEAR(s.right, half, 1e-11);
  }
  EXPECT_NEAR(cone.polyhedral().solid_angle, 2 * pi * (1 - std::cos(half)), 1e-4);
  EXPECT_TRUE(std::isinf(cone.polyhedral().cross_section_area));
  // From the other side: the body is the agent.
  const CombinedSliceCone swapped = combined_slice_cone(obstacle, agent, 5);
  for (const Slice& s : swapped.slices) ASSERT_NEAR(s.psi(), 2 * half, 1e-11);
}

TEST(CombinedSliceCone, InvariantUnderScale) {
  RandomBodies random(4104);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 40; ++i) {
    const CombinedEllipsoid a = random_combined(random, Vector3d::Zero(), 1),
                            b = random_combined(random, 12 * random.direction(), 2);
    const CombinedSliceCone cone = combined_slice_cone(a, b, 3);
    ASSERT_EQ(cone.relation, Relation::disjoint);
    for (const double scale : {0x1p-60, 1e-6, 1e9}) {
      const CombinedSliceCone scaled = combined_slice_cone(a.scaled(scale), b.scaled(scale), 3);
      ASSERT_EQ(scaled.relation, Relation::disjoint);
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(scaled.slices[k].left, cone.slices[k].left, 1e-10) << "case " << i << ' ' << scale;
        ASSERT_NEAR(scaled.slices[k].right, cone.slices[k].right, 1e-10) << "case " << i << ' ' << scale;
      }
    }
  }
}

TEST(CombinedSliceCone, OverlappingBodiesHaveNoSlices) {
  const CombinedEllipsoid dented(Ellipsoid::from_axes({0, 0, 0}, {3, 4, 4}), {hyperboloid(2, {0.5, 1, 1})});
  const CombinedEllipsoid ball(Ellipsoid::from_axes({-0.6, 0, 0}, Vector3d::Constant(0.25)));
  const CombinedSliceCone cone = combined_slice_cone(ball, dented, 8);
  EXPECT_EQ(cone.relation, Relation::overlapping);
  EXPECT_TRUE(cone.slices.empty());
  EXPECT_EQ(cone.polyhedral().solid_angle, 4 * pi);
}

/// Where 6.3.2 finds its tangents it finds the sector's edges, from outside of the mouth.
TEST(CombinedSliceCone, TheSourcesChoiceFromAfar) {
  RandomBodies random(4105);
  SCOPED_TRACE(random.trace());
  int planes = 0, failures = 0, differences = 0;
  for (int i = 0; i < 100; ++i) {
    const CombinedEllipsoid a = random_combined(random, Vector3d::Zero(), 0);
    const CombinedEllipsoid b = random_combined(random, random.uniform(9, 20) * random.direction(), 1);
    const CombinedSliceCone truth = combined_slice_cone(a, b, 6),
                            source = combined_slice_cone(a, b, 6, SliceSector::source_by_sides);
    ASSERT_EQ(source.relation, Relation::disjoint);
    int differing = 0;
    for (int k = 0; k < 6; ++k)
      differing += std::abs(source.slices[k].left - truth.slices[k].left) > 1e-9 ||
                   std::abs(source.slices[k].right - truth.slices[k].right) > 1e-9;
    ASSERT_EQ(differing, source.source_differences) << "case " << i;
    planes += 6;
    failures += source.source_failures;
    differences += source.source_differences;
  }
  RecordProperty("failures", failures);
  RecordProperty("differences", differences);
  EXPECT_LT(failures + differences, planes / 2);
}

TEST(CombinedSliceCone, RefusesWhatItCannotDo) {
  const CombinedEllipsoid ball(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}));
  const CombinedEllipsoid one(Ellipsoid::from_axes({9, 0, 0}, {2, 2, 2}), {hyperboloid(2, {1, 1, 1})});
  const CombinedEllipsoid two(Ellipsoid::from_axes({9, 0, 0}, {2, 2, 2}),
                              {hyperboloid(2, {1, 1, 1}), hyperboloid(1, {1, 1, 1})});
  const auto field = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(field([&] { combined_slice_cone(ball, one, 0); }), "planes");
  EXPECT_EQ(field([&] { combined_slice_cone(one, ball, 3, SliceSector::source_by_sides); }), "agent");
  EXPECT_EQ(field([&] { combined_slice_cone(ball, two, 3, SliceSector::source_printed); }), "obstacle");
  EXPECT_EQ(field([&] { combined_slice_cone(ball, one, 3, SliceSector::source_by_sides); }), "");
}

}  // namespace
}  // namespace vericone::combined_slice_cone_test
