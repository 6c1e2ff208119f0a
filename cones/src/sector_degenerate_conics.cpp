// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/sector.h>
#include <Eigen/LU>
#include <cmath>

#include "degenerate_conics.h"
#include "planar_frame.h"
#include "sector_parts.h"

namespace vericone {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Eigenvalues `values` and orthonormal eigenvectors (columns of `vectors`) of a symmetric matrix, by Jacobi
/// rotations. A rotation is skipped only where the entry is small beside both of its diagonal neighbours, so
/// small eigenvalues of graded matrices keep their digits; a solver that reduces to tridiagonal form first
/// loses them.
void symmetric_eigensystem(Matrix3d m, Vector3d& values, Matrix3d& vectors) {
  vectors.setIdentity();
  for (int sweep = 0; sweep < 20; ++sweep) {
    bool rotated = false;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const double off = m(p, q);
        if (!(std::abs(off) > 0x1p-54 * std::sqrt(std::abs(m(p, p))) * std::sqrt(std::abs(m(q, q))))) continue;
        rotated = true;
        const double zeta = (m(q, q) - m(p, p)) / (2 * off);
        const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
        const double c = 1 / std::sqrt(1 + t * t), s = c * t;
        const int r = 3 - p - q;
        const double rp = m(r, p), rq = m(r, q);
        m(p, p) -= t * off;
        m(q, q) += t * off;
        m(p, q) = m(q, p) = 0;
        m(r, p) = m(p, r) = c * rp - s * rq;
        m(r, q) = m(q, r) = s * rp + c * rq;
        const Vector3d vp = vectors.col(p);
        vectors.col(p) = c * vp - s * vectors.col(q);
        vectors.col(q) = s * vp + c * vectors.col(q);
      }
    if (!rotated) break;
  }
  values = m.diagonal();
}

}  // namespace

// Algorithm 3 takes the eigenvectors of C_2^{-1} C_1, the duals of the two conics: in the basis of the lines U
// through the vertices of the common self-polar triangle both are diagonal, and the common tangents are the
// corners (+-x, +-y, 1). C_2^{-1} C_1 is not symmetric, and inverting the dual of a thin or distant body
// loses all digits. The same basis comes from the primal pencil: for disjoint bodies it has a positive
// definite member, P = M_A (1 - mu) + M_B mu (the S-lemma), which the contact function supplies, and
// P^{-1/2} M_A P^{-1/2} = V diag(w) V^T is an ordinary symmetric problem with real answers.
//
// In the frame of the contact function, with the origin at the minimum y of the form P and r = (1 - mu) / mu,
//   P = diag(p_1, p_2, f - 1),  p_i = (1 + r s_i^2) / ((1 + r) s_i^2),  y_i = c_i / (1 + r s_i^2),
//   M_A = [I, y; y^T, f - 1]    (|y|^2 = f at the maximiser).
// A line u = P^{1/2} V l has the dual forms sum l_i^2 / w_i for A and sum l_i^2 / v_i for B, where
// (1 - mu) w_i + mu v_i = 1. Both vanish for l_i^2 = (w_k - w_j) w_i v_i, (i, j, k) cyclic: the corners.
std::optional<InnerTangents> inner_tangents_by_degenerate_conics(const PlanarFrame& frame,
                                                                 const ContactFrame<2>& contact) {
  const double r = contact.ratio, excess = contact.contact - 1;
  if (!(excess > 0)) return std::nullopt;
  const Vector2d grown = Vector2d::Ones() + r * contact.sigma.cwiseAbs2();
  const Vector2d y = contact.center.cwiseQuotient(grown);
  const Vector2d p_root = (grown / (1 + r)).cwiseSqrt().cwiseQuotient(contact.sigma);
  const double last_root = std::sqrt(excess);
  Matrix3d m;
  m << 1 / (p_root(0) * p_root(0)), 0, y(0) / (p_root(0) * last_root),  //
      0, 1 / (p_root(1) * p_root(1)), y(1) / (p_root(1) * last_root),   //
      y(0) / (p_root(0) * last_root), y(1) / (p_root(1) * last_root), 1;
  Vector3d w;
  Matrix3d basis;
  symmetric_eigensystem(m, w, basis);  // Algorithm 3, line 1
  basis = Vector3d(p_root(0), p_root(1), last_root).asDiagonal() * basis;

  // Lines 2-3.
  Vector3d l;
  for (int i = 0; i < 3; ++i) {
    const double wj = w((i + 1) % 3), wk = w((i + 2) % 3);
    l(i) = std::sqrt(std::abs((wk - wj) * w(i) * (1 + r - r * w(i))));
  }
  // Lines 4-9: corners of the rectangle; inner tangents have the centres on opposite sides.
  InnerTangents result;
  int found = 0;
  for (const double sign_x : {1.0, -1.0})
    for (const double sign_y : {1.0, -1.0}) {
      const Vector3d u = basis * Vector3d(sign_x * l(0), sign_y * l(1), l(2));
      const Vector2d n = u.head<2>();
      const double at_a = u(2) - n.dot(y), at_b = at_a + n.dot(contact.center);
      if (!(at_a * at_b < 0)) continue;
      if (found == 2) return std::nullopt;
      const double along = std::abs(n.dot(contact.center));
      if (!(std::abs(along - n.norm() - n.cwiseProduct(contact.sigma).norm()) <= 1e-6 * along))
        return std::nullopt;
      result.normals[found++] = frame.normal_from_contact * (at_b > 0 ? n : Vector2d(-n));
    }
  if (found != 2) return std::nullopt;
  // (1, t) with t > 0 first.
  if (result.normals[0].y() < result.normals[1].y()) std::swap(result.normals[0], result.normals[1]);
  return result;
}

std::optional<Sector> sector_by_degenerate_conics(const Ellipse& a, const Ellipse& b) {
  const Relation rel = relation<2>(a, b);
  if (rel == Relation::overlapping) return overlapping_sector(a, b);
  const ContactFrame<2> contact(a, b);
  if (rel == Relation::touching) return touching_sector(a, b, contact.separating_normal());
  const PlanarFrame frame(contact);
  const auto tangents = inner_tangents_by_degenerate_conics(frame, contact);
  if (!tangents) return std::nullopt;
  const bool reflected = frame.normal_to_space.determinant() < 0;
  const Vector2d right = tangents->normals[reflected ? 1 : 0], left = tangents->normals[reflected ? 0 : 1];
  const Vector2d right_normal = frame.normal_to_space * right, left_normal = frame.normal_to_space * left;
  Sector sector;
  sector.relation = Relation::disjoint;
  // The cross product of the mapped normals is that in the frame times the determinant: no cancellation when
  // the bodies are far apart.
  const double cross =
      std::abs(frame.normal_to_space.determinant() * (left.x() * right.y() - left.y() * right.x()));
  sector.psi = std::atan2(cross, -left_normal.dot(right_normal));
  sector.left = make_edge(a, b, left_normal, -1);
  sector.right = make_edge(a, b, right_normal, 1);
  sector.theta_b = bisector_angle(sector.right.direction, sector.psi);
  return sector;
}

}  // namespace vericone
