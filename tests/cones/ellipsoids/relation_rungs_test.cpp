// SPDX-License-Identifier: BSD-3-Clause
//
// The rungs of relation() and separates() against each other where they are hardest.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/testing/random_bodies.h>

#include <iostream>

#include "support/campaign.h"

namespace vericone::relation_rungs_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using exact::Rational;
using testing::RandomBodies, testing::share;

struct Rates {
  int cases = 0, undecided = 0, naive_wrong = 0, by_relation[3] = {};
  void print(const std::string& what) const {
    std::cout << "[ rates    ] " << what << ": " << cases << " cases, triage undecided "
              << 100. * undecided / cases << " %, naive wrong " << 100. * naive_wrong / cases << " %, apart "
              << by_relation[0] << ", overlapping " << by_relation[2] << "\n";
  }
};

template <int D>
void compare(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rates& rates) {
  const Relation exact = exact_relation<D>(a, b);
  const ContactFrame<D> frame(a, b);
  const auto triage = triage_relation<D>(a, b, frame);
  ++rates.cases;
  ++rates.by_relation[static_cast<int>(exact)];
  rates.undecided += !triage.has_value();
  rates.naive_wrong += (frame.contact > 1 ? Relation::disjoint : Relation::overlapping) != exact;
  const auto interval = interval_relation<D>(a, b, frame);
  for (const auto& answer : {triage, interval})
    if (answer) {
      ASSERT_EQ(*answer, exact);
    }
  Rung rung{};
  ASSERT_EQ(relation<D>(a, b, &rung), exact);
  ASSERT_EQ(rung, triage ? Rung::triage : interval ? Rung::interval : Rung::exact);
  ASSERT_EQ(relation<D>(b, a), exact) << "law (1)";
  ASSERT_EQ(exact_relation<D>(b, a), exact) << "law (1)";
}

double near_one(RandomBodies& random) {
  return 1 + (random.coin() ? 1 : -1) * random.log_uniform(1e-17, 1e-11);
}

TEST(RelationRungs, AgreeWithinRoundingsOfTouching) {
  struct Shape {
    const char* name;
    double low, high;
  };
  for (const Shape& shape : {Shape{"semi-axes 1..10", 1, 10}, Shape{"semi-axes 1e-6..1", 1e-6, 1}}) {
    RandomBodies random(531);
    SCOPED_TRACE(random.trace());
    Rates space, plane;
    for (int i = 0; i < share(4000); ++i) {
      const auto [a, b] = random.scaled_from_touching(shape.low, shape.high, near_one(random));
      ASSERT_NO_FATAL_FAILURE(compare<3>(a, b, space)) << "case " << i;
      const auto [p, q] = random.planar_scaled_from_touching(shape.low, shape.high, near_one(random));
      ASSERT_NO_FATAL_FAILURE(compare<2>(p, q, plane)) << "case " << i;
    }
    space.print(std::string("3-D ") + shape.name);
    plane.print(std::string("2-D ") + shape.name);
    EXPECT_GT(space.naive_wrong, share(10));
    EXPECT_GT(space.by_relation[0], share(1000));
    EXPECT_GT(space.by_relation[2], share(1000));
    EXPECT_GT(space.cases - space.undecided, share(1000));
  }
}

TEST(RelationRungs, AgreeAtEveryScale) {
  for (const double scale : {0x1p-332, 0x1p332, 1e-100, 1e100}) {
    RandomBodies random(532);
    SCOPED_TRACE(random.trace());
    Rates rates;
    for (int i = 0; i < share(1000); ++i) {
      const bool thin = i % 2 == 1;
      const auto [a, b] = random.scaled_from_touching(thin ? 1e-6 : 1, thin ? 1 : 10, near_one(random));
      const Ellipsoid sa = a.scaled(scale), sb = b.scaled(scale);
      ASSERT_NO_FATAL_FAILURE(compare<3>(sa, sb, rates)) << "case " << i;
      if (scale == 0x1p-332 || scale == 0x1p332) {
        ASSERT_EQ(relation<3>(sa, sb), relation<3>(a, b)) << "case " << i;
      }
    }
    rates.print("scale " + std::to_string(std::log10(scale)));
  }
}

TEST(RelationRungs, ThinBodiesGivenByTheirShape) {
  // The shape that defines the body is a rounded one, and its stored factor another rounding: the first rung
  // reads the factor, the last the shape.
  RandomBodies random(533);
  SCOPED_TRACE(random.trace());
  Rates rates;
  for (int i = 0; i < share(2500); ++i) {
    const auto [a, b] = random.scaled_from_touching(1e-5, 1, near_one(random));
    const Ellipsoid sa = Ellipsoid::from_shape(a.center(), a.shape());
    const double factor =
        1 / std::sqrt(ContactFrame<3>(sa, Ellipsoid::from_shape(b.center(), b.shape())).contact);
    const Ellipsoid sb =
        Ellipsoid::from_shape(a.center() + near_one(random) * factor * (b.center() - a.center()), b.shape());
    ASSERT_NO_FATAL_FAILURE(compare<3>(sa, sb, rates)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(compare<3>(sa, b, rates)) << "case " << i;
  }
  rates.print("given by shape, 1e-5..1");
}

TEST(RelationRungs, AgreeOnBodiesOfEveryDepth) {
  RandomBodies random(534);
  SCOPED_TRACE(random.trace());
  Rates rates;
  for (int i = 0; i < share(4000); ++i) {
    const double factor = random.integer(0, 9) == 0 ? 0 : random.uniform(0, 2);
    const auto [a, b] = random.scaled_from_touching(1e-3, 1, factor);
    ASSERT_NO_FATAL_FAILURE(compare<3>(a, b, rates)) << "case " << i;
  }
  rates.print("every depth");
  EXPECT_LT(rates.undecided, rates.cases / 50);
}

/// n.c > sqrt(n.S_A n) + sqrt(n.S_B n) by rationals: q_A + q_B + 2 sqrt(q_A q_B) < along^2.
template <int D>
bool separates_by_rationals(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                            const Eigen::Matrix<double, D, 1>& n) {
  const auto pa = exact::to_rational<D>(a.center()), pb = exact::to_rational<D>(b.center()),
             m = exact::to_rational<D>(n);
  const auto sa = exact::defining_shape<D>(a), sb = exact::defining_shape<D>(b);
  Rational along = 0, qa = 0, qb = 0;
  for (int i = 0; i < D; ++i) {
    along += m[i] * (pb[i] - pa[i]);
    for (int j = 0; j < D; ++j) {
      qa += m[i] * sa[i][j] * m[j];
      qb += m[i] * sb[i][j] * m[j];
    }
  }
  // Decided by bisecting for sqrt(q_A): along - s is below sqrt(q_B) or above for an s near it; here by the
  // sign of along - sqrt(q_A) first, then squares: (along - sqrt q_A)^2 > q_B.
  if (along.sign() <= 0 || along * along <= qa) return false;
  const Rational left = along * along + qa - qb;  // > 2 along sqrt(q_A) ?
  return left.sign() > 0 && left * left > 4 * along * along * qa;
}

TEST(RelationRungs, SeparatesAgreesWithRationals) {
  RandomBodies random(535);
  SCOPED_TRACE(random.trace());
  int yes = 0, no = 0, triage = 0;
  for (int i = 0; i < share(6000); ++i) {
    const double low = i % 2 ? 1 : 1e-6;
    const auto [a, b] = random.scaled_from_touching(low, 10 * low, near_one(random));
    const Vector3d n = random.log_uniform(1e-9, 1e9) *
                       random.ulps(ContactFrame<3>(a, b).separating_normal().normalized(), 2);
    const bool expected = separates_by_rationals<3>(a, b, n);
    ASSERT_EQ(separates<3>(a, b, n), expected) << "case " << i;
    ASSERT_FALSE(triage_separates<3>(a, b, n) && !expected) << "case " << i;
    ASSERT_FALSE(separates<3>(a, b, -n)) << "case " << i;
    if (expected) {
      ASSERT_EQ(relation<3>(a, b), Relation::disjoint);
    }
    (expected ? yes : no)++;
    triage += triage_separates<3>(a, b, n);
    const auto [p, q] = random.planar_scaled_from_touching(1, 10, near_one(random));
    const Vector2d m = ContactFrame<2>(p, q).separating_normal();
    ASSERT_EQ(separates<2>(p, q, m), separates_by_rationals<2>(p, q, m)) << "case " << i;
  }
  EXPECT_GT(yes, share(1500));
  EXPECT_GT(no, share(1500));
  EXPECT_GT(triage, 100);
}

/// Bodies *defined* by a shape matrix whose smallest eigenvalue is of the size of its rounding, next to small
/// balls.
TEST(RelationRungs, FlatBodiesDefinedByTheirShape) {
  RandomBodies random(536);
  SCOPED_TRACE(random.trace());
  int decided = 0, cases = 0;
  for (int i = 0; i < share(4000); ++i) {
    const double thin = random.log_uniform(1e-9, 1e-6);
    const auto flat = [&] {
      for (;;) {
        const Matrix3d r = random.rotation();
        Matrix3d s = r * Vector3d(1, random.uniform(0.1, 1), thin * thin).asDiagonal() * r.transpose();
        s = (0.5 * (s + s.transpose())).eval();
        try {
          return std::pair(Ellipsoid::from_shape({0, 0, 0}, s), Vector3d(r.col(2)));
        } catch (const InputError&) {
          continue;  // rounding made it indefinite, and that was noticed
        }
      }
    };
    const auto [a, normal] = flat();
    const Ellipsoid b = Ellipsoid::from_axes(normal * thin * random.uniform(0.3, 3), {thin, thin, thin});
    ++cases;
    Rung rung{};
    const Relation expected = exact_relation<3>(a, b);
    ASSERT_EQ(relation<3>(a, b, &rung), expected) << "case " << i;
    decided += rung != Rung::exact;
    const ContactFrame<3> frame(a, b);
    for (const auto& answer : {triage_relation<3>(a, b, frame), interval_relation<3>(a, b, frame)})
      if (answer) {
        ASSERT_EQ(*answer, expected) << "case " << i;
      }
  }
  std::cout << "[ rates    ] flat bodies from shapes: " << cases << " cases, " << decided
            << " decided before the exact rung\n";
  EXPECT_GT(decided, cases / 3);
  EXPECT_LT(decided, cases);
}

TEST(RelationRungs, SeparatesIsStrict) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {2, 2, 2}),
                  b = Ellipsoid::from_axes({3, 4, 0}, {3, 3, 3});
  EXPECT_FALSE(separates<3>(a, b, {3, 4, 0}));
  EXPECT_FALSE(separates<3>(a, b, {0, 0, 0}));
  EXPECT_FALSE(separates<3>(a, b, {std::nan(""), 0, 0}));
  EXPECT_TRUE(separates<3>(a, b.translated({0x1p-50, 0, 0}), {3, 4, 0}));
  EXPECT_FALSE(separates<3>(a, b.translated({0x1p-50, 0, 0}), {-3, -4, 0}));
}

}  // namespace
}  // namespace vericone::relation_rungs_test
