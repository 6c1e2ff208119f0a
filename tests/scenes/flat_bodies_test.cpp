// SPDX-License-Identifier: BSD-3-Clause
//
// Polygons and stadiums in the plane: verdicts against rays of corners in whole numbers, at touches too,
// times and distances against edges.
#include <gtest/gtest.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/scenes/scene.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include "support/random.h"

namespace vericone::flat_bodies_test {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using scenes::Scene, scenes::scene_of_text;

/// Whole numbers below 2^30: what is below has no more than 63 bits.
struct Point {
  std::int64_t x = 0, y = 0;

  Point operator-(const Point& b) const { return {x - b.x, y - b.y}; }
  Point operator-() const { return {-x, -y}; }
};
std::int64_t cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
std::int64_t dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
int sign(std::int64_t x) { return (x > 0) - (x < 0); }

/// An outline and its holes.
using Rings = std::vector<std::vector<Point>>;

/// Whether p + t w, t >= 0, meets the segment.
bool hits(const Point& p, const Point& w, const Point& c, const Point& d) {
  const Point along = d - c;
  std::int64_t across = cross(w, along), at = cross(c - p, along), on = cross(c - p, w);
  if (across == 0) return on == 0 && (dot(c - p, w) >= 0 || dot(d - p, w) >= 0);
  if (across < 0) across = -across, at = -at, on = -on;
  return at >= 0 && on >= 0 && on <= across;
}

template <typename Holds>
bool any_edge(const Rings& rings, const Holds& holds) {
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (holds(ring[i], ring[(i + 1) % ring.size()])) return true;
  return false;
}

/// Whether the agent, moving along w, meets the obstacle, by touching too; of bodies that are apart now.
bool meets(const Rings& agent, const Rings& obstacle, const Point& w) {
  const auto one = [](const Rings& from, const Rings& to, const Point& way) {
    return any_edge(from, [&](const Point& a, const Point&) {
      return any_edge(to, [&](const Point& c, const Point& d) { return hits(a, way, c, d); });
    });
  };
  return one(agent, obstacle, w) || one(obstacle, agent, -w);
}

bool is_inside(const Rings& rings, const Point& x) {
  bool odd = false;
  any_edge(rings, [&](const Point& a, const Point& b) {
    if ((a.y > x.y) != (b.y > x.y) && (sign(cross(b - a, x - a)) > 0) == (b.y > a.y)) odd = !odd;
    return false;
  });
  return odd;
}

bool edges_meet(const Rings& p, const Rings& q) {
  return any_edge(p, [&](const Point& a, const Point& b) {
    return any_edge(q, [&](const Point& c, const Point& d) {
      return hits(a, b - a, c, d) && hits(b, a - b, c, d) && hits(c, d - c, a, b) && hits(d, c - d, a, b);
    });
  });
}

bool are_apart(const Rings& p, const Rings& q) {
  return !edges_meet(p, q) && !is_inside(p, q[0][0]) && !is_inside(q, p[0][0]);
}

/// In the interior of the directions that meet, or an end of them.
Verdict truth(const Rings& agent, const Rings& obstacle, const Point& w) {
  if (!meets(agent, obstacle, w)) return Verdict::out;
  constexpr std::int64_t kFine = 1 << 20;  // turned by less than any two directions of corners are apart
  for (const int side : {-1, 1})
    if (!meets(agent, obstacle, {kFine * w.x - side * w.y, kFine * w.y + side * w.x})) return Verdict::on;
  return Verdict::in;
}

std::string text_of(const std::vector<Point>& ring) {
  std::ostringstream text;
  for (const Point& x : ring) text << (&x == ring.data() ? "[" : ", ") << "[" << x.x << ", " << x.y << "]";
  return text.str() + "]";
}

std::string body_text(const Rings& rings) {
  std::string text = "{polygon: " + text_of(rings[0]);
  for (std::size_t i = 1; i < rings.size(); ++i) text += (i == 1 ? ", holes: [" : ", ") + text_of(rings[i]);
  return text + (rings.size() > 1 ? "]}" : "}");
}

Scene scene_of(const Rings& agent, const Rings& obstacle) {
  return scene_of_text("agent: " + body_text(agent) + "\nobstacle: " + body_text(obstacle), "none.yaml");
}

/// Corners around a point on whole numbers; what is not simple is refused by the reader, and left out.
std::vector<Point> star(testing::Random& random, int x, int y, int size, int count) {
  std::vector<Point> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0.2, 0.8)) / count,
                 far = size * random.uniform(0.3, 1);
    ring.push_back({x + std::lround(far * std::cos(angle)), y + std::lround(far * std::sin(angle))});
  }
  return ring;
}

std::optional<Pair> pair_of_polygons(const Rings& a, const Rings& b) {
  try {
    return scene_of(a, b).pair();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

Vector3d velocity(const Point& w) { return {double(w.x), double(w.y), 0}; }

TEST(FlatBodies, VerdictsAreThoseOfCornersInWholeNumbers) {
  testing::Random random(4103);
  SCOPED_TRACE(random.trace());
  std::array<int, 3> seen{};
  int enclosed = 0, holed = 0;
  const int cases = testing::campaign_size(400, 10'000);
  for (int i = 0; i < cases; ++i) {
    Rings agent{star(random, random.integer(-14, 14), random.integer(-14, 14), random.integer(2, 6),
                     random.integer(3, 7))};
    Rings obstacle{star(random, 0, 0, random.integer(4, 12), random.integer(3, 12))};
    if (i % 4 == 0) {  // a frame: the agent may be in it
      obstacle = {{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}, {{-16, -16}, {-16, 16}, {16, 16}, {16, -16}}};
      obstacle.push_back({{17, 1}, {18, 2}, {18, 0}});
    }
    const auto pair = pair_of_polygons(agent, obstacle);
    if (!pair || !are_apart(agent, obstacle)) continue;
    EXPECT_EQ(pair->relation(), Relation::disjoint) << body_text(agent) << body_text(obstacle);
    enclosed += i % 4 == 0 && std::abs(agent[0][0].x) < 16;
    holed += obstacle.size() > 1;
    std::vector<Point> ways;
    for (int k = 0; k < 6; ++k) ways.push_back({random.integer(-9, 9), random.integer(-9, 9)});
    for (int k = 0; k < 10; ++k) {  // from corner to corner
      const auto& ring = obstacle[std::size_t(random.integer(0, int(obstacle.size()) - 1))];
      const Point &a = agent[0][std::size_t(random.integer(0, int(agent[0].size()) - 1))],
                  &b = ring[std::size_t(random.integer(0, int(ring.size()) - 1))];
      ways.push_back(b - a);
    }
    for (const Point& w : ways) {
      if (w.x == 0 && w.y == 0) continue;
      const Verdict expected = truth(agent, obstacle, w),
                    found = pair->verdict(velocity(w), Vector3d::Zero());
      EXPECT_EQ(found, expected) << body_text(agent) << body_text(obstacle) << w.x << " " << w.y;
      EXPECT_EQ(pair->verdict(Vector3d::Zero(), -velocity(w)), expected);
      ++seen[expected == Verdict::out ? 0 : expected == Verdict::on ? 1 : 2];
      if (expected != Verdict::on) continue;
      // The next numbers on both sides of a touch: one meets no more than the other says.
      for (const int side : {-1, 1}) {
        const Point near{(1 << 20) * w.x - side * w.y, (1 << 20) * w.y + side * w.x};
        EXPECT_EQ(pair->verdict(velocity(near), Vector3d::Zero()), truth(agent, obstacle, near));
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(seen[0], cases);
  EXPECT_GT(seen[1], cases / 3);
  EXPECT_GT(seen[2], cases);
  EXPECT_GT(enclosed, cases / 40);
  EXPECT_GT(holed, cases / 40);
}

double distance_to(const Vector2d& x, const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
  return (a + t * (b - a) - x).norm();
}

/// Between bodies that are apart: of corners and edges.
double distance_of(const Rings& p, const Rings& q, const Vector2d& moved) {
  double least = std::numeric_limits<double>::infinity();
  const auto at = [](const Point& x) { return Vector2d(double(x.x), double(x.y)); };
  any_edge(p, [&](const Point& a, const Point& b) {
    return any_edge(q, [&](const Point& c, const Point& d) {
      const Vector2d e = at(a) + moved, f = at(b) + moved;
      least = std::min({least, distance_to(e, at(c), at(d)), distance_to(f, at(c), at(d)),
                        distance_to(at(c), e, f), distance_to(at(d), e, f)});
      return false;
    });
  });
  return least;
}

TEST(FlatBodies, TimesAndDistancesAreThoseOfTheirEdges) {
  testing::Random random(4104);
  SCOPED_TRACE(random.trace());
  int met = 0, missed = 0;
  for (int i = 0; i < 150; ++i) {
    const Rings agent{star(random, 20, random.integer(-9, 9), 5, random.integer(3, 7))},
        obstacle{star(random, 0, 0, 9, random.integer(3, 12))};
    const auto pair = pair_of_polygons(agent, obstacle);
    if (!pair || !are_apart(agent, obstacle)) continue;
    const Point way{random.integer(-9, -1), random.integer(-4, 4)};
    const Vector3d w = velocity(way), still = Vector3d::Zero();
    EXPECT_NEAR(pair->distance(), distance_of(agent, obstacle, {0, 0}), 1e-9);
    // Steps no longer than what is left between them.
    double time = 0;
    for (int step = 0; step < 100'000; ++step) {
      const double left = distance_of(agent, obstacle, time * w.head<2>());
      if (left < 1e-9 || time > 100) break;
      time += left / w.norm();
    }
    if (const auto contact = pair->contact(w, still)) {
      EXPECT_LE(contact->earliest - 1e-6, time);
      EXPECT_NEAR(contact->time, time, 1e-6);
      ++met;
    } else {
      double least = std::numeric_limits<double>::infinity();
      for (double t = 0; t < 60; t += 0.01)
        least = std::min(least, distance_of(agent, obstacle, t * w.head<2>()));
      const Miss miss = pair->miss(w, still);
      EXPECT_LE(miss.least, least + 1e-9);
      EXPECT_NEAR(miss.most, least, 0.06);  // between two samples
      ++missed;
    }
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(missed, 20);
}

/// Two stadiums that pass each other sideways by 3 m, radii 1 and 2: in a frame turned by 3-4-5 too.
TEST(FlatBodies, StadiumsTouchWhereTheirRadiiAddUp) {
  const auto verdict = [](double y) {
    std::ostringstream text;
    text.precision(17);
    text << "agent: {stadium: {radius: 1, length: 4}, center: [-20, " << y
         << "]}\nobstacle: {stadium: {radius: 2, length: 6}, center: [0, 0]}\nagent_velocity: [3, 0]";
    const Scene scene = scene_of_text(text.str(), "none.yaml");
    EXPECT_TRUE(scene.in_plane && !scene.planar);
    return scene.pair().verdict(scene.agent.velocity, scene.obstacle.velocity);
  };
  EXPECT_EQ(verdict(3), Verdict::on);
  EXPECT_EQ(verdict(-3), Verdict::on);
  EXPECT_EQ(verdict(std::nextafter(3, 4)), Verdict::out);
  EXPECT_EQ(verdict(std::nextafter(3, 2)), Verdict::in);
  // A disc past a point of a polygon, 5 m off, along (3, 4).
  const auto past = [](double x) {
    std::ostringstream text;
    text.precision(17);
    text << "agent: {stadium: {radius: 5, length: 0}, center: [" << x
         << ", 3]}\nobstacle: {polygon: [[30, 40], [60, 40], [60, 30]]}\nagent_velocity: [3, 4]";
    const Scene scene = scene_of_text(text.str(), "none.yaml");
    return scene.pair().verdict(scene.agent.velocity, scene.obstacle.velocity);
  };
  EXPECT_EQ(past(-4), Verdict::on);
  EXPECT_EQ(past(std::nextafter(-4, -5)), Verdict::out);
  EXPECT_EQ(past(std::nextafter(-4, 0)), Verdict::in);
}

/// A margin of a polygon is a disc that goes around it; an ellipse that is a circle grows into a larger one.
TEST(FlatBodies, MarginsAreTheSumWithADisc) {
  const auto pair = [](const std::string& obstacle) {
    return scene_of_text("agent: {stadium: {radius: 0.5, length: 0}, center: [20, 1]}\nobstacle: " + obstacle,
                         "none.yaml")
        .pair();
  };
  const Pair square = pair("{polygon: [[-2, -2], [2, -2], [2, 2], [-2, 2]], margin: 1}");
  EXPECT_NEAR(square.distance(), 20 - 0.5 - 3, 1e-9);
  const Pair dented = pair("{polygon: [[-2, -2], [2, -2], [0, 0], [2, 2], [-2, 2]], margin: 1}");
  EXPECT_NEAR(dented.distance(), std::hypot(18, 1) - 1.5, 1e-6);
  const Pair circle = pair("{center: [0, 0], semi_axes: [2, 2], margin: 1}");
  EXPECT_NEAR(circle.distance(), std::hypot(20, 1) - 3.5, 1e-9);
  for (const double angle : {3.0, 3.1, 3.2, 3.3}) {
    const Vector3d w(std::cos(angle), std::sin(angle), 0);
    const double passes = std::abs(20 * w.y() - w.x());
    EXPECT_EQ(circle.verdict(w, Vector3d::Zero()), passes < 3.5 ? Verdict::in : Verdict::out);
  }
}

/// A union is met first when the first of its pieces is; a wall as far as it goes.
TEST(FlatBodies, UnionsAreMetWhereTheirPiecesAre) {
  testing::Random random(4113);
  SCOPED_TRACE(random.trace());
  const std::string agent = "agent: {stadium: {radius: 0.5, length: 1}, center: [-9, 0.25], rotation: 0.4}\n";
  const auto pair = [&](const std::string& obstacle) {
    const Scene scene = scene_of_text(agent + "obstacle: " + obstacle, "none.yaml");
    EXPECT_TRUE(scene.in_plane);
    return scene.pair();
  };
  const std::string pieces[] = {"{polygon: [[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [0, 1]], center: [1, 2]}",
                                "{stadium: {radius: 1, length: 3}, center: [0, -4], rotation: 1}",
                                "{center: [4, 0], semi_axes: [1, 2], rotation: 0.2}",
                                "{half_space: {normal: [-1, 2], offset: -21, extent: 40}}"};
  std::string all = pieces[0];
  for (int k = 1; k < 4; ++k) all += ", " + pieces[k];
  const Pair whole = pair("{pieces: [" + all + "]}");
  std::vector<Pair> each;
  for (const std::string& piece : pieces) each.push_back(pair(piece));
  double least = std::numeric_limits<double>::infinity();
  for (const Pair& one : each) least = std::min(least, one.distance());
  EXPECT_NEAR(whole.distance(), least, 1e-9);
  int met = 0, missed = 0;
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(-1.2, 1.2);
    const Vector3d w(std::cos(angle), std::sin(angle), 0), still = Vector3d::Zero();
    // Of the first of them, what is proved of its time.
    double earliest = std::numeric_limits<double>::infinity(), latest = earliest;
    for (const Pair& one : each)
      if (const auto contact = one.contact(w, still)) {
        earliest = std::min(earliest, contact->earliest);
        latest = std::min(latest, contact->latest);
      }
    const bool meets = std::isfinite(earliest);
    EXPECT_EQ(whole.verdict(w, still), meets ? Verdict::in : Verdict::out);
    ++(meets ? met : missed);
    if (!meets) continue;
    const auto contact = whole.contact(w, still);
    EXPECT_LE(contact->earliest, latest);
    EXPECT_GE(contact->latest, earliest);
    EXPECT_LT(contact->latest - contact->earliest, 1e-6);
    EXPECT_LT(latest - earliest, 1e-6);
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(missed, 20);
  EXPECT_NEAR(pair("{pieces: [" + pieces[1] + "], margin: 0.5}").distance(), each[1].distance() - 0.5, 1e-9);
}

TEST(FlatBodies, TurnAboutTheirOwnOrigin) {
  const Scene turned = scene_of_text(
      "agent: {center: [9, 0], semi_axes: [1, 1]}\n"
      "obstacle: {polygon: [[0, 0], [2, 0], [2, 1], [0, 1]], center: [0, 3], rotation: 1.5707963267948966}",
      "none.yaml");
  const Placed& body = turned.obstacle.placed;
  EXPECT_NEAR(body.support(Vector3d::UnitX()), 0, 1e-15);
  EXPECT_NEAR(body.support(-Vector3d::UnitX()), 1, 1e-15);
  EXPECT_NEAR(body.support(Vector3d::UnitY()), 5, 1e-15);
  EXPECT_EQ(turned.obstacle.name, "polygon of 4 corners");
}

TEST(FlatBodies, AreWrittenAsTheirFileHasThem) {
  const auto file =
      std::filesystem::temp_directory_path() / ("vericone_flat_" + std::to_string(::getpid()) + ".yaml");
  const Scene scene = scene_of_text(
      "agent: {stadium: {radius: 1, length: 3}, center: [0.1, 9], rotation: 0.3}\n"
      "obstacle: {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]], holes: [[[1, 1], [2, 1], [1, 2]]], margin: "
      "0.1}\n"
      "agent_velocity: [1, 2]",
      "none.yaml");
  scenes::write_scene(scene, file);
  const Scene again = scenes::read_scene(file);
  std::filesystem::remove(file);
  EXPECT_TRUE(again.in_plane);
  EXPECT_EQ(again.agent.velocity, scene.agent.velocity);
  EXPECT_EQ(again.agent.placed.pose.rotation, scene.agent.placed.pose.rotation);
  EXPECT_EQ(again.obstacle.placed.body.assembly()->size(), scene.obstacle.placed.body.assembly()->size());
}

TEST(FlatBodies, InSpaceAreRefused) {
  const auto field = [](const std::string& text) {
    try {
      static_cast<void>(scene_of_text(text, "none.yaml"));
    } catch (const InputError& e) {
      return e.field();
    }
    return std::string();
  };
  const std::string polygon = "{polygon: [[0, 0], [1, 0], [0, 1]]}";
  EXPECT_EQ(field("agent: " + polygon + "\nobstacle: {center: [9, 0, 0], semi_axes: [1, 1, 1]}"),
            "agent.polygon");
  EXPECT_EQ(field("agent: {box: {half_widths: [1, 1, 1]}}\nobstacle: " + polygon), "obstacle.polygon");
  EXPECT_EQ(field("agent: " + polygon + "\nobstacle: {pieces: [" + polygon + "]}"), "");  // in the plane
  EXPECT_EQ(field("agent: {center: [9, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {pieces: [" + polygon + "]}"),
            "obstacle.pieces[0].polygon");
  EXPECT_EQ(field("agent: {stadium: {radius: 0, length: 1}}\nobstacle: " + polygon), "agent.stadium.radius");
  EXPECT_EQ(field("agent: {polygon: [[0, 0], [1, 0], [0, 1]], stadium: {radius: 1, length: 1}}\nobstacle: " +
                  polygon),
            "agent.stadium");
  EXPECT_EQ(field("agent: {polygon: [[0, 0], [1, 1], [1, 0], [0, 1]]}\nobstacle: " + polygon),
            "agent.polygon[2]");
}

}  // namespace
}  // namespace vericone::flat_bodies_test
