// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/ellipsoid.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/quadric.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

namespace vericone {

const char VERICONE_COMPILED_ALIKE = 0;

namespace {

template <typename Derived>
std::string text(const Eigen::MatrixBase<Derived>& m) {
  std::string out = "[";
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    if (i) out += ", ";
    if (m.cols() > 1) out += "[";
    for (Eigen::Index j = 0; j < m.cols(); ++j) out += (j ? ", " : "") + to_text(m(i, j));
    if (m.cols() > 1) out += "]";
  }
  return out + "]";
}

template <int D>
void require_finite(const Eigen::Matrix<double, D, 1>& v, const char* field) {
  for (int i = 0; i < D; ++i)
    if (!std::isfinite(v(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(v(i)), "a finite number");
}

template <int D>
Eigen::Matrix<double, D, D> validated_rotation(const Eigen::Matrix<double, D, D>& r) {
  using Matrix = Eigen::Matrix<double, D, D>;
  if (!r.allFinite()) throw InputError("rotation", text(r), "a matrix of finite numbers");
  Matrix beyond = r.transpose() * r;
  beyond.diagonal().array() -= 1;
  const double defect = beyond.cwiseAbs().maxCoeff();
  if (defect > 1e-6) throw InputError("rotation", text(r), "orthonormal to 1e-6 (R^T R = I)");
  if (r.determinant() < 0)
    throw InputError("rotation", text(r), "a rotation, determinant +1, not a reflection");
  if (defect <= 4 * std::numeric_limits<double>::epsilon())
    return r;  // as good as it gets: keep the caller's bits
  return nearest_orthogonal<D>(r);
}

/// Lower Cholesky factor of S, computed with 50 digits and rounded once: in double the thin axis of a body
/// with axis ratio 1e6 would carry a relative error of 1e-4 (eps times the squared ratio).
template <int D>
Eigen::Matrix<double, D, D> wide_cholesky(const Eigen::Matrix<double, D, D>& s) {
  using Wide = boost::multiprecision::cpp_bin_float_50;
  std::array<std::array<Wide, D>, D> l;
  Eigen::Matrix<double, D, D> f = Eigen::Matrix<double, D, D>::Zero();
  for (int j = 0; j < D; ++j)
    for (int i = j; i < D; ++i) {
      Wide sum = s(i, j);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? Wide(sqrt(sum)) : Wide(sum / l[j][j]);
      f(i, j) = static_cast<double>(l[i][j]);
    }
  return f;
}

/// F F^T, symmetric bit for bit, which a plain product need not be.
template <int D>
Eigen::Matrix<double, D, D> gram(const Eigen::Matrix<double, D, D>& f) {
  Eigen::Matrix<double, D, D> s;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j <= i; ++j) s(i, j) = s(j, i) = f.row(i).dot(f.row(j));
  return s;
}

template <int D>
bool surely_positive_definite(const Eigen::Matrix<double, D, D>& s) {
  // With unit diagonal, |off-diagonal| <= 1/4 makes the matrix diagonally dominant for D <= 3.
  const Eigen::Matrix<double, D, 1> d = s.diagonal();
  if (!(d.minCoeff() > 1e-100) || !(d.maxCoeff() < 1e100)) return false;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < i; ++j)
      if (!(16 * s(i, j) * s(i, j) < 0.99 * d(i) * d(j))) return false;
  return true;
}

}  // namespace

template <int D>
BasicEllipsoid<D> BasicEllipsoid<D>::from_axes(const Vector& center, const Vector& semi_axes,
                                               const Matrix& rotation) {
  require_finite<D>(center, "center");
  for (int i = 0; i < D; ++i)
    if (!std::isfinite(semi_axes(i)) || !(semi_axes(i) > 0))
      throw InputError("semi_axes[" + std::to_string(i) + "]", to_text(semi_axes(i)),
                       "a positive finite number (metres)");
  BasicEllipsoid e;
  e.center_ = center;
  e.factor_ = validated_rotation<D>(rotation) * semi_axes.asDiagonal();
  e.shape_ = gram<D>(e.factor_);
  e.defined_by_factor_ = true;
  if (!e.shape_.allFinite() || e.shape_.diagonal().minCoeff() <= 0)
    throw InputError("semi_axes", text(semi_axes), "between 1e-150 and 1e150, their squares are needed");
  return e;
}

template <int D>
BasicEllipsoid<D> BasicEllipsoid<D>::from_shape(const Vector& center, const Matrix& shape) {
  require_finite<D>(center, "center");
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      const std::string entry = "shape[" + std::to_string(i) + "][" + std::to_string(j) + "]";
      if (!std::isfinite(shape(i, j))) throw InputError(entry, to_text(shape(i, j)), "a finite number");
      if (j > i && shape(i, j) != shape(j, i))
        throw InputError("shape", text(shape),
                         "symmetric, but [" + std::to_string(i) + "][" + std::to_string(j) +
                             "] differs from [" + std::to_string(j) + "][" + std::to_string(i) + "]");
    }
  if (!surely_positive_definite<D>(shape) && !exact::positive_definite<D>(exact::to_rational<D>(shape)))
    throw InputError("shape", text(shape), "positive definite (its eigenvalues are the squared semi-axes)");
  BasicEllipsoid e;
  e.center_ = center;
  e.shape_ = shape;
  e.factor_ = wide_cholesky<D>(shape);
  e.defined_by_factor_ = false;
  if (!e.factor_.allFinite() || e.factor_.diagonal().minCoeff() <= 0)
    throw InputError("shape", text(shape), "that of a body with semi-axes between 1e-150 and 1e150");
  return e;
}

template <int D>
BasicEllipsoid<D> BasicEllipsoid<D>::from_quadric(const BasicQuadric<D>& quadric) {
  using exact::Rational;
  const auto& q = quadric.matrix();
  const auto refuse = [&] { throw InputError("quadric", text(q), "the matrix of a real ellipsoid"); };
  // Q = [A b; b^T d]. Centre p = -A^{-1} b; (x-p)^T A (x-p) = p^T A p - d =: k, so S = k A^{-1}.
  exact::RationalMatrix<D> a = exact::to_rational<D>(Matrix(q.template topLeftCorner<D, D>()));
  exact::RationalVector<D> b = exact::to_rational<D>(Vector(q.template topRightCorner<D, 1>()));
  Rational d(q(D, D));
  if (a[0][0] < 0) {
    for (auto& row : a)
      for (auto& x : row) x = -x;
    for (auto& x : b) x = -x;
    d = -d;
  }
  if (!exact::positive_definite<D>(a)) refuse();
  const Rational det = exact::determinant<D>(a);
  exact::RationalMatrix<D> inverse;
  if constexpr (D == 2) {
    inverse = {{{a[1][1] / det, -a[0][1] / det}, {-a[0][1] / det, a[0][0] / det}}};
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
        inverse[i][j] = (a[r0][c0] * a[r1][c1] - a[r0][c1] * a[r1][c0]) / det;
      }
  }
  exact::RationalVector<D> p;
  Rational k = -d;
  for (int i = 0; i < D; ++i) {
    p[i] = 0;
    for (int j = 0; j < D; ++j) p[i] -= inverse[i][j] * b[j];
    k -= b[i] * p[i];
  }
  if (k.sign() <= 0) refuse();
  Vector center;
  Matrix shape;
  for (int i = 0; i < D; ++i) {
    center(i) = static_cast<double>(p[i]);
    for (int j = 0; j < D; ++j) shape(i, j) = static_cast<double>(Rational(k * inverse[i][j]));
  }
  try {
    return from_shape(center, shape);
  } catch (const InputError& error) {  // out of the range of double, or too thin for it
    throw InputError(
        "quadric", text(q),
        "that of an ellipsoid within double precision, but its " + error.field() + " is " + error.value());
  }
}

template <int D>
typename BasicEllipsoid<D>::Vector BasicEllipsoid<D>::semi_axes() const {
  return singular_values<D>(factor_);
}

template <int D>
typename BasicEllipsoid<D>::Matrix BasicEllipsoid<D>::axis_directions() const {
  return left_singular<D>(factor_).u;
}

template <int D>
BasicQuadric<D> BasicEllipsoid<D>::quadric() const {
  // With G = F^{-1}: |G (x - p)|^2 - 1.
  const Matrix g = factor_.inverse();
  const Matrix a = g.transpose() * g;
  Eigen::Matrix<double, D + 1, D + 1> q;
  const Vector b = -(a * center_), at = g * center_;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j <= i; ++j) q(i, j) = q(j, i) = a(i, j);
    q(i, D) = q(D, i) = b(i);
  }
  q(D, D) = at.squaredNorm() - 1;
  return BasicQuadric<D>(q);
}

template <int D>
double BasicEllipsoid<D>::volume() const {
  const double unit_ball = D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  return unit_ball * std::abs(factor_.determinant());
}

template <int D>
BasicEllipsoid<D> BasicEllipsoid<D>::translated(const Vector& by) const {
  BasicEllipsoid e = *this;
  e.center_ += by;
  require_finite<D>(e.center_, "center");
  return e;
}

template <int D>
BasicEllipsoid<D> BasicEllipsoid<D>::scaled(double scale) const {
  if (!std::isfinite(scale) || !(scale > 0))
    throw InputError("scale", to_text(scale), "a positive finite number");
  BasicEllipsoid e = *this;
  e.center_ *= scale;
  e.factor_ *= scale;
  e.shape_ = gram<D>(e.factor_);
  e.defined_by_factor_ = true;
  require_finite<D>(e.center_, "center");
  if (!e.shape_.allFinite() || e.shape_.diagonal().minCoeff() <= 0)
    throw InputError("scale", to_text(scale), "one that leaves the semi-axes between 1e-150 and 1e150");
  return e;
}

template class BasicEllipsoid<2>;
template class BasicEllipsoid<3>;

Eigen::Matrix2d rotation_2d(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

Eigen::Matrix3d rotation_3d(const Eigen::Vector4d& wxyz) {
  if (!wxyz.allFinite())
    throw InputError("rotation", text(wxyz), "a quaternion [w, x, y, z] of finite numbers");
  const double norm2 = wxyz.squaredNorm();
  if (!(std::abs(norm2 - 1) <= 2e-6))
    throw InputError("rotation", text(wxyz), "a unit quaternion [w, x, y, z] (|q| = 1 to 1e-6)");
  const double w = wxyz(0), x = wxyz(1), y = wxyz(2), z = wxyz(3), s = 2 / norm2;
  return (Eigen::Matrix3d() << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),
          s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),  //
          s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y))
      .finished();
}

Eigen::Matrix3d rotation_from_heading(double azimuth, double elevation) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation),
               se = std::sin(elevation);
  return (Eigen::Matrix3d() << ca * ce, -sa, -ca * se, sa * ce, ca, -sa * se, se, 0, ce).finished();
}

}  // namespace vericone
