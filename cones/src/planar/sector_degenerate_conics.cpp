// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/planar/sector.h>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "planar/degenerate_conics.h"
#include "planar/planar_frame.h"
#include "planar/sector_parts.h"

namespace vericone {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Of a 3 x 3 matrix h with h(2, 0) = 0, all eigenvalues of which are real: eigenvalues, and eigenvectors in
/// columns. QR steps with shifts, then back substitution (Golub and Van Loan, Matrix Computations, 7.5 and
/// 7.6); Eigen's solver does the same for any matrix, and takes 8 s to compile. Nothing where a pair is
/// complex.
struct RealEigen {
  Vector3d values;
  Matrix3d vectors;
};
std::optional<RealEigen> real_eigen(Matrix3d h) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  constexpr int kMostSteps = 60;
  Matrix3d q = Matrix3d::Identity();
  for (int last = 2, steps = 0; last > 0; ++steps) {
    int first = last;
    while (first > 0 && std::abs(h(first, first - 1)) >
                            kEps * (std::abs(h(first, first)) + std::abs(h(first - 1, first - 1))))
      --first;
    if (first == last) {
      --last;
      continue;
    }
    // Shifted by the eigenvalue of the last two rows that is nearer to their corner.
    const double half = 0.5 * (h(last - 1, last - 1) - h(last, last)),
                 product = h(last - 1, last) * h(last, last - 1), square = half * half + product;
    if (steps == kMostSteps || (last - first == 1 && square < 0)) return std::nullopt;
    const double root = std::copysign(std::sqrt(std::max(0.0, square)), half);
    const double shift = h(last, last) - (half + root == 0 ? 0 : product / (half + root));
    std::array<std::pair<double, double>, 2> turns;
    for (int k = first; k <= last; ++k) h(k, k) -= shift;
    for (int k = first; k < last; ++k) {
      const double length = std::hypot(h(k, k), h(k + 1, k));
      const double c = length > 0 ? h(k, k) / length : 1, s = length > 0 ? h(k + 1, k) / length : 0;
      for (int j = k; j < 3; ++j)
        std::tie(h(k, j), h(k + 1, j)) =
            std::pair(c * h(k, j) + s * h(k + 1, j), c * h(k + 1, j) - s * h(k, j));
      turns[k] = {c, s};
    }
    for (int k = first; k < last; ++k)
      for (Matrix3d* m : {&h, &q})
        for (int i = 0; i < 3; ++i) {
          const auto [c, s] = turns[k];
          std::tie((*m)(i, k), (*m)(i, k + 1)) =
              std::pair(c * (*m)(i, k) + s * (*m)(i, k + 1), c * (*m)(i, k + 1) - s * (*m)(i, k));
        }
    for (int k = first; k <= last; ++k) h(k, k) += shift;
  }
  RealEigen result{h.diagonal(), Matrix3d::Zero()};
  const double least = kEps * h.cwiseAbs().maxCoeff();  // apart of eigenvalues
  for (int k = 0; k < 3; ++k) {
    Vector3d x = Vector3d::Unit(k);
    for (int i = k - 1; i >= 0; --i) {
      for (int j = i + 1; j <= k; ++j) x(i) -= h(i, j) * x(j);
      const double apart = h(i, i) - h(k, k);
      x(i) /= std::abs(apart) > least ? apart : least;
    }
    for (int j = 0; j <= k; ++j) result.vectors.col(k) += x(j) * q.col(j);
  }
  return result;
}

/// The corner of the rectangle as a common point of the two dual conics, by Newton. Where an inner tangent
/// nearly coincides with an outer one (a needle that points at the other body, a body that looks like a
/// point) the pencil has nearly a double member and its eigenvectors lose digits that the tangent itself does
/// not. The line with normal (1, t) passes A's centre at the distance `alpha` and B's at 1 - alpha (both
/// times |n|):
///   alpha^2 = n^T S_A n,  (1 - alpha)^2 = n^T S_B n.
/// Nothing when that does not settle.
std::optional<double> polished_slope(const PlanarFrame& frame, double t, double alpha) {
  const Matrix2d &sa = frame.shape_a, &sb = frame.shape_b;
  double last = 1;
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double beta = 1 - alpha;
    const double miss_a = alpha * alpha - (sa(0, 0) + t * (2 * sa(0, 1) + t * sa(1, 1))),
                 miss_b = beta * beta - (sb(0, 0) + t * (2 * sb(0, 1) + t * sb(1, 1)));
    const double slope_a = sa(0, 1) + t * sa(1, 1), slope_b = sb(0, 1) + t * sb(1, 1);
    const double det = 2 * (slope_a * beta + slope_b * alpha);
    const double step = (beta * miss_a + alpha * miss_b) / det;
    alpha += (slope_a * miss_b - slope_b * miss_a) / det;
    t += step;
    const double relative = std::abs(step / t);
    if (!(relative < 0.5)) return std::nullopt;
    // Quadratic, so the next step would be below rounding; for bodies about to touch rounding ends it
    // earlier.
    if (relative < 1e-8 || (relative < 1e-2 && relative > 0.5 * last))
      return alpha > 0 && alpha < 1 ? std::optional(t) : std::nullopt;
    last = relative;
  }
  return std::nullopt;
}

}  // namespace

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
  // Algorithm 3, line 1, of j c1 with its first two coordinates exchanged: c1(1, 2) is zero.
  Matrix3d pencil;
  pencil << c1(1, 1), c1(1, 0), 0, -c1(0, 1), -c1(0, 0), -c1(0, 2), 0, -c1(2, 0), -c1(2, 2);
  const auto eigen = real_eigen(pencil);
  if (!eigen) return std::nullopt;
  const Vector3d& t = eigen->values;
  Matrix3d u = eigen->vectors;
  u.row(0).swap(u.row(1));

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
      const std::optional<double> slope = polished_slope(frame, line.y() / line.x(), -at_a / line.x());
      if (!slope) return std::nullopt;
      result.normals[found++] = Vector2d(1, *slope);
    }
  if (found != 2) return std::nullopt;
  if (result.normals[0].y() < result.normals[1].y()) std::swap(result.normals[0], result.normals[1]);
  // g is positive at (1, 0), so the two lie on either side of it.
  if (!(result.normals[0].y() > 0 && result.normals[1].y() < 0)) return std::nullopt;
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
