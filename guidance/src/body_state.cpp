// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/body_state.h>

#include <vericone/geometry/decompositions.h>
#include <vericone/guidance/plane_view.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vericone::guidance {
namespace {

template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

template <int D>
Matrix<D> symmetric(const Matrix<D>& m) {
  return 0.5 * (m + m.transpose());
}

/// The ellipsoid turned, its shape changed by `rate` for `dt`. S becomes X S X^T with X = I + S' S^{-1} dt/2,
/// which is S + S' dt to first order and positive definite for every dt.
template <int D>
BasicEllipsoid<D> changed(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& center,
                          const Matrix<D>& rotation, const Matrix<D>& rate, double dt) {
  Matrix<D> factor = body.factor();
  if (!rate.isZero(0)) {
    const Matrix<D> inverse = factor.inverse();
    factor += 0.5 * dt * rate * inverse.transpose();
  }
  const LeftSingular<D> svd = left_singular<D>(rotation * factor);
  Matrix<D> directions = svd.u;
  if (directions.determinant() < 0) directions.col(0) *= -1;
  return BasicEllipsoid<D>::from_axes(center, svd.values, directions);
}

template <int D>
BasicCombined<D> changed(const BasicCombined<D>& body, const Eigen::Matrix<double, D, 1>& center,
                         const Matrix<D>& rotation, const ShapeRate& rate, double dt) {
  std::vector<Delimiter<D>> delimiters = body.delimiters();
  for (std::size_t i = 0; i < delimiters.size(); ++i) {
    Delimiter<D>& d = delimiters[i];
    if (i < rate.delimiters.size()) {
      d.matrix += dt * rate.delimiters[i].matrix.template topLeftCorner<D, D>();
      d.level = std::max(d.level + dt * rate.delimiters[i].level, 0.0);
    }
    d.matrix = symmetric<D>(rotation * d.matrix * rotation.transpose());
  }
  const Matrix<D> shape_rate = rate.shape.topLeftCorner<D, D>();
  return BasicCombined<D>::trusted(changed<D>(body.ellipsoid(), center, rotation, shape_rate, dt),
                                   std::move(delimiters));
}

struct Later {
  const BodyState& body;
  const Eigen::Vector3d& position;
  const Eigen::Vector3d& turn;  // rotation vector
  double dt;

  Eigen::Matrix3d rotation() const {
    const double angle = turn.norm();
    if (!(angle > 0)) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }

  Shape operator()(const CombinedEllipse& shape) const {
    return changed<2>(shape, position.head<2>(), rotation_2d(turn.z()), body.rate, dt);
  }
  Shape operator()(const CombinedEllipsoid& shape) const {
    return changed<3>(shape, position, rotation(), body.rate, dt);
  }
  Shape operator()(const HullBody& shape) const {
    const Eigen::Matrix3d r = rotation();
    std::vector<Eigen::Vector3d> points = shape.points();
    for (Eigen::Vector3d& x : points) x = position + r * (x - body.position);
    return HullBody(std::move(points));
  }
};

}  // namespace

Eigen::Vector3d angular_velocity(const BodyState& body, const Eigen::Vector3d& acceleration) {
  const double square = body.velocity.squaredNorm();
  if (body.turning == Turning::none || !(square > 0)) return body.omega;
  return body.omega + body.velocity.cross(acceleration) / square;
}

BodyState advanced(const BodyState& body, double dt, const Eigen::Vector3d& acceleration) {
  BodyState later = body;
  later.position += dt * (body.velocity + 0.5 * dt * acceleration);
  later.velocity += dt * acceleration;
  const Eigen::Vector3d turn = dt * angular_velocity(body, acceleration);
  later.shape = std::visit(Later{body, later.position, turn, dt}, body.shape);
  return later;
}

}  // namespace vericone::guidance
