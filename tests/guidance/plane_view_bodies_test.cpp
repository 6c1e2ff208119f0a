// SPDX-License-Identifier: BSD-3-Clause
//
// Views of planar bodies and of dented ones in space.
#include <gtest/gtest.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/guidance/plane_view.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/guidance/plane_view.h>

#include <cmath>
#include <numbers>

#include "cones/ellipsoids/richardson.h"
#include "guidance/engagements.h"

namespace vericone::guidance::plane_view_bodies_test {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;
using testing::RandomBodies, testing::richardson_derivative;

const Ellipsoid& ellipsoid_of(const BodyState& body) { return body.shape.quadric()->ellipsoid(); }

bool same(const Touch& x, const Touch& y) {
  return x.corner == y.corner && x.first == y.first && x.second == y.second;
}
/// Whether the edges keep their contacts within h of now: the derivative jumps where an edge passes from one
/// to another, also to the opposite corner of the same two conics.
template <typename SectorAt>
bool keeps_contacts(const SectorAt& at, double h) {
  const CombinedSector now = at(0);
  for (const double t : {h, 0.5 * h, 0.25 * h}) {
    const CombinedSector ahead = at(t), behind = at(-t);
    for (const CombinedSector* s : {&ahead, &behind})
      if (!same(s->left_a, now.left_a) || !same(s->left_b, now.left_b) || !same(s->right_a, now.right_a) ||
          !same(s->right_b, now.right_b))
        return false;
    const auto bend = [&](SectorEdge Sector::*edge, Vector2d SectorEdge::*point) {
      return (ahead.sector.*edge.*point + behind.sector.*edge.*point - 2 * (now.sector.*edge.*point)).norm();
    };
    for (const auto edge : {&Sector::left, &Sector::right})
      for (const auto point : {&SectorEdge::point_on_a, &SectorEdge::point_on_b})
        if (bend(edge, point) > 0.02) return false;
  }
  return true;
}

/// A planar body that moves, turns and changes.
struct PlanarBody {
  BodyState now;
  CombinedEllipse shape;
  Vector3d acceleration = Vector3d::Zero();

  BodyState at(double t) const {
    BodyState s = now;
    s.position = now.position + t * now.velocity + 0.5 * t * t * acceleration;
    s.velocity = now.velocity + t * acceleration;
    double angle = t * now.omega.z();
    if (now.turning == Turning::with_heading)
      angle += std::atan2(s.velocity.y(), s.velocity.x()) - std::atan2(now.velocity.y(), now.velocity.x());
    const Matrix2d r = rotation_2d(angle);
    const auto turned = [&](const Matrix2d& m) -> Matrix2d {
      const Matrix2d x = r * m * r.transpose();
      return 0.5 * (x + x.transpose());
    };
    const Matrix2d change = now.rate.shape.topLeftCorner<2, 2>();
    const Ellipse e =
        Ellipse::from_shape(s.position.head<2>(), turned(shape.ellipsoid().shape() + t * change));
    std::vector<Delimiter<2>> delimiters = shape.delimiters();
    for (std::size_t i = 0; i < delimiters.size(); ++i) {
      delimiters[i].matrix =
          turned(delimiters[i].matrix + t * now.rate.delimiters[i].matrix.topLeftCorner<2, 2>());
      delimiters[i].level += t * now.rate.delimiters[i].level;
    }
    s.shape = CombinedEllipse::trusted(e, std::move(delimiters));
    return s;
  }
};

PlanarBody planar_body(RandomBodies& random, const Vector2d& position) {
  PlanarBody p;
  p.shape = testing::random_combined(random, position);
  p.now.position << position, 0;
  p.now.velocity << random.uniform(1, 10) * random.direction_2d(), 0;
  p.now.omega.z() = random.uniform(-1, 1);
  const auto change = [&](double size) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    m(0, 0) = random.uniform(-size, size);
    m(1, 1) = random.uniform(-size, size);
    m(0, 1) = m(1, 0) = random.uniform(-size, size);
    return m;
  };
  p.now.rate.shape = change(0.2);
  for (const Delimiter<2>& d : p.shape.delimiters()) {
    const Eigen::Matrix3d m = change(0.05);
    p.now.rate.delimiters.push_back({m, d.level > 0.1 ? random.uniform(-0.1, 0.1) : 0});
  }
  return p;
}

TEST(PlaneViewRates, PlanarBodiesWithDents) {
  RandomBodies random(7221);
  SCOPED_TRACE(random.trace());
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    PlanarBody body_a = planar_body(random, {random.uniform(-5, 5), random.uniform(-5, 5)});
    const Vector2d away = random.uniform(13, 30) * random.direction_2d();
    PlanarBody body_b = planar_body(random, body_a.now.position.head<2>() + away);
    double lateral = 0;
    if (i % 3) {
      body_a.now.turning = Turning::with_heading;
      lateral = random.uniform(-20, 20);
      body_a.acceleration = lateral * plane_states(body_a.at(0), body_b.at(0), {}).lateral_a();
    }
    const BodyState a = body_a.at(0), b = body_b.at(0);
    const auto view = plane_view(a, b, {}, SectorMethod::true_cone, RateMethod::analytic);
    ASSERT_TRUE(view);
    const auto sector = [&](double t) {
      return combined_sector(*body_a.at(t).shape.flat(), *body_b.at(t).shape.flat());
    };
    const CombinedSector now = sector(0);
    const PlaneCone& cone = view->cone;
    EXPECT_EQ(view->line_of_sight.z(), 0);
    EXPECT_LT((view->normal() - Vector3d(0, 0, 1)).norm(), 1e-15) << i;
    const double sight = std::atan2(view->line_of_sight.y(), view->line_of_sight.x());
    EXPECT_NEAR(cone.psi, now.sector.psi, 1e-15);
    EXPECT_NEAR(std::remainder(cone.theta_b + sight - now.sector.theta_b, 2 * std::numbers::pi), 0, 1e-14);
    EXPECT_LE(std::abs(cone.theta_b), std::numbers::pi / 2);
    const Vector3d v = b.velocity - a.velocity;
    const double scale = v.norm() / view->state.r + a.omega.norm() + b.omega.norm() +
                         body_a.acceleration.norm() / a.velocity.norm() + 0.1;
    const double h = 0.01 / scale;
    if (!keeps_contacts(sector, h)) continue;
    ++compared;
    const double psi = richardson_derivative([&](double t) { return sector(t).sector.psi; }, h);
    const double theta_b = richardson_derivative(
        [&](double t) {
          return std::remainder(sector(t).sector.theta_b - now.sector.theta_b, 2 * std::numbers::pi);
        },
        h);
    EXPECT_NEAR(cone.psi_rate + lateral * cone.psi_rate_by_a, psi, 1e-6 * scale) << i;
    EXPECT_NEAR(cone.theta_b_rate + lateral * cone.theta_b_rate_by_a, theta_b, 1e-6 * scale) << i;
  }
  EXPECT_GT(compared, 900);
}

/// A dented pair whose bodies turn and change.
std::pair<testing::MovingBody, testing::MovingBody> dented_pair(RandomBodies& random, double low, double high,
                                                                bool both) {
  auto [a, b] = testing::moving_pair(random, low, high);
  testing::dent(random, b);
  if (both) testing::dent(random, a);
  return {a, b};
}

TEST(PlaneView, SlicesOfDentedBodiesAreThoseOfTheCone) {
  RandomBodies random(7222);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    const auto [moving_a, moving_b] = dented_pair(random, 1.1, 3, i % 2);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const AxisFrame frame(b.position - a.position);
    const CombinedSliceCone cone = combined_slice_cone(*a.shape.quadric(), *b.shape.quadric(), 7);
    ASSERT_EQ(cone.slices.size(), 7U);
    for (const Slice& slice : cone.slices) {
      const Vector3d e = std::cos(slice.azimuth) * frame.e1 + std::sin(slice.azimuth) * frame.e2;
      const auto view = plane_view(a, b, e, SectorMethod::slice, RateMethod::none);
      ASSERT_TRUE(view);
      EXPECT_NEAR(view->cone.psi, slice.psi(), 1e-12);
      EXPECT_NEAR(view->cone.theta_b, slice.theta_b(), 1e-12);
    }
  }
}

TEST(PlaneViewRates, SlicesOfDentedBodies) {
  RandomBodies random(7223);
  SCOPED_TRACE(random.trace());
  int compared = 0, corners = 0;
  for (int i = 0; i < 400; ++i) {
    auto [moving_a, moving_b] = dented_pair(random, 1.3, 4, i % 2);
    const double spin = random.uniform(-1, 1);
    const Vector3d across = random.direction();
    double lateral = 0;
    if (i % 3) {
      moving_a.now.turning = Turning::with_heading;
      lateral = random.uniform(-10, 10);
      moving_a.acceleration = lateral * plane_states(moving_a.at(0), moving_b.at(0), across).lateral_a();
    }
    const BodyState a = moving_a.state(), b = moving_b.state();
    const auto view = plane_view(a, b, across, SectorMethod::slice, RateMethod::analytic, spin);
    ASSERT_TRUE(view);
    const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
    const auto at = [&, &moving_a = moving_a, &moving_b = moving_b](double t) {
      const BodyState next_a = moving_a.at(t), next_b = moving_b.at(t);
      const PlaneView states =
          plane_states(next_a, next_b, testing::carried_axis(c, v, t, view->across, spin));
      return combined_sector(
          central_section(*next_a.shape.quadric(), states.line_of_sight, states.across, Vector2d::Zero()),
          central_section(*next_b.shape.quadric(), states.line_of_sight, states.across,
                          Vector2d(states.state.r, 0)));
    };
    const double scale = v.norm() / c.norm() + a.omega.norm() + b.omega.norm() + std::abs(spin) +
                         moving_a.acceleration.norm() / a.velocity.norm();
    const double h = 0.005 / scale;
    const CombinedSector now = at(0);
    if (!keeps_contacts(at, h)) continue;
    ++compared;
    corners += now.left_b.corner + now.right_b.corner + now.left_a.corner + now.right_a.corner;
    const PlaneCone& cone = view->cone;
    const double psi = richardson_derivative([&](double t) { return at(t).sector.psi; }, h),
                 theta_b = richardson_derivative([&](double t) { return at(t).sector.theta_b; }, h);
    EXPECT_NEAR(cone.psi_rate + lateral * cone.psi_rate_by_a, psi, 1e-6 * scale) << i;
    EXPECT_NEAR(cone.theta_b_rate + lateral * cone.theta_b_rate_by_a,
                theta_b + view->state.v_theta / view->state.r, 1e-6 * scale)
        << i;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(corners, 50);
}

TEST(PlaneView, TrueSectorsOfDentedBodies) {
  RandomBodies random(7224);
  SCOPED_TRACE(random.trace());
  int decided = 0, asked = 0, narrower = 0;
  for (int i = 0; i < 30; ++i) {
    const auto [moving_a, moving_b] = dented_pair(random, 1.2, 2, i % 2);
    const BodyState a = moving_a.state(), b = moving_b.state();
    const CombinedOracle oracle(*a.shape.quadric(), *b.shape.quadric());
    const Vector3d across = random.direction();
    const auto view = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::none);
    ASSERT_TRUE(view);
    const auto slice = plane_view(a, b, across, SectorMethod::slice, RateMethod::none);
    ASSERT_TRUE(slice);
    EXPECT_LE(slice->cone.psi, view->cone.psi + 1e-6);
    BodyState round_a = a, round_b = b;
    round_a.shape = CombinedEllipsoid(ellipsoid_of(a));
    round_b.shape = CombinedEllipsoid(ellipsoid_of(b));
    const auto around = plane_view(round_a, round_b, across, SectorMethod::true_cone, RateMethod::none);
    ASSERT_TRUE(around);
    EXPECT_LE(view->cone.psi, around->cone.psi + 1e-6);
    narrower += view->cone.psi < around->cone.psi - 1e-3;
    for (const double side : {1., -1.}) {
      const double edge = view->cone.theta_b + 0.5 * side * view->cone.psi;
      for (const double beyond : {1e-5, -1e-5}) {
        const double angle = edge + side * beyond;
        const Certified answer =
            oracle.membership(std::cos(angle) * view->line_of_sight + std::sin(angle) * view->across);
        ++asked;
        decided += answer != Certified::undecided;
        EXPECT_NE(answer, beyond > 0 ? Certified::in : Certified::out) << i;
      }
    }
  }
  EXPECT_GT(decided, asked * 9 / 10);
  EXPECT_GT(narrower, 5);
}

/// What is remembered makes it quicker, not different: not from the step before, nor from elsewhere.
TEST(PlaneView, TrueSectorsDoNotDependOnWhatIsRemembered) {
  RandomBodies random(7226);
  SCOPED_TRACE(random.trace());
  EdgeMemory stale;
  for (int i = 0; i < 20; ++i) {
    const auto [moving_a, moving_b] = dented_pair(random, 1.3, 3, i % 4 == 0);
    const Vector3d across = random.direction();
    EdgeMemory memory;
    for (int step = 0; step < 5; ++step) {
      const BodyState a = moving_a.at(0.01 * step), b = moving_b.at(0.01 * step);
      const auto view = [&](EdgeMemory* from) {
        return plane_view(a, b, across, SectorMethod::true_cone, RateMethod::none, 0, from);
      };
      const auto fresh = view(nullptr);
      ASSERT_TRUE(fresh);
      for (EdgeMemory* from : {&memory, &stale}) {
        const auto followed = view(from);
        ASSERT_TRUE(followed);
        EXPECT_NEAR(followed->cone.psi, fresh->cone.psi, 4e-7) << i;
        EXPECT_NEAR(followed->cone.theta_b, fresh->cone.theta_b, 4e-7) << i;
      }
    }
  }
}

/// Against differences of sectors along the motion, which are written without the library's own propagation.
TEST(PlaneViewRates, TrueSectorsOfDentedBodies) {
  RandomBodies random(7229);
  SCOPED_TRACE(random.trace());
  int compared = 0, dents = 0;
  for (int i = 0; i < 40; ++i) {
    auto [moving_a, moving_b] = dented_pair(random, 1.3, 3, i % 4 == 0);
    const double spin = random.uniform(-1, 1);
    const Vector3d across = random.direction();
    double lateral = 0;
    if (i % 3) {
      moving_a.now.turning = Turning::with_heading;
      lateral = random.uniform(-10, 10);
      moving_a.acceleration = lateral * plane_states(moving_a.at(0), moving_b.at(0), across).lateral_a();
    }
    const BodyState a = moving_a.state(), b = moving_b.state();
    const auto view = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::analytic, spin);
    ASSERT_TRUE(view);
    const Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
    const auto at = [&, &moving_a = moving_a, &moving_b = moving_b](double t) {
      const auto later =
          plane_view(moving_a.at(t), moving_b.at(t), testing::carried_axis(c, v, t, view->across, spin),
                     SectorMethod::true_cone, RateMethod::none);
      return later ? later->cone : PlaneCone{};
    };
    const double scale = v.norm() / c.norm() + a.omega.norm() + b.omega.norm() + std::abs(spin) +
                         moving_a.acceleration.norm() / a.velocity.norm();
    const double h = 0.003 / scale, close = 1e-5 * scale;
    const auto psi = testing::settled_derivative([&](double t) { return at(t).psi; }, h, close),
               theta_b = testing::settled_derivative([&](double t) { return at(t).theta_b; }, h, close);
    if (!psi || !theta_b) continue;
    ++compared;
    BodyState round_a = a, round_b = b;
    round_a.shape = CombinedEllipsoid(ellipsoid_of(a));
    round_b.shape = CombinedEllipsoid(ellipsoid_of(b));
    dents += view->cone.psi <
             plane_view(round_a, round_b, across, SectorMethod::true_cone, RateMethod::none)->cone.psi - 1e-6;
    const PlaneCone& cone = view->cone;
    EXPECT_NEAR(cone.psi_rate + lateral * cone.psi_rate_by_a, *psi, 2 * close) << i;
    EXPECT_NEAR(cone.theta_b_rate + lateral * cone.theta_b_rate_by_a,
                *theta_b + view->state.v_theta / view->state.r, 2 * close)
        << i;
  }
  EXPECT_GT(compared, 25);
  EXPECT_GT(dents, 10);
}

TEST(PlaneViewRates, TrueSectorsOfDentsNotTouched) {
  RandomBodies random(7225);
  SCOPED_TRACE(random.trace());
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    const auto [moving_a, moving_b] = dented_pair(random, 1.5, 3, false);
    const BodyState a = moving_a.state(), b = moving_b.state();
    BodyState round_b = b;
    round_b.shape = CombinedEllipsoid(ellipsoid_of(b));
    round_b.rate.delimiters.clear();
    const Vector3d across = random.direction();
    const auto view = plane_view(a, b, across, SectorMethod::true_cone, RateMethod::analytic);
    const auto around = plane_view(a, round_b, across, SectorMethod::true_cone, RateMethod::analytic);
    ASSERT_TRUE(view && around);
    // Where the dents are not touched the closed form for the ellipsoids is the truth.
    if (std::abs(view->cone.psi - around->cone.psi) > 1e-6) continue;
    ++compared;
    EXPECT_NEAR(view->cone.psi_rate, around->cone.psi_rate, 2e-3) << i;
    EXPECT_NEAR(view->cone.theta_b_rate, around->cone.theta_b_rate, 2e-3) << i;
  }
  EXPECT_GT(compared, 2);
}

}  // namespace
}  // namespace vericone::guidance::plane_view_bodies_test
