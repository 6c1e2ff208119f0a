// SPDX-License-Identifier: GPL-3.0-or-later
//
// What doubles say of a piece without doubt, so that exact arithmetic is left the rest.
#pragma once

#include <vericone/internal/verify/assembly/truth.h>

#include <optional>
#include <vector>

namespace vericone::verify {

/// Distances in doubles between the agent's centre, moved, and pieces. Answers where they are away from the
/// reach by more than 1e-6 of the lengths involved, in the coordinates that make the agent a unit ball where
/// it is an ellipsoid (times its axis ratio).
class Nearness {
 public:
  Nearness() = default;
  Nearness(const Ellipsoid& agent, const TruePieces& pieces);
  Nearness(const HullBody& agent, const TruePieces& pieces);

  /// Never `on`.
  std::optional<Membership> decide(std::size_t piece, const Motion& motion, double margin) const;

 private:
  struct Piece {
    Eigen::Vector3d center;  // of a ball about it
    double radius;
    std::vector<Eigen::Vector3d> shape;  // in the agent's coordinates: a point, a triangle, else empty
    std::optional<Box> box;              // piece and agent together, where they make a box, rounded
  };
  void add(const TruePieces& pieces);
  std::optional<Membership> by_distance(const Piece& piece, const Motion& motion, double margin) const;

  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();  // of a ball about the agent
  double reach_ = 0;                                  // its radius and that of the pieces
  double size_ = 0;                                   // largest coordinate
  std::optional<Box> agent_box_;                      // where the agent is a box
  bool has_map_ = false;
  Eigen::Matrix3d map_ = Eigen::Matrix3d::Identity();  // to the agent's coordinates
  double unit_ = 0;                                    // the reach in them, without a margin
  double spread_ = 1;                                  // axis ratio
  double scale_ = 1;                                   // what a margin is in them; 0 where it has no meaning
  std::vector<Piece> pieces_;
};

}  // namespace vericone::verify
