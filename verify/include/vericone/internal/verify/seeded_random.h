// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace vericone::verify {

/// Random numbers that depend on nothing but (stream, seed, index): std::mt19937_64 is the same everywhere,
/// the standard distributions are not. Only operations that IEEE 754 rounds correctly are used.
///
/// Give every call its own statement: the order of evaluation of arguments is not fixed.
class SeededRandom {
 public:
  /// `stream` keeps the users of one seed apart.
  SeededRandom(std::uint32_t stream, std::uint64_t seed, std::uint64_t index) {
    std::seed_seq sequence{low(seed), high(seed), stream, low(index), high(index)};
    engine_.seed(sequence);
  }

  /// In [from, to), up to a rounding.
  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  /// In {from, ..., to}.
  int integer(int from, int to) {
    return from + static_cast<int>(engine_() % static_cast<std::uint64_t>(to - from + 1));
  }

  bool coin() { return engine_() >> 63; }

  /// Uniform on the unit circle (D = 2) or sphere (D = 3), to a rounding: a point of the unit ball, away from
  /// its centre, normalised.
  template <int D>
  Eigen::Matrix<double, D, 1> direction() {
    for (;;) {
      Eigen::Matrix<double, D, 1> v;
      for (int i = 0; i < D; ++i) v(i) = uniform(-1, 1);
      double r2 = 0;
      for (int i = 0; i < D; ++i) r2 += v(i) * v(i);
      if (r2 <= 1 && r2 >= 0.01) return v / std::sqrt(r2);
    }
  }

  /// Uniform rotation: the matrix of a uniform unit quaternion, orthonormal to a rounding.
  Eigen::Matrix3d rotation() {
    const Eigen::Vector4d q = direction<4>();
    const double w = q(0), x = q(1), y = q(2), z = q(3);
    Eigen::Matrix3d r;
    r << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
        2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),   //
        2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
    return r;
  }

 private:
  [[nodiscard]] static std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  [[nodiscard]] static std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

  std::mt19937_64 engine_;
};

}  // namespace vericone::verify
