// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/combined/planar_families.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/verify/seeded_random.h>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace vericone::verify {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr std::uint32_t kStream = 0x504c;

class Random : public SeededRandom {
 public:
  using SeededRandom::SeededRandom;
  Vector2d axes(double low, double high) {
    const double first = uniform(low, high);
    return {first, uniform(low, high)};
  }
  double angle() { return uniform(-std::numbers::pi, std::numbers::pi); }
  double power(double low, double high) { return std::pow(10, uniform(low, high)); }
};

using Family = CombinedPlanarFamily;

/// B of one of the first five families; A's kind for `both` is drawn among them as well.
CombinedEllipse body(Random& random, Family family, const Vector2d& center, const Vector2d& axes) {
  const double turn = random.angle();
  if (family == Family::dented || family == Family::pinched)
    return dented_conic(center, axes.x(), axes.y(), family == Family::pinched ? 1 : random.uniform(0, 1),
                        turn);
  // Each second ellipse is handed over by its shape matrix.
  Ellipse ellipse = Ellipse::from_axes(center, axes, rotation_2d(turn));
  if (random.coin()) ellipse = Ellipse::from_shape(center, ellipse.shape());
  // Delimiters in the proportions of the ellipse, so that thin bodies are cut as others are.
  const Matrix2d to_unit = ellipse.factor().inverse();
  const auto delimiter = [&](bool round) -> Delimiter<2> {
    const Vector2d semi = random.axes(0.1, 0.9);
    Matrix2d m;
    if (round) {
      const Matrix2d r = rotation_2d(random.angle());
      m = r * Vector2d(1 / (semi.x() * semi.x()), 0.5 * semi.y()).asDiagonal() * r.transpose();
    } else {
      m = hyperbola(semi, random.angle()).matrix;
    }
    m = to_unit.transpose() * m * to_unit;
    m(1, 0) = m(0, 1);
    return {m, 1};
  };
  const int count = family == Family::several ? random.integer(2, 3) : 1;
  std::vector<Delimiter<2>> delimiters;
  for (int i = 0; i < count; ++i) delimiters.push_back(delimiter(family == Family::waist));
  if (family == Family::waist && random.coin()) delimiters.push_back(delimiter(false));
  return {ellipse, delimiters};
}

Family any_kind(Random& random) { return static_cast<Family>(random.integer(0, 4)); }

/// B moved to `factor` times the sum of the radii along e.
CombinedEllipse placed(const CombinedEllipse& a, const CombinedEllipse& b, const Vector2d& e, double factor) {
  // A pinched body may have no extent along e; its ellipse has.
  const auto radius = [&](const CombinedEllipse& body) {
    const double r = 1 / body.gauge(e);
    return r > 0 ? r : 1 / CombinedEllipse(body.ellipsoid()).gauge(e);
  };
  return b.translated(a.center() + factor * (radius(a) + radius(b)) * e - b.center());
}

using Pair = std::pair<CombinedEllipse, CombinedEllipse>;

Pair in_mouth(Random& random, const Vector2d& origin) {
  const Vector2d axes = random.axes(2, 10);
  const double k = random.uniform(0.5, 1), phi = random.angle(), end = random.coin() ? 1 : -1;
  const CombinedEllipse b = dented_conic(origin, axes.x(), axes.y(), k, phi);
  const double neck = axes.x() * std::sqrt(1 - k), lips = axes.x();
  const double out = neck + random.uniform(0.2, 1.2) * (lips - neck);
  const double room = std::min(out - neck, axes.y() * std::sqrt(k));
  const Vector2d along(std::cos(phi), std::sin(phi));
  const double aside = random.uniform(-0.3, 0.3) * room;
  const Vector2d center = origin + end * out * along + aside * Vector2d(-along.y(), along.x());
  const Vector2d small = random.axes(0.05 * room, 0.7 * room);
  return {body(random, random.coin() ? Family::dented : Family::one_hyperbola, center, small), b};
}

Pair interlocked(Random& random, const Vector2d& origin) {
  const Family kind[2] = {random.coin() ? Family::dented : Family::one_hyperbola,
                          random.coin() ? Family::dented : Family::pinched};
  const Vector2d axes_a = random.axes(1, 10), axes_b = random.axes(1, 10);
  const CombinedEllipse a = body(random, kind[0], origin, axes_a), b = body(random, kind[1], origin, axes_b);
  const Vector2d e = random.direction<2>();
  return {a, placed(a, b, e, random.uniform(0.3, 1))};
}

Pair any_pair(Random& random, const Vector2d& origin, double thinness, double distance) {
  const auto axes = [&] {
    Vector2d x = random.axes(1, 10);
    if (thinness > 1) x(random.integer(0, 1)) /= thinness;
    return x;
  };
  const Family of_a = any_kind(random), of_b = any_kind(random);
  const Vector2d axes_a = axes(), axes_b = axes();
  const CombinedEllipse a = body(random, of_a, origin, axes_a), b = body(random, of_b, origin, axes_b);
  const Vector2d e = random.direction<2>();
  return {a, placed(a, b, e, distance)};
}

/// B moved along the line of centres to where the bodies begin to touch, then by `gap` of the distance.
Pair touching(const Pair& pair, double gap) {
  const int halvings = std::abs(gap) < 1e-3 ? 42 : 20;
  const auto& [a, b] = pair;
  const Vector2d c = b.center() - a.center();
  double in = 0, out = 4;
  while (combined_sector(a, b.translated((out - 1) * c)).sector.relation == Relation::overlapping) out *= 2;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (in + out);
    const bool meet =
        combined_sector(a, b.translated((middle - 1) * c)).sector.relation == Relation::overlapping;
    (meet ? in : out) = middle;
  }
  return {a, b.translated((out * (1 + gap) - 1) * c)};
}

}  // namespace

const char* name(CombinedPlanarFamily family) {
  static constexpr const char* kNames[] = {"one_hyperbola", "several", "dented",       "pinched",
                                           "waist",         "both",    "mouth",        "interlocked",
                                           "thin",          "far",     "near_touching"};
  return kNames[static_cast<std::size_t>(family)];
}

std::pair<CombinedEllipse, CombinedEllipse> combined_planar_pair(CombinedPlanarFamily family,
                                                                 std::uint64_t seed, std::uint64_t index) {
  Random random(kStream + static_cast<std::uint32_t>(family), seed, index);
  const double x = random.uniform(-10, 10);
  const Vector2d origin(x, random.uniform(-10, 10));
  for (;;) {
    try {
      switch (family) {
        case Family::mouth:
          return in_mouth(random, origin);
        case Family::interlocked: {
          const double gap = random.power(-3, -1);
          return touching(interlocked(random, origin), gap);
        }
        case Family::both:
          return any_pair(random, origin, 1, random.uniform(1, 4));
        case Family::thin: {
          const double thinness = random.power(1, 3), gap = random.uniform(0.01, 3);
          return touching(any_pair(random, origin, thinness, 1), gap);
        }
        case Family::far:
          return any_pair(random, origin, 1, random.power(2, 6));
        case Family::near_touching: {
          const double gap = random.power(-9, -2);
          const double sign = random.integer(0, 3) == 0 ? -1 : 1;
          return touching(random.coin() ? any_pair(random, origin, 1, 1) : interlocked(random, origin),
                          sign * gap);
        }
        default: {
          const Vector2d axes_a = random.axes(1, 10), axes_b = random.axes(1, 10);
          const Ellipse a = Ellipse::from_axes(origin, axes_a, rotation_2d(random.angle()));
          const CombinedEllipse b = body(random, family, origin, axes_b);
          const Vector2d e = random.direction<2>();
          return {a, placed(a, b, e, random.uniform(1, 4))};
        }
      }
    } catch (const InputError&) {
      // A delimiter that misses the ellipse: drawn again.
    }
  }
}

}  // namespace vericone::verify
