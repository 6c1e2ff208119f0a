// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/uncertain/probability.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/stop.h>
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/owens_t.hpp>
#include <cmath>
#include <numbers>
#include <vector>

namespace vericone {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using Factor = Eigen::Matrix<double, 2, 3>;

constexpr double kRounding = 1e-11;      // of every length
constexpr double kTermRounding = 1e-14;  // of every term of the integral
constexpr double kLeastTurn = 1e-5;      // of an arc: its corner is then right to kRounding

/// Of a standard normal variable.
double phi(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Symmetric, finite, and positive semidefinite to rounding.
template <typename Matrix>
bool is_covariance(const Matrix& m) {
  if (!m.allFinite() || m != m.transpose()) return false;
  // A pivot that is negative beyond rounding shows in Gauss's elimination, largest pivot first.
  Matrix rest = m;
  const double size = m.cwiseAbs().maxCoeff();
  for (int step = 0; step < m.rows(); ++step) {
    Eigen::Index k = 0;
    const double pivot = rest.diagonal().maxCoeff(&k);
    if (pivot <= 1e-13 * size) return rest.cwiseAbs().maxCoeff() <= 1e-13 * size;
    const auto column = rest.col(k).eval();
    rest -= column * column.transpose() / pivot;
    rest.row(k).setZero();
    rest.col(k).setZero();
  }
  return true;
}

void require_covariance(const Matrix3d& m, const char* field) {
  if (!is_covariance(m))
    throw InputError(field, to_text(m(0, 0)) + ", ...", "a symmetric, positive semidefinite matrix");
}

/// Two unit vectors across w.
std::array<Vector3d, 2> across(const Vector3d& w) {
  const Vector3d u = w.stableNormalized();
  const Vector3d e1 = u.unitOrthogonal();
  return {e1, u.cross(e1)};
}

/// The sum of two ellipses, images of the unit ball by two factors, about 0.
struct Sum {
  Factor a, b;

  /// The boundary's point with outer normal n.
  Vector2d point(const Vector2d& n) const {
    const Vector3d p = a.transpose() * n, q = b.transpose() * n;
    return a * (p / p.norm()) + b * (q / q.norm());
  }
};

/// What the error has to hit, about `center`: polygons are made of a body that is nearly round, and mapped.
struct Shadow {
  Vector2d center;
  Matrix2d map;
  Sum round;

  Shadow(const Vector2d& about, const Factor& a, const Factor& b) : center(about) {
    map = Matrix2d(a * a.transpose() + b * b.transpose()).llt().matrixL();
    const Matrix2d inverse = map.inverse();
    round = {inverse * a, inverse * b};
  }
  /// `grown`: 1 and a little, or less.
  Vector2d point(const Vector2d& of_round, double grown) const { return center + map * (grown * of_round); }
};

/// An arc of the round body's boundary between the points with normals at two angles, and the corner of the
/// tangents there.
struct Arc {
  double from, to;
  Vector2d p, q, corner;
  double gap;  // probability between the chord and the corner

  bool operator<(const Arc& other) const { return gap < other.gap; }
};

/// The standard normal measure of a polygon, edge by edge: that of the triangle with the origin is an angle
/// less exp(-r^2/2) integrated over it, and the angles of a closed polygon sum up to a turn or nothing.
double edge_term(const Vector2d& p, const Vector2d& q) {
  const Vector2d along = q - p;
  const double length = along.norm();
  if (!(length > 0)) return 0;
  const Vector2d unit = along / length;
  const double h =
      p.x() * unit.y() - p.y() * unit.x();  // of the line from the origin, positive where that is left
  if (h == 0) return p.dot(unit) < 0 && q.dot(unit) > 0 ? -0.5 : 0;
  const double from = p.dot(unit), distance = std::abs(h);
  if (length < 1 && std::hypot(distance, std::max({0.0, from, -from - length})) > 2 * length) {
    // Far from the origin the integrand is nearly a polynomial and keeps its digits, however small it is.
    const auto density = [&](double s) {
      const double r2 = h * h + s * s;
      return std::exp(-0.5 * r2) / r2;
    };
    return -h / (2 * std::numbers::pi) *
           boost::math::quadrature::gauss<double, 10>::integrate(density, from, from + length);
  }
  const double part = boost::math::owens_t(distance, (from + length) / distance) -
                      boost::math::owens_t(distance, from / distance);
  return h > 0 ? -part : part;
}

Arc arc_between(const Shadow& shadow, double from, double to) {
  Arc arc;
  arc.from = from;
  arc.to = to;
  const Vector2d n(std::cos(from), std::sin(from)), m(std::cos(to), std::sin(to));
  arc.p = shadow.round.point(n);
  arc.q = shadow.round.point(m);
  // From p along its tangent, until m.x = m.q.
  const Vector2d tangent(-n.y(), n.x());
  arc.corner = arc.p + tangent * (m.dot(arc.q - arc.p) / m.dot(tangent));
  const Vector2d p = shadow.point(arc.p, 1), q = shadow.point(arc.q, 1), c = shadow.point(arc.corner, 1);
  arc.gap = to - from > kLeastTurn ? std::abs(edge_term(p, c) + edge_term(c, q) - edge_term(p, q)) : 0;
  return arc;
}

struct Measure {
  double value = 0, rounding = 0;
};

Measure polygon_measure(const std::vector<Vector2d>& corners) {
  Measure m;
  bool inside = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &p = corners[i], &q = corners[(i + 1) % corners.size()];
    inside = inside && p.x() * q.y() - p.y() * q.x() >= 0;
    const double term = edge_term(p, q);
    m.value += term;
    m.rounding += std::abs(term);
  }
  m.rounding *= kTermRounding;
  if (inside) m.value += 1, m.rounding += 1e-15;
  return m;
}

/// The arcs in order.
class Outline {
 public:
  explicit Outline(const Shadow& shadow) : shadow_(shadow) {
    constexpr int kStart = 16;
    const auto angle = [](int i) { return 2 * std::numbers::pi * i / kStart; };
    for (int i = 0; i < kStart; ++i) arcs_.push_back(arc_between(shadow, angle(i), angle(i + 1)));
  }

  int points() const { return int(arcs_.size()); }

  std::vector<Vector2d> inner() const {
    std::vector<Vector2d> corners;
    for (const Arc& arc : arcs_) corners.push_back(shadow_.point(arc.p, 1 - kRounding));
    return corners;
  }
  std::vector<Vector2d> outer() const {
    std::vector<Vector2d> corners;
    for (const Arc& arc : arcs_) {
      corners.push_back(shadow_.point(arc.p, 1 + kRounding));
      corners.push_back(shadow_.point(arc.corner, 1 + kRounding));
    }
    return corners;
  }

  /// Cuts the arcs in two that hold most of what is open; false where none can be.
  bool refine() {
    std::vector<double> gaps;
    for (const Arc& arc : arcs_) gaps.push_back(arc.gap);
    const auto middle = gaps.begin() + std::ptrdiff_t(gaps.size() / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    const double least = *middle;
    std::vector<Arc> finer;
    bool any = false;
    for (const Arc& arc : arcs_) {
      if (!(arc.gap > 0) || arc.gap < least) {
        finer.push_back(arc);
        continue;
      }
      any = true;
      const double half = 0.5 * (arc.from + arc.to);
      finer.push_back(arc_between(shadow_, arc.from, half));
      finer.push_back(arc_between(shadow_, half, arc.to));
    }
    arcs_ = std::move(finer);
    return any;
  }

 private:
  const Shadow& shadow_;
  std::vector<Arc> arcs_;
};

/// Of the standard normal distribution over a shadow.
Probability standard_measure(const Shadow& shadow, const ProbabilityOptions& options) {
  Outline outline(shadow);
  while (true) {
    checkpoint();
    const Measure least = polygon_measure(outline.inner()), most = polygon_measure(outline.outer());
    Probability p;
    p.least = std::clamp(least.value - least.rounding, 0.0, 1.0);
    p.most = std::clamp(most.value + most.rounding, p.least, 1.0);
    // Beside a smooth boundary the area that chords cut off is twice that left at corners.
    p.estimate = std::clamp((least.value + 2 * most.value) / 3, p.least, p.most);
    p.points = outline.points();
    if (p.most - p.least <= std::max(options.absolute, options.relative * p.most) ||
        2 * outline.points() > options.most_points || !outline.refine())
      return p;
  }
}

/// Of the line x = t u through 0, the t within a polygon.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};
Span span_of(const std::vector<Vector2d>& corners, const Vector2d& u) {
  const Vector2d side(-u.y(), u.x());
  Span span;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const double s = side.dot(p), t = side.dot(q);
    if ((s <= 0) == (t <= 0)) continue;
    const double x = u.dot(p + (q - p) * (s / (s - t)));
    span.low = std::min(span.low, x), span.high = std::max(span.high, x);
  }
  return span;
}

/// The error lies on a line through 0 along u with this deviation (0: it is none).
Probability line_measure(const Shadow& shadow, const Vector2d& u, double deviation) {
  Outline outline(shadow);
  for (int i = 0; i < 12; ++i) outline.refine();

  const auto measure = [&](const Span& span) {
    if (!(span.low <= span.high)) return 0.0;
    if (!(deviation > 0)) return span.low <= 0 && span.high >= 0 ? 1.0 : 0.0;
    // The smaller tail, so that nothing cancels.
    const double x = span.low / deviation, y = span.high / deviation;
    return x > 0 ? phi(-x) - phi(-y) : phi(y) - phi(x);
  };
  Probability p;
  const double rounding = deviation > 0 ? kRounding : 0;
  p.least = std::max(0.0, measure(span_of(outline.inner(), u)) * (1 - rounding));
  p.most = std::clamp(measure(span_of(outline.outer(), u)) * (1 + rounding), p.least, 1.0);
  p.estimate = 0.5 * (p.least + p.most);
  p.points = outline.points();
  return p;
}

}  // namespace

Probability probability_of_passing_through(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w,
                                           const Matrix3d& position_covariance,
                                           const ProbabilityOptions& options) {
  if (!w.allFinite() || w.isZero(0))
    throw InputError("relative_velocity", to_text(w.norm()), "a finite velocity that is not zero (m/s)");
  require_covariance(position_covariance, "position_covariance");
  if (!(options.relative >= 0))
    throw InputError("relative", to_text(options.relative), "a number, 0 or more");
  if (!(options.absolute >= 0))
    throw InputError("absolute", to_text(options.absolute), "a number, 0 or more");
  if (options.most_points < 16)
    throw InputError("most_points", std::to_string(options.most_points), "16 or more");
  const auto [e1, e2] = across(w);
  Eigen::Matrix<double, 2, 3> flat;
  flat << e1.transpose(), e2.transpose();
  // Bodies meet where the error d of c has c + d in the shadow of A + (-B) about 0.
  const Vector2d center = flat * (a.center() - b.center());
  const Factor of_a = flat * a.factor(), of_b = flat * b.factor();
  const Matrix2d c = flat * position_covariance * flat.transpose();
  // Along its own axes.
  const double angle = 0.5 * std::atan2(c(0, 1) + c(1, 0), c(0, 0) - c(1, 1));
  const Vector2d u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
  const double large = u.dot(c * u), small = std::max(0.0, v.dot(c * v));
  if (!(small > 1e-14 * large))
    return line_measure(Shadow(center, of_a, of_b), u, std::sqrt(std::max(0.0, large)));
  Matrix2d whiten;
  whiten << u.transpose() / std::sqrt(large), v.transpose() / std::sqrt(small);
  return standard_measure(Shadow(whiten * center, whiten * of_a, whiten * of_b), options);
}

namespace {

/// The bound for one normal.
class NormalBound {
 public:
  NormalBound(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w, const GaussianErrors& errors,
              double horizon)
      : a_(a), b_(b), c_(b.center() - a.center()), w_(w), errors_(errors), horizon_(horizon) {}

  double operator()(const Vector3d& n) const {
    const double sizes = a_.radius(n) + b_.radius(n);
    // Rounded down.
    const double gap = n.dot(c_) - sizes - 1e-14 * (sizes + c_.norm());
    if (!(gap > 0)) return 1;
    const double now = tail(gap, n.dot(errors_.position * n));
    const double closing = n.dot(w_) + 1e-14 * w_.norm(), of_w = n.dot(errors_.velocity * n);
    double later = tail(-closing, of_w);
    if (std::isfinite(horizon_)) {
      const double variance =
          n.dot(errors_.position * n) - 2 * horizon_ * n.dot(errors_.cross * n) + horizon_ * horizon_ * of_w;
      later = std::min(later, tail(gap - horizon_ * closing, std::max(0.0, variance)));
    }
    return std::min(1.0, (now + later) * (1 + 1e-12));
  }

 private:
  /// That a normal error takes a margin away.
  static double tail(double margin, double variance) {
    if (!(variance > 0)) return margin >= 0 ? 0 : 1;
    return phi(-margin / std::sqrt(variance * (1 + 1e-12)));
  }

  const Ellipsoid &a_, &b_;
  Vector3d c_, w_;
  const GaussianErrors& errors_;
  double horizon_;
};

}  // namespace

ProbabilityBound collision_probability_bound(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w,
                                             const GaussianErrors& errors, double horizon) {
  if (!w.allFinite()) throw InputError("relative_velocity", to_text(w.norm()), "finite (m/s)");
  if (!(horizon > 0)) throw InputError("horizon", to_text(horizon), "a positive number (s), or infinity");
  require_covariance(errors.position, "position_covariance");
  require_covariance(errors.velocity, "velocity_covariance");
  Eigen::Matrix<double, 6, 6> all;
  all << errors.position, errors.cross, errors.cross.transpose(), errors.velocity;
  if (!is_covariance(all))
    throw InputError("cross_covariance", to_text(errors.cross(0, 0)) + ", ...",
                     "such that position and velocity together have a positive semidefinite covariance");
  const NormalBound bound(a, b, w, errors, horizon);
  // Directions all around, then the best one turned in steps that halve.
  ProbabilityBound best;
  const auto offer = [&](const Vector3d& n) {
    const double value = bound(n);
    if (!(value < best.most)) return false;
    best = {value, n};
    return true;
  };
  constexpr int kDirections = 200;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2.0 * i + 1) / kDirections, r = std::sqrt(1 - z * z),
                 t = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
    offer({r * std::cos(t), r * std::sin(t), z});
  }
  offer((b.center() - a.center()).normalized());
  if (best.normal.isZero(0)) return best;
  double step = 0.15;
  for (int i = 0; i < 200 && step > 1e-6; ++i) {
    const Vector3d n = best.normal, e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    bool better = false;
    for (int k = 0; k < 6; ++k) {
      const double t = 0.7 * i + k * std::numbers::pi / 3;
      better = offer((n + step * (std::cos(t) * e1 + std::sin(t) * e2)).normalized()) || better;
    }
    if (!better) step *= 0.6;
  }
  return best;
}

}  // namespace vericone
