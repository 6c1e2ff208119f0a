// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/robust_law.h>
#include <vericone/internal/geometry/requires.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace vericone::guidance {
namespace {

constexpr int kHalvings = 60;  // of a range, as many as doubles tell apart
constexpr double kNone = std::numeric_limits<double>::infinity();

/// A corner of the polytope: z(k+1) = A z + B u + D v, (7.17).
struct Corner {
  double a, b, d;
};

struct Corners {
  std::array<Corner, 8> all{};
  int count = 0;

  void add(double a, double b, double d) { all[static_cast<std::size_t>(count++)] = {a, b, d}; }
  const Corner* begin() const { return all.data(); }
  const Corner* end() const { return all.data() + count; }
};

/// Integral of exp(-rate t) from 0 to dt, s.
double decayed(double rate, double dt) {
  const double x = rate * dt;
  return x == 0 ? dt : -std::expm1(-x) / rate;
}

Corners corners_of(const RobustModel& m, Polytope polytope) {
  Corners corners;
  const std::array<double, 2> ends{m.a_low, m.a_high};
  for (const double a : ends) {
    const double decay = std::exp(-m.gain * a * m.dt), d = decayed(m.gain * a, m.dt);
    if (polytope == Polytope::printed) {
      corners.add(decay, m.sign_b * m.b_high * d, d);
      continue;
    }
    // (B, D) = (b D, D) lies between two lines through 0, whatever A is.
    for (const double other : ends) {
      const double far = decayed(m.gain * other, m.dt);
      for (const double b : {m.b_low, m.b_high}) corners.add(decay, m.sign_b * b * far, far);
    }
  }
  return corners;
}

struct Range {
  double low = -kNone, high = kNone;

  bool empty() const { return !(low <= high); }
  /// Gains k with |a + b k| <= most.
  void keep(const Corner& c, double most) {
    if (c.b == 0) {
      if (!(std::abs(c.a) <= most)) low = kNone, high = -kNone;
      return;
    }
    const double x = (-most - c.a) / c.b, y = (most - c.a) / c.b;
    low = std::max(low, std::min(x, y));
    high = std::min(high, std::max(x, y));
    if (most < 0) low = kNone, high = -kNone;
  }
};

/// The limits on 1 / rho = Gamma / Q at a gain, with their slopes: at least `least`, at most `most`.
struct Limits {
  double least = 0, least_slope = 0;
  double most = kNone, most_slope = 0;
};

/// Where the convex function with this slope is least.
template <typename Slope>
double minimum(Range range, Slope slope) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = range.low + 0.5 * (range.high - range.low);
    if (!(middle > range.low && middle < range.high)) break;
    (slope(middle) < 0 ? range.low : range.high) = middle;
  }
  return range.low + 0.5 * (range.high - range.low);
}

class Problem {
 public:
  Problem(const Corners& corners, double mu, double q, double r)
      : corners_(corners), mu_(mu), root_(std::sqrt(mu)), q_(q), r_(r) {}

  Limits at(double k) const {
    Limits limits;
    const double cost = q_ + r_ * k * k;
    for (const Corner& corner : corners_) {
      const double c = corner.a + corner.b * k, left = 1 - c * c;
      if (!(left > 0)) return {kNone, c * corner.b, kNone, 0};
      // (7.22)
      raise(limits, cost / left, (2 * r_ * k + 2 * cost * c * corner.b / left) / left);
      // (7.23): mu - s / rho + D^2 / rho^2 <= 0 with s = mu (1 - c^2) + D^2
      const double d2 = corner.d * corner.d, s = mu_ * left + d2, slope = -2 * mu_ * c * corner.b;
      const double w2 = (s - 2 * root_ * corner.d) * (s + 2 * root_ * corner.d);
      const double w = std::sqrt(std::max(0.0, w2));
      raise(limits, 2 * mu_ / (s + w), -2 * mu_ * slope / (w * (s + w)));
      if (const double most = (s + w) / (2 * d2); most < limits.most) {
        limits.most = most;
        limits.most_slope = slope * (1 + s / w) / (2 * d2);
      }
    }
    return limits;
  }

  /// The gain of least Gamma in a range; nothing where none has one. In (gain, 1 / rho) the inequalities have
  /// a convex set of solutions: `least` is a convex function of the gain, `most` a concave one.
  std::optional<double> best(const Range& range) const {
    const double k = minimum(range, [&](double x) { return at(x).least_slope; });
    if (fits(k)) return k;
    // The nearest gain at which the two meet, on the way to where they are farthest apart.
    double inside = minimum(range, [&](double x) {
      const Limits limits = at(x);
      return limits.least_slope - limits.most_slope;
    });
    if (!fits(inside)) return std::nullopt;
    double outside = k;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = outside + 0.5 * (inside - outside);
      if (middle == outside || middle == inside) break;
      (fits(middle) ? inside : outside) = middle;
    }
    return inside;
  }

 private:
  bool fits(double k) const {
    const Limits limits = at(k);
    return limits.least <= limits.most * (1 + 1e-12);
  }
  static void raise(Limits& limits, double value, double slope) {
    if (value > limits.least) limits.least = value, limits.least_slope = slope;
  }

  const Corners& corners_;
  double mu_, root_, q_, r_;
};

double norm_of(const Corners& corners, double k) {
  double most = 0;
  for (const Corner& c : corners) {
    const double left = 1 - std::abs(c.a + c.b * k);
    most = std::max(most, left > 0 ? c.d / left : kNone);
  }
  return most;
}

}  // namespace

const char* to_string(RobustStatus status) {
  switch (status) {
    case RobustStatus::solved:
      return "solved";
    case RobustStatus::decay:
      return "decay";
    case RobustStatus::attenuation:
      return "attenuation";
    case RobustStatus::saturation:
      return "saturation";
    case RobustStatus::weights:
      return "weights";
  }
  return "";
}

RobustCorrection robust_correction(double z, double low, double high, const RobustModel& model,
                                   const RobustOptions& options) {
  VERICONE_REQUIRES((check(model, options), low <= high), "low, high", "others", "low <= high");
  const Corners corners = corners_of(model, options.polytope);
  const double mu = options.attenuation == Attenuation::printed ? options.mu : options.mu * options.mu;
  const auto none = [&](RobustStatus status) {
    RobustCorrection correction{status};
    correction.norm = norm_of(corners, 0);
    return correction;
  };

  Range range;
  for (const Corner& c : corners) range.keep(c, 1);
  if (range.empty() || range.low == range.high) return none(RobustStatus::decay);
  // The norm D / (1 - |c|) of a scalar system, at most sqrt(mu).
  for (const Corner& c : corners) range.keep(c, 1 - c.d / std::sqrt(mu));
  if (range.empty()) return none(RobustStatus::attenuation);
  Range left = range;
  if (z != 0) {
    const double x = low / z, y = high / z;
    left.low = std::max(left.low, std::min(x, y));
    left.high = std::min(left.high, std::max(x, y));
  }
  if (left.empty() || (z == 0 && !(low <= 0 && high >= 0))) return none(RobustStatus::saturation);

  const Problem problem(corners, mu, options.state_weight, options.input_weight);
  const std::optional<double> best = problem.best(left);
  if (!best) return none(problem.best(range) ? RobustStatus::saturation : RobustStatus::weights);
  RobustCorrection correction;
  correction.gain = *best;
  correction.delta = std::clamp(*best * z, low, high);
  correction.gamma = z * z * problem.at(*best).least;
  correction.norm = norm_of(corners, *best);
  return correction;
}

void check(const RobustModel& m, const RobustOptions& o) {
  const auto require = [](bool good, const char* field, double value, const char* requirement) {
    if (!good) throw InputError(field, to_text(value), requirement);
  };
  require(m.gain > 0 && std::isfinite(m.gain), "K", m.gain, "a positive number (1/s)");
  require(m.a_low <= m.a_high && std::isfinite(m.a_low) && std::isfinite(m.a_high), "a", m.a_low,
          "two finite numbers, the lower one first");
  require(m.b_high > 0 && std::isfinite(m.b_high), "lambda", m.b_high, "a positive number (1/m)");
  require(m.b_low >= 0 && m.b_low <= m.b_high, "b_min", m.b_low, "between 0 and lambda (1/m)");
  require(m.sign_b == 1 || m.sign_b == -1, "sign_b", m.sign_b, "1 or -1");
  require(m.dt > 0 && std::isfinite(m.dt), "dt", m.dt, "a positive number (s)");
  require(o.mu > 0 && std::isfinite(o.mu), "mu", o.mu, "a positive number (s)");
  require(o.state_weight > 0 && std::isfinite(o.state_weight), "Q", o.state_weight, "a positive number");
  require(o.input_weight >= 0 && std::isfinite(o.input_weight), "R", o.input_weight, "a number, 0 or more");
}

}  // namespace vericone::guidance
