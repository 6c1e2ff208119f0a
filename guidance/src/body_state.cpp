// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/body_state.h>

#include <vericone/geometry/decompositions.h>
#include <vericone/geometry/error.h>
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
  Shape operator()(const Placed& shape) const {
    const Eigen::Matrix3d r = rotation();
    Placed later = shape;
    later.pose = {position + r * (shape.pose.position - body.position), r * shape.pose.rotation};
    return later;
  }
};

[[noreturn]] void refuse_mixed() {
  throw InputError("bodies", "one of the plane and one of space", "both of the plane or both of space");
}

struct AsPlaced {
  Placed operator()(const CombinedEllipse&) const { refuse_mixed(); }
  Placed operator()(const CombinedEllipsoid& body) const { return Body(body); }
  Placed operator()(const HullBody& hull) const { return Body(hull); }
  Placed operator()(const Placed& body) const { return body; }
};

using Point = std::optional<Eigen::Vector3d>;

struct Farthest {
  const Eigen::Vector3d& n;

  Point operator()(const CombinedEllipsoid& body) const {
    return body.is_ellipsoid() ? Point(body.ellipsoid().support_point(n)) : std::nullopt;
  }
  Point operator()(const HullBody& hull) const {
    return *std::max_element(
        hull.points().begin(), hull.points().end(),
        [this](const Eigen::Vector3d& x, const Eigen::Vector3d& y) { return n.dot(x) < n.dot(y); });
  }
  Point operator()(const Placed& body) const {
    const Eigen::Vector3d seen = body.pose.rotation.transpose() * n;
    const Point own = std::visit(Farthest{seen}, body.body.shape());
    return own ? Point(body.pose.to_world(*own)) : std::nullopt;
  }
  template <typename Other>
  Point operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

Placed placed(const Shape& shape) { return std::visit(AsPlaced{}, shape); }

const Placed* if_placed(const Shape& shape) { return std::get_if<Placed>(&shape); }

bool is_hull(const Shape& shape) { return std::holds_alternative<HullBody>(shape); }

Pair pair_of(const Shape& agent, const Shape& obstacle, const PairOptions& options) {
  const auto* flat_agent = std::get_if<CombinedEllipse>(&agent);
  const auto* flat_obstacle = std::get_if<CombinedEllipse>(&obstacle);
  if (flat_agent && flat_obstacle) return Pair(*flat_agent, *flat_obstacle, options);
  return Pair(placed(agent), placed(obstacle), options);
}

std::optional<Eigen::Vector3d> support_point(const Shape& shape, const Eigen::Vector3d& n) {
  return std::visit(Farthest{n}, shape);
}

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
