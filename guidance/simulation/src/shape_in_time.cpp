// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/shape_in_time.h>

#include <vericone/geometry/error.h>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "orthonormal.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Below this the hyperboloid cuts off less than rounding tells.
constexpr double kPlain = 1e-12;
/// Lengths are rounded up by this.
constexpr double kUp = 1 + 1e-14;

template <typename... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <typename... F>
Overloaded(F...) -> Overloaded<F...>;  // clang 14 does not find it by itself

/// What a planar shape sees of a rotation.
Matrix2d about_z(const Matrix3d& rotation) {
  const double c = rotation(0, 0), s = rotation(1, 0), length = std::hypot(c, s);
  if (!(length > 0)) return Matrix2d::Identity();
  return (Matrix2d() << c, -s, s, c).finished() / length;
}

template <int D>
Eigen::Matrix<double, D, D> rotation_of(const Matrix3d& rotation) {
  if constexpr (D == 2) {
    return about_z(rotation);
  } else {
    return rotation;
  }
}

/// R M R^T, symmetric bit for bit.
template <int D>
Eigen::Matrix<double, D, D> turned(const Eigen::Matrix<double, D, D>& r,
                                   const Eigen::Matrix<double, D, D>& m) {
  const Eigen::Matrix<double, D, D> image = r * m * r.transpose();
  return 0.5 * (image + image.transpose());
}

/// The image of an ellipsoid about the origin; defined by its factor, as exact predicates want it.
template <int D>
BasicEllipsoid<D> posed(const BasicEllipsoid<D>& e, const Eigen::Matrix<double, D, 1>& position,
                        const Eigen::Matrix<double, D, D>& rotation) {
  using Matrix = Eigen::Matrix<double, D, D>;
  using Vector = Eigen::Matrix<double, D, 1>;
  const Matrix& f = e.factor();
  Vector axes = f.colwise().norm().transpose();
  Matrix directions = f * axes.cwiseInverse().asDiagonal();
  // A factor from axes has them along its columns; one from a shape matrix has not.
  const Matrix gram = directions.transpose() * directions - Matrix::Identity();
  if (!(gram.cwiseAbs().maxCoeff() < 1e-12)) {
    axes = e.semi_axes();
    directions = e.axis_directions();
  }
  if (directions.determinant() < 0) directions.col(0) = -directions.col(0);
  return BasicEllipsoid<D>::from_axes(position, axes, orthonormal<D>(rotation * directions));
}

template <int D>
BasicCombined<D> posed(const BasicCombined<D>& body, const Eigen::Matrix<double, D, 1>& position,
                       const Eigen::Matrix<double, D, D>& rotation) {
  const BasicEllipsoid<D> ellipsoid = posed<D>(body.ellipsoid(), position, rotation);
  if (body.is_ellipsoid()) return ellipsoid;
  const Eigen::Matrix<double, D, D> r = orthonormal<D>(rotation);
  std::vector<Delimiter<D>> delimiters;
  delimiters.reserve(body.delimiters().size());
  for (const Delimiter<D>& d : body.delimiters()) delimiters.push_back({turned<D>(r, d.matrix), d.level});
  return BasicCombined<D>::trusted(ellipsoid, std::move(delimiters));
}

/// x_1^2 / a_1^2 - (the other terms) <= 1 in turned axes.
template <int D>
Eigen::Matrix<double, D, D> dents(const Eigen::Matrix<double, D, 1>& semi_axes,
                                  const Eigen::Matrix<double, D, D>& rotation) {
  Eigen::Matrix<double, D, 1> d = -semi_axes.cwiseAbs2().cwiseInverse();
  d(0) = -d(0);
  const Eigen::Matrix<double, D, D> m = d.asDiagonal();
  return turned<D>(rotation, m);
}

/// (5.5) and its counterpart: the ellipsoid of the largest k, the hyperboloid of the least.
template <int D>
BasicCombined<D> dented(const Eigen::Matrix<double, D, 1>& semi_axes, double least, double most,
                        const Vector3d& position, const Matrix3d& rotation) {
  const Eigen::Matrix<double, D, D> r = orthonormal<D>(rotation_of<D>(rotation));
  least = std::clamp(least, 0.0, 1.0);
  most = std::clamp(most, 0.0, 1.0);
  const auto ellipsoid = BasicEllipsoid<D>::from_axes(position.head<D>(), semi_axes * std::sqrt(1 + most), r);
  if (least + most < 2 * kPlain) return ellipsoid;
  return BasicCombined<D>::trusted(ellipsoid, {{dents<D>(semi_axes, r), 1 - least}});
}

/// Bounds of k over all times.
Oscillation::Range always(const Oscillation& k) {
  if (k.rate == 0) return k.range(0, 0);
  const double size = std::abs(k.amplitude), low = k.offset - size, high = k.offset + size;
  if (!k.absolute) return {low, high};
  return {low > 0 ? low : high < 0 ? -high : 0, std::max(std::abs(low), std::abs(high))};
}

void require_positive(double x, const std::string& field) {
  if (!std::isfinite(x) || !(x > 0)) throw InputError(field, to_text(x), "a positive finite number (metres)");
}

void check_k(const Oscillation& k) {
  for (const auto& [name, x] : {std::pair("offset", k.offset), std::pair("amplitude", k.amplitude),
                                std::pair("rate", k.rate), std::pair("phase", k.phase)})
    if (!std::isfinite(x)) throw InputError(std::string("k.") + name, to_text(x), "a finite number");
  constexpr double kRounding = 1e-12;
  const Oscillation::Range all = always(k);
  if (!(all.low >= -kRounding) || !(all.high <= 1 + kRounding))
    throw InputError("k", "[" + to_text(all.low) + ", " + to_text(all.high) + "]",
                     "between 0 and 1 at every time");
}

void require_about_origin(const Eigen::VectorXd& center) {
  if (!center.isZero(0))
    throw InputError("center", to_text(center.norm()) + " m from the origin",
                     "the origin of the body's own frame");
}

/// Largest distance of a dented body from its centre: where squares of the coordinates are the unknowns, both
/// surfaces are planes and the distance is linear, so it is largest at (a, b sqrt(k)) or b sqrt(1 + k).
double dented_reach(double a, double b, const Oscillation& k) {
  const double most = std::min(always(k).high * kUp, 1.0);
  // A plain ellipsoid is not cut.
  return std::sqrt(std::max(a * a * (1 + 2 * kPlain) + b * b * most, b * b * (1 + most))) * kUp;
}

/// To the farthest corner of the bounds, which may be farther than any point of the body.
double placed_reach(const Placed& body) {
  const Box bounds = body.body.bounds();
  const HullBody corners = HullBody::box(bounds.low, bounds.high);
  double most = 0;
  for (const Vector3d& corner : corners.points()) most = std::max(most, body.pose.to_world(corner).norm());
  return most * (1 + 1e-12);
}

}  // namespace

void check(const ShapeInTime& shape) {
  std::visit(Overloaded{[](const RigidShape& rigid) {
                          if (const auto* p = std::get_if<CombinedEllipse>(&rigid.shape))
                            require_about_origin(p->center());
                          if (const auto* p = std::get_if<CombinedEllipsoid>(&rigid.shape))
                            require_about_origin(p->center());
                        },
                        [](const DentedConic& conic) {
                          require_positive(conic.a_c, "a_c");
                          require_positive(conic.b_c, "b_c");
                          check_k(conic.k);
                        },
                        [](const DentedQuadric& quadric) {
                          for (int i = 0; i < 3; ++i)
                            require_positive(quadric.semi_axes(i), "semi_axes[" + std::to_string(i) + "]");
                          check_k(quadric.k);
                        }},
             shape);
}

bool planar(const ShapeInTime& shape) {
  if (const auto* rigid = std::get_if<RigidShape>(&shape))
    return std::holds_alternative<CombinedEllipse>(rigid->shape);
  return std::holds_alternative<DentedConic>(shape);
}

guidance::Shape shape_at(const ShapeInTime& shape, double t, const Vector3d& position,
                         const Matrix3d& rotation) {
  if (const auto* conic = std::get_if<DentedConic>(&shape)) {
    const double k = conic->k.at(t);
    return dented<2>({conic->a_c, conic->b_c}, k, k, position, rotation);
  }
  if (const auto* quadric = std::get_if<DentedQuadric>(&shape)) {
    const double k = quadric->k.at(t);
    return dented<3>(quadric->semi_axes, k, k, position, rotation);
  }
  const guidance::Shape& rigid = std::get<RigidShape>(shape).shape;
  if (const auto* body = std::get_if<CombinedEllipse>(&rigid))
    return posed<2>(*body, position.head<2>(), about_z(rotation));
  if (const auto* body = std::get_if<CombinedEllipsoid>(&rigid)) return posed<3>(*body, position, rotation);
  if (const auto* body = std::get_if<Placed>(&rigid))
    return Placed(body->body, composed({position, orthonormal<3>(rotation)}, body->pose));
  std::vector<Vector3d> points = std::get<HullBody>(rigid).points();
  for (Vector3d& x : points) x = position + rotation * x;
  return HullBody(std::move(points));
}

guidance::ShapeRate shape_rate_at(const ShapeInTime& shape, double t, const Matrix3d& rotation) {
  guidance::ShapeRate rate;
  // S = (1 + k) R diag(a^2) R^T, level = 1 - k.
  const auto fill = [&](const Oscillation& oscillation) {
    const double slope = oscillation.rate_at(t);
    rate.shape *= slope;
    if (oscillation.at(t) >= kPlain) rate.delimiters.push_back({Matrix3d::Zero(), -slope});
  };
  if (const auto* conic = std::get_if<DentedConic>(&shape)) {
    const Matrix2d squares = Vector2d(conic->a_c, conic->b_c).cwiseAbs2().asDiagonal();
    rate.shape.topLeftCorner<2, 2>() = turned<2>(about_z(rotation), squares);
    fill(conic->k);
  } else if (const auto* quadric = std::get_if<DentedQuadric>(&shape)) {
    const Matrix3d squares = quadric->semi_axes.cwiseAbs2().asDiagonal();
    rate.shape = turned<3>(rotation, squares);
    fill(quadric->k);
  }
  return rate;
}

guidance::Shape shape_over(const ShapeInTime& shape, double from, double to, const Vector3d& position,
                           const Matrix3d& rotation) {
  if (const auto* conic = std::get_if<DentedConic>(&shape)) {
    const Oscillation::Range k = conic->k.range(from, to);
    return dented<2>(Vector2d(conic->a_c, conic->b_c), k.low, k.high, position, rotation);
  }
  if (const auto* quadric = std::get_if<DentedQuadric>(&shape)) {
    const Oscillation::Range k = quadric->k.range(from, to);
    return dented<3>(quadric->semi_axes, k.low, k.high, position, rotation);
  }
  return shape_at(shape, from, position, rotation);
}

double reach(const ShapeInTime& shape) {
  if (const auto* conic = std::get_if<DentedConic>(&shape))
    return dented_reach(conic->a_c, conic->b_c, conic->k);
  if (const auto* quadric = std::get_if<DentedQuadric>(&shape))
    return dented_reach(quadric->semi_axes(0), quadric->semi_axes.tail<2>().maxCoeff(), quadric->k);
  const guidance::Shape& rigid = std::get<RigidShape>(shape).shape;
  if (const auto* body = std::get_if<CombinedEllipse>(&rigid))
    return body->ellipsoid().semi_axes().maxCoeff() * kUp;
  if (const auto* body = std::get_if<CombinedEllipsoid>(&rigid))
    return body->ellipsoid().semi_axes().maxCoeff() * kUp;
  if (const auto* body = std::get_if<Placed>(&rigid)) return placed_reach(*body);
  double most = 0;
  for (const Vector3d& x : std::get<HullBody>(rigid).points()) most = std::max(most, x.norm());
  return most * kUp;
}

}  // namespace vericone::simulation
