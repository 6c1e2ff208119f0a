// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace vericone::verify {

/// A real number known to about 45 digits, with a certified enclosure in doubles: what a rounded answer is
/// measured against.
class EnclosedReal {
 public:
  /// Zero, exactly.
  EnclosedReal() = default;

  /// `lo` and `hi` enclose the number; the exact sum of `parts` approximates it to 2^-150 relative (or to
  /// 1e-323 absolute, the last parts underflow), each part being the rest after the earlier ones rounded to
  /// nearest.
  EnclosedReal(double lo, double hi, const std::array<double, 3>& parts) : lo_(lo), hi_(hi), parts_(parts) {}

  /// lo() <= number <= hi(), certified.
  [[nodiscard]] double lo() const { return lo_; }
  [[nodiscard]] double hi() const { return hi_; }
  [[nodiscard]] bool contains(double value) const { return lo_ <= value && value <= hi_; }

  /// The number rounded to nearest.
  [[nodiscard]] double nearest() const { return parts_[0]; }
  [[nodiscard]] const std::array<double, 3>& parts() const { return parts_; }

  /// (value + value_low) - number, where |value_low| <= ulp(value)/2 or 0. Itself good to 8 eps relative, or
  /// eps^2 |number| absolute where value_low is not 0. Not a number gives not a number.
  [[nodiscard]] double error(double value, double value_low = 0) const;

  /// As error(), for angles in radians: the difference modulo 2 pi, in (-pi, pi].
  [[nodiscard]] double angle_error(double value, double value_low = 0) const;

  /// |error| in units of the spacing of doubles at the number. Zero has no spacing: 0 when `value` is 0 too,
  /// else infinity.
  [[nodiscard]] double ulps_off(double value) const;

  /// |error| / |number|, with the same convention at zero.
  [[nodiscard]] double relative_error(double value) const;

 private:
  double lo_ = 0, hi_ = 0;
  std::array<double, 3> parts_ = {0, 0, 0};
};

}  // namespace vericone::verify
