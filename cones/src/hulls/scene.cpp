// SPDX-License-Identifier: BSD-3-Clause
#include "hulls/scene.h"

#include "answers/stretch.h"

#include <vericone/internal/geometry/double_double.h>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace vericone {
namespace {

constexpr int kNoGrid = 1 << 20;

/// The largest e for which the finite x is a multiple of 2^e; kNoGrid for 0. As exact::grid_exponent,
/// quicker.
int fine_grid(double x) {
  if (x == 0) return kNoGrid;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto biased = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction =
      (bits & ((std::uint64_t{1} << 52) - 1)) | (biased == 0 ? 0 : std::uint64_t{1} << 52);
  return (biased == 0 ? -1074 : biased - 1075) + std::countr_zero(fraction);
}

/// x + at - reference, in metres.
void fill(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& at,
          const Eigen::Vector3d& reference, CentredPoints& to) {
  to.x.reserve(points.size());
  to.y.reserve(points.size());
  to.z.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    to.x.push_back(sum_of_three(p.x(), at.x(), -reference.x()));
    to.y.push_back(sum_of_three(p.y(), at.y(), -reference.y()));
    to.z.push_back(sum_of_three(p.z(), at.z(), -reference.z()));
    to.reach = to.reach.cwiseMax(to[to.size() - 1].cwiseAbs());
  }
}

void scale_by(double scale, CentredPoints& points) {
  for (auto* list : {&points.x, &points.y, &points.z})
    for (double& x : *list) x *= scale;
  points.reach *= scale;
}

/// Index of the least of sign * n.x over the points.
template <int kSign>
std::uint32_t least(const CentredPoints& points, const Eigen::Vector3d& n, double& value) noexcept {
  constexpr std::size_t kBlock = 16;
  const double nx = n.x(), ny = n.y(), nz = n.z();
  const double *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
  const std::size_t size = points.size();
  std::size_t best = 0, i = 0;
  double most = kSign * (nx * x[0] + ny * y[0] + nz * z[0]);
  // In blocks whose values are computed together and looked at one by one only where they hold a better one.
  for (; i + kBlock <= size; i += kBlock) {
    double values[kBlock];
    for (std::size_t j = 0; j < kBlock; ++j)
      values[j] = kSign * (nx * x[i + j] + ny * y[i + j] + nz * z[i + j]);
    double quarter[4] = {values[0], values[1], values[2], values[3]};
    for (std::size_t j = 4; j < kBlock; ++j) quarter[j % 4] = std::min(quarter[j % 4], values[j]);
    if (std::min(std::min(quarter[0], quarter[1]), std::min(quarter[2], quarter[3])) < most)
      for (std::size_t j = 0; j < kBlock; ++j)
        if (values[j] < most) {
          most = values[j];
          best = i + j;
        }
  }
  for (; i < size; ++i) {
    const double v = kSign * (nx * x[i] + ny * y[i] + nz * z[i]);
    if (v < most) {
      most = v;
      best = i;
    }
  }
  value = kSign * most;
  return static_cast<std::uint32_t>(best);
}

}  // namespace

HullScene::HullScene(std::vector<Eigen::Vector3d> agent_points, const Eigen::Vector3d& agent_at,
                     std::vector<Eigen::Vector3d> obstacle_points, const Eigen::Vector3d& obstacle_at,
                     const Eigen::Vector3d& reference, const Ellipsoid* round)
    : agent(std::move(agent_points)), obstacle(std::move(obstacle_points)) {
  fill(agent, agent_at, reference, centred_agent);
  fill(obstacle, obstacle_at, reference, centred_obstacle);
  double largest = reference.allFinite()
                       ? std::max(centred_agent.reach.maxCoeff(), centred_obstacle.reach.maxCoeff())
                       : std::numeric_limits<double>::infinity();
  int finest = kNoGrid;
  const auto look_at = [&](const Eigen::Vector3d& p) {
    for (int k = 0; k < 3; ++k) finest = std::min(finest, fine_grid(p(k)));
  };
  look_at(agent_at);
  look_at(obstacle_at);
  for (const auto* points : {&agent, &obstacle})
    for (const Eigen::Vector3d& p : *points) look_at(p);
  if (round) {
    ellipsoid = *round;
    largest = std::max(largest, round->factor().cwiseAbs().maxCoeff());
    const bool by_factor = round->defined_by_factor();
    for (int i = 0; i < 9; ++i) {
      const int g = fine_grid(by_factor ? round->factor()(i) : round->shape()(i));
      if (g != kNoGrid) finest = std::min(finest, by_factor ? g : static_cast<int>(std::floor(g / 2.0)));
    }
  }
  grid = finest == kNoGrid ? 0 : finest;
  for (int k = 0; k < 3; ++k) {
    exact_agent_at[k] = exact::on_grid(agent_at(k), grid);
    exact_obstacle_at[k] = exact::on_grid(obstacle_at(k), grid);
  }
  if (round) {
    if (!round->defined_by_factor()) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) exact_shape[i][j] = exact::on_grid(round->shape()(i, j), 2 * grid);
    } else {
      exact::IntegerMatrix<3> f;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f[i][j] = exact::on_grid(round->factor()(i, j), grid);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          exact_shape[i][j] = f[i][0] * f[j][0] + f[i][1] * f[j][1] + f[i][2] * f[j][2];
    }
  }
  if (!std::isfinite(largest)) return;
  const int e = largest == 0 ? 0 : std::ilogb(largest) + 1;
  if (std::abs(e) > 510) return;
  exponent = e;
  const double scale = std::ldexp(1.0, -e);  // a power of two: scaling is exact but for underflow
  scale_by(scale, centred_agent);
  scale_by(scale, centred_obstacle);
  reach = centred_agent.reach + centred_obstacle.reach;
  usable = true;
  if (!round) return;
  factor = round->factor() * scale;
  shape = round->shape() * scale * scale;
  to_ball = factor.inverse();
  usable = to_ball.allFinite() && to_ball.cwiseAbs().maxCoeff() < 1e100;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Interval& entry = enclosed_shape[kPacked[i][j]];
      double& magnitude = shape_magnitude[kPacked[i][j]];
      if (round->defined_by_factor()) {
        entry = 0;
        for (int k = 0; k < 3; ++k) {
          entry = entry + Interval(factor(i, k), Interval::kTiny) * Interval(factor(j, k), Interval::kTiny);
          magnitude += std::abs(factor(i, k) * factor(j, k));
        }
        shape(i, j) = shape(j, i) =
            factor(i, 0) * factor(j, 0) + factor(i, 1) * factor(j, 1) + factor(i, 2) * factor(j, 2);
      } else {
        entry = Interval(shape(i, j), Interval::kTiny);
        magnitude = std::abs(shape(i, j));
      }
      usable = usable && magnitude < 0x1p20;
    }
}

HullScene::HullScene(const HullScene& scene, const Stretch& stretch)
    : agent(scene.agent), obstacle(scene.obstacle), ellipsoid(scene.ellipsoid), stretched(true) {
  agent.insert(agent.end(), scene.agent.begin(), scene.agent.end());
  const exact::Way first(stretch, stretch.from), last(stretch, std::isinf(stretch.until) ? 1 : stretch.until);
  grid = std::min({scene.grid, first.exponent, last.exponent});
  const auto finer = [&](const exact::Integer& x, int power) {
    return x << static_cast<unsigned>(power * (scene.grid - grid));
  };
  exact_shape = scene.exact_shape;
  for (auto& row : exact_shape)
    for (exact::Integer& entry : row) entry = finer(entry, 2);
  for (int k = 0; k < 3; ++k) {
    exact_obstacle_at[k] = finer(scene.exact_obstacle_at[k], 1);
    exact_agent_at[k] = exact_agent_end[k] = finer(scene.exact_agent_at[k], 1);
    exact_agent_at[k] += first.on(k, grid);
  }
  // One that never ends goes on until it has passed: by as much as all numbers together.
  exact::Integer times = 1;
  if (std::isinf(stretch.until)) {
    for (const auto* points : {&agent, &obstacle})
      for (std::size_t i = 0; i < points->size(); ++i)
        for (const exact::Integer& x : points == &agent ? exact_agent(i) : exact_obstacle(i)) times += abs(x);
    for (const auto& row : exact_shape)
      for (const exact::Integer& entry : row) times += abs(entry);
  }
  for (int k = 0; k < 3; ++k) {
    if (std::isinf(stretch.until)) exact_agent_end[k] += first.on(k, grid);
    exact_agent_end[k] += last.on(k, grid) * times;
  }
}

HullSupport least_support(const HullScene& scene, const Eigen::Vector3d& n) noexcept {
  HullSupport support;
  support.pair.obstacle = least<1>(scene.centred_obstacle, n, support.obstacle_value);
  support.pair.agent = least<-1>(scene.centred_agent, n, support.agent_value);
  return support;
}

}  // namespace vericone
