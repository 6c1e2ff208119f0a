// SPDX-License-Identifier: BSD-3-Clause
//
// Imazu's 22 encounters and a harbour. What is at rest here is data; its sources: docs/explanation/ships.md.
#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace vericone::ships {

using Eigen::Vector2d;

namespace {

constexpr double kMile = 1852, kKnot = 1852.0 / 3600, kDegree = std::numbers::pi / 180;
// Every ship would be at the origin after half an hour: own ship and most others at 12 knots, others that
// are slower, and are overtaken, at 8.4.
constexpr double kMeet = 1800, kFast = 12 * kKnot, kSlow = 8.4 * kKnot;

/// Courses of the other ships, degrees clockwise from own ship's; the first of those named is slow.
const std::array<std::vector<double>, 22> kCourses{{{180},
                                                    {-90},
                                                    {0},
                                                    {45},
                                                    {180, -90},
                                                    {-10, -45},
                                                    {0, -45},
                                                    {180, -90},
                                                    {-30, -90},
                                                    {-90, 15},
                                                    {90, -30},
                                                    {180, -45, -10},
                                                    {180, 10, 45},
                                                    {-10, -45, -90},
                                                    {0, -45, -90},
                                                    {45, 90, -90},
                                                    {0, 10, -45},
                                                    {-135, -15, -30},
                                                    {15, -15, -135},
                                                    {0, -15, -90},
                                                    {-15, 15, -90},
                                                    {0, -45, -90}}};
constexpr std::array<int, 7> kWithSlow{3, 7, 15, 16, 17, 20, 22};

/// On a course, degrees clockwise from north, at the origin after `meet` seconds and at her goal after as
/// many again.
Ship bound(double course, double speed, double meet) {
  Ship ship;
  ship.heading = (90 - course) * kDegree;
  ship.speed = ship.wished = speed;
  const Vector2d way = meet * speed * Vector2d(std::sin(course * kDegree), std::cos(course * kDegree));
  ship.position = -way;
  ship.goal = way;
  return ship;
}

std::vector<Ship> imazu(int number) {
  std::vector<Ship> ships{bound(0, kFast, kMeet)};
  bool slow = std::find(kWithSlow.begin(), kWithSlow.end(), number) != kWithSlow.end();
  for (const double course : kCourses[static_cast<std::size_t>(number - 1)]) {
    ships.push_back(bound(course, slow ? kSlow : kFast, kMeet));
    slow = false;
  }
  return ships;
}

/// Two ships go in, two out, a ferry crosses, a tug follows: shorter ships, Fujii's domains.
std::vector<Ship> harbour() {
  const auto ship = [](double length, Vector2d from, Vector2d to, double knots) {
    Ship one;
    one.handling = {length, length / 6, 3 * length, length, 0.015, 0.03};
    one.domain = Domain::fujii(length);
    one.position = kMile * from;
    one.goal = kMile * to;
    const Vector2d way = to - from;
    one.heading = std::atan2(way.y(), way.x());
    one.speed = one.wished = knots * kKnot;
    return one;
  };
  return {ship(120, {0, -3}, {0, 3}, 8),    ship(90, {0.1, 3}, {0.1, -3}, 8),
          ship(60, {-2, 0.3}, {2, 0.3}, 7), ship(60, {2, -0.2}, {-2, -0.2}, 7),
          ship(40, {0, -1.9}, {0, 2}, 5),   ship(120, {-1.6, 2.4}, {1.6, -2.4}, 9)};
}

}  // namespace

const std::vector<std::string>& encounter_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (int k = 1; k <= 22; ++k)
      all.push_back(std::string("imazu-") + (k < 10 ? "0" : "") + std::to_string(k));
    all.emplace_back("harbour");
    return all;
  }();
  return names;
}

std::vector<Ship> ships_of(const std::string& name) {
  const std::vector<std::string>& names = encounter_names();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return k < 22 ? imazu(static_cast<int>(k) + 1) : harbour();
  throw InputError("name", name, "imazu-01 to imazu-22, or harbour");
}

}  // namespace vericone::ships
