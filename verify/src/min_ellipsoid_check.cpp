// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Approximate_min_ellipsoid_d.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_2.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_3.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Simple_cartesian.h>
#include <vericone/geometry/rational.h>
#include <vericone/verify/min_ellipsoid_check.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vericone::verify {
namespace {

using exact::Rational;
using Kernel = CGAL::Simple_cartesian<double>;

/// Relative; far below any epsilon that CGAL reaches.
constexpr double kSlack = 1e-10;

template <int D>
struct Traits;
template <>
struct Traits<2> {
  using Type = CGAL::Approximate_min_ellipsoid_d_traits_2<Kernel, CGAL::MP_Float>;
  static Kernel::Point_2 point(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }
};
template <>
struct Traits<3> {
  using Type = CGAL::Approximate_min_ellipsoid_d_traits_3<Kernel, CGAL::MP_Float>;
  static Kernel::Point_3 point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
};

/// p is in the body that the stored matrices define: (p - c)^T S^{-1} (p - c) <= 1, by the sign of the
/// determinant of [S, p - c; (p - c)^T, 1], which is det S (1 - (p - c)^T S^{-1} (p - c)).
template <int D>
bool inside(const BasicEllipsoid<D>& body, const exact::RationalMatrix<D>& shape,
            const Eigen::Matrix<double, D, 1>& p) {
  exact::RationalMatrix<D + 1> m;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) m[i][j] = shape[i][j];
    m[i][D] = m[D][i] = Rational(p(i)) - Rational(body.center()(i));
  }
  m[D][D] = 1;
  return exact::determinant<D + 1>(m).sign() >= 0;
}

}  // namespace

template <int D>
MinEllipsoidComparison<D> compare_min_ellipsoid(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                                double epsilon) {
  using Vector = Eigen::Matrix<double, D, 1>;
  MinEllipsoidComparison<D> result{.ours = min_volume_ellipsoid<D>(points)};
  const double unit_ball = D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  const BasicEllipsoid<D>& body = result.ours.body;
  result.our_volume = unit_ball * std::abs(body.factor().determinant());
  const exact::RationalMatrix<D> shape = exact::defining_shape<D>(body);

  std::vector<typename Traits<D>::Type::Point> converted;
  converted.reserve(points.size());
  for (const Vector& p : points) converted.push_back(Traits<D>::point(p));
  const CGAL::Approximate_min_ellipsoid_d<typename Traits<D>::Type> theirs(epsilon, converted.begin(),
                                                                           converted.end());
  if (!theirs.is_full_dimensional()) throw std::logic_error("compare_min_ellipsoid: CGAL found a flat body");
  result.cgal_ratio_bound = (1 + theirs.achieved_epsilon()) * (1 + 2 * kSlack);

  // CGAL's ellipsoid is y^T M y + 2 m^T y + nu <= alpha with alpha = (1 + k) (D + 1), where its certificate
  // is 1 + achieved_epsilon = (1 + k)^((D + 1) / 2). Its M is symmetric and its certificate holds up to the
  // rounding of its updates, for which a little is added.
  const double alpha = std::pow(1 + theirs.achieved_epsilon(), 2.0 / (D + 1)) * (D + 1) * (1 + kSlack);
  Eigen::Matrix<double, D, D> matrix;
  Vector vector;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) matrix(i, j) = theirs.defining_matrix(i, j);
    vector(i) = theirs.defining_vector(i) / 2;
  }
  const double nu = theirs.defining_scalar();
  const double rest = alpha - nu + vector.dot(matrix.inverse() * vector);
  result.cgal_volume = unit_ball * std::sqrt(std::pow(rest, D) / matrix.determinant());

  const exact::RationalMatrix<D> exact_matrix = exact::to_rational<D>(matrix);
  const exact::RationalVector<D> exact_vector = exact::to_rational<D>(vector);
  for (const Vector& p : points) {
    if (!inside<D>(body, shape, p)) ++result.outside_ours;
    const exact::RationalVector<D> x = exact::to_rational<D>(p);
    Rational value = Rational(nu) - Rational(alpha);
    for (int i = 0; i < D; ++i) {
      value += 2 * exact_vector[i] * x[i];
      for (int j = 0; j < D; ++j) value += exact_matrix[i][j] * x[i] * x[j];
    }
    if (value.sign() > 0) ++result.outside_cgal;
  }
  return result;
}

template MinEllipsoidComparison<2> compare_min_ellipsoid<2>(const std::vector<Eigen::Vector2d>&, double);
template MinEllipsoidComparison<3> compare_min_ellipsoid<3>(const std::vector<Eigen::Vector3d>&, double);

}  // namespace vericone::verify
