// SPDX-License-Identifier: BSD-3-Clause
//
// Which of two contacts is earlier, and enclosures of their times.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <vericone/internal/cones/times/order.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/LU>

#include "cones/ellipsoids/exact_tangency.h"
#include "cones/times/order_rungs.h"
#include "support/campaign.h"

namespace vericone::order_earlier_test {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using testing::as_sign, testing::ExactTangency, testing::operator-, testing::RandomBodies, testing::Real,
    testing::Rungs, testing::share;

/// The image under an integer matrix, exact for small integers in shapes.
Encounter image(const Encounter& e, const Matrix3d& m, const Vector3d& shift) {
  const auto body = [&](const Ellipsoid& x) {
    return Ellipsoid::from_shape(m * x.center() + shift, m * x.shape() * m.transpose());
  };
  return {body(e.a), body(e.b), m * e.w};
}

Matrix3d integer_matrix(RandomBodies& random) {
  for (;;) {
    Matrix3d m;
    for (int k = 0; k < 9; ++k) m(k) = random.integer(-3, 3);
    if (std::abs(m.determinant()) > 0.5) return m;
  }
}

/// Small integers throughout, colliding along (1, 0, 0).
Encounter integer_collision(RandomBodies& random) {
  for (;;) {
    Matrix3d s[2];
    for (Matrix3d& m : s) {
      const Matrix3d g = integer_matrix(random);
      m = g * g.transpose();
    }
    const auto coordinate = [&] { return static_cast<double>(random.integer(-6, 6)); };
    const Encounter e{Ellipsoid::from_shape({coordinate() - 12, coordinate(), coordinate()}, s[0]),
                      Ellipsoid::from_shape({coordinate() + 12, coordinate(), coordinate()}, s[1]),
                      {1, 0, 0}};
    const ConeOracle oracle(e.a, e.b);
    if (oracle.verdict(e.w, Vector3d::Zero()) == Verdict::in) return e;
  }
}

TEST(Earlier, KnownTimes) {
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  const Encounter in_three{ball, ball.translated({5, 0, 0}), {1, 0, 0}},
      in_four{ball, ball.translated({0, 6, 0}), {0, 1, 0}}, now{ball, ball.translated({1, 0, 0}), {0, 0, 0}},
      touching{ball, ball.translated({2, 0, 0}), {-1, 0, 0}},
      never{ball, ball.translated({5, 0, 0}), {-1, 0, 0}}, still{ball, ball.translated({5, 0, 0}), {0, 0, 0}},
      grazing{ball, ball.translated({3, 2, 0}), {1, 0, 0}},
      misses{ball, ball.translated({3, 3, 0}), {1, 0, 0}},
      tall{Ellipsoid::from_axes({0, 0, 0}, {2, 1, 1}), ball.translated({6, 0, 0}), {1, 0, 0}};
  Rungs r;
  EXPECT_EQ(r.earlier(in_three, in_four), Sign::negative);
  EXPECT_EQ(r.earlier(now, in_three), Sign::negative);
  EXPECT_EQ(r.earlier(touching, in_three), Sign::negative);
  EXPECT_EQ(r.earlier(touching, now), Sign::zero);
  EXPECT_EQ(r.earlier(now, now), Sign::zero);
  EXPECT_EQ(r.earlier(never, in_three), Sign::positive);
  EXPECT_EQ(r.earlier(never, still), Sign::zero);
  EXPECT_EQ(r.earlier(never, misses), Sign::zero);
  EXPECT_EQ(r.earlier(now, never), Sign::negative);
  EXPECT_EQ(r.earlier(grazing, in_three), Sign::zero);  // both at t = 3
  EXPECT_EQ(r.earlier(grazing, in_four), Sign::negative);
  EXPECT_EQ(r.earlier(grazing, misses), Sign::negative);
  EXPECT_EQ(r.earlier(tall, in_three), Sign::zero);
  EXPECT_EQ(r.earlier({in_three.a, in_three.b, {2, 0, 0}}, {in_four.a, in_four.b, {0, 3, 0}}),
            Sign::positive);
  EXPECT_THROW((void)earlier({ball, ball.translated({5, 0, 0}), {std::nan(""), 0, 0}}, now), InputError);
}

TEST(Earlier, IrrationalTimesOfBalls) {
  // t = u - sqrt(v) for balls of radii with sum r: u = c.w / w.w.
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  const auto at = [&](double x, double y) { return Encounter{ball, ball.translated({x, y, 0}), {1, 0, 0}}; };
  EXPECT_EQ(earlier(at(5, 1), at(5, -1)), Sign::zero);  // 5 - sqrt 3
  EXPECT_EQ(earlier(at(5, 1), at(5, 1.5)), Sign::negative);
  const Encounter turned{ball, ball.translated({3, 4, 1}), {0.6, 0.8, 0}};  // w is not quite of length one
  EXPECT_NE(earlier(at(5, 1), turned), Sign::zero);
  const Encounter scaled{ball, ball.translated({3, 4, 1}), {3, 4, 0}};  // one fifth of it, exactly
  EXPECT_EQ(earlier({ball, ball.translated({5, 0, 1}), {5, 0, 0}}, scaled), Sign::zero);
}

TEST(Earlier, TiesByLinearMapsAndTheirNeighbours) {
  RandomBodies random(704);
  SCOPED_TRACE(random.trace());
  Rungs ties, near;
  for (int i = 0; i < 40; ++i) {
    const Encounter base = integer_collision(random);
    const Vector3d shift(random.integer(-50, 50), random.integer(-50, 50), random.integer(-50, 50));
    const Encounter other = image(base, integer_matrix(random), shift);
    ASSERT_EQ(ties.earlier(base, other), Sign::zero) << "case " << i;
    ASSERT_EQ(earlier({base.b, base.a, -base.w}, other), Sign::zero) << "law (4)";
    // w = (s, 0, 0) divides the time by s.
    const double s = testing::moved_by_ulps(1, i % 2 ? random.integer(1, 8) : -random.integer(1, 8));
    ASSERT_EQ(near.earlier({base.a, base.b, {s, 0, 0}}, other), s > 1 ? Sign::negative : Sign::positive)
        << "case " << i;
  }
  ties.print("earlier, ties");
  near.print("earlier, neighbours of ties");
  EXPECT_EQ(ties.by[2], ties.cases);
}

TEST(Earlier, DifferentBodiesAtTheSameTimeAndTheirNeighbours) {
  // A stands back by w from where it touches B: the time is 1. A velocity with a little more of a component
  // along the normal is earlier, and as much as 2^-1000 of it counts.
  RandomBodies random(713);
  SCOPED_TRACE(random.trace());
  Rungs ties, near;
  const auto meeting = [&] {
    for (;;) {
      const ExactTangency t = ExactTangency::random(random);
      Vector3d w(random.integer(-20, 20), random.integer(-20, 20), 0);
      if (t.normal.dot(w) == 0 || t.normal(2) == 0) continue;
      if (t.normal.dot(w) < 0) w = -w;
      return std::pair(Encounter{t.touching_a.translated(-w), t.touching_b, w}, t.normal(2) > 0 ? 1 : -1);
    }
  };
  for (int i = 0; i < 30; ++i) {
    const auto [p, side] = meeting();
    const Encounter q = meeting().first;
    ASSERT_EQ(ties.earlier(p, q), Sign::zero) << "case " << i;
    Encounter other = p;
    other.w(2) = std::ldexp(i % 2 ? 1 : -1, i % 3 == 0 ? -30 : i % 3 == 1 ? -150 : -1000);
    ASSERT_EQ(near.earlier(other, q), as_sign(-side * other.w(2))) << "case " << i;
  }
  ties.print("earlier, different bodies");
  near.print("earlier, their neighbours");
  EXPECT_EQ(ties.by[2], ties.cases);
}

TEST(Earlier, GrazingContacts) {
  RandomBodies random(705);
  SCOPED_TRACE(random.trace());
  Rungs ties, near;
  for (int i = 0; i < 40; ++i) {
    const double scale = i % 3 == 0 ? 0x1p-150 : i % 3 == 1 ? 1 : 0x1p150;
    const ExactTangency t = ExactTangency::random(random, 1, scale);
    const Encounter p{t.a, t.b, t.w}, q = image(p, integer_matrix(random), Vector3d::Zero());
    ASSERT_EQ(ConeOracle(p.a, p.b).membership(p.w), Membership::on);
    ASSERT_EQ(ties.earlier(p, q), Sign::zero) << "case " << i;
    const double s = 1 + (i % 2 ? 1 : -1) * random.integer(1, 8) * 0x1p-36;
    ASSERT_EQ(near.earlier({p.a, p.b, s * p.w}, q), s > 1 ? Sign::negative : Sign::positive) << "case " << i;
    // w = k_A k_B q with q the vector between the supporting points: the time is 1 / (k_A k_B), at most one.
    const auto time = exact_time_to_contact(ConeOracle(p.a, p.b), p.w / scale, Vector3d::Zero());
    ASSERT_TRUE(time && time->positive());
    double inverse = scale / time->mid();
    ASSERT_NEAR(inverse / scale / scale, std::round(inverse / scale / scale), 1e-9) << "case " << i;
  }
  ties.print("earlier, grazing ties");
  near.print("earlier, grazing neighbours");
}

TEST(Earlier, NearlyGrazingContacts) {
  // Within roundings of the boundary of the cone: the bodies are in contact for a moment only.
  RandomBodies random(709);
  SCOPED_TRACE(random.trace());
  Rungs rungs;
  int by_verdict[3] = {};
  for (int i = 0; i < 100; ++i) {
    const ExactTangency t = ExactTangency::random(random);
    const Encounter grazing{t.a, t.b, t.w};
    Encounter near = grazing;
    near.w = random.ulps(t.w, 4);
    const ConeOracle oracle(near.a, near.b);
    const Membership membership = oracle.membership(near.w);
    ++by_verdict[static_cast<int>(membership)];
    const Sign s = rungs.earlier(near, grazing);
    const auto enclosure = enclose_time_to_contact(oracle, near.w, Vector3d::Zero());
    ASSERT_EQ(enclosure.has_value(), membership != Membership::out) << "case " << i;
    if (membership == Membership::out) {
      ASSERT_EQ(s, Sign::positive) << "case " << i;
      continue;
    }
    // At the enclosed time and not before: lower than any time at which the centres have passed.
    const auto time = exact_time_to_contact(ConeOracle(t.a, t.b), t.w, Vector3d::Zero());
    ASSERT_NEAR(enclosure->mid(), time->mid(), 1e-5 * (1 + time->mid())) << "case " << i;
    const auto exact = exact_time_to_contact(oracle, near.w, Vector3d::Zero());
    ASSERT_LE(enclosure->lo(), exact->hi());
    ASSERT_GE(enclosure->hi(), exact->lo());
    if (exact->hi() < time->lo()) {
      ASSERT_EQ(s, Sign::negative) << "case " << i;
    }
    if (exact->lo() > time->hi()) {
      ASSERT_EQ(s, Sign::positive) << "case " << i;
    }
  }
  rungs.print("earlier, nearly grazing");
  EXPECT_GT(by_verdict[static_cast<int>(Membership::in)], 20);
  EXPECT_GT(by_verdict[static_cast<int>(Membership::out)], 20);
}

/// A body of revolution or a ball about the x axis, and motion along it or in a plane through it: pencils
/// with factors that never change, for which the discriminant of the whole contact polynomial is zero.
TEST(Earlier, SymmetricBodies) {
  RandomBodies random(710);
  SCOPED_TRACE(random.trace());
  Rungs rungs;
  std::vector<std::pair<double, Encounter>> by_time;  // times that are known
  for (int i = 0; i < 60; ++i) {
    const double x = random.integer(1, 4), r = random.integer(1, 4), y = random.integer(1, 4),
                 d = random.integer(9, 12), v = random.integer(1, 3);
    const Vector3d axes = i % 3 == 0 ? Vector3d(x, x, x) : i % 3 == 1 ? Vector3d(x, r, r) : Vector3d(x, r, 1);
    const Encounter e{Ellipsoid::from_axes({0, 0, 0}, axes),
                      Ellipsoid::from_axes({d, 0, 0}, {y, i % 2 ? y : r, y}),
                      {v, 0, 0}};
    by_time.emplace_back((d - x - y) / v, e);
  }
  for (std::size_t i = 0; i < by_time.size(); ++i) {
    const auto& [t, p] = by_time[i];
    const auto& [u, q] = by_time[(7 * i + 3) % by_time.size()];
    // Times with denominators up to 3: equal as doubles exactly when they are equal.
    ASSERT_EQ(rungs.earlier(p, q), as_sign(t - u)) << "case " << i;
    const auto exact = exact_time_to_contact(ConeOracle(p.a, p.b), p.w, Vector3d::Zero());
    ASSERT_TRUE(exact && exact->contains(t)) << "case " << i;
  }
  rungs.print("earlier, symmetric bodies");
  EXPECT_GT(rungs.zeros, 2);
}

TEST(Earlier, OrderIsTransitiveAndInvariant) {
  RandomBodies random(711);
  SCOPED_TRACE(random.trace());
  std::vector<Encounter> all;
  const Ellipsoid ball = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 6; ++i) {
    const Encounter e = integer_collision(random);
    all.push_back(e);
    all.push_back(image(e, integer_matrix(random), {1, 2, 3}));
    const ExactTangency t = ExactTangency::random(random);
    all.push_back({t.a, t.b, t.w});
    all.push_back({t.a, t.b, -t.w});
    all.push_back({ball, ball.translated({3.0 + i, 1, 0}), {1, 0, 0}});
  }
  all.push_back({ball, ball, {1, 0, 0}});
  std::vector<std::vector<int>> order(all.size(), std::vector<int>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) order[i][j] = static_cast<int>(earlier(all[i], all[j]));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) {
      ASSERT_EQ(order[i][j], -order[j][i]) << "law (1)";
      for (std::size_t k = 0; k < all.size(); ++k)
        if (order[i][j] <= 0 && order[j][k] <= 0) {
          ASSERT_EQ(order[i][k], std::min(order[i][j], order[j][k])) << "law (5)";
        }
    }
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const Encounter &p = all[i], &q = all[i + 1];
    for (const double scale : {0x1p-480, 0x1p-40, 0x1p480}) {
      // scaled() redefines a body by its factor.
      const auto scaled = [&](const Ellipsoid& x) {
        return x.defined_by_factor() ? x.scaled(scale)
                                     : Ellipsoid::from_shape(scale * x.center(), scale * scale * x.shape());
      };
      const Encounter r{scaled(p.a), scaled(p.b), scale * p.w};
      ASSERT_EQ(static_cast<int>(earlier(r, q)), order[i][i + 1]) << "law (4), " << i << ", " << scale;
    }
    // Slower by a power of two and back.
    const Encounter slow{p.a, p.b, 0x1p-30 * p.w};
    ASSERT_LE(static_cast<int>(earlier(p, slow)), 0);
  }
}

TEST(Earlier, LengthsAndSpeedsOfDifferentScales) {
  RandomBodies random(712);
  SCOPED_TRACE(random.trace());
  const Encounter e = integer_collision(random);
  for (const auto& [length, speed] :
       {std::pair{0x1p-490, 0x1p490}, std::pair{0x1p490, 0x1p-490}, std::pair{1.0, 0x1p-490}}) {
    const Encounter p{e.a.scaled(length), e.b.scaled(length), speed * e.w};
    Rungs r;
    EXPECT_EQ(r.earlier(p, p), Sign::zero);
    EXPECT_EQ(r.earlier(p, {p.a, p.b, 2 * p.w}), Sign::positive);
    const Encounter near{p.a, p.b, (1 + 0x1p-52) * p.w};
    EXPECT_EQ(r.earlier(p, near), Sign::positive);
    EXPECT_EQ(r.earlier(p, e), length > speed ? Sign::positive : Sign::negative);
  }
}

TEST(Earlier, EveryRungDecides) {
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 2, 3}),
                  b = Ellipsoid::from_axes({10, 1, 1}, {2, 1, 1});
  struct Case {
    double part;
    Rung rung;
  };
  for (const Case& c :
       {Case{0x1p-10, Rung::triage}, Case{0x1p-36, Rung::interval}, Case{0x1p-52, Rung::exact}}) {
    const Encounter p{a, b, {1, 0, 0}}, q{a, b, {1 + c.part, 0, 0}};
    Rung rung = Rung::triage;
    EXPECT_EQ(earlier(q, p, &rung), Sign::negative) << c.part;
    EXPECT_EQ(rung, c.rung) << c.part;
    Rungs().earlier(p, q);
  }
}

/// The first contact with 80 digits, by bisection: at time t the bodies are apart iff the contact function
/// exceeds one at its maximum.
Real wide_time(const Encounter& e) {
  const auto sa = exact::defining_shape<3>(e.a), sb = exact::defining_shape<3>(e.b);
  using Matrix = std::array<std::array<Real, 3>, 3>;
  const auto contact = [&](const Real& t) {
    std::array<Real, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = Real(e.b.center()(i)) - Real(e.a.center()(i)) - t * Real(e.w(i));
    const auto value = [&](const Real& x, Real& slope_sign) {
      Matrix m;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = Real(sa[i][j]) + x * Real(sb[i][j]);
      std::array<Real, 3> n;
      const auto cofactor = [&](int i, int j) {
        const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
        return Real(m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0]);
      };
      Real det = 0, f = 0, qa = 0, qb = 0;
      for (int j = 0; j < 3; ++j) det += m[0][j] * cofactor(0, j);
      for (int i = 0; i < 3; ++i) {
        n[i] = 0;
        for (int j = 0; j < 3; ++j) n[i] += cofactor(i, j) * c[j] / det;
      }
      for (int i = 0; i < 3; ++i) {
        f += n[i] * c[i];
        for (int j = 0; j < 3; ++j) {
          qa += n[i] * Real(sa[i][j]) * n[j];
          qb += n[i] * Real(sb[i][j]) * n[j];
        }
      }
      slope_sign = qa - x * x * qb;  // of the contact function
      return Real(x / (1 + x) * f);
    };
    Real lo = -40, hi = 40, slope;  // log2 x
    for (int i = 0; i < 100; ++i) {
      const Real mid = (lo + hi) / 2;
      value(pow(Real(2), mid), slope);
      (slope > 0 ? lo : hi) = mid;
    }
    return value(pow(Real(2), lo), slope);
  };
  Real hi = clearance(e.a, e.b, e.w).time, lo = 0;
  const double guess = contact_time(e.a, e.b, e.w);
  for (const double part : {1e-12, 1e-6}) {
    if (contact(Real(guess) * (1 - part)) > 1) lo = std::max(lo, Real(Real(guess) * (1 - part)));
    if (contact(Real(guess) * (1 + part)) < 1) hi = std::min(hi, Real(Real(guess) * (1 + part)));
  }
  for (int i = 0; i < 48; ++i) {
    const Real mid = (lo + hi) / 2;
    (contact(mid) > 1 ? lo : hi) = mid;
  }
  return lo;
}

TEST(Earlier, EnclosuresContainTheTime) {
  RandomBodies random(706);
  SCOPED_TRACE(random.trace());
  int by_intervals = 0, cases = 0;
  double widest = 0;
  for (int i = 0; i < share(8); ++i) {
    const double low = i % 2 ? 0.05 : 1;
    const auto [a, b] = random.scaled_from_touching(low, 10 * low, random.uniform(1.1, 5));
    const ConeOracle oracle(a, b);
    const Vector3d w = b.center() - a.center() + random.in_box(0.2);
    if (oracle.membership(w) != Membership::in) continue;
    ++cases;
    const Real t = wide_time({a, b, w});
    const auto enclosure = enclose_time_to_contact(oracle, w, Vector3d::Zero()),
               exact = exact_time_to_contact(oracle, w, Vector3d::Zero());
    ASSERT_TRUE(enclosure && exact);
    // The reference is good to some 1e-28.
    const Real slack = t * Real("1e-25");
    for (const Interval& found : {*enclosure, *exact}) {
      ASSERT_TRUE(Real(found.lo()) <= t + slack && t - slack <= Real(found.hi())) << "case " << i;
    }
    ASSERT_LE(exact->rad(), 0x1p-51 * exact->mid());
    widest = std::max(widest, enclosure->rad() / enclosure->mid());
    by_intervals += interval_time_to_contact(a, b, {w(0), w(1), w(2)}).has_value();
  }
  EXPECT_GE(cases, share(4));
  EXPECT_GT(by_intervals, cases / 2);
  EXPECT_LT(widest, 1e-9);
}

TEST(Earlier, IntervalEnclosuresContainTheExactOne) {
  RandomBodies random(707);
  SCOPED_TRACE(random.trace());
  struct Family {
    const char* name;
    double low, high, scale;
  };
  for (const Family& f : {Family{"axes 1..10", 1, 10, 1}, Family{"axes 1e-4..1", 1e-4, 1, 1},
                          Family{"scale 1e-150", 1, 10, 0x1p-498}, Family{"scale 1e150", 1, 10, 0x1p490}}) {
    int in = 0, found_by_intervals = 0;
    double sum = 0;
    for (int i = 0; i < 250; ++i) {
      const auto [a0, b0] = random.scaled_from_touching(f.low, f.high, random.uniform(1.01, 6));
      const Ellipsoid a = a0.scaled(f.scale), b = b0.scaled(f.scale);
      const ConeOracle oracle(a, b);
      const Vector3d v_b = random.in_box(1), v_a = v_b + (b0.center() - a0.center()) + random.in_box(0.1);
      const Verdict verdict = oracle.verdict(v_a, v_b);
      const auto exact = exact_time_to_contact(oracle, v_a, v_b);
      ASSERT_EQ(exact.has_value(), verdict == Verdict::in) << f.name << " case " << i;
      const auto enclosure = enclose_time_to_contact(oracle, v_a, v_b);
      ASSERT_EQ(enclosure.has_value(), exact.has_value());
      if (!exact) continue;
      ++in;
      // Two enclosures of one number.
      ASSERT_LE(enclosure->lo(), exact->hi()) << f.name << " case " << i;
      ASSERT_GE(enclosure->hi(), exact->lo()) << f.name << " case " << i;
      std::array<Interval, 3> w;
      for (int k = 0; k < 3; ++k) w[k] = Interval(v_a(k)) - Interval(v_b(k));
      if (interval_time_to_contact(a, b, w)) {
        ++found_by_intervals;
        sum += enclosure->rad() / enclosure->mid();
        ASSERT_LE(enclosure->lo(), exact->lo() * (1 + 1e-15));
        ASSERT_GE(enclosure->hi(), exact->hi() * (1 - 1e-15));
      }
    }
    std::cout << "[ times    ] " << f.name << ": " << in << " contacts, " << found_by_intervals
              << " enclosed by intervals, mean relative radius " << sum / found_by_intervals << "\n";
    EXPECT_GT(in, 80) << f.name;
    EXPECT_GT(found_by_intervals, in / 2) << f.name;
  }
}

TEST(Earlier, RandomEncountersAreOrderedLikeTheirTimes) {
  RandomBodies random(708);
  SCOPED_TRACE(random.trace());
  Rungs rungs;
  for (int i = 0; i < 800; ++i) {
    Encounter e[2];
    std::optional<double> t[2];
    for (int k = 0; k < 2; ++k) {
      std::tie(e[k].a, e[k].b) = random.scaled_from_touching(1, 10, random.uniform(0.9, 4));
      e[k].w = e[k].b.center() - e[k].a.center() + random.in_box(6);
      t[k] = time_to_contact(e[k].a, e[k].b, e[k].w);
    }
    const Sign s = rungs.earlier(e[0], e[1]);
    const double never = std::numeric_limits<double>::infinity(), x = t[0].value_or(never),
                 y = t[1].value_or(never);
    if (x == y || std::abs(x - y) > 1e-9) {
      ASSERT_EQ(s, x == y ? Sign::zero : as_sign(x - y)) << "case " << i;
    }
  }
  rungs.print("earlier, random");
  EXPECT_GT(rungs.by[0], 780);
}

}  // namespace
}  // namespace vericone::order_earlier_test
