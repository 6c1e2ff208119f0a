// SPDX-License-Identifier: BSD-3-Clause
//
// The rung in doubles of two convex bodies within a horizon: near the ends of time and near the sides of the
// cone, against the rung in integers and against closed forms of upright cylinders; planes beside these.
#include <vericone/internal/cones/round/round_oracle.h>

#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>

#include "support/campaign.h"

namespace vericone::round_within_test {
namespace {

using Eigen::Vector3d;
using testing::any_body;
using testing::any_pose;
using testing::RandomBodies;
using testing::share;

const Vector3d kRest = Vector3d::Zero();
constexpr double kEver = std::numeric_limits<double>::infinity();

Convex any_convex(RandomBodies& random) {
  const Body body = any_body(random, std::array{BodyKind::convex, BodyKind::ellipsoid,
                                                BodyKind::hull}[std::size_t(random.integer(0, 5)) / 2]);
  const Pose turned{kRest, random.rotation()};
  if (const auto* convex = body.convex()) return in_world(*convex, turned);
  if (const auto* hull = body.hull())
    return in_world(Convex::rounded(*hull, random.coin() ? 0.1 : 0), turned);
  return in_world(Convex::rounded(body.quadric()->ellipsoid(), random.coin() ? 0.1 : 0), turned);
}

/// What one rung says and the other; how often it says anything.
struct Counts {
  int asked = 0, told = 0;
  void take(const RoundOracle& oracle, const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon) {
    const auto found = oracle.triage_within(v_a, v_b, horizon);
    ++asked;
    told += found.has_value();
    if (found) {
      ASSERT_EQ(found, oracle.exact_within(v_a, v_b, horizon))
          << "from " << horizon.from << " until " << horizon.until;
    }
  }
};

/// Where a velocity, or a time, begins to hit: between one that misses and one that does.
template <typename Hits>
double boundary(double misses, double hits, const Hits& is_hit) {
  for (int step = 0; step < 60; ++step) {
    const double between = 0.5 * (misses + hits);
    (is_hit(between) ? hits : misses) = between;
  }
  return hits;
}

TEST(RoundWithin, NearAllEndsItSaysWhatIntegersSay) {
  RandomBodies random(3031);
  SCOPED_TRACE(random.trace());
  Counts far, near, nearest;
  const auto counts = [&](double off) -> Counts& { return off > 1e-9 ? far : off > 1e-12 ? near : nearest; };
  for (int i = 0; i < share(80); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Vector3d at = random.uniform(5, 12) * random.direction(), v_b = random.direction();
    const RoundOracle oracle(any_convex(random), any_convex(random), kRest, at);
    if (oracle.relation() != Relation::disjoint) continue;
    const Vector3d w = at / random.uniform(2, 6);
    const auto contact = oracle.first_contact(w);
    if (!contact) continue;
    const auto hits = [&](const Vector3d& v, const Horizon& horizon) {
      return oracle.exact_within(v, kRest, horizon) == Membership::in;
    };
    // About the time of the contact, and about where velocities begin to pass.
    const double first = boundary(0.5 * contact->earliest, contact->latest, [&](double t) {
      return oracle.triage_within(w, kRest, {0, t}) == Membership::in;
    });
    const Vector3d side = w.norm() * random.direction();
    const double until = random.uniform(1.1, 3) * first,
                 from = i % 3 == 0 ? random.uniform(0, 0.9) * first : 0;
    const double beside = boundary(4, 0, [&](double s) {
      const auto found = oracle.triage_within(w + s * side, kRest, {from, until});
      return found == Membership::in;
    });
    for (const double off : {1e-3, 1e-6, 1e-10, 1e-11, 1e-13, 1e-14, 1e-16})
      for (const double sign : {-1.0, 1.0}) {
        counts(off).take(oracle, w + v_b, v_b, {from, first * (1 + sign * off)});
        counts(off).take(oracle, w + (beside + sign * off) * side + v_b, v_b, {from, until});
      }
    // Of a window that begins after now they may be in contact all along.
    if (i % 4 == 0) {
      counts(1).take(oracle, w, kRest, {first * random.uniform(1, 1.5), until});
      ASSERT_FALSE(hits(w, {0, 0.99 * contact->earliest}));
    }
  }
  std::cout << "[ told     ] " << far.told << " of " << far.asked << ", " << near.told << " of " << near.asked
            << ", " << nearest.told << " of " << nearest.asked << "\n";
  EXPECT_GT(far.told, 0.98 * far.asked);
  EXPECT_GT(near.told, 0.9 * near.asked);
}

/// Two upright cylinders of whole numbers: they touch exactly at 2 along x, beside or above each other.
TEST(RoundWithin, TouchesOfUprightBodiesAtTheEndsAreOn) {
  const Convex can = Convex::cylinder(2, 2), larger = Convex::cylinder(3, 4), ball = Convex::capsule(5, 0),
               box = Convex::box({3, 3, 2});
  struct Case {
    Convex agent, obstacle;
    Vector3d touching, inwards, w;  // the obstacle's place where they touch; to where they overlap
  };
  const std::array cases{Case{can, larger, {5, 0, 0}, {-1, 0, 0}, {1, 0, 0}},
                         Case{can, larger, {3, 4, 1}, {-3, -4, 0}, {2, 1, 0}},
                         Case{can, larger, {3, 0, 3}, {0, 0, -1}, {1, 0, 2}},
                         Case{ball, can, {7, 0, 0}, {-1, 0, 0}, {3, 1, 0}},
                         Case{ball, box, {2, -2, -7}, {0, 0, 1}, {1, 1, -1}},
                         Case{box, can, {5, 2, 1}, {-1, 0, 0}, {1, 0, 0}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const Case& c = cases[i];
    const auto verdict = [&](double beside, double from, double until) {
      const Vector3d at = c.touching + beside * c.inwards + 2 * c.w;
      return Pair(Placed(c.agent), Placed(c.obstacle, Pose{at})).verdict(c.w, kRest, {from, until});
    };
    EXPECT_EQ(verdict(0, 0, 2), Verdict::on);
    EXPECT_EQ(verdict(0, 2, 2), Verdict::on);
    EXPECT_EQ(verdict(0, 0, 2 + 0x1p-44), Verdict::in);
    EXPECT_EQ(verdict(0, 0, 2 - 0x1p-44), Verdict::out);
    EXPECT_EQ(verdict(0, 2, 3), Verdict::in);
    EXPECT_EQ(verdict(0, 20, 30), Verdict::out);
    EXPECT_EQ(verdict(0, 20, kEver), Verdict::out);
    for (const double off : {0x1p-20, 0x1p-40, 0x1p-44}) {
      EXPECT_EQ(verdict(off, 0, 2), Verdict::in);
      EXPECT_EQ(verdict(-off, 0, 2), Verdict::out);
    }
  }
}

/// Two upright cylinders in closed form: the obstacle's middle, seen from the agent, the sum of their radii,
/// of half their heights, and a horizon.
struct Upright {
  Vector3d c;
  double radius, height;
  Horizon within;

  bool meets(const Vector3d& w) const {
    const double a = w.head<2>().squaredNorm(), b = c.head<2>().dot(w.head<2>()),
                 rest = c.head<2>().squaredNorm() - radius * radius, root = b * b - a * rest;
    if (!(root > 0)) return false;
    const double q = b + std::copysign(std::sqrt(root), b), up = (c.z() - height) / w.z(),
                 down = (c.z() + height) / w.z();
    const double first = std::max({within.from, std::min(q / a, rest / q), std::min(up, down)}),
                 last = std::min({within.until, std::max(q / a, rest / q), std::max(up, down)});
    return first < last;
  }
};

TEST(RoundWithin, PlanesOfUprightCylindersTouchTheirCones) {
  RandomBodies random(3032);
  SCOPED_TRACE(random.trace());
  int planes = 0, sampled = 0;
  for (int i = 0; i < share(4000); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const double own = random.log_uniform(0.1, 10), other = random.log_uniform(0.1, 10),
                 high = random.log_uniform(0.1, 10), higher = random.log_uniform(0.1, 10);
    const double from = i % 3 == 0 ? random.uniform(0, 3) : 0;
    const Upright truth{random.log_uniform(1, 100) * random.direction(),
                        own + other,
                        high + higher,
                        {from, i % 5 == 0 ? kEver : from + random.log_uniform(0.1, 30)}};
    if (truth.c.head<2>().norm() < 1.001 * truth.radius && std::abs(truth.c.z()) < 1.001 * truth.height)
      continue;
    Pose turned{truth.c};
    const double turn = i % 2 == 0 ? random.uniform(0, 6) : 0;
    turned.rotation.topLeftCorner<2, 2>() = rotation_2d(turn);
    const Pair pair(Placed(Convex::cylinder(own, 2 * high)),
                    Placed(Convex::cylinder(other, 2 * higher), turned));
    // From a velocity that hits to one that does not.
    const Eigen::Vector2d side = 0.9 * truth.radius * random.direction_2d();
    const Vector3d inside = truth.c + Vector3d(side.x(), side.y(), random.uniform(-0.9, 0.9) * truth.height);
    const Vector3d w = inside / random.uniform(from, std::min(truth.within.until, from + 10)),
                   way = 4 * (w.norm() + truth.radius + truth.height) * random.direction();
    if (!truth.meets(w) || truth.meets(w + way)) continue;
    const double edge = boundary(1, 0, [&](double s) { return truth.meets(w + s * way); });
    const Vector3d touching = w + edge * way;
    EXPECT_EQ(pair.verdict(touching - 1e-9 * (touching - w), kRest, truth.within), Verdict::in);
    const Vector3d beside = touching + 1e-9 * way;
    EXPECT_EQ(pair.verdict(beside, kRest, truth.within), Verdict::out);
    const auto half = pair.safe_half_space(beside, kRest, truth.within);
    ASSERT_TRUE(half);
    ++planes;
    const Vector3d& n = half->normal;
    const double most = half->most(truth.within), size = n.norm() * way.norm();
    EXPECT_LE(n.dot(beside), most);
    EXPECT_GE(n.dot(touching), most - 1e-7 * size);
    for (int k = 0; k < 20; ++k) {
      const Vector3d v = touching + random.log_uniform(1e-6, 1) * way.norm() * random.direction();
      if (!(n.dot(v) < most - 1e-13 * size)) continue;
      ++sampled;
      ASSERT_FALSE(truth.meets(v)) << v.transpose();
    }
  }
  EXPECT_GT(planes, share(2000));
  EXPECT_GT(sampled, 5 * planes);
}

}  // namespace
}  // namespace vericone::round_within_test
