// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/combined.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <vericone/internal/geometry/lengths.h>

namespace vericone {
namespace {

/// The region's matrix where the ellipsoid is the unit ball.
template <int D>
Eigen::Matrix<double, D, D> whitened(const Delimiter<D>& delimiter,
                                     const Eigen::Matrix<double, D, D>& factor) {
  const Eigen::Matrix<double, D, D> m = factor.transpose() * delimiter.matrix * factor;
  return 0.5 * (m + m.transpose());
}

template <int D>
double largest_eigenvalue(const Eigen::Matrix<double, D, D>& m) {
  return symmetric_eigenvalues<D>(m)(D - 1);
}

template <int D>
void validate(const BasicEllipsoid<D>& ellipsoid, const Delimiter<D>& delimiter, const std::string& field) {
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      const double x = delimiter.matrix(i, j);
      const std::string entry = field + ".matrix[" + std::to_string(i) + "][" + std::to_string(j) + "]";
      if (!std::isfinite(x)) throw InputError(entry, to_text(x), "a finite number");
      if (x != delimiter.matrix(j, i))
        throw InputError(entry, to_text(x), "equal to its mirror image: symmetric");
    }
  if (!(delimiter.level >= 0) || !std::isfinite(delimiter.level))
    throw InputError(field + ".level", to_text(delimiter.level),
                     "finite and not negative: the centre is inside");
  const double reach = largest_eigenvalue<D>(whitened<D>(delimiter, ellipsoid.factor()));
  if (!(reach > delimiter.level * (1 + 1e-12)))
    throw InputError(field, "a surface that misses the ellipsoid",
                     "one that cuts it: its nearest point must be inside (now at " +
                         to_text(std::sqrt(delimiter.level / std::max(reach, 1e-300))) +
                         " of the ellipsoid's extent in that direction)");
}

void require_semi_axes(const double* axes, int count) {
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(axes[i]) || !(axes[i] > 1e-150) || !(axes[i] < 1e150))
      throw InputError("semi_axes[" + std::to_string(i) + "]", to_text(axes[i]),
                       "a positive finite number (metres)");
}

/// R diag(d) R^T, symmetric bit for bit.
template <int D>
Eigen::Matrix<double, D, D> turned(const Eigen::Matrix<double, D, D>& r,
                                   const Eigen::Matrix<double, D, 1>& d) {
  Eigen::Matrix<double, D, D> m;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += r(i, k) * d(k) * r(j, k);
      m(i, j) = m(j, i) = sum;
    }
  return m;
}

/// Symmetric bit for bit, which a product of factors need not be.
template <int D>
Eigen::Matrix<double, D, D> symmetric(const Eigen::Matrix<double, D, D>& m) {
  return 0.5 * (m + m.transpose());
}

/// The ellipse { y : |G y| <= 1 } about `center`, G of full rank.
Ellipse ellipse_of(const Eigen::Matrix<double, 3, 2>& g, const Eigen::Vector2d& center) {
  // One Jacobi rotation makes the columns perpendicular: V with G V = U diag(sigma).
  const double p = g.col(0).squaredNorm(), q = g.col(1).squaredNorm(), r = g.col(0).dot(g.col(1));
  const double angle = 0.5 * std::atan2(2 * r, p - q);
  Eigen::Matrix2d v;
  v << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Eigen::Vector2d axes((g * v.col(0)).norm(), (g * v.col(1)).norm());
  return Ellipse::from_axes(center, axes.cwiseInverse(), v);
}

}  // namespace

Delimiter<3> hyperboloid(int sheets, const Eigen::Vector3d& semi_axes, const Eigen::Matrix3d& rotation) {
  if (sheets != 1 && sheets != 2)
    throw InputError("sheets", std::to_string(sheets), "1 (a waist) or 2 (two dents)");
  require_semi_axes(semi_axes.data(), 3);
  // Validates the rotation and makes it orthonormal to rounding.
  const Eigen::Matrix3d r =
      Ellipsoid::from_axes(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), rotation).factor();
  Eigen::Vector3d d = semi_axes.cwiseAbs2().cwiseInverse();
  if (sheets == 2) {
    d.tail<2>() *= -1;
  } else {
    d(0) *= -1;
  }
  return {turned<3>(r, d), 1};
}

Delimiter<2> hyperbola(const Eigen::Vector2d& semi_axes, double angle) {
  require_semi_axes(semi_axes.data(), 2);
  if (!std::isfinite(angle)) throw InputError("angle", to_text(angle), "a finite number (radians)");
  return {turned<2>(rotation_2d(angle),
                    Eigen::Vector2d(1 / (semi_axes(0) * semi_axes(0)), -1 / (semi_axes(1) * semi_axes(1)))),
          1};
}

CombinedEllipse dented_conic(const Eigen::Vector2d& center, double a_c, double b_c, double k, double phi) {
  const Eigen::Vector2d axes(a_c, b_c);
  require_semi_axes(axes.data(), 2);
  if (!(k >= 0 && k <= 1)) throw InputError("k", to_text(k), "between 0 and 1");
  if (!std::isfinite(phi)) throw InputError("phi", to_text(phi), "a finite number (radians)");
  const Eigen::Matrix2d r = rotation_2d(phi);
  const Ellipse ellipse = Ellipse::from_axes(center, axes * std::sqrt(1 + k), r);
  if (k == 0) return ellipse;  // the hyperbola touches it
  return CombinedEllipse::trusted(
      ellipse, {{turned<2>(r, Eigen::Vector2d(1 / (a_c * a_c), -1 / (b_c * b_c))), 1 - k}});
}

template <int D>
BasicCombined<D>::BasicCombined(const BasicEllipsoid<D>& ellipsoid, std::vector<Delimiter<D>> delimiters)
    : ellipsoid_(ellipsoid), delimiters_(std::move(delimiters)) {
  for (std::size_t i = 0; i < delimiters_.size(); ++i)
    validate<D>(ellipsoid_, delimiters_[i], "hyperboloids[" + std::to_string(i) + "]");
}

template <int D>
BasicCombined<D> BasicCombined<D>::trusted(const BasicEllipsoid<D>& ellipsoid,
                                           std::vector<Delimiter<D>> delimiters) {
  BasicCombined body(ellipsoid);
  body.delimiters_ = std::move(delimiters);
  return body;
}

template <int D>
double BasicCombined<D>::gauge(const Vector& u) const {
  double largest = (scaled_inverse<D>(ellipsoid_.factor()) * u).squaredNorm();
  for (const Delimiter<D>& d : delimiters_) {
    const double value = u.dot(d.matrix * u);
    if (value > 0)
      largest = std::max(largest, d.level > 0 ? value / d.level : std::numeric_limits<double>::infinity());
  }
  return std::sqrt(largest);
}

template <int D>
std::vector<BasicQuadric<D>> BasicCombined<D>::quadrics() const {
  std::vector<BasicQuadric<D>> all{ellipsoid_.quadric()};
  for (const Delimiter<D>& d : delimiters_) {
    Eigen::Matrix<double, D + 1, D + 1> q;
    const Vector mp = d.matrix * center();
    q.template topLeftCorner<D, D>() = d.matrix;
    q.template topRightCorner<D, 1>() = -mp;
    q.template bottomLeftCorner<1, D>() = -mp.transpose();
    q(D, D) = center().dot(mp) - d.level;
    all.emplace_back(q);
  }
  return all;
}

// Where E is the unit ball, y^T y <= 1 and y^T A_i y <= level_i, so
//   y^T (I + sum lambda_i A_i) y <= 1 + sum lambda_i level_i   for lambda >= 0.
// The least volume is the largest log det(I + sum lambda_i A_i) - D log(1 + sum lambda_i level_i).
template <int D>
BasicEllipsoid<D> BasicCombined<D>::bounding_ellipsoid() const {
  if (is_ellipsoid()) return ellipsoid_;
  std::vector<Matrix> a;
  for (const Delimiter<D>& d : delimiters_) a.push_back(whitened<D>(d, ellipsoid_.factor()));
  Matrix sum = Matrix::Identity();
  double level = 1;
  const auto merit = [](const Matrix& m, double bound) {
    const Cholesky<D> factor = cholesky<D>(m);
    if (!factor.positive) return -std::numeric_limits<double>::infinity();
    return 2 * factor.lower.diagonal().array().log().sum() - D * std::log(bound);
  };
  std::vector<double> lambda(a.size(), 0.0);
  for (int round = 0; round < 4; ++round)
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Matrix rest = sum - lambda[i] * a[i];
      const double rest_level = level - lambda[i] * delimiters_[i].level;
      // Golden section over x = lambda / (1 + lambda).
      const auto value = [&](double x) {
        const double l = x / (1 - x);
        return merit(rest + l * a[i], rest_level + l * delimiters_[i].level);
      };
      constexpr double kGolden = 0.6180339887498949;
      double lo = 0, hi = 1 - 1e-9;
      for (int step = 0; step < 60; ++step) {
        const double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo);
        if (value(x) >= value(y)) {
          hi = y;
        } else {
          lo = x;
        }
      }
      const double best = value(lo) > merit(sum, level) ? lo / (1 - lo) : lambda[i];
      sum = rest + best * a[i];
      level = rest_level + best * delimiters_[i].level;
      lambda[i] = best;
    }
  constexpr double kWidening = 1 + 1e-12;
  const Matrix f = ellipsoid_.factor();
  return BasicEllipsoid<D>::from_shape(center(),
                                       symmetric<D>(f * (sum / level).inverse() * f.transpose() * kWidening));
}

// N >= A_i / level_i for all i: the smallest such N above I and one A is taken eigenvalue by eigenvalue.
template <int D>
std::optional<BasicEllipsoid<D>> BasicCombined<D>::inscribed_ellipsoid() const {
  Matrix n = Matrix::Identity();
  for (const Delimiter<D>& d : delimiters_) {
    if (d.level == 0) return std::nullopt;
    const Matrix l = cholesky<D>(n).lower;
    const Matrix inverse = l.inverse();
    const Matrix a = whitened<D>(d, ellipsoid_.factor()) / d.level;
    const auto solver = symmetric_eigen<D>(symmetric<D>(inverse * a * inverse.transpose()));
    const Matrix v = l * solver.vectors;
    n = symmetric<D>(v * solver.values.cwiseMax(1.0).asDiagonal() * v.transpose());
  }
  constexpr double kNarrowing = 1 - 1e-12;
  const Matrix f = ellipsoid_.factor();
  return BasicEllipsoid<D>::from_shape(center(), symmetric<D>(f * n.inverse() * f.transpose() * kNarrowing));
}

template <int D>
BasicCombined<D> BasicCombined<D>::translated(const Vector& by) const {
  return trusted(ellipsoid_.translated(by), delimiters_);
}

template <int D>
BasicCombined<D> BasicCombined<D>::scaled(double scale) const {
  std::vector<Delimiter<D>> delimiters = delimiters_;
  for (Delimiter<D>& d : delimiters) d.matrix /= scale * scale;
  return trusted(ellipsoid_.scaled(scale), std::move(delimiters));
}

std::vector<Corner> corners(const CombinedEllipse& body) {
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  std::vector<Corner> all;
  const int count = static_cast<int>(body.delimiters().size()) + 1;
  const Matrix2d f = body.ellipsoid().factor();
  const auto matrix = [&](int i) -> Matrix2d {
    return i == 0 ? Matrix2d::Identity() : whitened<2>(body.delimiters()[i - 1], f);
  };
  const auto level = [&](int i) { return i == 0 ? 1.0 : body.delimiters()[i - 1].level; };
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      // On both curves r^2 u^T A_i u = level_i and r^2 u^T A_j u = level_j.
      const Matrix2d h = level(j) * matrix(i) - level(i) * matrix(j);
      const double discriminant = h(0, 1) * h(0, 1) - h(0, 0) * h(1, 1);
      if (!(discriminant > 0)) continue;
      const double q = -(h(0, 1) + std::copysign(std::sqrt(discriminant), h(0, 1)));
      for (Vector2d u : {Vector2d(q, h(0, 0)), Vector2d(h(1, 1), q)}) {
        u.normalize();
        // The radius from the better of the two curves: at level 0 a curve says nothing about it.
        const int k = level(i) >= level(j) ? i : j;
        const double value = u.dot(matrix(k) * u);
        if (!(value > 0) || level(k) == 0) continue;
        const double r = std::sqrt(level(k) / value);
        bool inside = u.dot(matrix(i) * u) >= -1e-12 * matrix(i).norm() &&
                      u.dot(matrix(j) * u) >= -1e-12 * matrix(j).norm();
        for (int other = 0; other < count && inside; ++other)
          if (other != i && other != j)
            inside = r * r * u.dot(matrix(other) * u) <= level(other) + 1e-12 * r * r * matrix(other).norm();
        if (!inside) continue;
        for (const double s : {1.0, -1.0}) all.push_back({body.center() + f * (s * r * u), i, j});
      }
    }
  std::sort(all.begin(), all.end(), [&](const Corner& x, const Corner& y) {
    const Vector2d dx = x.point - body.center(), dy = y.point - body.center();
    return std::atan2(dx.y(), dx.x()) < std::atan2(dy.y(), dy.x());
  });
  return all;
}

CombinedEllipse central_section(const CombinedEllipsoid& body, const Eigen::Vector3d& x_axis,
                                const Eigen::Vector3d& y_axis, const Eigen::Vector2d& center) {
  Eigen::Matrix<double, 3, 2> p;
  p << x_axis, y_axis;
  const Ellipse ellipse = ellipse_of(scaled_inverse<3>(body.ellipsoid().factor()) * p, center);
  std::vector<Delimiter<2>> delimiters;
  for (const Delimiter<3>& d : body.delimiters()) {
    const Eigen::Matrix2d m = p.transpose() * d.matrix * p;
    const Delimiter<2> section{symmetric<2>(m), d.level};
    const Eigen::Matrix2d a = whitened<2>(section, ellipse.factor());
    // Largest eigenvalue of a symmetric 2 x 2 matrix.
    const double reach = 0.5 * (a(0, 0) + a(1, 1)) + std::hypot(0.5 * (a(0, 0) - a(1, 1)), a(0, 1));
    if (reach > d.level) delimiters.push_back(section);
  }
  return CombinedEllipse::trusted(ellipse, std::move(delimiters));
}

template class BasicCombined<2>;
template class BasicCombined<3>;

}  // namespace vericone
