// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <vericone/testing/random_bodies.h>

#include <iostream>
#include <limits>

namespace vericone::quadric_side_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::RandomBodies;

/// The expected sign, and the rung that must find it; every rung that answers agrees.
template <typename Shape, int D>
void expect_side(const Shape& shape, const Eigen::Matrix<double, D, 1>& x, Sign expected, Rung by) {
  Rung rung{};
  EXPECT_EQ(side<D>(shape, x, &rung), expected);
  EXPECT_EQ(rung, by) << to_string(rung);
  EXPECT_EQ(exact_side<D>(shape, x), expected);
  for (const FilteredSign s : {triage_side<D>(shape, x), interval_side<D>(shape, x)})
    if (s != FilteredSign::uncertain) {
      EXPECT_EQ(static_cast<int>(s), static_cast<int>(expected));
    }
}

TEST(QuadricSide, EveryRung) {
  const Quadric sphere(Eigen::Vector4d(1, 1, 1, -25).asDiagonal().toDenseMatrix());
  expect_side<Quadric, 3>(sphere, {1, 2, 3}, Sign::negative, Rung::triage);
  expect_side<Quadric, 3>(sphere, {4, 4, 3}, Sign::positive, Rung::triage);
  expect_side<Quadric, 3>(sphere, {3, 4, 0}, Sign::zero, Rung::exact);
  expect_side<Quadric, 3>(sphere, {std::nextafter(3, 4), 4, 0}, Sign::positive, Rung::exact);
  expect_side<Quadric, 3>(sphere, {std::nextafter(3, 2), 4, 0}, Sign::negative, Rung::exact);
  // Terms that differ much in size: the fixed bound counts every rounding at the largest, the interval not.
  bool found = false;
  for (double x = 3; x < 3 + 1e-13 && !found; x = std::nextafter(x, 4)) {
    Rung rung{};
    EXPECT_EQ((side<3>(sphere, Vector3d(x, 4, 0), &rung)), x > 3 ? Sign::positive : Sign::zero);
    found = rung == Rung::interval;
  }
  EXPECT_TRUE(found) << "no point that the interval rung decides";
}

TEST(QuadricSide, HyperboloidsAndCombinations) {
  // A dented ellipsoid: inside x^2/16 + y^2 + z^2 <= 1 and outside of the cups of x^2 - y^2 - z^2 = 4.
  const Quadric ellipsoid(Eigen::Vector4d(0.0625, 1, 1, -1).asDiagonal().toDenseMatrix());
  const Quadric cups(Eigen::Vector4d(1, -1, -1, -4).asDiagonal().toDenseMatrix());
  const std::array<Quadric, 2> dented{ellipsoid, cups};
  const auto at = [&](double x, double y, double z) {
    return side<3>(std::span<const Quadric>(dented), Vector3d(x, y, z));
  };
  EXPECT_EQ(at(0, 0, 0), Sign::negative);
  EXPECT_EQ(at(2, 0, 0), Sign::zero);  // the bottom of a dent
  EXPECT_EQ(at(3, 0, 0), Sign::positive);
  EXPECT_EQ(at(0, 1, 0), Sign::zero);
  EXPECT_EQ(at(2, 0.5, 0), Sign::negative);
  EXPECT_EQ(at(0, 1, 1e-200), Sign::positive);
  EXPECT_EQ((side<3>(std::span<const Quadric>(), Vector3d(1, 2, 3))), Sign::negative);
}

TEST(BodySide, EveryRungForBothDefinitions) {
  const Ellipsoid by_axes = Ellipsoid::from_axes({1, 2, 3}, {2, 3, 6}),
                  by_shape = Ellipsoid::from_shape({1, 2, 3}, by_axes.shape());
  for (const Ellipsoid& body : {by_axes, by_shape}) {
    expect_side<Ellipsoid, 3>(body, {1, 2, 4}, Sign::negative, Rung::triage);
    expect_side<Ellipsoid, 3>(body, {4, 2, 3}, Sign::positive, Rung::triage);
    // (2/3, 2/3, 1/3) is a unit vector: with axes 2, 3, 6 the point (4/3, 2, 2); times 3 it is on the tripled
    // body. Here the axis points are exact.
    expect_side<Ellipsoid, 3>(body, {3, 2, 3}, Sign::zero, Rung::exact);
    expect_side<Ellipsoid, 3>(body, {std::nextafter(3, 4), 2, 3}, Sign::positive, Rung::exact);
    expect_side<Ellipsoid, 3>(body, {std::nextafter(3, 2), 2, 3}, Sign::negative, Rung::exact);
    expect_side<Ellipsoid, 3>(body.scaled(3), {3 + 4, 6 + 6, 9 + 6}, Sign::zero, Rung::exact);
  }
}

TEST(BodySide, ScalesFromThousandthToTheEndsOfTheRange) {
  for (int e : {-498, -300, 0, 300, 498}) {
    const double s = std::ldexp(1.0, e);
    const Ellipsoid body = Ellipsoid::from_axes(s * Vector3d(1, 2, 3), s * Vector3d(2, 3, 6));
    expect_side<Ellipsoid, 3>(body, s * Vector3d(1, 2, 4), Sign::negative, Rung::triage);
    expect_side<Ellipsoid, 3>(body, s * Vector3d(3, 2, 3), Sign::zero, Rung::exact);
    expect_side<Ellipsoid, 3>(body, s * Vector3d(3.5, 2, 3), Sign::positive, Rung::triage);
    // A unit body seen from far away or from next to its centre.
    const Ellipsoid unit;
    expect_side<Ellipsoid, 3>(unit, s * Vector3d(4, 0, 0), e < 0 ? Sign::negative : Sign::positive,
                              Rung::triage);
  }
}

TEST(Side, RefusesWhatIsNotANumber) {
  const Ellipsoid body;
  try {
    side<3>(body, Vector3d(0, std::numeric_limits<double>::quiet_NaN(), 0));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "point[1]");
  }
  EXPECT_THROW(side<3>(body.quadric(), Vector3d(0, 0, std::numeric_limits<double>::infinity())), InputError);
}

/// Laws and agreement of rungs on points around the surface of random bodies.
TEST(Side, LawsOnRandomPoints) {
  constexpr std::uint64_t kSeed = 20261121;
  RandomBodies random(kSeed);
  SCOPED_TRACE(random.trace());
  int decided[3] = {};
  constexpr int kCases = 100'000;
  for (int i = 0; i < kCases; ++i) {
    const double thin = i % 3 == 0 ? 1e-8 : i % 3 == 1 ? 1e-3 : 1;
    const Ellipsoid body = random.ellipsoid(random.in_box(5), thin, 10);
    const Vector3d n = random.direction();
    Vector3d x = body.support_point(n);
    if (i % 2) x += random.log_uniform(1e-17, 1) * (random.coin() ? 1 : -1) * n;
    Rung rung{};
    const Sign s = side<3>(body, x, &rung);
    ++decided[static_cast<int>(rung)];
    ASSERT_EQ(s, exact_side<3>(body, x)) << "case " << i;
    for (const FilteredSign f : {triage_side<3>(body, x), interval_side<3>(body, x)})
      if (f != FilteredSign::uncertain) {
        ASSERT_EQ(static_cast<int>(f), static_cast<int>(s)) << i;
      }
    // The same body and point, twice as large, and as a quadric (of its own rounding).
    ASSERT_EQ(side<3>(body.scaled(2), Vector3d(2 * x)), s);
    const Quadric quadric = body.quadric();
    const Sign q = side<3>(quadric, x, &rung);
    ASSERT_EQ(q, exact_side<3>(quadric, x));
    ASSERT_EQ(side<3>(Quadric(-quadric.matrix()), x), static_cast<Sign>(-static_cast<int>(q)));
    ASSERT_EQ(side<3>(Quadric(0.25 * quadric.matrix()), x), q);
  }
  std::cout << "[ rates    ] " << kCases << " points near surfaces: triage " << 100. * decided[0] / kCases
            << " %, interval " << 100. * decided[1] / kCases << " %, exact " << 100. * decided[2] / kCases
            << " %\n";
  EXPECT_GT(decided[0], kCases / 4);
  EXPECT_GT(decided[2], 0);
}

TEST(Side, InThePlane) {
  const Ellipse circle = Ellipse::from_axes({0, 0}, {5, 5});
  expect_side<Ellipse, 2>(circle, {3, 4}, Sign::zero, Rung::exact);
  expect_side<Ellipse, 2>(circle, {3, 3.9}, Sign::negative, Rung::triage);
  const Conic hyperbola(Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix());
  expect_side<Conic, 2>(hyperbola, {1.25, 0.75}, Sign::zero, Rung::exact);
  expect_side<Conic, 2>(hyperbola, {2, 0}, Sign::positive, Rung::triage);
  // Oblique: along the long axis and across it at the same distance; 10 lengths of (3, 1)/sqrt(10) are on it.
  const Ellipse oblique = Ellipse::from_shape({0, 0}, Eigen::Matrix2d{{10, 6}, {6, 10}});
  expect_side<Ellipse, 2>(oblique, {2, 2}, Sign::negative, Rung::triage);
  expect_side<Ellipse, 2>(oblique, {2, -2}, Sign::positive, Rung::triage);
}

}  // namespace
}  // namespace vericone::quadric_side_test
