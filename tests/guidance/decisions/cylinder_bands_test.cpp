// SPDX-License-Identifier: BSD-3-Clause
//
// Bands of cylinders with vertical axes, as well clear volumes are: their ends against closed forms, a disc
// in plan times an interval in altitude; needles. And of boxes, whose margins are round.
#include <vericone/guidance/bands.h>

#include <gtest/gtest.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <tuple>

#include "support/campaign.h"

namespace vericone::guidance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::RandomBodies;
using testing::share;

constexpr double kHalfTurn = std::numbers::pi, kNever = std::numeric_limits<double>::infinity();
constexpr double kFoot = 0.3048, kNauticalMile = 1852;

/// Two upright cylinders, seen from the agent.
struct Cans {
  Vector3d c, u;          // m, m/s
  double radius, height;  // m: the sum of both radii, and of both halves of their heights
  Range within;           // s
  Vector3d v;             // m/s, the agent's

  struct Window {
    double from, to;
    bool empty() const { return !(from < to); }
  };
  /// When their altitudes overlap, with this relative rate and the agent higher by `higher`.
  Window in_altitude(double rate, double higher = 0) const {
    const double up = c.z() - higher;
    if (rate == 0) return std::abs(up) < height ? Window{within.from, within.to} : Window{1, 0};
    const double a = (up - height) / rate, b = (up + height) / rate;
    return {std::max(std::min(a, b), within.from), std::min(std::max(a, b), within.to)};
  }
  /// When their discs overlap in plan, with this relative velocity.
  Window in_plan(const Vector2d& w) const {
    const Vector2d p = c.head<2>();
    const double a = w.squaredNorm(), b = p.dot(w), root = b * b - a * (p.squaredNorm() - radius * radius);
    if (!(root > 0)) return {1, 0};
    const double q = b + std::copysign(std::sqrt(root), b);
    const double one = q / a, other = (p.squaredNorm() - radius * radius) / q;
    return {std::max(std::min(one, other), within.from), std::min(std::max(one, other), within.to)};
  }
  bool meet(const Vector3d& velocity, double higher = 0) const {
    const Vector3d w = velocity - u;
    const Window up = in_altitude(w.z(), higher), beside = in_plan(w.head<2>());
    return std::max(up.from, beside.from) < std::min(up.to, beside.to);
  }

  /// Values of a curve of level velocities where what is met may change: it crosses a tangent from the apex,
  /// or the circle of those that arrive at the beginning or the end of the window in altitude.
  template <typename Lines, typename Circles>
  void crossings(const Lines& of_line, const Circles& of_circle) const {
    const Window window = in_altitude(v.z() - u.z());
    if (window.empty()) return;
    const Vector2d p = c.head<2>(), apex = u.head<2>();
    const double along = std::asin(radius / p.norm()), line = std::atan2(p.y(), p.x());
    for (const double angle : {line + along, line - along})
      of_line(apex, Vector2d(std::cos(angle), std::sin(angle)));
    for (const double t : {window.from, window.to})
      if (t > 0 && std::isfinite(t)) of_circle(Vector2d(apex + p / t), radius / t);
  }
  /// Those at which it does: `hit` before and after differ. `low` and `high` are no ends.
  template <typename Hit>
  static std::vector<double> changes(std::vector<double> all, double low, double high, const Hit& hit) {
    std::erase_if(all, [&](double q) { return !(q > low && q < high); });
    std::sort(all.begin(), all.end());
    std::vector<double> real;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double before = i > 0 ? all[i - 1] : low, after = i + 1 < all.size() ? all[i + 1] : high;
      if (hit(0.5 * (before + all[i])) != hit(0.5 * (all[i] + after))) real.push_back(all[i]);
    }
    return real;
  }

  double speed() const { return v.head<2>().norm(); }
  Vector3d heading(double q) const { return {speed() * std::sin(q), speed() * std::cos(q), v.z()}; }

  std::vector<double> headings() const {
    std::vector<double> all;
    const auto add = [&](const Vector2d& x) {
      const double q = std::atan2(x.x(), x.y());
      all.push_back(q < 0 ? q + 2 * kHalfTurn : q);
    };
    crossings(
        [&](const Vector2d& apex, const Vector2d& e) {
          const double b = apex.dot(e), root = b * b - apex.squaredNorm() + speed() * speed();
          if (root < 0) return;
          for (const double sign : {-1.0, 1.0})
            if (const double k = -b + sign * std::sqrt(root); k > 0) add(apex + k * e);
        },
        [&](const Vector2d& m, double r) {
          const double d = m.norm(), a = (d * d + speed() * speed() - r * r) / (2 * d);
          if (!(speed() > std::abs(a))) return;
          const double h = std::sqrt(speed() * speed() - a * a);
          const Vector2d x = m / d, y(-x.y(), x.x());
          add(a * x + h * y);
          add(a * x - h * y);
        });
    return changes(all, 0, 2 * kHalfTurn, [&](double q) { return meet(heading(q)); });
  }

  std::vector<double> speeds(const Range& range) const {
    std::vector<double> all;
    const Vector2d ahead = v.head<2>() / speed();
    crossings(
        [&](const Vector2d& apex, const Vector2d& e) {
          const Vector2d n(-e.y(), e.x());
          all.push_back(n.dot(apex) / n.dot(ahead));
        },
        [&](const Vector2d& m, double r) {
          const double b = ahead.dot(m), root = b * b - m.squaredNorm() + r * r;
          if (!(root > 0)) return;
          for (const double sign : {-1.0, 1.0}) all.push_back(b + sign * std::sqrt(root));
        });
    return changes(all, range.from, range.to, [&](double q) {
      return meet({q * ahead.x(), q * ahead.y(), v.z()});
    });
  }

  std::vector<double> climbs(const Range& range) const {
    const Window window = in_plan((v - u).head<2>());
    std::vector<double> all;
    if (!window.empty())
      for (const double t : {window.from, window.to})
        for (const double side : {-height, height})
          if (t > 0) all.push_back(u.z() + (c.z() + side) / t);
    return changes(all, range.from, range.to, [&](double q) { return meet({v.x(), v.y(), q}); });
  }

  std::vector<double> altitudes(const Range& range) const {
    const Window window = in_plan((v - u).head<2>());
    std::vector<double> all;
    if (!window.empty())
      for (const double t : {window.from, window.to})
        for (const double side : {-height, height}) all.push_back(c.z() + t * u.z() + side);
    return changes(all, range.from, range.to, [&](double q) { return meet({v.x(), v.y(), 0}, q); });
  }

  /// Parts of the sums are the agent's. `margin`: cylinders have none; it is asked of pairs without.
  Bands answer(const BandOptions& options) const {
    const double part = 0.3;
    const Placed agent(Convex::cylinder(part * radius, 2 * part * height));
    const Intruder other{{Convex::cylinder((1 - part) * radius, 2 * (1 - part) * height), Pose{c}}, u};
    return bands(agent, v, {&other, 1}, options);
  }
};

std::vector<double> inner_ends(const Band& band, double low, double high) {
  std::vector<double> ends;
  for (const Range& range : band.free)
    for (const double end : {range.from, range.to})
      if (end > low && end < high) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// The worst difference, of the range.
double worst_of(const std::vector<double>& found, const std::vector<double>& expected, double all) {
  if (found.size() != expected.size()) return kNever;
  double worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
    worst = std::max(worst, std::abs(found[k] - expected[k]) / all);
  return worst;
}

TEST(BandsOfCylinders, EndWhereTheClosedFormSays) {
  RandomBodies random(3841);
  SCOPED_TRACE(random.trace());
  std::array<int, 4> some{};
  int frees = 0, conflicts = 0;
  double heading = 0, others = 0;
  for (int i = 0; i < share(2000); ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    // A well clear volume, 4,000 ft x 450 ft; or any.
    const bool real = i % 2 == 0;
    const double mile = real ? kNauticalMile : 1, side = random.uniform(0, 2 * kHalfTurn);
    const double far = (real ? random.uniform(2, 12) : random.uniform(3, 30)) * mile;
    Cans d{{far * std::cos(side), far * std::sin(side), 0},
           Vector3d::Zero(),
           real ? 4000 * kFoot : random.uniform(0.5, 2.5),
           real ? 450 * kFoot : random.uniform(0.3, 3),
           {},
           Vector3d::Zero()};
    d.c.z() = random.uniform(-3, 3) * d.height;
    d.within = {i % 5 == 0 ? random.uniform(0, 3) : 0, i % 3 == 0 ? kNever : random.uniform(4, 20)};
    if (real) d.within = {10 * d.within.from, 10 * d.within.to};
    const double unit = real ? 60 : 1;
    for (Vector3d* x : {&d.u, &d.v}) {
      const double way = random.uniform(0, 2 * kHalfTurn);
      *x = unit * random.uniform(0.5, 4) * Vector3d(std::sin(way), std::cos(way), 0);
      // Both level; or not.
      if (i % 4 != 0) x->z() = random.uniform(-0.3, 0.3) * (real ? 30 : 1);
    }
    // Towards a meeting, as a rule.
    if (i % 8 != 0) d.v.head<2>() = (d.c.head<2>() / random.uniform(2, 9) / (real ? 20 : 1) + d.u.head<2>());
    BandOptions options;
    options.horizon = {d.within.from, d.within.to};
    options.speed = {0.1 * d.speed(), 2 * d.speed()};
    options.climb = {-0.5 * unit, 0.5 * unit};
    options.altitude = {-8 * d.height, 8 * d.height};
    const Bands found = d.answer(options);
    const auto headings = d.headings();
    heading = std::max(heading, worst_of(inner_ends(found.heading, 0, 2 * kHalfTurn), headings, 1));
    ASSERT_LT(heading, 1e-9 * kHalfTurn / 180);
    const auto sample = [&](const Band& band, const auto& meets) {
      for (const auto& [ranges, hit, count] :
           {std::tuple(&band.free, false, &frees), {&band.conflict, true, &conflicts}})
        for (const Range& range : *ranges)
          for (int k = 1; k < 30; ++k, ++*count)
            ASSERT_EQ(meets(range.from + (range.to - range.from) * k / 30), hit);
    };
    const auto check = [&](const Band& band, const Range& range, const std::vector<double>& expected) {
      const double worst = worst_of(inner_ends(band, range.from, range.to), expected, range.to - range.from);
      others = std::max(others, worst);
      ASSERT_LT(worst, 1e-10);
    };
    const Vector2d ahead = d.v.head<2>() / d.speed();
    check(found.speed, options.speed, d.speeds(options.speed));
    check(found.climb, options.climb, d.climbs(options.climb));
    check(found.altitude, options.altitude, d.altitudes(options.altitude));
    sample(found.heading, [&](double q) { return d.meet(d.heading(q)); });
    sample(found.speed, [&](double q) { return d.meet({q * ahead.x(), q * ahead.y(), d.v.z()}); });
    sample(found.climb, [&](double q) { return d.meet({d.v.x(), d.v.y(), q}); });
    sample(found.altitude, [&](double q) { return d.meet({d.v.x(), d.v.y(), 0}, q); });
    some[0] += !headings.empty();
    some[1] += !d.speeds(options.speed).empty();
    some[2] += !d.climbs(options.climb).empty();
    some[3] += !d.altitudes(options.altitude).empty();
  }
  std::cout << "[ ends     ] headings " << heading * 180 / kHalfTurn << " degrees; others " << others
            << " of the range; of " << some[0] << ", " << some[1] << ", " << some[2] << ", " << some[3]
            << "; " << frees << " samples free, " << conflicts << " in conflict\n";
  for (const int n : some) EXPECT_GT(n, share(2000) / 10);
}

/// Boxes that pass beside each other by g: then the rest of the margin is in height.
TEST(BandsOfBoxes, OfAltitudesKeepTheMarginFromEdges) {
  constexpr double kMargin = 2, kMost = 10;
  for (const double turned : {0.0, 0.3})
    for (const double g : {-0.5, 0.1, 0.4, 1.0, 1.6, 1.99}) {
      SCOPED_TRACE("beside by " + std::to_string(g) + ", turned " + std::to_string(turned));
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(turned, Vector3d::UnitZ()).toRotationMatrix();
      const Intruder other{
          Placed(HullBody::box({-2, -1, -0.5}, {2, 1, 0.5}), Pose{turn * Vector3d(30, 2 + g, 1), turn}),
          turn * Vector3d(-1, 0, 0)};
      const Placed agent(HullBody::box({-1, -1, -1}, {1, 1, 1}), Pose{Vector3d::Zero(), turn});
      const Bands found = bands(agent, turn * Vector3d(4, 0, 0), {&other, 1},
                                {.horizon = {0, 12}, .margin = kMargin, .altitude = {-kMost, kMost}});
      const double beside = std::max(g, 0.0), high = 1.5 + std::sqrt(kMargin * kMargin - beside * beside);
      const Band& band = found.altitude;
      ASSERT_EQ(band.conflict.size(), 1U);
      ASSERT_EQ(band.free.size(), 2U);
      EXPECT_EQ(band.free[0].from, -kMost);
      EXPECT_EQ(band.free[1].to, kMost);
      for (const auto& [free, conflict, truth] :
           {std::tuple{band.free[0].to, band.conflict[0].from, 1 - high},
            {-band.free[1].from, -band.conflict[0].to, -1 - high}}) {
        EXPECT_LE(free, truth + 1e-12);
        EXPECT_GE(conflict, truth - 1e-12);
        EXPECT_LT(conflict - free, 1e-4 * kMost);
      }
    }
}

TEST(BandsOfCylinders, LoseNoNeedle) {
  RandomBodies random(3842);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < share(2000); ++i) {
    // Near mid-air collision volumes, 500 ft and 100 ft to each side, 9 to 14 nautical miles away.
    const double side = random.uniform(0, 2 * kHalfTurn), own = random.uniform(60, 200);
    const double far = random.uniform(9, 14) * kNauticalMile;
    Cans d{{far * std::cos(side), far * std::sin(side), random.uniform(-500, 500)},
           Vector3d::Zero(),
           500 * kFoot,
           100 * kFoot,
           {0, kNever},
           Vector3d::Zero()};
    const double heading = random.uniform(0, 2 * kHalfTurn), time = random.uniform(60, 300);
    d.v = own * Vector3d(std::sin(0.3), std::cos(0.3), 0);
    d.v.z() = i % 2 == 0 ? 0 : random.uniform(-5, 5);
    // With that heading it passes through the volume, off its middle.
    const double off = random.uniform(0, 0.9) * d.radius, way = random.uniform(0, 2 * kHalfTurn);
    const Vector3d miss(off * std::cos(way), off * std::sin(way), random.uniform(-0.9, 0.9) * d.height);
    d.u = d.heading(heading) - (d.c + miss) / time;
    if (i % 4 == 0) {  // both level, one a little above the other
      d.c.z() = miss.z();
      d.u.z() = d.v.z();
    }
    const Band band = d.answer({}).heading;
    ASSERT_FALSE(band.conflict.empty()) << "needle " << i;
    const auto holds = [&](const Range& range) { return range.from <= heading && heading <= range.to; };
    ASSERT_TRUE(std::any_of(band.conflict.begin(), band.conflict.end(), holds)) << "needle " << i;
  }
}

}  // namespace
}  // namespace vericone::guidance
