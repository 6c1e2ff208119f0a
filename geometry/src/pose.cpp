// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies moved and turned, and planar ones raised.
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/geometry/rotation.h>

namespace vericone {
namespace {

Ellipsoid raised(const Ellipse& body, double height) {
  Eigen::Vector3d center(body.center().x(), body.center().y(), 0);
  if (!body.defined_by_factor()) {
    Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
    shape.topLeftCorner<2, 2>() = body.shape();
    shape(2, 2) = height * height;
    return Ellipsoid::from_shape(center, shape);
  }
  const Eigen::Matrix2d& f = body.factor();
  const double x = f.col(0).norm(), y = f.col(1).norm();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() << f.col(0) / x, f.col(1) / y;
  return Ellipsoid::from_axes(center, {x, y, height}, rotation);
}

}  // namespace

Pose Pose::from_quaternion(const Eigen::Vector3d& position, const Eigen::Vector4d& wxyz) {
  return {position, rotation_3d(wxyz)};
}

bool is_upright(const Pose& pose) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(pose.position(i)))
      throw InputError("pose.position[" + std::to_string(i) + "]", to_text(pose.position(i)),
                       "a finite number (m)");
  const Eigen::Matrix3d& r = pose.rotation;
  if (!((r.transpose() * r - Eigen::Matrix3d::Identity()).norm() < 1e-12 && r.determinant() > 0))
    throw InputError("pose.rotation", "determinant " + to_text(r.determinant()),
                     "a rotation, orthonormal to 1e-12");
  return r == Eigen::Matrix3d::Identity();
}

Ellipsoid in_world(const Ellipsoid& body, const Pose& pose) {
  if (is_upright(pose)) return pose.position.isZero(0) ? body : body.translated(pose.position);
  const Eigen::Vector3d center = pose.to_world(body.center());
  if (!body.defined_by_factor()) return Ellipsoid::from_shape(center, turned<3>(pose.rotation, body.shape()));
  Eigen::Matrix3d axes = pose.rotation * body.axis_directions();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  return Ellipsoid::from_axes(center, body.semi_axes(), axes);
}

CombinedEllipsoid in_world(const CombinedEllipsoid& body, const Pose& pose) {
  if (body.is_ellipsoid()) return in_world(body.ellipsoid(), pose);
  if (is_upright(pose)) return pose.position.isZero(0) ? body : body.translated(pose.position);
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<3>& d : body.delimiters())
    delimiters.push_back({turned<3>(pose.rotation, d.matrix), d.level});
  return CombinedEllipsoid::trusted(in_world(body.ellipsoid(), pose), std::move(delimiters));
}

HullBody in_world(const HullBody& body, const Pose& pose) {
  if (is_upright(pose) && pose.position.isZero(0)) return body;
  std::vector<Eigen::Vector3d> points = body.points();
  for (Eigen::Vector3d& x : points) x = pose.to_world(x);
  return HullBody(std::move(points));
}

Pose composed(const Pose& first, const Pose& second) {
  return {first.to_world(second.position), first.rotation * second.rotation};
}

Pose inverse(const Pose& pose) {
  return {-(pose.rotation.transpose() * pose.position), pose.rotation.transpose()};
}

CombinedEllipsoid raised(const CombinedEllipse& body, double height) {
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<2>& d : body.delimiters()) {
    Delimiter<3> cylinder{Eigen::Matrix3d::Zero(), d.level};
    cylinder.matrix.topLeftCorner<2, 2>() = d.matrix;
    delimiters.push_back(cylinder);
  }
  return CombinedEllipsoid::trusted(raised(body.ellipsoid(), height), std::move(delimiters));
}

}  // namespace vericone
