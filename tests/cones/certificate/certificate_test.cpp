// SPDX-License-Identifier: BSD-3-Clause
//
// Certificates: that there are some, that they say the verdict, and that of two ellipsoids they are right by
// formulas of their own in fractions. A checker that knows nothing of the library reads those of all kinds in
// query_test.py.
#include <vericone/cones/certificate.h>

#include <gtest/gtest.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/testing/random_bodies.h>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/cones/ellipsoids/exact_tangency.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using exact::Rational;
using exact::RationalBody;
using exact::RationalVector;
using testing::RandomBodies;

/// The text behind the last field of that name, up to its end as a number or a list of numbers.
std::string field(const std::string& text, const std::string& name) {
  const auto found = text.rfind("\"" + name + "\": ");
  if (found == std::string::npos) return {};
  const auto start = found + name.size() + 4;
  return text.substr(start, text[start] == '[' ? text.find(']', start) + 1 - start
                                               : text.find_first_of(",}", start) - start);
}

/// A double or a fraction in quotes.
Rational number(std::string text) {
  std::erase_if(text, [](char c) { return c == '"' || c == ' ' || c == '[' || c == ']'; });
  const auto slash = text.find('/');
  const auto whole = [](const std::string& digits) { return boost::multiprecision::cpp_int(digits); };
  if (slash != std::string::npos) return Rational(text.substr(0, slash) + "/" + text.substr(slash + 1));
  if (text.find_first_of(".e") != std::string::npos) return Rational(std::stod(text));
  return Rational(whole(text).str());
}

std::vector<Rational> numbers(const std::string& list) {
  std::vector<Rational> all;
  for (std::size_t from = 0; from < list.size();) {
    const auto until = std::min(list.find(',', from), list.size());
    all.push_back(number(list.substr(from, until - from)));
    from = until + 1;
  }
  return all;
}

using Fractions = RationalVector<3>;

Fractions fractions(const Vector3d& v) { return exact::to_rational<3>(v); }
Rational dot(const Fractions& x, const Fractions& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Fractions minus(const Fractions& x, const Fractions& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }

Rational form(const RationalBody<3>& body, const Fractions& n) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += n[i] * body.shape[i][j] * n[j];
  return sum;
}

struct Case {
  Ellipsoid a, b;
  Vector3d v_a, v_b;
  Horizon horizon = {};

  [[nodiscard]] Pair pair() const { return Pair(Placed(a), Placed(b)); }
};

/// The normal of a plane, as it is or by the axes across w.
Fractions normal_of(const std::string& text, const Fractions& w) {
  const std::vector<Rational> n = numbers(field(text, "n"));
  if (n.size() == 3) return {n[0], n[1], n[2]};
  const std::vector<Rational> across = numbers(field(text, "across_w"));
  const int k = static_cast<int>(static_cast<double>(across.at(0))), i = k == 0 ? 1 : 0, j = k == 2 ? 1 : 2;
  Fractions r;
  r[i] = across[1] * w[k];
  r[j] = across[2] * w[k];
  r[k] = -across[1] * w[i] - across[2] * w[j];
  return r;
}

/// In fractions: that a proof is one.
void expect_right(const Case& c, Verdict verdict, const std::string& text) {
  const RationalBody<3> a(c.a), b(c.b);
  const bool now = verdict == Verdict::touching || verdict == Verdict::overlapping;
  const Fractions v_a = fractions(now ? Vector3d::Zero() : c.v_a),
                  v_b = fractions(now ? Vector3d::Zero() : c.v_b), w = minus(v_a, v_b);
  if (verdict == Verdict::out) {
    const Fractions n = normal_of(text, w);
    const Rational along = dot(n, w), q_a = form(a, n), q_b = form(b, n);
    if (std::isinf(c.horizon.until)) {
      EXPECT_LE(along, 0) << text;
    }
    for (const double t : {c.horizon.from, c.horizon.until}) {
      if (std::isinf(t)) continue;
      const Rational gap = dot(n, minus(b.center, a.center)) - Rational(t) * along,
                     rest = gap * gap - q_a - q_b;
      EXPECT_TRUE(gap > 0 && rest > 0 && rest * rest > 4 * q_a * q_b) << text;
    }
    return;
  }
  const Rational t = number(field(text, "time"));
  if (!now) {
    EXPECT_GE(t, Rational(c.horizon.from)) << text;
    if (!std::isinf(c.horizon.until)) {
      EXPECT_LE(t, Rational(c.horizon.until)) << text;
    }
  }
  const std::vector<Rational> x = numbers(field(text, "point"));
  ASSERT_EQ(x.size(), 3U);
  const auto place = [&](const Fractions& v) {
    return Fractions{x[0] - t * v[0], x[1] - t * v[1], x[2] - t * v[2]};
  };
  const Sign expected =
      verdict == Verdict::in || verdict == Verdict::overlapping ? Sign::negative : Sign::zero;
  EXPECT_EQ(exact::side<3>(a, place(v_a)), expected) << text;
  EXPECT_EQ(exact::side<3>(b, place(v_b)), expected) << text;
  if (expected == Sign::negative) return;
  const Fractions n = normal_of(text, w);
  const Rational along = dot(n, w);
  EXPECT_TRUE(along == 0 || t == Rational(c.horizon.from) || t == Rational(c.horizon.until)) << text;
  // The widths along n, exactly: both bodies touch the plane through the point.
  const Fractions from_a = minus(place(v_a), a.center), from_b = minus(b.center, place(v_b));
  EXPECT_EQ(dot(n, from_a) * dot(n, from_a), form(a, n)) << text;
  EXPECT_EQ(dot(n, from_b) * dot(n, from_b), form(b, n)) << text;
  EXPECT_TRUE(dot(n, from_a) > 0 && dot(n, from_b) > 0) << text;
}

void expect_certificate(const Case& c) {
  const Pair pair = c.pair();
  const Verdict verdict = pair.verdict(c.v_a, c.v_b, c.horizon);
  const Certificate found = pair.certificate(c.v_a, c.v_b, c.horizon, "\"it\"");
  ASSERT_FALSE(found.text.empty()) << to_string(verdict) << ": " << found.reason;
  EXPECT_TRUE(found.reason.empty());
  EXPECT_NE(found.text.find("\"says\": \"" + std::string(to_string(verdict)) + "\", \"id\": \"it\""),
            std::string::npos)
      << found.text;
  expect_right(c, verdict, found.text);
}

void expect_both_ways(const Case& c) {
  expect_certificate(c);
  expect_certificate({c.b, c.a, c.v_b, c.v_a, c.horizon});
}

Horizon any_horizon(RandomBodies& random) {
  Horizon horizon;
  if (random.coin()) return horizon;
  horizon.until = random.integer(0, 32) / 8.0;
  if (random.coin()) horizon.from = horizon.until * random.integer(0, 4) / 4;
  if (random.integer(0, 4) == 0) horizon.until = std::numeric_limits<double>::infinity();
  return horizon;
}

TEST(Certificates, OfRandomEllipsoidsAreRight) {
  RandomBodies random(801);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 150; ++i) {
    const double least = i % 3 == 0 ? 1e-6 : 0.3;
    const auto [a, b] = random.scaled_from_touching(least, 3, random.uniform(0.6, 3));
    const Vector3d v_b = random.in_box(2), c = b.center() - a.center();
    expect_both_ways({a, b, v_b + random.uniform(-0.5, 1) * c + random.in_box(1), v_b, any_horizon(random)});
  }
}

TEST(Certificates, OfExactTangenciesAreRight) {
  RandomBodies random(802);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const auto t = testing::ExactTangency::random(random, std::ldexp(1.0, random.integer(0, 3)));
    expect_both_ways({t.a, t.b, t.w, Vector3d::Zero(), any_horizon(random)});
    expect_both_ways({t.touching_a, t.touching_b, random.in_box(3), Vector3d::Zero(), {}});
    expect_both_ways({t.touching_a, t.touching_b, -t.normal, Vector3d::Zero(), {0.5, 2}});
  }
}

TEST(Certificates, OfNearGrazesAreRight) {
  RandomBodies random(803);
  SCOPED_TRACE(random.trace());
  for (int bits = 10; bits <= 56; bits += 2)
    for (int i = 0; i < 4; ++i) {
      const auto t = testing::ExactTangency::random(random);
      const double e = std::ldexp(1.0, -bits);
      expect_both_ways({t.a, t.b.translated(20 * e * random.direction()), t.w, Vector3d::Zero(), {}});
      expect_both_ways(
          {t.a, t.b, t.w + e * t.w.norm() * random.direction(), Vector3d::Zero(), any_horizon(random)});
      expect_both_ways({t.touching_a, t.touching_b.translated(20 * e * random.direction()), random.in_box(2),
                        random.in_box(2), any_horizon(random)});
    }
}

TEST(Certificates, OfConcentricAndResting) {
  const Ellipsoid ball = Ellipsoid::from_axes(Vector3d::Zero(), Vector3d::Ones());
  const Ellipsoid far = ball.translated({4, 0, 0});
  for (const Vector3d& w : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(-1, 0, 0)})
    for (const Horizon& horizon : {Horizon{}, Horizon{0, 1}, Horizon{1, 3}, Horizon{2, 2}}) {
      expect_both_ways({ball, far, w, Vector3d::Zero(), horizon});
      expect_both_ways({ball, ball, w, Vector3d::Zero(), horizon});
    }
}

TEST(Certificates, OfEveryTwoKindsSayTheVerdict) {
  RandomBodies random(804);
  SCOPED_TRACE(random.trace());
  int without = 0, of_dents = 0;
  for (const BodyKind agent : kBodyKinds)
    for (const BodyKind obstacle : kBodyKinds)
      for (int i = 0; i < 4; ++i) {
        const Pair pair(Placed(any_body(random, agent), any_pose(random, 1)),
                        Placed(any_body(random, obstacle), any_pose(random, random.uniform(5, 12))));
        const Vector3d v_b = random.in_box(1), v_a = v_b + pair.obstacle().pose.position + random.in_box(4);
        const Horizon horizon = any_horizon(random);
        const Verdict verdict = pair.verdict(v_a, v_b, horizon);
        const Certificate found = pair.certificate(v_a, v_b, horizon);
        const bool dents = agent == BodyKind::combined || obstacle == BodyKind::combined ||
                           agent == BodyKind::pieces || obstacle == BodyKind::pieces;
        of_dents += dents;
        if (found.text.empty()) {
          EXPECT_TRUE(dents) << to_string(agent) << ' ' << to_string(obstacle) << ' ' << to_string(verdict);
          EXPECT_FALSE(found.reason.empty());
          ++without;
          continue;
        }
        EXPECT_NE(found.text.find("\"says\": \"" + std::string(to_string(verdict)) + "\""),
                  std::string::npos);
      }
  EXPECT_LE(without, of_dents / 20);
}

TEST(Certificates, OfErrorsSayWhatAllOfThemLeadTo) {
  RandomBodies random(805);
  SCOPED_TRACE(random.trace());
  int seen[4] = {};
  for (int i = 0; i < 200; ++i) {
    const auto [a, b] = random.scaled_from_touching(0.3, 3, random.uniform(1.2, 3));
    const Pair pair{Placed(a), Placed(b)};
    const Vector3d v_b = random.in_box(1), v_a = v_b + 0.3 * (b.center() - a.center()) + random.in_box(0.6);
    RelativeErrors errors;
    const double size = random.uniform(0.01, 1);
    if (i % 3 == 0) errors.position = ErrorSet::ball(size);
    if (i % 3 == 1) errors.position = ErrorSet::box(size * Vector3d(1, 0, 0.5));
    if (i % 3 == 2) errors.position = ErrorSet::ellipsoid(Vector3d(size, 1, 0.1), random.rotation());
    if (random.coin()) errors.velocity = ErrorSet::ball(0.1 * size);
    if (random.coin()) errors.horizon = random.integer(1, 40) / 4.0;
    const RobustVerdict verdict = robust_verdict(pair, v_a, v_b, errors).verdict;
    const Certificate found = pair.certificate(v_a, v_b, errors, "3");
    ++seen[static_cast<int>(verdict)];
    if (verdict == RobustVerdict::undecided) continue;
    EXPECT_NE(found.text.find("\"says\": \"" + std::string(to_string(verdict)) + "\", \"id\": 3"),
              std::string::npos)
        << found.text << found.reason;
    EXPECT_NE(found.text.find("\"position_error\": "), std::string::npos);
  }
  for (const RobustVerdict verdict : {RobustVerdict::out, RobustVerdict::in, RobustVerdict::depends})
    EXPECT_GT(seen[static_cast<int>(verdict)], 10) << to_string(verdict);
}

TEST(Certificates, OfErrorsThatTheFormatHasNot) {
  const Pair pair(Placed(Ellipsoid{}), Placed(Ellipsoid{}.translated({4, 3, 0})));
  const auto with = [&](const auto& change) {
    RelativeErrors errors;
    errors.horizon = 3;
    change(errors);
    return pair.certificate(Vector3d(1, 0, 0), Vector3d::Zero(), errors);
  };
  EXPECT_EQ(with([](auto& e) { e.size = 0.1; }).reason, "the format has no errors of size");
  EXPECT_EQ(with([](auto& e) { e.attitude_b = 0.1; }).reason, "the format has no errors of attitude");
  EXPECT_EQ(with([](auto& e) { e.acceleration = 0.1; }).reason, "the format has no accelerations");
  EXPECT_EQ(with([](auto& e) {
              e.position = ErrorSet::ball(0.1) + ErrorSet::box({0.1, 0, 0});
            }).reason,
            "the errors are no ball, ellipsoid or box along the axes, but a sum of some");
  EXPECT_TRUE(with([](auto& e) { e.size = 0.1; }).text.empty());
  // No error at all: the certificate of the verdict.
  EXPECT_EQ(with([](auto&) {}).text, pair.certificate(Vector3d(1, 0, 0), Vector3d::Zero(), {0, 3}).text);
}

TEST(Certificates, BadVelocitiesAreRefused) {
  const Pair pair(Placed(Ellipsoid{}), Placed(Ellipsoid{}.translated({4, 0, 0})));
  EXPECT_THROW(static_cast<void>(pair.certificate(Vector3d(NAN, 0, 0), Vector3d::Zero())), std::exception);
}

}  // namespace
}  // namespace vericone
