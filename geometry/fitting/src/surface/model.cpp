// SPDX-License-Identifier: BSD-3-Clause
#include "surface/model.h"

#include <ceres/jet.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "surface/secular_foot.h"

namespace vericone::fitting {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

/// G^T G of the triangular factor in `p`, the diagonal in logarithms.
template <typename T>
Matrix3<T> ellipsoid_matrix(bool planar, const T* p) {
  Matrix3<T> g = Matrix3<T>::Constant(T(0));
  using std::exp;
  if (planar) {
    g(0, 0) = exp(p[0]);
    g(1, 1) = exp(p[1]);
    g(1, 0) = p[2];
  } else {
    for (int i = 0; i < 3; ++i) g(i, i) = exp(p[i]);
    g(1, 0) = p[3];
    g(2, 0) = p[4];
    g(2, 1) = p[5];
  }
  return g.transpose() * g;
}

/// The matrix of a delimiter: p holds v, then the factor K by its columns.
template <typename T>
Matrix3<T> delimiter_matrix(const SurfaceModel::Delimiting& form, const T* p) {
  using std::sqrt;
  const Vector3<T> v(p[0], p[1], p[2]);
  const Vector3<T> from = form.axes.col(0).cast<T>(), to = v / sqrt(v.dot(v));
  // The least rotation that takes the first axis to v, on the two others.
  const Vector3<T> c = from.cross(to);
  const T denominator = T(1) + from.dot(to);
  const auto turned = [&](const Vector3d& axis) -> Vector3<T> {
    const Vector3<T> e = axis.cast<T>(), ce = c.cross(e);
    return e + ce + c.cross(ce) / denominator;
  };
  const Vector3<T> e1 = turned(form.axes.col(1)), e2 = turned(form.axes.col(2));
  const Vector3<T> k1 = e1 * p[3] + e2 * p[4], k2 = e2 * p[5];
  const Matrix3<T> m = v * v.transpose() - k1 * k1.transpose() - k2 * k2.transpose();
  return form.sheets == 2 ? m : Matrix3<T>(-m);
}

constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};

/// Value, principal axes and derivatives of one matrix from `function(parameters)`.
template <typename Function>
Surfaces::Surface surface(const Parameters& parameters, int first, int count, const Function& function) {
  using Jet = ceres::Jet<double, 6>;
  Jet p[6];
  for (int i = 0; i < count; ++i) p[i] = Jet(parameters(first + i), i);
  const Matrix3<Jet> m = function(static_cast<const Jet*>(p));
  Surfaces::Surface s;
  s.first = first;
  s.count = count;
  for (int i = 0; i < 6; ++i) {
    s.matrix(kRow[i], kColumn[i]) = s.matrix(kColumn[i], kRow[i]) = m(kRow[i], kColumn[i]).a;
    s.derivative.row(i) = (i < 3 ? 1 : 2) * m(kRow[i], kColumn[i]).v.transpose();
  }
  const auto solver = symmetric_eigen<3>(s.matrix);
  s.eigenvalues = solver.values;
  s.axes = solver.vectors;
  return s;
}

Vector6 products(const Vector3d& z) {
  Vector6 zz;
  for (int i = 0; i < 6; ++i) zz(i) = z(kRow[i]) * z(kColumn[i]);
  return zz;
}

/// The surface that is first when distances are taken to first order.
std::size_t first_guess(const std::vector<Surfaces::Surface>& all, const Vector3d& y) {
  std::size_t guess = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < all.size() && all.size() > 1; ++i) {
    const Vector3d my = all[i].matrix * y;
    const double distance = (y.dot(my) - 1) / my.norm();
    if (!(distance > most)) continue;
    most = distance;
    guess = i;
  }
  return guess;
}

/// Whether it is certain that the signed distance to the surface is below `distance`, without computing it:
/// y is inside, and so is the ball about y of that depth.
bool is_farther(const Surfaces::Surface& s, const Vector3d& y, double distance) {
  constexpr double kCertain = 1 - 1e-9;
  const Vector3d my = s.matrix * y;
  const double depth = std::max(0.0, -distance);
  return y.dot(my) + 2 * depth * my.norm() + depth * depth * std::max(0.0, s.eigenvalues(2)) < kCertain;
}

/// Nearest point of the curve where two surfaces meet, if it is that of the body: multipliers not negative.
struct Rim {
  Vector3d point;
  double first, second;  // y - z = first M1 z + second M2 z
};

std::optional<Rim> rim(const Matrix3d& m1, const Matrix3d& m2, const Vector3d& y, const Vector3d& start,
                       double multiplier) {
  Eigen::Matrix<double, 5, 1> x, f;
  x << start, multiplier, 0;
  for (int i = 0; i < 30; ++i) {
    const Vector3d z = x.head<3>(), n1 = m1 * z, n2 = m2 * z;
    Eigen::Matrix<double, 5, 5> j = Eigen::Matrix<double, 5, 5>::Zero();
    j.topLeftCorner<3, 3>() = Matrix3d::Identity() + x(3) * m1 + x(4) * m2;
    j.block<3, 1>(0, 3) = n1;
    j.block<3, 1>(0, 4) = n2;
    j.block<1, 3>(3, 0) = n1.transpose();
    j.block<1, 3>(4, 0) = n2.transpose();
    f << z + x(3) * n1 + x(4) * n2 - y, 0.5 * (z.dot(n1) - 1), 0.5 * (z.dot(n2) - 1);
    const Eigen::Matrix<double, 5, 1> step = j.partialPivLu().solve(f);
    x -= step;
    if (!(x.head<3>().norm() < 1e6)) return std::nullopt;
    if (step.head<3>().norm() <= 1e-15 * (1 + x.head<3>().norm())) {
      if (!(x(3) >= 0 && x(4) >= 0)) return std::nullopt;
      return Rim{x.head<3>(), x(3), x(4)};
    }
  }
  return std::nullopt;
}

}  // namespace

Parameters ellipsoid_parameters(bool planar, const Vector3d& center, const Matrix3d& matrix) {
  // G^T G = M with G lower triangular: the Cholesky factor of the matrix read backwards.
  const int d = planar ? 2 : 3;
  const Eigen::MatrixXd m = matrix.topLeftCorner(d, d).reverse();
  const Eigen::MatrixXd g = Eigen::MatrixXd(m.llt().matrixU()).reverse();
  Parameters p(planar ? 5 : 9);
  p.head(d) = center.head(d);
  p.segment(d, d) = g.diagonal().array().log();
  p(2 * d) = g(1, 0);
  if (!planar) p.tail<2>() << g(2, 0), g(2, 1);
  return p;
}

void append_delimiter(SurfaceModel& model, Parameters& parameters, int sheets, const Vector3d& semi_axes,
                      const Matrix3d& axes) {
  model.delimiters.push_back({sheets, axes});
  const Eigen::Index n = parameters.size();
  parameters.conservativeResize(n + 6);
  parameters.segment<3>(n) = axes.col(0) / semi_axes(0);
  parameters.tail<3>() << 1 / semi_axes(1), 0, 1 / semi_axes(2);
}

Surfaces::Surfaces(const SurfaceModel& model, const Parameters& parameters)
    : planar_(model.planar), size_(model.size()), center_size_(model.center_size()) {
  center_ = Vector3d::Zero();
  center_.head(center_size_) = parameters.head(center_size_);
  all_.push_back(surface(parameters, center_size_, model.ellipsoid_size() - center_size_,
                         [&](const auto* p) { return ellipsoid_matrix(planar_, p); }));
  int first = model.ellipsoid_size();
  for (const SurfaceModel::Delimiting& form : model.delimiters) {
    all_.push_back(surface(parameters, first, 6, [&](const auto* p) { return delimiter_matrix(form, p); }));
    first += 6;
  }
}

double Surfaces::distance(const Vector3d& x, double* gradient) const {
  Vector3d y = x - center_;
  if (planar_) y.z() = 0;
  std::size_t active = first_guess(all_, y);
  SecularFoot foot = secular_foot(all_[active].eigenvalues, all_[active].axes.transpose() * y);
  for (std::size_t i = 0, guess = active; i < all_.size(); ++i) {
    if (i == guess || is_farther(all_[i], y, foot.distance)) continue;
    const SecularFoot f = secular_foot(all_[i].eigenvalues, all_[i].axes.transpose() * y);
    if (f.distance <= foot.distance) continue;
    active = i;
    foot = f;
  }
  Vector3d z = all_[active].axes * foot.point;
  std::size_t other = active;
  std::optional<Rim> corner;
  if (foot.distance > 0) {
    double worst = 1e-14;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const double value = z.dot(all_[i].matrix * z) - 1;
      if (i == active || value <= worst) continue;
      worst = value;
      other = i;
    }
    if (other != active) corner = rim(all_[active].matrix, all_[other].matrix, y, z, foot.multiplier);
  }
  double distance = foot.distance, scale = 0;
  Vector3d normal = all_[active].matrix * z;
  if (corner) {
    z = corner->point;
    normal = y - z;
    distance = normal.norm();
    scale = distance;
    normal /= distance;
  } else {
    scale = normal.norm();
    normal /= scale;
  }
  if (!gradient) return distance;
  Eigen::Map<Eigen::VectorXd> g(gradient, size_);
  g.setZero();
  g.head(center_size_) = -normal.head(center_size_);
  const Vector6 zz = products(z) / (2 * scale);
  const auto add = [&](const Surface& s, double factor) {
    g.segment(s.first, s.count) += factor * (s.derivative.transpose() * zz).head(s.count);
  };
  add(all_[active], corner ? corner->first : 1);
  if (corner) add(all_[other], corner->second);
  return distance;
}

double Surfaces::ellipsoid_distance(const Vector3d& x) const {
  Vector3d y = x - center_;
  if (planar_) y.z() = 0;
  return secular_foot(all_[0].eigenvalues, all_[0].axes.transpose() * y).distance;
}

CombinedEllipsoid Surfaces::body() const {
  Matrix3d axes = all_[0].axes;
  if (axes.determinant() < 0) axes.col(2) *= -1;
  std::vector<Delimiter<3>> delimiters;
  for (std::size_t i = 1; i < all_.size(); ++i) delimiters.push_back({all_[i].matrix, 1});
  const Ellipsoid ellipsoid = Ellipsoid::from_axes(center_, semi_axes(), axes);
  return CombinedEllipsoid::trusted(ellipsoid, std::move(delimiters));
}

Ellipse Surfaces::footprint() const {
  const auto solver = symmetric_eigen<2>(all_[0].matrix.topLeftCorner<2, 2>());
  Eigen::Matrix2d axes = solver.vectors;
  if (axes.determinant() < 0) axes.col(1) *= -1;
  return Ellipse::from_axes(center_.head<2>(), solver.values.cwiseSqrt().cwiseInverse(), axes);
}

Vector3d Surfaces::semi_axes() const {
  Vector3d a = Vector3d::Zero();  // planar: the first eigenvalue is 0
  const int d = center_size_;
  a.head(d) = all_[0].eigenvalues.tail(d).cwiseSqrt().cwiseInverse();
  return a;
}

Eigen::MatrixXd Surfaces::semi_axes_derivative() const {
  const int d = center_size_;
  const Surface& s = all_[0];
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(3, size_);
  for (int k = 0; k < d; ++k) {
    const int column = 3 - d + k;
    const Vector6 vv = products(s.axes.col(column));
    const double factor = -0.5 * std::pow(s.eigenvalues(column), -1.5);
    j.row(k).segment(s.first, s.count) = factor * (s.derivative.transpose() * vv).head(s.count).transpose();
  }
  return j;
}

}  // namespace vericone::fitting
