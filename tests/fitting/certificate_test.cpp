// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/fitting/hull.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <vericone/testing/random_bodies.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "proof/quadratic_form.h"
#include "proof/triangle_form.h"

namespace vericone::fitting::certificate_test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using exact::Rational;
using ::testing::ElementsAre;
using testing::RandomBodies;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Pieces = std::vector<std::vector<Quadric>>;

Quadric diagonal(double x, double y, double z, double w) {
  return Quadric(Vector4d(x, y, z, w).asDiagonal().toDenseMatrix());
}

Sample cloud(std::vector<Vector3d> points) { return {std::move(points), {}}; }
Sample triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return {{a, b, c}, {{0, 1, 2}}}; }
bool contains(const Pieces& pieces, const Sample& one) {
  const Certificate c = check(pieces, one);
  return c.all_inside();
}

/// The criterion with square roots (Hadeler 1983; Chang and Sederberg 1994), with fifty digits: what is
/// below 1e-40 is zero for small integers.
bool copositive_by_roots(const std::array<std::array<int, 3>, 3>& m) {
  using Wide = boost::multiprecision::cpp_bin_float_50;
  const Wide tiny("-1e-40");
  const auto root = [&](int i) { return Wide(sqrt(Wide(m[i][i]))); };
  Wide product = 2, sum = root(0) * root(1) * root(2);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Wide edge = m[i][j] + root(i) * root(j);
    if (edge < tiny) return false;
    product *= edge < 0 ? Wide(0) : edge;
    sum += m[i][j] * root(k);
  }
  return sum + sqrt(product) >= tiny;
}

TEST(TriangleForm, AgreesWithTheCriterionInRootsOnAllSmallIntegers) {
  int yes = 0, no_by_inside = 0, unsure = 0, count = 0;
  std::array<std::array<int, 3>, 3> m{};
  const auto each = [&](int low, int high, int& entry, const auto& then) {
    for (entry = low; entry <= high; ++entry) then();
  };
  int a = 0, b = 0, c = 0, x = 0, y = 0, z = 0;
  each(0, 4, a, [&] {
    each(0, 4, b, [&] {
      each(0, 4, c, [&] {
        each(-4, 4, x, [&] {
          each(-4, 4, y, [&] {
            each(-4, 4, z, [&] {
              m = {{{a, x, z}, {x, b, y}, {z, y, c}}};
              exact::IntegerMatrix<3> integers;
              exact::RationalMatrix<3> rationals;
              std::array<std::array<Interval, 3>, 3> intervals;
              for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                  integers[i][j] = -m[i][j];
                  rationals[i][j] = Rational(-m[i][j]);
                  intervals[i][j] = Interval(-m[i][j], 1e-9);
                }
              const bool expected = copositive_by_roots(m);
              ASSERT_EQ(not_positive(integers), expected ? Known::yes : Known::no)
                  << a << b << c << " " << x << " " << y << " " << z;
              ASSERT_EQ(greatest_value(rationals) <= 0, expected)
                  << a << b << c << " " << x << " " << y << " " << z;
              const Known k = not_positive(intervals);
              if (k != Known::unsure) {
                ASSERT_EQ(k == Known::yes, expected);
              }
              ++count;
              yes += expected;
              unsure += k == Known::unsure;
              no_by_inside += !expected && x * x <= a * b && y * y <= b * c && z * z <= a * c;
            });
          });
        });
      });
    });
  });
  EXPECT_EQ(count, 91125);
  EXPECT_GT(yes, 10000);
  EXPECT_GT(no_by_inside, 1000);  // what corners and edges do not tell
  EXPECT_LT(unsure, count / 2);   // those with zeros
}

TEST(TriangleForm, GreatestValueIsTheLeastBound) {
  RandomBodies random(61);
  SCOPED_TRACE(random.trace());
  for (int n = 0; n < 500; ++n) {
    exact::RationalMatrix<3> c;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) c[i][j] = c[j][i] = Rational(random.integer(-50, 50), 7);
    const Rational greatest = greatest_value(c);
    Rational sampled = c[0][0];
    constexpr int kGrid = 12;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; i + j <= kGrid; ++j) {
        const std::array<Rational, 3> l{Rational(i, kGrid), Rational(j, kGrid),
                                        Rational(kGrid - i - j, kGrid)};
        Rational value = 0;
        for (std::size_t r = 0; r < 3; ++r)
          for (std::size_t s = 0; s < 3; ++s) value += l[r] * c[r][s] * l[s];
        sampled = std::max(sampled, value);
      }
    ASSERT_GE(greatest, sampled);
    // A grid point is within 1/12 of the greatest in each coordinate, where the gradient vanishes along the
    // free directions: the loss is of second order, entries up to 8, at most 8 * 9 / 144 in all.
    ASSERT_LE(greatest - sampled, Rational(1, 2));
  }
}

/// A point of the triangle where the quadric is positive, by halving the triangle where the greatest entry of
/// its form (which bounds it) is positive.
std::optional<exact::RationalVector<3>> witness(const exact::RationalMatrix<4>& q,
                                                std::array<exact::RationalVector<3>, 3> t, int depth) {
  for (const auto& x : t)
    if (exact::side<3>(q, x) == Sign::positive) return x;
  if (depth == 0) return std::nullopt;
  Rational most = 0, longest = -1;
  std::size_t cut = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    Rational polar = 0, length = 0;
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t s = 0; s < 4; ++s)
        polar += (r < 3 ? t[i][r] : Rational(1)) * q[r][s] * (s < 3 ? t[j][s] : Rational(1));
    most = std::max(most, polar);
    for (std::size_t r = 0; r < 3; ++r) length += (t[i][r] - t[j][r]) * (t[i][r] - t[j][r]);
    if (length > longest) {
      longest = length;
      cut = i;
    }
  }
  if (most <= 0) return std::nullopt;
  exact::RationalVector<3> middle;
  for (std::size_t r = 0; r < 3; ++r) middle[r] = (t[cut][r] + t[(cut + 1) % 3][r]) / 2;
  auto first = t, second = t;
  first[cut] = middle;
  second[(cut + 1) % 3] = middle;
  if (auto w = witness(q, first, depth - 1)) return w;
  return witness(q, second, depth - 1);
}

bool contains(const Interval& interval, const Rational& x) {
  return Rational(interval.mid()) - Rational(interval.rad()) <= x &&
         x <= Rational(interval.mid()) + Rational(interval.rad());
}

TEST(QuadraticForm, IntervalsContainWhatIntegersSay) {
  RandomBodies random(60);
  SCOPED_TRACE(random.trace());
  double widest = 0;
  for (int n = 0; n < 2000; ++n) {
    // Many zeros, so that there are cylinders, planes and forms without a square: 2 x y.
    Matrix4d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j)
        m(i, j) = m(j, i) = random.coin() ? 0 : random.log_uniform(1e-6, 1e6) * (random.coin() ? 1 : -1);
    if (m.isZero()) continue;
    const Vector3d near = random.in_box(10);
    const QuadraticForm form(Quadric(m), near);
    const std::array<Vector3d, 3> x{near + random.in_box(1e-3), random.in_box(10), near};
    const auto exact = form.exact_polars<3>(x);
    for (std::size_t i = 0; i < 3; ++i) {
      Rational value = 0;  // by the definition
      const Vector4d h = x[i].homogeneous();
      for (int r = 0; r < 4; ++r)
        for (int s = 0; s < 4; ++s) value += Rational(h(r)) * Rational(m(r, s)) * Rational(h(s));
      ASSERT_EQ(form.number(exact.form[i][i], exact.exponent), value);
      ASSERT_TRUE(contains(form.at(x[i]).value, value));
      ASSERT_TRUE(contains(form.narrowly_at(x[i]).value, value));
      widest = std::max(widest, form.narrowly_at(x[i]).value.rad() / (m.cwiseAbs().maxCoeff() * 300));
      for (std::size_t j = 0; j < 3; ++j)
        ASSERT_TRUE(contains(QuadraticForm::polar(form.at(x[i]), form.at(x[j])),
                             form.number(exact.form[i][j], exact.exponent)));
    }
  }
  EXPECT_LT(widest, 1e-13);
}

TEST(Certificate, TrianglesOfQuadricsOfAllKindsAgainstHalvingInRationals) {
  RandomBodies random(62);
  SCOPED_TRACE(random.trace());
  int inside = 0, outside = 0, corners_inside_only = 0;
  for (int n = 0; n < 3000; ++n) {
    Matrix4d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) m(i, j) = m(j, i) = random.integer(-5, 5);
    m(3, 3) = random.integer(-20, 0);
    if (m.isZero()) continue;
    const double scale = std::ldexp(1.0, random.integer(-3, 0));
    const auto corner = [&] {
      return Vector3d(scale * Vector3d(random.integer(-9, 9), random.integer(-9, 9), random.integer(-9, 9)));
    };
    const Sample sample = triangle(corner(), corner(), corner());
    const Certificate c = check({{Quadric(m)}}, sample);
    std::array<exact::RationalVector<3>, 3> t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = exact::to_rational<3>(sample.points[i]);
    // Deep enough for what is positive somewhere: integers at most 5 * 9 * 9 in eighths leave no smaller
    // bumps.
    const bool found = witness(exact::to_rational<4>(m), t, c.triangles_inside ? 7 : 16).has_value();
    ASSERT_EQ(c.triangles_inside, found ? 0U : 1U) << m << "\n"
                                                   << sample.points[0].transpose() << "\n"
                                                   << sample.points[1].transpose() << "\n"
                                                   << sample.points[2].transpose();
    ++(found ? outside : inside);
    corners_inside_only += found && c.points_inside == 3;
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
  EXPECT_GT(corners_inside_only, 50);
}

/// x -> T x + by as a map of quadrics, exact for small integers: T is unimodular.
Quadric moved(const Quadric& q, const Eigen::Matrix3d& inverse, const Vector3d& by) {
  Matrix4d back = Matrix4d::Identity();
  back.topLeftCorner<3, 3>() = inverse;
  back.topRightCorner<3, 1>() = -inverse * by;
  return Quadric(back.transpose() * q.matrix() * back);
}

TEST(Certificate, TrianglesThatTouchExactlyAreInside) {
  const Quadric cups = diagonal(1, -1, -1, -1);  // x^2 - y^2 - z^2 <= 1: a dent ends at (1, 0, 0)
  const Quadric waist = diagonal(-1, 1, 1, -1);  // narrowest at x = 0, circle of radius 1
  Eigen::Matrix3d shear, inverse;
  shear << 1, 2, -1, 0, 1, 3, 0, 0, 1;
  inverse << 1, -2, 7, 0, 1, -3, 0, 0, 1;
  ASSERT_EQ(shear * inverse, Eigen::Matrix3d::Identity());
  struct Case {
    Quadric quadric;
    Vector3d a, b, c, outwards;
  };
  const Case cases[] = {
      {cups, {1, -1, -1}, {1, 2, -1}, {1, -1, 2}, {1, 0, 0}},  // its plane touches inside
      {cups, {1, -1, 0}, {1, 2, 0}, {0, 0, 5}, {1, 0, 0}},     // an edge touches
      {cups, {1, 0, 0}, {0, 3, 1}, {0, 1, 4}, {1, 0, 0}},      // a corner touches
      {waist, {-1, 1, 0}, {2, 1, 0}, {0, 0, 0}, {0, 1, 0}},    // an edge touches the waist
  };
  for (const Case& k : cases)
    for (const Vector3d& by : {Vector3d(0, 0, 0), Vector3d(1 << 12, -(1 << 11), 3 << 10)}) {
      const auto place = [&](const Vector3d& x) { return Vector3d(shear * x + by); };
      const Pieces piece{{moved(k.quadric, inverse, by)}};
      const Certificate c = check(piece, triangle(place(k.a), place(k.b), place(k.c)));
      EXPECT_TRUE(c.all_inside());
      EXPECT_GT(c.by_exact, 0U);
      // The smallest step that is exact in all of these coordinates, outwards and inwards.
      const Vector3d step = 0x1p-40 * k.outwards;
      EXPECT_FALSE(contains(piece, triangle(place(k.a + step), place(k.b + step), place(k.c + step))));
      EXPECT_TRUE(contains(piece, triangle(place(k.a - step), place(k.b - step), place(k.c - step))));
    }
  // One rounding outwards.
  const double beyond = std::nextafter(1, 2);
  const Certificate out = check({{cups}}, triangle({beyond, -1, -1}, {beyond, 2, -1}, {beyond, -1, 2}));
  EXPECT_EQ(out.points_inside, 3U);
  EXPECT_EQ(out.triangles_inside, 0U);
}

TEST(Certificate, OnePointMovedByOneRoundingIsRefused) {
  const Pieces ball{{diagonal(1, 1, 1, -25)}};
  std::vector<Vector3d> points{{3, 4, 0}, {0, 0, 5}, {1, 1, 1}, {-4, 0, 3}};
  const Certificate c = check(ball, cloud(points));
  EXPECT_TRUE(c.all_inside());
  EXPECT_EQ(c.points, 4U);
  EXPECT_EQ(c.by_exact, 3U);
  EXPECT_THAT(c.touching, ElementsAre(0, 1, 3));
  points[0].x() = std::nextafter(3, 4);
  const Certificate refused = check(ball, cloud(points));
  EXPECT_EQ(refused.points_inside, 3U);
  EXPECT_FALSE(refused.all_inside());
  EXPECT_EQ(refused.coverage(), 0.75);
  points[0].x() = std::nextafter(3, 2);
  EXPECT_TRUE(check(ball, cloud(points)).all_inside());
}

TEST(Certificate, CountsWhatTheExactSideCounts) {
  RandomBodies random(63);
  SCOPED_TRACE(random.trace());
  for (const double far : {0.0, 10.0, 5e6}) {
    const Ellipsoid body = random.ellipsoid(far * random.direction(), 0.2, 2);
    Piece piece;
    piece.body = body;
    set_quadrics(piece);
    const Quadric q = piece.quadrics[0];
    std::vector<Vector3d> points;
    std::size_t inside = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vector3d x = body.support_point(random.direction());
      const double by = random.log_uniform(1e-17, 1e-2) * (random.coin() ? 1 : -1);
      points.push_back(x + by * (x - body.center()));
      inside += exact_side<3>(q, points.back()) != Sign::positive;
    }
    const Certificate c = check({{q}}, cloud(points));
    EXPECT_EQ(c.points_inside, inside);
    EXPECT_EQ(c.points, 3000U);
    EXPECT_GT(inside, 500U);
    EXPECT_LT(inside, 2900U);
  }
}

TEST(Certificate, UnionsContainTrianglesOnlyWithinOnePiece) {
  const auto ball = [](double x) {
    Matrix4d m = Matrix4d::Identity();
    m(0, 3) = m(3, 0) = -x;
    m(3, 3) = x * x - 4;
    return std::vector<Quadric>{Quadric(m)};
  };
  const Pieces pieces{ball(-1), ball(1)};  // radius 2
  // One in the first, one in the second, one across both whose corners are all inside.
  const Sample mesh{{{-2, 0, 0}, {-2, 1, 0}, {-1, 0, 1}, {2, 0, 0}, {2, 1, 0}, {1, 0, 1}, {9, 9, 9}},
                    {{{0, 1, 2}}, {{3, 4, 5}}, {{0, 3, 5}}}};
  const Certificate c = check(pieces, mesh);
  EXPECT_EQ(c.points, 6U);  // the outlier belongs to no triangle
  EXPECT_EQ(c.points_inside, 6U);
  EXPECT_EQ(c.triangles, 3U);
  EXPECT_EQ(c.triangles_inside, 2U);
  EXPECT_FALSE(c.all_inside());
  EXPECT_EQ(check(pieces, cloud(mesh.points)).points_inside, 6U);
  EXPECT_EQ(check({pieces[0]}, mesh).points_inside, 3U);
  // On the surface of the first, deep in the second: not touching the hull.
  EXPECT_TRUE(check(pieces, cloud({{1, 0, 0}})).touching.empty());
  EXPECT_THAT(check(pieces, cloud({{-3, 0, 0}, {1, 0, 0}})).touching, ElementsAre(0));
}

/// Largest margin that is certified, by halving.
double largest_margin(const std::vector<Quadric>& piece, const Vector3d& x) {
  double low = 0, high = 100;
  for (int i = 0; i < 100; ++i) {
    const double m = 0.5 * (low + high);
    (check({piece}, cloud({x}), m).margins_inside == 1 ? low : high) = m;
  }
  return low;
}

TEST(Certificate, MarginsAreTheDistances) {
  const std::vector<Quadric> ball{diagonal(1, 1, 1, -25)}, longish{diagonal(1.0 / 9, 1, 1, -1)},
      cups{diagonal(1, -1, -1, -1)};
  const auto expect_margin = [](const std::vector<Quadric>& piece, const Vector3d& x, double distance) {
    const double m = largest_margin(piece, x);
    EXPECT_NEAR(m / distance, 1, 1e-13) << x.transpose();
  };
  expect_margin(ball, {3, 0, 0}, 2);
  expect_margin(ball, {0, 0, 0}, 5);
  // Near the tip of semi-axes 3, 1, 1 the tip is nearest while the distance is at most the radius of
  // curvature, 1/3; else a circle, sqrt(1 - x^2 / 8) away.
  expect_margin(longish, {2.75, 0, 0}, 0.25);
  expect_margin(longish, {2, 0, 0}, std::sqrt(0.5));
  expect_margin(longish, {0, 0, 0}, 1);
  // x^2 + (y - t)^2 on x^2 = 1 + y^2 is least at y = t / 2.
  expect_margin(cups, {0, 0, 0}, 1);
  expect_margin(cups, {0, 3, 0}, std::sqrt(1 + 4.5));
  // Outside none is, nor on the boundary.
  EXPECT_EQ(largest_margin(ball, {6, 0, 0}), 0);
}

TEST(Certificate, BallsWithAMarginAreInside) {
  RandomBodies random(64);
  SCOPED_TRACE(random.trace());
  int accepted = 0;
  for (int n = 0; n < 300; ++n) {
    Matrix4d m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j <= i; ++j) m(i, j) = m(j, i) = random.uniform(-1, 1);
    m(3, 3) = -1;
    const std::vector<Quadric> piece{Quadric(m)};
    const Vector3d x = random.in_box(0.5);
    const double radius = random.log_uniform(1e-3, 1);
    if (check({piece}, cloud({x}), radius).margins_inside == 0) continue;
    ++accepted;
    for (int k = 0; k < 300; ++k)
      ASSERT_NE(side<3>(piece[0], Vector3d(x + radius * (1 - 1e-12) * random.direction())), Sign::positive);
  }
  EXPECT_GT(accepted, 50);
}

TEST(Certificate, SaysWhatIsWrongWithItsInput) {
  const Pieces ball{{diagonal(1, 1, 1, -25)}};
  const auto field = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  const Sample one = cloud({{1, 2, 3}});
  EXPECT_EQ(field([&] { check({}, one); }), "pieces");
  EXPECT_EQ(field([&] { check({{}}, one); }), "pieces[0]");
  EXPECT_EQ(field([&] { check(ball, one, -1); }), "margin");
  EXPECT_EQ(field([&] { check(ball, one, kInfinity); }), "margin");
  EXPECT_EQ(field([&] { check(ball, cloud({{0, 0, 0}, {0, kInfinity, 0}})); }), "points[1]");
  EXPECT_EQ(field([&] { check(ball, Sample{one.points, {{{0, 0, 1}}}}); }), "triangles[0]");
  EXPECT_TRUE(check(ball, cloud({})).all_inside());
}

TEST(Certificate, HoldsAtTheEndsOfTheRange) {
  for (const int e : {-500, -300, 300, 500}) {
    const double s = std::ldexp(1.0, e);
    const Pieces ball{{diagonal(1, 1, 1, -25 * s * s)}};
    EXPECT_TRUE(contains(ball, cloud({s * Vector3d(3, 4, 0), s * Vector3d(1, 1, 1)}))) << e;
    EXPECT_FALSE(contains(ball, cloud({s * Vector3d(std::nextafter(3, 4), 4, 0)}))) << e;
    const Pieces cups{{diagonal(1, -1, -1, -s * s)}};
    EXPECT_TRUE(
        contains(cups, triangle(s * Vector3d(1, -1, -1), s * Vector3d(1, 2, -1), s * Vector3d(1, -1, 2))))
        << e;
    EXPECT_FALSE(contains(
        cups, triangle(s * Vector3d(1.5, -1, -1), s * Vector3d(1.5, 2, -1), s * Vector3d(1.5, -1, 2))))
        << e;
  }
}

}  // namespace
}  // namespace vericone::fitting::certificate_test
