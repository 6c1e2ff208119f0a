// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/testing/random_bodies.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

#include "support/campaign.h"

namespace vericone::visible_sector_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using testing::RandomBodies, testing::share;

Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The sector by separating lines: normals n with min n.b - h_A(n) >= 0 make one interval of angles, whose
/// ends are the normals of the edges. Without tangents, hulls or orders.
struct Reference {
  double gap = 0;  // the widest separation; negative: none
  double psi = 0, theta_b = 0;

  Reference(const std::function<double(const Vector2d&)>& support, const std::vector<Vector2d>& points) {
    const auto separation = [&](double angle) {
      const Vector2d n = unit(angle);
      double least = INFINITY;
      for (const Vector2d& p : points) least = std::min(least, n.dot(p));
      return least - support(n);
    };
    constexpr int kStart = 720;
    double best = 0;
    gap = -INFINITY;
    for (int i = 0; i < kStart; ++i)
      if (const double s = separation(2 * pi * i / kStart); s > gap) gap = s, best = 2 * pi * i / kStart;
    for (double step = 2 * pi / kStart; step > 1e-9; step /= 2)
      for (const double other : {best - step, best + step})
        if (const double s = separation(other); s > gap) gap = s, best = other;
    if (!(gap > 0)) return;
    const auto end = [&](double turn) {
      double inside = best, outside = best + turn * pi;
      for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (inside + outside);
        (separation(middle) > 0 ? inside : outside) = middle;
      }
      return inside;
    };
    const double up = end(1), down = end(-1);
    psi = pi - (up - down);
    theta_b = 0.5 * (up + down);
  }
};

double turns_off(double x, double y) { return std::abs(std::remainder(x - y, 2 * pi)); }

/// What is seen from the origin of a wavy star about `center`: one point a bearing.
std::vector<Vector2d> seen(RandomBodies& random, const Vector2d& center, double size, int count) {
  const double waves = random.integer(1, 6), depth = random.uniform(0, 0.6),
               shift = random.uniform(0, 2 * pi), flat = random.uniform(0.2, 1), turn = random.uniform(0, pi);
  std::vector<Vector2d> all;
  for (int i = 0; i < 8 * count; ++i) {
    const double t = 2 * pi * i / (8 * count);
    const double r = size * (1 + depth * std::cos(waves * t + shift));
    all.push_back(center + rotation_2d(turn) * Vector2d(r * std::cos(t), flat * r * std::sin(t)));
  }
  std::vector<Vector2d> chain;
  double low = INFINITY, high = -INFINITY;
  const double middle = std::atan2(center.y(), center.x());
  const auto bearing = [&](const Vector2d& p) {
    return std::remainder(std::atan2(p.y(), p.x()) - middle, 2 * pi);
  };
  for (const Vector2d& p : all) low = std::min(low, bearing(p)), high = std::max(high, bearing(p));
  for (int i = 0; i < count; ++i) {
    const double from = low + (high - low) * i / count, to = low + (high - low) * (i + 1) / count;
    const Vector2d* nearest = nullptr;
    for (const Vector2d& p : all)
      if (const double b = bearing(p); b >= from && b <= to && (!nearest || p.norm() < nearest->norm()))
        nearest = &p;
    if (nearest) chain.push_back(*nearest);
  }
  return chain;
}

struct Counts {
  int answers = 0, none = 0, undecided = 0;
  double tried = 0, points = 0, worst = 0;

  void compare(const VisibleSector& search, const VisibleSector& direct, const Reference& reference,
               double size) {
    ASSERT_EQ(search.sector.has_value(), search.reason == NoSector::none);
    if (std::abs(reference.gap) < 1e-6 * size) {  // touching to the resolution of the reference
      ++undecided;
      return;
    }
    ASSERT_EQ(search.sector.has_value(), reference.gap > 0)
        << "gap " << reference.gap << " psi " << reference.psi;
    ASSERT_EQ(direct.sector.has_value(), reference.gap > 0);
    if (!search.sector) {
      ++none;
      return;
    }
    ++answers;
    for (const VisibleSector* s : {&search, &direct}) {
      worst = std::max({worst, std::abs(s->sector->psi - reference.psi),
                        turns_off(s->sector->theta_b, reference.theta_b)});
      EXPECT_NEAR(s->sector->psi, reference.psi, 1e-10);
      EXPECT_LT(turns_off(s->sector->theta_b, reference.theta_b), 1e-10);
    }
  }

  /// Prints them; there must be enough of each kind for the comparison to mean something.
  void report() const {
    std::cout << answers << " sectors, " << none << " without tangents, " << undecided
              << " touching; off by at most " << worst << " rad; " << 100 * tried / points
              << " % of the points tried\n";
    EXPECT_GT(answers, share(1000));
    EXPECT_GT(none, share(100));
    EXPECT_LT(undecided, 10);
  }
};

TEST(VisibleSector, SearchEqualsSeparatingLinesForEllipticAgents) {
  RandomBodies random(7601);
  SCOPED_TRACE(random.trace());
  Counts counts;
  for (int i = 0; i < share(2000); ++i) {
    const Ellipse agent = random.ellipse({0, 0}, 0.1, 1.5);
    const int n = random.integer(1, 60);
    const std::vector<Vector2d> chain =
        seen(random, random.uniform(1, 6) * random.direction_2d(), random.uniform(0.2, 3), n);
    if (chain.empty()) continue;
    const Reference reference([&](const Vector2d& d) { return agent.support(d); }, chain);
    const VisibleSector search = visible_sector(agent, chain);
    ASSERT_NO_FATAL_FAILURE(counts.compare(search, sector_of_points(agent, chain), reference, 1));
    if (search.sector) {
      counts.tried += search.tried;
      counts.points += double(chain.size());
      const Sector& s = *search.sector;
      for (const auto& [edge, index] :
           {std::pair(s.left, search.left_point), std::pair(s.right, search.right_point)}) {
        EXPECT_EQ(edge.point_on_b, chain[index]);
        EXPECT_NEAR((edge.point_on_a - agent.support_point(edge.normal)).norm(), 0, 1e-9);
        EXPECT_LT((edge.point_on_b - edge.point_on_a).normalized().dot(edge.normal), 1e-12);
      }
    }
  }
  counts.report();
}

TEST(VisibleSector, SearchEqualsSeparatingLinesForAgentsOfAnyShape) {
  RandomBodies random(7602);
  SCOPED_TRACE(random.trace());
  Counts counts;
  for (int i = 0; i < share(2000); ++i) {
    std::vector<Vector2d> agent(random.integer(1, 40));
    const double size = random.uniform(0.1, 1.2);
    for (Vector2d& p : agent) p = random.uniform(0, size) * random.direction_2d();
    const std::vector<Vector2d> chain = seen(random, random.uniform(1, 6) * random.direction_2d(),
                                             random.uniform(0.2, 3), random.integer(1, 60));
    if (chain.empty()) continue;
    const Reference reference(
        [&](const Vector2d& d) {
          double most = -INFINITY;
          for (const Vector2d& p : agent) most = std::max(most, d.dot(p));
          return most;
        },
        chain);
    const VisibleSector search = visible_sector(agent, chain);
    ASSERT_NO_FATAL_FAILURE(counts.compare(search, sector_of_points(agent, chain), reference, 1));
    if (search.sector) counts.tried += search.tried, counts.points += double(chain.size());
  }
  counts.report();
}

TEST(VisibleSector, PointsOfAnEllipseGiveItsSector) {
  RandomBodies random(7603);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const auto [a, b] = random.planar_scaled_from_touching(0.3, 3, random.uniform(1.2, 4));
    std::vector<Vector2d> points;
    constexpr int kPoints = 2000;
    for (int k = 0; k < kPoints; ++k) points.push_back(b.center() + b.factor() * unit(2 * pi * k / kPoints));
    const Sector exact = sector_by_support(a, b);
    const VisibleSector s = sector_of_points(a, points);
    ASSERT_TRUE(s.sector);
    // Inscribed: smaller, by the square of the spacing.
    EXPECT_LT(s.sector->psi, exact.psi + 1e-12);
    EXPECT_NEAR(s.sector->psi, exact.psi, 1e-3);
    EXPECT_NEAR(turns_off(s.sector->theta_b, exact.theta_b), 0, 1e-3);
  }
}

TEST(VisibleSector, DownSamplingStaysInside) {
  RandomBodies random(7604);
  SCOPED_TRACE(random.trace());
  int smaller = 0;
  for (int i = 0; i < share(200); ++i) {
    const Ellipse agent = random.ellipse({0, 0}, 0.2, 0.8);
    const std::vector<Vector2d> chain = seen(random, 4 * random.direction_2d(), random.uniform(0.2, 2), 100);
    const VisibleSector all = visible_sector(agent, chain);
    for (const int every : {2, 5, 30}) {
      const VisibleSector some = visible_sector(agent, chain, {.keep_every = every});
      if (!all.sector || !some.sector) continue;
      const double off = std::remainder(some.sector->theta_b - all.sector->theta_b, 2 * pi);
      EXPECT_LE(std::abs(off) + some.sector->psi / 2, all.sector->psi / 2 + 1e-12);
      smaller += some.sector->psi < all.sector->psi - 1e-9;
      EXPECT_EQ(some.sector->left.point_on_b, chain[some.left_point]);
    }
  }
  EXPECT_GT(smaller, share(50));
}

TEST(VisibleSector, DegenerateInputHasAnAnswer) {
  const Ellipse agent = Ellipse::from_axes({0, 0}, {1, 1});
  EXPECT_EQ(visible_sector(agent, {}).reason, NoSector::no_points);
  const std::vector<Vector2d> one{{2, 0}};
  ASSERT_TRUE(visible_sector(agent, one).sector);
  EXPECT_NEAR(visible_sector(agent, one).sector->psi, pi / 3, 1e-14);
  EXPECT_NEAR(visible_sector(agent, one).sector->theta_b, 0, 1e-15);
  const std::vector<Vector2d> same(5, Vector2d(2, 0));
  EXPECT_NEAR(visible_sector(agent, same).sector->psi, pi / 3, 1e-14);
  const std::vector<Vector2d> on{{3, 0}, {1, 0}};
  EXPECT_EQ(visible_sector(agent, on).reason, NoSector::inside_agent);
  // All on one tangent.
  const std::vector<Vector2d> line{{1, 2}, {1, 3}, {1, 4}};
  ASSERT_TRUE(visible_sector(agent, line).sector);
  EXPECT_NEAR(visible_sector(agent, line).sector->left.direction.x(), 0, 1e-15);
  // All around.
  const std::vector<Vector2d> around{{2, 0}, {-1, 2}, {-1, -2}};
  EXPECT_EQ(visible_sector(agent, around).reason, NoSector::no_tangents);
  EXPECT_EQ(sector_of_points(agent, around).reason, NoSector::no_tangents);
  // An agent of one point, of a segment; far from the origin.
  const std::vector<Vector2d> point{{1e6, 0}}, segment{{1e6, -1}, {1e6, 1}}, far{{1e6 + 1, 0}, {1e6 + 2, 1}};
  EXPECT_NEAR(visible_sector(point, far).sector->psi, std::atan2(1, 2), 1e-9);
  EXPECT_NEAR(sector_of_points(segment, far).sector->psi, visible_sector(segment, far).sector->psi, 1e-12);
  EXPECT_FALSE(visible_sector(point, point).sector);
  EXPECT_FALSE(sector_of_points(point, point).sector);
  EXPECT_THROW(visible_sector(std::span<const Vector2d>(), far), InputError);
  EXPECT_THROW(visible_sector(agent, far, {.keep_every = 0}), InputError);
}

TEST(VisibleSector, NumbersThatAreNotFiniteOrBeyondDoubles) {
  const auto refused = [](auto&& ask) -> std::string {
    try {
      ask();
      return "";
    } catch (const InputError& error) {
      return error.field();
    }
  };
  const double infinite = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const std::vector<Vector2d> good{{2, 0}, {3, 1}}, bad{{2, 0}, {3, 1}, {2, nan}, {infinite, 0}};
  EXPECT_EQ(refused([&] { visible_sector(Ellipse(), bad); }), "chain[2][1]");
  EXPECT_EQ(refused([&] { visible_sector(good, bad); }), "chain[2][1]");
  EXPECT_EQ(refused([&] { visible_sector(bad, good); }), "agent[2][1]");
  EXPECT_EQ(refused([&] { sector_of_points(Ellipse(), bad); }), "points[2][1]");
  EXPECT_EQ(refused([&] { sector_of_points(good, bad); }), "points[2][1]");
  EXPECT_EQ(refused([&] { sector_of_points(bad, good); }), "agent[2][1]");
  // Numbers of which a square is beyond doubles: a sector of finite numbers, or none.
  for (const double size : {1e-150, 1e-80, 1e80, 1e150})
    for (const double way : {1e-310, 1.0, 1e307}) {
      const auto agent = Ellipse::from_axes({0, 0}, {size, size});
      const std::vector<Vector2d> points{{way, 0}, {way, way}};
      for (const VisibleSector& s : {visible_sector(agent, points), sector_of_points(agent, points)}) {
        EXPECT_EQ(s.sector.has_value(), s.reason == NoSector::none) << size << ' ' << way;
        if (s.sector) {
          EXPECT_TRUE(std::isfinite(s.sector->psi) && std::isfinite(s.sector->theta_b));
        }
      }
    }
  // The sector of a disc of 0.6 d against two points at d: the same at every scale of which squares are.
  const auto psi = [](double d) {
    const std::vector<Vector2d> points{{d, 0}, {d, 0.3 * d}};
    return visible_sector(Ellipse::from_axes({0, 0}, {0.6 * d, 0.6 * d}), points).sector->psi;
  };
  EXPECT_NEAR(psi(1e-149), psi(1), 1e-13);
  EXPECT_NEAR(psi(1e149), psi(1), 1e-13);
}

}  // namespace
}  // namespace vericone::visible_sector_test
