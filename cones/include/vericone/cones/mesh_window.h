// SPDX-License-Identifier: BSD-3-Clause
//
// A window of a mesh, named by its rim: who passes it, its cone, and a flat opening that stands for it.
#pragma once

#include <vericone/cones/map/cone_map.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/cones/pair.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone {

/// A mesh that stands somewhere, and one of its boundary_loops(). The window is the closed loop; the surface
/// that counts crossings of it is the fan of triangles about the mean of its points. Which surface spans the
/// loop hardly matters: two of them close up to a body, and a way that starts and ends outside of that body
/// crosses both the same number of times, as signs count.
class MeshWindow {
 public:
  /// `triangles` of indices into `points`, metres, in the body's frame; `loop`: which of its boundary loops,
  /// 0 the longest. Throws InputError naming "points...", "triangles...", "pose..." or "loop" (no such one).
  MeshWindow(std::vector<Eigen::Vector3d> points, std::vector<Assembly::Triangle> triangles, std::size_t loop,
             const Pose& pose = {});

  /// The whole mesh, this window's wall and all else.
  [[nodiscard]] const Placed& mesh() const { return mesh_; }
  /// In the world (m), in order; the last is joined to the first.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& rim() const { return rim_; }

  /// How often the straight way from one point to another crosses the fan, counted with signs: +1 where it
  /// comes out on the side from which the rim runs counterclockwise, -1 where it goes in. Rounded: for ways
  /// that keep off the rim, and ends off the fan, by more than 1e-12 of their distances.
  [[nodiscard]] int crossings(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  /// Of the ray from a point along w.
  [[nodiscard]] int crossings_along(const Eigen::Vector3d& from, const Eigen::Vector3d& w) const;

  /// Whether w = v_agent - v_mesh, which does not change, carries the agent through: it never touches the
  /// mesh, by the verdict of their Pair, and the ray from its middle crosses the fan, signs counted. `grazes`
  /// where it does but touches. What touches the mesh elsewhere, before or after, is `blocked`. Nothing where
  /// the pair does not decide. As certain as the pair's verdict is (Pair::guarantee()).
  [[nodiscard]] std::optional<Transit> transit(const Pair& agent_and_mesh, const Eigen::Vector3d& w) const;
  /// Prepares a Pair each time.
  [[nodiscard]] std::optional<Transit> transit(const Placed& agent, const Eigen::Vector3d& w) const;

  /// The orifice cone: the connected safe region, of the cone map of agent and mesh, around a direction that
  /// passes. The map is drawn anew: seconds. Nothing where the direction does not pass at this resolution.
  struct Cone {
    ConeMap map;
    ConeMapRegion region;
  };
  [[nodiscard]] std::optional<Cone> cone(const Placed& agent, const Eigen::Vector3d& through,
                                         const ConeMapOptions& options = {}) const;

  /// A flat opening about where the window is, for laws: in the plane of least squares of the rim, each part
  /// of the rim as its length; the rim projected onto it if that is a simple polygon, else a convex polygon
  /// about the rim's mean that no part of the projected rim enters. Its normal is on the side from which the
  /// rim runs counterclockwise. Throws InputError naming "loop" where the projected rim passes through its
  /// mean. What passes this need not pass the window.
  [[nodiscard]] PlacedOpening flat() const;

 private:
  Placed mesh_;
  std::vector<Eigen::Vector3d> rim_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
};

}  // namespace vericone
