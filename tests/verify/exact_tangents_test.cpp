// SPDX-License-Identifier: GPL-3.0-or-later
//
// Held against closed forms (circles, affine images of circles) in 100-digit arithmetic.
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/exact_tangents.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace vericone::verify::exact_tangents_test {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_100;
constexpr double kPi = std::numbers::pi;

Ellipse circle(double x, double y, double r) { return Ellipse::from_axes({x, y}, {r, r}); }

Ellipse of_shape(double x, double y, double s11, double s12, double s22) {
  return Ellipse::from_shape({x, y}, (Eigen::Matrix2d() << s11, s12, s12, s22).finished());
}

InnerTangents tangents_of(const Ellipse& a, const Ellipse& b) {
  const ExactTangents exact = exact_inner_tangents(a, b);
  EXPECT_EQ(exact.relation, PlanarRelation::separated);
  EXPECT_TRUE(exact.tangents.has_value());
  return exact.tangents.value_or(InnerTangents{});
}

/// The true value lies inside, both ends are within `steps` doubles, and the parts give 40 digits.
void expect_encloses(const EnclosedReal& e, const Wide& truth, int steps = 1) {
  EXPECT_LE(Wide(e.lo()), truth) << e.lo() << " " << truth;
  EXPECT_GE(Wide(e.hi()), truth) << e.hi() << " " << truth;
  double x = e.lo();
  for (int i = 0; i < steps && x < e.hi(); ++i) x = std::nextafter(x, e.hi());
  EXPECT_EQ(x, e.hi());
  const Wide sum = Wide(e.parts()[0]) + e.parts()[1] + e.parts()[2];
  EXPECT_LE(abs(sum - truth), abs(truth) * Wide("1e-40"));
}

Wide pi() { return boost::math::constants::pi<Wide>(); }

Wide wrapped(Wide angle) {
  while (angle > pi()) angle -= 2 * pi();
  while (angle <= -pi()) angle += 2 * pi();
  return angle;
}

/// Angle from the vector (ax, ay) to (bx, by), without the cancellation of a difference of two angles.
Wide angle_between(const Wide& ax, const Wide& ay, const Wide& bx, const Wide& by) {
  return atan2(Wide(ax * by - ay * bx), Wide(ax * bx + ay * by));
}

/// Circles (0, 0; r1) and (dx, dy; r2): psi = 2 asin((r1 + r2) / d), bisector along the line of centres.
void check_circles(double dx, double dy, double r1, double r2) {
  SCOPED_TRACE(::testing::Message() << "dx " << dx << " dy " << dy << " r1 " << r1 << " r2 " << r2);
  const InnerTangents t = tangents_of(circle(0, 0, r1), circle(dx, dy, r2));
  const Wide x(dx), y(dy), d = sqrt(Wide(x * x + y * y)), half = asin(Wide((Wide(r1) + r2) / d)),
                           mid = atan2(y, x);
  expect_encloses(t.psi, 2 * half);
  expect_encloses(t.theta_b, mid);
  expect_encloses(t.right.direction, wrapped(mid - half));
  expect_encloses(t.left.direction, wrapped(mid + half));
  // The contact with A is at r1 (cos, sin) of the direction turned back by a right angle (left edge: A on the
  // left of the line from A to B has its contact to the right).
  const Wide left = mid + half, right = mid - half;
  EXPECT_NEAR(t.left.point_on_a[0].nearest(), double(r1 * cos(Wide(left - pi() / 2))), 1e-14 * r1);
  EXPECT_NEAR(t.left.point_on_a[1].nearest(), double(r1 * sin(Wide(left - pi() / 2))), 1e-14 * r1);
  EXPECT_NEAR(t.right.point_on_a[0].nearest(), double(r1 * cos(Wide(right + pi() / 2))), 1e-14 * r1);
  EXPECT_NEAR(t.right.point_on_a[1].nearest(), double(r1 * sin(Wide(right + pi() / 2))), 1e-14 * r1);
  const double scale = 1e-15 * (double(d) + r2);
  EXPECT_NEAR(t.left.point_on_b[0].nearest(), double(x + r2 * cos(Wide(left + pi() / 2))), scale);
  EXPECT_NEAR(t.left.point_on_b[1].nearest(), double(y + r2 * sin(Wide(left + pi() / 2))), scale);
}

TEST(ExactTangents, CirclesOnTheXAxis) {
  check_circles(5, 0, 1, 1);
  check_circles(5, 0, 1, 2);
  check_circles(5, 0, 2, 1);
}

TEST(ExactTangents, CirclesToTheLeftHaveTheBisectorAtPi) {
  check_circles(-5, 0, 1, 1);
  check_circles(-5, 0, 1, 2);
  const InnerTangents t = tangents_of(circle(0, 0, 1), circle(-5, 0, 2));
  EXPECT_EQ(t.theta_b.nearest(), kPi);
}

TEST(ExactTangents, BisectorAlongTheXAxisIsZeroExactly) {
  const InnerTangents t = tangents_of(circle(0, 0, 1), circle(5, 0, 2));
  EXPECT_EQ(t.theta_b.lo(), 0);
  EXPECT_EQ(t.theta_b.hi(), 0);
}

TEST(ExactTangents, BisectorNextToTheXAxisIsNot) {
  check_circles(5, 1e-250, 1, 2);
  check_circles(-5, 1e-250, 1, 2);
  check_circles(-5, -1e-250, 1, 2);
  check_circles(5, -0x1p-60, 1, 2);
}

TEST(ExactTangents, CirclesOnTheYAxisAndOblique) {
  check_circles(0, 5, 1, 2);
  check_circles(0, -5, 1, 1);
  check_circles(-3, -4, 1, 2);
  check_circles(0.3, 7, 1.25, 3);
}

TEST(ExactTangents, TinyOpeningsAreGoodToTheLastBit) {
  check_circles(3e9, 4e9, 1, 1);
  check_circles(-3e9, 4e9, 1, 2);
  check_circles(1e15, 7, 1e-3, 1e-2);
  check_circles(1e15, 0, 1, 1);
}

TEST(ExactTangents, NearlyTouchingCircles) {
  check_circles(2 + 0x1p-51, 0, 1, 1);
  check_circles(5, 0x1p-20, 2, 3);
}

TEST(ExactTangents, AxisParallelTangents) {
  const InnerTangents t = tangents_of(circle(0, 0, 1), circle(2, 2, 1));
  EXPECT_EQ(t.right.direction.lo(), 0);
  EXPECT_EQ(t.right.direction.hi(), 0);
  expect_encloses(t.left.direction, pi() / 2);
  expect_encloses(t.psi, pi() / 2);
  expect_encloses(t.theta_b, pi() / 4);

  const InnerTangents back = tangents_of(circle(2, 2, 1), circle(0, 0, 1));
  expect_encloses(back.right.direction, pi());
  expect_encloses(back.left.direction, -pi() / 2);
  expect_encloses(back.theta_b, -3 * pi() / 4);
}

TEST(ExactTangents, EveryQuadrantAndOrder) {
  // Tangents along the axes again, in all quadrants: the vertical one is a root at 0, the horizontal one at
  // infinity.
  for (const double x : {-2.0, 2.0})
    for (const double y : {-2.0, 2.0}) {
      SCOPED_TRACE(::testing::Message() << x << " " << y);
      const InnerTangents t = tangents_of(circle(0, 0, 1), circle(x, y, 1));
      expect_encloses(t.psi, pi() / 2);
      expect_encloses(t.theta_b, atan2(Wide(y), Wide(x)));
    }
}

struct Relations {
  Ellipse a, b;
  PlanarRelation relation;
};

TEST(ExactRelation, Decided) {
  const auto separated = PlanarRelation::separated, touching = PlanarRelation::touching,
             overlapping = PlanarRelation::overlapping;
  const double more = std::nextafter(5.0, 6.0), less = std::nextafter(5.0, 4.0);
  const std::vector<Relations> cases = {
      {circle(0, 0, 1), circle(2, 0, 1), touching},
      {circle(0, 0, 2), circle(3, 4, 3), touching},  // 3-4-5
      {circle(0, 0, 2), circle(more, 0, 3), separated},
      {circle(0, 0, 2), circle(less, 0, 3), overlapping},
      {circle(1e9, 1e9, 2), circle(1e9 + 3, 1e9 + 4, 3), touching},
      {circle(0, 0, 2), circle(3, 4 + 1e-15, 3), separated},
      {circle(0, 0, 2), circle(3, 4 - 1e-15, 3), overlapping},
      {circle(0, 0, 1), circle(1, 0, 1), overlapping},
      {circle(0, 0, 3), circle(1, 0, 1), overlapping},  // contained
      {circle(1, 0, 1), circle(0, 0, 3), overlapping},
      {circle(0, 0, 3), circle(2, 0, 1), overlapping},                  // contained, boundaries touch
      {circle(0, 0, 3), circle(0, 0, 1), overlapping},                  // concentric
      {circle(0, 0, 1), circle(0, 0, 1), overlapping},                  // the same
      {of_shape(0, 0, 4, 0, 1), of_shape(0, 0, 1, 0, 4), overlapping},  // crossing in four points
      {of_shape(0, 0, 4, 0, 1), of_shape(3, 0, 1, 0, 25), touching},    // vertices on the x axis
      {of_shape(0, 0, 4, 0, 1), of_shape(0, 3, 9, 0, 4), touching},     // vertices on the y axis
      {of_shape(0, 0, 4, 0, 1), of_shape(0, 0, 4, 0, 0.25),
       overlapping},  // contained, touching at two points
      // Unit circles at the origin and (0, 1), (0, 2), (2, 0), (2, 2), sheared by [1 1; 0 1].
      {of_shape(0, 0, 2, 1, 1), of_shape(1, 1, 2, 1, 1), overlapping},
      {of_shape(0, 0, 2, 1, 1), of_shape(2, 2, 2, 1, 1), touching},
      {of_shape(0, 0, 2, 1, 1), of_shape(2, 0, 2, 1, 1), touching},
      {of_shape(0, 0, 2, 1, 1), of_shape(4, 2, 2, 1, 1), separated},
  };
  for (const Relations& c : cases) {
    SCOPED_TRACE(::testing::Message() << "A " << c.a.center().transpose() << " | " << c.a.shape() << "\nB "
                                      << c.b.center().transpose() << " | " << c.b.shape());
    EXPECT_STREQ(name(exact_relation(c.a, c.b)), name(c.relation));
    EXPECT_STREQ(name(exact_relation(c.b, c.a)), name(c.relation));
    const ExactTangents exact = exact_inner_tangents(c.a, c.b);
    EXPECT_EQ(exact.relation, c.relation);
    EXPECT_EQ(exact.tangents.has_value(), c.relation == PlanarRelation::separated);
  }
}

TEST(ExactRelation, TakesTheFactorAsTheBody) {
  // S = F F^T is not a matrix of doubles here: with the rounded shape the circles would not touch.
  const double r = 1 + 0x1p-40;
  EXPECT_EQ(exact_relation(circle(0, 0, r), circle(2 * r, 0, r)), PlanarRelation::touching);
  const auto rounded = [&](double x) { return Ellipse::from_shape({x, 0}, circle(x, 0, r).shape()); };
  EXPECT_NE(exact_relation(rounded(0), rounded(2 * r)), PlanarRelation::touching);
}

/// The map M takes the circles (0; r1) and (d; r2) to ellipses with shape matrices r^2 M M^T, and their
/// tangents to those of the ellipses.
TEST(ExactTangents, AffineImagesOfCircles) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto integer = [&](int from, int to) {
      return from + static_cast<int>(random() % static_cast<std::uint64_t>(to - from + 1));
    };
    int m11, m12, m21, m22;
    do {
      m11 = integer(-30, 30), m12 = integer(-30, 30), m21 = integer(-30, 30), m22 = integer(-30, 30);
    } while (m11 * m22 == m12 * m21);
    const int r1 = integer(1, 9), r2 = seed % 4 == 0 ? r1 : integer(1, 9);
    int dx, dy;
    do {
      dx = integer(-60, 60), dy = integer(-60, 60);
    } while (dx * dx + dy * dy <= (r1 + r2) * (r1 + r2));
    const int x = integer(-1000, 1000), y = integer(-1000, 1000);

    const auto image = [&](int cx, int cy, int r) {
      const int r_2 = r * r;
      return of_shape(x + m11 * cx + m12 * cy, y + m21 * cx + m22 * cy, r_2 * (m11 * m11 + m12 * m12),
                      r_2 * (m11 * m21 + m12 * m22), r_2 * (m21 * m21 + m22 * m22));
    };
    const InnerTangents t = tangents_of(image(0, 0, r1), image(dx, dy, r2));

    const Wide d = sqrt(Wide(dx * dx + dy * dy)), half = asin(Wide(Wide(r1 + r2) / d)),
               mid = atan2(Wide(dy), Wide(dx));
    Wide edge_x[2], edge_y[2], contact_x[2], contact_y[2];  // right, left
    for (int side = 0; side < 2; ++side) {
      // A reflection swaps the edges.
      const int turn = (side == 0 ? -1 : 1) * (m11 * m22 > m12 * m21 ? 1 : -1);
      const Wide angle = mid + turn * half, c = cos(angle), s = sin(angle);
      edge_x[side] = m11 * c + m12 * s, edge_y[side] = m21 * c + m22 * s;
      const Wide px = r1 * turn * s, py = -r1 * turn * c;  // the contact with the circle about the origin
      contact_x[side] = x + m11 * px + m12 * py, contact_y[side] = y + m21 * px + m22 * py;
    }
    const Wide psi = angle_between(edge_x[0], edge_y[0], edge_x[1], edge_y[1]);
    expect_encloses(t.psi, psi);
    expect_encloses(t.right.direction, atan2(edge_y[0], edge_x[0]));
    expect_encloses(t.left.direction, atan2(edge_y[1], edge_x[1]));
    if (abs(t.theta_b.nearest()) > 0)
      expect_encloses(t.theta_b, wrapped(atan2(edge_y[0], edge_x[0]) + psi / 2));
    for (int side = 0; side < 2; ++side) {
      const InnerTangent& edge = side == 0 ? t.right : t.left;
      EXPECT_NEAR(edge.point_on_a[0].nearest(), double(contact_x[side]), 1e-12);
      EXPECT_NEAR(edge.point_on_a[1].nearest(), double(contact_y[side]), 1e-12);
    }
  }
}

TEST(ExactTangents, CongruentTranslatedEllipses) {
  // M = [2 1; 0 1] on unit circles at (0, 0) and (3, 0), then (0, 3): the outer tangents are a pair of
  // parallels.
  const InnerTangents t = tangents_of(of_shape(0, 0, 5, 1, 1), of_shape(6, 0, 5, 1, 1));
  const Wide s = Wide(2) / 3, c = sqrt(Wide(5)) / 3;  // sin, cos of the half opening
  expect_encloses(t.left.direction, atan2(s, Wide(2 * c + s)));
  expect_encloses(t.right.direction, atan2(Wide(-s), Wide(2 * c - s)));
}

TEST(ExactTangents, SwapTurnsTheDirectionsAround) {
  const Ellipse a = of_shape(1, 2, 5, 1, 3), b = of_shape(9, 4, 2, -1, 7);
  const InnerTangents ab = tangents_of(a, b), ba = tangents_of(b, a);
  EXPECT_EQ(ab.psi.lo(), ba.psi.lo());
  EXPECT_EQ(ab.psi.hi(), ba.psi.hi());
  EXPECT_NEAR(std::remainder(ab.theta_b.nearest() - ba.theta_b.nearest() - kPi, 2 * kPi), 0, 1e-15);
  EXPECT_NEAR(std::remainder(ab.left.direction.nearest() - ba.left.direction.nearest() - kPi, 2 * kPi), 0,
              1e-15);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(ab.left.point_on_a[i].nearest(), ba.left.point_on_b[i].nearest());
    EXPECT_EQ(ab.right.point_on_b[i].nearest(), ba.right.point_on_a[i].nearest());
  }
}

TEST(ExactTangents, TranslationChangesNoBit) {
  const Ellipse a = of_shape(0, 0, 5, 1, 3), b = of_shape(8, 2, 2, -1, 7);
  const InnerTangents here = tangents_of(a, b),
                      there = tangents_of(a.translated({1e9, -3e8}), b.translated({1e9, -3e8}));
  EXPECT_EQ(here.psi.parts(), there.psi.parts());
  EXPECT_EQ(here.theta_b.parts(), there.theta_b.parts());
}

}  // namespace
}  // namespace vericone::verify::exact_tangents_test
