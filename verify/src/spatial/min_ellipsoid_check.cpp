// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Approximate_min_ellipsoid_d.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_2.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_3.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Simple_cartesian.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/verify/spatial/min_ellipsoid_check.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <ctime>
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
  template <typename Number>
  using Type = CGAL::Approximate_min_ellipsoid_d_traits_2<Kernel, Number>;
  static Kernel::Point_2 point(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }
};
template <>
struct Traits<3> {
  template <typename Number>
  using Type = CGAL::Approximate_min_ellipsoid_d_traits_3<Kernel, Number>;
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

/// CGAL's ellipsoid x^T matrix x + 2 vector.x + nu <= alpha and what it certifies.
template <int D>
struct CgalRun {
  Eigen::Matrix<double, D, D> matrix;
  Eigen::Matrix<double, D, 1> vector;
  double nu, alpha;
  CgalMinEllipsoid<D> result;
};

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <int D>
constexpr double kUnitBall = D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;

/// `Number`: of the certificate.
template <int D, typename Number = CGAL::MP_Float>
CgalRun<D> run_cgal(const std::vector<Eigen::Matrix<double, D, 1>>& points, double epsilon) {
  using CgalTraits = typename Traits<D>::template Type<Number>;
  std::vector<typename CgalTraits::Point> converted;
  converted.reserve(points.size());
  for (const auto& p : points) converted.push_back(Traits<D>::point(p));
  CgalRun<D> run;
  const double start = thread_seconds();
  const CGAL::Approximate_min_ellipsoid_d<CgalTraits> theirs(epsilon, converted.begin(), converted.end());
  run.result.seconds = thread_seconds() - start;
  if (!theirs.is_full_dimensional()) throw std::logic_error("cgal_min_ellipsoid: CGAL found a flat body");
  run.result.ratio_bound = (1 + theirs.achieved_epsilon()) * (1 + 2 * kSlack);

  // alpha = (1 + k) (D + 1), where CGAL's certificate is 1 + achieved_epsilon = (1 + k)^((D + 1) / 2). Its M
  // is symmetric and its certificate holds up to the rounding of its updates, for which a little is added.
  run.alpha = std::pow(1 + theirs.achieved_epsilon(), 2.0 / (D + 1)) * (D + 1) * (1 + kSlack);
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) run.matrix(i, j) = theirs.defining_matrix(i, j);
    run.vector(i) = theirs.defining_vector(i) / 2;
  }
  run.nu = theirs.defining_scalar();
  const double rest = run.alpha - run.nu + run.vector.dot(run.matrix.inverse() * run.vector);
  run.result.volume = kUnitBall<D> * std::sqrt(std::pow(rest, D) / run.matrix.determinant());
  return run;
}

}  // namespace

template <int D>
CgalMinEllipsoid<D> cgal_min_ellipsoid(const std::vector<Eigen::Matrix<double, D, 1>>& points, double epsilon,
                                       bool plain) {
  return plain ? run_cgal<D, double>(points, epsilon).result : run_cgal<D>(points, epsilon).result;
}

template <int D>
MinEllipsoidComparison<D> compare_min_ellipsoid(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                                double epsilon) {
  using Vector = Eigen::Matrix<double, D, 1>;
  MinEllipsoidComparison<D> result{.ours = min_volume_ellipsoid<D>(points)};
  const BasicEllipsoid<D>& body = result.ours.body;
  result.our_volume = kUnitBall<D> * std::abs(body.factor().determinant());
  const exact::RationalMatrix<D> shape = exact::defining_shape<D>(body);

  const CgalRun<D> theirs = run_cgal<D>(points, epsilon);
  result.cgal_volume = theirs.result.volume;
  result.cgal_ratio_bound = theirs.result.ratio_bound;
  const exact::RationalMatrix<D> exact_matrix = exact::to_rational<D>(theirs.matrix);
  const exact::RationalVector<D> exact_vector = exact::to_rational<D>(theirs.vector);
  for (const Vector& p : points) {
    if (!inside<D>(body, shape, p)) ++result.outside_ours;
    const exact::RationalVector<D> x = exact::to_rational<D>(p);
    Rational value = Rational(theirs.nu) - Rational(theirs.alpha);
    for (int i = 0; i < D; ++i) {
      value += 2 * exact_vector[i] * x[i];
      for (int j = 0; j < D; ++j) value += exact_matrix[i][j] * x[i] * x[j];
    }
    if (value.sign() > 0) ++result.outside_cgal;
  }
  return result;
}

template CgalMinEllipsoid<2> cgal_min_ellipsoid<2>(const std::vector<Eigen::Vector2d>&, double, bool);
template CgalMinEllipsoid<3> cgal_min_ellipsoid<3>(const std::vector<Eigen::Vector3d>&, double, bool);
template MinEllipsoidComparison<2> compare_min_ellipsoid<2>(const std::vector<Eigen::Vector2d>&, double);
template MinEllipsoidComparison<3> compare_min_ellipsoid<3>(const std::vector<Eigen::Vector3d>&, double);

}  // namespace vericone::verify
