// SPDX-License-Identifier: BSD-3-Clause
//
// Collision cones in the plane: the sector between the inner common tangents of two ellipses.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/ellipsoid.h>
#include <array>
#include <optional>

namespace vericone {

/// One side of a sector: an inner common tangent of A and B.
struct SectorEdge {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // unit, along the tangent from A towards B
  Eigen::Vector2d normal =
      Eigen::Vector2d::Zero();  // unit, into the sector; A on its low side, B on the high
  Eigen::Vector2d point_on_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d point_on_b = Eigen::Vector2d::Zero();
};

/// The set of relative velocities w = v_A - v_B that bring two bodies in the plane together (source, 5.1).
///
///            left
///          \      /            \  the bodies lie in opposite sectors of
///           \  B /              > opening psi about the crossing of the
///            \  /              /  two inner tangents
///             \/
///             /\  psi
///            / A\              theta_b points from A to B
///
/// For touching bodies the tangents coincide: psi = pi, theta_b is the direction of the common normal from A
/// to B, both edges lie in the common tangent. For overlapping bodies every velocity collides: psi = 2 pi,
/// theta_b is the direction of the line of centres (0 for concentric ones), and there are no edges.
struct Sector {
  Relation relation = Relation::overlapping;
  double psi = 0;      // opening, radians
  double theta_b = 0;  // direction of the bisector, radians in (-pi, pi]
  SectorEdge left;     // counter-clockwise end, theta_b + psi/2
  SectorEdge right;    // clockwise end, theta_b - psi/2
};

/// The sector by support functions: the normal n of an inner tangent satisfies
/// n.c = sqrt(n^T S_A n) + sqrt(n^T S_B n). Newton from a separating normal, which cannot jump to another
/// root because the difference is concave in n, then a refinement whose residual is evaluated with 31 digits:
/// psi and the edges are right to a few units in the last place for thin, distant and nearly touching bodies
/// alike (docs/measured/planar-accuracy.md). Bodies too close for double precision to tell apart are decided
/// exactly. Cost: below a microsecond, no allocation while the first rung of the predicates decides.
[[nodiscard]] Sector sector_by_support(const Ellipse& a, const Ellipse& b);

/// The sector by degenerate conics (source, 5.2.1 and Algorithm 3): eigenvectors of the pencil of the two
/// dual conics, the common tangents as the corners of a rectangle in their basis, the inner ones by the sides
/// on which the centres lie. The pair is first mapped by an affine map that makes both bodies and their
/// distance comparable, so proportional, concentric-part, thin and distant pairs are ordinary ones, and each
/// tangent found is polished as a common point of the dual conics. Double precision throughout: psi is right
/// to 1e-12, except for bodies about to touch, to eps / sqrt(gap) (docs/measured/planar-accuracy.md). Nothing
/// is returned where rounding decides, for bodies whose gap is a few roundings. Cost: a few microseconds.
[[nodiscard]] std::optional<Sector> sector_by_degenerate_conics(const Ellipse& a, const Ellipse& b);

/// Velocities with which the bodies move and turn, for rates.
struct PlanarMotion {
  Eigen::Vector2d v_a = Eigen::Vector2d::Zero(), v_b = Eigen::Vector2d::Zero();  // m/s
  double omega_a = 0, omega_b = 0;  // counter-clockwise turning rates, rad/s
  // Rates of the shape matrices beyond turning (bodies that change their shape), m^2/s.
  Eigen::Matrix2d shape_rate_a = Eigen::Matrix2d::Zero(), shape_rate_b = Eigen::Matrix2d::Zero();
};

struct SectorRates {
  double psi = 0, theta_b = 0;  // rad/s
};

/// Time derivatives of psi and theta_b in closed form. The source obtains them numerically (5.3); implicit
/// differentiation of the tangency condition gives them exactly (docs/explanation/theory.md, 1).
/// `sector`: of disjoint bodies, computed from the same a and b. Throws InputError naming "sector.relation"
/// where it is that of bodies that are not, which has no edges that turn, or a default-constructed one.
[[nodiscard]] SectorRates sector_rates(const Sector& sector, const Ellipse& a, const Ellipse& b,
                                       const PlanarMotion& motion);

/// The source's y, (5.1) and (5.10): V_theta_hat^2 / V^2 - sin^2(psi / 2), with the relative velocity
/// V = V_B - V_A = -w resolved along (V_r_hat) and across (V_theta_hat) the bisector. The pair is on a
/// collision course iff y < 0 and V_r_hat < 0; y = 0 on the boundary. For disjoint bodies, psi <= pi: the
/// source's y cannot tell a sector of more than half a turn, and is never negative for psi = 2 pi.
struct ConeFunction {
  double y = 0;
  double v_r_hat = 0;      // m/s, negative when approaching
  double v_theta_hat = 0;  // m/s

  [[nodiscard]] bool colliding() const { return y < 0 && v_r_hat < 0; }
};

/// From velocities in the plane; (5.9) in its corrected form (errata, 3.5). V = 0 gives y = -sin^2(psi / 2)
/// with v_r_hat = 0, which is not colliding.
[[nodiscard]] ConeFunction cone_function(double psi, double theta_b, const Eigen::Vector2d& v_a,
                                         const Eigen::Vector2d& v_b);

// Exact membership of a velocity in the planar sector of two ellipses.

/// Two ellipses prepared for many velocities: ConeOracle in the plane. Its laws hold here as well.
///
/// With n perpendicular to w the line of motion misses iff |n.c| > rho_A(n) + rho_B(n). Without square roots:
/// G = (n.c)^2 - q_A - q_B > 0 and F = G^2 - 4 q_A q_B > 0, q = n^T S n; it grazes iff G > 0 and F = 0. F has
/// degree 4 in w, 4 in c and 2 in the shapes. Ahead or behind is told by a normal that separates the bodies.
class SectorOracle {
 public:
  SectorOracle(const Ellipse& a, const Ellipse& b);

  [[nodiscard]] const Ellipse& a() const { return a_; }
  [[nodiscard]] const Ellipse& b() const { return b_; }
  [[nodiscard]] Relation relation() const { return relation_; }

  /// Exact. `w` = v_A - v_B. Bodies that are not disjoint, w = 0 and velocities that are not finite as in
  /// ConeOracle. Cost: 13 ns where the first rung decides (6 ns without a bound), 45 ns in the second, 2 us
  /// in the last.
  [[nodiscard]] Membership membership(const Eigen::Vector2d& w, Rung* rung = nullptr) const;
  [[nodiscard]] Membership membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b,
                                      Rung* rung = nullptr) const;

  [[nodiscard]] std::optional<Membership> triage_membership(const Eigen::Vector2d& w) const noexcept;
  [[nodiscard]] std::optional<Membership> interval_membership(const Eigen::Vector2d& v_a,
                                                              const Eigen::Vector2d& v_b) const noexcept;
  [[nodiscard]] std::optional<Membership> interval_membership(
      const std::array<Interval, 2>& w) const noexcept;
  [[nodiscard]] Membership exact_membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b) const;

  /// Floating point without a bound, for comparison.
  [[nodiscard]] Membership naive_membership(const Eigen::Vector2d& w) const noexcept;

  [[nodiscard]] Verdict verdict(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b,
                                Rung* rung = nullptr) const;

  /// Separates the bodies strictly where certified; see ConeOracle.
  [[nodiscard]] const Eigen::Vector2d& separating_normal() const { return normal_; }
  [[nodiscard]] bool normal_certified() const { return normal_certified_; }

 private:
  Ellipse a_, b_;
  Relation relation_;
  Eigen::Vector2d normal_ = Eigen::Vector2d::Zero();
  bool normal_certified_ = false;
  // Lengths divided by a power of two so that |c| is near one; each number of the first rung with a bound of
  // the terms it was summed from; xx, xy, yy.
  double shape_a_[3][2] = {}, shape_b_[3][2] = {}, c_[2][2] = {};
  Interval enclosed_a_[3], enclosed_b_[3], enclosed_c_[2];
  bool usable_ = false;
};

/// Tag of SectorOracle::membership for rung_counts().
struct SectorMembership;

}  // namespace vericone
