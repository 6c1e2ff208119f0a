// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/exact_cone.h>

#include <vericone/cones/contact_frame.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "azimuth_nodes.h"

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The pair in coordinates where both bodies are axis-aligned and K lies in the unit ball about (0,0,L)
/// turned onto `center`: A has the squared semi-axes alpha, B beta.
class Silhouette {
 public:
  explicit Silhouette(const ContactFrame<3>& contact) {
    const Vector3d shape = contact.bounding_shape(), scale = shape.cwiseSqrt();
    center_ = contact.center.cwiseQuotient(scale);
    alpha_ = shape.cwiseInverse();
    beta_ = contact.sigma.cwiseAbs2().cwiseQuotient(shape);
    to_space_ = contact.to_space * scale.asDiagonal();
    normal_to_space_ = contact.to_frame.transpose() * scale.cwiseInverse().asDiagonal();
    const AxisFrame frame(center_);
    // A map that reflects would turn the curve clockwise in space.
    plane_ << (to_space_.determinant() > 0 ? 1 : -1) * frame.e1, frame.e2;
    nodes_ = AzimuthNodes(plane_.transpose() * alpha_.asDiagonal() * plane_,
                          plane_.transpose() * beta_.asDiagonal() * plane_);
    const double length2 = center_.squaredNorm();
    base_ = center_ / length2;
    start_ = std::sqrt(std::max(0.0, 1 - 1 / length2));
    radius_ = previous_ = start_;
  }

  struct Point {
    Vector3d normal, contact;  // in space, not normalised
    Vector3d turning;          // contact x d contact / ds, in space
  };

  /// Sample k of `count`, in order. Normals are base + radius e, in the plane n.center = 1, where
  /// g = 1 - rho_A - rho_B is concave along each ray with its maximum at the base (there the gradient is
  /// along the centre line), so Newton converges from any start beyond it.
  Point at(int k, int count) {
    const AzimuthNodes::Node node = nodes_.at(k, count);
    const Vector3d e = plane_ * node.e;
    const Vector3d e_t = plane_ * Eigen::Vector2d(-node.e.y(), node.e.x());
    // Cubic through the last two samples and their derivatives.
    const double ds = 2 * std::numbers::pi / count;
    const double guess =
        k < 2 ? radius_ : 5 * previous_ - 4 * radius_ + ds * (4 * radius_rate_ + 2 * previous_rate_);
    double radius = std::clamp(guess, 0.5 * radius_ + 0.5 * start_, 2 * radius_);
    Vector3d n, gradient_a, gradient_b;
    double ra = 0, rb = 0;
    const auto evaluate = [&] {
      n = base_ + radius * e;
      gradient_a = alpha_.cwiseProduct(n);
      gradient_b = beta_.cwiseProduct(n);
      ra = std::sqrt(n.dot(gradient_a));
      rb = std::sqrt(n.dot(gradient_b));
      gradient_a *= 1 / ra;
      gradient_b *= 1 / rb;
    };
    evaluate();
    for (int iteration = 0; iteration < 50; ++iteration) {
      const double step = (1 - ra - rb) / (gradient_a + gradient_b).dot(e);
      if (!std::isfinite(step)) break;
      radius = std::max(radius + step, start_);
      evaluate();
      if (std::abs(step) < 1e-8 * radius) break;  // quadratic: the next step would be below rounding
    }
    // g(n(t)) = 0 differentiated: radius' = radius (q.e') / -(q.e) with q = grad g.
    const Vector3d q = center_ - gradient_a - gradient_b;
    const double radius_t = -radius * q.dot(e_t) / q.dot(e);
    previous_ = radius_;
    radius_ = radius;
    previous_rate_ = radius_rate_;
    radius_rate_ = radius_t * node.weight;
    const Vector3d n_t = radius_t * e + radius * e_t;
    // q' = -(H_A + H_B) n', H = S / rho - (S n)(S n)^T / rho^3.
    const Vector3d q_t = -(alpha_.cwiseProduct(n_t) - gradient_a * gradient_a.dot(n_t)) / ra -
                         (beta_.cwiseProduct(n_t) - gradient_b * gradient_b.dot(n_t)) / rb;
    Point p;
    p.normal = normal_to_space_ * n;
    p.contact = to_space_ * q;
    p.turning = node.weight * p.contact.cross(to_space_ * q_t);
    return p;
  }

 private:
  Vector3d center_, alpha_, beta_, base_;
  Eigen::Matrix<double, 3, 2> plane_;
  AzimuthNodes nodes_;
  Matrix3d to_space_, normal_to_space_;
  double start_ = 0, radius_ = 0, previous_ = 0, radius_rate_ = 0, previous_rate_ = 0;
};

/// Moves `v` towards `target`, which is certain, in steps of growing size until `certain(v)`. The first step
/// is where the floating-point rung usually decides; gaps between inner and outer are far larger.
template <typename Certain>
Vector3d certified(const Vector3d& v, const Vector3d& target, Certain&& certain) {
  for (double step = 0x1p-44; step < 1; step *= 4) {
    const Vector3d moved = ((1 - step) * v + step * target).normalized();
    if (certain(moved)) return moved;
  }
  return target;
}

}  // namespace

ExactCone exact_cone(const Ellipsoid& a, const Ellipsoid& b, int samples) {
  if (samples < 3 || samples > 1'000'000)
    throw InputError("samples", std::to_string(samples), "a whole number from 3 to 1000000");
  ExactCone cone;
  const ContactFrame<3> contact(a, b);
  cone.relation = relation<3>(a, b, contact);
  const Vector3d c = b.center() - a.center();
  if (c.squaredNorm() > 0) cone.axis = c.normalized();
  if (cone.relation != Relation::disjoint) {
    cone.solid_angle = (cone.relation == Relation::touching ? 2 : 4) * std::numbers::pi;
    cone.cross_section_area = std::numeric_limits<double>::infinity();
    return cone;
  }
  Silhouette silhouette(contact);
  cone.boundary.reserve(samples);
  bool bounded = true;
  const double ds = 2 * std::numbers::pi / samples;
  for (int i = 0; i < samples; ++i) {
    const Silhouette::Point p = silhouette.at(i, samples);
    const double distance = p.contact.norm(), along = cone.axis.dot(p.contact);
    const double turning = cone.axis.dot(p.turning);
    cone.boundary.push_back({p.contact / distance, p.normal.normalized(), p.contact});
    // d omega = (1 - cos) d azimuth = axis.(u x u') / (1 + axis.u) ds for u = q / |q|.
    cone.solid_angle += turning / (distance * (distance + along)) * ds;
    if (along > 0) {
      cone.cross_section_area += 0.5 * turning / (along * along) * ds;
    } else {
      bounded = false;
    }
  }
  if (!bounded) cone.cross_section_area = std::numeric_limits<double>::infinity();
  return cone;
}

ConeBounds cone_bounds(const ExactCone& cone, const Ellipsoid& a, const Ellipsoid& b) {
  const ConeOracle oracle(a, b);
  const Vector3d inside_normal = oracle.separating_normal().normalized();
  ConeBounds bounds;
  std::vector<Vector3d> normals;
  bounds.inner.directions.reserve(cone.boundary.size());
  bounds.outer.directions.reserve(cone.boundary.size());
  normals.reserve(cone.boundary.size());
  for (const BoundarySample& s : cone.boundary) {
    bounds.inner.directions.push_back(certified(s.direction, cone.axis, [&](const Vector3d& w) {
      return oracle.triage_membership(w) == Membership::in;
    }));
    normals.push_back(
        certified(s.normal, inside_normal, [&](const Vector3d& n) { return triage_separates<3>(a, b, n); }));
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Vector3d edge = normals[i].cross(normals[(i + 1) % normals.size()]);
    if (edge.dot(inside_normal) < 0) edge = -edge;
    bounds.outer.directions.push_back(edge.normalized());
  }
  const auto measure = [&](PolyhedralCone& p) {
    p.solid_angle = polygon_solid_angle(cone.axis, p.directions);
    p.cross_section_area = polygon_section_area(cone.axis, p.directions);
  };
  measure(bounds.inner);
  measure(bounds.outer);
  const auto error = [](double inner, double value, double outer) {
    return std::max({value - inner, outer - value, 0.0}) + 1e-12 * value;
  };
  bounds.solid_angle_error = error(bounds.inner.solid_angle, cone.solid_angle, bounds.outer.solid_angle);
  bounds.cross_section_area_error =
      std::isfinite(cone.cross_section_area)
          ? error(bounds.inner.cross_section_area, cone.cross_section_area, bounds.outer.cross_section_area)
          : std::numeric_limits<double>::infinity();
  return bounds;
}

}  // namespace vericone
