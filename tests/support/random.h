// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "support/campaign.h"

namespace vericone::testing {

/// Random input from a seed that the test names; the environment variable VERICONE_SEED replaces it.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(from_environment("VERICONE_SEED", seed)), engine_(seed_) {
    ::testing::Test::RecordProperty("seed", std::to_string(seed_));
  }

  /// For SCOPED_TRACE, so that a failure tells how to repeat it.
  std::string trace() const { return "VERICONE_SEED=" + std::to_string(seed_); }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  double normal() { return std::normal_distribution<double>()(engine_); }

  template <int D>
  Eigen::Matrix<double, D, 1> vector() {
    Eigen::Matrix<double, D, 1> v;
    for (int i = 0; i < D; ++i) v(i) = normal();
    return v;
  }

  template <int D>
  Eigen::Matrix<double, D, D> rotation() {
    if constexpr (D == 2)
      return Eigen::Rotation2Dd(uniform(-3.2, 3.2)).toRotationMatrix();
    else
      return Eigen::Quaterniond(Eigen::Vector4d(vector<4>().normalized())).toRotationMatrix();
  }

  template <typename Iterator>
  void shuffle(Iterator first, Iterator last) {
    std::shuffle(first, last, engine_);
  }

 private:
  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace vericone::testing
