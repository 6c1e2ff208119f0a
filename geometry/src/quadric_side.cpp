// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/combined.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/quadric_side.h>

#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/tracked.h>
#include <array>
#include <cmath>
#include <string>

namespace vericone {
namespace {

// The formulas, over any ring of numbers. Matrices and vectors are functions of indices.

/// x^T S x with n unknowns; S symmetric.
template <int N, typename Number, typename Matrix, typename Vector>
constexpr Number quadratic_form(const Matrix& s, const Vector& x) {
  Number sum = x(0) * (s(0, 0) * x(0));
  for (int i = 1; i < N; ++i) sum = sum + x(i) * (s(i, i) * x(i));
  for (int i = 0; i < N; ++i)
    for (int j = i + 1; j < N; ++j) sum = sum + (s(i, j) * (x(i) * x(j))) * 2;
  return sum;
}

/// Cofactor (r, c) of a D x D matrix.
template <int D, typename Number, typename Matrix>
constexpr Number cofactor(const Matrix& m, int r, int c) {
  if constexpr (D == 2) {
    return r == c ? m(1 - r, 1 - c) : -m(1 - r, 1 - c);
  } else {
    const int r0 = (r + 1) % 3, r1 = (r + 2) % 3, c0 = (c + 1) % 3, c1 = (c + 2) % 3;
    return m(r0, c0) * m(r1, c1) - m(r0, c1) * m(r1, c0);
  }
}

template <int D, typename Number, typename Matrix>
constexpr Number determinant(const Matrix& m) {
  Number sum = m(0, 0) * cofactor<D, Number>(m, 0, 0);
  for (int j = 1; j < D; ++j) sum = sum + m(0, j) * cofactor<D, Number>(m, 0, j);
  return sum;
}

/// |adj(F) d|^2 - det(F)^2, negative inside { F u : |u| <= 1 }.
template <int D, typename Number, typename Matrix, typename Vector>
constexpr Number side_by_factor(const Matrix& f, const Vector& d) {
  const Number det = determinant<D, Number>(f);
  Number sum = -(det * det);
  for (int i = 0; i < D; ++i) {
    Number z = cofactor<D, Number>(f, 0, i) * d(0);
    for (int j = 1; j < D; ++j) z = z + cofactor<D, Number>(f, j, i) * d(j);
    sum = sum + z * z;
  }
  return sum;
}

/// d^T adj(S) d - det S.
template <int D, typename Number, typename Matrix, typename Vector>
constexpr Number side_by_shape(const Matrix& s, const Vector& d) {
  const auto adjugate = [&](int i, int j) { return cofactor<D, Number>(s, i, j); };
  return quadratic_form<D, Number>(adjugate, d) - determinant<D, Number>(s);
}

/// d^T M d - level.
template <int D, typename Number, typename Matrix, typename Vector>
constexpr Number side_of_delimiter(const Matrix& m, const Vector& d, const Number& level) {
  return quadratic_form<D, Number>(m, d) - level;
}

template <int D>
constexpr RoundingCount delimiter_count() {
  const auto entry = [](int, int) { return RoundingCount{0}; };
  const auto coordinate = [](int) { return RoundingCount{1}; };  // the difference to the centre
  return side_of_delimiter<D, RoundingCount>(entry, coordinate, RoundingCount{0});
}

template <int D>
constexpr RoundingCount quadric_count() {
  const auto entry = [](int, int) { return RoundingCount{0}; };
  const auto coordinate = [](int) { return RoundingCount{0}; };
  return quadratic_form<D + 1, RoundingCount>(entry, coordinate);
}

template <int D>
constexpr RoundingCount body_count(bool by_factor) {
  const auto entry = [](int, int) { return RoundingCount{0}; };
  const auto coordinate = [](int) { return RoundingCount{1}; };  // the difference to the centre
  return by_factor ? side_by_factor<D, RoundingCount>(entry, coordinate)
                   : side_by_shape<D, RoundingCount>(entry, coordinate);
}

/// Inputs are scaled to at most one, so a product that leaves the normal numbers loses at most 2^-1075, and
/// there are fewer than 2^9 of them.
constexpr double kUnderflow = 0x1p-1060;

/// A power of two that brings the largest of some numbers into (1/2, 1]; 0 where there is none in range.
double scale_to_one(double largest) {
  if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return 0;
  const int e = std::ilogb(largest) + 1;
  return std::abs(e) > 1000 ? 0 : std::ldexp(1.0, -e);
}

template <int D>
struct ScaledQuadric {
  Eigen::Matrix<double, D + 1, D + 1> q;
  Eigen::Matrix<double, D + 1, 1> x;
  bool usable;

  ScaledQuadric(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point) {
    const double by_q = scale_to_one(quadric.matrix().cwiseAbs().maxCoeff());
    const double by_x = scale_to_one(std::max(1.0, point.cwiseAbs().maxCoeff()));
    q = quadric.matrix() * by_q;
    x << point * by_x, by_x;
    // Scaling is exact unless it leaves the normal numbers.
    usable = by_q > 0 && by_x > 0;
    for (int i = 0; i <= D; ++i) {
      usable = usable && ((i < D && point(i) == 0) || std::abs(x(i)) >= 0x1p-1000);
      for (int j = 0; j <= D; ++j)
        usable = usable && (quadric.matrix()(i, j) == 0 || std::abs(q(i, j)) >= 0x1p-1000);
    }
  }
};

template <int D>
struct ScaledBody {
  bool by_factor;
  Eigen::Matrix<double, D, D> m;  // factor or shape
  Eigen::Matrix<double, D, 1> point, center;
  bool usable;

  ScaledBody(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& x)
      : by_factor(body.defined_by_factor()) {
    const double extent =
        std::max(body.factor().cwiseAbs().maxCoeff(), (x - body.center()).cwiseAbs().maxCoeff());
    const double scale = scale_to_one(extent);
    usable = scale > 0 && scale < 0x1p511 && scale > 0x1p-511;
    m = by_factor ? Eigen::Matrix<double, D, D>(body.factor() * scale)
                  : Eigen::Matrix<double, D, D>(body.shape() * (scale * scale));
    point = x * scale;
    center = body.center() * scale;
    const auto in_range = [](double before, double after) {
      return before == 0 || std::abs(after) >= 0x1p-1000;
    };
    for (int i = 0; i < D; ++i) {
      usable = usable && in_range(x(i), point(i)) && in_range(body.center()(i), center(i));
      for (int j = 0; j < D; ++j)
        usable = usable && in_range(by_factor ? body.factor()(i, j) : body.shape()(i, j), m(i, j));
    }
  }

  template <typename Number, typename Make, typename Difference>
  Number value(const Make& make, const Difference& difference) const {
    const auto entry = [&](int i, int j) { return make(m(i, j)); };
    const auto d = [&](int i) { return difference(point(i), center(i)); };
    return by_factor ? side_by_factor<D, Number>(entry, d) : side_by_shape<D, Number>(entry, d);
  }
};

/// A delimiter with lengths and matrix entries scaled to at most one by powers of two.
template <int D>
struct ScaledDelimiter {
  Eigen::Matrix<double, D, D> m;
  Eigen::Matrix<double, D, 1> point, center;
  double level;
  bool usable;

  ScaledDelimiter(const Delimiter<D>& delimiter, const Eigen::Matrix<double, D, 1>& p,
                  const Eigen::Matrix<double, D, 1>& x) {
    const double by_m = scale_to_one(delimiter.matrix.cwiseAbs().maxCoeff());
    const double by_x = scale_to_one((x - p).cwiseAbs().maxCoeff());
    m = delimiter.matrix * by_m;
    point = x * by_x;
    center = p * by_x;
    level = delimiter.level * by_m * by_x * by_x;
    const auto in_range = [](double before, double after) {
      return before == 0 || (std::abs(after) >= 0x1p-900 && std::abs(after) <= 0x1p900);
    };
    usable = by_m > 0 && by_x > 0 && in_range(delimiter.level, delimiter.level * by_m) &&
             in_range(delimiter.level, delimiter.level * by_m * by_x) && in_range(delimiter.level, level);
    for (int i = 0; i < D; ++i) {
      usable = usable && in_range(x(i), point(i)) && in_range(p(i), center(i));
      for (int j = 0; j < D; ++j) usable = usable && in_range(delimiter.matrix(i, j), m(i, j));
    }
  }
};

template <int D>
FilteredSign triage_delimiter(const ScaledDelimiter<D>& s) {
  constexpr RoundingCount kCount = delimiter_count<D>();
  return side_of_delimiter<D, Tracked>([&](int i, int j) { return Tracked::of(s.m(i, j)); },
                                       [&](int i) { return Tracked::of(s.point(i) - s.center(i)); },
                                       Tracked::of(s.level))
      .sign(kCount, kUnderflow);
}

template <int D>
FilteredSign interval_delimiter(const ScaledDelimiter<D>& s) {
  return side_of_delimiter<D, Interval>([&](int i, int j) { return Interval(s.m(i, j)); },
                                        [&](int i) { return Interval(s.point(i)) - Interval(s.center(i)); },
                                        Interval(s.level))
      .sign();
}

template <int D>
exact::Integer exact_delimiter(const Delimiter<D>& delimiter, const Eigen::Matrix<double, D, 1>& p,
                               const Eigen::Matrix<double, D, 1>& x) {
  using exact::Integer;
  constexpr int kNone = 1 << 20;
  int e_m = kNone, e_x = kNone;
  for (int i = 0; i < D; ++i) {
    e_x = std::min({e_x, exact::grid_exponent(x(i), kNone), exact::grid_exponent(p(i), kNone)});
    for (int j = 0; j < D; ++j) e_m = std::min(e_m, exact::grid_exponent(delimiter.matrix(i, j), kNone));
  }
  if (e_x == kNone) e_x = 0;
  const int e_level = exact::grid_exponent(delimiter.level, kNone);
  if (e_m == kNone) e_m = 0;
  // One grid for the level and for the products: 2^(e_m + 2 e_x).
  if (e_level != kNone) e_m = std::min(e_m, e_level - 2 * e_x);
  return side_of_delimiter<D, Integer>(
      [&](int i, int j) { return exact::on_grid(delimiter.matrix(i, j), e_m); },
      [&](int i) { return Integer(exact::on_grid(x(i), e_x) - exact::on_grid(p(i), e_x)); },
      exact::on_grid(delimiter.level, e_m + 2 * e_x));
}

template <typename Point>
void require_finite(const Point& point) {
  for (int i = 0; i < point.size(); ++i)
    if (!std::isfinite(point(i)))
      throw InputError("point[" + std::to_string(i) + "]", to_text(point(i)), "a finite number (metres)");
}

std::optional<Sign> known(FilteredSign s) {
  if (s == FilteredSign::uncertain) return std::nullopt;
  return s == FilteredSign::positive ? Sign::positive : Sign::negative;
}

template <typename Number>
Sign sign_of(const Number& x) {
  return static_cast<Sign>(x.sign());
}

}  // namespace

template <int D>
FilteredSign triage_side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point) noexcept {
  const ScaledQuadric<D> scaled(quadric, point);
  if (!scaled.usable) return FilteredSign::uncertain;
  constexpr RoundingCount kCount = quadric_count<D>();
  return quadratic_form<D + 1, Tracked>([&](int i, int j) { return Tracked::of(scaled.q(i, j)); },
                                        [&](int i) { return Tracked::of(scaled.x(i)); })
      .sign(kCount, kUnderflow);
}

template <int D>
FilteredSign interval_side(const BasicQuadric<D>& quadric,
                           const Eigen::Matrix<double, D, 1>& point) noexcept {
  const ScaledQuadric<D> scaled(quadric, point);
  if (!scaled.usable) return FilteredSign::uncertain;
  return quadratic_form<D + 1, Interval>([&](int i, int j) { return Interval(scaled.q(i, j)); },
                                         [&](int i) { return Interval(scaled.x(i)); })
      .sign();
}

template <int D>
Sign exact_side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point) {
  using exact::Integer;
  const Eigen::Matrix<double, D + 1, 1> x = point.homogeneous();
  constexpr int kNone = 1 << 20;
  int e_q = kNone, e_x = 0;
  for (int i = 0; i <= D; ++i) {
    e_x = std::min(e_x, exact::grid_exponent(x(i), kNone));
    for (int j = 0; j <= D; ++j) e_q = std::min(e_q, exact::grid_exponent(quadric.matrix()(i, j), kNone));
  }
  return sign_of(quadratic_form<D + 1, Integer>(
      [&](int i, int j) { return exact::on_grid(quadric.matrix()(i, j), e_q); },
      [&](int i) { return exact::on_grid(x(i), e_x); }));
}

template <int D>
FilteredSign triage_side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point) noexcept {
  // Outside a box around the body.
  for (int i = 0; i < D; ++i) {
    const double d = std::abs(point(i) - body.center()(i));
    const double reach =
        body.defined_by_factor() ? body.factor().row(i).cwiseAbs().sum() : std::sqrt(body.shape()(i, i));
    if (d > reach * (1 + 0x1p-40) && d <= std::numeric_limits<double>::max()) return FilteredSign::positive;
  }
  const ScaledBody<D> scaled(body, point);
  if (!scaled.usable) return FilteredSign::uncertain;
  constexpr RoundingCount kByFactor = body_count<D>(true), kByShape = body_count<D>(false);
  return scaled
      .template value<Tracked>([](double x) { return Tracked::of(x); },
                               [](double x, double p) { return Tracked::of(x - p); })
      .sign(scaled.by_factor ? kByFactor : kByShape, kUnderflow);
}

template <int D>
FilteredSign interval_side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point) noexcept {
  const ScaledBody<D> scaled(body, point);
  if (!scaled.usable) return FilteredSign::uncertain;
  return scaled
      .template value<Interval>([](double x) { return Interval(x); },
                                [](double x, double p) { return Interval(x) - Interval(p); })
      .sign();
}

template <int D>
Sign exact_side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point) {
  using exact::Integer;
  constexpr int kNone = 1 << 20;
  const bool by_factor = body.defined_by_factor();
  const auto& m = by_factor ? body.factor() : body.shape();
  int e = kNone;
  for (int i = 0; i < D; ++i) {
    e = std::min({e, exact::grid_exponent(point(i), kNone), exact::grid_exponent(body.center()(i), kNone)});
    for (int j = 0; j < D; ++j) {
      const int g = exact::grid_exponent(m(i, j), kNone);
      if (g != kNone) e = std::min(e, by_factor ? g : static_cast<int>(std::floor(g / 2.0)));
    }
  }
  const auto entry = [&](int i, int j) { return exact::on_grid(m(i, j), by_factor ? e : 2 * e); };
  const auto d = [&](int i) {
    return Integer(exact::on_grid(point(i), e) - exact::on_grid(body.center()(i), e));
  };
  return sign_of(by_factor ? side_by_factor<D, Integer>(entry, d) : side_by_shape<D, Integer>(entry, d));
}

template <int D>
Sign side(const BasicQuadric<D>& quadric, const Eigen::Matrix<double, D, 1>& point, Rung* rung) {
  return climb<PointQuadric>(
      rung, [&] { return known(triage_side<D>(quadric, point)); },
      [&] { return known(interval_side<D>(quadric, point)); },
      [&] {
        require_finite(point);
        return exact_side<D>(quadric, point);
      });
}

template <int D>
Sign side(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& point, Rung* rung) {
  return climb<PointBody>(
      rung, [&] { return known(triage_side<D>(body, point)); },
      [&] { return known(interval_side<D>(body, point)); },
      [&] {
        require_finite(point);
        return exact_side<D>(body, point);
      });
}

template <int D>
Sign side(std::span<const BasicQuadric<D>> quadrics, const Eigen::Matrix<double, D, 1>& point, Rung* rung) {
  Sign largest = Sign::negative;
  for (const auto& quadric : quadrics) {
    largest = std::max(largest, side<D>(quadric, point, rung));
    if (largest == Sign::positive) break;
  }
  return largest;
}

template <int D>
Sign side(const BasicCombined<D>& body, const Eigen::Matrix<double, D, 1>& point, Rung* rung) {
  Sign largest = side<D>(body.ellipsoid(), point, rung);
  for (const Delimiter<D>& delimiter : body.delimiters()) {
    if (largest == Sign::positive) break;
    const ScaledDelimiter<D> scaled(delimiter, body.center(), point);
    Rung own{};
    const Sign s = climb<PointCombined>(
        &own, [&] { return scaled.usable ? known(triage_delimiter<D>(scaled)) : std::nullopt; },
        [&] { return scaled.usable ? known(interval_delimiter<D>(scaled)) : std::nullopt; },
        [&] { return sign_of(exact_delimiter<D>(delimiter, body.center(), point)); });
    if (rung) *rung = std::max(*rung, own);
    largest = std::max(largest, s);
  }
  return largest;
}
template Sign side<2>(const CombinedEllipse&, const Eigen::Vector2d&, Rung*);
template Sign side<3>(const CombinedEllipsoid&, const Eigen::Vector3d&, Rung*);

namespace exact {

template <int D>
Sign side(const RationalMatrix<D + 1>& quadric, const RationalVector<D>& point) {
  return sign_of(quadratic_form<D + 1, Rational>([&](int i, int j) { return quadric[i][j]; },
                                                 [&](int i) { return i < D ? point[i] : Rational(1); }));
}

template <int D>
Sign side(const RationalBody<D>& body, const RationalVector<D>& point) {
  if (!positive_definite<D>(body.shape))
    throw InputError("body.shape", "not positive definite", "symmetric and positive definite");
  return sign_of(side_by_shape<D, Rational>([&](int i, int j) { return body.shape[i][j]; },
                                            [&](int i) { return Rational(point[i] - body.center[i]); }));
}

template Sign side<2>(const RationalMatrix<3>&, const RationalVector<2>&);
template Sign side<3>(const RationalMatrix<4>&, const RationalVector<3>&);
template Sign side<2>(const RationalBody<2>&, const RationalVector<2>&);
template Sign side<3>(const RationalBody<3>&, const RationalVector<3>&);

}  // namespace exact

#define VERICONE_INSTANTIATE(D)                                                                              \
  template Sign side<D>(const BasicQuadric<D>&, const Eigen::Matrix<double, D, 1>&, Rung*);                  \
  template Sign side<D>(const BasicEllipsoid<D>&, const Eigen::Matrix<double, D, 1>&, Rung*);                \
  template Sign side<D>(std::span<const BasicQuadric<D>>, const Eigen::Matrix<double, D, 1>&, Rung*);        \
  template FilteredSign triage_side<D>(const BasicQuadric<D>&, const Eigen::Matrix<double, D, 1>&) noexcept; \
  template FilteredSign interval_side<D>(const BasicQuadric<D>&,                                             \
                                         const Eigen::Matrix<double, D, 1>&) noexcept;                       \
  template Sign exact_side<D>(const BasicQuadric<D>&, const Eigen::Matrix<double, D, 1>&);                   \
  template FilteredSign triage_side<D>(const BasicEllipsoid<D>&,                                             \
                                       const Eigen::Matrix<double, D, 1>&) noexcept;                         \
  template FilteredSign interval_side<D>(const BasicEllipsoid<D>&,                                           \
                                         const Eigen::Matrix<double, D, 1>&) noexcept;                       \
  template Sign exact_side<D>(const BasicEllipsoid<D>&, const Eigen::Matrix<double, D, 1>&);
VERICONE_INSTANTIATE(2)
VERICONE_INSTANTIATE(3)
#undef VERICONE_INSTANTIATE

}  // namespace vericone
