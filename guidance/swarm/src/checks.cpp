// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <cmath>
#include <string>
#include <utility>

#include "state.h"

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

[[noreturn]] void refuse(const std::string& field, double value, const char* requirement) {
  throw InputError(field, to_text(value), requirement);
}

void check(const Solid& body, const std::string& name) {
  for (int k = 0; k < 3; ++k)
    if (!(body.half(k) > 0) || body.half(k) > kFarthest || std::isnan(body.half(k)))
      refuse(name + ".half[" + std::to_string(k) + "]", body.half(k), "positive, at most 1e5 (m)");
  if (!((body.rotation.transpose() * body.rotation - Eigen::Matrix3d::Identity()).norm() < 1e-12))
    throw InputError(name + ".rotation", "another matrix", "orthonormal to 1e-12");
  if (!(body.rotation.determinant() > 0))
    throw InputError(name + ".rotation", "a reflection", "a rotation, of determinant 1");
}

void check(const Vector3d& x, const std::string& name) {
  if (!x.allFinite() || x.lpNorm<Eigen::Infinity>() > kFarthest)
    throw InputError(name, to_text(x.x()) + ", " + to_text(x.y()) + ", " + to_text(x.z()),
                     "within 1e5 m (m/s)");
}

}  // namespace

void check(const Agent& agent, const std::string& name) {
  check(agent.body, name + ".body");
  if (agent.body.box) throw InputError(name + ".body.box", "true", "false: agents are ellipsoids");
  check(agent.position, name + ".position");
  check(agent.velocity, name + ".velocity");
  if (agent.goals.empty()) throw InputError(name + ".goals", "none", "one or more");
  for (std::size_t k = 0; k < agent.goals.size(); ++k)
    check(agent.goals[k], name + ".goals[" + std::to_string(k) + "]");
  if (!(agent.share >= 0 && agent.share <= 1)) refuse(name + ".share", agent.share, "0 to 1");
  for (const auto& [field, value] :
       {std::pair(".wished", agent.wished), {".fastest", agent.fastest}, {".most", agent.most}})
    if (!(value > 0) || !std::isfinite(value)) refuse(name + field, value, "a positive finite number");
  if (!(agent.turning >= 0) || !std::isfinite(agent.turning))
    refuse(name + ".turning", agent.turning, "0 or a positive finite number (rad/s)");
  if (!(agent.fastest * agent.fastest <= 2 * kFarthest * agent.most))
    refuse(name + ".most", agent.most, "enough to stop within 1e5 m from `fastest`");
  if (!(agent.wished <= agent.fastest)) refuse(name + ".wished", agent.wished, "at most `fastest`");
}

void check(const Obstacle& obstacle, const std::string& name) {
  check(obstacle.body, name + ".body");
  check(obstacle.position, name + ".position");
}

void check(const SwarmOptions& options) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0) || !std::isfinite(value)) refuse(name, value, "a positive finite number");
  };
  positive(options.step, "step");
  positive(options.horizon, "horizon");
  positive(options.box_horizon, "box_horizon");
  positive(options.sight, "sight");
  if (!(options.lost >= 0 && options.lost <= 1)) refuse("lost", options.lost, "0 to 1");
  if (options.neighbours == 0) throw InputError("neighbours", "0", "1 or more");
}

}  // namespace vericone::swarm
