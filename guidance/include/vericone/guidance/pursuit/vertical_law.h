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
  double size_p = 0.018, size_d = 0.012;
  double altitude_p = 0.006, altitude_d = 0.003;
  double lock_p = 0.84, lock_d = 0.42;
  double most = 10;  // m/s^2
};

enum class VerticalMode : std::uint8_t { size, lock, altitude };
[[nodiscard]] const char* to_string(VerticalMode mode);

class VerticalLaw {
 public:
  explicit VerticalLaw(const VerticalGains& gains) : gains_(gains) {}
  /// Acceleration up, m/s^2. size: x_S, px, and its rate; altitude, m, and its rate, up; focal: px.
  double step(double size, double size_rate, double altitude, double climb, double focal);
  [[nodiscard]] VerticalMode mode() const { return mode_; }

 private:
  VerticalGains gains_;
  VerticalMode mode_ = VerticalMode::size;
  std::optional<double> lock_;
  bool driving_ = false;
};

}  // namespace vericone::guidance
