// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/geometry/exact/algebraic.h>
#include <vericone/testing/random_bodies.h>

#include <algorithm>
#include <cmath>

namespace vericone::exact::algebraic_test {
namespace {

Polynomial polynomial(std::initializer_list<long> lowest_first) {
  Polynomial p;
  for (const long x : lowest_first) p.emplace_back(x);
  return p;
}

/// b x - a.
Polynomial linear(long a, long b) { return polynomial({-a, b}); }

TEST(Algebraic, PolynomialArithmetic) {
  const Polynomial p = polynomial({6, -10, 4});  // 2 (x - 1) (2 x - 3)
  EXPECT_EQ(primitive_part(p), polynomial({3, -5, 2}));
  EXPECT_EQ(primitive_part(polynomial({-4, -6})), polynomial({-2, -3}));
  EXPECT_EQ(derivative(p), polynomial({-10, 8}));
  EXPECT_EQ(linear(1, 1) * linear(3, 2) * Integer(2), p);
  EXPECT_EQ(p - p, Polynomial{});
  EXPECT_EQ(p + polynomial({0, 0, -4}), polynomial({6, -10}));
  EXPECT_EQ(gcd(p, linear(3, 2) * linear(-7, 5)), linear(3, 2));
  EXPECT_EQ(gcd(p, linear(2, 1)), polynomial({1}));
  EXPECT_EQ(gcd(p, {}), polynomial({3, -5, 2}));
  EXPECT_TRUE(surely_coprime(p, linear(2, 1)));
  EXPECT_FALSE(surely_coprime(p, linear(3, 2) * linear(-7, 5)));
  EXPECT_FALSE(surely_coprime(p, {}));
  EXPECT_EQ(divide_exactly(p, linear(3, 2)), polynomial({-2, 2}));
  EXPECT_EQ(squarefree_part(linear(1, 1) * linear(1, 1) * linear(1, 1) * linear(3, 2)),
            linear(1, 1) * linear(3, 2));
  EXPECT_EQ(squarefree_part(p * Integer(-1)), polynomial({-3, 5, -2}));
}

TEST(Algebraic, ContentOfLongNumbers) {
  testing::RandomBodies random(603);
  SCOPED_TRACE(random.trace());
  const auto long_number = [&](int limbs) {
    Integer x = 1;
    for (int i = 0; i < limbs; ++i) x = (x << 52) + static_cast<long long>(random.uniform() * 0x1p52);
    return random.coin() ? x : Integer(-x);
  };
  for (int i = 0; i < 300; ++i) {
    const Integer content = abs(long_number(random.integer(0, 30)));
    Polynomial p;
    for (int k = random.integer(2, 5); k > 0; --k) p.push_back(content * long_number(random.integer(0, 60)));
    Integer expected = 0;
    for (const Integer& x : p) expected = boost::multiprecision::gcd(expected, x);
    const Polynomial q = primitive_part(p);
    for (std::size_t k = 0; k < p.size(); ++k) ASSERT_EQ(q[k] * expected, p[k]) << "case " << i;
  }
}

TEST(Algebraic, DyadicNumbers) {
  EXPECT_EQ(compare(Dyadic::of(0.75), Dyadic{3, 2}), 0);
  EXPECT_EQ(compare(Dyadic::of(-0.75), Dyadic{-7, 3}), 1);
  EXPECT_EQ(compare(Dyadic::power_of_two(-3), Dyadic::power_of_two(2)), -1);
  for (const double x : {0.0, 1.0, -0.1, 1e300, -1e-300, 0x1p-1074, 0x1.fffffffffffffp1023}) {
    const Interval i = enclosure(Dyadic::of(x));
    EXPECT_TRUE(i.contains(x)) << x;
    EXPECT_LE(i.rad(), std::abs(x) * 0x1p-52 + 4 * Interval::kTiny) << x;
  }
  EXPECT_FALSE(enclosure(Dyadic::power_of_two(1024)).finite());
  EXPECT_TRUE(enclosure(Dyadic::power_of_two(-1200)).contains(0x1p-1074) ||
              enclosure(Dyadic::power_of_two(-1200)).contains(0));
  EXPECT_EQ(log2_floor(Dyadic{-3, 4}), -3);
  EXPECT_EQ(scaled_value(polynomial({1, 0, 2}), Dyadic{3, 1}), 4 * 1 + 2 * 9);
  for (const auto& [lo, hi] :
       {std::pair(Dyadic{0, 0}, Dyadic{1, 0}), std::pair(Dyadic{1, 0}, Dyadic{3, 1}),
        std::pair(Dyadic{1, 100}, Dyadic{1, 0}), std::pair(Dyadic{-9, 0}, Dyadic{-1, 5})}) {
    EXPECT_EQ(compare(lo, between(lo, hi)), -1);
    EXPECT_EQ(compare(hi, between(lo, hi)), 1);
  }
  // One third lies between the ends.
  const Dyadic third{(Integer(1) << 90) / 3, 90};
  EXPECT_LT(compare(Dyadic::of(enclosure(third).lo()), third), 0);
  EXPECT_GT(compare(Dyadic::of(enclosure(third).hi()), third), 0);
}

TEST(Algebraic, RootsOfProductsOfLinearFactorsAreFoundInOrder) {
  testing::RandomBodies random(601);
  SCOPED_TRACE(random.trace());
  for (int round = 0; round < 400; ++round) {
    std::vector<std::pair<long, long>> factors(random.integer(1, 6));
    for (auto& [a, b] : factors) {
      a = random.integer(-12, 12);
      b = random.integer(1, 5);
    }
    Polynomial p = random.coin() ? polynomial({7, 0, 3}) : polynomial({-2});  // no real root
    for (const auto& [a, b] : factors)
      for (int times = random.integer(1, 2); times > 0; --times) p = p * linear(a, b);
    std::sort(factors.begin(), factors.end(),
              [](const auto& x, const auto& y) { return x.first * y.second < y.first * x.second; });
    factors.erase(
        std::unique(factors.begin(), factors.end(),
                    [](const auto& x, const auto& y) { return x.first * y.second == y.first * x.second; }),
        factors.end());
    auto roots = real_roots(p);
    ASSERT_EQ(roots.size(), factors.size());
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const auto [a, b] = factors[i];
      RealRoot copy = roots[i];
      ASSERT_EQ(sign_at(linear(a, b), copy), 0);
      copy = roots[i];
      ASSERT_EQ(sign_at(linear(a, b) * linear(a, b) * Integer(1) + polynomial({1}), copy), 1);
      ASSERT_EQ(copy.sign(), (a > 0) - (a < 0));
      ASSERT_TRUE(enclosure(copy).contains(static_cast<double>(a) / static_cast<double>(b)));
      for (std::size_t j = 0; j < roots.size(); ++j) {
        RealRoot x = roots[i], y = real_roots(linear(factors[j].first, factors[j].second)).front();
        ASSERT_EQ(compare(x, y), i < j ? -1 : i > j ? 1 : 0);
        ASSERT_EQ(compare(y, x), i < j ? 1 : i > j ? -1 : 0);
        ASSERT_EQ(sign_at(linear(factors[j].first, factors[j].second), x), i < j ? -1 : i > j ? 1 : 0);
      }
    }
  }
}

TEST(Algebraic, EqualityIsExact) {
  // The square root of two from three polynomials, and a neighbour at a distance of about 1e-40.
  RealRoot x = real_roots(polynomial({-2, 0, 1})).back(),
           y = real_roots(polynomial({-2, 0, 1}) * polynomial({-3, 0, 1}))[2],
           z = real_roots(polynomial({-4, 0, 0, 0, 1})).back();
  EXPECT_EQ(compare(x, y), 0);
  EXPECT_EQ(compare(y, z), 0);
  EXPECT_EQ(sign_at(z.polynomial(), x), 0);
  EXPECT_EQ(multiplicity(x, polynomial({-2, 0, 1}) * polynomial({-2, 0, 1}) * polynomial({-4, 0, 0, 0, 1})),
            3);
  EXPECT_EQ(multiplicity(x, polynomial({5, 1})), 0);
  const Integer large = Integer(1) << 400;
  const Polynomial near{Integer(-2) * large - 1, 0, large};
  RealRoot n = real_roots(near).back();
  EXPECT_EQ(compare(x, n), -1);
  EXPECT_EQ(compare(n, x), 1);
  EXPECT_EQ(sign_at(near, x), -1);
  EXPECT_EQ(sign_at(polynomial({-2, 0, 1}), n), 1);
  RealRoot negative = real_roots(polynomial({-2, 0, 1})).front();
  EXPECT_EQ(negative.sign(), -1);
  EXPECT_EQ(compare(negative, x), -1);
}

TEST(Algebraic, RootsThatNearlyMeet) {
  // Mignotte: x^d - 2 (m x - 1)^2 has two roots within about m^-(d+2)/2 of 1/m.
  const Integer m = Integer(1) << 40;
  Polynomial p{-2, 4 * m, -2 * m * m, 0, 0, 0, 0, 1};
  auto roots = real_roots(p);
  ASSERT_EQ(roots.size(), 3u);
  const Dyadic middle{1, 40};
  EXPECT_EQ(compare(roots[0], middle), -1);
  EXPECT_EQ(compare(roots[1], middle), 1);
  for (auto& root : roots) EXPECT_EQ(sign_at(p, root), 0);
}

TEST(Algebraic, RootsOfVeryDifferentSizes) {
  Polynomial p{1};
  for (const int e : {-900, -300, 0, 300, 900}) {
    const Polynomial positive = e < 0 ? Polynomial{-3, Integer(1) << -e} : Polynomial{Integer(-3) << e, 1};
    p = p * positive * Polynomial{-positive[0], positive[1]};
  }
  p.insert(p.begin(), Integer(0));
  auto roots = real_roots(p);
  ASSERT_EQ(roots.size(), 11u);
  for (std::size_t i = 0; i < 5; ++i) {
    const double expected = std::ldexp(3, -900 + static_cast<int>(i == 0   ? 0
                                                                  : i == 1 ? 600
                                                                  : i == 2 ? 900
                                                                  : i == 3 ? 1200
                                                                           : 1800));
    EXPECT_TRUE(enclosure(roots[6 + i]).contains(expected));
    EXPECT_TRUE(enclosure(roots[4 - i]).contains(-expected));
    EXPECT_LE(enclosure(roots[6 + i]).rad(), 0x1p-51 * expected);
  }
  EXPECT_TRUE(roots[5].is_dyadic());
  EXPECT_EQ(roots[5].sign(), 0);
  EXPECT_EQ(real_roots_in(p, Dyadic{0, 0}, Dyadic{3, 0}).size(), 4u);
  EXPECT_EQ(positive_roots(p).size(), 5u);
}

TEST(Algebraic, RandomSignsAgreeWithFloatingPoint) {
  testing::RandomBodies random(602);
  SCOPED_TRACE(random.trace());
  int roots_seen = 0;
  for (int round = 0; round < 500; ++round) {
    Polynomial p, q;
    for (int i = random.integer(2, 8); i >= 0; --i) p.emplace_back(random.integer(-1000, 1000));
    for (int i = random.integer(1, 6); i >= 0; --i) q.emplace_back(random.integer(-1000, 1000));
    trim(p);
    trim(q);
    if (p.empty() || q.empty()) continue;
    const auto horner = [](const Polynomial& f, double x) {
      double sum = 0;
      for (auto it = f.rbegin(); it != f.rend(); ++it) sum = sum * x + static_cast<double>(*it);
      return sum;
    };
    std::vector<RealRoot> roots = real_roots(p);
    // The number of roots: sign changes on a fine grid never exceed it.
    for (auto& root : roots) {
      ++roots_seen;
      const Interval x = enclosure(root);
      const double scale = std::pow(1 + std::abs(x.mid()), static_cast<double>(q.size())) * 1000;
      const double value = horner(q, x.mid());
      if (std::abs(value) > 1e-10 * scale) {
        ASSERT_EQ(sign_at(q, root), value > 0 ? 1 : -1);
      }
      ASSERT_EQ(sign_at(p, root), 0);
      ASSERT_EQ(sign_at(p * q, root), 0);
    }
    int changes = 0;
    for (int i = -2000; i < 2000; ++i)
      changes += horner(p, i * 0.01 + 0.001) * horner(p, i * 0.01 + 0.011) < 0;
    ASSERT_LE(changes, static_cast<int>(roots.size()));
    for (std::size_t i = 1; i < roots.size(); ++i) ASSERT_EQ(compare(roots[i - 1], roots[i]), -1);
  }
  EXPECT_GT(roots_seen, 500);
}

}  // namespace
}  // namespace vericone::exact::algebraic_test
