// SPDX-License-Identifier: BSD-3-Clause
//
// The orifice cone: which relative velocities carry an agent through an opening in a thin flat wall. Exact,
// by the ladder of predicates.h; the mathematics is in docs/explanation/predicates/orifice.md.
//
// Laws, for all agents, openings and velocities w (tests/cones/opening/orifice_test.cpp):
//   (1) transit of w == transit of s w for s > 0 a power of two
//   (2) the length and the sign of the opening's normal do not matter
//   (3) a rung that answers agrees with every later rung
//   (4) unchanged by scaling, and by moving, agent and opening together, as long as numbers stay exact
//   (5) at most one of w and -w is not `blocked`
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/sign.h>
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

namespace vericone {

/// A flat circular opening in a plane wall of no thickness, by its normal: other outlines, and circles by
/// axes of their plane, are a PlacedOpening. Lengths in metres. Its rim is the circle about `center` in the
/// plane normal.(x - center) = 0.
struct Orifice {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // of any length but zero, of either sign
  double radius = 1;                                  // positive
};

/// Where the agent is now with regard to the plane of the opening.
enum class WallSide : std::uint8_t {
  clear,     // strictly on one side
  touching,  // on one side, with one point in the plane
  cut,       // the plane cuts the agent
};

/// Whether a relative velocity carries the agent through an opening.
enum class Transit : std::uint8_t {
  passes,   // through the opening, without touching the rim
  grazes,   // through, touching the rim without cutting it
  blocked,  // not through: it hits the rim or the wall, moves away or along the wall, or w = 0
};

[[nodiscard]] const char* to_string(WallSide side);
[[nodiscard]] const char* to_string(Transit transit);

/// An agent (a sphere or any ellipsoid) and an opening, prepared for many velocities.
class OrificeOracle {
 public:
  /// Throws InputError naming "orifice.center[i]", "orifice.normal[i]", "orifice.normal" or "orifice.radius".
  OrificeOracle(const Ellipsoid& agent, const Orifice& orifice);

  /// An opening of any outline, in an infinite wall. The rim is exactly that of opening.h: nothing is
  /// rounded, and of a polygon the edges decide: what touches one, or a vertex, without cutting it `grazes`.
  /// Throws InputError naming "orifice.center[i]", "orifice.axes[i][j]" or "orifice.axes".
  OrificeOracle(const Ellipsoid& agent, PlacedOpening opening);

  [[nodiscard]] const Ellipsoid& agent() const { return agent_; }
  /// What it was made from: one of the two is there. Metres.
  [[nodiscard]] const std::optional<Orifice>& orifice() const { return orifice_; }
  [[nodiscard]] const std::optional<PlacedOpening>& placed() const { return placed_; }
  [[nodiscard]] const Eigen::Vector3d& center() const {
    return orifice_ ? orifice_->center : placed_->center;
  }
  /// Perpendicular to the wall, of any length, no unit; of a PlacedOpening rounded.
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }
  /// Whether the region inside is convex: then so are the directions that pass.
  [[nodiscard]] bool convex() const { return !placed_ || placed_->opening.convex(); }

  /// Exact. An agent that is cut by the plane is already in the opening or in the wall: then transit() is
  /// `blocked` for every velocity. One that touches the plane counts as being on its side of it.
  [[nodiscard]] WallSide side() const { return side_; }

  /// Exact. `w` = v_A - v_B, the velocity of the agent relative to the opening; only its direction counts.
  /// `rung`: where to write the rung that decided. Throws InputError naming "agent_velocity[i]". Linear in
  /// the vertices of a polygon, each edge of which climbs alone: `rung` is the highest that one needed.
  [[nodiscard]] Transit transit(const Eigen::Vector3d& w, Rung* rung = nullptr) const;

  /// First rung: nothing where rounding could matter. Never answers `grazes`. No allocation, no throw.
  [[nodiscard]] std::optional<Transit> triage_transit(const Eigen::Vector3d& w) const noexcept;

  /// Second rung, in intervals. Never answers `grazes`. No allocation, no throw.
  [[nodiscard]] std::optional<Transit> interval_transit(const Eigen::Vector3d& w) const noexcept;

  /// Last rung, in integers. Requires a finite w.
  [[nodiscard]] Transit exact_transit(const Eigen::Vector3d& w) const;

 private:
  struct InIntegers;
  template <typename N>
  struct Seen;

  void prepare(double opening_reach);
  [[nodiscard]] bool polygonal() const { return placed_ && placed_->opening.polygonal(); }
  template <typename N>
  [[nodiscard]] Seen<N> seen_along(const Eigen::Vector3d& w) const noexcept;
  template <typename N>
  [[nodiscard]] std::optional<Transit> certified(const Eigen::Vector3d& w) const noexcept;
  template <typename N, typename Disc>
  [[nodiscard]] std::optional<Transit> through_disc(const Seen<N>& seen, const Disc& disc) const noexcept;
  template <typename N, typename Unsure>
  [[nodiscard]] std::optional<Transit> through_polygon(const Seen<N>& seen, const Unsure& unsure) const;
  [[nodiscard]] std::optional<Transit> climb_by_edges(const Eigen::Vector3d& w, Rung& rung) const;

  Ellipsoid agent_;
  std::optional<Orifice> orifice_;
  std::optional<PlacedOpening> placed_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  std::shared_ptr<const InIntegers> exact_;
  WallSide side_ = WallSide::cut;
  int toward_ = 0;  // sign of normal.c, exact
  bool usable_ = false;
  double scale_ = 1, normal_scale_ = 1;  // powers of two, of lengths and of the normal
  Eigen::Vector2d axis_scale_{1, 1};     // and of the opening's axes
};

/// Tag of OrificeOracle::transit for rung_counts().
struct OrificeTransit;

/// The source's criterion (2.2) for a sphere: |c x w|^2 < (R_B - R_A)^2 |w|^2 and c.w > 0. It takes the
/// opening as if it always faced the velocity, that is as a sphere's great circle perpendicular to w: for an
/// opening tilted against w it says `passes` of velocities that cut the rim
/// (docs/explanation/predicates/orifice.md has the rate; use OrificeOracle for a real opening).
///
/// `center_line` = p_B - p_A from the agent to the centre of the opening; radii in metres, positive. Exact
/// for the numbers given. An agent larger than the opening is `blocked`. Throws InputError naming
/// "center_line[i]", "agent_radius", "opening_radius" or "agent_velocity[i]".
[[nodiscard]] Transit facing_orifice_transit(const Eigen::Vector3d& center_line, double agent_radius,
                                             double opening_radius, const Eigen::Vector3d& w,
                                             Rung* rung = nullptr);

/// Tag of facing_orifice_transit for rung_counts().
struct FacingOrificeTransit;

}  // namespace vericone
