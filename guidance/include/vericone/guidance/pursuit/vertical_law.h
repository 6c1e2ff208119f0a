// SPDX-License-Identifier: BSD-3-Clause
//
// The altitude of a camera that keeps what it follows at a size in its picture, (4.17)-(4.24), Algorithm 2,
// corrected (errata 3.4).
#pragma once

#include <cstdint>
#include <optional>

namespace vericone::guidance {

struct VerticalGains {
  double size = 240, size_band = 20, size_near = 5;  // x_S: wanted, where it begins to act, where it ends, px
  double altitude = 200, altitude_band = 100;        // z: wanted and most beside it, m
  double size_p = 0.018, size_d = 0.012;             // 1/s^2 and 1/s
  double altitude_p = 0.006, altitude_d = 0.003;     // 1/s^2 and 1/s
  double lock_p = 0.84, lock_d = 0.42;               // 1/s^2 and 1/s
  double most = 10;                                  // m/s^2
  /// With the term 2 phi x_W x_S'^2 / x_S^3 that (4.23) leaves out of the inversion of (4.22).
  bool exact = true;
};

/// phi of (4.17), px: of a picture `width` px wide with this field of view, rad.
[[nodiscard]] double focal_length(double width, double field_of_view);
/// u_S of (4.23), m/s^2 up, with phi x_W / x_S = z of (4.19), so that no focal length is needed. size > 0,
/// px.
[[nodiscard]] double size_acceleration(double size, double size_rate, double altitude,
                                       const VerticalGains& gains);
/// (4.24), its second sign corrected, m/s^2 up.
[[nodiscard]] double altitude_acceleration(double wanted, double altitude, double climb, double p, double d);

enum class VerticalMode : std::uint8_t { size, lock, altitude };
[[nodiscard]] const char* to_string(VerticalMode mode);

/// Algorithm 2 as it works (errata 3.4): outside the band of altitudes the altitude is driven; else a size
/// out of its band is driven until it is near the wanted one; then the altitude is locked. No allocation, no
/// throw.
class VerticalLaw {
 public:
  /// Throws InputError naming "most" where it is negative or no number.
  explicit VerticalLaw(const VerticalGains& gains);
  /// Acceleration up, m/s^2. size: x_S, px, and its rate; altitude, m, and its rate, up. A size of 0, of what
  /// is not in the picture, drives nothing.
  double step(double size, double size_rate, double altitude, double climb);
  [[nodiscard]] VerticalMode mode() const { return mode_; }

 private:
  VerticalGains gains_;
  VerticalMode mode_ = VerticalMode::size;
  std::optional<double> lock_;
  bool driving_ = false;
};

}  // namespace vericone::guidance
