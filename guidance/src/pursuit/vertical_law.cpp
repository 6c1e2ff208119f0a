// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/guidance/pursuit/source_laws.h>
#include <vericone/internal/guidance/pursuit/source_laws.h>
#include <algorithm>
#include <cmath>

namespace vericone::guidance {

const char* to_string(VerticalMode mode) {
  switch (mode) {
    case VerticalMode::size:
      return "size";
    case VerticalMode::lock:
      return "lock";
    case VerticalMode::altitude:
      return "altitude";
  }
  return "?";
}

double focal_length(double width, double field_of_view) {
  return 0.5 * width / std::tan(0.5 * field_of_view);
}

double size_acceleration(double size, double size_rate, double altitude, const VerticalGains& gains) {
  // (4.23): u_S = K_p e_S - K_d x_S' through (4.22) with phi x_W / x_S = z. The square is what the print
  // leaves out: with it x_S'' = u_S exactly.
  const double wanted = gains.size_p * (gains.size - size) - gains.size_d * size_rate;
  const double square = gains.exact ? 2 * size_rate * size_rate / size : 0;
  return altitude / size * (square - wanted);
}

double altitude_acceleration(double wanted, double altitude, double climb, double p, double d) {
  return p * (wanted - altitude) - d * climb;
}

VerticalLaw::VerticalLaw(const VerticalGains& gains) : gains_(gains) {
  if (!(gains.most >= 0)) throw InputError("most", to_text(gains.most), "0 or more (m/s^2)");
}

double VerticalLaw::step(double size, double size_rate, double altitude, double climb) {
  const double error = std::abs(size - gains_.size);
  double command = 0;
  if (!(std::abs(altitude - gains_.altitude) <= gains_.altitude_band)) {
    mode_ = VerticalMode::altitude;
    lock_.reset();
    driving_ = true;  // the size is asked again when the altitude is right
    command = altitude_acceleration(gains_.altitude, altitude, climb, gains_.altitude_p, gains_.altitude_d);
  } else {
    if (!(size > 0)) {
      driving_ = false;
    } else if (error > gains_.size_band) {
      driving_ = true;
    } else if (error < gains_.size_near) {
      driving_ = false;
    }
    if (driving_) {
      mode_ = VerticalMode::size;
      lock_.reset();
      command = size_acceleration(size, size_rate, altitude, gains_);
    } else {
      mode_ = VerticalMode::lock;
      if (!lock_) lock_ = altitude;
      command = altitude_acceleration(*lock_, altitude, climb, gains_.lock_p, gains_.lock_d);
    }
  }
  return std::clamp(command, -gains_.most, gains_.most);
}

}  // namespace vericone::guidance
