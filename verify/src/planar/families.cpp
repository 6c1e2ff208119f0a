// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/verify/planar/campaign.h>

#include <algorithm>
#include <cmath>

namespace vericone::verify {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

class Random : public SeededRandom {
 public:
  Random(PlanarFamily family, std::uint64_t seed, std::uint64_t index)
      : SeededRandom(static_cast<std::uint32_t>(family), seed, index) {}

  Vector2d direction() { return SeededRandom::direction<2>(); }
  Vector2d axes() {
    const double first = uniform(1, 10);
    return {first, uniform(1, 10)};
  }
  Vector2d near_origin() {
    const double x = uniform(-10, 10);
    return {x, uniform(-10, 10)};
  }
  double separation() { return uniform(1.2, 5); }
};

/// `x` to 20 bits after the point: sums and products of a few such numbers are exact.
double coarse(double x) { return std::round(x * 0x1p20) * 0x1p-20; }

Matrix2d rotation(const Vector2d& first_axis) {
  return (Matrix2d() << first_axis.x(), -first_axis.y(), first_axis.y(), first_axis.x()).finished();
}

/// Each second body is handed over by its shape matrix, so that both ways to define a body are tried.
Ellipse body(Random& random, const Vector2d& center, const Vector2d& semi_axes) {
  const Ellipse e = Ellipse::from_axes(center, semi_axes, rotation(random.direction()));
  return random.coin() ? e : Ellipse::from_shape(center, e.shape());
}

/// The distance along the unit vector e at which B would touch A, to a few eps times the axis ratio.
///
/// It is the least value of F(tau) = rho_A(n) + rho_B(n) over the normals n = e + tau e', e' across e,
/// because bodies at distance d are disjoint iff some n with n.e = 1 has d > F. Both terms are convex in tau
/// with known minimisers, so the minimum lies between these.
double touching_distance(const Ellipse& a, const Ellipse& b, const Vector2d& e) {
  const Vector2d across(-e.y(), e.x());
  const auto width = [&](double tau) {
    const Vector2d n = e + tau * across;
    return a.radius(n) + b.radius(n);
  };
  const auto minimiser = [&](const Ellipse& body) {
    const Vector2d u = body.factor().transpose() * e, v = body.factor().transpose() * across;
    return -u.dot(v) / v.squaredNorm();
  };
  double lo = minimiser(a), hi = minimiser(b);
  if (lo > hi) std::swap(lo, hi);
  for (int i = 0; i < 200 && lo < hi; ++i) {
    const double third = (hi - lo) / 3, x = lo + third, y = hi - third;
    if (width(x) <= width(y))
      hi = y;
    else
      lo = x;
  }
  return width(0.5 * (lo + hi));
}

Ellipse moved_to(const Ellipse& body, const Vector2d& center) {
  if (body.defined_by_factor()) return body.translated(center - body.center());
  return Ellipse::from_shape(center, body.shape());
}

/// B moved to `factor` times the touching distance from A in a random direction.
std::pair<Ellipse, Ellipse> apart(Random& random, const Ellipse& a, const Ellipse& b, double factor) {
  const Vector2d e = random.direction();
  return {a, moved_to(b, a.center() + factor * touching_distance(a, b, e) * e)};
}

/// a |p|^2 and b |p|^2 are the squared semi-axes along and across the integer vector p; for coarse a and b
/// all entries are exact.
Matrix2d shape_along(const Eigen::Vector2i& p, double a, double b) {
  const double x = p.x(), y = p.y();
  return (Matrix2d() << a * x * x + b * y * y, (a - b) * x * y, (a - b) * x * y, a * y * y + b * x * x)
      .finished();
}

/// A pair with axes along and across the integer vector p; centres on the line along p when `aligned`.
std::pair<Ellipse, Ellipse> with_common_axes(Random& random, const Eigen::Vector2i& p, bool aligned,
                                             const Vector2d& center) {
  const double n2 = p.squaredNorm();
  const auto shape = [&] {
    const Vector2d s = random.axes();
    return shape_along(p, coarse(s.x() * s.x() / n2), coarse(s.y() * s.y() / n2));
  };
  const Ellipse a = Ellipse::from_shape(center, shape()), b = Ellipse::from_shape(center, shape());
  if (!aligned) return apart(random, a, b, random.separation());
  const double length = std::sqrt(n2);
  const double steps =
      coarse(random.separation() * touching_distance(a, b, p.cast<double>() / length) / length);
  return {a, moved_to(b, center + steps * p.cast<double>())};
}

}  // namespace

const char* name(PlanarFamily family) {
  switch (family) {
    case PlanarFamily::regular:
      return "regular";
    case PlanarFamily::congruent:
      return "congruent";
    case PlanarFamily::proportional:
      return "proportional";
    case PlanarFamily::common_axes:
      return "common_axes";
    case PlanarFamily::circles:
      return "circles";
    case PlanarFamily::thin:
      return "thin";
    case PlanarFamily::far_from_origin:
      return "far_from_origin";
    case PlanarFamily::far_apart:
      return "far_apart";
    case PlanarFamily::nearly_touching:
      return "nearly_touching";
    case PlanarFamily::within_rounding:
      return "within_rounding";
    case PlanarFamily::thin_touching:
      return "thin_touching";
    case PlanarFamily::symmetric:
      return "symmetric";
    case PlanarFamily::mixed_scale:
      return "mixed_scale";
  }
  return "?";
}

std::pair<Ellipse, Ellipse> planar_pair(PlanarFamily family, std::uint64_t seed, std::uint64_t index) {
  // Every random number has its own statement: the order of evaluation of arguments is not fixed.
  Random random(family, seed, index);
  const Vector2d center = random.near_origin(), axes_a = random.axes(), axes_b = random.axes();
  switch (family) {
    case PlanarFamily::regular: {
      const Ellipse a = body(random, center, axes_a), b = body(random, center, axes_b);
      return apart(random, a, b, random.separation());
    }
    case PlanarFamily::congruent: {
      const Ellipse a = body(random, center, axes_a);
      return apart(random, a, a, random.separation());
    }
    case PlanarFamily::proportional: {
      const Matrix2d s =
          Ellipse::from_axes(center, axes_a, rotation(random.direction())).shape().unaryExpr(&coarse);
      const double ratio = random.integer(1, 256) / 16.0;
      const Ellipse a = Ellipse::from_shape(center, s), b = Ellipse::from_shape(center, ratio * s);
      return apart(random, a, b, random.separation());
    }
    case PlanarFamily::common_axes: {
      Eigen::Vector2i p(0, 0);
      while (p.isZero()) {
        p.x() = random.integer(-20, 20);
        p.y() = random.integer(-20, 20);
      }
      return with_common_axes(random, p, random.coin(), center.unaryExpr(&coarse));
    }
    case PlanarFamily::circles: {
      const double second = random.integer(0, 3) == 0 ? axes_a.x() : axes_b.x();
      const Ellipse a = Ellipse::from_axes(center, {axes_a.x(), axes_a.x()});
      const Ellipse b = Ellipse::from_axes(center, {second, second});
      return apart(random, a, b, random.separation());
    }
    case PlanarFamily::thin: {
      const int which = random.integer(1, 3);
      const auto squeezed = [](const Vector2d& s) { return Vector2d(s.x(), 1e-6 * s.x()); };
      const Ellipse a = body(random, center, which & 1 ? squeezed(axes_a) : axes_a);
      const Ellipse b = body(random, center, which & 2 ? squeezed(axes_b) : axes_b);
      return apart(random, a, b, random.separation());
    }
    case PlanarFamily::far_from_origin: {
      const double distance = 1e9 * random.uniform(0.5, 2);
      const Vector2d far = distance * random.direction();
      const Ellipse a = body(random, far, axes_a), b = body(random, far, axes_b);
      return apart(random, a, b, random.separation());
    }
    case PlanarFamily::far_apart: {
      const Ellipse a = body(random, center, axes_a), b = body(random, center, axes_b);
      return apart(random, a, b, 1e9 * random.uniform(0.5, 2));
    }
    case PlanarFamily::nearly_touching: {
      constexpr std::array kGaps = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
      const Ellipse a = body(random, center, axes_a), b = body(random, center, axes_b);
      const double gap = kGaps[index / 4 % kGaps.size()];
      return apart(random, a, b, 1 + (index % 4 == 3 ? -gap : gap));
    }
    case PlanarFamily::within_rounding: {
      const Ellipse a = body(random, center, axes_a), b = body(random, center, axes_b);
      return apart(random, a, b, 1 + random.integer(-4, 4) * 0x1p-52);
    }
    case PlanarFamily::thin_touching: {
      constexpr std::array kThickness = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
      constexpr std::array kGaps = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
      const double thickness = kThickness[index % kThickness.size()];
      const double gap = kGaps[index / kThickness.size() % kGaps.size()];
      const int which = random.integer(1, 3);
      const auto squeezed = [&](const Vector2d& s) { return Vector2d(s.x(), thickness * s.x()); };
      const Ellipse a = body(random, center, which & 1 ? squeezed(axes_a) : axes_a);
      const Ellipse b = body(random, center, which & 2 ? squeezed(axes_b) : axes_b);
      return apart(random, a, b, 1 + gap);
    }
    case PlanarFamily::symmetric: {
      const int sign = random.coin() ? 1 : -1;
      const bool along_x = random.coin();
      const Eigen::Vector2i p = along_x ? Eigen::Vector2i(sign, 0) : Eigen::Vector2i(0, sign);
      const Vector2d on_axis = along_x ? Vector2d(coarse(center.x()), 0) : Vector2d(0, coarse(center.y()));
      return with_common_axes(random, p, true, on_axis);
    }
    case PlanarFamily::mixed_scale: {
      const bool large_a = random.coin();
      const Ellipse a = body(random, center, (large_a ? 1e6 : 1.0) * axes_a);
      const Ellipse b = body(random, center, (large_a ? 1.0 : 1e6) * axes_b);
      return apart(random, a, b, random.separation());
    }
  }
  return {};
}

}  // namespace vericone::verify
