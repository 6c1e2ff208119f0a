// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/world_body.h>
#include <vericone/internal/geometry/rotation.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace vericone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int D>
using Matrix = Eigen::Matrix<double, D, D>;
template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

/// Lengths are rounded up by this.
constexpr double kUp = 1 + 1e-14;

template <int D>
BasicEllipsoid<D> changed(const BasicEllipsoid<D>& body, const Vector<D>& center, const Matrix<D>& rotation,
                          const Matrix<D>& rate, double dt) {
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
BasicCombined<D> changed(const BasicCombined<D>& body, const Vector<D>& center, const Matrix<D>& rotation,
                         const BodyRate& rate, double dt) {
  std::vector<Delimiter<D>> delimiters = body.delimiters();
  for (std::size_t i = 0; i < delimiters.size(); ++i) {
    Delimiter<D>& d = delimiters[i];
    if (i < rate.delimiters.size()) {
      d.matrix += dt * rate.delimiters[i].matrix.template topLeftCorner<D, D>();
      d.level = std::max(d.level + dt * rate.delimiters[i].level, 0.0);
    }
    d.matrix = turned<D>(rotation, d.matrix);
  }
  const Matrix<D> shape_rate = rate.shape.topLeftCorner<D, D>();
  return BasicCombined<D>::trusted(changed<D>(body.ellipsoid(), center, rotation, shape_rate, dt),
                                   std::move(delimiters));
}

struct Moved {
  const Vector3d &from, &to, &turn;
  const BodyRate& rate;
  double dt;

  Matrix3d rotation() const {
    const double angle = turn.norm();
    if (!(angle > 0)) return Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  }

  WorldBody operator()(const CombinedEllipse& body) const {
    return changed<2>(body, to.head<2>(), rotation_2d(turn.z()), rate, dt);
  }
  WorldBody operator()(const CombinedEllipsoid& body) const {
    return changed<3>(body, to, rotation(), rate, dt);
  }
  WorldBody operator()(const HullBody& hull) const {
    const Matrix3d r = rotation();
    std::vector<Vector3d> points = hull.points();
    for (Vector3d& x : points) x = to + r * (x - from);
    return HullBody(std::move(points));
  }
  WorldBody operator()(const Placed& body) const {
    const Matrix3d r = rotation();
    return Placed(body.body, {to + r * (body.pose.position - from), r * body.pose.rotation});
  }
};

/// The image of an ellipsoid about the origin; defined by its factor, as exact predicates want it.
template <int D>
BasicEllipsoid<D> image(const BasicEllipsoid<D>& e, const Vector<D>& position, const Matrix<D>& rotation) {
  const Matrix<D>& f = e.factor();
  Vector<D> axes = f.colwise().norm().transpose();
  Matrix<D> directions = f * axes.cwiseInverse().asDiagonal();
  // A factor from axes has them along its columns; one from a shape matrix has not.
  const Matrix<D> gram = directions.transpose() * directions - Matrix<D>::Identity();
  if (!(gram.cwiseAbs().maxCoeff() < 1e-12)) {
    axes = e.semi_axes();
    directions = e.axis_directions();
  }
  if (directions.determinant() < 0) directions.col(0) = -directions.col(0);
  return BasicEllipsoid<D>::from_axes(position, axes, orthonormal<D>(rotation * directions));
}

template <int D>
BasicCombined<D> image(const BasicCombined<D>& body, const Vector<D>& position, const Matrix<D>& rotation) {
  const BasicEllipsoid<D> ellipsoid = image<D>(body.ellipsoid(), position, rotation);
  if (body.is_ellipsoid()) return ellipsoid;
  const Matrix<D> r = orthonormal<D>(rotation);
  std::vector<Delimiter<D>> delimiters;
  delimiters.reserve(body.delimiters().size());
  for (const Delimiter<D>& d : body.delimiters()) delimiters.push_back({turned<D>(r, d.matrix), d.level});
  return BasicCombined<D>::trusted(ellipsoid, std::move(delimiters));
}

struct Image {
  const Vector3d& position;
  const Matrix3d& rotation;

  WorldBody operator()(const CombinedEllipse& body) const {
    return image<2>(body, position.head<2>(), rotation_of<2>(rotation));
  }
  WorldBody operator()(const CombinedEllipsoid& body) const { return image<3>(body, position, rotation); }
  WorldBody operator()(const HullBody& hull) const {
    std::vector<Vector3d> points = hull.points();
    for (Vector3d& x : points) x = position + rotation * x;
    return HullBody(std::move(points));
  }
  WorldBody operator()(const Placed& body) const {
    return Placed(body.body, composed({position, orthonormal<3>(rotation)}, body.pose));
  }
};

struct Reach {
  template <int D>
  double operator()(const BasicCombined<D>& body) const {
    return body.ellipsoid().semi_axes().maxCoeff() * kUp;
  }
  double operator()(const HullBody& hull) const {
    double most = 0;
    for (const Vector3d& x : hull.points()) most = std::max(most, x.norm());
    return most * kUp;
  }
  double operator()(const Placed& body) const {
    const Box bounds = body.body.bounds();
    const HullBody corners = HullBody::box(bounds.low, bounds.high);
    double most = 0;
    for (const Vector3d& corner : corners.points()) most = std::max(most, body.pose.to_world(corner).norm());
    return most * (1 + 1e-12);
  }
};

template <int D>
BasicCombined<D> inflated_by(const BasicCombined<D>& body, double distance) {
  constexpr double kWider = 1 + 1e-12;
  const BasicEllipsoid<D>& e = body.ellipsoid();
  const double p = std::sqrt(e.shape().trace() / D) / distance;
  Matrix<D> shape = (1 + 1 / p) * kWider * e.shape();
  shape.diagonal().array() += (1 + p) * kWider * distance * distance;
  const auto ellipsoid = BasicEllipsoid<D>::from_shape(e.center(), shape);
  std::vector<Delimiter<D>> delimiters;
  for (const Delimiter<D>& d : body.delimiters()) {
    const double level =
        (d.level + 2 * distance * (d.matrix * e.factor()).norm() + distance * distance * d.matrix.norm()) *
        kWider;
    const Matrix<D> seen = ellipsoid.factor().transpose() * d.matrix * ellipsoid.factor();
    const double most = symmetric_eigenvalues<D>(0.5 * (seen + seen.transpose()))(D - 1);
    // One that hardly cuts any more is left out: the body only grows.
    if (most > level * (1 + 1e-9)) delimiters.push_back({d.matrix, level});
  }
  return BasicCombined<D>::trusted(ellipsoid, std::move(delimiters));
}

using Point = std::optional<Vector3d>;

struct Farthest {
  const Vector3d& n;

  Point operator()(const CombinedEllipsoid& body) const {
    return body.is_ellipsoid() ? Point(body.ellipsoid().support_point(n)) : std::nullopt;
  }
  Point operator()(const HullBody& hull) const {
    return *std::max_element(hull.points().begin(), hull.points().end(),
                             [this](const Vector3d& x, const Vector3d& y) { return n.dot(x) < n.dot(y); });
  }
  Point operator()(const Convex& body) const { return body.support_point(n); }
  Point operator()(const Placed& body) const {
    const Vector3d seen = body.pose.rotation.transpose() * n;
    const Point own = std::visit(Farthest{seen}, body.body.shape());
    return own ? Point(body.pose.to_world(*own)) : std::nullopt;
  }
  template <typename Other>
  Point operator()(const Other&) const {
    return std::nullopt;
  }
};

template <int D>
BasicEllipsoid<D> containing(const BasicCombined<D>& body) {
  return body.is_ellipsoid() ? body.ellipsoid() : body.bounding_ellipsoid();
}

Ellipsoid containing_by_covariance(const HullBody& hull) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& x : hull.points()) mean += x / double(hull.size());
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& x : hull.points())
    covariance += (x - mean) * (x - mean).transpose() / double(hull.size());
  // Flat hulls, and single points, get a little thickness.
  const double thickness = 1e-6 * covariance.trace() + 1e-24;
  covariance += thickness * Matrix3d::Identity();
  const Cholesky<3> factors = cholesky<3>(covariance);
  double most = 0;
  for (const Vector3d& x : hull.points()) most = std::max(most, factors.half_solve(x - mean).squaredNorm());
  const Matrix3d shape = covariance * (most * (1 + 1e-12) + 1e-12);
  return Ellipsoid::from_shape(mean, (shape + shape.transpose()) / 2);
}

void require_quadric(const WorldBody& body) {
  if (!body.flat() && !body.quadric())
    throw InputError("body", "a hull, or a body with a pose", "an ellipse, an ellipsoid or a combined body");
}

}  // namespace

bool WorldBody::planar() const { return std::holds_alternative<CombinedEllipse>(kind_); }
const CombinedEllipse* WorldBody::flat() const { return std::get_if<CombinedEllipse>(&kind_); }
const CombinedEllipsoid* WorldBody::quadric() const { return std::get_if<CombinedEllipsoid>(&kind_); }
const HullBody* WorldBody::hull() const { return std::get_if<HullBody>(&kind_); }
const Placed* WorldBody::placed() const { return std::get_if<Placed>(&kind_); }

bool WorldBody::delimited() const {
  return (flat() && !flat()->is_ellipsoid()) || (quadric() && !quadric()->is_ellipsoid());
}

Placed WorldBody::as_placed() const {
  if (planar())
    throw InputError("bodies", "one of the plane and one of space", "both of the plane or both of space");
  if (quadric()) return Body(*quadric());
  return hull() ? Placed(Body(*hull())) : *placed();
}

std::optional<Vector3d> WorldBody::support_point(const Vector3d& n) const {
  return std::visit(Farthest{n}, kind_);
}

double WorldBody::gauge(const Vector3d& x) const {
  require_quadric(*this);
  if (flat()) return flat()->gauge(Eigen::Vector2d(x.head<2>() - flat()->center()));
  return quadric()->gauge(x - quadric()->center());
}

Ellipse WorldBody::containing_ellipse() const {
  if (!planar()) throw InputError("body", "one of space", "a planar one");
  return containing(*flat());
}

Ellipsoid WorldBody::containing_ellipsoid() const {
  if (planar()) throw InputError("body", "a planar one", "one of space");
  if (quadric()) return containing(*quadric());
  return hull() ? containing_by_covariance(*hull()) : placed()->containing_ellipsoid();
}

double WorldBody::reach() const { return std::visit(Reach{}, kind_); }

WorldBody WorldBody::posed(const Vector3d& position, const Matrix3d& rotation) const {
  return std::visit(Image{position, rotation}, kind_);
}

WorldBody WorldBody::moved(const Vector3d& from, const Vector3d& to, const Vector3d& turn,
                           const BodyRate& rate, double dt) const {
  return std::visit(Moved{from, to, turn, rate, dt}, kind_);
}

WorldBody WorldBody::inflated(double distance) const {
  require_quadric(*this);
  if (flat()) return inflated_by<2>(*flat(), distance);
  return inflated_by<3>(*quadric(), distance);
}

}  // namespace vericone
