// SPDX-License-Identifier: BSD-3-Clause
#include "surface/secular_foot.h"

#include <algorithm>
#include <cmath>

namespace vericone::fitting {
namespace {

using Eigen::Array3d, Eigen::Vector3d;

/// sum l_i y_i^2 / w_i^2 where w = start + s * slope is the denominator of z_i = y_i / w_i. It is monotone in
/// s between the poles that enclose the global minimum.
struct SecularSum {
  Array3d weights, start, slope;

  double value(double s, double& derivative) const {
    const Array3d w = start + s * slope;
    const Array3d term = weights / w.square();
    derivative = -2 * (term * slope / w).sum();
    return term.sum();
  }
};

/// s in [low, high] where the sum is 1, from `s`. Newton's method on 1 / sqrt(sum), which is nearly linear
/// (it is for one term), kept within the bracket. A step below 1e-9 times the natural unit leaves an error
/// below rounding, since the next would be its square; `unit` is that of s, 0: s itself.
double root_of_sum(const SecularSum& f, double low, double high, double s, bool decreasing, double unit) {
  constexpr double kLast = 1e-9;
  for (int i = 0; i < 200; ++i) {
    double derivative = 0;
    const double value = f.value(s, derivative);
    if (value == 1) return s;
    ((value > 1) == decreasing ? low : high) = s;
    const double next = s - 2 * value * (std::sqrt(std::max(value, 0.0)) - 1) / derivative;
    const double step = std::abs(next - s);
    if (value > 0 && step <= kLast * (unit > 0 ? unit : std::abs(s))) return next;
    if (value > 0 && next > low && next < high) {
      s = next;
      continue;
    }
    // Towards a pole the scale is logarithmic.
    const double middle = low > 0 && high > 4 * low ? std::sqrt(low * high) : 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    s = middle;
  }
  return s;
}

}  // namespace

// y - z = t diag(l) z; it is the nearest where 1 + t l_i >= 0 for all i. So t is between the poles -1 / l_i
// next to 0, and near a pole 1 + t l_p is the unknown that does not cancel.
SecularFoot secular_foot(const Vector3d& l, const Vector3d& y) {
  constexpr double kPole = 1e-18;
  const Array3d weights = l.array() * y.array().square();
  const double value = weights.sum() - 1;
  SecularFoot foot;
  foot.point = y;
  if (value == 0) return foot;

  const bool outside = value > 0;
  if (outside && l(0) >= 0) {  // no pole
    double reach = 0;
    for (int i = 0; i < 3; ++i)
      if (l(i) > 0) reach += y(i) * y(i) / l(i);
    const SecularSum f{weights, Array3d::Ones(), l.array()};
    foot.multiplier = root_of_sum(f, 0, std::sqrt(reach), 0, true, 1 / l(2));
    foot.point = y.array() / (1 + foot.multiplier * l.array());
  } else {
    const int p = outside ? 0 : 2;
    const Array3d ratio = l.array() / l(p);
    const SecularSum f{weights, 1 - ratio, ratio};
    // Where the term of the pole outweighs what the others can be.
    const double others = outside ? weights.max(0.0).sum() : 1 + (-weights).max(0.0).sum();
    double low = std::sqrt(std::abs(weights(p)) / others), derivative = 0;
    double s = 0;
    const bool far = low >= kPole;
    low = std::max(low * (1 - 1e-12), kPole);
    if (far || (f.value(low, derivative) > 1) != outside) {
      s = root_of_sum(f, low, 1, 1, !outside, 0);
      foot.point = y.array() / (f.start + s * f.slope);
    } else {  // on the medial axis: y_p = 0, z_p is not
      for (int i = 0; i < 3; ++i) foot.point(i) = i == p ? 0 : y(i) / f.start(i);
      const double rest = 1 - (l.array() * foot.point.array().square()).sum();
      foot.point(p) = std::copysign(std::sqrt(std::max(rest / l(p), 0.0)), y(p));
    }
    foot.multiplier = (s - 1) / l(p);
  }
  foot.distance = foot.multiplier * (l.array() * foot.point.array()).matrix().norm();
  return foot;
}

}  // namespace vericone::fitting
