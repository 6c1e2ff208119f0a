// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/sector.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "degenerate_conics.h"
#include "planar_frame.h"
#include "sector_parts.h"

namespace vericone {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

std::optional<InnerTangents> inner_tangents_by_degenerate_conics(const Eigen::Matrix2d& shape_a,
                                                                 const Eigen::Matrix2d& shape_b) {
  // Dual conic of an ellipse with centre p and shape S: the line n.x = d touches it iff (d - n.p)^2 = n^T S
  // n, i.e. l^T C l = 0 for l = (n, -d) and C = [S - p p^T, -p; -p^T, -1]. Centres at (-1/2, 0) and (1/2, 0).
  const auto dual = [](const Eigen::Matrix2d& s, double x) {
    Matrix3d c;
    c << s(0, 0) - x * x, s(0, 1), -x, s(0, 1), s(1, 1), 0, -x, 0, -1;
    return c;
  };
  const Matrix3d c1 = dual(shape_a, -0.5), c2 = dual(shape_b, 0.5);
  const Eigen::EigenSolver<Matrix3d> solver(c2.inverse() * c1);  // Algorithm 3, line 1
  if (solver.info() != Eigen::Success) return std::nullopt;
  const auto& values = solver.eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(values(i).imag()) <= 1e-12 * largest)) return std::nullopt;
  const Matrix3d u = solver.pseudoEigenvectors();

  // Lines 2-3: in the basis U every member of the pencil is diagonal.
  Vector3d d1, d2;
  for (int i = 0; i < 3; ++i) {
    d1(i) = u.col(i).dot(c1 * u.col(i));
    d2(i) = u.col(i).dot(c2 * u.col(i));
  }
  const double t1 = values(0).real(), t2 = values(1).real();
  const double x2 = -(d1(2) - t2 * d2(2)) / (d1(0) - t2 * d2(0)),
               y2 = -(d1(2) - t1 * d2(2)) / (d1(1) - t1 * d2(1));
  if (!(x2 > 0) || !(y2 > 0)) return std::nullopt;
  const double x = std::sqrt(x2), y = std::sqrt(y2);

  // Lines 4-9: corners of the rectangle; inner tangents have the centres on opposite sides.
  InnerTangents result;
  int found = 0;
  const double xs[] = {x, -x, -x, x}, ys[] = {y, -y, y, -y};
  for (int i = 0; i < 4; ++i) {
    const Vector3d l = u * Vector3d(xs[i], ys[i], 1);
    const double at_a = -0.5 * l.x() + l.z(), at_b = 0.5 * l.x() + l.z();
    if (!(at_a * at_b < 0)) continue;
    if (found == 2) return std::nullopt;
    result.normals[found++] = at_b > 0 ? l.head<2>() : Vector2d(-l.head<2>());
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
  const auto tangents = inner_tangents_by_degenerate_conics(frame.shape_a, frame.shape_b);
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
