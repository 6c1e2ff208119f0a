// SPDX-License-Identifier: BSD-3-Clause
//
// Proofs: docs/explanation/robust-law.md, "The probability of a collision".
#include <vericone/cones/uncertain/probability.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "uncertain/covariance.h"
#include "uncertain/shadow.h"

namespace vericone {
namespace gaussian {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using Rule = boost::math::quadrature::gauss<double, 20>;

constexpr int kNodes = 20;
constexpr double kEllipse =
    3;  // sum of the semi-axes of Bernstein's ellipse, of an interval of half length 1
constexpr double kLeast = 1e-290;  // below, doubles lose their digits

/// The normal distribution from u to u + height, to a few roundings however small it is.
double between(double u, double height) {
  const double half = 0.5 * height, m = u + half, v = u + height, reach = std::abs(m) * half;
  if (half <= 0.25 && reach <= 0.75) {
    // exp(-m s - s^2 / 2) is the sum of He_n(m) (-s)^n / n!; odd n integrate to 0.
    double even = 1, odd = m, power = half, sum = half, last = half;
    for (int n = 2; n <= 18; n += 2) {
      even = m * odd - (n - 1) * even;
      odd = m * even - n * odd;
      power *= half * half / (n * (n + 1));
      const double term = power * even;
      sum += term;
      if (std::abs(term) + std::abs(last) < 1e-18 * sum) break;
      last = term;
    }
    return std::exp(-0.5 * m * m) * sum * std::sqrt(2 / std::numbers::pi);
  }
  const double a = u / std::numbers::sqrt2, b = v / std::numbers::sqrt2;
  if (u >= 0) return 0.5 * (std::erfc(a) - std::erfc(b));
  if (v <= 0) return 0.5 * (std::erfc(-b) - std::erfc(-a));
  return 0.5 * (std::erf(b) + std::erf(-a));
}

/// The measure of a shadow, by the integral of -x' density(x) (Phi(y) - Phi(y0)) around its boundary, y0 on
/// the line through the leftmost and the rightmost point: no term is negative.
class Integral {
 public:
  Integral(const Shadow& shadow, const ProbabilityOptions& options) : k_(shadow), options_(options) {
    // The rightmost point has its normal along the first row of M.
    start_ = std::atan2(k_.bx, k_.ax);
    const double length = std::hypot(k_.ax, k_.bx);
    const Shadow::Point right = k_.point(k_.ax / length, k_.bx / length);
    slope_ = right.y / right.x;
    wide_ = 2 * k_.rounding * (std::abs(k_.ax) + std::abs(k_.bx));
    tall_ = 2 * k_.rounding * (std::abs(k_.ay) + std::abs(k_.by)) + std::abs(slope_) * wide_;
    away_ = k_.rounding * (std::abs(k_.x) + std::abs(k_.y));
  }

  Probability measure() {
    constexpr double kPi = std::numbers::pi;
    panels_.reserve(std::size_t(std::max(2, options_.most_points / kNodes)) + 1);
    add(start_ + 0.5 * kPi, 0.5 * kPi);
    add(start_ + 1.5 * kPi, 0.5 * kPi);
    double scale = 0;
    Probability p;
    while (true) {
      refine(scale);
      p = sum();
      const double wanted = std::max(options_.absolute, options_.relative * p.estimate);
      if (2 * open_ <= wanted || full()) break;
      checkpoint();
      scale = p.estimate;
    }
    return p;
  }

 private:
  struct Panel {
    double middle, half;
    double error, value;  // of the integral; the value of one node as long as it is not summed
    double rounding;
    bool skipped, summed;
    bool operator<(const Panel& other) const { return error < other.error; }
  };

  bool full() const { return int(panels_.size() + 1) * kNodes > options_.most_points; }

  /// Cuts panels in two, the worst one first, until little is open.
  void refine(double scale) {
    while (!full()) {
      double open = 0, known = 0;
      for (const Panel& panel : panels_) {
        open += panel.error;
        if (panel.summed || panel.error < 0.01 * panel.value) known += panel.value;
      }
      const double wanted =
          0.2 * std::max(options_.absolute, options_.relative * (scale > 0 ? scale : known));
      if (open <= wanted) return;
      // Not std::pop_heap: there are few, and sums of the errors are needed anyway.
      const auto worst = std::max_element(panels_.begin(), panels_.end());
      const Panel cut = *worst;
      if (!(cut.half > 1e-15)) return;
      *worst = panels_.back();
      panels_.pop_back();
      add(cut.middle - 0.5 * cut.half, 0.5 * cut.half);
      add(cut.middle + 0.5 * cut.half, 0.5 * cut.half);
    }
  }

  void add(double middle, double half) {
    const double c = std::cos(middle), s = std::sin(middle);
    Panel panel{middle, half, 0, 0, 0, false, false};
    const Bounds bounds = bound(c, s, half);
    panel.skipped = bounds.real <= bounds.complex;
    panel.error = std::min(bounds.real, bounds.complex);
    panel.value = 2 * half * std::abs(term(c, s).value);
    panels_.push_back(panel);
  }

  struct Term {
    double value, rounding;
  };
  /// The integrand at an angle, and by how much it may be off.
  Term term(double c, double s) const {
    const Shadow::Point p = k_.point(c, s);
    const double x = k_.x + p.x, start = k_.y + slope_ * p.x, end = k_.y + p.y, height = p.y - slope_ * p.x;
    const double along = p.turn * (k_.bx * c - k_.ax * s);
    const double low = std::min(start, end);
    const double part = between(low, std::abs(height));
    const double value = std::abs(along) * std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi) * part;
    // Lengths of the bodies (with the angle, right to 7 roundings) and the way to them are as good as
    // `rounding` says. The density is nowhere above 5 (2 / height + nearest + 1) times `part`.
    const double of_width = wide_ * (1 + p.turn), of_height = tall_ * (1 + p.turn);
    const double tall = std::abs(height), nearest = std::max({0.0, low, -low - tall});
    const double densest = 5 * (2 / std::max(tall, of_height) + nearest + 1);
    const double farthest = std::max(std::abs(start), std::abs(end));
    const double relative = 0x1p-47 + (of_width + away_) * std::abs(x) +
                            (of_height + away_) * std::min(farthest, densest) + of_height * densest +
                            of_width * p.turn / std::max(std::abs(along), 1e-300);
    return {value, value * relative};
  }

  struct Bounds {
    double real, complex;
  };
  /// Of the integral over a panel, by the largest value; and of what Gauss's rule leaves of it, by the
  /// largest absolute value in the disc around Bernstein's ellipse.
  Bounds bound(double c, double s, double half) const {
    constexpr double kReach = 0.5 * (kEllipse + 1 / kEllipse);
    const double radius = kReach * half;
    const double wide = std::cosh(radius), deep = std::sinh(radius);
    Bounds b;
    b.complex = 64.0 / 15 * half * std::pow(kEllipse, -2.0 * kNodes) / (1 - 1 / (kEllipse * kEllipse)) *
                largest(c, s, wide, deep, wide - 1, true);
    b.real = 2 * half * largest(c, s, 1, half, 0.5 * half * half, false);
    return b;
  }

  /// For angles z from the middle with |cos z| <= wide and |sin z| <= deep; the integrals of both from 0 are
  /// at most `deep` and `risen`.
  double largest(double c, double s, double wide, double deep, double risen, bool complex) const {
    const double along_both = std::abs(c * c - s * s) * deep * deep + 2 * std::abs(s * c) * deep * wide;
    const auto least = [&](double e1, double e2) {
      const double middle = e1 * c * c + e2 * s * s, low = middle - std::abs(e1 - e2) * along_both;
      return complex ? low : std::max(low, std::min(e1, e2));
    };
    const double l = least(k_.l1, k_.l2), m = least(k_.m1, k_.m2);
    double turn = 0;
    if (k_.l1 * k_.l2 > 0) turn += l > 0 ? k_.l1 * k_.l2 / (l * std::sqrt(l)) : kInfinity;
    if (k_.m1 * k_.m2 > 0) turn += m > 0 ? k_.m1 * k_.m2 / (m * std::sqrt(m)) : kInfinity;
    if (!(turn < kInfinity)) return kInfinity;
    const Shadow::Point p = k_.point(c, s);
    // Of u = (a, b).p, u' = turn (b c - a s) and its own derivative -turn (a c + b s), turn aside.
    const auto slope_of = [&](double a, double b) {
      return turn * (std::abs(b * c - a * s) * wide + std::abs(a * c + b * s) * deep);
    };
    const auto change_of = [&](double a, double b) {
      return turn * (std::abs(b * c - a * s) * deep + std::abs(a * c + b * s) * risen);
    };
    const double of_x = change_of(k_.ax, k_.bx), of_y = change_of(k_.ay, k_.by);
    const double of_start = std::abs(slope_) * of_x;
    const double height =
        std::abs(p.y - slope_ * p.x) + change_of(k_.ay - slope_ * k_.ax, k_.by - slope_ * k_.bx);
    const double start = k_.y + slope_ * p.x, end = k_.y + p.y;
    const double low = std::min(start - of_start, end - of_y), high = std::max(start + of_start, end + of_y);
    const double x = std::max(0.0, std::abs(k_.x + p.x) - of_x), y = std::max({0.0, low, -high});
    // |density(z)| is that of the real part times exp(half the square of the imaginary part).
    double exponent = -0.5 * (x * x + y * y);
    double part = height / (2 * std::numbers::pi);
    if (complex) {
      const double beside = std::max(of_y, of_start);
      exponent += 0.5 * (of_x * of_x + beside * beside);
    } else {
      part = std::min(part, 1 / std::sqrt(2 * std::numbers::pi));
    }
    return slope_of(k_.ax, k_.bx) * part * std::exp(exponent) * (1 + 1e-9);
  }

  void evaluate(Panel& panel) const {
    const double c = std::cos(panel.middle), s = std::sin(panel.middle);
    panel.value = panel.rounding = 0;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double t = panel.half * Rule::abscissa()[i], weight = panel.half * Rule::weights()[i];
      const double dc = std::cos(t), ds = std::sin(t);
      for (const double side : {ds, -ds}) {
        const Term of_node = term(c * dc - s * side, s * dc + c * side);
        panel.value += weight * of_node.value;
        panel.rounding += weight * of_node.rounding;
      }
    }
    panel.summed = true;
  }

  Probability sum() {
    Probability p;
    double rounding = 0, skipped = 0, left = 0;
    p.points = 0;
    for (Panel& panel : panels_) {
      ++p.points;  // its middle
      if (panel.skipped) {
        skipped += panel.error;
        continue;
      }
      if (!panel.summed) evaluate(panel);
      p.estimate += panel.value;
      rounding += panel.rounding;
      left += panel.error;
      p.points += kNodes;
    }
    open_ = left + skipped;
    p.least = std::clamp(p.estimate - left - rounding, 0.0, 1.0);
    p.most = std::clamp((p.estimate + left + skipped + rounding) * (1 + 0x1p-50), p.least, 1.0);
    p.estimate = std::clamp(p.estimate, p.least, p.most);
    return p;
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Shadow& k_;
  const ProbabilityOptions& options_;
  std::vector<Panel> panels_;
  double start_, slope_, open_ = 0;
  double wide_, tall_, away_;  // by how much widths, heights and the way to the shadow may be off
};

/// Where the axis of x leaves the shadow scaled by `grown` about its centre: between chord and tangents of
/// the arc that crosses it, on the right (side 1) or the left (-1). False where it is surely not met.
class Crossing {
 public:
  Crossing(const Shadow& shadow, double grown) : k_(shadow), grown_(grown) {
    slack_ = 4 * k_.rounding * (std::abs(k_.y) + grown * (std::abs(k_.ay) + std::abs(k_.by)));
    top_ = std::atan2(k_.by, k_.ay);
  }

  /// Of the highest and the lowest point: 1 above the axis surely, -1 below, 0 neither.
  bool missed() const { return side(top_) == -1 || side(top_ + std::numbers::pi) == 1; }
  bool met() const { return side(top_) == 1 && side(top_ + std::numbers::pi) == -1; }

  struct Ends {
    double inner, outer;
  };
  Ends ends(int side_of) const {
    // From the lowest point, counter-clockwise on the right.
    const double lowest = top_ - side_of * std::numbers::pi;
    const auto turn = [&](auto is_below) {
      double below = lowest, above = top_;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (below + above);
        (is_below(side(middle)) ? below : above) = middle;
      }
      return std::pair(below, above);
    };
    const Place p = place(turn([](int at) { return at < 0; }).first);
    const Place q = place(turn([](int at) { return at <= 0; }).second);
    Ends e;
    e.inner = p.x + (q.x - p.x) * (p.y / (p.y - q.y));
    e.outer = side_of * std::numeric_limits<double>::infinity();
    for (const Place& t : {p, q})
      // n.(z - t) <= 0 for all of the body: at y = 0.
      if (side_of * t.nx > 0) {
        const double x = t.x + (t.ny / t.nx) * t.y;
        e.outer = side_of > 0 ? std::min(e.outer, x) : std::max(e.outer, x);
      }
    return e;
  }

 private:
  struct Place {
    double x, y, nx, ny;
  };
  Place place(double t) const {
    const double c = std::cos(t), s = std::sin(t);
    const Shadow::Point p = k_.point(c, s);
    return {k_.x + grown_ * p.x, k_.y + grown_ * p.y, k_.by * c - k_.ay * s, k_.ax * s - k_.bx * c};
  }
  int side(double t) const {
    const double y = place(t).y;
    return y > slack_ ? 1 : y < -slack_ ? -1 : 0;
  }

  const Shadow& k_;
  double grown_, slack_, top_;
};

/// Of an error along the axis of x, and perhaps a little beside it.
Probability line_measure(const Shadow& shadow) {
  constexpr double kRounding = 0x1p-46;
  Probability p;
  p.least = 0;
  const Crossing outer(shadow, (1 + shadow.smear) * (1 + kRounding));
  if (outer.missed()) {
    p.most = shadow.beside;
    return p;
  }
  p.points = 2;
  const double left = outer.ends(-1).outer, right = outer.ends(1).outer;
  const double slack = kRounding * (std::abs(shadow.x) + std::abs(shadow.ax) + std::abs(shadow.bx));
  if (left - slack >= right + slack)
    p.most = 0;
  else
    p.most = shadow.still ? (left <= slack && right >= -slack ? 1 : 0)
                          : between(left - slack, right - left + 2 * slack);
  p.most = std::min(1.0, p.most * (1 + kRounding) + shadow.beside);
  if (shadow.smear < 1) {
    const Crossing inner(shadow, (1 - shadow.smear) * (1 - kRounding));
    if (inner.met()) {
      const double from = inner.ends(-1).inner + slack, to = inner.ends(1).inner - slack;
      if (from < to)
        p.least = shadow.still ? (from < 0 && to > 0 ? 1 : 0)
                               : std::max(0.0, between(from, to - from) * (1 - kRounding) - shadow.beside);
    }
  }
  p.estimate = 0.5 * (p.least + p.most);
  return p;
}

}  // namespace
}  // namespace gaussian

Probability probability_of_passing_through(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w,
                                           const Eigen::Matrix3d& position_covariance,
                                           const ProbabilityOptions& options) {
  using namespace gaussian;
  if (!w.allFinite() || w.isZero(0))
    throw InputError("relative_velocity", to_text(w.norm()), "a finite velocity that is not zero (m/s)");
  const Covariance covariance(position_covariance, "position_covariance");
  if (!(options.relative >= 0))
    throw InputError("relative", to_text(options.relative), "a number, 0 or more");
  if (!(options.absolute >= 0))
    throw InputError("absolute", to_text(options.absolute), "a number, 0 or more");
  if (options.most_points < 16)
    throw InputError("most_points", std::to_string(options.most_points), "16 or more");
  const Shadow shadow(a, b, w, covariance.matrix);
  Probability p = shadow.flat ? line_measure(shadow) : Integral(shadow, options).measure();
  if (p.most < kLeast && p.points > 0 && !shadow.still) p.least = 0, p.most = kLeast;
  p.clipped = covariance.clipped;
  return p;
}

}  // namespace vericone
