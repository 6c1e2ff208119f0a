// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "ellipsoids/azimuth_nodes.h"
#include "ellipsoids/require_disjoint.h"

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Four numbers that go through the same operations: the two ends of a chord
/// through the base, for the walk forward and for the walk backward.
using Lanes = Eigen::Array4d;
using Lanes3 = std::array<Lanes, 3>;

Lanes3 broadcast(const Vector3d& v) {
  return {Lanes::Constant(v.x()), Lanes::Constant(v.y()), Lanes::Constant(v.z())};
}

using Walks = AzimuthNodes::Walks;
Lanes same(const Walks& x) { return {x(0), x(0), x(1), x(1)}; }
Lanes opposite(const Walks& x) { return {x(0), -x(0), x(1), -x(1)}; }
Lanes3 opposite(const Eigen::Matrix<double, 3, 2>& plane, const Walks& x, const Walks& y) {
  return {opposite(plane(0, 0) * x + plane(0, 1) * y), opposite(plane(1, 0) * x + plane(1, 1) * y),
          opposite(plane(2, 0) * x + plane(2, 1) * y)};
}

Lanes dot(const Lanes3& x, const Lanes3& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// The pair in coordinates where both bodies are axis-aligned and K lies in the
/// unit ball about (0,0,L) turned onto `center`: A has the squared semi-axes
/// alpha, B beta. Normals are base + radius e, in the plane n.center = 1, with
/// e a unit vector of the plane across the centre line.
class Silhouette {
 public:
  Silhouette(const ContactFrame<3>& contact, int count) : ds_(2 * std::numbers::pi / count) {
    const Vector3d shape = contact.bounding_shape(), scale = shape.cwiseSqrt();
    const Vector3d alpha = shape.cwiseInverse(), beta = contact.sigma.cwiseAbs2().cwiseQuotient(shape);
    Vector3d center = contact.center.cwiseQuotient(scale);
    // Bodies whose gap is below rounding, known to be apart from the exact rung: traced as if they were a few
    // roundings farther apart. The cone is a half-space to 1e-7 then.
    constexpr double kLeast = 1 + 0x1p-50;
    if (center.squaredNorm() < kLeast) center *= std::sqrt(kLeast) / center.norm();
    const Matrix3d to_space = contact.to_space * scale.asDiagonal();
    const Matrix3d normal_to_space = contact.to_frame.transpose() * scale.cwiseInverse().asDiagonal();
    const AxisFrame frame(center);
    const double determinant = to_space.determinant(), length2 = center.squaredNorm();
    // A map that reflects would turn the curve clockwise in space.
    plane_ << (determinant > 0 ? 1 : -1) * frame.e1, frame.e2;
    nodes_ = AzimuthNodes(plane_.transpose() * alpha.asDiagonal() * plane_,
                          plane_.transpose() * beta.asDiagonal() * plane_, count);
    const Vector3d base = center / length2;
    normal_plane_ = normal_to_space * plane_;
    base_a_ = plane_.transpose() * alpha.cwiseProduct(base);
    base_b_ = plane_.transpose() * beta.cwiseProduct(base);
    turning_scale_ = std::abs(determinant) / (std::sqrt(length2) * contact.center_line.norm());
    start_ = std::sqrt(std::max(0.0, 1 - 1 / length2));
    radius_ = previous_ = start_;
    alpha_ = broadcast(alpha);
    beta_ = broadcast(beta);
    adjugate_a_ = broadcast(Vector3d(alpha.y() * alpha.z(), alpha.z() * alpha.x(), alpha.x() * alpha.y()));
    adjugate_b_ = broadcast(Vector3d(beta.y() * beta.z(), beta.z() * beta.x(), beta.x() * beta.y()));
    base_ = broadcast(base);
    center_ = broadcast(center);
    center_line_ = broadcast(contact.center_line);
    normal_base_ = broadcast(normal_to_space * base);
    for (int i = 0; i < 3; ++i) to_space_[i] = broadcast(to_space.row(i));
  }

  struct Points {
    Lanes3 normal, contact;  // in space, not normalised
    Lanes turning;           // axis.(contact x d contact / ds), in space
  };

  /// Samples k and -k of the walks and the opposite ones, in the order of k. g
  /// = 1 - rho_A - rho_B is concave along each ray with its maximum at the base
  /// (there the gradient is along the centre line), so Newton converges from
  /// any start beyond it.
  Points at(int k) {
    const AzimuthNodes::Nodes nodes = nodes_.at(k);
    const Walks across_x(-nodes.y(0), nodes.y(1)), across_y(nodes.x(0), -nodes.x(1));
    const Lanes3 e = opposite(plane_, nodes.x, nodes.y), e_t = opposite(plane_, across_x, across_y);
    const Lanes weight = same(nodes.weight);
    // Along a ray S n . e = S base . e + radius S e . e, and the same across
    // it.
    const Lanes base_a = opposite(base_a_.x() * nodes.x + base_a_.y() * nodes.y),
                base_b = opposite(base_b_.x() * nodes.x + base_b_.y() * nodes.y);
    const Lanes along_a = same(nodes.along_a), along_b = same(nodes.along_b);
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
    for (int iteration = 0; iteration < 50; ++iteration) {
      place();
      const Lanes rho_a = dot(n, a).sqrt(), rho_b = dot(n, b).sqrt();
      over_a = rho_a.inverse();
      over_b = rho_b.inverse();
      const Lanes slope_a = (base_a + radius * along_a) * over_a,
                  slope_b = (base_b + radius * along_b) * over_b;
      const Lanes bend_a = (along_a - slope_a.square()) * over_a,
                  bend_b = (along_b - slope_b.square()) * over_b;
      const Lanes over_slope = (slope_a + slope_b).inverse();
      const Lanes newton = (1 - rho_a - rho_b) * over_slope;
      // Second order, bounded so that far from the root it stays a Newton step
      // of the right size.
      const Lanes second = (0.5 * newton * (bend_a + bend_b) * over_slope).max(-0.5).min(0.5);
      Lanes step = (newton * (1 - second)).max(start_ - radius);
      // No slope: bodies that all but touch, and the radius is as good as it
      // gets.
      step = (step.abs() <= std::numeric_limits<double>::max()).select(step, 0.0);
      radius += step;
      // Powers of step sqrt(S e.e) / rho.
      const Lanes step2 = step.square();
      const Lanes size = step2 * (along_a * over_a.square()).max(along_b * over_b.square());
      if (size.maxCoeff() < 1.6e-11) {
        // Third-order terms are below rounding: no need to take the roots anew.
        place();
        const Lanes more_a = (slope_a * step + 0.5 * bend_a * step2) * over_a,
                    more_b = (slope_b * step + 0.5 * bend_b * step2) * over_b;
        over_a *= 1 - more_a + more_a.square();
        over_b *= 1 - more_b + more_b.square();
        break;
      }
    }
    Points p;
    // The gradient S_A n / rho_A + S_B n / rho_B of the width, along e and
    // across it.
    const Lanes slope = (base_a + radius * along_a) * over_a + (base_b + radius * along_b) * over_b;
    const Lanes side =
        (opposite(base_a_.x() * across_x + base_a_.y() * across_y) + radius * same(nodes.mixed_a)) * over_a +
        (opposite(base_b_.x() * across_x + base_b_.y() * across_y) + radius * same(nodes.mixed_b)) * over_b;
    // The width is one all along: radius' slope + radius side = 0.
    const Lanes over_slope = slope.inverse();
    previous_ = radius_;
    radius_ = radius;
    previous_rate_ = radius_rate_;
    radius_rate_ = -weight * radius * side * over_slope;
    // With T = to_space: axis.(T q x T q') = det T (T^{-1} axis).(q x q'),
    // T^{-1} axis = center / |c|, and q' = -(H_A + H_B) n' with q = grad g, H =
    // S / rho - (S n)(S n)^T / rho^3, n' = radius' e + radius e'. By Lagrange's
    // identity m.H n' = (n x m).adj(S)(n x n') / rho^3, which makes the product
    // a sum of positive terms, (radius / slope) (v.adj(S_A) v / rho_A^3 +
    // v.adj(S_B) v / rho_B^3) with
    //   v = slope n x e' - side n x e,  n x e = e' / L,  n x e' = radius center
    //   / L - e / L.
    Lanes3 v;  // squares of its components times L
    const Lanes lift = slope * radius;
    for (int i = 0; i < 3; ++i) v[i] = (lift * center_[i] - slope * e[i] - side * e_t[i]).square();
    p.turning =
        turning_scale_ * weight * radius * over_slope *
        (dot(adjugate_a_, v) * over_a * over_a.square() + dot(adjugate_b_, v) * over_b * over_b.square());
    const Lanes3 normal_e = opposite(normal_plane_, nodes.x, nodes.y);
    const Lanes3 gradient = {a[0] * over_a + b[0] * over_b, a[1] * over_a + b[1] * over_b,
                             a[2] * over_a + b[2] * over_b};
    for (int i = 0; i < 3; ++i) {
      p.normal[i] = normal_base_[i] + radius * normal_e[i];
      p.contact[i] = center_line_[i] - dot(to_space_[i], gradient);
    }
    return p;
  }

 private:
  AzimuthNodes nodes_;
  Eigen::Matrix<double, 3, 2> plane_, normal_plane_;
  Vector2d base_a_, base_b_;  // S base in the plane
  Lanes3 alpha_, beta_, adjugate_a_, adjugate_b_, base_, center_, center_line_, normal_base_;
  std::array<Lanes3, 3> to_space_;
  double ds_, turning_scale_ = 0, start_ = 0;
  Lanes radius_ = Lanes::Zero(), previous_ = Lanes::Zero();
  Lanes radius_rate_ = Lanes::Zero(), previous_rate_ = Lanes::Zero();
};

void require_cone_of(const TrueCone& cone, const ConeOracle& oracle) {
  require_disjoint(oracle.relation());
  if (cone.relation != Relation::disjoint)
    throw InputError("cone.relation", to_string(cone.relation), "disjoint, for a cone with edges");
  if (cone.boundary.size() < 3)
    throw InputError("cone.boundary", std::to_string(cone.boundary.size()) + " samples", "3 or more");
  // The axis is taken to be inside, without a proof.
  const Vector3d axis = (oracle.b().center() - oracle.a().center()).normalized();
  if (!((cone.axis - axis).cwiseAbs().maxCoeff() <= 4 * std::numeric_limits<double>::epsilon()))
    throw InputError(
        "cone.axis",
        "[" + to_text(cone.axis.x()) + ", " + to_text(cone.axis.y()) + ", " + to_text(cone.axis.z()) + "]",
        "the direction from a to b: the cone of these two bodies");
}

/// Moves `v` towards `target`, which is certain, in steps of growing size until the predicate says yes. Its
/// floating-point rung usually decides within a few of them; only where that would take steps that show
/// beside the gap between inner and outer (`unnoticed`) are the intervals asked, which lose less for distant
/// bodies, and then the whole ladder.
template <typename Quick, typename Intervals, typename Certain>
Vector3d certified(const Vector3d& v, const Vector3d& target, double unnoticed, const Quick& quick,
                   const Intervals& intervals, const Certain& certain) {
  const auto moved = [&](double step) -> Vector3d { return ((1 - step) * v + step * target).normalized(); };
  for (double step = 0x1p-44; step < unnoticed; step *= 8)
    if (const Vector3d m = moved(step); quick(m)) return m;
  for (double step = 0x1p-44; step < unnoticed; step *= 8)
    if (const Vector3d m = moved(step); intervals(m)) return m;
  for (double step = 0x1p-48; step < 1; step *= 8)
    if (const Vector3d m = moved(step); certain(m)) return m;
  return target;
}

/// Sign of the turn at `y` on the way x, y, z seen from the origin: positive to the left, which is
/// counter-clockwise. Differences keep its digits for near vectors.
double turn(const Vector3d& x, const Vector3d& y, const Vector3d& z) { return x.dot((y - x).cross(z - x)); }

void measure(PolyhedralCone& cone, const Vector3d& axis) {
  cone.solid_angle = polygon_solid_angle(axis, cone.directions);
  cone.cross_section_area = polygon_section_area(axis, cone.directions);
}

/// The intersection of the half-spaces n.x >= 0 of separating normals given in order around it. Normals that
/// were moved inside the hull of the others bound nothing and would make the chain of edges cross itself.
PolyhedralCone intersection(std::vector<Vector3d> normals, const Vector3d& axis, const Vector3d& inside) {
  const AxisFrame frame(axis);
  // Every separating normal has n.c > 0, so n / n.c is a point of a plane; start at one that is extreme
  // there.
  const auto first = std::max_element(normals.begin(), normals.end(), [&](const auto& x, const auto& y) {
    return x.dot(frame.e1) * y.dot(axis) < y.dot(frame.e1) * x.dot(axis);
  });
  std::rotate(normals.begin(), first, normals.end());
  std::vector<Vector3d> hull;
  for (std::size_t i = 0; i <= normals.size(); ++i) {
    const Vector3d& n = normals[i % normals.size()];
    while (hull.size() > 1 && !(turn(hull[hull.size() - 2], hull.back(), n) > 0)) hull.pop_back();
    if (i < normals.size()) hull.push_back(n);
  }
  PolyhedralCone cone;
  if (hull.size() < 3) {  // one half-space
    const AxisFrame across(inside);
    cone.directions = {across.e1, across.e2, -across.e1, -across.e2};
    cone.solid_angle = 2 * std::numbers::pi;
    cone.cross_section_area = std::numeric_limits<double>::infinity();
    return cone;
  }
  cone.directions.reserve(hull.size());
  double perimeter = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector3d& next = hull[(i + 1) % hull.size()];
    const Vector3d across = hull[i].cross(next - hull[i]);
    cone.directions.push_back(across.normalized());
    perimeter += std::atan2(across.norm(), hull[i].dot(next));
  }
  measure(cone, axis);
  // The solid angle of a cone and the perimeter of its polar add up to 2 pi: better for nearly a half-space,
  // whose edges may be half a turn apart.
  if (perimeter < 1) cone.solid_angle = 2 * std::numbers::pi - perimeter;
  return cone;
}

}  // namespace

TrueCone true_cone(const Ellipsoid& a, const Ellipsoid& b, int samples) {
  if (samples < 3 || samples > 1'000'000)
    throw InputError("samples", std::to_string(samples), "a whole number from 3 to 1000000");
  TrueCone cone;
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
  // Opposite samples come in pairs; of an odd number of samples every pair
  // gives one. Both walks stop where they meet.
  const bool paired = samples % 2 == 0;
  const int half = samples / 2, last = paired ? half / 2 : half;
  Lanes solid_angle = Lanes::Zero(), area = Lanes::Zero();
  bool bounded = true;
  for (int i = 0; i <= last; ++i) {
    if (i % 4096 == 0) checkpoint();
    const Silhouette::Points p = silhouette.at(i);
    const Lanes distance = dot(p.contact, p.contact).sqrt(), normal = dot(p.normal, p.normal).sqrt();
    const Lanes over_distance = distance.inverse(), over_normal = normal.inverse();
    const Lanes along =
        cone.axis.x() * p.contact[0] + cone.axis.y() * p.contact[1] + cone.axis.z() * p.contact[2];
    // d omega = (1 - cos) d azimuth = axis.(u x u') / (1 + axis.u) ds for u = q
    // / |q|.
    const Lanes solid_part = p.turning / (distance * (distance + along));
    const Lanes area_part = 0.5 * p.turning / along.square();
    const auto put = [&](int index, int lane) {
      BoundarySample& sample = cone.boundary[index];
      for (int x = 0; x < 3; ++x) {
        sample.direction(x) = p.contact[x](lane) * over_distance(lane);
        sample.normal(x) = p.normal[x](lane) * over_normal(lane);
        sample.contact(x) = p.contact[x](lane);
      }
      bounded = bounded && along(lane) > 0;
      solid_angle(lane) += solid_part(lane);
      area(lane) += area_part(lane);
    };
    put(i, 0);
    if (paired) put(i + half, 1);
    if (i == 0 || (paired && 2 * i == half)) continue;  // the walk backward is at a node of the other
    put(samples - i, 2);
    if (paired) put(half - i, 3);
  }
  const double ds = 2 * std::numbers::pi / samples;
  cone.solid_angle = ds * solid_angle.sum();
  cone.cross_section_area = ds * area.sum();
  if (!bounded) cone.cross_section_area = std::numeric_limits<double>::infinity();
  return cone;
}

ConeBounds cone_bounds(const TrueCone& cone, const Ellipsoid& a, const Ellipsoid& b) {
  const ConeOracle oracle(a, b);
  require_cone_of(cone, oracle);
  // Scaled by a power of two only: a rounding could lose the proof that it separates.
  const Vector3d inside_normal =
      oracle.separating_normal() *
      std::ldexp(1.0, -std::ilogb(oracle.separating_normal().cwiseAbs().maxCoeff()));
  ConeBounds bounds;
  std::vector<Vector3d> normals;
  // The relative gap is about 7 / samples^2.
  const double unnoticed =
      0.02 / (static_cast<double>(cone.boundary.size()) * static_cast<double>(cone.boundary.size()));
  bounds.inner.directions.reserve(cone.boundary.size());
  normals.reserve(cone.boundary.size());
  for (const BoundarySample& s : cone.boundary) {
    bounds.inner.directions.push_back(certified(
        s.direction, cone.axis, unnoticed,
        [&](const Vector3d& w) { return oracle.triage_membership(w) == Membership::in; },
        [&](const Vector3d& w) { return oracle.interval_membership(w, Vector3d::Zero()) == Membership::in; },
        [&](const Vector3d& w) { return oracle.membership(w) != Membership::out; }));
    normals.push_back(certified(
        s.normal, inside_normal, unnoticed, [&](const Vector3d& n) { return triage_separates<3>(a, b, n); },
        [](const Vector3d&) { return false; }, [&](const Vector3d& n) { return separates<3>(a, b, n); }));
  }
  bounds.outer = intersection(std::move(normals), cone.axis, inside_normal);
  measure(bounds.inner, cone.axis);
  const auto error = [](double inner, double value, double outer) {
    return std::max(value - inner, outer - value) + 1e-12 * value;
  };
  bounds.solid_angle = std::clamp(cone.solid_angle, bounds.inner.solid_angle,
                                  std::max(bounds.inner.solid_angle, bounds.outer.solid_angle));
  bounds.solid_angle_error = error(bounds.inner.solid_angle, bounds.solid_angle, bounds.outer.solid_angle);
  bounds.cross_section_area = cone.cross_section_area;
  bounds.cross_section_area_error = std::numeric_limits<double>::infinity();
  if (std::isfinite(cone.cross_section_area)) {
    bounds.cross_section_area =
        std::clamp(cone.cross_section_area, bounds.inner.cross_section_area,
                   std::max(bounds.inner.cross_section_area, bounds.outer.cross_section_area));
    bounds.cross_section_area_error =
        error(bounds.inner.cross_section_area, bounds.cross_section_area, bounds.outer.cross_section_area);
  }
  return bounds;
}

}  // namespace vericone
