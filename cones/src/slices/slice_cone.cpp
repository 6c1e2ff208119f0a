// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/cones/slices/slice_sector.h>

#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include <vericone/internal/geometry/lengths.h>
#include "ellipsoids/plane_axis.h"
#include "ellipsoids/require_disjoint.h"
#include "planar/degenerate_conics.h"
#include "planar/planar_frame.h"
#include "slices/on_planes.h"

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Factor F of the section { y : |G y| <= 1 }, from G = Q R: F = R^{-1}.
Matrix2d section_factor(const Vector3d& g1, const Vector3d& g2) {
  const double r11 = g1.norm(), r12 = g1.dot(g2) / r11;
  const double r22 = (g2 - (r12 / r11) * g1).norm();
  Matrix2d f;
  f << 1 / r11, -r12 / (r11 * r22), 0, 1 / r22;
  return f;
}

/// Both bodies seen from planes through both centres. With G = F^{-1} a body is |G x| <= 1 about its centre,
/// so its section by x = P y is |G P y| <= 1; this is (6.11) without squaring the matrices.
class Slicer {
 public:
  Slicer(const Ellipsoid& a, const Ellipsoid& b)
      : frame_(b.center() - a.center()),
        distance_((b.center() - a.center()).norm()),
        inverse_a_(scaled_inverse<3>(a.factor())),
        inverse_b_(scaled_inverse<3>(b.factor())),
        along_a_(inverse_a_ * frame_.axis),
        along_b_(inverse_b_ * frame_.axis) {}

  const AxisFrame& frame() const { return frame_; }

  Slice slice(double azimuth, const Vector3d& across, int& fallbacks) const {
    const Matrix2d fa = section_factor(along_a_, inverse_a_ * across),
                   fb = section_factor(along_b_, inverse_b_ * across);
    const ContactFrame<2> contact(fa, fb, Vector2d(distance_, 0));
    const PlanarFrame frame(contact);
    std::array<Vector2d, 2> normals;
    if (const auto tangents = inner_tangents_by_degenerate_conics(frame, contact)) {
      normals = tangents->normals;
    } else {
      ++fallbacks;
      normals = {Vector2d(1, support_tangent_slope(frame, contact, 1)),
                 Vector2d(1, support_tangent_slope(frame, contact, -1))};
    }
    if (frame.normal_to_space.determinant() < 0) std::swap(normals[0], normals[1]);
    // The line of sight is the x axis. An edge at the angle delta from it has the inner normal
    // (sin delta, -+cos delta), and |c| sin delta = rho_A + rho_B keeps the relative accuracy of small
    // angles.
    const auto angle = [&](const Vector2d& normal, double side) {
      const Vector2d n = (frame.normal_to_space * normal).normalized();
      const double width = (fa.transpose() * n).norm() + (fb.transpose() * n).norm();
      return std::atan2(width / distance_, side * n.y());
    };
    return {azimuth, angle(normals[1], -1), angle(normals[0], 1)};
  }

 private:
  AxisFrame frame_;
  double distance_;
  Eigen::Matrix3d inverse_a_, inverse_b_;
  Vector3d along_a_, along_b_;
};

}  // namespace

SliceCone slice_cone(const Ellipsoid& a, const Ellipsoid& b, int planes) {
  require_planes(planes);
  SliceCone cone;
  cone.relation = relation<3>(a, b);
  cone.axis = (b.center() - a.center()).normalized();
  if (cone.relation != Relation::disjoint) return cone;
  const Slicer slicer(a, b);
  cone.slices.reserve(planes);
  on_planes(slicer.frame(), planes, [&](double azimuth, const Vector3d& across) {
    cone.slices.push_back(slicer.slice(azimuth, across, cone.support_fallbacks));
    return true;
  });
  return cone;
}

Slice slice_sector(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& across) {
  require_disjoint(a, b);
  const Slicer slicer(a, b);
  const AxisFrame& frame = slicer.frame();
  const Vector3d second = second_axis(frame.axis, across);
  int fallbacks = 0;
  return slicer.slice(std::atan2(second.dot(frame.e2), second.dot(frame.e1)), second, fallbacks);
}

PolyhedralCone SliceCone::polyhedral() const {
  PolyhedralCone cone;
  if (relation != Relation::disjoint) {
    cone.solid_angle = (relation == Relation::touching ? 2 : 4) * std::numbers::pi;
    cone.cross_section_area = std::numeric_limits<double>::infinity();
    return cone;
  }
  const AxisFrame frame(axis);
  const auto add = [&](double azimuth, double angle) {
    cone.directions.push_back(std::cos(angle) * frame.axis + std::sin(angle) * frame.across(azimuth));
  };
  for (const Slice& s : slices) add(s.azimuth, s.left);
  for (const Slice& s : slices) add(s.azimuth + std::numbers::pi, s.right);
  cone.solid_angle = polygon_solid_angle(axis, cone.directions);
  cone.cross_section_area = polygon_section_area(axis, cone.directions);
  return cone;
}

}  // namespace vericone
