// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/exact_cone.h>

#include <vericone/cones/contact_frame.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "azimuth_nodes.h"

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Two numbers that go through the same operations, one for each end of a chord through the base.
using Lanes = Eigen::Array2d;
using Lanes3 = std::array<Lanes, 3>;

Lanes dot(const Lanes3& x, const Lanes3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

Lanes3 times(const Matrix3d& m, const Lanes3& x) {
  return {m(0, 0) * x[0] + m(0, 1) * x[1] + m(0, 2) * x[2], m(1, 0) * x[0] + m(1, 1) * x[1] + m(1, 2) * x[2],
          m(2, 0) * x[0] + m(2, 1) * x[1] + m(2, 2) * x[2]};
}

/// The pair in coordinates where both bodies are axis-aligned and K lies in the unit ball about (0,0,L)
/// turned onto `center`: A has the squared semi-axes alpha, B beta.
class Silhouette {
 public:
  Silhouette(const ContactFrame<3>& contact, int count) : ds_(2 * std::numbers::pi / count) {
    const Vector3d shape = contact.bounding_shape(), scale = shape.cwiseSqrt();
    center_ = contact.center.cwiseQuotient(scale);
    alpha_ = shape.cwiseInverse();
    beta_ = contact.sigma.cwiseAbs2().cwiseQuotient(shape);
    to_space_ = contact.to_space * scale.asDiagonal();
    normal_to_space_ = contact.to_frame.transpose() * scale.cwiseInverse().asDiagonal();
    const AxisFrame frame(center_);
    const double determinant = to_space_.determinant();
    turning_scale_ = determinant / contact.center_line.norm();
    // A map that reflects would turn the curve clockwise in space.
    plane_ << (determinant > 0 ? 1 : -1) * frame.e1, frame.e2;
    nodes_ = AzimuthNodes(plane_.transpose() * alpha_.asDiagonal() * plane_,
                          plane_.transpose() * beta_.asDiagonal() * plane_, count);
    const double length2 = center_.squaredNorm();
    base_ = center_ / length2;
    start_ = std::sqrt(std::max(0.0, 1 - 1 / length2));
    radius_ = previous_ = start_;
  }

  /// Two opposite samples: lane 0 at the azimuth asked for, lane 1 half a turn on.
  struct Points {
    Lanes3 normal, contact;  // in space, not normalised
    Lanes turning;           // axis.(contact x d contact / ds), in space
  };

  /// Samples k and k + count / 2, in the order of k. Normals are base + radius e, in the plane n.center = 1,
  /// where g = 1 - rho_A - rho_B is concave along each ray with its maximum at the base (there the gradient
  /// is along the centre line), so Newton converges from any start beyond it.
  Points at(int k) {
    const AzimuthNodes::Node node = nodes_.at(k);
    const Vector3d direction = plane_ * node.e, across = plane_ * Vector2d(-node.e.y(), node.e.x());
    Lanes3 e, e_t;
    for (int i = 0; i < 3; ++i) {
      e[i] = Lanes(direction(i), -direction(i));
      e_t[i] = Lanes(across(i), -across(i));
    }
    // Cubic through the last two samples and their derivatives.
    Lanes radius = radius_ + ds_ * radius_rate_;
    if (k >= 2) radius = 5 * previous_ - 4 * radius_ + ds_ * (4 * radius_rate_ + 2 * previous_rate_);
    radius = radius.max(0.5 * (radius_ + start_)).min(2 * radius_);

    Lanes3 n, a, b;  // a = alpha n, b = beta n
    const auto place = [&] {
      for (int i = 0; i < 3; ++i) {
        n[i] = base_[i] + radius * e[i];
        a[i] = alpha_[i] * n[i];
        b[i] = beta_[i] * n[i];
      }
    };
    Lanes over_a, over_b;  // 1 / rho
    for (int iteration = 0;; ++iteration) {
      place();
      const Lanes rho_a = dot(n, a).sqrt(), rho_b = dot(n, b).sqrt();
      over_a = rho_a.inverse();
      over_b = rho_b.inverse();
      const Lanes slope_a = dot(a, e) * over_a, slope_b = dot(b, e) * over_b;
      const Lanes bend_a = (node.square_a - slope_a.square()) * over_a,
                  bend_b = (node.square_b - slope_b.square()) * over_b;
      const Lanes over_slope = (slope_a + slope_b).inverse();
      const Lanes newton = (1 - rho_a - rho_b) * over_slope;
      // Second order, bounded so that far from the root it stays a Newton step of the right size.
      const Lanes second = (0.5 * newton * (bend_a + bend_b) * over_slope).max(-0.5).min(0.5);
      Lanes step = newton * (1 - second);
      if (!step.allFinite() || iteration == 50) break;
      step = step.max(start_ - radius);
      radius += step;
      const Lanes grown_a = slope_a * step * over_a, grown_b = slope_b * step * over_b;
      const Lanes largest = grown_a.abs().max(grown_b.abs()).max(step.abs() / radius);
      if (largest.maxCoeff() < 4e-6) {
        // Third-order terms are below rounding: no need to take the roots anew.
        place();
        const Lanes more_a = grown_a + 0.5 * bend_a * over_a * step.square(),
                    more_b = grown_b + 0.5 * bend_b * over_b * step.square();
        over_a *= 1 - more_a + more_a.square();
        over_b *= 1 - more_b + more_b.square();
        break;
      }
    }
    // g(n(t)) = 0 differentiated: radius' = radius (q.e') / -(q.e) with q = grad g = center - gradient.
    Lanes3 gradient_a, gradient_b, gradient;
    for (int i = 0; i < 3; ++i) {
      gradient_a[i] = a[i] * over_a;
      gradient_b[i] = b[i] * over_b;
      gradient[i] = gradient_a[i] + gradient_b[i];
    }
    const Lanes radius_t = -radius * dot(gradient, e_t) / dot(gradient, e);
    previous_ = radius_;
    radius_ = radius;
    previous_rate_ = radius_rate_;
    radius_rate_ = radius_t * node.weight;
    // q' = -(H_A + H_B) n', H = S / rho - (S n)(S n)^T / rho^3.
    Lanes3 n_t, q, q_t;
    for (int i = 0; i < 3; ++i) n_t[i] = radius_t * e[i] + radius * e_t[i];
    const Lanes along_a = dot(gradient_a, n_t), along_b = dot(gradient_b, n_t);
    for (int i = 0; i < 3; ++i) {
      q[i] = center_[i] - gradient[i];
      q_t[i] = (gradient_a[i] * along_a - alpha_[i] * n_t[i]) * over_a +
               (gradient_b[i] * along_b - beta_[i] * n_t[i]) * over_b;
    }
    // With T = to_space: axis.(T q x T q') = det T (T^{-1} axis).(q x q'), T^{-1} axis = center / |c|, and
    // center.(q x q') = -center.(gradient x q').
    const Lanes volume = center_[0] * (gradient[2] * q_t[1] - gradient[1] * q_t[2]) +
                         center_[1] * (gradient[0] * q_t[2] - gradient[2] * q_t[0]) +
                         center_[2] * (gradient[1] * q_t[0] - gradient[0] * q_t[1]);
    return {times(normal_to_space_, n), times(to_space_, q), turning_scale_ * node.weight * volume};
  }

 private:
  Vector3d center_, alpha_, beta_, base_;
  Eigen::Matrix<double, 3, 2> plane_;
  AzimuthNodes nodes_;
  Matrix3d to_space_, normal_to_space_;
  double ds_, turning_scale_ = 0, start_ = 0;
  Lanes radius_ = Lanes::Zero(), previous_ = Lanes::Zero();
  Lanes radius_rate_ = Lanes::Zero(), previous_rate_ = Lanes::Zero();
};

/// Moves `v` towards `target`, which is certain, in steps of growing size until the predicate says yes. The first
/// step is where its floating-point rung usually decides; gaps between inner and outer are far larger. For bodies
/// so thin that it never does, the whole ladder is asked.
template <typename Quick, typename Certain>
Vector3d certified(const Vector3d& v, const Vector3d& target, Quick&& quick, Certain&& certain) {
  const auto moved = [&](double step) -> Vector3d { return ((1 - step) * v + step * target).normalized(); };
  for (double step = 0x1p-44; step < 0x1p-28; step *= 4)
    if (const Vector3d m = moved(step); quick(m)) return m;
  for (double step = 0x1p-48; step < 1; step *= 4)
    if (const Vector3d m = moved(step); certain(m)) return m;
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
  Silhouette silhouette(contact, samples);
  cone.boundary.resize(samples);
  // Opposite samples come in pairs; of an odd number of samples every pair gives one.
  const bool paired = samples % 2 == 0;
  const int half = samples / 2, count = paired ? half : samples;
  Lanes solid_angle = Lanes::Zero(), area = Lanes::Zero();
  bool bounded = true;
  for (int i = 0; i < count; ++i) {
    const Silhouette::Points p = silhouette.at(i);
    const Lanes distance = dot(p.contact, p.contact).sqrt(), normal = dot(p.normal, p.normal).sqrt();
    const Lanes over_distance = distance.inverse(), over_normal = normal.inverse();
    const Lanes along =
        cone.axis.x() * p.contact[0] + cone.axis.y() * p.contact[1] + cone.axis.z() * p.contact[2];
    for (int lane = 0; lane < (paired ? 2 : 1); ++lane) {
      BoundarySample& sample = cone.boundary[i + lane * half];
      for (int x = 0; x < 3; ++x) {
        sample.direction(x) = p.contact[x](lane) * over_distance(lane);
        sample.normal(x) = p.normal[x](lane) * over_normal(lane);
        sample.contact(x) = p.contact[x](lane);
      }
      bounded = bounded && along(lane) > 0;
    }
    // d omega = (1 - cos) d azimuth = axis.(u x u') / (1 + axis.u) ds for u = q / |q|.
    solid_angle += p.turning / (distance * (distance + along));
    area += 0.5 * p.turning / along.square();
  }
  const double ds = 2 * std::numbers::pi / samples;
  cone.solid_angle = ds * (paired ? solid_angle.sum() : solid_angle(0));
  cone.cross_section_area = ds * (paired ? area.sum() : area(0));
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
    bounds.inner.directions.push_back(
        certified(s.direction, cone.axis,
                  [&](const Vector3d& w) { return oracle.triage_membership(w) == Membership::in; },
                  [&](const Vector3d& w) { return oracle.membership(w) != Membership::out; }));
    normals.push_back(certified(s.normal, inside_normal,
                                [&](const Vector3d& n) { return triage_separates<3>(a, b, n); },
                                [&](const Vector3d& n) { return separates<3>(a, b, n); }));
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
    return std::max(value - inner, outer - value) + 1e-12 * value;
  };
  bounds.solid_angle = std::clamp(cone.solid_angle, bounds.inner.solid_angle, bounds.outer.solid_angle);
  bounds.solid_angle_error = error(bounds.inner.solid_angle, bounds.solid_angle, bounds.outer.solid_angle);
  bounds.cross_section_area = cone.cross_section_area;
  bounds.cross_section_area_error = std::numeric_limits<double>::infinity();
  if (std::isfinite(cone.cross_section_area)) {
    bounds.cross_section_area =
        std::clamp(cone.cross_section_area, bounds.inner.cross_section_area, bounds.outer.cross_section_area);
    bounds.cross_section_area_error =
        error(bounds.inner.cross_section_area, bounds.cross_section_area, bounds.outer.cross_section_area);
  }
  return bounds;
}

}  // namespace vericone
