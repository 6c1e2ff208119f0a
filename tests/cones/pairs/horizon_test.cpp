// SPDX-License-Identifier: BSD-3-Clause
//
// Verdicts within a horizon: contacts exactly at its ends in whole numbers, laws of all kinds of pairs, and a
// march of relations, which know nothing of motion, as truth.
#include <vericone/cones/pair.h>

#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>
#include <array>
#include <cmath>
#include <tuple>

#include "support/allocations.h"
#include "support/campaign.h"

namespace vericone::pair_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::campaign_size;
using testing::RandomBodies;
using testing::share;

constexpr double kEver = std::numeric_limits<double>::infinity();
const Vector3d kStill = Vector3d::Zero();

int rank(Verdict verdict) {
  switch (verdict) {
    case Verdict::out:
      return 0;
    case Verdict::on:
    case Verdict::touching:
      return 1;
    case Verdict::in:
    case Verdict::overlapping:
      return 2;
    case Verdict::undecided:
      break;
  }
  return -1;
}

Matrix3d shear(RandomBodies& random) {
  Matrix3d g = Matrix3d::Identity();
  const int i = static_cast<int>(random.uniform(0, 3)) % 3, j = (i + 1 + (random.uniform(0, 1) < 0.5)) % 3;
  g(i, j) = std::floor(random.uniform(-2, 3));
  return g;
}

Vector3d whole(RandomBodies& random, double most) {
  Vector3d w;
  do
    for (int k = 0; k < 3; ++k) w(k) = std::floor(random.uniform(-most, most + 1));
  while (w.isZero(0));
  return w;
}

/// Two bodies that touch from outside when the obstacle is at `at`, with the normal n; all in whole numbers.
struct Touching {
  Body agent, obstacle;
  Vector3d at, normal;
  bool round;
};

/// Semi-axes of two ellipsoids from Pythagorean quadruples (u; d): x_i = u_i alpha_i has the whole support
/// alpha_i u_i^2 / d along n_i = 1 / alpha_i. Sheared, so that nothing is along an axis.
Touching touching_ellipsoids(RandomBodies& random) {
  constexpr std::array<std::array<int, 4>, 6> kQuadruples{
      {{1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}, {4, 4, 7, 9}, {2, 6, 9, 11}, {6, 6, 7, 11}}};
  const auto any = [&] { return kQuadruples[static_cast<std::size_t>(random.uniform(0, 6)) % 6]; };
  const auto u = any(), v = any();
  Vector3d a, b, q, n;
  for (int i = 0; i < 3; ++i) {
    const double sign = random.uniform(0, 1) < 0.5 ? -1 : 1, m = 1 + std::floor(random.uniform(0, 4));
    const double alpha = u[3] * v[3] * m;
    a(i) = u[i] * alpha;
    b(i) = v[i] * alpha;
    q(i) = sign * (a(i) * u[i] / u[3] + b(i) * v[i] / v[3]);
    n(i) = sign / m;
  }
  const Matrix3d g = shear(random) * shear(random);
  const auto body = [&](const Vector3d& axes) {
    return Ellipsoid::from_shape(kStill, g * axes.cwiseAbs2().asDiagonal() * g.transpose());
  };
  return {body(a), body(b), g * q, g.inverse().transpose() * n, true};
}

/// Boxes whose faces come to lie on each other, sheared.
Touching touching_hulls(RandomBodies& random) {
  const auto size = [&] { return 1 + std::floor(random.uniform(0, 6)); };
  const Vector3d a(size(), size(), size()), b(size(), size(), size());
  const Matrix3d g = shear(random) * shear(random);
  const auto body = [&](const Vector3d& half) {
    auto points = HullBody::box(-half, half).points();
    for (Vector3d& x : points) x = g * x;
    return HullBody(std::move(points));
  };
  const int k = static_cast<int>(random.uniform(0, 3)) % 3;
  Vector3d q, n = kStill;
  for (int i = 0; i < 3; ++i) q(i) = std::floor(random.uniform(-(a(i) + b(i)) + 1, a(i) + b(i)));
  n(k) = random.uniform(0, 1) < 0.5 ? -1 : 1;
  q(k) = n(k) * (a(k) + b(k));
  return {body(a), body(b), g * q, g.inverse().transpose() * n, false};
}

/// The same hull as one piece of an assembly, so that assemblies' own predicates are asked.
Body as_assembly(const Body& hull) { return Assembly::polyhedra({std::get<HullBody>(hull.shape())}); }

TEST(WithinHorizon, ContactsExactlyAtItsEndsAreOn) {
  RandomBodies random(3801);
  SCOPED_TRACE(random.trace());
  int entered = 0, left = 0, grazed = 0;
  for (int i = 0; i < share(2400); ++i) {
    Touching t = i % 2 == 0 ? touching_ellipsoids(random) : touching_hulls(random);
    if (i % 4 == 1) t.obstacle = as_assembly(t.obstacle);
    if (i % 8 == 5) t.agent = as_assembly(t.agent);
    Vector3d w = whole(random, 9);
    if (i % 5 == 0) {
      // Along the plane that they touch in.
      w = Vector3d(t.normal.cross(whole(random, 3)) * 144);
      w = Vector3d(w.array().round());
      if (w.isZero(0) || t.normal.dot(w) != 0) continue;
    }
    const double T =
        std::ldexp(1 + std::floor(random.uniform(0, 200)), -static_cast<int>(random.uniform(0, 8)));
    const Vector3d v = whole(random, 5), at = t.at + T * w;
    const Pair pair(Placed(t.agent), Placed(t.obstacle, Pose{at}));
    const auto verdict = [&](double from, double until) {
      return pair.verdict(w + v, v, Horizon{from, until});
    };
    const double side = t.normal.dot(w);
    if (i % 5 != 0 && std::abs(side) < 1e-9) continue;
    const bool apart = pair.relation() == Relation::disjoint;
    for (const int power : {20, 45}) {
      const double sooner = T * (1 - std::ldexp(1.0, -power)), later = T * (1 + std::ldexp(1.0, -power));
      SCOPED_TRACE("case " + std::to_string(i) + ", power " + std::to_string(power));
      if (i % 5 == 0) {
        ++grazed;
        if (t.round) {
          ASSERT_EQ(verdict(0, sooner), Verdict::out);
          ASSERT_EQ(verdict(0, T), Verdict::on);
          ASSERT_EQ(verdict(0, later), Verdict::on);
          ASSERT_EQ(verdict(T, T), Verdict::on);
          ASSERT_EQ(verdict(T, kEver), Verdict::on);
          ASSERT_EQ(verdict(later, kEver), Verdict::out);
        } else {
          ASSERT_EQ(verdict(sooner, later), Verdict::on);
          ASSERT_EQ(verdict(T, T), Verdict::on);
        }
      } else if (side > 0) {
        ++entered;
        ASSERT_TRUE(apart);
        ASSERT_EQ(verdict(0, sooner), Verdict::out);
        ASSERT_EQ(verdict(0, T), Verdict::on);
        ASSERT_EQ(verdict(0, later), Verdict::in);
        ASSERT_EQ(verdict(sooner, T), Verdict::on);
        ASSERT_EQ(verdict(T, T), Verdict::on);
        ASSERT_EQ(verdict(T, later), Verdict::in);
        ASSERT_EQ(verdict(T, kEver), Verdict::in);
      } else {
        ++left;
        ASSERT_EQ(verdict(T, T), Verdict::on);
        ASSERT_EQ(verdict(T, kEver), Verdict::on);
        ASSERT_EQ(verdict(sooner, T), Verdict::in);
        ASSERT_EQ(verdict(later, kEver), Verdict::out);
        ASSERT_EQ(verdict(later, 2 * later), Verdict::out);
        if (apart) {
          ASSERT_EQ(verdict(0, T), Verdict::in);
        }
      }
    }
  }
  EXPECT_GT(std::min({entered, left, grazed}), 60);
}

TEST(WithinHorizon, OfThinBodiesAnInstant) {
  // A plate flown through, a segment through a plate, a point along a plate.
  const HullBody plate({{0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}});
  const HullBody point({{-3, 0.25, 0}}), across({{-3, 0, 0}, {-2, 0, 0}});
  for (const bool pieces : {false, true}) {
    const Body wall = pieces ? Body(Assembly::polyhedra({plate})) : Body(plate);
    const Pair of_point{Placed(Body(point)), Placed(wall)};
    const auto ask = [](const Pair& pair, const Vector3d& w, double from, double until) {
      return pair.verdict(w, kStill, Horizon{from, until});
    };
    EXPECT_EQ(ask(of_point, {1, 0, 0}, 0, 2.5), Verdict::out);
    EXPECT_EQ(ask(of_point, {1, 0, 0}, 0, 3), Verdict::on);
    EXPECT_EQ(ask(of_point, {1, 0, 0}, 0, 3.5), Verdict::in);
    EXPECT_EQ(ask(of_point, {1, 0, 0}, 3, 3.5), Verdict::on);
    EXPECT_EQ(ask(of_point, {1, 0, 0}, 3.125, 3.5), Verdict::out);
    const Pair of_segment{Placed(Body(across)), Placed(wall)};
    EXPECT_EQ(ask(of_segment, {1, 0, 0}, 0, 2), Verdict::on);
    EXPECT_EQ(ask(of_segment, {1, 0, 0}, 2.5, 2.5), Verdict::in);
    EXPECT_EQ(ask(of_segment, {1, 0, 0}, 3, 4), Verdict::on);
    const Pair beside{Placed(Body(HullBody({{0, -3, 0}}))), Placed(wall)};
    EXPECT_EQ(ask(beside, {0, 1, 0}, 0, 1.5), Verdict::out);
    EXPECT_EQ(ask(beside, {0, 1, 0}, 0, 2), Verdict::on);
    EXPECT_EQ(ask(beside, {0, 1, 0}, 0, 9), Verdict::on);
    EXPECT_EQ(ask(beside, {0, 1, 0}, 4, 9), Verdict::on);
    EXPECT_EQ(ask(beside, {0, 1, 0}, 4.5, 9), Verdict::out);
  }
  // Where two plates of one wall join, a point passes through the wall.
  const HullBody left({{0, -1, -1}, {0, 0, -1}, {0, 0, 1}, {0, -1, 1}}),
      right({{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}});
  const Pair seam{Placed(Body(HullBody({{-3, 0, 0}}))), Placed(Body(Assembly::polyhedra({left, right})))};
  EXPECT_EQ(seam.verdict({1, 0, 0}, kStill), Verdict::in);
  EXPECT_EQ(seam.verdict({1, 0, 0}, kStill, Horizon{0, 2}), Verdict::out);
  EXPECT_EQ(seam.verdict({1, 0, 0}, kStill, Horizon{0, 3}), Verdict::on);
  EXPECT_EQ(seam.verdict({1, 0, 0}, kStill, Horizon{0, 4}), Verdict::in);
}

// Contact from 1 to 5 along w = (1, 0, 0): of a little more or less speed, or time, than doubles can tell
// from it.
TEST(WithinHorizon, NeitherVelocitiesNorTheirProductsWithTimesAreRounded) {
  const HullBody cube = HullBody::box({-1, -1, -1}, {1, 1, 1});
  const Body bodies[] = {Ellipsoid(), cube, Assembly::polyhedra({cube}),
                         Assembly::boxes({{{-1, -1, -1}, {1, 1, 1}}})};
  for (const Body& agent : bodies)
    for (const Body& obstacle : bodies) {
      const Pair pair(Placed(agent), Placed(obstacle, Pose{{3, 0, 0}}));
      SCOPED_TRACE(pair.guarantee().family);
      const Vector3d w(1, 0, 0), little(0x1p-60, 0, 0);
      const auto ask = [&](const Vector3d& v_b, double from, double until) {
        return pair.verdict(w, v_b, Horizon{from, until});
      };
      EXPECT_EQ(ask(kStill, 0, 1), Verdict::on);
      EXPECT_EQ(ask(-little, 0, 1), Verdict::in);
      EXPECT_EQ(ask(little, 0, 1), Verdict::out);
      EXPECT_EQ(ask(kStill, 5, kEver), Verdict::on);
      EXPECT_EQ(ask(-little, 5, kEver), Verdict::out);
      EXPECT_EQ(ask(-little, 5, 6), Verdict::out);
      EXPECT_EQ(ask(little, 5, 6), Verdict::in);
      const double more = 1 + 0x1p-30, less = 1 - 0x1p-30;  // more * less = 1 - 2^-60
      EXPECT_EQ(pair.verdict(less * w, kStill, Horizon{0, more}), Verdict::out);
      EXPECT_EQ(pair.verdict(less * w, kStill, Horizon{5 * more, kEver}), Verdict::in);
    }
}

// A velocity with a part below 1e-290 of the rest gets somewhere in the end.
TEST(WithinHorizon, OfPartsThatAreHardlyThere) {
  for (const double side : {1.0, -1.0}) {
    const auto box = [&](const Vector3d& from, const Vector3d& to) {
      const Vector3d mirror(1, side, 1), p = from.cwiseProduct(mirror), q = to.cwiseProduct(mirror);
      return Box{p.cwiseMin(q), p.cwiseMax(q)};
    };
    const Box small = box({-1, -1e-160, -1}, {1, 0, 1}), wall = box({-5, 1e-152, -1}, {1e150, 1e-150, 1});
    const Vector3d w(1, side * 1e-300, 0);
    for (const Body& agent : {Body(HullBody::box(small.low, small.high)), Body(Assembly::boxes({small}))}) {
      const Pair pair(Placed(agent), Placed(Body(Assembly::boxes({wall}))));
      SCOPED_TRACE(pair.guarantee().family);
      EXPECT_EQ(pair.verdict(w, kStill), Verdict::in);
      EXPECT_EQ(pair.verdict(w, kStill, Horizon{0, 1e147}), Verdict::out);
      EXPECT_EQ(pair.verdict(w, kStill, Horizon{0, 1e149}), Verdict::in);
      EXPECT_EQ(pair.verdict(w, kStill, Horizon{1e145, 1e149}), Verdict::in);
      EXPECT_EQ(pair.verdict(w, kStill, Horizon{1e149, 1e149}), Verdict::in);
      EXPECT_EQ(pair.verdict(-w, kStill, Horizon{0, 1e149}), Verdict::out);
    }
  }
}

class EveryPairWithin : public ::testing::TestWithParam<std::tuple<BodyKind, BodyKind>> {};

TEST_P(EveryPairWithin, KeepsTheLawsAndAgreesWithAMarch) {
  const auto [first, second] = GetParam();
  RandomBodies random(3810 + 7 * static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(second));
  SCOPED_TRACE(random.trace());
  int asked = 0, decided = 0, marched = 0, met = 0;
  for (int i = 0; i < campaign_size(40, 1000); ++i) {
    const Placed a(any_body(random, first), any_pose(random, 0.5));
    const Placed b(any_body(random, second), any_pose(random, random.uniform(4, 9)));
    const Pair pair(a, b), mirrored(b, a);
    const Vector3d c = b.pose.position - a.pose.position;
    const Vector3d w = (c + random.uniform(0, 4) * random.direction()) * random.log_uniform(0.1, 10);
    const Vector3d v = random.direction(), v_a = w + v;
    const double way = c.norm() / (v_a - v).norm();  // s
    std::array<double, 3> t{random.uniform(0, 2) * way, random.uniform(0, 2) * way,
                            random.uniform(0, 2) * way};
    std::sort(t.begin(), t.end());
    const auto ask = [&](double from, double until) { return pair.verdict(v_a, v, Horizon{from, until}); };
    const bool exact = pair.guarantee().exact;
    SCOPED_TRACE("pair " + std::to_string(i));
    const Verdict ever = pair.verdict(v_a, v), early = ask(0, t[0]), late = ask(0, t[2]);
    asked += 2;
    decided += (early != Verdict::undecided) + (late != Verdict::undecided);
    ASSERT_EQ(ask(0, kEver), ever);
    if (exact) {
      ASSERT_NE(early, Verdict::undecided);
      ASSERT_NE(late, Verdict::undecided);
      ASSERT_NE(ask(t[0], t[2]), Verdict::undecided);
    }
    if (pair.relation() != Relation::disjoint) continue;
    // It grows with its end, and falls with its beginning.
    const auto at_most = [](Verdict x, Verdict y) {
      return rank(x) < 0 || rank(y) < 0 || rank(x) <= rank(y);
    };
    ASSERT_TRUE(at_most(early, late)) << to_string(early) << " " << to_string(late);
    ASSERT_TRUE(at_most(late, ever));
    const Verdict window = ask(t[0], t[2]), before = ask(t[0], t[1]), after = ask(t[1], t[2]);
    ASSERT_TRUE(at_most(window, late));
    if (rank(window) >= 0 && rank(before) >= 0 && rank(after) >= 0) {
      ASSERT_EQ(rank(window), std::max(rank(before), rank(after)));
    }
    // Exchanged; twice as fast in half the time.
    ASSERT_EQ(mirrored.verdict(v, v_a, Horizon{0, t[1]}), ask(0, t[1]));
    ASSERT_EQ(mirrored.verdict(v, v_a, Horizon{t[0], t[1]}), before);
    ASSERT_EQ(pair.verdict(8 * v_a, 8 * v, Horizon{0.125 * t[0], 0.125 * t[1]}), before);
    // The brackets of the first contact.
    if (const auto contact = pair.contact(v_a, v)) {
      if (contact->earliest > t[1] * (1 + 1e-12)) {
        ASSERT_TRUE(ask(0, t[1]) == Verdict::out || !exact);
      }
      if (contact->latest < t[1] * (1 - 1e-12)) {
        ASSERT_NE(ask(0, t[1]), Verdict::out);
      }
    }
    // A march of standing bodies.
    constexpr int kSteps = 24;
    for (int step = 0; step <= kSteps; ++step) {
      Placed moved = a;
      moved.pose.position += (t[0] + (t[2] - t[0]) * step / kSteps) * (v_a - v);
      const auto now = relation_of(WorldBody(moved), WorldBody(b), pair.guarantee().exact ? 1e-6 : 1e-3);
      if (now != Relation::overlapping) continue;
      ++met;
      // Of a body and a place that rounding changes a little.
      if (step > 0 && step < kSteps) {
        ASSERT_TRUE(window == Verdict::in || (window == Verdict::undecided && !exact))
            << to_string(window) << " at step " << step;
      }
    }
    ++marched;
  }
  EXPECT_GE(decided, 0.9 * asked);
  EXPECT_GT(met, 0);
  EXPECT_GT(marched, asked / 4);
}

std::string kinds_within(const ::testing::TestParamInfo<EveryPairWithin::ParamType>& info) {
  return std::string(to_string(std::get<0>(info.param))) + "_and_" + to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryPairWithin,
                         ::testing::Combine(::testing::ValuesIn(kBodyKinds), ::testing::ValuesIn(kBodyKinds)),
                         kinds_within);

TEST(WithinHorizon, IsRefusedWhereItIsNone) {
  const Pair pair(Placed(Ellipsoid()), Placed(Ellipsoid(), Pose{{5, 0, 0}}));
  const auto refused = [&](const Vector3d& v_a, const Horizon& horizon) {
    try {
      static_cast<void>(pair.verdict(v_a, kStill, horizon));
    } catch (const InputError& error) {
      return error.field();
    }
    return std::string("nothing");
  };
  const Vector3d w(1, 0, 0);
  for (const Horizon& horizon :
       {Horizon{-1, 2}, Horizon{2, 1}, Horizon{NAN, 1}, Horizon{0, NAN}, Horizon{kEver, kEver}})
    EXPECT_EQ(refused(w, horizon), "horizon");
  EXPECT_EQ(refused({NAN, 0, 0}, {0, 1}), "agent_velocity[0]");
  EXPECT_EQ(pair.verdict(kStill, kStill, Horizon{0, 1}), Verdict::out);
  EXPECT_EQ(pair.verdict(w, kStill, Horizon{0, 0}), Verdict::out);
  EXPECT_EQ(pair.verdict(w, kStill, Horizon{0, 3}), Verdict::on);
  EXPECT_EQ(pair.verdict(w, kStill, Horizon{7, 9}), Verdict::on);
  // Far and slow, near and fast.
  EXPECT_EQ(pair.verdict(1e-300 * w, kStill, Horizon{0, 2.9e300}), Verdict::out);
  EXPECT_EQ(pair.verdict(1e-300 * w, kStill, Horizon{0, 3.1e300}), Verdict::in);
  EXPECT_EQ(pair.verdict(1e300 * w, kStill, Horizon{0, 2.9e-300}), Verdict::out);
  EXPECT_EQ(pair.verdict(1e300 * w, kStill, Horizon{0, 3.1e-300}), Verdict::in);
}

TEST(WithinHorizon, OfTwoEllipsoidsAllocatesNothing) {
  RandomBodies random(3803);
  const Pair pair(Placed(any_body(random, BodyKind::ellipsoid)),
                  Placed(any_body(random, BodyKind::ellipsoid), Pose{{6, 1, 0}}));
  int in = 0;
  const auto before = testing::allocations();
  for (int i = 0; i < 200; ++i) {
    const Vector3d w = Vector3d(6, 1, 0) + random.direction() * random.uniform(0, 3);
    in += pair.verdict(w, kStill, Horizon{0, random.uniform(0, 2)}) == Verdict::in;
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(in, 10);
}

}  // namespace
}  // namespace vericone::pair_test
