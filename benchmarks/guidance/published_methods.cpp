// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what published methods and ours decide in the same random encounters, and how many
// narrow conflicts a grid of headings leaves out.
//
// Usage: vericone_published_methods [ENCOUNTERS [CONFLICTS]]
#include <vericone/cones/pair.h>
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <vector>

#include "benchmarks/guidance/published.h"

namespace {

using namespace vericone;
using namespace vericone::guidance;
using Eigen::Vector2d;
using Eigen::Vector3d;
using published::Decision;
using vericone::testing::RandomBodies;

constexpr double kPi = std::numbers::pi;

double quantile(std::vector<double> all, double part) {
  if (all.empty()) return 0;
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
}

Vector3d raised(const Vector2d& v) { return {v.x(), v.y(), 0}; }

/// Ellipses that move in the plane, as ellipsoids so high that all answers are those of the ellipses; and
/// the discs about them.
struct Encounter {
  Decision seen;
  Placed agent{Body()};
  std::vector<Intruder> others;

  /// Of an agent smaller by 1e-6: what only touches, as half-planes and tangents do, is no hit.
  bool is_safe(const Vector2d& v) const {
    const Placed smaller(agent.body.quadric()->ellipsoid().scaled(1 - 1e-6), agent.pose);
    return std::none_of(others.begin(), others.end(), [&](const Intruder& other) {
      return may_collide(Pair(smaller, other.body).verdict(raised(v), other.velocity, {0, seen.until}));
    });
  }
};

constexpr double kLong = 2.5;

Placed body(double aspect, const Vector2d& at, double heading) {
  return {Ellipsoid::from_axes({0, 0, 0}, {kLong, kLong / aspect, kLong}),
          {raised(at), Eigen::AngleAxisd(heading, Vector3d::UnitZ()).toRotationMatrix()}};
}

/// With `count` others that the wanted velocity meets or nearly meets, and hits at least one.
Encounter encounter(RandomBodies& random, double aspect, int count) {
  for (;;) {
    Encounter e;
    e.seen.until = 10;
    e.seen.fastest = 5;
    const double course = random.uniform(-kPi, kPi);
    e.seen.wanted = random.uniform(1.5, 4) * Vector2d(std::cos(course), std::sin(course));
    e.seen.agent = {Vector2d::Zero(), e.seen.wanted, kLong};
    e.agent = body(aspect, Vector2d::Zero(), course);
    while (int(e.others.size()) < count) {
      const Vector2d at = random.uniform(2.5 * kLong, 30) * random.direction_2d();
      const bool clear = std::all_of(e.seen.others.begin(), e.seen.others.end(), [&](const auto& other) {
        return (other.position - at).norm() > 2 * kLong;
      });
      if (!clear) continue;
      const Vector2d v =
          e.seen.wanted - (at + random.uniform(0, 2 * kLong) * random.direction_2d()) / random.uniform(3, 12);
      if (v.norm() > 4) continue;
      e.seen.others.push_back({at, v, kLong});
      e.others.push_back({body(aspect, at, std::atan2(v.y(), v.x())), raised(v)});
    }
    if (!e.is_safe(e.seen.wanted)) return e;
  }
}

struct Method {
  const char* name;
  std::function<std::optional<Vector2d>(const Encounter&)> decide;
  int hits = 0, none = 0;
  std::vector<double> ratios{}, times{};  // to the bound; us
};

void compare(double aspect, int count, int encounters) {
  Avoidance ours;
  std::vector<Method> all;
  all.push_back({"dynamic window, others at rest (1997)",
                 [](const Encounter& e) { return dynamic_window(e.seen, false); }});
  all.push_back({"the same, others keep their velocity",
                 [](const Encounter& e) { return dynamic_window(e.seen, true); }});
  all.push_back({"ORCA (2011)", [](const Encounter& e) { return orca(e.seen); }});
  all.push_back({"grid of headings, 1 degree (as DAIDALUS)",
                 [](const Encounter& e) { return heading_grid(e.seen, 1); }});
  all.push_back({"`bands`, nearest free heading", [](const Encounter& e) -> std::optional<Vector2d> {
                   const Vector2d& wanted = e.seen.wanted;
                   const double speed = wanted.norm();
                   const Band band =
                       bands(e.agent, raised(wanted), e.others,
                             {.horizon = {0, e.seen.until}, .speed = {speed, speed}, .climb = {-1e-9, 1e-9}})
                           .heading;
                   const double own = std::atan2(wanted.x(), wanted.y());
                   std::optional<double> nearest;
                   for (const Range& range : band.free)
                     for (const double inside : {1e-9, -1e-9}) {
                       const double end = inside > 0 ? range.from + inside : range.to + inside;
                       const double off = std::remainder(end - own, 2 * kPi);
                       if (end > range.from && end < range.to &&
                           (!nearest || std::abs(off) < std::abs(*nearest)))
                         nearest = off;
                     }
                   if (!nearest) return std::nullopt;
                   return Vector2d(speed * std::sin(own + *nearest), speed * std::cos(own + *nearest));
                 }});
  all.push_back({"`avoid`", [&](const Encounter& e) -> std::optional<Vector2d> {
                   AvoidOptions options;
                   options.until = e.seen.until;
                   options.speed = {0, e.seen.fastest};
                   options.climb = {0, 0};
                   ours = avoid(e.agent, raised(e.seen.wanted), raised(e.seen.wanted), e.others, options);
                   if (ours.status != AvoidStatus::free) return std::nullopt;
                   return Vector2d(ours.velocity.head<2>());
                 }});
  RandomBodies random(31);
  int safe_exists = 0;
  int crowded = 0, hits_when_crowded = 0;
  for (int i = 0; i < encounters; ++i) {
    const Encounter e = encounter(random, aspect, count);
    std::vector<std::optional<Vector2d>> answers;
    for (Method& method : all) {
      const auto start = std::chrono::steady_clock::now();
      answers.push_back(method.decide(e));
      method.times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() *
                             1e6);
    }
    const bool safe = ours.status == AvoidStatus::free;
    safe_exists += safe;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!answers[k]) {
        all[k].none += safe;
        continue;
      }
      const bool hits = !e.is_safe(*answers[k]);
      all[k].hits += hits;
      if (!hits && safe && ours.lower > 0)
        all[k].ratios.push_back((*answers[k] - e.seen.wanted).norm() / ours.lower);
    }
    Vector2d flown = Vector2d::Zero();
    if (!orca(e.seen, &flown)) {
      ++crowded;
      hits_when_crowded += !e.is_safe(flown);
    }
  }
  for (const Method& m : all)
    std::printf("| %g, %d | %s | %d | %d of %d | %.2f, %.1f | %.1f us, %.1f us |\n", aspect, count, m.name,
                m.hits, m.none, safe_exists, quantile(m.ratios, 0.5), quantile(m.ratios, 0.9),
                quantile(m.times, 0.5), quantile(m.times, 0.9));
  std::printf("| %g, %d | ORCA, least violation where the half-planes leave nothing | %d of %d | | | |\n",
              aspect, count, hits_when_crowded, crowded);
}

/// Of conflicts of discs of 500 ft in all, those between two headings of a grid.
void narrow(int conflicts) {
  constexpr double kMile = 1852, kRadius = 152.4 / 2;
  RandomBodies random(32);
  int arcs = 0, unseen = 0, lost = 0;
  for (int i = 0; i < conflicts; ++i) {
    const double own = random.uniform(60, 200), heading = random.uniform(0, 2 * kPi),
                 time = random.uniform(60, 300);
    const Vector2d c = random.uniform(9, 14) * kMile * random.direction_2d();
    const auto on = [&](double q) { return Vector2d(own * std::sin(q), own * std::cos(q)); };
    const Vector2d u = on(heading) - c / time;
    const auto ball = [&](const Vector2d& at) {
      return Placed(Ellipsoid::from_axes({0, 0, 0}, Vector3d::Constant(kRadius)), Pose{raised(at)});
    };
    const Placed agent = ball(Vector2d::Zero());
    const std::vector<Intruder> others{{ball(c), raised(u)}};
    // The grid is one of turns from where it flies now.
    const double now = random.uniform(0, 2 * kPi);
    const Band band = bands(agent, raised(on(now)), others, {.horizon = {}}).heading;
    const auto inside = [](const Range& range, double q) {
      for (const double turn : {-2 * kPi, 0.0, 2 * kPi})
        if (range.from <= q + turn && q + turn <= range.to) return true;
      return false;
    };
    bool found = false, seen = false;
    for (const Range& range : band.conflict) {
      found = found || inside(range, heading);
      if (!inside(range, heading)) continue;
      for (int k = 0; k < 360; ++k) seen = seen || inside(range, std::fmod(now + k * kPi / 180, 2 * kPi));
    }
    ++arcs;
    lost += !found;
    unseen += !seen;
  }
  std::printf(
      "\nConflicts of discs of 500 ft at 9 to 14 nautical miles: %d; between two headings of a grid of 1 "
      "degree: %d; not among the bands: %d\n",
      arcs, unseen, lost);
}

}  // namespace

int main(int argc, char** argv) {
  const int encounters = argc > 1 ? std::atoi(argv[1]) : 300,
            conflicts = argc > 2 ? std::atoi(argv[2]) : 2000;
  std::printf(
      "| aspect, others | method | hits in truth | no answer though there is one | distance from the wanted "
      "velocity over the bound, median and 90 %% | a decision, median and 90 %% |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const double aspect : {1.0, 5.0})
    for (const int count : {1, 4}) compare(aspect, count, encounters);
  narrow(conflicts);
  return 0;
}
