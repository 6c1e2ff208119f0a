// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/predicates.h>

#include <vericone/cones/contact_frame.h>
#include <vericone/geometry/error.h>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "contact_polynomial.h"

namespace vericone {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

// Roundings along the longest path to each quantity, counted from the inputs. c: 1 (difference of the
// centres). S: 3 (three products of factors summed). u, v = w_i / w_k, w_j / w_k: 3 (two differences of
// velocities, the quotient).
//   affine_shadow: ik, jk   u S (3+3+1), 1 sum                    ->  8
//                  ii, jj   1 sum, u (8+1+3+1), 1 sum             -> 14
//                  ij       v S 1 sum (8), u jk (8+3+1), 1 sum    -> 13
//   d:             c + u c (1+3+1), 1 sum                         ->  6
//   k0, k3:        14+14+1 product, 1 sum                         -> 30
//   mixed:         14+14+1 product, 2 sums                        -> 31
//   k1, k2:        d d M (6+6+1 + 14 + 1 = 28), 2 sums -> 30; mixed + k0 -> 32; 1 sum -> 33
//   discriminant:  k12 = 33+33+1 -> 67; 18 k03 = 30+30+1 + 1 -> 62; their sum -> 68, times k12 -> 136;
//                  k2 k2 (k2 k0): 67 + 64 + 1, 1 sum -> 133; 27 k03 k03: 61+61+1 + 1 -> 124; 2 sums -> 138
// The magnitudes carry as many roundings of their own; 3 % covers them and the terms of second order.
constexpr double kShapeBound = 1.03 * 33 * kUnitRoundoff;
constexpr double kDiscriminantBound = 1.03 * 138 * kUnitRoundoff;
// normal.(u, v, 1): 3+1 and 2 sums, counted on the normal as it is.
constexpr double kAheadBound = 1.03 * 6 * kUnitRoundoff;
// Products below the smallest normal number lose more than a relative rounding. Inputs are scaled so that no
// intermediate factor exceeds about 2^150, hence all such losses together stay far below this.
constexpr double kUnderflowBound = 1e-250;

/// A floating-point value of a polynomial in the inputs together with the same polynomial evaluated on
/// absolute values. If no monomial went through more than K roundings, the value is within K (1 + tiny) u
/// times the magnitude of the exact one. Both live in one vector register: tracking costs no extra
/// instruction.
struct Tracked {
  using Pair = double __attribute__((vector_size(16)));
  using Bits = long long __attribute__((vector_size(16)));
  Pair pair;

  double value() const { return pair[0]; }
  double magnitude() const { return pair[1]; }

  static Tracked of(const double (&entry)[2]) { return {Pair{entry[0], entry[1]}}; }
  static Tracked minus(double x) { return {Pair{-x, std::abs(x)}}; }

  friend Tracked operator+(Tracked x, Tracked y) { return {x.pair + y.pair}; }
  friend Tracked operator-(Tracked x) {
    constexpr Bits kSignOfValue = {std::numeric_limits<long long>::min(), 0};
    return {reinterpret_cast<Pair>(reinterpret_cast<Bits>(x.pair) ^ kSignOfValue)};
  }
  friend Tracked operator-(Tracked x, Tracked y) { return x + (-y); }
  friend Tracked operator*(Tracked x, Tracked y) { return {x.pair * y.pair}; }
  friend Tracked operator*(Tracked x, int factor) { return {x.pair * static_cast<double>(factor)}; }

  /// Whether the exact value is certainly positive (1) or negative (-1).
  int sign(double relative_bound) const {
    const double bound = relative_bound * magnitude() + kUnderflowBound;
    return static_cast<int>(value() > bound) - static_cast<int>(value() < -bound);
  }
};

/// Position of entry (r, c) of a symmetric 3x3 matrix among its six.
constexpr int kPacked[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

/// Exactly the power of two in [|x|, 2|x|), as an exponent; 0 for 0.
int binary_exponent(double x) { return x == 0 ? 0 : std::ilogb(x) + 1; }

/// The coordinate to project along, that of the largest entry of w, and the two after it. No branches: the
/// directions of velocities are hard to predict.
struct DroppedAxis {
  int i, j, k;
  explicit DroppedAxis(const Eigen::Vector3d& w) {
    constexpr int kNext[] = {1, 2, 0, 1};
    const double x = std::abs(w.x()), y = std::abs(w.y()), z = std::abs(w.z());
    k = z > std::max(x, y) ? 2 : static_cast<int>(y > x);
    i = kNext[k];
    j = kNext[k + 1];
  }
};

/// Whether the point `x` (relative to the centre, off by at most `slack` in each coordinate) is inside the
/// body.
template <int D>
bool surely_inside(const BasicEllipsoid<D>& body, Eigen::Matrix<double, D, 1> x, double slack) {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;
  // At a scale of one, so that neither a determinant nor a square leaves the range; powers of two are exact.
  const double scale = std::ldexp(1.0, -binary_exponent(body.factor().cwiseAbs().maxCoeff()));
  const Matrix f = body.factor() * scale;
  x *= scale;
  slack *= scale;
  const Matrix inverse = f.inverse();
  const double inverse_norm = inverse.norm();
  // |I - F G| < 1/2 makes |F^{-1}| < 2 |G|, whatever G is.
  if (!(inverse_norm < 1e12) || !((Matrix::Identity() - f * inverse).norm() < 0.49)) return false;
  const Vector z = inverse * x;
  const Vector residual = (x - f * z).cwiseAbs();
  const double bound = residual.norm() + std::sqrt(D) * slack +
                       8 * kUnitRoundoff * (x.norm() + (f.cwiseAbs() * z.cwiseAbs()).norm());
  return z.norm() + 2 * inverse_norm * bound < 1 - 16 * kUnitRoundoff;
}

void require_finite_velocity(const Eigen::Vector3d& v, const char* field) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(v(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(v(i)),
                       "a finite number (m/s)");
}

}  // namespace

const char* to_string(Relation relation) {
  switch (relation) {
    case Relation::disjoint:
      return "disjoint";
    case Relation::touching:
      return "touching";
    case Relation::overlapping:
      return "overlapping";
  }
  return "";
}

const char* to_string(Membership membership) {
  switch (membership) {
    case Membership::in:
      return "in";
    case Membership::on:
      return "on";
    case Membership::out:
      return "out";
  }
  return "";
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::in:
      return "in";
    case Verdict::on:
      return "on";
    case Verdict::out:
      return "out";
    case Verdict::overlapping:
      return "overlapping";
    case Verdict::touching:
      return "touching";
  }
  return "";
}

template <int D>
bool triage_separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                      const Eigen::Matrix<double, D, 1>& n) {
  // g(n) = n.c - |F_A^T n| - |F_B^T n|. Each term is a sum of at most three products of inputs with one
  // rounding each, then a square root and two sums: fewer than 12 roundings.
  const Eigen::Matrix<double, D, 1> c = b.center() - a.center(), m = n.cwiseAbs();
  const double g = n.dot(c) - a.radius(n) - b.radius(n);
  const double magnitude = m.dot(c.cwiseAbs()) + (a.factor().cwiseAbs().transpose() * m).norm() +
                           (b.factor().cwiseAbs().transpose() * m).norm();
  return std::isfinite(magnitude) && magnitude > 1e-140 && g > 16 * kUnitRoundoff * magnitude;
}

template <int D>
bool separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, const Eigen::Matrix<double, D, 1>& n) {
  if (!n.allFinite()) return false;
  if (triage_separates<D>(a, b, n)) return true;
  // n.c > sqrt(q_A) + sqrt(q_B), sign first, then squared twice.
  using exact::Integer;
  const exact::PairOnGrid<D> pair(a, b);
  const auto m = exact::direction_on_grid<D>(n);
  Integer along = 0, qa = 0, qb = 0;
  for (int i = 0; i < D; ++i) {
    along += pair.c[i] * m[i];
    for (int j = 0; j < D; ++j) {
      const Integer mm = m[i] * m[j];
      qa += pair.a[i][j] * mm;
      qb += pair.b[i][j] * mm;
    }
  }
  if (along.sign() <= 0) return false;
  const Integer rest = along * along - qa - qb;
  return rest.sign() > 0 && rest * rest > 4 * qa * qb;
}

template <int D>
std::optional<Relation> triage_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                        const ContactFrame<D>& frame) {
  if (!(frame.contact < std::numeric_limits<double>::max()) || !frame.center.allFinite()) return std::nullopt;
  if (frame.contact > 1) {
    if (triage_separates<D>(a, b, frame.separating_normal())) return Relation::disjoint;
    return std::nullopt;
  }
  // At the maximiser both bodies contain y = c / (1 + x sigma^2); it certifies the overlap.
  Eigen::Matrix<double, D, 1> y;
  for (int i = 0; i < D; ++i) y(i) = frame.center(i) / (1 + frame.ratio * frame.sigma(i) * frame.sigma(i));
  const Eigen::Matrix<double, D, 1> x = frame.to_space * y, c = b.center() - a.center();
  const double slack = 4 * kUnitRoundoff * (x.cwiseAbs().maxCoeff() + c.cwiseAbs().maxCoeff());
  if (surely_inside<D>(a, x, 0) && surely_inside<D>(b, x - c, slack)) return Relation::overlapping;
  return std::nullopt;
}

template <int D>
Relation exact_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  const auto p = exact::contact_polynomial<D>(exact::PairOnGrid<D>(a, b));
  const int roots = exact::distinct_positive_roots(p);
  return roots == 0 ? Relation::overlapping : roots == 1 ? Relation::touching : Relation::disjoint;
}

template <int D>
Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  return relation<D>(a, b, ContactFrame<D>(a, b));
}

template <int D>
Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, const ContactFrame<D>& frame) {
  if (const auto answer = triage_relation<D>(a, b, frame)) return *answer;
  return exact_relation<D>(a, b);
}

template bool separates<2>(const Ellipse&, const Ellipse&, const Eigen::Vector2d&);
template bool separates<3>(const Ellipsoid&, const Ellipsoid&, const Eigen::Vector3d&);
template bool triage_separates<2>(const Ellipse&, const Ellipse&, const Eigen::Vector2d&);
template bool triage_separates<3>(const Ellipsoid&, const Ellipsoid&, const Eigen::Vector3d&);
template std::optional<Relation> triage_relation<2>(const Ellipse&, const Ellipse&, const ContactFrame<2>&);
template std::optional<Relation> triage_relation<3>(const Ellipsoid&, const Ellipsoid&,
                                                    const ContactFrame<3>&);
template Relation relation<2>(const Ellipse&, const Ellipse&, const ContactFrame<2>&);
template Relation relation<3>(const Ellipsoid&, const Ellipsoid&, const ContactFrame<3>&);
template Relation exact_relation<2>(const Ellipse&, const Ellipse&);
template Relation exact_relation<3>(const Ellipsoid&, const Ellipsoid&);
template Relation relation<2>(const Ellipse&, const Ellipse&);
template Relation relation<3>(const Ellipsoid&, const Ellipsoid&);

ConeOracle::ConeOracle(const Ellipsoid& a, const Ellipsoid& b) : a_(a), b_(b) {
  const ContactFrame<3> frame(a, b);
  relation_ = vericone::relation<3>(a, b, frame);
  if (relation_ == Relation::disjoint) {
    normal_ = frame.separating_normal();
    normal_certified_ = separates<3>(a, b, normal_);
    if (!normal_certified_) {
      // The bodies are closer than rounding: the exact maximiser, rounded, may do better.
      const exact::PairOnGrid<3> pair(a, b);
      const auto n =
          exact::contact_normal(pair, exact::between_positive_roots(exact::contact_polynomial<3>(pair), 0));
      const exact::Integer largest =
          std::max({exact::Integer(abs(n[0])), exact::Integer(abs(n[1])), exact::Integer(abs(n[2]))});
      for (int i = 0; i < 3; ++i)
        normal_(i) = static_cast<double>(exact::Integer((n[i] << 64) / largest)) * 0x1p-64;
      normal_certified_ = separates<3>(a, b, normal_);
    }
  }
  // Powers of two: scaling is exact.
  const Eigen::Vector3d c = b.center() - a.center();
  const int e = binary_exponent(c.cwiseAbs().maxCoeff());
  if (std::abs(e) > 400) return;
  const double scale = std::ldexp(1.0, -e), scale2 = scale * scale;
  usable_ = true;
  const auto fill = [&](const Ellipsoid& body, double(Scaled::*entries)[6][2]) {
    const Eigen::Matrix3d f = body.factor().cwiseAbs() * scale;
    const Eigen::Matrix3d magnitude = body.defined_by_factor()
                                          ? Eigen::Matrix3d(f * f.transpose())
                                          : Eigen::Matrix3d(body.shape().cwiseAbs() * scale2);
    for (int k = 0; k < 3; ++k)
      for (int r = 0; r < 3; ++r)
        for (int col = r; col < 3; ++col) {
          const int row = (k + 1 + r) % 3, column = (k + 1 + col) % 3;
          auto& entry = (scaled_[k].*entries)[kPacked[r][col]];
          entry[0] = body.shape()(row, column) * scale2;
          entry[1] = magnitude(row, column);
        }
    usable_ = usable_ && magnitude.maxCoeff() < 0x1p20 && magnitude.diagonal().minCoeff() > 1e-40;
  };
  fill(a, &Scaled::shape_a);
  fill(b, &Scaled::shape_b);
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) {
      const int row = (k + 1 + r) % 3;
      scaled_[k].c[r][0] = c(row) * scale;
      scaled_[k].c[r][1] = std::abs(c(row)) * scale;
      scaled_[k].normal[r][0] = r < 2 ? -normal_(row) : normal_(row);
      scaled_[k].normal[r][1] = std::abs(normal_(row));
    }
}

std::optional<Membership> ConeOracle::triage_membership(const Eigen::Vector3d& w) const noexcept {
  const DroppedAxis axis(w);
  const double wk = w(axis.k);
  if (!(std::abs(wk) > 0 && std::abs(wk) <= std::numeric_limits<double>::max() && usable_)) {
    if (w.x() == 0 && w.y() == 0 && w.z() == 0) return Membership::out;
    return std::nullopt;
  }
  const Scaled& scaled = scaled_[axis.k];
  const Tracked::Pair quotients = Tracked::Pair{w(axis.i), w(axis.j)} / Tracked::Pair{wk, wk};
  const Tracked minus_u = Tracked::minus(quotients[0]), minus_v = Tracked::minus(quotients[1]);
  // The side of a plane that separates the bodies: K lies on the positive one.
  const auto n = [&scaled](int r) { return Tracked::of(scaled.normal[r]); };
  const Tracked height = n(0) * minus_u + n(1) * minus_v + n(2);
  const int ahead = normal_certified_ ? (wk > 0 ? 1 : -1) * height.sign(kAheadBound) : 0;
  if (ahead < 0) return Membership::out;

  const auto a = [&scaled](int r, int col) { return Tracked::of(scaled.shape_a[kPacked[r][col]]); };
  const auto b = [&scaled](int r, int col) { return Tracked::of(scaled.shape_b[kPacked[r][col]]); };
  const auto c = [&scaled](int r) { return Tracked::of(scaled.c[r]); };
  const ContactCubic<Tracked> cubic(affine_shadow<Tracked>(a, minus_u, minus_v, 0, 1, 2),
                                    affine_shadow<Tracked>(b, minus_u, minus_v, 0, 1, 2),
                                    c(0) + minus_u * c(2), c(1) + minus_v * c(2));
  const int discriminant = cubic.discriminant().sign(kDiscriminantBound);
  const int k1 = cubic.k1.sign(kShapeBound), k2 = cubic.k2.sign(kShapeBound);
  const bool apart = (discriminant > 0) & ((k1 > 0) | (k2 > 0));
  const bool meets = (ahead > 0) & ((discriminant < 0) | ((discriminant > 0) & (k1 < 0) & (k2 < 0)));
  if (!(apart | meets)) return std::nullopt;
  return apart ? Membership::out : Membership::in;
}

Membership ConeOracle::naive_membership(const Eigen::Vector3d& w) const noexcept {
  const DroppedAxis axis(w);
  const Scaled& scaled = scaled_[axis.k];
  const double minus_u = -w(axis.i) / w(axis.k), minus_v = -w(axis.j) / w(axis.k);
  const auto a = [&scaled](int r, int col) { return scaled.shape_a[kPacked[r][col]][0]; };
  const auto b = [&scaled](int r, int col) { return scaled.shape_b[kPacked[r][col]][0]; };
  const auto c = [&scaled](int r) { return scaled.c[r][0]; };
  const ContactCubic<double> cubic(affine_shadow<double>(a, minus_u, minus_v, 0, 1, 2),
                                   affine_shadow<double>(b, minus_u, minus_v, 0, 1, 2), c(0) + minus_u * c(2),
                                   c(1) + minus_v * c(2));
  const double d = cubic.discriminant();
  if (d > 0 && (cubic.k1 > 0 || cubic.k2 > 0)) return Membership::out;
  if (!(normal_.dot(w) > 0)) return Membership::out;
  return d == 0 ? Membership::on : Membership::in;
}

Membership ConeOracle::exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  using exact::Integer;
  const auto w = exact::difference_on_grid<3>(v_a, v_b);
  if (w[0] == 0 && w[1] == 0 && w[2] == 0) return Membership::out;
  const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  const exact::PairOnGrid<3> pair(a_, b_);
  const auto entry = [](const exact::IntegerMatrix<3>& s) {
    return [&s](int r, int col) -> const Integer& { return s[r][col]; };
  };
  const auto ma = shadow<Integer>(entry(pair.a), w[i], w[j], w[k], i, j, k);
  const auto mb = shadow<Integer>(entry(pair.b), w[i], w[j], w[k], i, j, k);
  const ContactCubic<Integer> cubic(ma, mb, w[k] * pair.c[i] - w[i] * pair.c[k],
                                    w[k] * pair.c[j] - w[j] * pair.c[k]);
  const int discriminant = cubic.discriminant().sign();
  const bool positive_pair = cubic.k1 > 0 || cubic.k2 > 0;
  if (discriminant > 0 && positive_pair) return Membership::out;
  // The line meets K; on which side of the origin? Any strictly separating normal tells.
  const auto n =
      normal_certified_
          ? exact::direction_on_grid<3>(normal_)
          : exact::contact_normal(pair, exact::between_positive_roots(exact::contact_polynomial<3>(pair), 0));
  const Integer ahead = n[0] * w[0] + n[1] * w[1] + n[2] * w[2];
  if (ahead.sign() < 0) return Membership::out;
  return discriminant == 0 && positive_pair ? Membership::on : Membership::in;
}

// The first rung has no answer for numbers that are not finite, so they are looked for after it.

Membership ConeOracle::membership(const Eigen::Vector3d& w) const {
  if (const auto answer = triage_membership(w)) return *answer;
  require_finite_velocity(w, "agent_velocity");
  return exact_membership(w, Eigen::Vector3d::Zero());
}

Membership ConeOracle::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  const Eigen::Vector3d w = v_a - v_b;
  // A difference that rounds to zero or to infinity is not a relative error of one rounding.
  if (w.x() != 0 || w.y() != 0 || w.z() != 0)
    if (const auto answer = triage_membership(w)) return *answer;
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  return exact_membership(v_a, v_b);
}

Verdict ConeOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  if (relation_ == Relation::overlapping) return Verdict::overlapping;
  if (relation_ == Relation::touching) return Verdict::touching;
  switch (membership(v_a, v_b)) {
    case Membership::in:
      return Verdict::in;
    case Membership::on:
      return Verdict::on;
    case Membership::out:
      return Verdict::out;
  }
  return Verdict::out;
}

}  // namespace vericone
