// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/sector.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "degenerate_conics.h"
#include "planar_frame.h"
#include "sector_parts.h"

namespace vericone {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Dual conic of an ellipse with centre p and shape S: the line n.x = d touches it iff (d - n.p)^2 = n^T S n,
// i.e. l^T C l = 0 for l = (n, -d) and C = [S - p p^T, -p; -p^T, -1].
//
// Algorithm 3 takes the eigenvectors of C_2^{-1} C_1: lines in whose basis every member of the pencil is
// diagonal. C_2 is nearly singular for thin and for distant bodies, so the inverse is taken of another member
// instead, which has the same eigenvectors: C = C_1 / lambda + C_2 / (1 - lambda) at the maximiser of the
// contact function. With the origin between the centres so that A is at (-lambda, 0) and B at (1 - lambda,
// 0),
//   C = [S_K - e_1 e_1^T, 0; 0, -1 / (lambda (1 - lambda))],   S_K = diag(1 / f, 1),
// which is diagonal, and a scaling of the coordinates makes it J = diag(-1, 1, -1).
std::optional<InnerTangents> inner_tangents_by_degenerate_conics(const PlanarFrame& frame,
                                                                 const ContactFrame<2>& contact) {
  if (!(contact.contact > 1)) return std::nullopt;
  const double lambda = contact.ratio / (1 + contact.ratio), one_minus_lambda = 1 / (1 + contact.ratio);
  const Vector3d scale(1 / std::sqrt((contact.contact - 1) / contact.contact), 1,
                       std::sqrt(lambda * one_minus_lambda));
  const Matrix2d s = frame.shape_a / lambda;
  Matrix3d c1;
  c1 << s(0, 0) - lambda, s(0, 1), 1, s(0, 1), s(1, 1), 0, 1, 0, -1 / lambda;
  c1 = scale.asDiagonal() * c1 * scale.asDiagonal();
  const Vector3d j(-1, 1, -1);
  const Eigen::EigenSolver<Matrix3d> solver(j.asDiagonal() * c1);  // Algorithm 3, line 1
  if (solver.info() != Eigen::Success) return std::nullopt;
  const auto& values = solver.eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(values(i).imag()) <= 1e-12 * largest)) return std::nullopt;
  const Vector3d t = values.real();
  Matrix3d u = solver.pseudoEigenvectors();

  // Lines 2-3: in the basis U the members are diag(g_i) and diag(t_i g_i); both vanish at the corners
  // l_i^2 = g_j g_k (t_j - t_k), (i, j, k) cyclic.
  Vector3d g, l;
  for (int i = 0; i < 3; ++i) g(i) = u.col(i).dot(j.cwiseProduct(u.col(i)));
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    l(i) = std::sqrt(std::abs(g(i1) * g(i2) * (t(i1) - t(i2))));
  }
  u = scale.asDiagonal() * u;

  // Lines 4-9: corners of the rectangle; inner tangents have the centres on opposite sides.
  InnerTangents result;
  int found = 0;
  for (const double sign_x : {1.0, -1.0})
    for (const double sign_y : {1.0, -1.0}) {
      const Vector3d line = u * Vector3d(sign_x * l(0), sign_y * l(1), l(2));
      const double at_a = -lambda * line.x() + line.z(), at_b = one_minus_lambda * line.x() + line.z();
      if (!(at_a * at_b < 0)) continue;
      if (found == 2) return std::nullopt;
      const Vector2d n = line.x() > 0 ? Vector2d(line.head<2>()) : Vector2d(-line.head<2>());
      const double miss = n.x() - std::sqrt(n.dot(frame.shape_a * n)) - std::sqrt(n.dot(frame.shape_b * n));
      if (!(std::abs(miss) <= 1e-6 * n.x())) return std::nullopt;
      result.normals[found++] = n;
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
