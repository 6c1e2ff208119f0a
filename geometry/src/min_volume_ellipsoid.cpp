// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/min_volume_ellipsoid.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace vericone {
namespace {

using Eigen::Index;
using exact::Rational;

constexpr double kEps = std::numeric_limits<double>::epsilon();
/// Points thinner than this part of their length are refused as flat.
constexpr double kFlat = 1e-13;
constexpr double kLargestCoordinate = 1e100;

template <int D>
using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;
template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Square = Eigen::Matrix<double, D, D>;

// Sums over points are loops in this file: Eigen's products of matrices of unknown size took 10 s to compile.

/// sum_i u_i q_i q_i^T.
template <int R>
Square<R> second_moment(const Points<R>& q, const Eigen::VectorXd& u) {
  Square<R> m = Square<R>::Zero();
  for (Index i = 0; i < q.cols(); ++i)
    for (int j = 0; j < R; ++j) {
      const double weighted = u(i) * q(j, i);
      for (int k = 0; k <= j; ++k) m(j, k) += weighted * q(k, i);
    }
  for (int j = 0; j < R; ++j)
    for (int k = 0; k < j; ++k) m(k, j) = m(j, k);
  return m;
}

template <int D>
void validate(const Eigen::Ref<const Points<D>>& points, const MinVolumeOptions& options) {
  if (!(options.tolerance > 0) || !(options.tolerance < 1))
    throw InputError("tolerance", to_text(options.tolerance), "a number between 0 and 1, both excluded");
  if (options.max_iterations < 1)
    throw InputError("max_iterations", std::to_string(options.max_iterations), "at least 1");
  if (points.cols() <= D)
    throw InputError("points", std::to_string(points.cols()) + (points.cols() == 1 ? " point" : " points"),
                     "at least " + std::to_string(D + 1) + " points");
  for (Index i = 0; i < points.cols(); ++i)
    for (int k = 0; k < D; ++k)
      if (!(std::abs(points(k, i)) <= kLargestCoordinate))
        throw InputError("points[" + std::to_string(i) + "][" + std::to_string(k) + "]",
                         to_text(points(k, i)), "a finite number, at most 1e100 in magnitude");
}

/// Coordinates y = diag(1/extent) axes^T (x - origin) in which the points fill the unit box, more or less,
/// however thin they are; and the points that were extreme in some direction.
template <int D>
struct Frame {
  Vector<D> origin;
  Square<D> axes;  // orthonormal columns
  Vector<D> extents;
  std::vector<Index> core_set;
};

template <int D>
double largest_entry(const Eigen::Ref<const Points<D>>& points) {
  double largest = 0;
  for (Index i = 0; i < points.cols(); ++i) largest = std::max(largest, points.col(i).cwiseAbs().maxCoeff());
  return largest;
}

/// Kumar and Yildirim's core set: the extreme points along D orthogonal directions, each direction orthogonal
/// to the spread found before. They choose the directions freely; here each one is that of the point farthest
/// from the affine hull so far, which keeps the frame good for thin bodies; those points join the set, so
/// that it always spans the space.
template <int D>
Frame<D> core_set_frame(const Eigen::Ref<const Points<D>>& points) {
  constexpr const char* kDegenerate[] = {"points that are all equal", "points that are all on one line",
                                         "points that are all in one plane"};
  Frame<D> f;
  Vector<D> least = points.col(0), most = least;
  for (Index i = 1; i < points.cols(); ++i) {
    least = least.cwiseMin(points.col(i));
    most = most.cwiseMax(points.col(i));
  }
  int widest = 0;
  (most - least).maxCoeff(&widest);
  Index start = 0;
  while (points(widest, start) != least(widest)) ++start;
  f.origin = points.col(start);
  f.core_set.push_back(start);
  f.axes.setZero();
  const double rounding = 16 * kEps * largest_entry<D>(points);  // of the coordinates themselves
  Points<D> rest(D, points.cols());
  for (Index i = 0; i < points.cols(); ++i) rest.col(i) = points.col(i) - f.origin;
  // A power of two, so that no squared length over- or underflows and no digit is lost.
  const double unit = std::exp2(std::ilogb(std::max(largest_entry<D>(rest), 1e-300)));
  rest /= unit;
  for (int k = 0; k < D; ++k) {
    Index far = 0;
    double distance = -1;
    for (Index i = 0; i < rest.cols(); ++i)
      if (const double square = rest.col(i).squaredNorm(); square > distance) {
        distance = square;
        far = i;
      }
    Vector<D> axis = rest.col(far).stableNormalized();
    for (int j = 0; j < k; ++j) axis -= f.axes.col(j) * f.axes.col(j).dot(axis);
    axis.stableNormalize();
    Index low = 0, high = 0;
    double lowest = 0, highest = 0;  // of the origin
    for (Index i = 0; i < rest.cols(); ++i) {
      const double along = axis.dot(rest.col(i));
      rest.col(i) -= along * axis;
      if (i == 0 || along < lowest) lowest = along, low = i;
      if (i == 0 || along > highest) highest = along, high = i;
    }
    f.extents(k) = unit * (highest - lowest);
    if (!(f.extents(k) > kFlat * f.extents.head(k + 1).maxCoeff() + rounding))
      throw InputError("points", kDegenerate[k],
                       D == 2 ? "spread over the plane, not on one line"
                              : "spread over all of space, not in one plane or on one line");
    f.axes.col(k) = axis;
    f.core_set.insert(f.core_set.end(), {far, low, high});
  }
  std::ranges::sort(f.core_set);
  // Not std::ranges::unique, whose result clang 14 does not take from the headers of g++ 12.
  f.core_set.erase(std::unique(f.core_set.begin(), f.core_set.end()), f.core_set.end());
  return f;
}

/// maximise log det M(u), M(u) = sum_i u_i q_i q_i^T, q_i = (y_i, 1), over weights u >= 0 that sum to 1: the
/// dual of the minimum-volume problem. Its gradient is g_i = q_i^T M^{-1} q_i = 1 + (y_i-c)^T C^{-1} (y_i-c)
/// with the weighted mean c and covariance C; at the optimum g_i <= N = D+1, with equality where u_i > 0.
///
/// This is the problem on a working set of a few dozen points.
template <int D>
class DualAscent {
 public:
  static constexpr int kN = D + 1;

  void add(Index index, const Vector<D>& y) {
    members_.push_back(index);
    const Index m = std::ssize(members_);
    q_.conservativeResize(kN, m);
    q_.col(m - 1) = y.homogeneous();
    u_.conservativeResize(m);
    u_(m - 1) = 0;
  }

  void start_uniform() {
    u_.setConstant(1.0 / double(u_.size()));
    update();
  }

  /// Forgets the members without weight that are well inside.
  void drop_interior() {
    Index kept = 0;
    for (Index i = 0; i < u_.size(); ++i) {
      if (u_(i) == 0 && g_(i) < kN * (1 - 1e-3)) continue;
      members_[kept] = members_[i];
      q_.col(kept) = q_.col(i).eval();
      u_(kept) = u_(i);
      ++kept;
    }
    members_.resize(kept);
    q_.conservativeResize(kN, kept);
    u_.conservativeResize(kept);
    update();
  }

  /// Steps until every member has g_i <= N (1 + tolerance) and, where u_i > 0, g_i >= N (1 - tolerance);
  /// until no step makes progress; or until `iterations` reaches `limit`.
  void maximize(double tolerance, int limit, int& iterations) {
    update();
    int stalled = 0;
    double best = value(llt_, u_);
    while (iterations < limit && stalled < kStallLimit && residual() > tolerance) {
      checkpoint();
      todd_yildirim_step();
      ++iterations;
      for (int k = 0; k < kNewtonSteps && iterations < limit; ++k) {
        ++iterations;
        if (!newton_step()) break;
      }
      const double now = value(llt_, u_);
      stalled = now > best + 4 * kEps ? 0 : stalled + 1;
      best = std::max(best, now);
    }
  }

  const std::vector<Index>& members() const { return members_; }
  const Eigen::VectorXd& weights() const { return u_; }
  Vector<D> mean() const {
    Vector<D> sum = Vector<D>::Zero();
    for (Index i = 0; i < u_.size(); ++i) sum += u_(i) * q_.col(i).template head<D>();
    return sum;
  }
  Square<D> covariance() const {
    const Vector<D> center = mean();
    Points<D> y(D, u_.size());
    for (Index i = 0; i < u_.size(); ++i) y.col(i) = q_.col(i).template head<D>() - center;
    return second_moment<D>(y, u_);
  }

 private:
  static constexpr int kStallLimit = 50;
  static constexpr int kNewtonSteps = 30;
  using Lifted = Eigen::Matrix<double, kN, Eigen::Dynamic>;

  static Cholesky<kN> decompose(const Lifted& q, const Eigen::VectorXd& u) {
    return cholesky<kN>(second_moment<kN>(q, u));
  }

  void update() {
    u_ /= u_.sum();
    llt_ = decompose(q_, u_);
    whitened_.resize(kN, u_.size());
    g_.resize(u_.size());
    for (Index i = 0; i < u_.size(); ++i) {
      for (int j = 0; j < kN; ++j) {  // L w = q
        double rest = q_(j, i);
        for (int k = 0; k < j; ++k) rest -= llt_.lower(j, k) * whitened_(k, i);
        whitened_(j, i) = rest / llt_.lower(j, j);
      }
      g_(i) = whitened_.col(i).squaredNorm();
    }
  }

  /// Largest violation of the optimality conditions, relative to N.
  double residual() const {
    double r = 0;
    for (Index i = 0; i < u_.size(); ++i) r = std::max(r, u_(i) > 0 ? std::abs(g_(i) - kN) : g_(i) - kN);
    return r / kN;
  }

  /// Moves weight to the point that sticks out most, or away from the weighted point that lies deepest
  /// inside, whichever violates more (WA-TY). The step lengths maximise the determinant along the line:
  /// source, Algorithm 1, line 5, with N = D+1 in place of its n+1, D in place of n.
  void todd_yildirim_step() {
    Index outer = 0, inner = -1;
    g_.maxCoeff(&outer);
    for (Index i = 0; i < u_.size(); ++i)
      if (u_(i) > 0 && (inner < 0 || g_(i) < g_(inner))) inner = i;
    if (g_(outer) - kN >= kN - g_(inner)) {
      const double step = (g_(outer) - kN) / (kN * (g_(outer) - 1));
      u_ *= 1 - step;
      u_(outer) += step;
    } else {
      const double whole = u_(inner) / (1 - u_(inner));  // takes all weight from the point
      const double step = g_(inner) > 1 ? (kN - g_(inner)) / (kN * (g_(inner) - 1)) : whole;
      u_ *= 1 + std::min(step, whole);
      u_(inner) = step < whole ? u_(inner) - step : 0;
    }
    update();
  }

  /// One Newton step for log det M(u) - N sum(u) over the points of positive weight; its maximum has weights
  /// of sum 1 by itself. The gradient is g - N, the Hessian minus the squares of q_i^T M^{-1} q_j. A weight
  /// that would turn negative stops the step at zero and leaves the support: with more points than the
  /// problem has degrees of freedom the Hessian is singular and that is how the surplus leaves. Returns
  /// whether another step may help.
  bool newton_step() {
    std::vector<Index> face;
    for (Index i = 0; i < u_.size(); ++i)
      if (u_(i) > 0) face.push_back(i);
    const Index m = std::ssize(face);
    Eigen::VectorXd gradient(m);
    for (Index k = 0; k < m; ++k) gradient(k) = g_(face[k]) - kN;
    const double residual_before = gradient.cwiseAbs().maxCoeff();
    if (residual_before <= 8 * kN * kEps) return false;
    Eigen::MatrixXd hessian(m, m);
    for (Index k = 0; k < m; ++k)
      for (Index l = 0; l <= k; ++l) {
        const double product = whitened_.col(face[k]).dot(whitened_.col(face[l]));
        hessian(k, l) = hessian(l, k) = product * product;
      }
    Eigen::VectorXd direction = shortest_least_squares(hessian, gradient);
    // What the Hessian cannot reach is an ascent direction without curvature: follow it to the boundary.
    Eigen::VectorXd flat = gradient;
    for (Index k = 0; k < m; ++k) flat -= direction(k) * hessian.col(k);
    if (!(flat.norm() < 0.1 * gradient.norm())) direction = flat / (flat.norm() * kEps);
    if (!direction.allFinite() || !(direction.dot(gradient) > 0)) return false;

    double longest = std::numeric_limits<double>::infinity();
    Index blocking = -1;
    for (Index k = 0; k < direction.size(); ++k)
      if (direction(k) < 0 && -u_(face[k]) / direction(k) < longest) {
        longest = -u_(face[k]) / direction(k);
        blocking = k;
      }
    const Eigen::VectorXd old_u = u_;
    const double old_value = value(llt_, old_u);
    for (double step = std::min(1.0, longest); step > 1e-3 * std::min(1.0, longest); step /= 2) {
      for (Index k = 0; k < direction.size(); ++k)
        u_(face[k]) = std::max(0.0, old_u(face[k]) + step * direction(k));
      const bool hits = blocking >= 0 && step >= longest;
      if (hits) u_(face[blocking]) = 0;
      const auto llt = decompose(q_, u_);
      if (llt.positive && value(llt, u_) >= old_value - 16 * kEps) {
        update();
        if (hits) return true;
        double after = 0;
        for (Index i : face) after = std::max(after, std::abs(g_(i) - kN));
        return after < 0.9 * residual_before || residual_before > 1e-6;
      }
    }
    u_ = old_u;
    update();
    return false;
  }

  static double value(const Cholesky<kN>& llt, const Eigen::VectorXd& u) {
    double half_log = 0;  // of the determinant
    for (int j = 0; j < kN; ++j) half_log += std::log(llt.lower(j, j));
    return 2 * half_log - kN * (u.sum() - 1);
  }

  std::vector<Index> members_;
  Lifted q_, whitened_;
  Eigen::VectorXd u_, g_;
  Cholesky<kN> llt_;
};

/// Ladder of tests of points against the ellipsoid that a factor F defines: with G = F^{-1}, x is inside iff
/// |G (x - p)|^2 <= 1. In double, then in long double, each with an error bound, then in rationals.
template <int D>
class ExactBody {
 public:
  explicit ExactBody(const BasicEllipsoid<D>& body) : center_(body.center()) {
    p_ = exact::to_rational<D>(body.center());
    const auto f = exact::to_rational<D>(body.factor());
    const Rational det = exact::determinant<D>(f);
    det_squared_ = det * det;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        adjugate_[i][j] = cofactor(f, j, i);
        const Rational g = adjugate_[i][j] / det;
        inverse_(i, j) = static_cast<double>(g);
        wide_inverse_(i, j) = static_cast<long double>(g);
      }
  }

  template <typename T>
  struct Bounds {
    T lower, upper;
  };

  Bounds<double> bounds(const Vector<D>& x) const { return bounds_in<double>(inverse_, x); }
  Bounds<long double> wide_bounds(const Vector<D>& x) const {
    return bounds_in<long double>(wide_inverse_, x);
  }

  /// |adj(F) (x - p)|^2, to be held against det(F)^2.
  Rational scaled_form(const Vector<D>& x) const {
    checkpoint();  // all of a million points may come here
    Rational sum = 0;
    exact::RationalVector<D> d;
    for (int j = 0; j < D; ++j) d[j] = Rational(x(j)) - p_[j];
    for (int i = 0; i < D; ++i) {
      Rational y = 0;
      for (int j = 0; j < D; ++j) y += adjugate_[i][j] * d[j];
      sum += y * y;
    }
    return sum;
  }
  const Rational& scale() const { return det_squared_; }

  bool contains(const Vector<D>& x) const {
    const auto b = bounds(x);
    if (b.upper <= 1) return true;
    if (b.lower > 1) return false;
    const auto wide = wide_bounds(x);
    if (wide.upper <= 1) return true;
    if (wide.lower > 1) return false;
    return scaled_form(x) <= det_squared_;
  }

 private:
  /// Bounds on |G (x - p)|^2. A term of a component carries at most D+3 roundings (two for the entry of G,
  /// the difference, the product, D-1 sums), each of at most u = eps/2, so (D+4) u times the sum of the
  /// magnitudes bounds its error; 16 eps covers the few roundings of squaring and adding, the constant
  /// underflow.
  template <typename T>
  Bounds<T> bounds_in(const Eigen::Matrix<T, D, D>& inverse, const Vector<D>& x) const {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    Bounds<T> b{0, 0};
    Eigen::Matrix<T, D, 1> d;
    for (int j = 0; j < D; ++j) d(j) = T(x(j)) - T(center_(j));
    for (int i = 0; i < D; ++i) {
      T y = 0, size = 0;
      for (int j = 0; j < D; ++j) {
        const T term = inverse(i, j) * d(j);
        y += term;
        size += std::abs(term);
      }
      const T error = T(0.5) * (D + 5) * eps * size + T(1e-290), magnitude = std::abs(y);
      const T low = std::max(T(0), magnitude - error), high = magnitude + error;
      b.lower += low * low;
      b.upper += high * high;
    }
    return {b.lower * (1 - 16 * eps), b.upper * (1 + 16 * eps)};
  }

  static Rational cofactor(const exact::RationalMatrix<D>& m, int i, int j) {
    if constexpr (D == 2) {
      return (i + j) % 2 ? Rational(-m[1 - i][1 - j]) : m[1 - i][1 - j];
    } else {
      const int r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
      return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
  }

  Vector<D> center_;
  exact::RationalVector<D> p_;
  exact::RationalMatrix<D> adjugate_;
  Rational det_squared_;
  Square<D> inverse_;
  Eigen::Matrix<long double, D, D> wide_inverse_;
};

/// Least double s with s^2 >= x, or a few units in the last place above it.
double sqrt_up(const Rational& x) {
  double s = std::sqrt(static_cast<double>(x));
  while (Rational(s) * Rational(s) < x) s = std::nextafter(s, std::numeric_limits<double>::infinity());
  return s;
}

/// Factor by which the body must grow about its centre to hold every point, rounded up. From the bounds in
/// double where they are tight; otherwise in rationals, for the few points that long double leaves as
/// candidates.
template <int D>
double growth_needed(const ExactBody<D>& body, const Eigen::Ref<const Points<D>>& points, double slack) {
  double lower = 0, upper = 0;
  for (Index i = 0; i < points.cols(); ++i) {
    const auto b = body.bounds(points.col(i));
    lower = std::max(lower, b.lower);
    upper = std::max(upper, b.upper);
  }
  if (upper - lower <= slack * upper) return std::nextafter(std::sqrt(upper), 2 * upper + 1);
  long double wide_lower = 0;
  for (Index i = 0; i < points.cols(); ++i)
    if (body.bounds(points.col(i)).upper >= lower)
      wide_lower = std::max(wide_lower, body.wide_bounds(points.col(i)).lower);
  Rational most = 0;
  for (Index i = 0; i < points.cols(); ++i)
    if (body.bounds(points.col(i)).upper >= lower && body.wide_bounds(points.col(i)).upper >= wide_lower)
      most = std::max(most, body.scaled_form(points.col(i)));
  return sqrt_up(most / body.scale());
}

template <int D>
struct Principal {
  Vector<D> axes;
  Square<D> rotation;

  explicit Principal(const Square<D>& factor) {
    const LeftSingular<D> svd = left_singular<D>(factor);
    axes = svd.values;
    rotation = svd.u;
    if (rotation.determinant() < 0) rotation.col(D - 1) *= -1;
  }
};

template <int D>
BasicEllipsoid<D> principal_body(const Vector<D>& center, const Square<D>& factor) {
  const Principal<D> principal(factor);
  return BasicEllipsoid<D>::from_axes(center, principal.axes, principal.rotation);
}

/// The ellipsoid { p + F u } of the given factor, grown until it contains every point exactly. Turning F into
/// axes and a rotation rounds, so growth and check repeat, with a margin that doubles, until the check
/// passes.
template <int D>
BasicEllipsoid<D> containing_body(const Vector<D>& center, const Square<D>& factor,
                                  const Eigen::Ref<const Points<D>>& points, double tolerance) {
  auto [axes, rotation] = Principal<D>(factor);
  for (double margin = 2 * kEps;; margin *= 2) {
    checkpoint();
    const ExactBody<D> trial(BasicEllipsoid<D>::from_axes(center, axes, rotation));
    axes *= growth_needed<D>(trial, points, std::max(1e-3 * tolerance, 64 * kEps)) * (1 + margin);
    const auto body = BasicEllipsoid<D>::from_axes(center, axes, rotation);
    const ExactBody<D> check(body);
    bool all = true;
    for (Index i = 0; i < points.cols() && all; ++i) all = check.contains(points.col(i));
    if (all) return body;
  }
}

/// volume(body) / least volume is at most |det F| / (D^(D/2) sqrt(det C)), C the covariance of the points
/// under any weights of sum 1. For the optimal body { (x-c*)^T A (x-c*) <= 1 } holds every point, so the
/// weighted mean of the left sides, tr(A C) + (c-c*)^T A (c-c*), is at most 1; hence tr(A C) <= 1, det(A C)
/// <= D^(-D), and the least volume is V_D / sqrt(det A) >= V_D D^(D/2) sqrt(det C).
template <int D>
double volume_ratio_bound(const BasicEllipsoid<D>& body, const Eigen::Ref<const Points<D>>& points,
                          const std::vector<Index>& support, const std::vector<double>& weights) {
  exact::RationalMatrix<D> second{};
  exact::RationalVector<D> first{};
  Rational sum = 0;
  for (std::size_t k = 0; k < support.size(); ++k) {
    const Vector<D> x = points.col(support[k]);
    const Rational w(weights[k]);
    sum += w;
    for (int i = 0; i < D; ++i) {
      const Rational wx = w * (Rational(x(i)) - Rational(body.center()(i)));
      first[i] += wx;
      for (int j = 0; j <= i; ++j) second[i][j] += wx * (Rational(x(j)) - Rational(body.center()(j)));
    }
  }
  exact::RationalMatrix<D> covariance;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j <= i; ++j)
      covariance[i][j] = covariance[j][i] = second[i][j] / sum - first[i] * first[j] / (sum * sum);
  const Rational det_f = exact::determinant<D>(exact::to_rational<D>(body.factor()));
  const Rational det_c = exact::determinant<D>(covariance);
  if (det_c.sign() <= 0) return std::numeric_limits<double>::infinity();
  return sqrt_up(det_f * det_f / (Rational(D == 2 ? 4 : 27) * det_c));
}

/// g_i - 1 for every point, and for each orthant about the centre the point where it is largest: points that
/// stick out in different directions, so that one pass gives the working set several new members.
template <int D>
struct Violations {
  double largest = 0;  // of g_i
  std::array<Index, 1 << D> worst;
  std::array<double, 1 << D> g;
};

template <int D>
Violations<D> violations(const Points<D>& y, const Vector<D>& mean, const Square<D>& covariance) {
  Violations<D> v;
  v.worst.fill(-1);
  v.g.fill(0);
  const Square<D> inverse = cholesky<D>(covariance).lower_inverse();
  for (Index i = 0; i < y.cols(); ++i) {
    double g = 1;
    int orthant = 0;
    for (int j = 0; j < D; ++j) {
      double z = 0;
      for (int k = 0; k <= j; ++k) z += inverse(j, k) * (y(k, i) - mean(k));
      g += z * z;
      orthant |= int(z > 0) << j;
    }
    if (g > v.g[orthant]) {
      v.g[orthant] = g;
      v.worst[orthant] = i;
    }
  }
  v.largest = *std::ranges::max_element(v.g);
  return v;
}

}  // namespace

template <int D>
MinVolumeResult<D> min_volume_ellipsoid(const Eigen::Ref<const Points<D>>& points,
                                        const MinVolumeOptions& options) {
  constexpr int kN = D + 1;
  validate<D>(points, options);
  const Frame<D> frame = core_set_frame<D>(points);
  Points<D> y(D, points.cols());
  for (Index i = 0; i < points.cols(); ++i) {
    const Vector<D> from_origin = points.col(i) - frame.origin;
    for (int k = 0; k < D; ++k) y(k, i) = frame.axes.col(k).dot(from_origin) / frame.extents(k);
  }

  MinVolumeResult<D> result;
  DualAscent<D> dual;
  for (const Index i : frame.core_set) dual.add(i, y.col(i));
  dual.start_uniform();
  double largest = 0;
  while (true) {
    checkpoint();
    dual.maximize(std::clamp(0.01 * options.tolerance, 16 * kEps, 1e-3), options.max_iterations,
                  result.iterations);
    const Violations<D> v = violations<D>(y, dual.mean(), dual.covariance());
    largest = v.largest;
    result.optimality_gap = v.largest / kN - 1;
    if (result.optimality_gap <= options.tolerance) {
      result.status = MinVolumeStatus::converged;
      break;
    }
    if (result.iterations >= options.max_iterations) break;
    dual.drop_interior();
    bool added = false;
    for (std::size_t k = 0; k < v.worst.size(); ++k)
      if (v.worst[k] >= 0 && v.g[k] > kN * (1 + 0.1 * result.optimality_gap) &&
          std::ranges::find(dual.members(), v.worst[k]) == dual.members().end()) {
        dual.add(v.worst[k], y.col(v.worst[k]));
        added = true;
      }
    if (!added) {
      result.status = MinVolumeStatus::rounding_limit;
      break;
    }
  }

  std::vector<std::pair<Index, double>> support;
  for (std::size_t k = 0; k < dual.members().size(); ++k)
    if (dual.weights()(Index(k)) > 0) support.emplace_back(dual.members()[k], dual.weights()(Index(k)));
  std::ranges::sort(support);
  for (const auto& [index, weight] : support) {
    result.support.push_back(index);
    result.weights.push_back(weight);
  }

  // In y the body is (y-c)^T C^{-1} (y-c) <= max g - 1 (source, (4.3), where n should read D).
  const Square<D> to_space = frame.axes * frame.extents.asDiagonal();
  const Square<D> root = cholesky<D>(dual.covariance()).lower;
  const Vector<D> center = frame.origin + to_space * dual.mean();
  const Square<D> factor = to_space * root * std::sqrt(largest - 1);
  if (options.certified) {
    result.body = containing_body<D>(center, factor, points, options.tolerance);
    result.volume_ratio_bound = volume_ratio_bound<D>(result.body, points, result.support, result.weights);
  } else {
    result.body = principal_body<D>(center, factor);
    result.volume_ratio_bound = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

template MinVolumeResult<2> min_volume_ellipsoid<2>(const Eigen::Ref<const Eigen::Matrix2Xd>&,
                                                    const MinVolumeOptions&);
template MinVolumeResult<3> min_volume_ellipsoid<3>(const Eigen::Ref<const Eigen::Matrix3Xd>&,
                                                    const MinVolumeOptions&);

}  // namespace vericone
