// SPDX-License-Identifier: BSD-3-Clause
//
// What an oracle of hulls reads: the points, once as they were given and once centred and scaled for the
// rungs in floating point.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/hull_body.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone {

struct Stretch;

/// A point b_j - a_i of the obstacle's points minus the agent's. Where one of the bodies is an ellipsoid its
/// centre is its only point.
struct HullPair {
  std::uint32_t obstacle = 0, agent = 0;
};

/// One body's points relative to the reference point, in units of the scene's scale: x = fl(v + at - r) 2^-e.
struct CentredPoints {
  std::vector<double> x, y, z;
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();  // largest |coordinate| along each axis

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// K = { b_j - a_i + e : e in E }, E the ellipsoid centred at 0 or 0 itself.
struct HullScene {
  /// `..._at`: added to each of the points, without rounding.
  HullScene(std::vector<Eigen::Vector3d> agent_points, const Eigen::Vector3d& agent_at,
            std::vector<Eigen::Vector3d> obstacle_points, const Eigen::Vector3d& obstacle_at,
            const Eigen::Vector3d& reference, const Ellipsoid* round);

  /// All that the agent meets on a stretch of its way, which ends somewhere: its points, once at the first
  /// place and once at the last. For the last rung alone: not usable.
  HullScene(const HullScene& scene, const Stretch& stretch);

  std::vector<Eigen::Vector3d> agent, obstacle;  // as given
  std::optional<Ellipsoid> ellipsoid;

  bool usable = false;  // whether the following is within the range of doubles
  int exponent = 0;     // of the scale: lengths are in units of 2^exponent metres
  CentredPoints centred_agent, centred_obstacle;
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();                                    // of both
  Eigen::Matrix3d factor = Eigen::Matrix3d::Zero(), shape = Eigen::Matrix3d::Zero();  // scaled; of E
  Eigen::Matrix3d to_ball = Eigen::Matrix3d::Identity();  // about the inverse of factor
  Interval enclosed_shape[6];                             // xx, xy, xz, yy, yz, zz
  double shape_magnitude[6] = {};                         // sums of absolute values of terms

  HullPair start;  // where searches begin: near the origin

  // Integers on a grid of 2^grid.
  int grid = 0;
  exact::IntegerMatrix<3> exact_shape;
  exact::IntegerVector<3> exact_agent_at, exact_obstacle_at;
  exact::IntegerVector<3>
      exact_agent_end;  // where the second half of the agent's points stands, on a stretch
  bool stretched = false;

  // A normal that separates exactly, for disjoint bodies.
  exact::IntegerVector<3> exact_normal{0, 0, 0};

  static constexpr int kPacked[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

  double radius() const { return ellipsoid ? 1 : 0; }  // of E in the coordinates of to_ball

  Eigen::Vector3d difference(HullPair p) const {
    return centred_obstacle[p.obstacle] - centred_agent[p.agent];
  }
  exact::IntegerVector<3> exact_agent(std::size_t i) const {
    return on_grid(agent[i], stretched && i >= agent.size() / 2 ? exact_agent_end : exact_agent_at);
  }
  exact::IntegerVector<3> exact_obstacle(std::size_t i) const {
    return on_grid(obstacle[i], exact_obstacle_at);
  }

 private:
  exact::IntegerVector<3> on_grid(const Eigen::Vector3d& v, const exact::IntegerVector<3>& at) const {
    return {at[0] + exact::on_grid(v.x(), grid), at[1] + exact::on_grid(v.y(), grid),
            at[2] + exact::on_grid(v.z(), grid)};
  }
};

class HullOracle;
const HullScene& scene_of(const HullOracle& oracle);

/// The pair with the least n.(b_j - a_i), and that value; rounded. Off by at most support_slack().
struct HullSupport {
  HullPair pair;
  double obstacle_value = 0, agent_value = 0;
  double value() const { return obstacle_value - agent_value; }
};
HullSupport least_support(const HullScene& scene, const Eigen::Vector3d& n) noexcept;

/// How far n.x, as least_support() computes it for a point of either body, and the difference of two such are
/// from the exact n.(b - a) / scale: one rounding for the centred point, one for each product, two sums, one
/// difference, and the bound itself; the last term covers underflow.
inline double support_slack(const HullScene& scene, const Eigen::Vector3d& n) {
  return 8 * 0x1p-53 * n.cwiseAbs().dot(scene.reach) + 0x1p-1000;
}

}  // namespace vericone
