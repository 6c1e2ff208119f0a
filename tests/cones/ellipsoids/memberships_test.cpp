// SPDX-License-Identifier: BSD-3-Clause
//
// Many velocities at once: the answers of single calls, at every width of vector registers. And the forms
// that answer both against the exact rung, where their bounds are strained: far from |w| = 1, thin, distant,
// tangent.
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/testing/random_bodies.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "cones/ellipsoids/exact_tangency.h"
#include "support/allocations.h"
#include "support/campaign.h"

namespace vericone::memberships_test {
namespace {

using Eigen::Vector3d;
using testing::ExactTangency, testing::RandomBodies, testing::share;

constexpr VectorWidth kWidths[] = {VectorWidth::two, VectorWidth::four, VectorWidth::eight};

ConeOracle unit_balls() {
  return {Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}), Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2})};
}

/// A pair and a velocity on the boundary of its cone, the latter exactly where the pair is drawn so.
struct Drawn {
  ConeOracle oracle;
  Vector3d edge;
};

Drawn draw(RandomBodies& random, int kind) {
  switch (kind % 6) {
    case 0:
    case 1: {
      const auto t = ExactTangency::random(random, kind % 12 < 6 ? 1 : 0x1p14);
      return {ConeOracle(t.a, t.b), t.w};
    }
    case 2: {  // bodies that touch or overlap
      const auto t = ExactTangency::random(random);
      return {ConeOracle(t.touching_a, random.coin() ? t.touching_b : t.touching_a), t.w};
    }
    default:
      break;
  }
  const auto [a, b] = kind % 6 == 3   ? random.scaled_from_touching(1, 10, 1 + random.log_uniform(1e-15, 3))
                      : kind % 6 == 4 ? random.scaled_from_touching(1e-6, 1, random.uniform(1.01, 3))
                                      : random.scaled_from_touching(1, 10, random.log_uniform(10, 1e9));
  ConeOracle oracle(a, b);
  if (oracle.relation() != Relation::disjoint) return {std::move(oracle), random.direction()};
  return {std::move(oracle), true_cone(a, b, 16).boundary[random.integer(0, 15)].direction};
}

/// On the edge, within roundings of it or near it, or anywhere; at one length or of any size a double has.
Vector3d velocity(RandomBodies& random, const Vector3d& edge) {
  const int kind = random.integer(0, 19);
  if (kind == 0 && random.integer(0, 20) == 0) return Vector3d::Zero();
  Vector3d w = kind == 0   ? edge
               : kind == 1 ? random.ulps(edge, 2)
               : kind < 10 ? Vector3d(edge + random.log_uniform(1e-12, 2) * edge.norm() * random.direction())
                           : random.direction();
  if (random.coin()) return w;
  return w * std::ldexp(1.0, random.coin() ? random.integer(-40, 40) : random.integer(-1100, 960));
}

TEST(Memberships, EqualThoseOfSingleCallsAtEveryWidth) {
  RandomBodies random(531);
  SCOPED_TRACE(random.trace());
  constexpr int kPairs = 100;
  const int velocities = share(1'000'000) / kPairs;
  std::vector<Vector3d> w(velocities);
  std::vector<Membership> at_once(velocities);
  std::array<int, 3> counts = {}, rungs = {};
  for (int pair = 0; pair < kPairs; ++pair) {
    const Drawn drawn = draw(random, pair);
    for (Vector3d& v : w) v = velocity(random, drawn.edge);
    std::vector<Membership> single;
    for (int i = 0; i < velocities; ++i) {
      Rung rung{};
      single.push_back(drawn.oracle.membership(w[i], &rung));
      ++counts[static_cast<int>(single.back())];
      ++rungs[static_cast<int>(rung)];
      if (rung == Rung::triage && i % 20 == 0) {
        ASSERT_EQ(single[i], drawn.oracle.exact_membership(w[i], Vector3d::Zero()))
            << "pair " << pair << ": " << w[i].transpose();
      }
    }
    for (const VectorWidth width : kWidths) {
      std::fill(at_once.begin(), at_once.end(), Membership::on);
      drawn.oracle.memberships(w, at_once, width);
      for (int i = 0; i < velocities; ++i)
        ASSERT_EQ(at_once[i], single[i])
            << "pair " << pair << ", " << static_cast<int>(width) << " at once: " << w[i].transpose();
    }
  }
  // Every answer and every rung has its part.
  for (const int count : counts) EXPECT_GT(count, share(10'000));
  for (const int count : rungs) EXPECT_GT(count, share(10'000));
}

TEST(Memberships, OfVectorsWithinAnArrayOfOtherThings) {
  RandomBodies random(533);
  SCOPED_TRACE(random.trace());
  const ConeOracle oracle = unit_balls();
  for (const std::ptrdiff_t step : {3, 4, 6, 7, 40, 3000, 0, -3, -5}) {
    const auto room = static_cast<std::size_t>(std::abs(step));
    for (const std::size_t count : {0, 1, 63, 64, 65, 200, 1100}) {
      std::vector<double> numbers(room * count + 3, std::numeric_limits<double>::quiet_NaN());
      const std::size_t first = step < 0 && count > 0 ? room * (count - 1) : 0;
      const auto at = [&](std::size_t i) {
        return Eigen::Map<Vector3d>(numbers.data() + first + step * std::ptrdiff_t(i));
      };
      for (std::size_t i = 0; i < count; ++i) at(i) = random.direction();
      for (const VectorWidth width : kWidths) {
        std::vector<Membership> out(count, Membership::on);
        oracle.memberships(numbers.data() + first, step, out, width);
        for (std::size_t i = 0; i < count; ++i)
          ASSERT_EQ(out[i], oracle.membership(at(i))) << step << ' ' << i;
      }
    }
  }
}

TEST(Memberships, OfAnyNumberOfVelocities) {
  RandomBodies random(532);
  SCOPED_TRACE(random.trace());
  const ConeOracle oracle = unit_balls();
  std::vector<Vector3d> w;
  std::vector<Membership> single;
  for (int count = 0; count < 2100; ++count) {
    if (count < 260 || count > 1000) {
      std::vector<Membership> out(count + 1, Membership::on);
      for (const VectorWidth width : kWidths) {
        oracle.memberships(w, std::span(out).first(count), width);
        ASSERT_TRUE(std::equal(single.begin(), single.end(), out.begin())) << count;
        ASSERT_EQ(out[count], Membership::on) << "nothing is written beyond the end";
      }
    }
    w.push_back(random.direction());
    single.push_back(oracle.membership(w.back()));
  }
}

TEST(Memberships, GrazingOnesAndRestAmongOthers) {
  const ConeOracle oracle = unit_balls();
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  const std::vector<std::pair<Vector3d, Membership>> cases = {{{4, 3, 0}, Membership::on},
                                                              {{4, 0, -3}, Membership::on},
                                                              {{-4, -3, 0}, Membership::out},
                                                              {{0, 0, 0}, Membership::out},
                                                              {{-0.0, 0, -0.0}, Membership::out},
                                                              {{tiny, 0, 0}, Membership::in},
                                                              {{-tiny, 0, 0}, Membership::out},
                                                              {{4 * tiny, 3 * tiny, 0}, Membership::on},
                                                              {{tiny, tiny, tiny}, Membership::out},
                                                              {{huge, 0, tiny}, Membership::in},
                                                              {{huge, huge, 0}, Membership::out},
                                                              {{0x1p1000, 0, 0x1p-1000}, Membership::in},
                                                              {{0x1.8p1000, 0x1.2p1000, 0}, Membership::on}};
  for (const VectorWidth width : kWidths)
    for (int before = 0; before < 70; ++before) {
      std::vector<Vector3d> w(before, Vector3d(1, 0, 0));
      for (const auto& c : cases) w.push_back(c.first);
      std::vector<Membership> out(w.size());
      oracle.memberships(w, out, width);
      for (int i = 0; i < before; ++i) ASSERT_EQ(out[i], Membership::in);
      for (std::size_t i = 0; i < cases.size(); ++i)
        ASSERT_EQ(out[before + i], cases[i].second) << cases[i].first.transpose();
    }
}

TEST(Memberships, RefuseWhatIsNotANumberByItsPlace) {
  const ConeOracle oracle = unit_balls();
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const VectorWidth width : kWidths)
    for (const double bad : {nan, -nan, inf, -inf})
      for (const int at : {0, 1, 63, 64, 200, 1023, 1024, 1499})
        for (int j = 0; j < 3; ++j) {
          std::vector<Vector3d> w(1500, Vector3d(1, 0, 0));
          w[at](j) = bad;
          if (at + 1 < 1500) w[at + 1](0) = nan;
          std::vector<Membership> out(w.size());
          try {
            oracle.memberships(w, out, width);
            FAIL() << bad << " passed";
          } catch (const InputError& error) {
            ASSERT_EQ(error.field(), "w[" + std::to_string(at) + "][" + std::to_string(j) + "]");
          }
          for (int i = 0; i < at; ++i) ASSERT_EQ(out[i], Membership::in) << "answered before";
        }
  std::vector<Membership> out(3);
  try {
    oracle.memberships(std::vector<Vector3d>(5, Vector3d(1, 0, 0)), out);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "out: got 3 answers, must be as many as velocities, 5");
  }
}

/// The first rung answers at every length of a velocity.
TEST(Memberships, FormsDecideAtEveryScale) {
  RandomBodies random(533);
  SCOPED_TRACE(random.trace());
  int asked = 0, decided = 0;
  for (int pair = 0; pair < 40; ++pair) {
    const auto [a, b] = random.scaled_from_touching(1, 10, random.uniform(1.1, 3));
    const double scale = std::ldexp(1.0, random.integer(-400, 400));
    const ConeOracle plain(a, b);
    const ConeOracle scaled(Ellipsoid::from_shape(scale * a.center(), scale * scale * a.shape()),
                            Ellipsoid::from_shape(scale * b.center(), scale * scale * b.shape()));
    for (int j = 0; j < 100; ++j) {
      const Vector3d w = random.direction();
      const Membership is = plain.membership(w);
      for (int e = -960; e <= 960; e += 31) {
        const auto answer = scaled.triage_membership(w * std::ldexp(1.0, e));
        ++asked;
        decided += answer.has_value();
        ASSERT_TRUE(!answer || *answer == is) << w.transpose() << " times 2^" << e;
      }
    }
  }
  EXPECT_GT(decided, 0.999 * asked);
}

TEST(Memberships, DoNotAllocate) {
  RandomBodies random(534);
  const auto [a, b] = random.scaled_from_touching(1, 10, 1.5);
  const ConeOracle oracle(a, b);
  std::vector<Vector3d> w(1000);
  for (Vector3d& v : w) v = random.direction();
  std::vector<Membership> out(w.size());
  for (const VectorWidth width : kWidths) {
    const std::size_t before = testing::allocations();
    oracle.memberships(w, out, width);
    EXPECT_EQ(testing::allocations(), before);
  }
}

TEST(Memberships, KnowTheMachine) {
  // A width that the machine has not falls back to one that it has, as all tests above would show.
  EXPECT_GE(widest_vectors(), VectorWidth::two);
  RecordProperty("widest", static_cast<int>(widest_vectors()));
}

}  // namespace
}  // namespace vericone::memberships_test
