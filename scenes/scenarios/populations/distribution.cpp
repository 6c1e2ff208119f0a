// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/populations/distribution.h"

#include <vericone/cones/ellipsoids/predicates.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::populations {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

using Coefficients = std::array<double, 8>;

[[gnu::always_inline]] inline double ratio(const Coefficients& p, const Coefficients& q, double r) {
  double above = p[7], below = q[7];
  for (int i = 6; i >= 0; --i) {
    above = above * r + p[i];
    below = below * r + q[i];
  }
  return above / below;
}

// Of AS 241: near the middle, and in r = sqrt(-log(tail)) farther out.
constexpr Coefficients kA{3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                          1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                          3.3430575583588128105e4, 2.5090809287301226727e3},
    kB{1.0,
       4.2313330701600911252e1,
       6.8718700749205790830e2,
       5.3941960214247511077e3,
       2.1213794301586595867e4,
       3.9307895800092710610e4,
       2.8729085735721942674e4,
       5.2264952788528545610e3},
    kC{1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
       3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
       2.27238449892691845833e-2, 7.74545014278341407640e-4},
    kD{1.0,
       2.05319162663775882187e0,
       1.67638483018380384940e0,
       6.89767334985100004550e-1,
       1.48103976427480074590e-1,
       1.51986665636164571966e-2,
       5.47593808499534494600e-4,
       1.05075007164441684324e-9},
    kE{6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
       2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
       2.71155556874348757815e-5, 2.01033439929228813265e-7},
    kF{1.0,
       5.99832206555887937690e-1,
       1.36929880922735805310e-1,
       1.48753612908506148525e-2,
       7.86869131145613259100e-4,
       1.84631831751005468180e-5,
       1.42151175831644588870e-7,
       2.04426310338993978564e-15};
constexpr double kMiddle = 0.425;

[[gnu::always_inline]] inline double middle(double q) { return q * ratio(kA, kB, kMiddle * kMiddle - q * q); }

/// The quantile of p < 0.5 outside the middle, but for its sign. `r`: sqrt(-log(p)).
[[gnu::always_inline]] inline double tail_at(double r) {
  return r <= 5 ? ratio(kC, kD, r - 1.6) : ratio(kE, kF, r - 5);
}

/// Many at a time: the middle's polynomials of all, and then of those farther out, a seventh of them, theirs.
/// Which these are is nothing that a processor could guess, so they are put together first.
[[gnu::always_inline]] inline void normals(std::span<const double> u, double mean, double deviation,
                                           double* x) {
  constexpr std::size_t kTogether = 512;
  std::array<std::uint32_t, kTogether> at;
  std::array<double, kTogether> r;
  for (; !u.empty(); x += std::min(kTogether, u.size()), u = u.subspan(std::min(kTogether, u.size()))) {
    const std::size_t n = std::min(kTogether, u.size());
    std::size_t out = 0;
    for (std::size_t i = 0; i < n; ++i) x[i] = mean + deviation * middle(u[i] - 0.5);
    for (std::size_t i = 0; i < n; ++i) {
      at[out] = std::uint32_t(i);
      out += std::abs(u[i] - 0.5) > kMiddle;
    }
    for (std::size_t j = 0; j < out; ++j) r[j] = -std::log(std::min(u[at[j]], 1 - u[at[j]]));
    for (std::size_t j = 0; j < out; ++j) {
      const double root = std::sqrt(r[j]);
      r[j] = ratio(kC, kD, root - 1.6);
      if (root > 5) r[j] = ratio(kE, kF, root - 5);
    }
    for (std::size_t j = 0; j < out; ++j) x[at[j]] = mean + deviation * std::copysign(r[j], u[at[j]] - 0.5);
  }
}

// The same lines for wider registers, without fused products: the same bits (memberships.cpp of cones).
using Normals = void(std::span<const double>, double, double, double*);
void by_two(std::span<const double> u, double mean, double deviation, double* x) {
  normals(u, mean, deviation, x);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void by_four(std::span<const double> u, double mean, double deviation, double* x) {
  normals(u, mean, deviation, x);
}
[[gnu::target("avx512f")]] void by_eight(std::span<const double> u, double mean, double deviation,
                                         double* x) {
  normals(u, mean, deviation, x);
}
Normals* widest() {
  switch (widest_vectors()) {
    case VectorWidth::eight:
      return by_eight;
    case VectorWidth::four:
      return by_four;
    case VectorWidth::two:
      break;
  }
  return by_two;
}
#else
Normals* widest() { return by_two; }
#endif

double tail(double p) {
  const bool low = p < 0.5;
  const double r = std::sqrt(-std::log(low ? p : 1 - p));
  return low ? -tail_at(r) : tail_at(r);
}

class Uniform : public Distribution {
 public:
  Uniform(double low, double high) : low_(low), high_(high), log_(-std::log(high - low)) {}
  void quantiles(std::span<const double> u, double* x) const override {
    for (std::size_t i = 0; i < u.size(); ++i) x[i] = std::min(low_ + (high_ - low_) * u[i], high_);
  }
  double log_density(double x) const override { return x >= low_ && x <= high_ ? log_ : kNone; }
  double least() const override { return low_; }

 private:
  double low_, high_, log_;
};

class Normal : public Distribution {
 public:
  Normal(double mean, double deviation) : mean_(mean), deviation_(deviation) {}
  void quantiles(std::span<const double> u, double* x) const override {
    static Normals* const kWidest = widest();
    kWidest(u, mean_, deviation_, x);
  }
  double log_density(double x) const override {
    const double z = (x - mean_) / deviation_;
    return -0.5 * z * z - std::log(deviation_) - 0.5 * std::log(2 * std::numbers::pi);
  }
  double from_normal(double z) const override { return mean_ + deviation_ * z; }
  double least() const override { return kNone; }

 private:
  double mean_, deviation_;
};

/// By its symmetry: the probability of being within x of the mean, at nodes, and the density in between.
class VonMises : public Distribution {
 public:
  VonMises(double mean, double concentration) : mean_(mean), concentration_(concentration) {
    // Beyond 14 / sqrt(concentration) there is less than 1e-17 of all.
    most_ = std::min(std::numbers::pi, concentration > 0 ? 14 / std::sqrt(concentration) : 4.0);
    for (int i = 0; i < kCells; ++i) within_[i + 1] = within_[i] + mass(at(i), at(i + 1));
    all_ = within_[kCells];
  }
  void quantiles(std::span<const double> u, double* x) const override {
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double side = 2 * u[i] - 1;
      x[i] = mean_ + std::copysign(distance(std::abs(side) * all_), side);
    }
  }
  double log_density(double x) const override {
    const double off = std::abs(x - mean_);
    return off <= most_ * (1 + 1e-12) ? concentration_ * (std::cos(off) - 1) - std::log(2 * all_) : kNone;
  }
  double least() const override { return mean_ - most_; }

 private:
  static constexpr int kCells = 1024;

  double at(int i) const { return most_ * i / kCells; }
  double density(double x) const { return std::exp(concentration_ * (std::cos(x) - 1)); }
  /// Between two places in one cell: Gauss and Legendre's rule of three points, whose error is below 1e-15 of
  /// a cell.
  double mass(double from, double to) const {
    const double centre = 0.5 * (from + to), half = 0.5 * (to - from), node = half * std::sqrt(0.6);
    return half / 9 * (8 * density(centre) + 5 * (density(centre - node) + density(centre + node)));
  }
  double distance(double target) const {
    const auto* next = std::upper_bound(within_.begin(), within_.end(), target);
    const int i = std::clamp(int(next - within_.begin()) - 1, 0, kCells - 1);
    const double from = at(i), to = at(i + 1), wanted = target - within_[i];
    const double cell = within_[i + 1] - within_[i];
    double x = cell > 0 ? from + (to - from) * wanted / cell : from;
    for (int k = 0; k < 2; ++k) {
      const double slope = density(x);
      if (slope > 0) x = std::clamp(x - (mass(from, x) - wanted) / slope, from, to);
    }
    return x;
  }

  double mean_, concentration_, most_ = 0, all_ = 0;
  std::array<double, kCells + 1> within_{};
};

class Elevation : public Distribution {
 public:
  Elevation(double low, double high)
      : low_(low), high_(high), sine_(std::sin(low)), width_(std::sin(high) - std::sin(low)) {}
  void quantiles(std::span<const double> u, double* x) const override {
    for (std::size_t i = 0; i < u.size(); ++i)
      x[i] = std::clamp(std::asin(std::clamp(sine_ + width_ * u[i], -1.0, 1.0)), low_, high_);
  }
  double log_density(double x) const override {
    return x >= low_ && x <= high_ ? std::log(std::cos(x) / width_) : kNone;
  }
  double least() const override { return low_; }

 private:
  double low_, high_, sine_, width_;
};

class Table : public Distribution {
 public:
  Table(std::vector<double> edges, const std::vector<double>& weights)
      : edges_(std::move(edges)), below_(edges_.size(), 0) {
    for (std::size_t i = 0; i < weights.size(); ++i) below_[i + 1] = below_[i] + weights[i];
  }
  void quantiles(std::span<const double> u, double* x) const override {
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double target = u[k] * below_.back();
      const std::size_t i = cell(below_, target);
      const double part = (target - below_[i]) / (below_[i + 1] - below_[i]);
      x[k] = std::min(edges_[i] + (edges_[i + 1] - edges_[i]) * part, edges_[i + 1]);
    }
  }
  double log_density(double x) const override {
    if (!(x >= edges_.front() && x <= edges_.back())) return kNone;
    const std::size_t i = cell(edges_, x);
    return std::log((below_[i + 1] - below_[i]) / below_.back() / (edges_[i + 1] - edges_[i]));
  }
  double least() const override { return edges_.front(); }

 private:
  /// The last that begins at or before the place; of cells without length, none.
  static std::size_t cell(const std::vector<double>& begins, double place) {
    auto next = std::upper_bound(begins.begin(), begins.end(), place);
    if (next == begins.end()) next = std::lower_bound(begins.begin(), begins.end(), begins.back());
    return std::size_t(next - begins.begin()) - 1;
  }

  std::vector<double> edges_, below_;
};

}  // namespace

double normal_quantile(double p) { return std::abs(p - 0.5) <= kMiddle ? middle(p - 0.5) : tail(p); }

double Distribution::from_normal(double z) const {
  // The nearest below 1: a value of z above 8.2 is as rare as one in 1e16.
  const double u =
      std::clamp(0.5 * std::erfc(-z / std::numbers::sqrt2), std::numeric_limits<double>::min(), 1 - 0x1p-53);
  double x = 0;
  quantiles({&u, 1}, &x);
  return x;
}

DistributionPtr uniform(double low, double high) { return std::make_shared<Uniform>(low, high); }
DistributionPtr normal(double mean, double deviation) { return std::make_shared<Normal>(mean, deviation); }
DistributionPtr von_mises(double mean, double concentration) {
  return std::make_shared<VonMises>(mean, concentration);
}
DistributionPtr elevation(double low, double high) { return std::make_shared<Elevation>(low, high); }
DistributionPtr table(std::vector<double> edges, std::vector<double> weights) {
  return std::make_shared<Table>(std::move(edges), weights);
}

}  // namespace vericone::populations
