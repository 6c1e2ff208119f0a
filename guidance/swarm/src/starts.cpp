// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::swarm {

using Eigen::Vector3d;
using engagements::Random;

namespace {

constexpr double kScatter = 0.01;  // m
constexpr double kRadius = 1.5;    // m, of balls

Vector3d scattered(const Vector3d& x, Random& random) {
  const double a = random.uniform(-kScatter, kScatter), b = random.uniform(-kScatter, kScatter);
  return x + Vector3d(a, b, random.uniform(-kScatter, kScatter));
}

Agent agent_at(const Vector3d& start, std::vector<Vector3d> goals, double radius = kRadius) {
  Agent agent;
  agent.body = Solid::ball(radius);
  agent.position = start;
  agent.goals = std::move(goals);
  return agent;
}

/// A block of points about a middle, every `spacing` m, as many along each axis.
std::vector<Vector3d> block(std::size_t count, const Vector3d& middle, double spacing) {
  std::size_t side = 1;
  while (side * side * side < count) ++side;
  const double half = 0.5 * spacing * static_cast<double>(side - 1);
  std::vector<Vector3d> points;
  for (std::size_t k = 0; k < count; ++k)
    points.emplace_back(middle +
                        spacing * Vector3d(static_cast<double>(k / (side * side)),
                                           static_cast<double>(k / side % side),
                                           static_cast<double>(k % side)) -
                        Vector3d::Constant(half));
  return points;
}

double width_of_block(std::size_t count, double spacing) {
  return spacing * std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9);
}

Start circle(std::size_t count, Random& random) {
  const double radius = std::max(10.0, 4.5 * static_cast<double>(count) / (2 * std::numbers::pi));
  Start start;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const Vector3d x = radius * Vector3d(std::cos(angle), std::sin(angle), 0);
    start.agents.push_back(agent_at(scattered(x, random), {-x}));
  }
  return start;
}

/// On circles of latitude 10 m apart, an agent for every 2.5 m of their radius, from one pole to the other:
/// 812 agents on a sphere of 100 m, as in RVO2-3D's example.
std::vector<Vector3d> on_sphere(std::size_t count) {
  for (double radius = std::max(10.0, 100 * std::sqrt(static_cast<double>(count) / 812));; radius *= 1.01) {
    std::vector<Vector3d> points;
    for (int ring = 0; ring * 10 / radius < std::numbers::pi; ++ring) {
      const double angle = ring * 10 / radius, r = radius * std::sin(angle), here = std::ceil(r / 2.5);
      for (int i = 0; i < here; ++i)
        points.emplace_back(r * std::cos(2 * std::numbers::pi * i / here),
                            r * std::sin(2 * std::numbers::pi * i / here), radius * std::cos(angle));
    }
    if (points.size() < count) continue;
    points.resize(count);
    return points;
  }
}

Start sphere(std::size_t count, Random& random) {
  Start start;
  for (const Vector3d& x : on_sphere(count)) start.agents.push_back(agent_at(scattered(x, random), {-x}));
  return start;
}

Start slender(std::size_t count, Random& random) {
  Start start = sphere(count, random);
  for (Agent& agent : start.agents) {
    agent.body.half = Vector3d(3, 0.75, 0.75);
    agent.body.rotation =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), agent.goals[0] - agent.position)
            .toRotationMatrix();
  }
  return start;
}

Start turning(std::size_t count, Random& random) {
  Start start = slender(count, random);
  for (Agent& agent : start.agents) agent.turning = 1;
  return start;
}

Start crossing(std::size_t count, Random& random) {
  constexpr double kSpacing = 8;
  const std::size_t first = count - count / 2;
  const double far = width_of_block(first, kSpacing) + 10;
  Start start;
  for (const auto& [number, ahead] : {std::pair(first, Vector3d(1, 0, 0)), {count / 2, Vector3d(0, 1, 0)}})
    for (const Vector3d& x : block(number, -far * ahead, kSpacing))
      start.agents.push_back(agent_at(scattered(x, random), {x + 2 * far * ahead}));
  return start;
}

Start gap(std::size_t count, Random& random) {
  constexpr double kSpacing = 6, kHalf = 12, kOuter = 100, kInside = kHalf - kRadius - 1.5;
  const double half = 0.5 * width_of_block(count, kSpacing) - 0.5 * kSpacing, far = half + 20,
               strip = 0.5 * (kOuter - kHalf);
  Start start;
  for (const Vector3d& x : block(count, Vector3d(-far, 0, 0), kSpacing)) {
    // To a place in the hole, then through it: who is pushed aside before the wall has passed neither.
    const Vector3d hole = std::min(1.0, kInside / half) * Vector3d(0, x.y(), x.z()), half_through(1, 0, 0);
    start.agents.push_back(agent_at(scattered(x, random),
                                    {hole - half_through, hole + half_through, x + Vector3d(2 * far, 0, 0)}));
  }
  for (const double side : {-1.0, 1.0}) {
    Solid beside, above;
    beside.box = above.box = true;
    beside.half = Vector3d(0.5, strip, kOuter);
    above.half = Vector3d(0.5, kHalf, strip);
    start.obstacles.push_back({beside, Vector3d(0, side * (kHalf + strip), 0)});
    start.obstacles.push_back({above, Vector3d(0, 0, side * (kHalf + strip))});
  }
  return start;
}

/// Ten bodies for an agent, in a cube, with 3 m or more between any two.
Start forest(std::size_t count, Random& random) {
  constexpr double kAgent = 1, kRoom = 3, kLane = 8;
  const std::size_t bodies = 10 * count;
  const double side = 10 * std::cbrt(static_cast<double>(bodies));
  Start start;
  while (start.obstacles.size() < bodies) {
    const double thin = random.uniform(0.5, 1);
    Solid body{Vector3d(2 * thin, thin, thin), random.rotation(), false};
    const Vector3d at =
        side * Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    const auto crowded = [&](const Obstacle& other) {
      return (other.position - at).norm() < other.body.reach() + body.reach() + kRoom;
    };
    if (std::none_of(start.obstacles.begin(), start.obstacles.end(), crowded))
      start.obstacles.push_back({body, at});
  }
  std::size_t across = 1;
  while (across * across < count) ++across;
  const double middle = 0.5 * static_cast<double>(across - 1);
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3d x(-0.5 * side - 10, kLane * (static_cast<double>(k / across) - middle),
                     kLane * (static_cast<double>(k % across) - middle));
    start.agents.push_back(agent_at(scattered(x, random), {x + Vector3d(side + 20, 0, 0)}, kAgent));
  }
  return start;
}

}  // namespace

const std::vector<std::string>& start_names() {
  static const std::vector<std::string> names{"circle", "sphere",  "crossing", "gap",
                                              "forest", "slender", "turning"};
  return names;
}

Start start_of(const std::string& name, std::size_t agents, std::uint64_t seed) {
  if (agents == 0 || agents > 1'000'000) throw InputError("agents", std::to_string(agents), "1 to 1000000");
  Random random(seed, 0);
  if (name == "circle") return circle(agents, random);
  if (name == "sphere") return sphere(agents, random);
  if (name == "crossing") return crossing(agents, random);
  if (name == "gap") return gap(agents, random);
  if (name == "forest") return forest(agents, random);
  if (name == "slender") return slender(agents, random);
  if (name == "turning") return turning(agents, random);
  throw InputError("name", name, "circle, sphere, crossing, gap, forest, slender or turning");
}

}  // namespace vericone::swarm
