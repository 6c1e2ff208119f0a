// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/convex.h>
#include <array>
#include <optional>
#include <vector>

#include "answers/stretch.h"

namespace vericone::pairs {

/// Two bodies, and the plane between them. A search by points gives a normal that is right to 1e-3, because
/// it looks no farther once the distance is known; at the end of what one plane frees that is too little, as
/// the last part of the way to a rim is a matter of the normal.
class TightPlane {
 public:
  TightPlane(const Convex& agent, const Eigen::Vector3d& agent_at, const Convex& obstacle,
             const Eigen::Vector3d& obstacle_at);

  /// With the agent displaced from `start` to `end`, the best plane that Newton's method finds from a given
  /// one, in doubles: no proof. Where several pieces are nearest, where their planes meet: f(n) is the least
  /// of smooth functions, a quadratic model with linear terms of each is maximised at each step.
  /// Nothing where no plane is found that parts them.
  [[nodiscard]] std::optional<NearestPlane> tightened(NearestPlane plane, const Eigen::Vector3d& start,
                                                      const Eigen::Vector3d& end) const;
  /// The same from several normals, one after the other, first a `known` one, for bodies that are nearly
  /// touching on the way: there a search by points tells nothing.
  [[nodiscard]] std::optional<NearestPlane> found(const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                                                  const std::optional<Eigen::Vector3d>& known) const;

 private:
  struct Option;
  struct Choice;
  struct Way;
  class Model;
  using Options = std::vector<Convex::Piece>;

  double value(const Eigen::Vector3d& n, const Way& way) const;
  std::vector<Choice> choices(const Eigen::Vector3d& n, const Way& way) const;

  Options agent_, obstacle_;
  double margin_;
  Eigen::Vector3d between_;            // of points amid both
  std::vector<Eigen::Vector3d> axes_;  // of flat pieces: there f has a tip
};

}  // namespace vericone::pairs
