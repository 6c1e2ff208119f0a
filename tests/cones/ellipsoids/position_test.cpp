// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include <array>
#include <iostream>
#include <limits>
#include <tuple>

#include "cones/ellipsoids/print_answers.h"
#include "support/campaign.h"

namespace vericone::position_test {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::moved_by_ulps, testing::RandomBodies, testing::share;

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

struct Shares {
  std::array<int, 3> rung{};
  std::array<int, 8> position{};
  int total() const { return rung[0] + rung[1] + rung[2]; }
  void print(const char* what) const {
    std::cout << "[ shares   ] " << what << ": triage " << rung[0] << ", interval " << rung[1] << ", exact "
              << rung[2] << "; positions";
    for (const int n : position) std::cout << ' ' << n;
    std::cout << '\n';
  }
};

/// Law (3): every rung that answers agrees with the last; laws (1) and (2).
template <int D>
Position checked(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Shares* shares = nullptr) {
  const Position exact = exact_position<D>(a, b);
  Rung rung{};
  EXPECT_EQ(position<D>(a, b, &rung), exact);
  EXPECT_EQ(triage_position<D>(a, b).value_or(exact), exact);
  EXPECT_EQ(interval_position<D>(a, b).value_or(exact), exact);
  EXPECT_EQ(triage_position<D>(a, b).has_value(), rung == Rung::triage);
  EXPECT_EQ(position<D>(b, a), swapped(exact)) << "law (1)";
  EXPECT_EQ(exact_position<D>(b, a), swapped(exact)) << "law (1)";
  EXPECT_EQ(relation_of(exact), exact_relation<D>(a, b)) << "law (2)";
  if (shares) {
    ++shares->rung[static_cast<int>(rung)];
    ++shares->position[static_cast<int>(exact)];
  }
  return exact;
}

template <int D>
void expect(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Position answer, Rung by) {
  EXPECT_EQ(checked<D>(a, b), answer);
  Rung rung{};
  position<D>(a, b, &rung);
  EXPECT_EQ(rung, by);
  for (const double scale : {0x1p-300, 0x1p7, 0x1p300}) {
    EXPECT_EQ(checked<D>(a.scaled(scale), b.scaled(scale)), answer) << "law (4), scale " << scale;
    position<D>(a.scaled(scale), b.scaled(scale), &rung);
    EXPECT_EQ(rung, by) << "scale " << scale;
  }
  const auto reflected = [](const BasicEllipsoid<D>& body) { return body.translated(-2 * body.center()); };
  EXPECT_EQ(checked<D>(reflected(a), reflected(b)), answer) << "law (4), reflection";
}

Ellipsoid sphere(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}
Ellipse circle(const Vector2d& center, double radius) {
  return Ellipse::from_axes(center, Vector2d::Constant(radius));
}

/// Two balls, by the numbers alone.
Position position_of_balls(const exact::Rational& distance2, const exact::Rational& ra,
                           const exact::Rational& rb) {
  if (distance2 == 0 && ra == rb) return Position::equal;
  const exact::Rational sum = ra + rb, difference = rb - ra;
  const int outer = distance2.compare(sum * sum), inner = distance2.compare(difference * difference);
  if (outer >= 0) return outer > 0 ? Position::disjoint : Position::touching;
  if (inner > 0) return Position::crossing;
  if (difference > 0) return inner < 0 ? Position::a_inside_b : Position::a_inside_b_touching;
  return inner < 0 ? Position::b_inside_a : Position::b_inside_a_touching;
}

TEST(Position, EveryRung) {
  const Ellipsoid unit = sphere({0, 0, 0}, 1);
  expect<3>(unit, sphere({3, 0, 0}, 1), Position::disjoint, Rung::triage);
  expect<3>(unit, sphere({1, 0, 0}, 1), Position::crossing, Rung::triage);
  expect<3>(unit, sphere({0.25, 0.25, 0}, 2), Position::a_inside_b, Rung::triage);
  expect<3>(sphere({0.25, 0.25, 0}, 2), unit, Position::b_inside_a, Rung::triage);
  expect<3>(unit, sphere({3, 4, 0}, 4), Position::touching, Rung::exact);
  expect<3>(unit, sphere({3, 4, 0}, 6), Position::a_inside_b_touching, Rung::exact);
  expect<3>(sphere({3, 4, 0}, 6), unit, Position::b_inside_a_touching, Rung::exact);
  expect<3>(unit, unit, Position::equal, Rung::exact);
  expect<2>(circle({0, 0}, 1), circle({3, 4}, 4), Position::touching, Rung::exact);
  expect<2>(circle({0, 0}, 1), circle({3, 4}, 6), Position::a_inside_b_touching, Rung::exact);
  expect<2>(circle({0, 0}, 1), circle({0.5, 0}, 2), Position::a_inside_b, Rung::triage);
  expect<2>(circle({0, 0}, 1), circle({0, 0}, 1), Position::equal, Rung::exact);
}

TEST(Position, TheMiddleRungDecidesWhatTheFirstLeaves) {
  const Ellipsoid big = sphere({0, 0, 0}, 4);
  // Off an exact tangency (offset 3, radius 1) by 2^-k: only intervals see the smaller ones.
  for (const auto& [off, side] : {std::pair{-0x1p-45, Position::a_inside_b}, {0x1p-45, Position::crossing}})
    expect<3>(sphere({3 + off, 0, 0}, 1), big, side, Rung::interval);
  for (const auto& [off, side] : {std::pair{-0x1p-51, Position::a_inside_b}, {0x1p-51, Position::crossing}})
    expect<3>(sphere({3 + off, 0, 0}, 1), big, side, Rung::exact);
  for (const auto& [off, side] : {std::pair{-0x1p-45, Position::crossing}, {0x1p-45, Position::disjoint}})
    expect<3>(sphere({5 + off, 0, 0}, 1), big, side, Rung::interval);
}

TEST(Position, BallsOfSmallIntegers) {
  // Every kind of position, most of them many times; mapped by one integer matrix they become general
  // homothetic ellipsoids.
  RandomBodies random(901);
  SCOPED_TRACE(random.trace());
  Shares space, plane;
  for (int i = 0; i < 1000; ++i) {
    const auto small = [&] { return random.coin() ? random.integer(-4, 4) : random.integer(-1, 1); };
    const Vector3d p(small(), small(), small());
    const Vector3d q = i % 16 == 0 ? p : Vector3d(small(), small(), small());
    const int ra = random.integer(1, 6), rb = random.integer(1, 6);
    const Position truth =
        position_of_balls(static_cast<int>((q - p).squaredNorm()), exact::Rational(ra), exact::Rational(rb));
    Matrix3d m;
    do
      for (int k = 0; k < 9; ++k) m(k) = random.integer(-3, 3);
    while (m.col(0).dot(m.col(1).cross(m.col(2))) == 0);
    ASSERT_EQ(checked<3>(sphere(p, ra), sphere(q, rb), &space), truth) << "case " << i;
    const Matrix3d s = m * m.transpose();
    ASSERT_EQ(checked<3>(Ellipsoid::from_shape(m * p, ra * ra * s), Ellipsoid::from_shape(m * q, rb * rb * s),
                         &space),
              truth)
        << "case " << i;
    const Vector2d p2(p.x(), p.y()), q2(q.x(), q.y());
    const Position planar = position_of_balls(static_cast<int>((q2 - p2).squaredNorm()), exact::Rational(ra),
                                              exact::Rational(rb));
    ASSERT_EQ(checked<2>(circle(p2, ra), circle(q2, rb), &plane), planar) << "case " << i;
    const Matrix2d m2 = (Matrix2d() << 2, 1, -1, random.integer(0, 5)).finished(), s2 = m2 * m2.transpose();
    ASSERT_EQ(checked<2>(Ellipse::from_shape(m2 * p2, ra * ra * s2),
                         Ellipse::from_shape(m2 * q2, rb * rb * s2), &plane),
              planar)
        << "case " << i;
  }
  space.print("balls and homothetic ellipsoids");
  plane.print("circles and homothetic ellipses");
  for (int k = 0; k < 8; ++k) {
    EXPECT_GT(space.position[k], 5) << to_string(static_cast<Position>(k));
    EXPECT_GT(plane.position[k], 5) << to_string(static_cast<Position>(k));
  }
}

/// The body with a diagonal shape, mapped by `m`.
template <int D>
BasicEllipsoid<D> image(const Matrix<D>& m, const Vector<D>& center, const Vector<D>& squared_axes) {
  return BasicEllipsoid<D>::from_shape(m * center, m * squared_axes.asDiagonal() * m.transpose());
}

TEST(Position, EllipseAndCircleTangentFromInside) {
  // x^2/25 + y^2/9 = 1: curvature radius 9/5 at the ends of the long axis. Squared radii are dyadic.
  std::array<Matrix2d, 3> maps;
  maps[0] << 1, 0, 0, 1;
  maps[1] << 2, 1, -1, 3;
  maps[2] << 5, 8, 8, 13;
  for (const Matrix2d& m : maps) {
    const Ellipse host = image<2>(m, {0, 0}, {25, 9});
    const auto ball = [&](double x, double y, double radius2) {
      return checked<2>(image<2>(m, {x, y}, Vector2d::Constant(radius2)), host);
    };
    EXPECT_EQ(ball(4, 0, 1), Position::a_inside_b_touching) << "one point, curved more";
    EXPECT_EQ(ball(3.5, 0, 2.25), Position::a_inside_b_touching);
    EXPECT_EQ(ball(3, 0, 4), Position::crossing) << "tangent, but curved less";
    EXPECT_EQ(ball(0, 1, 4), Position::a_inside_b_touching) << "at the flat end";
    EXPECT_EQ(ball(0, 0, 9), Position::a_inside_b_touching) << "two points, concentric";
    EXPECT_EQ(ball(0, 0, 25), Position::b_inside_a_touching) << "two points, around it";
    EXPECT_EQ(ball(2, 0, 6.75), Position::a_inside_b_touching) << "two points, excentric";
    EXPECT_EQ(ball(-3, 0, 3.9375), Position::a_inside_b_touching);
    // Where the map leaves them exact, the neighbouring doubles; else 2^-38 away.
    for (int ulps = 1; ulps <= 8; ++ulps) {
      const auto moved = [&](double x, int count) {
        return m.isIdentity(0) ? moved_by_ulps(x, count) : x + count * 0x1p-38;
      };
      EXPECT_EQ(ball(2, 0, moved(6.75, ulps)), Position::crossing) << ulps;
      EXPECT_EQ(ball(2, 0, moved(6.75, -ulps)), Position::a_inside_b) << ulps;
      EXPECT_EQ(ball(moved(4, ulps), 0, 1), Position::crossing) << ulps;
      EXPECT_EQ(ball(moved(4, -ulps), 0, 1), Position::a_inside_b) << ulps;
      EXPECT_EQ(ball(0, 0, moved(9, ulps)), Position::crossing) << ulps;
      EXPECT_EQ(ball(0, 0, moved(9, -ulps)), Position::a_inside_b) << ulps;
    }
  }
}

TEST(Position, OsculatingCircle) {
  // Semi-axes 4 and 2: curvature radius 1 at (4, 0). There three of the four common points meet.
  const Ellipse host = Ellipse::from_axes({0, 0}, {4, 2});
  EXPECT_EQ(checked<2>(circle({3, 0}, 1), host), Position::a_inside_b_touching);
  for (int k = 1; k <= 40; k += 3) {
    const double more = std::ldexp(1.0, -k);
    EXPECT_EQ(checked<2>(circle({3 - more, 0}, 1 + more), host), Position::crossing) << k;
    EXPECT_EQ(checked<2>(circle({3 + more, 0}, 1 - more), host), Position::a_inside_b_touching) << k;
    EXPECT_EQ(checked<2>(circle({3 - more, 0}, 1), host), Position::a_inside_b) << k;
    EXPECT_EQ(checked<2>(circle({3 + more, 0}, 1), host), Position::crossing) << k;
  }
}

TEST(Position, EllipsoidAndBallTangentFromInside) {
  Matrix3d general;
  general << 2, 1, 0, -1, 3, 1, 1, 0, 2;
  for (const Matrix3d& m : {Matrix3d(Matrix3d::Identity()), general})
    for (const double third : {9., 16.}) {  // a circle of tangency, or two points
      const Ellipsoid host = image<3>(m, {0, 0, 0}, {25, 9, third});
      const auto ball = [&](double x, double y, double radius2) {
        return checked<3>(image<3>(m, {x, y, 0}, Vector3d::Constant(radius2)), host);
      };
      EXPECT_EQ(ball(2, 0, 6.75), Position::a_inside_b_touching);
      EXPECT_EQ(ball(4, 0, 1), Position::a_inside_b_touching);
      EXPECT_EQ(ball(3, 0, 4), Position::crossing);
      EXPECT_EQ(ball(0, 0, 9), Position::a_inside_b_touching);
      EXPECT_EQ(ball(0, 1, 4), Position::a_inside_b_touching);
      EXPECT_EQ(ball(0, 0, 25), Position::b_inside_a_touching);
      for (int ulps = 1; ulps <= 8; ++ulps) {
        const double step = m.isIdentity(0) ? moved_by_ulps(6.75, ulps) - 6.75 : ulps * 0x1p-38;
        EXPECT_EQ(ball(2, 0, 6.75 + step), Position::crossing) << ulps;
        EXPECT_EQ(ball(2, 0, 6.75 - step), Position::a_inside_b) << ulps;
      }
    }
  // Concentric, contact on a whole circle, in a plane, and a common axis longer than the host's.
  const Ellipsoid host = Ellipsoid::from_axes({1, 2, 3}, {5, 3, 3});
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1, 2, 3}, {4, 3, 3}), host), Position::a_inside_b_touching);
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1, 2, 3}, {5, 3, 2}), host), Position::a_inside_b_touching);
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1, 2, 3}, {6, 3, 2}), host), Position::crossing);
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1, 2, 3}, {5, 3, 3}), host), Position::equal);
  EXPECT_EQ(
      checked<3>(Ellipsoid::from_shape({1, 2, 3}, Vector3d(25, 9, 9).asDiagonal().toDenseMatrix()), host),
      Position::equal)
      << "given by shape and by factor";
  // Equal extent across, moved along or across: a pencil that is singular at one.
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1.5, 2, 3}, {4, 3, 3}), host), Position::crossing);
  EXPECT_EQ(checked<3>(Ellipsoid::from_axes({1, 2.5, 3}, {4, 3, 3}), host), Position::crossing);
}

TEST(Position, TangentAtOnePointInGeneralPosition) {
  // A ball within the unit ball touching it at e_3, squeezed across e_3, is still inside and touches there.
  // The numbers are small multiples of 2^-4; an integer matrix takes it to general position.
  RandomBodies random(902);
  SCOPED_TRACE(random.trace());
  Shares tangent, near;
  for (int i = 0; i < 400; ++i) {
    Matrix3d m;
    do
      for (int k = 0; k < 9; ++k) m(k) = random.integer(-3, 3);
    while (m.col(0).dot(m.col(1).cross(m.col(2))) == 0);
    const double r = random.integer(1, 15) / 16., qx = random.integer(1, 16) / 16.,
                 qy = random.integer(1, 16) / 16.;
    const Vector3d home(random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9));
    const Vector3d squares(r * r * qx * qx, r * r * qy * qy, r * r), lift(0, 0, 1 - r);
    const double scale = std::ldexp(1.0, random.integer(-300, 300));
    const auto body = [&](const Vector3d& center, const Vector3d& s) {
      return image<3>(scale * m, center, s);
    };
    const Ellipsoid host = body(home, Vector3d::Ones()), guest = body(home + lift, squares);
    ASSERT_EQ(checked<3>(guest, host, &tangent), Position::a_inside_b_touching) << "case " << i;
    // Its exact neighbours along the common normal.
    const double step = std::ldexp(1.0, -random.integer(5, 40));
    ASSERT_EQ(checked<3>(body(home + lift - Vector3d(0, 0, step), squares), host, &near),
              Position::a_inside_b)
        << "case " << i;
    ASSERT_EQ(checked<3>(body(home + lift + Vector3d(0, 0, step), squares), host, &near), Position::crossing)
        << "case " << i;
  }
  tangent.print("tangent from inside");
  near.print("off by 2^-5 to 2^-40");
  EXPECT_EQ(tangent.rung[2], tangent.total()) << "no lower rung may answer a degenerate position";
  EXPECT_GT(near.rung[0], near.total() / 2);
}

/// Least (h_B(n) - h_A(n)) / rho_A(n), by sampling and descent: an upper bound that is close.
template <int D>
double least_margin(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, RandomBodies& random) {
  const Matrix<D> to_normal = a.factor().inverse().transpose();
  const auto margin = [&](const Vector<D>& u) {
    const Vector<D> n = to_normal * u;
    return n.dot(b.center() - a.center()) + b.radius(n) - 1;
  };
  const auto direction = [&]() -> Vector<D> {
    if constexpr (D == 2)
      return random.direction_2d();
    else
      return random.direction();
  };
  double least_of_all = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 3; ++start) {
    Vector<D> best = direction();
    double least = margin(best);
    const auto improve = [&](const Vector<D>& u) {
      const double value = margin(u);
      if (value < least) {
        least = value;
        best = u;
      }
    };
    for (int i = 0; i < 150; ++i) improve(direction());
    for (double step = 0.3; step > 1e-6; step *= 0.8)
      for (int i = 0; i < 5; ++i) improve((best + step * direction()).normalized());
    least_of_all = std::min(least_of_all, least);
  }
  return least_of_all;
}

template <int D>
void compare_with_supports(RandomBodies& random, int cases, Shares& shares) {
  int near = 0;
  for (int i = 0; i < cases; ++i) {
    const double low = i % 3 == 0 ? 0.03 : 1, high = low == 1 ? 10 : 1;
    auto [a, b] = [&] {
      if constexpr (D == 2)
        return random.planar_scaled_from_touching(low, high, random.uniform(0, 1.2));
      else
        return random.scaled_from_touching(low, high, random.uniform(0, 1.2));
    }();
    if (i % 4 != 0) {
      const Vector<D> p = b.center();
      b = b.translated(-p).scaled(random.log_uniform(1, 30)).translated(p);
    }
    if (random.coin()) std::swap(a, b);
    const Position answer = checked<D>(a, b, &shares);
    if (relation<D>(a, b) != Relation::overlapping) continue;
    const double ab = least_margin<D>(a, b, random), ba = least_margin<D>(b, a, random);
    // A negative margin is a proof; a positive one is an upper bound of the least, close for bodies that are
    // not thin.
    ASSERT_FALSE(ab < -1e-9 && answer == Position::a_inside_b) << "case " << i << ", margin " << ab;
    ASSERT_FALSE(ba < -1e-9 && answer == Position::b_inside_a) << "case " << i << ", margin " << ba;
    if (low < 1) continue;
    constexpr double kTolerance = 1e-3;
    if ((ab > 0 && ab < kTolerance) || (ba > 0 && ba < kTolerance)) {
      ++near;
      continue;
    }
    ASSERT_EQ(answer, ab > 0   ? Position::a_inside_b
                      : ba > 0 ? Position::b_inside_a
                               : Position::crossing)
        << "case " << i << ", margins " << ab << ' ' << ba;
  }
  EXPECT_LT(near, cases / 20);
}

TEST(Position, AgreesWithTheSupportFunctions) {
  RandomBodies random(903);
  SCOPED_TRACE(random.trace());
  Shares plane, space;
  ASSERT_NO_FATAL_FAILURE(compare_with_supports<2>(random, share(2000), plane));
  ASSERT_NO_FATAL_FAILURE(compare_with_supports<3>(random, share(1500), space));
  plane.print("random ellipses");
  space.print("random ellipsoids");
  for (const Shares* s : {&plane, &space}) {
    for (const Position p :
         {Position::disjoint, Position::crossing, Position::a_inside_b, Position::b_inside_a})
      EXPECT_GT(s->position[static_cast<int>(p)], s->total() / 40) << to_string(p);
    EXPECT_GT(s->rung[0], s->total() * 999 / 1000);
  }
}

/// Scales A about its centre until it just fits in B, then moves a factor or two by ulps.
template <int D>
void check_within_roundings(RandomBodies& random, double low, int cases, Shares& shares) {
  for (int i = 0; i < cases; ++i) {
    auto [a, b] = [&] {
      if constexpr (D == 2)
        return random.planar_scaled_from_touching(low, 1, random.uniform(0, 0.3));
      else
        return random.scaled_from_touching(low, 1, random.uniform(0, 0.3));
    }();
    const Vector<D> axes = a.semi_axes();
    const Vector<D> p = a.center(), q = b.center();
    b = b.translated(-q).scaled(4).translated(q);
    // The largest factor by bisection on the answer itself; only the neighbourhood matters.
    const auto grown = [&a = a, &p](double factor) { return a.translated(-p).scaled(factor).translated(p); };
    double fits = 0, sticks_out = 8 / axes.maxCoeff() * b.semi_axes().maxCoeff();
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (fits + sticks_out);
      if (mid == fits || mid == sticks_out || mid == 0) break;
      const Position now = position<D>(grown(mid), b);
      (now == Position::a_inside_b || now == Position::a_inside_b_touching ? fits : sticks_out) = mid;
    }
    if (!(fits > 0x1p-40)) continue;  // A's centre is outside B
    for (const int ulps : {-8, -1, 0, 1, 8}) {
      checked<D>(grown(moved_by_ulps(fits, ulps)), b, &shares);
      if (::testing::Test::HasFailure()) FAIL() << "case " << i;
    }
  }
}

TEST(Position, RungsAgreeWithinRoundingsOfInternalTangency) {
  RandomBodies random(904);
  SCOPED_TRACE(random.trace());
  for (const double low : {0.1, 1e-6}) {
    Shares plane, space;
    ASSERT_NO_FATAL_FAILURE(check_within_roundings<2>(random, low, 100, plane));
    ASSERT_NO_FATAL_FAILURE(check_within_roundings<3>(random, low, 60, space));
    plane.print("ellipses within 8 ulps of a tangency");
    space.print("ellipsoids within 8 ulps of a tangency");
    for (const Shares* s : {&plane, &space}) {
      EXPECT_GT(s->total(), 100);
      EXPECT_GT(s->position[static_cast<int>(Position::a_inside_b)], s->total() / 10);
      EXPECT_GT(s->position[static_cast<int>(Position::crossing)], s->total() / 10);
    }
  }
}

TEST(Position, EveryRatioOfSizes) {
  // From 1e-140 beside 1e140 to nearly equal.
  RandomBodies random(905);
  SCOPED_TRACE(random.trace());
  Shares shares;
  for (int i = 0; i < 400; ++i) {
    const double sa = random.log_uniform(1e-140, 1e140),
                 sb = i % 2 ? random.log_uniform(1e-140, 1e140) : sa * random.log_uniform(1e-9, 1e9);
    const double larger = std::max(sa, sb);
    const Ellipsoid a = random.ellipsoid({0, 0, 0}, 0.5, 1).scaled(sa),
                    b = random.ellipsoid({0, 0, 0}, 0.5, 1)
                            .scaled(sb)
                            .translated((i % 3 ? random.uniform(0, 2) * larger : 0.) * random.direction());
    checked<3>(a, b, &shares);
    if (HasFailure()) FAIL() << "case " << i << " sizes " << sa << ' ' << sb;
  }
  shares.print("sizes 1e-140 to 1e140");
  EXPECT_GT(shares.rung[0], 150);
}

TEST(Position, IsTransitive) {
  // Law (5) on chains of a body, and of two that hold it nearly tightly.
  RandomBodies random(906);
  SCOPED_TRACE(random.trace());
  const auto inside = [](Position p) {
    return p == Position::a_inside_b || p == Position::a_inside_b_touching || p == Position::equal;
  };
  int chains = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ellipse a = random.ellipse({random.uniform(-1, 1), random.uniform(-1, 1)}, 0.5, 1);
    const Ellipse b = random.ellipse({random.uniform(-1, 1), random.uniform(-1, 1)}, 1.5, 3);
    const Ellipse c = random.ellipse({random.uniform(-1, 1), random.uniform(-1, 1)}, 3, 6);
    if (!inside(position<2>(a, b)) || !inside(position<2>(b, c))) continue;
    ++chains;
    ASSERT_EQ(position<2>(a, c), Position::a_inside_b) << "case " << i;
  }
  EXPECT_GT(chains, 100);
}

TEST(Position, RationalBodies) {
  using exact::Rational, exact::RationalBody;
  // Thirds: what doubles cannot hold.
  const auto ball = [](const Rational& x, const Rational& y, const Rational& r) {
    RationalBody<2> body;
    body.center = {x, y};
    body.shape = {{{r * r, 0}, {0, r * r}}};
    return body;
  };
  const auto unit = ball(0, 0, 1);
  EXPECT_EQ(exact::position<2>(ball(Rational(1, 5), Rational(4, 15), Rational(2, 3)), unit),
            Position::a_inside_b_touching);
  EXPECT_EQ(exact::position<2>(unit, ball(Rational(1, 5), Rational(4, 15), Rational(2, 3))),
            Position::b_inside_a_touching);
  EXPECT_EQ(exact::position<2>(ball(Rational(1, 5), Rational(4, 15),
                                    Rational("666666666666666666667/1000000000000000000000")),
                               unit),
            Position::crossing);
  EXPECT_EQ(exact::position<2>(ball(Rational(1, 3), 0, Rational(1, 3)), unit), Position::a_inside_b);
  EXPECT_EQ(exact::position<2>(ball(Rational(4, 3), 0, Rational(1, 3)), unit), Position::touching);
  EXPECT_EQ(exact::position<2>(unit, unit), Position::equal);
  RationalBody<3> a, b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      a.shape[i][j] = i == j ? 1 : 0;
      b.shape[i][j] = i == j ? Rational(1, 9) : Rational(0);
    }
  b.center = {Rational(2, 3), 0, 0};
  EXPECT_EQ(exact::position<3>(b, a), Position::a_inside_b_touching);
  b.shape[2][2] = 0;
  EXPECT_THROW((void)exact::position<3>(b, a), InputError) << "a disc is no ellipsoid";
  b.shape[2][2] = Rational(1, 9);
  b.shape[0][1] = Rational(1, 90);
  EXPECT_THROW((void)exact::relation<3>(b, a), InputError) << "not symmetric";
  EXPECT_THROW((void)exact::membership(a, RationalBody<3>(), {Rational(1), Rational(0), Rational(0)}),
               InputError);
}

}  // namespace
}  // namespace vericone::position_test
